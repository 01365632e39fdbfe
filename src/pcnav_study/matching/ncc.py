"""Normalised cross-correlation of a roaming template, by FFT and running sums [1]_.

References
----------
.. [1] Lewis (1995), Vision Interface 95, 120-123.
"""

from __future__ import annotations

import numpy as np
from scipy import fft

from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Image, template_of


def normalised_cross_correlation(reference: Image, moving: Image, max_shift: float) -> Surface:
    """Correlation coefficient, -1 to 1, of the template at every place in the reference.

    Places where the reference is constant score zero.
    """
    template, origin = template_of(reference, moving, max_shift)
    centred = template - template.mean()
    level = reference - reference.mean()
    shape = (reference.shape[0], reference.shape[1])
    spectrum = fft.rfft2(level, shape) * np.conj(fft.rfft2(centred, shape))
    rows, cols = (r - t + 1 for r, t in zip(reference.shape, template.shape, strict=True))
    product = fft.irfft2(spectrum, shape)[:rows, :cols]
    count = template.size
    variance = (
        _running_sum(level**2, template.shape) - _running_sum(level, template.shape) ** 2 / count
    )
    energy = variance * (centred**2).sum()
    flat = energy <= 1e-12 * max(float(energy.max()), np.finfo(float).tiny)
    score = np.where(flat, 0.0, product / np.sqrt(np.where(flat, 1.0, energy)))
    return Surface(np.clip(score, -1.0, 1.0), origin)


def _running_sum(image: Image, shape: tuple[int, ...]) -> Image:
    """Sums over every window of ``shape`` that fits."""
    total = np.pad(image.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    rows, cols = shape
    summed: Image = (
        total[rows:, cols:] - total[:-rows, cols:] - total[rows:, :-cols] + total[:-rows, :-cols]
    )
    return summed
