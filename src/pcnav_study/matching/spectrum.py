"""Spectra of finite windows: tapers, lengths, and transforms of which only a part is needed.

Only low frequencies are kept of many spectra and only small shifts of every surface, so
both transforms leave out the rows and columns that nobody reads.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft, ndimage
from scipy.signal import windows as tapers

from pcnav_study.matching.windows import Window

Spectrum = NDArray[np.complex64]
Taper = str | tuple[str, float]


@lru_cache(maxsize=256)
def taper(shape: tuple[int, int], kind: Taper) -> NDArray[np.float32]:
    """Separable window that fades to zero at the rim; ``kind`` as scipy.signal names it."""
    rows, cols = (tapers.get_window(kind, n, fftbins=False) for n in shape)
    table: NDArray[np.float32] = np.outer(rows, cols).astype(np.float32)
    table.flags.writeable = False
    return table


def faded(window: Window, kind: Taper) -> NDArray[np.float32]:
    """The image without its mean, faded to zero at its rim and around missing pixels.

    A sharp edge of missing data is the same in every frame of a camera, and would pull
    every match to no shift at all.
    """
    image = window.centred()
    image *= taper(window.shape, kind)
    if window.valid is not None:
        image *= feather(window)
    return image


def feather(window: Window) -> NDArray[np.float32]:
    """1 in the valid part, falling to 0 towards missing pixels over 1/16 of the window."""
    valid = window.valid
    if valid is None:
        return np.ones(window.shape, np.float32)
    ramp = max(2.0, min(window.shape) / 16)
    depth = ndimage.distance_transform_edt(valid)
    weight: NDArray[np.float32] = np.sin(np.pi / 2 * np.minimum(depth / ramp, 1.0)) ** 2
    return weight.astype(np.float32)


@lru_cache(maxsize=256)
def transform_shape(shape: tuple[int, int], step: int = 1) -> tuple[int, int]:
    """Fast even lengths, multiples of 2 ``step``, that hold ``shape``."""
    rows, cols = (2 * step * fft.next_fast_len(-(-n // (2 * step)), real=True) for n in shape)
    return rows, cols


def low_spectrum(image: NDArray[np.float32], shape: tuple[int, int], step: int) -> Spectrum:
    """Half-plane spectrum after padding to ``shape``, cut to the band of a ``step`` px grid.

    Returns (rows // step, columns // step // 2 + 1); the same as ``rfft2`` for step 1.
    """
    rows, cols = shape
    if step == 1:
        full: Spectrum = fft.rfft2(image, shape)
        return full
    half = fft.rfft(image, cols, axis=-1)
    high = fft.fft(half[..., : cols // step // 2 + 1], rows, axis=-2)
    n = rows // step
    low: Spectrum = np.concatenate(
        (high[..., : n // 2, :], high[..., rows - (n - n // 2) :, :]), axis=-2
    )
    return low


def part_of_surface(spectrum: Spectrum, cols: int, size: tuple[int, int]) -> NDArray[np.float32]:
    """The first ``size`` (rows, columns) of the inverse transform."""
    columns = fft.ifft(spectrum, axis=-2)[..., : size[0], :]
    surface: NDArray[np.float32] = fft.irfft(columns, cols, axis=-1)[..., : size[1]]
    return surface


@lru_cache(maxsize=256)
def frequencies(
    shape: tuple[int, int], step: int = 1
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cycles/px along rows (n, 1) and columns (1, m) of a spectrum from `low_spectrum`."""
    rows, cols = (n // step for n in shape)
    return fft.fftfreq(rows)[:, None] / step, fft.rfftfreq(cols)[None, :] / step


def delayed(spectrum: Spectrum, shape: tuple[int, int], step: int, start: NDArray[Any]) -> Spectrum:
    """The spectrum whose surface begins at the shift ``start`` (px): sought shifts come first."""
    f_rows, f_cols = frequencies(shape, step)
    phase = 2j * np.pi * (f_rows * start[0] + f_cols * start[1])
    turned: Spectrum = (spectrum * np.exp(phase)).astype(np.complex64)
    return turned


def whitened(product: Spectrum) -> Spectrum:
    """Every coefficient divided by its modulus; zero where it is zero. Overwrites its input."""
    modulus = np.abs(product)
    np.maximum(modulus, np.float32(1e-30), out=modulus)
    np.reciprocal(modulus, out=modulus)
    product *= modulus
    return product
