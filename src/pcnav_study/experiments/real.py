"""Window pairs of two real pictures of one place, where the registration is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import rasterio
from numpy.typing import NDArray
from skimage.transform import AffineTransform, warp

from pcnav_study.errors import InputError
from pcnav_study.frames.images import read_grey
from pcnav_study.frames.maps import metric_crs, read_window
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.trials import Trials

VALID_SHARE = 0.99  # of both windows


def registered(
    reference: str, moving: str, affine: str | None = None
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Both pictures on the reference's pixels; NaN where the moving one shows nothing.

    Parameters
    ----------
    reference, moving : str
        Paths. Georeferenced rasters, or images with ``affine``.
    affine : str, optional
        Text file of 2 x 3 numbers that take pixel (x, y, 1) of the reference to the moving
        image.

    Raises
    ------
    InputError
        If a file cannot be read, or neither georeference nor affine relates the two.
    """
    if affine is not None:
        fixed, moved = read_grey(Path(reference)), read_grey(Path(moving))
        try:
            matrix = np.vstack([np.loadtxt(affine).reshape(2, 3), [0, 0, 1]])
        except (OSError, ValueError) as error:
            raise InputError(
                f"{affine} does not hold 2 x 3 numbers ({error}); correct it"
            ) from error
        seen = warp(moved, AffineTransform(matrix), output_shape=fixed.shape, order=1, cval=np.nan)
        return fixed, seen.astype(np.float32)
    metric_crs(reference)
    with rasterio.open(reference) as raster:
        grid = Grid(raster.transform, raster.shape, raster.crs.to_wkt())
    return read_window(reference, grid), read_window(moving, grid)


def draw_registered(
    fixed: NDArray[np.float32],
    moved: NDArray[np.float32],
    size: int,
    n: int,
    rng: np.random.Generator,
) -> Trials:
    """``n`` pairs at random places, displaced by whole pixels, up to a sixth of the window.

    Raises
    ------
    InputError
        If no ``size`` px windows of both show enough valid ground.
    """
    reach = size // 6 - 1
    room = np.array(fixed.shape) - size
    references, movings, shifts = [], [], []
    for _ in range(200 * n):
        whole = rng.integers(-reach, reach + 1, 2)
        first, last = np.maximum(0, -whole), room - np.maximum(0, whole)
        if (last < first).any():
            break
        corner = rng.integers(first, last + 1)
        one, other = (
            image[at[0] : at[0] + size, at[1] : at[1] + size]
            for image, at in ((fixed, corner), (moved, corner + whole))
        )
        if min(np.isfinite(one).mean(), np.isfinite(other).mean()) >= VALID_SHARE:
            references.append(one)
            movings.append(other)
            shifts.append(whole)
        if len(shifts) == n:
            return Trials(np.array(references), np.array(movings), np.array(shifts, np.float64))
    raise InputError(
        f"the two pictures share too little valid ground for windows of {size} px; "
        "lower pairs.window_px"
    )
