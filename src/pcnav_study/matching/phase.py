"""Phase correlation: the shift theorem read backwards [1]_.

An image displaced by d has the spectrum of the original times exp(-i w . d). The
normalised cross-power spectrum keeps only that factor, and its inverse transform is a
Dirac delta at the shift.

In the linear regime of shading a relief seen under the sun azimuth tau has the spectrum
``i w sin(zenith) cos(theta - tau)`` times that of the heights [2]_, so two suns multiply
the factor by ``sgn[cos(theta - tau1) cos(theta - tau2)]``: known suns give the sign.

References
----------
.. [1] Kuglin and Hines (1975), Proc. IEEE Int. Conf. Cybernetics and Society, 163-165.
.. [2] Kube and Pentland (1988), IEEE Trans. PAMI 10(5), 703-707.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, floor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window

SUN_BAND = 0.2  # cycles/px, the low-pass of `sun_phase_correlation`


class Search(NamedTuple):
    """The candidates of one pair: ``size`` shifts from ``start``, ``step`` px apart.

    ``start`` is measured between first pixels; ``shape`` is the transform's.
    """

    shape: tuple[int, int]
    step: int
    start: tuple[int, int]
    size: tuple[int, int]

    @classmethod
    def of(cls, pair: Pair, step: int = 1) -> Search:
        """Every shift within the reach, and on a coarse grid those just around it."""
        start, size = [], []
        for offset, reach in zip(pair.offset, pair.reach, strict=True):
            first = ceil(offset - reach) if step == 1 else floor(offset - reach)
            last = offset + reach
            start.append(first)
            size.append((floor(last) - first if step == 1 else ceil(last - first)) // step + 1)
        shape = sp.transform_shape(pair.reference.shape, step)
        fitting = [min(n, s // step) for n, s in zip(size, shape, strict=True)]
        return cls(shape, step, (start[0], start[1]), (fitting[0], fitting[1]))

    def surface(self, pair: Pair, values: NDArray[np.float32]) -> Surface:
        """The values as a surface over shifts between the two centres."""
        rows, cols = pair.offset
        return Surface(values, (self.start[0] - rows, self.start[1] - cols), self.step)


def reference_spectrum(window: Window, search: Search, kind: sp.Taper) -> sp.Spectrum:
    """The reference's spectrum, delayed so that the sought shifts come first; kept."""
    shape, step, start, _ = search

    def compute() -> sp.Spectrum:
        plain = sp.low_spectrum(sp.faded(window, kind), shape, step)
        return sp.delayed(plain, shape, step, np.array(start))

    return window.kept(("delayed", shape, step, start, kind), compute)


def moving_spectrum(window: Window, search: Search, kind: sp.Taper) -> sp.Spectrum:
    """The complex conjugate of the moving image's spectrum; kept."""
    shape, step, _, _ = search

    def compute() -> sp.Spectrum:
        plain = sp.low_spectrum(sp.faded(window, kind), shape, step)
        return np.conj(plain, out=plain)

    return window.kept(("conjugate", shape, step, kind), compute)


def cross_power(pair: Pair, search: Search, kind: sp.Taper) -> sp.Spectrum:
    """Normalised cross-power spectrum, half plane; every modulus is 1 or 0."""
    product: sp.Spectrum = np.multiply(
        reference_spectrum(pair.reference, search, kind),
        moving_spectrum(pair.moving, search, kind),
    )
    return sp.whitened(product)


def phase_correlation(pair: Pair) -> Found:
    """Signed peak, Hann taper, whole band: the method of the paper's references [1]_.

    The quality is the cosine similarity with a Dirac delta spread over 3 x 3 px: with
    every modulus 1 the whole surface has unit energy, by Parseval.
    """
    surface = _correlation(pair)
    return Found(surface, None, _share(surface))


def absolute_phase_correlation(pair: Pair) -> Found:
    """As `phase_correlation`, of the absolute surface: a contrast reversal is a peak too."""
    signed = _correlation(pair)
    surface = Surface(np.abs(signed.values), signed.origin)
    return Found(surface, None, _share(surface))


def sun_phase_correlation(pair: Pair) -> Found:
    """Phase correlation repaired with the sign pattern of two known suns [2]_.

    Without suns both are taken to be the same, and the pattern is +1 throughout. The
    band is a Gaussian low-pass: high frequencies leave the linear regime first.
    """
    search = Search.of(pair)
    product = cross_power(pair, search, ("tukey", 0.25))
    azimuths = (0.0, 0.0) if pair.sun is None else (pair.sun[0].azimuth, pair.sun[1].azimuth)
    product *= _sun_pattern(search.shape, azimuths, pair.pixel_size)
    surface = search.surface(pair, sp.part_of_surface(product, search.shape[1], search.size))
    return Found(surface)


def _correlation(pair: Pair) -> Surface:
    search = Search.of(pair)
    product = cross_power(pair, search, "hann")
    return search.surface(pair, sp.part_of_surface(product, search.shape[1], search.size))


def _share(surface: Surface) -> float:
    """Root of the energy within 3 x 3 px of the peak, where the whole energy is 1 / size."""
    row, col = surface.peak()
    near = surface.values[max(row - 1, 0) : row + 2, max(col - 1, 0) : col + 2].ravel()
    return float(min(np.sqrt(np.dot(near, near)), 1.0))


@lru_cache(maxsize=32)
def _sun_pattern(
    shape: tuple[int, int], azimuths: tuple[float, float], pixel_size: tuple[float, float]
) -> NDArray[np.float32]:
    """Low-passed sign pattern (rows, columns // 2 + 1); zenith changes no sign."""
    f_rows, f_cols = sp.frequencies(shape)
    bearing = np.arctan2(f_cols / pixel_size[1], -f_rows / pixel_size[0])
    one, other = (np.cos(bearing - np.radians(azimuth)) for azimuth in azimuths)
    band = np.exp(-0.5 * (f_rows**2 + f_cols**2) / SUN_BAND**2)
    pattern: NDArray[np.float32] = (np.sign(one * other) * band).astype(np.float32)
    return pattern
