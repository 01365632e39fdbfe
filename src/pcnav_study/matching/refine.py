"""From a coarse shift to a sub-pixel one: read the signs, repair the spectrum, fit it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching.overlap import Overlap, overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.subpixel import ESTIMATORS, peak_of

SECTORS = 8
DEFAULT = "plane-fit"


def refined(pair: Pair, shift: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Sub-pixel shift near ``shift``, and the Dirac-delta quality there.

    Signs are read at the present shift and again at the better one; where that lies
    more than a pixel off, the overlap is cut anew around it.
    """
    overlap = overlap_of(pair, shift, SECTORS)
    if overlap is None:
        return shift, 0.0
    residual = peak_of(overlap, signed_weight(overlap, shift - overlap.whole))
    if np.abs(residual).max() > 0.75:
        moved = overlap_of(pair, overlap.whole + residual, SECTORS)
        if moved is not None:
            residual = residual + overlap.whole - moved.whole
            overlap = moved
    name = pair.subpixel or DEFAULT
    if name not in ESTIMATORS:
        raise InputError(f"subpixel {name!r} is unknown; use one of {', '.join(ESTIMATORS)}")
    residual = ESTIMATORS[name](overlap, signed_weight(overlap, residual))
    return overlap.whole + residual, delta_quality(overlap, residual)


def signed_weight(overlap: Overlap, residual: NDArray[np.float64]) -> NDArray[np.float32]:
    """Weight of every coefficient, with the sign of its sector at ``residual``."""
    band = overlap.band
    sums = _sector_sums(overlap, residual)
    counts = np.diff(np.append(band.first, band.index.size))
    signed: NDArray[np.float32] = band.weight * np.repeat(np.sign(sums), counts)
    return signed.astype(np.float32)


def delta_quality(overlap: Overlap, residual: NDArray[np.float64]) -> float:
    """Cosine similarity, 0 to 1, of the repaired surface with a Dirac delta at the shift.

    Both are seen through the same low-pass, so by Parseval's theorem it is the sum of
    the sectors' absolute surfaces there, whatever sign each has.
    """
    return float(min(np.abs(_sector_sums(overlap, residual)).sum(), 1.0))


def _sector_sums(overlap: Overlap, residual: NDArray[np.float64]) -> NDArray[np.float32]:
    """Surface of each sector at ``residual`` (row, column) px."""
    band = overlap.band
    turned = overlap.phasors * np.exp(1j * (residual.astype(np.float32) @ band.omega))
    sums: NDArray[np.float32] = np.add.reduceat(turned.real * band.weight, band.first)
    return sums
