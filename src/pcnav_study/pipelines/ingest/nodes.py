"""Nodes of the ingest pipeline."""

from __future__ import annotations

import logging

import pandas as pd
import xarray as xr

from pcnav_study.errors import InputError
from pcnav_study.frames import read_elevation
from pcnav_study.pipelines.parameters import Ingest
from pcnav_study.scene import Grid, jacksboro, sun_position

logger = logging.getLogger(__name__)


def load_elevation(ingest: Ingest) -> xr.DataArray:
    """The embedded tile, or the user's elevation model."""
    elevation = jacksboro() if ingest.elevation == "jacksboro" else read_elevation(ingest.elevation)
    dy, dx = Grid.of(elevation).pixel_size
    rows, cols = elevation.shape
    logger.info(
        "Relief: %d x %d pixels of %.1f x %.1f m, %.0f to %.0f m high",
        rows, cols, dy, dx, float(elevation.min()), float(elevation.max()),
    )  # fmt: skip
    return elevation


def place_suns(elevation: xr.DataArray, ingest: Ingest) -> pd.DataFrame:
    """Sun over the middle of the map at the map's time (first row) and at each flight's."""
    grid = Grid.of(elevation)
    y, x = (float(axis.mean()) for axis in grid.coordinates())
    latitude, longitude = grid.to_wgs84(x, y)
    rows = []
    for role, time in [("map", ingest.map_time), *(("flight", t) for t in ingest.flight_times)]:
        sun = sun_position(time, latitude, longitude)
        if not sun.is_up:
            raise InputError(
                f"the sun is below the horizon at {time}; choose a daylight time in "
                f"ingest.{'map_time' if role == 'map' else 'flight_times'}"
            )
        logger.info(
            "Sun of the %s at %s: azimuth %.0f, zenith %.0f deg",
            role,
            time,
            sun.azimuth,
            sun.zenith,
        )
        rows.append({"role": role, "time": time, "azimuth": sun.azimuth, "zenith": sun.zenith})
    return pd.DataFrame(rows)
