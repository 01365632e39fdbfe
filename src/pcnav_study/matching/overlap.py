"""The cross-power spectrum of what both windows show, once the whole-pixel shift is known.

Outside the overlap the windows show different ground, which is noise to every
coefficient: cropping both to it before the sub-pixel step takes most of the error away.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.windows import SMALLEST, Window

Slices = tuple[slice, slice]
TAPER = ("tukey", 0.5)
EDGE = 0.25  # cycles/px, the highest frequency kept


class Band(NamedTuple):
    """The coefficients that are kept of one transform, sorted by sector.

    Attributes
    ----------
    index : (n,) int
        Into the flattened half-plane spectrum.
    omega : (2, n) float32
        Radians/px along rows and columns.
    weight : (n,) float32
        Low-pass, twice for coefficients whose mirror image is left out; of unit sum.
    first : (sectors,) int
        Where each sector begins.
    """

    index: NDArray[np.intp]
    omega: NDArray[np.float32]
    weight: NDArray[np.float32]
    first: NDArray[np.intp]


class Overlap(NamedTuple):
    """Unit phasors (n,) of a `Band`, and the whole-pixel shift they were taken at."""

    phasors: NDArray[np.complex64]
    band: Band
    shape: tuple[int, int]
    whole: NDArray[np.float64]


def overlap_of(pair: Pair, shift: NDArray[np.float64], sectors: int) -> Overlap | None:
    """Both windows cropped to their overlap at the nearest whole shift; None if too small."""
    whole = np.rint(shift + pair.offset)
    cuts = [
        _common(int(w), r, m)
        for w, r, m in zip(whole, pair.reference.shape, pair.moving.shape, strict=True)
    ]
    if min(c.stop - c.start for c, _ in cuts) < SMALLEST:
        return None
    one: Slices = (cuts[0][0], cuts[1][0])
    other: Slices = (cuts[0][1], cuts[1][1])
    shape = (one[0].stop - one[0].start, one[1].stop - one[1].start)
    step = 2 if min(shape) >= 48 else 1
    low = sp.low_spectrum(_stacked(pair, one, other), shape, step)
    band = band_of(shape, step, sectors)
    ours, theirs = low.reshape(2, -1)[:, band.index]
    product = np.conj(theirs, out=theirs)
    product *= ours
    return Overlap(sp.whitened(product), band, shape, whole - pair.offset)


@lru_cache(maxsize=256)
def band_of(shape: tuple[int, int], step: int, sectors: int) -> Band:
    """The band below ``EDGE`` of a spectrum from `spectrum.low_spectrum`."""
    from pcnav_study.matching.sectors import BAND, sector_of

    f_rows, f_cols = sp.frequencies(shape, step)
    radius = np.hypot(f_rows, f_cols)
    inside = (radius > 0) & (radius < EDGE) & ((f_cols > 0) | (f_rows > 0))
    inside &= np.abs(f_rows) < 0.5 / step
    index = np.flatnonzero(inside)
    number = sector_of(f_rows, f_cols, sectors).ravel()[index]
    order = np.argsort(number, kind="stable")
    index, number = index[order], number[order]
    weight = np.exp(-0.5 * radius.ravel()[index] ** 2 / BAND**2)
    rows, cols = np.broadcast_arrays(f_rows, f_cols)
    omega = 2 * np.pi * np.stack([rows.ravel()[index], cols.ravel()[index]])
    first = np.unique(number, return_index=True)[1]
    return Band(
        index, omega.astype(np.float32), (weight / weight.sum()).astype(np.float32), first
    )


def _common(whole: int, reference: int, moving: int) -> tuple[slice, slice]:
    """Where the windows overlap along one axis: in the reference and in the moving image.

    Cut to a length with a fast transform, few of which cover every shift.
    """
    first, last = max(0, whole), min(reference, whole + moving)
    length = max(last - first, 0)
    unit = 16 if length >= 64 else 4 if length >= 16 else 1
    usable = length // unit * unit
    start = first + (length - usable) // 2
    return slice(start, start + usable), slice(start - whole, start - whole + usable)


def _stacked(pair: Pair, one: Slices, other: Slices) -> NDArray[np.float32]:
    """(2, rows, columns): both crops without mean, tapered, weighted alike where pixels miss."""
    rows, cols = one
    shape = (rows.stop - rows.start, cols.stop - cols.start)
    both = np.empty((2, *shape), np.float32)
    weight = sp.taper(shape, TAPER)
    weight = weight * _valid(pair.reference, one) * _valid(pair.moving, other)
    for out, window, cut in zip(both, (pair.reference, pair.moving), (one, other), strict=True):
        image = window.values[cut]
        if window.valid is not None:
            image = np.where(window.valid[cut], image, window.mean)
        np.subtract(image, image.dtype.type(image.mean()), out=out, casting="same_kind")
        out *= weight
    return both


def _valid(window: Window, cut: Slices) -> Any:
    """Weights around missing pixels; 1 where none is missing."""
    if window.valid is None:
        return np.float32(1.0)
    feathered = window.kept("feather", lambda: sp.feather(window))
    return feathered[cut]
