"""What every matcher starts from: a checked image that remembers its own transforms."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError

T = TypeVar("T")
Real = NDArray[np.float32] | NDArray[np.float64]
SMALLEST = 8  # px; below it a window holds no texture to match


class Window:
    """One image, checked once, with everything computed from it kept for the next match.

    Make it with `prepare`, and hand it to `match` in place of the image: a reference
    that meets many frames then pays for its spectrum once. The pixels are the caller's
    own array wherever their type allows, and are never written to.

    Attributes
    ----------
    values : (rows, columns) float32 or float64
        NaN wherever ``valid`` is False.
    valid : (rows, columns) bool, or None
        None where every pixel is valid.
    low, high, mean : float
        Over the valid pixels; zero if there is none.
    """

    __slots__ = ("_store", "high", "low", "mean", "valid", "values")

    def __init__(self, values: Real, valid: NDArray[np.bool_] | None) -> None:
        self.values = values
        self.valid = valid
        inside = values if valid is None else values[valid]
        self.low, self.high, self.mean = 0.0, 0.0, 0.0
        if inside.size:
            self.low, self.high = float(inside.min()), float(inside.max())
            self.mean = float(np.add.reduce(inside, axis=None)) / inside.size
        self._store: dict[Hashable, Any] = {}

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return self.values.shape

    @property
    def is_empty(self) -> bool:
        """True where there is nothing to match: no valid pixel, or one value throughout."""
        return not self.high > self.low

    @property
    def is_tame(self) -> bool:
        """True where products of two spectra stay within single precision."""
        return 1e-4 < self.high - self.low < 1e6

    def kept(self, key: Hashable, compute: Callable[[], T]) -> T:
        """The value stored under ``key``, computed at the first call."""
        if key not in self._store:
            self._store[key] = compute()
        return cast(T, self._store[key])

    def centred(self) -> NDArray[np.float32]:
        """A new array: pixels less their mean, zero where invalid, within -1 and 1.

        Unscaled single precision would overflow in a product of two spectra.
        """
        out = np.empty(self.shape, np.float32)
        np.subtract(self.values, self.values.dtype.type(self.mean), out=out, casting="same_kind")
        if not self.is_tame:
            span = self.high - self.low
            exact = (self.values.astype(np.float64) - self.mean) / max(span, 1e-300)
            out[...] = exact
        if self.valid is not None:
            out[~self.valid] = 0.0
        return out


def prepare(image: ArrayLike | Window, name: str = "image") -> Window:
    """Check an image and make it reusable.

    Parameters
    ----------
    image : (rows, columns) real array
        NaN, or a masked element of a masked array, is no data.
    name : str
        What to call it in an error.

    Raises
    ------
    InputError
        If it is not two-dimensional, not real numbers, infinite somewhere, or too small.
    """
    if isinstance(image, Window):
        return image
    hidden = np.ma.getmaskarray(image) if isinstance(image, np.ma.MaskedArray) else None
    array: NDArray[Any] = np.asarray(image)
    if array.ndim != 2:
        raise InputError(
            f"{name} has {array.ndim} dimensions; give one band of shape (rows, columns)"
        )
    if array.dtype.kind == "c":
        raise InputError(f"{name} is complex; give its real part or its magnitude")
    if array.dtype.kind not in "fiub":
        raise InputError(f"{name} holds {array.dtype}, not numbers; give a real array")
    if min(array.shape) < SMALLEST:
        raise InputError(f"{name} of {array.shape} px is too small; give at least {SMALLEST} px")
    values = _as_float(array)
    window = Window(values, None) if hidden is None else None
    if window is not None and np.isfinite(window.low) and np.isfinite(window.high):
        return window
    if np.isinf(values).any():
        raise InputError(f"{name} holds infinities; mark missing data with NaN")
    valid = ~np.isnan(values) if hidden is None else ~(np.isnan(values) | hidden)
    if valid.all():
        return Window(values, None)
    holed: NDArray[Any] = np.where(valid, values, np.nan).astype(values.dtype)
    return Window(holed, valid)


def _as_float(array: NDArray[Any]) -> Real:
    """Single precision where it is exact, else double; the very array if it already is."""
    if array.dtype == np.float64 or (array.dtype != np.float32 and array.dtype.itemsize > 2):
        double: NDArray[np.float64] = array.astype(np.float64, copy=False)
        return double
    single: NDArray[np.float32] = array.astype(np.float32, copy=False)
    return single
