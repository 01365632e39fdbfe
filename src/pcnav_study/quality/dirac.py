"""The Dirac-delta quality of a phase-correlation surface.

A perfect match gives a Dirac delta. The normalised cross-power spectrum Q of N pixels has
modulus 1 throughout, so by Parseval's theorem its surface r has unit energy,

    sum_x r(x)**2 = 1/N sum_w |Q(w)|**2 = 1,

and the cosine similarity of r with a delta at x is <r, delta> / (|r| |delta|) = r(x):
the height of the peak itself. A shift between pixels spreads the delta over its
neighbours; counted with them it is the root of the neighbourhood's share of the energy,
the cosine with the best delta spread over it.

The sector form (`matching.refine.delta_quality`): with a low-pass b >= 0 of unit sum, the
cosine in the inner product weighted by b is sum_w b(w) Re[Q(w) exp(i w x)]. Two suns may
flip whole angular sectors, so each sector's part counts with the sign that it has: the sum
of the sectors' absolute surfaces. `null` says what unrelated windows reach.
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


def null_level(
    candidates: int,
    *,
    radius: int = 1,
    false_match_rate: float = 0.01,
    whole: int | None = None,
) -> float:
    """Quality that unrelated windows exceed with probability ``false_match_rate``.

    Unrelated phases give a surface of independent normal values; the best of
    ``candidates`` neighbourhoods, each a chi-square of (2 radius + 1)**2 degrees of
    freedom, is bounded by the union of all.

    Parameters
    ----------
    candidates : int
        Shifts that the best was chosen from.
    radius : int
        As in `delta_similarity`.
    false_match_rate : float
        Share of unrelated pairs that may pass.
    whole : int, optional
        Pixels of the surface that the unit energy is spread over, if more were computed
        than are candidates.
    """
    cells = (2 * radius + 1) ** 2
    if candidates <= cells:
        return 1.0
    energy = chi2.isf(false_match_rate / candidates, cells) / (whole or candidates)
    return float(np.sqrt(min(energy, 1.0)))
