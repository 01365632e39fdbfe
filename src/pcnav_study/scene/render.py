"""A frame as the pinhole camera would take it over the relief."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid


MOST = 256  # planes


def render(
    radiance: xr.DataArray, elevation: xr.DataArray, camera: Camera, pose: Pose
) -> NDArray[np.float32]:
    """Image of ``camera.shape``: each pixel's ray is followed down to the relief.

    Every ray is sampled on level planes between the highest and the lowest ground in sight,
    so close that none passes more than one pixel of the map from plane to plane (but 256 at
    most); the first sample below ground brackets the surface, and a secant step between
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
    planes = _planes(heights, grid, pose, rays)
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


def _planes(
    heights: NDArray[np.float64], grid: Grid, pose: Pose, rays: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Descending heights at which the rays are sampled."""
    slant = np.hypot(rays[..., 0], rays[..., 1])
    slant = float(np.nanmax(slant)) if np.isfinite(slant).any() else 0.0
    reach = slant * (pose.height - heights.min())
    (top, left), (bottom, right) = (
        np.array(grid.row_col(pose.east + side * reach, pose.north - side * reach))
        for side in (-1, 1)
    )
    rows, cols = (
        slice(max(int(first), 0), max(int(last) + 2, 1))
        for first, last in ((top, bottom), (left, right))
    )
    seen = heights[rows, cols]
    if not seen.size:
        seen = heights
    highest, lowest = min(seen.max() + 1.0, pose.height), seen.min() - 1.0
    passed = slant * (highest - lowest) / min(grid.pixel_size)
    return np.linspace(highest, lowest, int(np.clip(np.ceil(passed), 1, MOST - 1)) + 1)


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
