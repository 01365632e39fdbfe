"""Footprints on the ground as GeoJSON (RFC 7946): WGS 84, counter-clockwise, closed rings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from pyproj import CRS, Transformer

from pcnav_study.navigation.calibration import Installation
from pcnav_study.navigation.localise import Fix


def footprint_collection(
    table: pd.DataFrame, fixes: Mapping[str, Fix], constants: Installation
) -> dict[str, Any]:
    """A FeatureCollection: a polygon for each placed frame.

    Parameters
    ----------
    table : DataFrame
        As ``flight_table`` gives it.
    fixes : mapping
        Of the placed frames, by name.
    constants : Installation
        Its map bias is taken off the footprints; the camera's look does not move them.
    """
    features = []
    for row in table[table["frame"].isin(list(fixes))].to_dict("records"):
        fix = fixes[row["frame"]]
        to_degrees = Transformer.from_crs(CRS(fix.fine.grid.crs), 4326, always_xy=True)
        east, north = (fix.footprint - constants.bias).T
        if _clockwise(east, north):
            east, north = east[::-1], north[::-1]
        longitude, latitude = to_degrees.transform(east, north)
        ring = [[round(x, 8), round(y, 8)] for x, y in zip(longitude, latitude, strict=True)]
        names = ("frame", "status", "alarm", "quality", "method")
        features.append(
            {
                "type": "Feature",
                "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
                "properties": {name: row[name] for name in names}
                | {"camera_longitude": row["longitude"], "camera_latitude": row["latitude"]},
            }
        )
    return {"type": "FeatureCollection", "features": features}


def _clockwise(x: Any, y: Any) -> bool:
    """By the shoelace formula."""
    return bool((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() < 0)
