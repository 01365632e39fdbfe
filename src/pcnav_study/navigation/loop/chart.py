"""The map on board: the reference picture and the heights under it, on one grid."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.scene.grid import Grid

Corner = tuple[int, int]


@dataclass(frozen=True)
class Chart:
    """What the UAV carries of the ground.

    Parameters
    ----------
    reference, elevation : DataArray (y, x)
        On one grid, in a metric CRS.
    """

    reference: xr.DataArray
    elevation: xr.DataArray

    def __post_init__(self) -> None:
        if self.reference.shape != self.elevation.shape:
            raise InputError(
                f"the map {self.reference.shape} and the elevation {self.elevation.shape} do not "
                "lie on one grid; resample one onto the other"
            )

    @cached_property
    def grid(self) -> Grid:
        """Of both."""
        return Grid.of(self.elevation)

    @cached_property
    def pixel(self) -> float:
        """Side of a square pixel of the same area, metres."""
        return float(np.sqrt(np.prod(self.grid.pixel_size)))

    @cached_property
    def level(self) -> float:
        """Mean height, metres."""
        return float(np.nanmean(self._heights))

    @cached_property
    def _heights(self) -> NDArray[np.float32]:
        return np.asarray(self.elevation.values, np.float32)

    @cached_property
    def _pixels(self) -> NDArray[np.float32]:
        return np.asarray(self.reference.values, np.float32)

    def heights(self, corner: Corner, shape: tuple[int, int]) -> NDArray[np.float32]:
        """Heights from (row, column) on; beyond the map its mean."""
        cut = _cut(self._heights, corner, shape)
        missing = np.isnan(cut)
        return np.where(missing, np.float32(self.level), cut) if missing.any() else cut

    def pixels(self, corner: Corner, shape: tuple[int, int]) -> NDArray[np.float32]:
        """The reference from (row, column) on; NaN beyond the map."""
        return _cut(self._pixels, corner, shape)


def _cut(
    values: NDArray[np.float32], corner: Corner, shape: tuple[int, int]
) -> NDArray[np.float32]:
    spans = [
        (max(first, 0), min(first + length, size))
        for first, length, size in zip(corner, shape, values.shape, strict=True)
    ]
    inside = [max(last - first, 0) for first, last in spans]
    (top, bottom), (left, right) = spans
    if inside == list(shape):
        return values[top:bottom, left:right]
    out = np.full(shape, np.nan, np.float32)
    if min(inside) > 0:
        row, col = top - corner[0], left - corner[1]
        out[row : row + inside[0], col : col + inside[1]] = values[top:bottom, left:right]
    return out
