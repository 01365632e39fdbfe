"""Footprints on the ground as GeoJSON (RFC 7946): WGS 84, counter-clockwise, closed rings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike
from pyproj import CRS, Transformer


def footprint_collection(
    table: pd.DataFrame, corners: dict[str, ArrayLike], crs: str
) -> dict[str, Any]:
    """A FeatureCollection: a polygon for each placed frame.

    Parameters
    ----------
    table : DataFrame
        As ``flight_table`` gives it.
    corners : dict
        (4, 2) east and north of each placed frame's picture, by frame, in ``crs``.
    """
    to_degrees = Transformer.from_crs(CRS(crs), 4326, always_xy=True)
    features = []
    for row in table[table["frame"].isin(list(corners))].to_dict("records"):
        east, north = np.asarray(corners[row["frame"]], float).T
        if _clockwise(east, north):
            east, north = east[::-1], north[::-1]
        longitude, latitude = to_degrees.transform(east, north)
        ring = [[round(x, 8), round(y, 8)] for x, y in zip(longitude, latitude, strict=True)]
        names = ("frame", "status", "alarm", "quality", "method")
        camera = [row["longitude"], row["latitude"]]
        features.append(
            {
                "type": "Feature",
                "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
                "properties": {name: row[name] for name in names} | {"camera": camera},
            }
        )
    return {"type": "FeatureCollection", "features": features}


def _clockwise(x: Any, y: Any) -> bool:
    """By the shoelace formula."""
    return bool((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() < 0)
