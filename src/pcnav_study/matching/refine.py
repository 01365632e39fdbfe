"""From a coarse shift to a sub-pixel one: read the signs, repair the spectrum, fit it.

Both windows are first cropped to their overlap. The energy of the light patterns, pixel by
pixel, finds the summit there; at the summit each sector's sign is read off.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.overlap import Overlap, overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.subpixel import ESTIMATORS
from pcnav_study.matching.surface import quadratic_peak

DEFAULT = "plane-fit"
IMPLAUSIBLE = 0.5  # share left out of the energy of a pair reversed as a whole


def refined(
    pair: Pair, shift: NDArray[np.float64], around: int = 2
) -> tuple[NDArray[np.float64], float]:
    """Sub-pixel shift within ``around`` px of ``shift``, and the Dirac-delta quality there.

    Where the summit lies more than 1.5 px off, the overlap is cut anew around it.
    """
    overlap = overlap_of(pair, shift)
    if overlap is None:
        return shift, 0.0
    residual, sectors = summit(overlap, around)
    if np.abs(residual).max() > 1.5:
        moved = overlap_of(pair, overlap.whole + residual)
        if moved is not None:
            overlap = moved
            residual, sectors = summit(overlap, 1)
    bank = overlap.band.bank
    signed = (np.sign(sectors) @ bank.reshape(len(bank), -1)).reshape(bank.shape[1:])
    signed *= overlap.band.sharper
    residual = ESTIMATORS[pair.subpixel or DEFAULT](overlap, signed, residual)
    return overlap.whole + residual, delta_quality(overlap, residual)


def summit(overlap: Overlap, around: int) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """The highest energy of the light patterns within ``around`` px.

    Returns
    -------
    residual : (row, column), px
    sectors : (sectors,)
        Every sector's surface at the nearest whole pixel.
    """
    rows, cols = (
        _waves(omega.size, float(omega[-1]), bool(omega[0] < 0), around)
        for omega in overlap.band[:2]
    )
    surfaces = np.matmul(np.matmul(rows, overlap.band.patterns * overlap.phasors), cols.T).real
    total = plausible_energy(surfaces)
    row, col = divmod(int(total.argmax()), total.shape[1])
    whole = np.array([row - around, col - around], float)
    return whole + quadratic_peak(total, (row, col)), overlap.sector_sums(whole)


def energy(surfaces: NDArray[np.float32]) -> NDArray[np.float32]:
    """Sum over the light patterns (patterns, rows, columns) of the squared surface.

    Half a wave, some 2 px, beside the true shift sectors turn their sign one by one; only at
    the shift do their heights follow the light.
    """
    squared = surfaces * surfaces
    total: NDArray[np.float32] = squared.sum(axis=0)
    return total


def plausible_energy(surfaces: NDArray[np.float32]) -> NDArray[np.float32]:
    """The energy, less half of what is reversed in all directions alike.

    That needs suns almost opposite; half a wave beside the shift of a pair that nothing
    reverses, it is common.
    """
    total = energy(surfaces)
    constant = surfaces[0]
    wave = np.sqrt(total - constant * constant)
    reversed_alike = np.maximum(-constant - wave, 0)
    total -= np.float32(IMPLAUSIBLE) * reversed_alike * reversed_alike
    return total


def quality_at(pair: Pair, shift: NDArray[np.float64]) -> float:
    """The Dirac-delta quality of a shift found by any method."""
    overlap = overlap_of(pair, shift)
    return 0.0 if overlap is None else delta_quality(overlap, shift - overlap.whole)


def delta_quality(overlap: Overlap, residual: NDArray[np.float64]) -> float:
    """Cosine similarity, 0 to 1, of the repaired surface with a Dirac delta at the shift.

    Both are seen through the same low-pass, so by Parseval's theorem it is the sum of
    the sectors' absolute surfaces there, whatever sign each has.
    """
    return min(float(np.abs(overlap.sector_sums(residual)).sum()), 1.0)


@lru_cache(maxsize=256)
def _waves(size: int, highest: float, two_sided: bool, around: int) -> NDArray[np.complex64]:
    """exp(i w x), (2 around + 1, size), for every pixel x up to ``around`` away."""
    omega = np.linspace(-highest if two_sided else 0.0, highest, size)
    waves: NDArray[np.complex64] = np.exp(
        1j * np.outer(np.arange(-around, around + 1), omega)
    ).astype(np.complex64)
    return waves
