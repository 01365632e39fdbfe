"""Nodes of the simulate pipeline."""

from __future__ import annotations

import logging

import numpy as np
import pandas as pd
import xarray as xr

from pcnav_study.pipelines.parameters import Simulate
from pcnav_study.scene import Camera, SunPosition, fly, fractal_albedo, shade, waypoints

logger = logging.getLogger(__name__)


def map_sun(suns: pd.DataFrame) -> SunPosition:
    """The sun of the map: the row of that role."""
    row = suns[suns["role"] == "map"].iloc[0]
    return SunPosition(float(row["azimuth"]), float(row["zenith"]))


def paint_ground(elevation: xr.DataArray, simulate: Simulate) -> xr.DataArray:
    """Reflectance of the ground."""
    rng = np.random.default_rng([simulate.seed, 0])
    values = fractal_albedo(
        (elevation.sizes["y"], elevation.sizes["x"]), simulate.albedo_contrast, rng
    )
    return elevation.copy(data=values.astype(np.float32)).rename("albedo")


def photograph_map(
    elevation: xr.DataArray, albedo: xr.DataArray, suns: pd.DataFrame, simulate: Simulate
) -> xr.DataArray:
    """The satellite image, under the map's sun."""
    sun = map_sun(suns)
    image = (shade(elevation, sun=sun, shadows=simulate.shadows) * albedo.values).astype(np.float32)
    image.attrs.update(sun_azimuth=sun.azimuth, sun_zenith=sun.zenith)
    return image.rename("radiance")


def fly_route(
    elevation: xr.DataArray, albedo: xr.DataArray, suns: pd.DataFrame, simulate: Simulate
) -> xr.Dataset:
    """Frames of one flight along the route under every flight sun."""
    route = waypoints(elevation, simulate.route.start, simulate.route.end, simulate.route.waypoints)
    frames = fly(
        elevation,
        albedo.values,
        suns[suns["role"] == "flight"],
        map_sun(suns),
        route,
        Camera.from_field_of_view(simulate.camera.shape, simulate.camera.field_of_view),
        height_above_ground=simulate.height_above_ground_m,
        attitude_sigma=simulate.attitude_sigma_deg,
        position_sigma=simulate.position_sigma_m,
        noise=simulate.noise,
        shadows=simulate.shadows,
        rng=np.random.default_rng([simulate.seed, 1]),
    )
    logger.info(
        "Photographed %d frames: %d waypoints under %d suns",
        frames.sizes["frame"], len(route), frames.sizes["frame"] // len(route),
    )  # fmt: skip
    return frames
