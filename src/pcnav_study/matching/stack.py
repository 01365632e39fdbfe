"""Many pairs at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.methods import match
from pcnav_study.matching.windows import Window, prepare
from pcnav_study.scene.sun import SunPosition


class StackResult(NamedTuple):
    """Shifts (n, 2) in px, as of `match`, and qualities (n,)."""

    shifts: NDArray[np.float64]
    qualities: NDArray[np.float64]


def match_stack(
    references: ArrayLike | Window | Sequence[ArrayLike | Window],
    movings: Sequence[ArrayLike | Window] | NDArray[np.floating],
    method: str = "pc-sectors",
    sun: tuple[SunPosition, SunPosition] | None = None,
    max_shift: float | None = None,
    *,
    pixel_size: tuple[float, float] = (1.0, 1.0),
    subpixel: str | None = None,
) -> StackResult:
    """`match` of every moving image with its reference, or with one reference for all.

    Parameters
    ----------
    references : one image (rows, columns), or a stack or sequence of n
        A single reference is transformed once.
    movings : stack (n, rows, columns), or sequence of n images

    Raises
    ------
    InputError
        If there are neither one nor n references, or as `match`.
    """
    if isinstance(references, Window):
        ours: list[Window] = [references]
    elif isinstance(references, list | tuple):
        ours = [prepare(image, "reference") for image in references]
    else:
        array = np.asarray(references)
        ours = [prepare(image, "reference") for image in (array if array.ndim == 3 else [array])]
    if len(ours) not in (1, len(movings)):
        raise InputError(
            f"{len(ours)} references do not fit {len(movings)} moving images; give one, or as many"
        )
    shifts, qualities = np.zeros((len(movings), 2)), np.zeros(len(movings))
    for k, moving in enumerate(movings):
        result = match(
            ours[k if len(ours) > 1 else 0],
            moving,
            method,
            sun,
            max_shift,
            pixel_size=pixel_size,
            subpixel=subpixel,
        )
        shifts[k], qualities[k] = result.shift, result.quality
    return StackResult(shifts, qualities)
