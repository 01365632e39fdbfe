"""The template methods as the paper describes them: one window pair after the other.

Nothing is shared between neighbouring placements. These exist for the paper's claim on
speed and as an independent truth of the fast forms; ``METHODS`` does not list them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.mutual_information import LEVELS, quantised
from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.template import Roaming

Score = Callable[[NDArray[Any], NDArray[Any]], float]


def roaming_ncc(pair: Pair) -> Found:
    """Correlation coefficient of every window pair in turn."""
    return _roam(pair, _coefficient, pair.reference.values, pair.moving.values)


def roaming_ssd(pair: Pair) -> Found:
    """Minus the mean squared difference of every window pair in turn."""
    reference = pair.reference.values - np.nanmean(pair.reference.values)
    cut = Roaming(pair).cut
    moving = pair.moving.values - np.nanmean(pair.moving.values[cut])
    return _roam(pair, _minus_squares, reference, moving)


def roaming_mi(pair: Pair, levels: int = LEVELS) -> Found:
    """Mutual information in nats of every window pair in turn."""
    moving = np.full(pair.moving.shape, -1, np.intp)
    cut = Roaming(pair).cut
    moving[cut] = quantised(pair.moving.values[cut], levels)

    def score(one: NDArray[Any], other: NDArray[Any]) -> float:
        return information(one, other, levels)

    return _roam(pair, score, quantised(pair.reference.values, levels), moving)


def information(one: NDArray[Any], other: NDArray[Any], levels: int) -> float:
    """Mutual information in nats of two arrays of grey levels; negative levels are missing."""
    both = (one >= 0) & (other >= 0)
    cells = np.bincount(one[both] * levels + other[both], minlength=levels**2)
    joint = cells.reshape(levels, levels) / max(int(both.sum()), 1)
    apart = np.outer(joint.sum(axis=1), joint.sum(axis=0))
    some = joint > 0
    return float((joint[some] * np.log(joint[some] / apart[some])).sum())


def _roam(pair: Pair, score: Score, reference: NDArray[Any], moving: NDArray[Any]) -> Found:
    """Score of the template at every placement."""
    roaming = Roaming(pair)
    template = moving[roaming.cut]
    rows, cols = roaming.shape
    values = np.zeros(roaming.size)
    for row in range(roaming.size[0]):
        for col in range(roaming.size[1]):
            values[row, col] = score(reference[row : row + rows, col : col + cols], template)
    return Found(roaming.surface(values))


def _coefficient(one: NDArray[Any], other: NDArray[Any]) -> float:
    both = np.isfinite(one) & np.isfinite(other)
    a, b = one[both].astype(np.float64), other[both].astype(np.float64)
    if a.size < 2:
        return 0.0
    a, b = a - a.mean(), b - b.mean()
    norm = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / norm if norm > 0 else 0.0


def _minus_squares(one: NDArray[Any], other: NDArray[Any]) -> float:
    difference = (one - other)[np.isfinite(one) & np.isfinite(other)]
    return -float(np.mean(difference**2)) if difference.size else -np.inf
