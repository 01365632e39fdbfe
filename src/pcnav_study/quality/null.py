"""What quality unrelated windows reach: the null of the sectors' Dirac-delta quality.

The quality of `matching.refine.delta_quality` is q = sum_k |S_k|, where S_k is the
low-passed surface of angular sector k at the shift and all weights sum to one. Unrelated
windows have uniform phases, so S_k is nearly normal with variance

    sigma_k**2 = 1/2 sum_{w, w'} b_k(w) b_k(w') g(w - w')

where b_k is the sector's low-pass and g the correlation of the unit phasors of two
frequencies. A taper t makes neighbours alike: for a spectrum that varies little between
them their coefficients correlate by rho = F[t**2](w - w') / F[t**2](0), the phasors of one
picture by c(rho) = (pi / 4) rho 2F1(1/2, 1/2; 2; rho**2) [1]_, and those of the product of
two unrelated pictures by c(rho)**2. A sum of absolute normals has no closed law; its
density is the convolution of half-normal ones. The best of many shifts is bounded by
their union.

Every |S_k| has a positive mean, so q has a floor that falls with the window's side. The
number of candidates alone, as in `dirac.null_level`, does not tell it: a search on a coarse
grid has few candidates, but its windows are as large as ever.

References
----------
.. [1] Middleton (1948), Quarterly of Applied Mathematics 5(4), 445-498.
"""

from __future__ import annotations

from functools import lru_cache
from math import log, pi, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy import fft, special

from pcnav_study.matching.overlap import SMALL, band_of
from pcnav_study.matching.spectrum import Taper, taper

Array = NDArray[np.float64]
NEIGHBOURS = 4  # harmonics; further ones are uncorrelated under any taper in use
CELLS = 2048  # of the numerical density


def sector_spread(shape: tuple[int, int], kind: Taper | None = None) -> Array:
    """Standard deviation of each sector's surface for unrelated windows.

    Parameters
    ----------
    shape : (rows, columns)
        Of the overlap, px.
    kind : str or (str, float), optional
        Taper, as scipy.signal names it; by default the one `matching.overlap` uses.

    Returns
    -------
    (sectors,)
    """
    return _spread(shape, kind or ("tukey", 0.25 if min(shape) < SMALL else 0.5))


@lru_cache(maxsize=256)
def _spread(shape: tuple[int, int], kind: Taper) -> Array:
    bank = band_of(shape).bank.astype(np.float64)
    window = fft.fft2(taper(shape, kind).astype(np.float64) ** 2)
    variance = np.zeros(len(bank))
    rows, cols = bank.shape[1:]
    tall, wide = min(NEIGHBOURS, rows - 1), min(NEIGHBOURS, cols - 1)
    for down in range(-tall, tall + 1):
        for right in range(-wide, wide + 1):
            alike = phasor_correlation(float(abs(window[down, right] / window[0, 0]))) ** 2
            one = bank[
                :, max(-down, 0) : rows - max(down, 0), max(-right, 0) : cols - max(right, 0)
            ]
            two = bank[:, max(down, 0) : rows + min(down, 0), max(right, 0) : cols + min(right, 0)]
            variance += 0.5 * alike * np.einsum("kij,kij->k", one, two)
    spread: Array = np.sqrt(variance)
    spread.flags.writeable = False
    return spread


@lru_cache(maxsize=64)
def crowding(shape: tuple[int, int], kind: Taper) -> float:
    """How much more of an unrelated surface's energy lies at no shift than on average.

    Phasors that a taper makes alike pile the energy up around the middle of the surface:
    the sum of g over all differences of frequency.
    """
    window = fft.fft2(taper(shape, kind).astype(np.float64) ** 2)
    rho = np.abs(window / window[0, 0])[: NEIGHBOURS + 1, : NEIGHBOURS + 1]
    alike = np.vectorize(phasor_correlation)(rho) ** 2
    twice = np.where(np.arange(NEIGHBOURS + 1) == 0, 1, 2)
    return float(twice @ alike @ twice)


def phasor_correlation(rho: float) -> float:
    """Correlation of the unit phasors of two circular normal variables of correlation ``rho``."""
    rho = min(rho, 1.0)
    return float(pi / 4 * rho * special.hyp2f1(0.5, 0.5, 2.0, rho**2))


@lru_cache(maxsize=256)
def _tail_table(shape: tuple[int, int], kind: Taper | None) -> tuple[Array, Array]:
    """Qualities and the probability to exceed them, at one shift."""
    spread = sector_spread(shape, kind)
    top = float(np.sqrt(2 / pi) * spread.sum() + 12 * np.sqrt((spread**2).sum()))
    grid = (np.arange(CELLS) + 0.5) * top / CELLS
    spectrum = np.ones(CELLS + 1, np.complex128)
    for sigma in spread[spread > 0]:
        density = np.exp(-0.5 * (grid / sigma) ** 2)
        spectrum *= fft.rfft(density / density.sum(), 2 * CELLS)
    density = np.maximum(fft.irfft(spectrum, 2 * CELLS)[:CELLS], 0.0)
    # Each half-cell offset of the grid adds up over the sectors.
    values = grid + (np.count_nonzero(spread) - 1) * 0.5 * top / CELLS
    tail: Array = np.cumsum(density[::-1])[::-1]
    return values, tail


def density(shape: tuple[int, int], kind: Taper | None = None) -> tuple[Array, Array]:
    """Qualities, and the probability density of each at one shift of unrelated windows."""
    values, tail = _tail_table(shape, kind)
    return values, -np.gradient(tail, values)


def null_tail(
    quality: float, shape: tuple[int, int], candidates: int = 1, kind: Taper | None = None
) -> float:
    """Probability, at most, that unrelated windows reach ``quality`` at the best of shifts."""
    values, tail = _tail_table(shape, kind)
    logs = np.log(np.maximum(tail, 1e-300))
    return float(min(np.exp(np.interp(quality, values, logs)) * max(candidates, 1), 1.0))


def sector_null_level(
    shape: tuple[int, int],
    candidates: int = 1,
    *,
    false_match_rate: float = 0.01,
    kind: Taper | None = None,
) -> float:
    """Quality that unrelated windows exceed with probability ``false_match_rate`` at most.

    Parameters
    ----------
    shape : (rows, columns)
        Of the overlap, px.
    candidates : int
        Whole-pixel shifts searched.
    false_match_rate : float
        Share of unrelated pairs that may pass.
    kind : str or (str, float), optional
        Taper, as in `sector_spread`.
    """
    values, tail = _tail_table(shape, kind)
    wanted = log(false_match_rate / max(candidates, 1))
    logs = np.log(np.maximum(tail, 1e-300))
    return float(min(np.interp(-wanted, -logs, values), 1.0))


@lru_cache(maxsize=1024)
def expected_null(shape: tuple[int, int]) -> float:
    """Mean quality of unrelated windows at one shift: sqrt(2 / pi) times the sum of spreads."""
    return sqrt(2 / pi) * float(sector_spread(shape).sum())
