"""What speaks for a shift: six numbers beside the Dirac-delta quality, at little cost.

A near miss keeps much of the quality, because every sector's surface is a ridge across its
own direction. What it loses is agreement: the ridges no longer cross at the shift. So the
middle of both windows is looked at once more, at the shift and around it.

Reflectance keeps its sign under every sun and rules the low frequencies; shading turns its
sign and rules the high ones. Where both are in view a sector's two parts cancel at the true
shift, and its summit lies beside it. Every sector is therefore seen in two bands, each with
a sign of its own.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.overlap import SECTORS, Band, band_of, centred, validity
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.refine import quality_at
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import SMALLEST, Window
from pcnav_study.quality.null import expected_null

AROUND = (-4, -2, -1, 0, 1, 2, 4)  # px, where around the shift energy is looked at
SIDES = (48, 128)  # px, the smallest and the largest middle looked at
RING = 0.17  # cycles/px, where each sector is cut into a low and a high band
APART = 4  # px, from where on another peak is another place

Shift = NDArray[np.float64]


class Evidence(NamedTuple):
    """What speaks for one shift.

    Attributes
    ----------
    quality : float
        Dirac-delta quality, 0 to 1.
    above_null : float
        The same in units of what unrelated windows of this overlap have on average.
    share : float
        Of the sectors' energy around it, the part within 3 x 3 px, 0 to 1.
    summit : float
        The sectors' energy at the shift over the highest around it, 0 to 1.
    pull : float
        How far the sectors, each along its own direction, would move the shift, px (RMS).
    accord : float
        Of the sectors' heights at the shift, the part left when each one's low and high band
        are added with their signs, 0 to 1.
    rival : float
        Second peak of the score surface over the first, 0 to 1.
    """

    quality: float
    above_null: float
    share: float
    summit: float
    pull: float
    accord: float
    rival: float


FARTHEST = 5.0  # px, the largest pull stated
NOTHING = Evidence(0.0, 0.0, 0.0, 0.0, FARTHEST, 0.0, 1.0)


def evidence_of(
    reference: Window,
    moving: Window,
    shift: Shift,
    surface: Surface,
    quality: float | None = None,
) -> Evidence:
    """Evidence for ``shift`` (row, column) px, as of `matching.match`.

    Parameters
    ----------
    reference, moving : Window
    shift : (2,)
    surface : Surface
        Score of all candidates, by ``pc-sectors``.
    quality : float, optional
        Of the shift, if it is known already.

    Returns
    -------
    Evidence
        ``NOTHING`` for windows without texture or overlap.
    """
    if reference.is_empty or moving.is_empty or not np.isfinite(shift[0] + shift[1]):
        return NOTHING
    cuts, residual, overlap = _middle(reference, moving, shift)
    if min(n for _, _, n in cuts) < SMALLEST:
        return NOTHING
    phasors = _phasors(reference, moving, cuts)
    if phasors is None:
        return NOTHING
    if quality is None:
        quality = quality_at(Pair(reference, moving, (1.0, 1.0)), shift)
    share, summit, pull, accord = _local(phasors, (cuts[0][2], cuts[1][2]), residual)
    null = expected_null(overlap)
    return Evidence(quality, quality / null, share, summit, pull, accord, rival_of(surface))


def rival_of(surface: Surface) -> float:
    """Second peak, at least ``APART`` px away, over the first; both above the mean."""
    values = surface.values
    row, col = surface.peak()
    reach = -(-APART // surface.step) - 1
    left = values.copy()
    left[max(row - reach, 0) : row + reach + 1, max(col - reach, 0) : col + reach + 1] = -np.inf
    second, first = float(left.max()), float(values[row, col])
    return min(max(second / first, 0.0), 1.0) if first > 0 else 1.0


def _middle(
    reference: Window, moving: Window, shift: Shift
) -> tuple[list[tuple[int, int, int]], Shift, tuple[int, int]]:
    """The middle of the overlap: (first in reference, in moving, length) of each axis.

    Also the part of the shift that is left, px, and the shape of the whole overlap.
    """
    smallest, largest = SIDES
    side = min(max(min(moving.shape) // 2, smallest), largest)
    cuts, residual, overlap = [], [], []
    for s, r, m in zip(shift, reference.shape, moving.shape, strict=True):
        offset = (r - m) / 2
        whole = round(float(s) + offset)
        first, last = max(0, whole), min(r, whole + m)
        length = max(last - first, 0)
        used = min(length // (16 if length >= 64 else 4) * (16 if length >= 64 else 4), side)
        start = first + (length - used) // 2
        cuts.append((start, start - whole, used))
        residual.append(float(s) + offset - whole)
        overlap.append(length // 4 * 4)
    return cuts, np.array(residual), (overlap[0], overlap[1])


def _phasors(
    reference: Window, moving: Window, cuts: list[tuple[int, int, int]]
) -> NDArray[np.complex64] | None:
    """Unit phasors of the middle's cross-power spectrum; None without texture."""
    (r_row, m_row, rows), (r_col, m_col, cols) = cuts
    both = np.empty((2, rows, cols), np.float32)
    weight = sp.taper((rows, cols), ("tukey", 0.5))
    places = ((reference, r_row, r_col), (moving, m_row, m_col))
    for out, (window, row, col) in zip(both, places, strict=True):
        cut = slice(row, row + rows), slice(col, col + cols)
        centred(window, cut, out)
        weight = weight * validity(window, cut)
    both *= weight
    omega_rows, omega_cols = band_of((rows, cols))[:2]
    high, wide = len(omega_rows) // 2, len(omega_cols) - 1
    full = fft.fft(fft.rfft(both, axis=-1)[..., : wide + 1], axis=-2)
    product = np.conj(full[1])
    product *= full[0]
    low: NDArray[np.complex64] = np.concatenate((product[rows - high :], product[: high + 1]))
    sp.whitened(low)
    return low if low[high].any() else None


