"""The cross-power spectrum of what both windows show, once the whole-pixel shift is known.

Outside the overlap the windows show different ground, which is noise to every
coefficient: cropping both to it before the sub-pixel step takes most of the error away.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.windows import SMALLEST, Window

Slices = tuple[slice, slice]
EDGE = 0.36  # cycles/px, the highest frequency kept along either axis
LONGEST = 256  # px per side of a crop; shading, not the number of pixels, limits beyond it
HARMONICS = 56  # kept along an axis, at most
SMALL = 80  # px; a smaller crop cannot afford to lose its rim to the taper
SEARCH_BAND = 0.2  # cycles/px, standard deviation of the Gaussian low-pass of the search
FIT_BAND = 0.3  # cycles/px, the same of the sub-pixel fit
SECTORS = 8


class Band(NamedTuple):
    """The coefficients that are kept of one transform.

    Attributes
    ----------
    omega_rows, omega_cols : (r,), (c,) float32
        Angular frequencies, radians/px; along the rows ascending, along the columns from 0.
    bank : (sectors, r, c) float32
        Low-pass of each angular sector, all together of unit sum.
    patterns : (3, r, c) float32
        The same low-pass times each of `light_patterns`.
    sharper : (r, c) float32
        What turns the search's low-pass into the fit's.
    """

    omega_rows: NDArray[np.float32]
    omega_cols: NDArray[np.float32]
    bank: NDArray[np.float32]
    patterns: NDArray[np.float32]
    sharper: NDArray[np.float32]


class Overlap(NamedTuple):
    """Unit phasors (r, c) of a `Band`, and the whole-pixel shift they were taken at."""

    phasors: NDArray[np.complex64]
    band: Band
    whole: NDArray[np.float64]

    def turned(self, residual: NDArray[np.float64]) -> NDArray[np.complex64]:
        """Phasors without the phase ramp of ``residual`` (row, column) px."""
        rows = np.exp(1j * residual[0] * self.band.omega_rows).astype(np.complex64)
        cols = np.exp(1j * residual[1] * self.band.omega_cols).astype(np.complex64)
        turned: NDArray[np.complex64] = self.phasors * rows[:, None]
        turned *= cols
        return turned

    def sector_sums(self, residual: NDArray[np.float64]) -> NDArray[np.float32]:
        """Surface of each sector at ``residual``; their absolute values sum to 1 at most."""
        bank = self.band.bank
        real = self.turned(residual).real.ravel()
        sums: NDArray[np.float32] = bank.reshape(len(bank), -1) @ real
        return sums


def overlap_of(pair: Pair, shift: NDArray[np.float64]) -> Overlap | None:
    """Both windows cropped to their overlap at the nearest whole shift; None if too small."""
    whole = [round(float(s + o)) for s, o in zip(shift, pair.offset, strict=True)]
    cuts = [
        _common(w, r, m)
        for w, r, m in zip(whole, pair.reference.shape, pair.moving.shape, strict=True)
    ]
    if min(c.stop - c.start for c, _ in cuts) < SMALLEST:
        return None
    one: Slices = (cuts[0][0], cuts[1][0])
    other: Slices = (cuts[0][1], cuts[1][1])
    ours, theirs = _low_pass(_stacked(pair, one, other))
    product = np.conj(theirs, out=theirs)
    product *= ours
    band = band_of((one[0].stop - one[0].start, one[1].stop - one[1].start))
    return Overlap(sp.whitened(product), band, np.array(whole) - pair.offset)


def _low_pass(images: NDArray[np.float32]) -> sp.Spectrum:
    """Spectra (2, r, c) of two images up to ``EDGE``, rows in ascending frequency."""
    rows, cols = images.shape[1:]
    high, wide = _edge(rows), _edge(cols)
    half = fft.rfft(images, axis=-1)[..., : wide + 1]
    full = fft.fft(half, axis=-2)
    low: sp.Spectrum = np.concatenate((full[:, rows - high :], full[:, : high + 1]), axis=1)
    return low


def _edge(length: int) -> int:
    """Highest harmonic kept; the last one of an even length has no sign and is left out."""
    return min(int(EDGE * length), (length - 1) // 2, HARMONICS)


@lru_cache(maxsize=128)
def band_of(shape: tuple[int, int]) -> Band:
    """The band of an overlap of ``shape``."""
    rows = np.arange(-_edge(shape[0]), _edge(shape[0]) + 1)[:, None] / shape[0]
    cols = np.arange(_edge(shape[1]) + 1)[None, :] / shape[1]
    squared = rows**2 + cols**2
    weight = np.exp(-0.5 * squared / SEARCH_BAND**2) * ((cols > 0) | (rows > 0))
    weight[squared > EDGE**2] = 0.0
    weight /= weight.sum()
    which = sector_of(rows, cols)
    bank = (which == np.arange(SECTORS)[:, None, None]) * weight
    omega = [(2 * np.pi * f.ravel()).astype(np.float32) for f in (rows, cols)]
    sharper = np.exp(-0.5 * squared * (FIT_BAND**-2 - SEARCH_BAND**-2))
    patterns = light_patterns(rows, cols) * weight
    return Band(omega[0], omega[1], *(t.astype(np.float32) for t in (bank, patterns, sharper)))


def light_patterns(rows: NDArray[np.float64], cols: NDArray[np.float64]) -> NDArray[np.float64]:
    """What two suns can make of a cross-power spectrum, of equal power: (3, r, c).

    The product ``cos(theta - tau1) cos(theta - tau2)`` is a constant and a wave of twice the
    angle; light that no azimuth turns, as of reflectance, adds to the constant.
    """
    twice = 2 * np.arctan2(rows, cols)
    return np.stack((np.ones_like(twice), 2**0.5 * np.cos(twice), 2**0.5 * np.sin(twice)))


def sector_of(rows: NDArray[np.float64], cols: NDArray[np.float64]) -> NDArray[np.intp]:
    """Number of the angular sector of a frequency and of its opposite."""
    angle = np.arctan2(rows, cols) % np.pi
    number: NDArray[np.intp] = np.minimum(angle / np.pi * SECTORS, SECTORS - 1).astype(np.intp)
    return number


def _common(whole: int, reference: int, moving: int) -> tuple[slice, slice]:
    """Where the windows overlap along one axis: in the reference and in the moving image.

    Cut to a length with a fast transform, few of which cover every shift.
    """
    first, last = max(0, whole), min(reference, whole + moving)
    length = max(last - first, 0)
    unit = 16 if length >= 64 else 4 if length >= 16 else 1
    usable = min(length // unit * unit, LONGEST)
    start = first + (length - usable) // 2
    return slice(start, start + usable), slice(start - whole, start - whole + usable)


def _stacked(pair: Pair, one: Slices, other: Slices) -> NDArray[np.float32]:
    """(2, rows, columns): both crops without mean, tapered, weighted alike where pixels miss."""
    rows, cols = one
    shape = (rows.stop - rows.start, cols.stop - cols.start)
    both = np.empty((2, *shape), np.float32)
    weight = sp.taper(shape, ("tukey", 0.25 if min(shape) < SMALL else 0.5))
    weight = weight * validity(pair.reference, one) * validity(pair.moving, other)
    for out, window, cut in zip(both, (pair.reference, pair.moving), (one, other), strict=True):
        centred(window, cut, out)
        out *= weight
    return both


def centred(window: Window, cut: Slices, out: NDArray[np.float32]) -> None:
    """Write a crop without its mean, missing pixels at the window's, scaled only if wild."""
    image = window.values[cut]
    if window.valid is not None:
        image = np.where(window.valid[cut], image, window.mean)
    mean = image.dtype.type(np.add.reduce(image, axis=None) / image.size)
    np.subtract(image, mean, out=out, casting="same_kind")
    if not window.is_tame:
        out /= np.float32(max(float(np.abs(out).max()), 1e-37))


def validity(window: Window, cut: Slices) -> Any:
    """Weights around missing pixels; 1 where none is missing."""
    if window.valid is None:
        return np.float32(1.0)
    feathered = window.kept("feather", lambda: sp.feather(window))
    return feathered[cut]
