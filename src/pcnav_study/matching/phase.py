"""Phase correlation: the shift theorem read backwards [1]_.

An image displaced by d has the spectrum of the original times exp(-i w . d). The
normalised cross-power spectrum keeps only that factor, and its inverse transform is a
Dirac delta at the shift.

References
----------
.. [1] Kuglin and Hines (1975), Proc. IEEE Int. Conf. Cybernetics and Society, 163-165.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Image, embedded, tapered


def cross_power(reference: Image, moving: Image) -> NDArray[np.complex128]:
    """Normalised cross-power spectrum (rows, columns // 2 + 1) of two equally large images.

    Every coefficient has modulus 1, or 0 where either spectrum vanishes.
    """
    product = fft.rfft2(reference) * np.conj(fft.rfft2(moving))
    modulus = np.abs(product)
    tiny = np.finfo(float).eps * max(float(modulus.max()), np.finfo(float).tiny)
    quotient: NDArray[np.complex128] = np.where(
        modulus > tiny, product / np.maximum(modulus, tiny), 0.0
    )
    return quotient


def phase_correlation(reference: Image, moving: Image, max_shift: float) -> Surface:
    """Signed phase-correlation surface within ``max_shift`` px of zero shift.

    The reference may be larger than the moving image; it is then a search area.
    """
    shape = reference.shape
    faded, offset = embedded(tapered(moving), (shape[0], shape[1]))
    correlation = fft.irfft2(cross_power(tapered(reference), faded), shape)
    reach = [min(int(max_shift), (n - 1) // 2) for n in shape]
    rows, cols = (np.arange(-m, m + 1) for m in reach)
    return Surface(
        correlation[np.ix_(rows, cols)],
        (-reach[0] - float(offset[0]), -reach[1] - float(offset[1])),
    )
