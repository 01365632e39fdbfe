"""Normalised cross-correlation of a roaming template, by FFT and running sums [1]_ [2]_.

References
----------
.. [1] Lewis (1995), Vision Interface 95, 120-123.
.. [2] Padfield (2012), IEEE Trans. Image Processing 21(5), 2706-2718: with masks.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.template import SHARE, Roaming, filled

FLAT = 1e-10  # share of the largest variance below which a placement is constant


def normalised_cross_correlation(pair: Pair) -> Found:
    """Correlation coefficient, -1 to 1, of the template at every place in the reference.

    Places where the reference is constant, or with too few valid pixels, score zero.
    """
    roaming = Roaming(pair)
    values = _masked(roaming) if roaming.masked else _unmasked(roaming)
    return Found(roaming.surface(values))


def _unmasked(roaming: Roaming) -> NDArray[Any]:
    reference = roaming.pair.reference
    spectrum, inverse = reference.kept(("ncc", roaming.shape), lambda: _reference_part(roaming))
    template = roaming.pair.moving.centred()[roaming.cut]
    template = template - np.add.reduce(template, axis=None) / np.float32(template.size)
    energy = float(np.vdot(template, template))
    if energy == 0:
        return np.zeros(roaming.size)
    score = roaming.correlated(spectrum, roaming.forward(template))
    inverse = inverse * np.float32(energy**-0.5)
    inverse *= score
    np.minimum(inverse, 1.0, out=inverse)
    return np.maximum(inverse, -1.0, out=inverse)


def _reference_part(roaming: Roaming) -> tuple[NDArray[Any], NDArray[np.float32]]:
    """Spectrum, and one over the standard deviation's share of every placement's norm."""
    centred = roaming.pair.reference.centred()
    level = centred.astype(np.float64)
    count = roaming.shape[0] * roaming.shape[1]
    variance = roaming.running_sum(level**2) - roaming.running_sum(level) ** 2 / count
    flat = variance <= FLAT * max(float(variance.max()), 1e-300)
    inverse = np.where(flat, 0.0, 1 / np.sqrt(np.where(flat, 1.0, variance)))
    return roaming.forward(centred), inverse.astype(np.float32)


def _masked(roaming: Roaming) -> NDArray[np.float64]:
    """The same over the pixels valid in both [2]_."""
    image, here = filled(roaming.pair.reference)
    template, there = filled(roaming.pair.moving, roaming.cut)
    ours = roaming.forward(np.stack([image, image**2, here]))
    theirs = roaming.forward(np.stack([template, template**2, there]))

    def total(one: int, other: int) -> NDArray[np.float64]:
        return np.asarray(roaming.correlated(ours[one], theirs[other]))

    count = np.rint(total(2, 2))
    usable = count >= max(SHARE * float(count.max()), 2)
    n = np.where(usable, count, 1.0)
    sum_one, sum_other = total(0, 2), total(2, 0)
    covariance = total(0, 0) - sum_one * sum_other / n
    variances = (total(1, 2) - sum_one**2 / n, total(2, 1) - sum_other**2 / n)
    for variance in variances:
        usable &= variance > FLAT * max(float(variance[usable].max(initial=0.0)), 1e-300)
    norm = np.sqrt(np.where(usable, variances[0] * variances[1], 1.0))
    return np.asarray(np.where(usable, np.clip(covariance / norm, -1.0, 1.0), 0.0))
