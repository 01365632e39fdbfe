"""Two windows and what is asked of them: the one argument of every matcher."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import SMALLEST, Window
from pcnav_study.scene.sun import SunPosition


@dataclass(frozen=True, slots=True)
class Pair:
    """One matching task.

    Attributes
    ----------
    reference, moving : Window
        The reference is at least as large as the moving image.
    reach : (row, column)
        Largest shift sought, px, between the two centres.
    sun : (SunPosition, SunPosition), optional
        Of the reference and of the moving image.
    pixel_size : (dy, dx)
        Any unit; only its ratio matters, to a method that knows directions on the ground.
    subpixel : str, optional
        A name in ``subpixel.ESTIMATORS``; None is the method's own choice.
    """

    reference: Window
    moving: Window
    reach: tuple[float, float]
    sun: tuple[SunPosition, SunPosition] | None = None
    pixel_size: tuple[float, float] = (1.0, 1.0)
    subpixel: str | None = None

    @property
    def offset(self) -> tuple[float, float]:
        """What a shift between centres gains when measured between the first pixels."""
        (rows, cols), (m_rows, m_cols) = self.reference.shape, self.moving.shape
        return (rows - m_rows) / 2, (cols - m_cols) / 2


class Found(NamedTuple):
    """What a matcher answers.

    ``shift`` is None where the surface's quadratic peak is the answer; ``quality`` is
    None where `match` is to measure it.
    """

    surface: Surface
    shift: NDArray[np.float64] | None = None
    quality: float | None = None


class Matcher(Protocol):
    """A method: any function of a pair. Adding one is one file and one line in METHODS."""

    def __call__(self, pair: Pair, /) -> Found:
        """Score the shifts within ``pair.reach``."""
        ...


def reach_of(reference: Window, moving: Window, max_shift: float | None) -> tuple[float, float]:
    """Largest shift sought by rows and by columns, px.

    By default the search margin around the moving image plus a quarter of it. Beyond
    half the moving image a shift cannot be told from its alias.

    Raises
    ------
    InputError
        If the reference is the smaller one, or ``max_shift`` too small or too large.
    """
    margins = [(r - m) / 2 for r, m in zip(reference.shape, moving.shape, strict=True)]
    if min(margins) < 0:
        raise InputError(
            f"the reference {reference.shape} is smaller than the moving image {moving.shape}; "
            "crop the moving image or give a larger reference"
        )
    sides = moving.shape
    if max_shift is None:
        return margins[0] + sides[0] // 4, margins[1] + sides[1] // 4
    if not max_shift >= 1:
        raise InputError(f"max_shift {max_shift} px leaves nothing to search; give 1 or more")
    limits = [margin + (side - 1) // 2 for margin, side in zip(margins, sides, strict=True)]
    if max_shift > max(limits):
        raise InputError(
            f"max_shift {max_shift:g} px is beyond the {max(limits):g} px that a {sides} px image "
            f"in a {reference.shape} px reference can tell; lower it or give a larger reference"
        )
    return min(max_shift, limits[0]), min(max_shift, limits[1])


def template_of(pair: Pair) -> tuple[tuple[slice, slice], tuple[float, float]]:
    """The middle of the moving image that stays inside the reference for every shift sought.

    Returns its slices, and the shift that puts it at the reference's first pixel.
    """
    cuts = [max(0, int(np.ceil(r - o))) for r, o in zip(pair.reach, pair.offset, strict=True)]
    shape = [m - 2 * c for m, c in zip(pair.moving.shape, cuts, strict=True)]
    if min(shape) < SMALLEST:
        raise InputError(
            f"max_shift {max(pair.reach):g} px leaves no template of a {pair.moving.shape} px "
            "image; lower max_shift or give a larger reference"
        )
    slices = [slice(c, c + n) for c, n in zip(cuts, shape, strict=True)]
    origin = [-(r - n) / 2 for r, n in zip(pair.reference.shape, shape, strict=True)]
    return (slices[0], slices[1]), (origin[0], origin[1])
