"""Mutual information of a roaming template: exhaustive and exact, by FFT [1]_.

The joint histogram of template and reference at every place is a set of
cross-correlations, one for each pair of grey levels. Counts are whole numbers, so single
precision, rounded, is exact.

References
----------
.. [1] Viola and Wells (1997), Int. J. Computer Vision 24(2), 137-154.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.template import SHARE, Roaming
from pcnav_study.matching.windows import Real

LEVELS = 16


def mutual_information(pair: Pair, levels: int = LEVELS) -> Found:
    """Mutual information in nats of the template at every place in the reference.

    Only pixels valid in both count. Places with too few of them score zero.
    """
    roaming = Roaming(pair)
    reference = pair.reference
    ours = reference.kept(
        ("mi", roaming.fft_shape, levels),
        lambda: roaming.forward(indicators(reference.values, levels)),
    )
    theirs = roaming.forward(indicators(pair.moving.values[roaming.cut], levels))
    table = _n_log_n(roaming.shape[0] * roaming.shape[1])
    joint = np.zeros(roaming.size)
    reference_counts = np.zeros((levels, *roaming.size), np.int32)
    template_part = np.zeros(roaming.size)
    total = np.zeros(roaming.size, np.int32)
    for b in range(levels):
        counts = np.rint(roaming.correlated(ours, theirs[b])).astype(np.int32)
        joint += table[counts].sum(axis=0)
        reference_counts += counts
        there = counts.sum(axis=0)
        template_part += table[there]
        total += there
    usable = total >= max(SHARE * float(total.max()), 2)
    n = np.where(usable, total, 1)
    nats = np.log(n) + (joint - table[reference_counts].sum(axis=0) - template_part) / n
    return Found(roaming.surface(np.where(usable, np.maximum(nats, 0.0), 0.0)))


def quantised(image: Real, levels: int) -> NDArray[np.intp]:
    """Grey levels 0 to ``levels`` - 1, equally wide between the extremes; -1 where missing."""
    valid = np.isfinite(image)
    level = np.where(valid, 0, -1).astype(np.intp)
    if not valid.any():
        return level
    inside = image[valid].astype(np.float64)
    low, high = float(inside.min()), float(inside.max())
    if high > low:
        level[valid] = np.minimum((inside - low) / (high - low) * levels, levels - 1).astype(
            np.intp
        )
    return level


def indicators(image: Real, levels: int) -> NDArray[np.float32]:
    """(levels, rows, columns): 1 where the image has that level."""
    here: NDArray[Any] = quantised(image, levels)[None] == np.arange(levels)[:, None, None]
    return here.astype(np.float32)


def _n_log_n(largest: int) -> NDArray[np.float64]:
    """n log n for n from 0 to ``largest``."""
    n = np.arange(largest + 1, dtype=np.float64)
    table: NDArray[np.float64] = n * np.log(np.maximum(n, 1.0))
    return table
