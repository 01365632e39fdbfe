"""Where between the pixels the shift lies: three estimators on a sign-repaired spectrum.

Each takes an overlap's unit phasors, one weight per coefficient that carries its
sector's sign, and a first guess, and returns the residual shift (row, column) in px. The
phasor at angular frequency w of a residual d is exp(-i w . d), times the sign.

References
----------
.. [1] Guizar-Sicairos, Thurman, Fienup (2008), Optics Letters 33(2), 156-158.
.. [2] Hoge (2003), IEEE Trans. Medical Imaging 22(2), 299-302.
.. [3] Stone, Orchard, Chang, Martucci (2001), IEEE TGRS 39(10), 2235-2243.
.. [4] Leprince, Barbot, Ayoub, Avouac (2007), IEEE TGRS 45(6), 1529-1558.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.overlap import Overlap

Shift = NDArray[np.float64]
Estimator = Callable[[Overlap, NDArray[np.float32], Shift], Shift]
ROUNDS = 2  # of reweighting; a third moves the answer by under 0.002 px
LARGEST = 1.0  # px, how far an estimate may leave its first guess


def plane_fit(overlap: Overlap, weight: NDArray[np.float32], guess: Shift) -> Shift:
    """Weighted least squares on the phase plane, reweighted by the misfit [3]_ [4]_.

    The phase is taken about the present estimate, so it needs no unwrapping, and a
    coefficient counts by the fourth power of the cosine of half its misfit.
    """
    shift = guess
    rows, cols = (_powers(w) for w in (overlap.band.omega_rows, overlap.band.omega_cols))
    for _ in range(ROUNDS):
        turned = overlap.turned(shift)
        turned *= weight
        real, imaginary = turned.real.copy(), turned.imag.copy()
        size = np.abs(turned)
        counted = size + real
        counted *= counted
        np.divide(counted, np.maximum(size, np.float32(1e-12)), out=counted)
        normal = rows @ counted @ cols.T
        counted *= np.arctan2(imaginary, real)
        right = rows[:2] @ counted @ cols[:2].T
        shift = np.subtract(shift, _solved(normal, right))
    return np.clip(shift, guess - LARGEST, guess + LARGEST)


def upsampled_dft(
    overlap: Overlap, weight: NDArray[np.float32], guess: Shift, factor: int = 100
) -> Shift:
    """Peak of the surface evaluated every 1 / ``factor`` px by a matrix transform [1]_.

    First every tenth of a pixel, then every hundredth around the best.
    """
    shift = guess
    phasors = overlap.phasors * weight
    for reach, spacing in ((LARGEST, 0.1), (0.1, 1 / factor)):
        grid = np.arange(-reach, reach + spacing / 2, spacing)
        rows, cols = (
            np.exp(1j * np.outer(grid + centre, omega)).astype(np.complex64)
            for centre, omega in zip(shift, overlap.band[:2], strict=True)
        )
        surface = (rows @ phasors @ cols.T).real
        shift = shift + grid[np.array(np.unravel_index(surface.argmax(), surface.shape))]
    return shift


def svd_fit(overlap: Overlap, weight: NDArray[np.float32], guess: Shift) -> Shift:
    """Phase slopes of the two dominant singular vectors [2]_.

    A pure shift makes the spectrum a matrix of rank one, the product of a row and a
    column factor, each with a linear phase.
    """
    left, _, right = np.linalg.svd(overlap.turned(guess) * weight, full_matrices=False)
    slopes = [
        _slope(overlap.band.omega_rows, left[:, 0]),
        _slope(overlap.band.omega_cols, right[0]),
    ]
    return np.asarray(guess - np.clip(slopes, -LARGEST, LARGEST))


ESTIMATORS: dict[str, Estimator] = {
    "plane-fit": plane_fit,
    "upsampled-dft": upsampled_dft,
    "svd": svd_fit,
}


def _powers(omega: NDArray[np.float32]) -> NDArray[np.float32]:
    """(3, n): the powers 0, 1 and 2."""
    return np.stack([np.ones_like(omega), omega, omega * omega])


def _solved(normal: NDArray[np.floating[Any]], right: NDArray[np.floating[Any]]) -> Shift:
    """Slopes of a plane through the origin, from moments indexed by powers of omega.

    Zero where the coefficients do not determine both.
    """
    rows, cross, cols = float(normal[2, 0]), float(normal[1, 1]), float(normal[0, 2])
    y, x = float(right[1, 0]), float(right[0, 1])
    determinant = rows * cols - cross * cross
    if not determinant > 1e-9 * rows * cols:
        return np.zeros(2)
    return np.array([(cols * y - cross * x) / determinant, (rows * x - cross * y) / determinant])


def _slope(omega: NDArray[np.float32], vector: NDArray[np.complex64]) -> float:
    """Phase slope of a singular vector, by least squares weighted with its energy."""
    phase = np.unwrap(np.angle(vector).astype(np.float64))
    weight = np.abs(vector).astype(np.float64) ** 2
    centred = omega - weight @ omega / weight.sum()
    return float((weight * centred) @ phase / max((weight * centred) @ centred, 1e-30))
