"""What every matcher does first: check the pair, and lay the two windows on each other."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import windows as tapers

from pcnav_study.errors import InputError

Image = NDArray[np.float64]
SMALLEST = 8  # px; below it a window holds no texture to match


def as_image(image: ArrayLike, name: str) -> Image:
    """A float64 copy of a two-dimensional real image, no-data filled with the mean.

    Raises
    ------
    InputError
        If it is not two-dimensional, is complex, holds infinities, or is too small.
    """
    array: NDArray[Any] = np.asarray(image)
    if array.ndim != 2:
        raise InputError(
            f"{name} has {array.ndim} dimensions; give one band of shape (rows, columns)"
        )
    if np.iscomplexobj(array):
        raise InputError(f"{name} is complex; give its real part or its magnitude")
    if min(array.shape) < SMALLEST:
        raise InputError(f"{name} of {array.shape} px is too small; give at least {SMALLEST} px")
    values = array.astype(np.float64)
    if np.isinf(values).any():
        raise InputError(f"{name} holds infinities; mark missing data with NaN")
    missing = np.isnan(values)
    if missing.any():
        values[missing] = 0.0 if missing.all() else values[~missing].mean()
    return values


def default_max_shift(reference: Image, moving: Image) -> float:
    """The search margin around the moving image plus a quarter of its shorter side."""
    margin = min(a - b for a, b in zip(reference.shape, moving.shape, strict=True)) / 2
    return float(margin + min(moving.shape) // 4)


def tapered(image: Image) -> Image:
    """The image without its mean, faded to zero at the rim by a Hann window."""
    rows, cols = (tapers.hann(n, sym=False) for n in image.shape)
    faded: Image = (image - image.mean()) * np.outer(rows, cols)
    return faded


def embedded(moving: Image, shape: tuple[int, int]) -> tuple[Image, NDArray[np.float64]]:
    """The moving image in zeros of ``shape``, and where its centre lies off the middle."""
    frame = np.zeros(shape)
    top, left = ((s - m) // 2 for s, m in zip(shape, moving.shape, strict=True))
    frame[top : top + moving.shape[0], left : left + moving.shape[1]] = moving
    return frame, np.array([s - m for s, m in zip(shape, moving.shape, strict=True)]) / 2 - (
        top,
        left,
    )


def template_of(
    reference: Image, moving: Image, max_shift: float
) -> tuple[Image, tuple[float, float]]:
    """The middle of the moving image that stays inside the reference for every shift sought.

    Returns the template, and the shift that puts it at the reference's first pixel.
    """
    cuts = [
        max(0, int(np.ceil(max_shift - (r - m) / 2)))
        for r, m in zip(reference.shape, moving.shape, strict=True)
    ]
    rows, cols = (slice(c, m - c) for c, m in zip(cuts, moving.shape, strict=True))
    template = moving[rows, cols]
    if min(template.shape) < SMALLEST:
        raise InputError(
            f"max_shift {max_shift:g} px leaves no template of a {moving.shape} px image; "
            "lower max_shift or give a larger reference"
        )
    origin = tuple(-(r - t) / 2 for r, t in zip(reference.shape, template.shape, strict=True))
    return template, (origin[0], origin[1])
