"""One `match` for every method, and the table of methods.

To add a method, write a function of a `Pair` that returns a `Found` (its score of every
candidate shift, and a shift and a quality if it knows better ones) in a file of its own,
and give it a name in ``METHODS``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.mutual_information import mutual_information
from pcnav_study.matching.ncc import normalised_cross_correlation
from pcnav_study.matching.pair import Matcher, Pair, reach_of
from pcnav_study.matching.phase import (
    absolute_phase_correlation,
    phase_correlation,
    sun_phase_correlation,
)
from pcnav_study.matching.refine import quality_at, refined
from pcnav_study.matching.sectors import sector_phase_correlation
from pcnav_study.matching.ssd import squared_differences
from pcnav_study.matching.subpixel import ESTIMATORS
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window, prepare
from pcnav_study.scene.sun import SunPosition

METHODS: dict[str, Matcher] = {
    "pc-sectors": sector_phase_correlation,
    "pc": phase_correlation,
    "pc-abs": absolute_phase_correlation,
    "pc-solar": sun_phase_correlation,
    "ncc": normalised_cross_correlation,
    "mi": mutual_information,
    "ssd": squared_differences,
}


class MatchResult:
    """One match.

    Attributes
    ----------
    shift : (2,) float64
        (row, column) in px, to be applied to the moving image to register it with the
        reference; between the two centres if the reference is larger.
    quality : float
        Dirac-delta quality, 0 to 1: the cosine similarity of the phase-correlation
        surface with a Dirac delta at that shift. For ``pc`` and ``pc-abs`` of their own
        surface; otherwise after the sectors' signs are repaired, so that suns of any
        difference compare. Measured when first asked for, where the method has no need
        of it itself.
    surface : Surface
        The method's score of every candidate shift.
    method : str
        A name in ``METHODS``.
    """

    __slots__ = ("_pair", "_quality", "method", "shift", "surface")

    def __init__(
        self,
        shift: NDArray[np.float64],
        quality: float | None,
        surface: Surface,
        method: str,
        pair: Pair | None = None,
    ) -> None:
        self.shift = shift
        self.surface = surface
        self.method = method
        self._quality = quality
        self._pair = pair

    @property
    def quality(self) -> float:
        """Dirac-delta quality, 0 to 1."""
        if self._quality is None:
            self._quality = 0.0 if self._pair is None else quality_at(self._pair, self.shift)
            self._pair = None
        return self._quality

    def __reduce__(self) -> tuple[type[MatchResult], tuple[object, ...]]:
        """Pickle the answer, not the images."""
        return MatchResult, (self.shift, self.quality, self.surface, self.method)

    def __repr__(self) -> str:
        row, col = self.shift
        return (
            f"MatchResult({self.method}: shift=({row:.3f}, {col:.3f}), quality={self.quality:.3f})"
        )


def match(
    reference_image: ArrayLike | Window,
    moving_image: ArrayLike | Window,
    method: str = "pc-sectors",
    sun: tuple[SunPosition, SunPosition] | None = None,
    max_shift: float | None = None,
    *,
    pixel_size: tuple[float, float] = (1.0, 1.0),
    subpixel: str | None = None,
) -> MatchResult:
    """Shift that registers the moving image with the reference.

    Parameters
    ----------
    reference_image : (rows, columns) real array, or a Window from `prepare`
        As large as the moving image, or larger: a search area. NaN is no data.
    moving_image : (rows, columns) real array, or a Window
    method : str
        A name in ``METHODS``.
    sun : pair of SunPosition, optional
        Of the reference and of the moving image; only ``pc-solar`` uses them.
    max_shift : float, optional
        Largest shift sought along each axis, px. By default the search margin around the
        moving image plus a quarter of it.
    pixel_size : (dy, dx), optional
        Of both images, in any unit, for methods that use directions on the ground.
    subpixel : str, optional
        A name in ``subpixel.ESTIMATORS``, applied to whatever the method finds. Without
        it ``pc-sectors`` fits the phase plane, and the other methods take the summit of a
        quadratic through their surface.

    Raises
    ------
    InputError
        For an unknown method or estimator, or images that no method can match. An image
        that is merely empty (constant, or without a valid pixel) gives shift 0, quality 0.
    """
    matcher = METHODS.get(method)
    if matcher is None:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join(METHODS)}")
    if subpixel is not None and subpixel not in ESTIMATORS:
        raise InputError(f"subpixel {subpixel!r} is unknown; use one of {', '.join(ESTIMATORS)}")
    reference, moving = prepare(reference_image, "reference"), prepare(moving_image, "moving")
    reach = reach_of(reference, moving, max_shift)
    if reference.is_empty or moving.is_empty:
        return MatchResult(np.zeros(2), 0.0, Surface(np.zeros((1, 1)), (0.0, 0.0)), method)
    pair = Pair(reference, moving, reach, sun, pixel_size, subpixel)
    surface, shift, quality = matcher(pair)
    if shift is None:
        shift = surface.best_shift()
        if subpixel is not None:
            shift, _ = refined(pair, shift)
    return MatchResult(shift, quality, surface, method, pair if quality is None else None)
