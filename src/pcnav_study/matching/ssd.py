"""Sum of squared differences of a roaming template, by FFT and running sums [1]_.

References
----------
.. [1] Barnea and Silverman (1972), IEEE Trans. Computers C-21(2), 179-186.
"""

from __future__ import annotations

import numpy as np

from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.template import SHARE, Roaming, filled


def squared_differences(pair: Pair) -> Found:
    """Minus the mean squared difference over the valid pixels, at every place.

    Only the differences that the two means make are taken out: contrast must agree.
    Places with too few valid pixels score the worst of all.
    """
    roaming = Roaming(pair)
    image, here = filled(pair.reference)
    template, there = filled(pair.moving, roaming.cut)
    ours = roaming.forward(np.stack([image, image**2, here]))
    theirs = roaming.forward(np.stack([template, template**2, there]))
    count = np.rint(roaming.correlated(ours[2], theirs[2]))
    usable = count >= max(SHARE * float(count.max()), 2)
    squares = (
        roaming.correlated(ours[1], theirs[2])
        - 2 * roaming.correlated(ours[0], theirs[0])
        + roaming.correlated(ours[2], theirs[1])
    )
    mean = np.maximum(squares, 0.0) / np.where(usable, count, 1.0)
    return Found(roaming.surface(-np.where(usable, mean, mean[usable].max(initial=0.0))))
