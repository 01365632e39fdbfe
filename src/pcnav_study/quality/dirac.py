"""The Dirac-delta quality of a phase-correlation surface.

A perfect match gives a Dirac delta. Where the cross-power spectrum has modulus 1
throughout, Parseval's theorem gives the surface unit energy, so the cosine similarity
with a delta at the peak is the peak's height itself. A shift between pixels spreads the
delta over its neighbours; their energy is therefore counted with it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2


def delta_similarity(
    surface: NDArray[np.floating], peak: tuple[int, int], *, radius: int = 1
) -> float:
    """Cosine similarity, 0 to 1, of a surface with a delta spread over a neighbourhood.

    Parameters
    ----------
    surface : (rows, columns)
        Phase correlation, in any scale; NaN counts as zero.
    peak : (row, column)
        Index of the shift in question.
    radius : int
        Half width of the square neighbourhood, px.
    """
    energy = np.nan_to_num(np.asarray(surface, np.float64)) ** 2
    total = float(energy.sum())
    if total == 0:
        return 0.0
    row, col = peak
    near = energy[max(row - radius, 0) : row + radius + 1, max(col - radius, 0) : col + radius + 1]
    return float(np.sqrt(min(float(near.sum()) / total, 1.0)))


def null_level(candidates: int, *, radius: int = 1, false_match_rate: float = 0.01) -> float:
    """Quality that unrelated windows exceed with probability ``false_match_rate``.

    Unrelated phases give a surface of independent normal values; the best of
    ``candidates`` neighbourhoods, each a chi-square of (2 radius + 1)**2 degrees of
    freedom, is bounded by the union of all.
    """
    cells = (2 * radius + 1) ** 2
    if candidates <= cells:
        return 1.0
    return float(np.sqrt(min(chi2.isf(false_match_rate / candidates, cells) / candidates, 1.0)))
