"""A frame as the pinhole camera would take it over the relief."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid


def render(
    radiance: xr.DataArray, elevation: xr.DataArray, camera: Camera, pose: Pose, *, steps: int = 64
) -> NDArray[np.float32]:
    """Image of ``camera.shape``: each pixel's ray is followed down to the relief.

    Every ray is sampled on ``steps`` level planes between the highest and the lowest
    ground; the first sample below ground brackets the surface, and a secant step between
    the two brackets places it.

    Parameters
    ----------
    radiance, elevation : DataArray (y, x)
        On the same grid, in a metric CRS; heights in metres.

    Returns
    -------
    (rows, columns) float32
        NaN where the ray leaves the map or looks at the sky.
    """
    grid = Grid.of(elevation)
    heights = elevation.values.astype(np.float64)
    rows, cols = np.indices(camera.shape, dtype=np.float64)
    rays = camera.rays(rows, cols, pose)
    down = np.where(rays[..., 2:] < 0, -rays[..., 2:], np.nan)
    rays = rays / down
    top = min(heights.max() + 1.0, pose.height)
    planes = np.linspace(top, heights.min() - 1.0, steps)
    hit = np.full(camera.shape, np.nan)
    above = np.full(camera.shape, np.nan)
    for k, plane in enumerate(planes):
        clearance = plane - _sample(heights, grid, pose, rays, np.full(camera.shape, plane))
        if k:
            crossed = np.isnan(hit) & (clearance <= 0) & (above > 0)
            share = above / np.where(crossed, above - clearance, 1.0)
            hit = np.where(crossed, planes[k - 1] + share * (plane - planes[k - 1]), hit)
        above = clearance
    return _sample(radiance.values.astype(np.float64), grid, pose, rays, hit).astype(np.float32)


def _sample(
    values: NDArray[np.float64],
    grid: Grid,
    pose: Pose,
    rays: NDArray[np.float64],
    level: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Values where each ray passes its level; NaN off the grid."""
    drop = pose.height - level
    row, col = grid.row_col(pose.east + drop * rays[..., 0], pose.north + drop * rays[..., 1])
    at = np.nan_to_num([row, col], nan=-9.0)
    sampled: NDArray[np.float64] = ndimage.map_coordinates(values, at, order=1, cval=np.nan)
    return sampled
