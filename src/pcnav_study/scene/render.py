"""A frame as the pinhole camera would take it over the relief."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid

MOST = 256  # planes
CONTRACTION = 0.9  # largest product of the ground's slope and the rays' slant iterated with
ROUNDS, SETTLED = 60, 0.02  # iterations, and the metres between two that end them


def render(
    radiance: xr.DataArray, elevation: xr.DataArray, camera: Camera, pose: Pose
) -> NDArray[np.float32]:
    """Image of ``camera.shape``: each pixel's ray is followed down to the relief.

    Where the ground is everywhere less steep than the rays, each ray meets it once, and the
    meeting is found by fixed-point iteration. Elsewhere every ray is sampled on level planes
    between the highest and the lowest ground in sight, so close that none passes more than
    one pixel of the map from plane to plane (but 256 at most); the first sample below
    ground brackets the surface, and a secant step between the two brackets places it.

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
    slant = np.hypot(rays[..., 0], rays[..., 1])
    steepest = float(np.nanmax(slant)) if np.isfinite(slant).any() else 0.0
    seen, whole = _in_sight(heights, grid, pose, steepest)
    level = None
    if whole and np.isfinite(slant).all() and steepest * _steepest(seen, grid) < CONTRACTION:
        level = _settled(heights, grid, pose, rays, float(seen.mean()))
    if level is None:
        level = _marched(heights, grid, pose, rays, _planes(seen, grid, pose, steepest))
    return _sample(radiance.values.astype(np.float64), grid, pose, rays, level).astype(np.float32)


def _in_sight(
    heights: NDArray[np.float64], grid: Grid, pose: Pose, slant: float
) -> tuple[NDArray[np.float64], bool]:
    """The part of the map that rays of at most this slant can meet, and whether it is all there."""
    reach = slant * max(pose.height - heights.min(), 0.0)
    (top, left), (bottom, right) = (
        np.array(grid.row_col(pose.east + side * reach, pose.north - side * reach))
        for side in (-1, 1)
    )
    rows, cols = heights.shape
    seen = heights[
        max(int(top), 0) : max(int(bottom) + 2, 1), max(int(left), 0) : max(int(right) + 2, 1)
    ]
    whole = min(top, left) >= 0 and bottom <= rows - 1 and right <= cols - 1
    return (seen if seen.size else heights), bool(whole and pose.height > heights.max())


def _steepest(seen: NDArray[np.float64], grid: Grid) -> float:
    """Bound of the slope of the surface between the pixels, as rise over run."""
    dy, dx = grid.pixel_size
    return float(
        np.hypot(
            np.abs(np.diff(seen, axis=0)).max(initial=0.0) / dy,
            np.abs(np.diff(seen, axis=1)).max(initial=0.0) / dx,
        )
    )


def _settled(
    heights: NDArray[np.float64],
    grid: Grid,
    pose: Pose,
    rays: NDArray[np.float64],
    level: float,
) -> NDArray[np.float64] | None:
    """Where each ray meets the ground, by repeating: look up the height, go down to it.

    Where the ground rises less along a ray than the ray falls, this is a contraction: it
    has one fixed point, the only meeting. None if it takes too long.
    """
    found = np.full(rays.shape[:2], level)
    for _ in range(ROUNDS):
        before, found = found, _sample(heights, grid, pose, rays, found)
        if np.abs(found - before).max() < SETTLED:
            return found
    return None


def _marched(
    heights: NDArray[np.float64],
    grid: Grid,
    pose: Pose,
    rays: NDArray[np.float64],
    planes: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Where each ray first passes from above the ground to below it; NaN where it never does."""
    flat = rays.reshape(-1, rays.shape[-1])
    hit = np.full(len(flat), np.nan)
    under_way = np.arange(len(flat))
    above = np.full(len(flat), np.nan)
    for k, plane in enumerate(planes):
        level = np.full(len(under_way), plane)
        clearance = plane - _sample(heights, grid, pose, flat[under_way], level)
        if k:
            before = above[under_way]
            crossed = (clearance <= 0) & (before > 0)
            share = before[crossed] / (before - clearance)[crossed]
            hit[under_way[crossed]] = planes[k - 1] + share * (plane - planes[k - 1])
            under_way, clearance = under_way[~crossed], clearance[~crossed]
        above[under_way] = clearance
    return hit.reshape(rays.shape[:2])


def _planes(seen: NDArray[np.float64], grid: Grid, pose: Pose, slant: float) -> NDArray[np.float64]:
    """Descending heights at which the rays are sampled."""
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
