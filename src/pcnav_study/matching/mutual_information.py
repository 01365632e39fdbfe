"""Mutual information of a roaming template: exhaustive and exact, by FFT [1]_.

The joint histogram of template and reference at every place is a set of
cross-correlations, one for each pair of grey levels.

References
----------
.. [1] Viola and Wells (1997), Int. J. Computer Vision 24(2), 137-154.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.special import xlogy

from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Image, template_of

LEVELS = 16


def mutual_information(
    reference: Image, moving: Image, max_shift: float, *, levels: int = LEVELS
) -> Surface:
    """Mutual information in nats of the template at every place in the reference."""
    template, origin = template_of(reference, moving, max_shift)
    shape = (reference.shape[0], reference.shape[1])
    rows, cols = (r - t + 1 for r, t in zip(reference.shape, template.shape, strict=True))
    in_reference = fft.rfft2(_indicators(quantised(reference, levels), levels), shape)
    in_template = np.conj(fft.rfft2(_indicators(quantised(template, levels), levels), shape))
    joint_entropy = np.zeros((rows, cols))
    reference_counts = np.zeros((levels, rows, cols))
    template_counts = np.zeros(levels)
    for b in range(levels):
        counts = np.rint(fft.irfft2(in_reference * in_template[b], shape)[:, :rows, :cols])
        joint_entropy -= xlogy(counts, counts).sum(axis=0)
        reference_counts += counts
        template_counts[b] = counts[:, 0, 0].sum()
    n = template.size
    own = xlogy(reference_counts, reference_counts).sum(axis=0)
    fixed = xlogy(template_counts, template_counts).sum()
    return Surface(np.log(n) - (joint_entropy + own + fixed) / n, origin)


def quantised(image: Image, levels: int) -> NDArray[np.intp]:
    """Grey levels 0 to ``levels`` - 1, equally wide between the extremes."""
    low, high = float(image.min()), float(image.max())
    if high <= low:
        return np.zeros(image.shape, np.intp)
    level: NDArray[np.intp] = ((image - low) / (high - low) * levels).astype(np.intp)
    return np.asarray(np.minimum(level, levels - 1), np.intp)


def _indicators(image: NDArray[np.intp], levels: int) -> NDArray[np.float64]:
    """(levels, rows, columns): 1 where the image has that level."""
    here: NDArray[np.bool_] = image[None] == np.arange(levels)[:, None, None]
    return here.astype(np.float64)
