"""Where the moving image lies on the reference: one ``match`` for every method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.mutual_information import mutual_information
from pcnav_study.matching.ncc import normalised_cross_correlation
from pcnav_study.matching.phase import phase_correlation
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Image, as_image, default_max_shift
from pcnav_study.quality.dirac import delta_similarity
from pcnav_study.scene.sun import SunPosition

METHODS: dict[str, Callable[[Image, Image, float], Surface]] = {
    "pc": phase_correlation,
    "ncc": normalised_cross_correlation,
    "mi": mutual_information,
}


@dataclass(frozen=True)
class MatchResult:
    """One match.

    Parameters
    ----------
    shift : (2,) float64
        (row, column) in px, to be applied to the moving image to register it with the
        reference; between the two centres if the reference is larger.
    quality : float
        Dirac-delta quality, 0 to 1, of the phase correlation at that shift.
    surface : Surface
        The method's score of every candidate shift.
    method : str
        A name in ``METHODS``.
    """

    shift: NDArray[np.float64]
    quality: float
    surface: Surface
    method: str


def match(
    reference_image: ArrayLike,
    moving_image: ArrayLike,
    method: str = "pc",
    sun: tuple[SunPosition, SunPosition] | None = None,
    max_shift: float | None = None,
) -> MatchResult:
    """Shift that registers the moving image with the reference.

    Parameters
    ----------
    reference_image : (rows, columns) real array
        As large as the moving image, or larger: a search area. NaN is no data.
    moving_image : (rows, columns) real array
    method : str
        A name in ``METHODS``.
    sun : pair of SunPosition, optional
        Of the reference and of the moving image, for methods that can use them.
    max_shift : float, optional
        Largest shift sought, px. By default the search margin around the moving image
        plus a quarter of its shorter side.

    Raises
    ------
    InputError
        For an unknown method, or images that no method can match.
    """
    if method not in METHODS:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join(METHODS)}")
    reference, moving = as_image(reference_image, "reference"), as_image(moving_image, "moving")
    if any(r < m for r, m in zip(reference.shape, moving.shape, strict=True)):
        raise InputError(
            f"the reference {reference.shape} is smaller than the moving image {moving.shape}; "
            "crop the moving image or give a larger reference"
        )
    reach = default_max_shift(reference, moving) if max_shift is None else float(max_shift)
    if not reach >= 1:
        raise InputError(f"max_shift {max_shift} px leaves nothing to search; give 1 or more")
    if np.ptp(reference) == 0 or np.ptp(moving) == 0:
        empty = Surface(np.zeros((1, 1)), (0.0, 0.0))
        return MatchResult(np.zeros(2), 0.0, empty, method)
    surface = METHODS[method](reference, moving, reach)
    shift = surface.best_shift()
    phase = surface if method == "pc" else phase_correlation(reference, moving, reach)
    return MatchResult(shift, delta_similarity(phase.values, phase.at(shift)), surface, method)


__all__ = ["METHODS", "MatchResult", "Surface", "match"]
