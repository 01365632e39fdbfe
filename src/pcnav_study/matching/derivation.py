"""The theory of phase correlation under two suns, written plainly.

The matchers compute the same things faster; tests and walkthroughs hold them, and the
pictures, against this.

References
----------
.. [1] Kuglin and Hines (1975), Proc. IEEE Int. Conf. Cybernetics and Society, 163-165.
.. [2] Kube and Pentland (1988), IEEE Trans. PAMI 10(5), 703-707.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import fft

Array = NDArray[np.float64]


def cross_power_spectrum(reference: Array, moving: Array) -> NDArray[np.complex128]:
    """Normalised cross-power spectrum [1]_ of two equally large images, the whole plane.

    Of modulus 1, or 0 where either spectrum vanishes; frequencies as ``fft.fftfreq``.
    """
    product = fft.fft2(reference) * np.conj(fft.fft2(moving))
    modulus = np.abs(product)
    known = modulus > 1e-12 * modulus.max()
    quotient: NDArray[np.complex128] = np.where(known, product / np.where(known, modulus, 1), 0)
    return quotient


def fringes(shape: tuple[int, int], shift: tuple[float, float]) -> NDArray[np.complex128]:
    """exp(-i w . d): what a shift (row, column) alone makes of the cross-power spectrum."""
    f_rows, f_cols = fft.fftfreq(shape[0])[:, None], fft.fftfreq(shape[1])[None, :]
    wave: NDArray[np.complex128] = np.exp(-2j * np.pi * (f_rows * shift[0] + f_cols * shift[1]))
    return wave


def frequency_bearing(shape: tuple[int, int], pixel_size: tuple[float, float]) -> Array:
    """Direction on the ground of every frequency, degrees clockwise from north."""
    to_north = -fft.fftfreq(shape[0])[:, None] / pixel_size[0]
    to_east = fft.fftfreq(shape[1])[None, :] / pixel_size[1]
    bearing: Array = np.degrees(np.arctan2(to_east, to_north))
    return bearing


def sign_pattern(
    shape: tuple[int, int], azimuths: tuple[float, float], pixel_size: tuple[float, float]
) -> Array:
    """sgn[cos(theta - tau1) cos(theta - tau2)]: sectors of frequency that two suns reverse.

    In the linear regime a relief under the azimuth tau has the spectrum
    ``i w sin(zenith) cos(theta - tau)`` times that of its heights [2]_.
    """
    bearing = frequency_bearing(shape, pixel_size)
    one, other = (np.cos(np.radians(bearing - azimuth)) for azimuth in azimuths)
    pattern: Array = np.sign(one * other)
    return pattern


def expected_peak(azimuth_difference: float) -> float:
    """Height of the correlation at the true shift: 1 - 2 dtau / 180, dtau in degrees.

    The reversed share of all directions is dtau / 180; what is reversed counts against.
    """
    return 1.0 - 2.0 * azimuth_difference / 180.0
