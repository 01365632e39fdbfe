"""Sites by name."""

from __future__ import annotations

import numpy as np
import xarray as xr

from pcnav_study.frames import read_elevation
from pcnav_study.scene import Grid, fractal_relief, jacksboro

FRACTAL_SIDE, FRACTAL_PIXEL = 480, (30.0, 30.0)  # px, metres


def elevation_of(site: str) -> xr.DataArray:
    """``jacksboro``, ``fractal:SEED``, or the path of an elevation GeoTIFF."""
    if site == "jacksboro":
        return jacksboro()
    kind, _, seed = site.partition(":")
    if kind == "fractal" and seed.isdigit():
        shape = (FRACTAL_SIDE, FRACTAL_SIDE)
        grid = Grid.centred(400_000.0, 3_800_000.0, FRACTAL_PIXEL, shape, "EPSG:32611")
        heights = fractal_relief(shape, FRACTAL_PIXEL, np.random.default_rng(int(seed)))
        return grid.image(heights.astype(np.float32), "elevation")
    return read_elevation(site)