class _Tables(NamedTuple):
    band: Band
    bank: NDArray[np.float32]
    slope: NDArray[np.float32]
    rows: NDArray[np.complex64]
    cols: NDArray[np.complex64]


@lru_cache(maxsize=64)
def _tables(shape: tuple[int, int]) -> _Tables:
    """What `_local` needs of a shape: the bank, its slopes, and the waves around a shift."""
    band = band_of(shape)
    rows, cols = np.meshgrid(band.omega_rows, band.omega_cols, indexing="ij")
    low = np.hypot(rows, cols) < 2 * np.pi * RING
    bank = np.concatenate((band.bank * low, band.bank * ~low))
    flat = bank.reshape(len(bank), -1)
    direction = np.tile((np.arange(SECTORS) + 0.5) * np.pi / SECTORS, 2)
    along = np.outer(np.sin(direction), rows) + np.outer(np.cos(direction), cols)
    slope = flat * along / np.maximum((flat * along**2).sum(axis=1, keepdims=True), 1e-12)
    waves = [
        np.exp(1j * np.outer(AROUND, omega)).astype(np.complex64)
        for omega in (band.omega_rows, band.omega_cols)
    ]
    return _Tables(band, bank, slope.astype(np.float32), waves[0], waves[1].T.copy())


def _local(
    phasors: NDArray[np.complex64], shape: tuple[int, int], residual: Shift
) -> tuple[float, float, float, float]:
    """Share, summit, pull and accord at ``residual`` px from the phasors' whole-pixel shift."""
    band, bank, slope, rows, cols = _tables(shape)
    turned = phasors * np.exp(1j * residual[0] * band.omega_rows).astype(np.complex64)[:, None]
    turned *= np.exp(1j * residual[1] * band.omega_cols).astype(np.complex64)
    moves = slope @ turned.imag.ravel()
    surfaces = np.matmul(np.matmul(rows, bank * turned), cols).real
    energy = np.square(surfaces).sum(axis=0)
    middle = len(AROUND) // 2
    near = float(energy[middle - 1 : middle + 2, middle - 1 : middle + 2].sum())
    heights = surfaces[:, middle, middle]
    highest, whole = float(energy.max()), float(energy.sum())
    pull = np.sqrt(float(moves @ moves) / max(float(heights @ heights), 1e-30))
    together = np.abs(heights[:SECTORS] + heights[SECTORS:]).sum()
    accord = float(together / max(float(np.abs(heights).sum()), 1e-30))
    return (
        near / max(whole, 1e-30),
        float(energy[middle, middle]) / max(highest, 1e-30),
        min(float(pull), FARTHEST),
        accord,
    )
