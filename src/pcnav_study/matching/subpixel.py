"""Where between the pixels the shift lies: three estimators on a sign-repaired spectrum.

Each takes the unit phasors of an overlap and one weight per coefficient that carries
the sector's sign, and returns the residual shift (row, column) in px. The phasor at
angular frequency w of a residual d is exp(-i w . d), times the sign.

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
Estimator = Callable[[Overlap, NDArray[np.float32]], Shift]
LARGEST = 1.5  # px, a residual beyond it belongs to another whole pixel


def plane_fit(overlap: Overlap, weight: NDArray[np.float32]) -> Shift:
    """Weighted least squares on the phase plane, reweighted by the misfit [3]_ [4]_.

    The phase is taken about the present estimate, so it needs no unwrapping, and a
    coefficient counts by (1 + cos(misfit)) / 2, squared.
    """
    omega = overlap.band.omega
    sign, size = np.sign(weight), np.abs(weight)
    phasors = overlap.phasors * sign
    shift = peak_of(overlap, weight)
    for _ in range(2):
        turned = phasors * np.exp(1j * (shift.astype(np.float32) @ omega))
        counted = size * (0.5 + 0.5 * turned.real) ** 2
        shift = shift - _solve(omega * counted, omega, np.arctan2(turned.imag, turned.real))
    return np.clip(shift, -LARGEST, LARGEST)


def peak_of(overlap: Overlap, weight: NDArray[np.float32], rounds: int = 3) -> Shift:
    """The summit of the phase-correlation surface, by Newton's method from zero shift."""
    omega = overlap.band.omega
    shift = np.zeros(2)
    for _ in range(rounds):
        turned = weight * overlap.phasors * np.exp(1j * (shift.astype(np.float32) @ omega))
        step = _solve(omega * np.maximum(turned.real, 0), omega, None, turned.imag)
        shift = np.clip(shift - np.clip(step, -0.7, 0.7), -LARGEST, LARGEST)
    return shift


def upsampled_dft(overlap: Overlap, weight: NDArray[np.float32], factor: int = 100) -> Shift:
    """Peak of the surface evaluated every 1 / ``factor`` px by a matrix transform [1]_.

    First every tenth of a pixel, then every hundredth around the best.
    """
    shift = np.zeros(2)
    for reach, spacing in ((LARGEST, 0.1), (0.1, 1 / factor)):
        grid = np.arange(-reach, reach + spacing / 2, spacing)
        rows, cols = (
            np.exp(1j * np.outer(grid + centre, omega))
            for centre, omega in zip(shift, overlap.band.omega, strict=True)
        )
        surface = ((rows * (weight * overlap.phasors)) @ cols.T).real
        best = np.unravel_index(surface.argmax(), surface.shape)
        shift = shift + grid[np.array(best)]
    return shift


def svd_fit(overlap: Overlap, weight: NDArray[np.float32]) -> Shift:
    """Slopes of the two dominant singular vectors' phases [2]_.

    A pure shift makes the spectrum a matrix of rank one, a product of a row and a
    column factor, each with a linear phase.
    """
    omega = np.round(overlap.band.omega, 6)
    values, cells = zip(*(np.unique(axis, return_inverse=True) for axis in omega), strict=True)
    matrix = np.zeros((values[0].size, values[1].size), np.complex128)
    matrix[cells[0], cells[1]] = weight * overlap.phasors
    left, _, right = np.linalg.svd(matrix, full_matrices=False)
    return np.clip(
        [-_slope(values[0], left[:, 0]), -_slope(values[1], right[0])], -LARGEST, LARGEST
    )


ESTIMATORS: dict[str, Estimator] = {
    "plane-fit": plane_fit,
    "upsampled-dft": upsampled_dft,
    "svd": svd_fit,
}


def _solve(
    weighted: NDArray[Any],
    omega: NDArray[np.float32],
    phase: NDArray[Any] | None,
    already_weighted: NDArray[Any] | None = None,
) -> Shift:
    """Least-squares d of ``phase = -omega . d``, negated; zero where it is not determined."""
    (a, b), (_, d) = (weighted @ omega.T).tolist()
    right = weighted @ phase if already_weighted is None else omega @ already_weighted
    y, x = (-right).tolist()
    determinant = a * d - b * b
    if not determinant > 1e-12 * a * d:
        return np.zeros(2)
    return -np.array([(d * y - b * x) / determinant, (a * x - b * y) / determinant])


def _slope(omega: NDArray[np.float64], vector: NDArray[np.complex128]) -> float:
    """Phase slope of a singular vector, by least squares weighted with its modulus."""
    phase = np.unwrap(np.angle(vector))
    weight = np.abs(vector) ** 2
    weight /= weight.sum()
    centred = omega - weight @ omega
    return float((weight * centred) @ phase / max((weight * centred) @ centred, 1e-30))
