"""Ground that a ridge hides from the camera."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.scene.camera import Pose
from pcnav_study.scene.grid import Grid

MOST_STEPS = 64


def occluded(
    ground: NDArray[np.floating], grid: Grid, pose: Pose, *, clearance: float | None = None
) -> NDArray[np.bool_]:
    """True where the line of sight to the camera passes below the ground.

    The line is followed, in steps of about a pixel, until it is above the highest ground.

    Parameters
    ----------
    ground : (rows, columns)
        Heights on ``grid``, metres.
    clearance : float, optional
        Metres by which ground must rise above the line to hide what is behind; a quarter of
        a pixel by default, as interpolated ground is no surer than that.
    """
    height = np.asarray(ground, np.float64)
    x, y = grid.mesh()
    dy, dx = grid.pixel_size
    to_east, to_north, up = pose.east - x, pose.north - y, pose.height - height
    reach = np.clip((height.max() - height) / np.maximum(up, 1e-9), 0.0, 1.0)
    pixels = float((reach * np.hypot(to_east / dx, to_north / dy)).max())
    steps = min(int(np.ceil(pixels)), MOST_STEPS)
    spare = 0.25 * min(dy, dx) if clearance is None else clearance
    row, col = np.indices(grid.shape, dtype=np.float64)
    hidden = np.zeros(grid.shape, bool)
    for k in range(1, steps + 1):
        t = reach * (k / steps)
        at = np.stack([row - t * to_north / dy, col + t * to_east / dx])
        between = ndimage.map_coordinates(height, at, order=1, mode="nearest")
        hidden |= between > height + t * up + spare
    return hidden
