"""From the frame's geometry to the map's.

Each ground point of the map grid, with its height, is projected into the frame and looked
up there. On level ground that is the plane homography of Hartley and Zisserman [1]_; with
an elevation model it is an orthophoto.

References
----------
.. [1] Hartley and Zisserman (2004), Multiple View Geometry, section 8.1.1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid

SAMPLES = 32  # along each axis, from which the scale is measured


def rectify(
    frame: NDArray[np.floating],
    camera: Camera,
    pose: Pose,
    grid: Grid,
    ground: NDArray[np.floating] | float,
) -> NDArray[np.float32]:
    """The frame as the map would show it.

    Parameters
    ----------
    frame : (rows, columns)
        NaN is no data.
    grid : Grid
        In a metric CRS, that of ``pose``.
    ground : float or array of ``grid.shape``
        Height of the ground in metres, level or from an elevation model.

    Returns
    -------
    array of ``grid.shape``, float32
        NaN outside the picture.

    Raises
    ------
    InputError
        If the frame is not of the camera's size.
    """
    if frame.shape != camera.shape:
        raise InputError(
            f"a frame of {frame.shape} px does not fit the camera's {camera.shape}; "
            "give each camera a flight folder of its own"
        )
    north, east = grid.coordinates()
    at = np.stack(camera.project_map(east, north, ground, pose))
    shrink = _shrink_factor(*at)
    small = _block_mean(np.asarray(frame, np.float64), shrink)
    if shrink > 1:
        at -= (shrink - 1) / 2
        at /= shrink
    at[np.isnan(at)] = -9.0
    out = np.empty(grid.shape, np.float32)
    ndimage.map_coordinates(small, at, output=out, order=1, cval=np.nan)
    return out


def bounding_grid(corners: NDArray[np.float64], pixel: float, crs: str) -> Grid:
    """The smallest north-up grid of even sides that holds a footprint.

    Parameters
    ----------
    corners : (4, 2)
        East and north.
    pixel : float
        Side of a pixel in metres.
    """
    low, high = corners.min(axis=0), corners.max(axis=0)
    cols, rows = (2 * int(np.ceil(side / 2 / pixel)) for side in high - low)
    middle = (low + high) / 2
    return Grid.centred(middle[0], middle[1], (pixel, pixel), (rows, cols), crs)


def central_grid(corners: NDArray[np.float64], pixel: float, crs: str) -> Grid:
    """The north-up square, of even side, about a footprint's middle and as wide as it is narrow.

    Its corners may lie outside the picture.
    """
    middle = corners.mean(axis=0)
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
    side = 2 * int(sides.min() / 2 / pixel)
    return Grid.centred(middle[0], middle[1], (pixel, pixel), (side, side), crs)


def _shrink_factor(rows: NDArray[np.float64], cols: NDArray[np.float64]) -> int:
    """Whole frame pixels that one map pixel covers, at least one."""
    every = max(1, min(rows.shape) // SAMPLES)
    rows, cols = rows[::every, ::every], cols[::every, ::every]
    area = (
        np.abs(
            np.gradient(rows, axis=0) * np.gradient(cols, axis=1)
            - np.gradient(rows, axis=1) * np.gradient(cols, axis=0)
        )
        / every**2
    )
    side = np.sqrt(np.nanmedian(area)) if np.isfinite(area).any() else 1.0
    return max(1, int(side))


def _block_mean(image: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Means of size x size blocks; the rest at the right and bottom is left out."""
    if size == 1:
        return image
    rows, cols = (n // size for n in image.shape)
    blocks = image[: rows * size, : cols * size].reshape(rows, size, cols, size)
    return np.asarray(blocks.mean(axis=(1, 3)))
