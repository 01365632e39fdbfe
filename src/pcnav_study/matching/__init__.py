"""Where the moving image lies on the reference: one ``match`` for every method."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.pair import Found, Matcher, Pair, reach_of
from pcnav_study.matching.phase import (
    absolute_phase_correlation,
    phase_correlation,
    sun_phase_correlation,
)
from pcnav_study.matching.refine import refined
from pcnav_study.matching.sectors import sector_phase_correlation
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window, prepare
from pcnav_study.scene.sun import SunPosition

METHODS: dict[str, Matcher] = {
    "pc-sectors": sector_phase_correlation,
    "pc": phase_correlation,
    "pc-abs": absolute_phase_correlation,
    "pc-solar": sun_phase_correlation,
}


@dataclass(frozen=True, slots=True)
class MatchResult:
    """One match."""

    shift: NDArray[np.float64]
    quality: float
    surface: Surface
    method: str


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
    """Shift."""
    matcher = METHODS.get(method)
    if matcher is None:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join(METHODS)}")
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
    if quality is None:
        quality = refined(pair, shift)[1]
    return MatchResult(shift, quality, surface, method)


__all__ = ["METHODS", "Found", "MatchResult", "Matcher", "Pair", "Surface", "Window", "match", "prepare"]
