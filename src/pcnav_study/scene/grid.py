"""A georeferenced pixel grid, and the DataArrays that lie on it.

The georeference travels the CF way, in the ``spatial_ref`` coordinate that
rioxarray reads and writes, so any tool of that family understands our images.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import rioxarray  # noqa: F401  (registers the .rio accessor)
import xarray as xr
from affine import Affine
from numpy.typing import ArrayLike, NDArray
from pyproj import CRS, Transformer

from pcnav_study.errors import InputError


@dataclass(frozen=True)
class Grid:
    """A north-up pixel grid: row 0 is north, column 0 is west.

    Parameters
    ----------
    transform : Affine
        Maps (column, row) of a pixel's upper-left corner to (x, y) of ``crs``.
    shape : tuple of int
        (rows, columns).
    crs : str
        Coordinate reference system, as anything pyproj reads.
    """

    transform: Affine
    shape: tuple[int, int]
    crs: str

    @classmethod
    def of(cls, image: xr.DataArray) -> Grid:
        """The grid of an image with dims (..., "y", "x"); raises InputError without a CRS."""
        if image.rio.crs is None:
            raise InputError(
                f"image {image.name!r} has no CRS; write one with image.rio.write_crs()"
            )
        shape = (image.sizes["y"], image.sizes["x"])
        return cls(_transform(image), shape, image.rio.crs.to_wkt())

    @classmethod
    def centred(
        cls, x: float, y: float, pixel_size: tuple[float, float], shape: tuple[int, int], crs: str
    ) -> Grid:
        """The grid of ``shape`` whose middle lies at (x, y), in units of ``crs``."""
        dy, dx = pixel_size
        rows, cols = shape
        corner = Affine(dx, 0.0, x - dx * cols / 2, 0.0, -dy, y + dy * rows / 2)
        return cls(corner, shape, crs)

    @property
    def pixel_size(self) -> tuple[float, float]:
        """(dy, dx), both positive, in units of the CRS."""
        return abs(self.transform.e), abs(self.transform.a)

    def coordinates(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Coordinates of the pixel centres along y (rows,) and along x (columns,)."""
        t = self.transform
        rows, cols = self.shape
        row, col = np.arange(rows, dtype=np.float64), np.arange(cols, dtype=np.float64)
        return t.f + t.e * (row + 0.5), t.c + t.a * (col + 0.5)

    def mesh(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """x and y of every pixel centre, each of the grid's shape."""
        y, x = self.coordinates()
        return np.broadcast_to(x, self.shape), np.broadcast_to(y[:, None], self.shape)

    def row_col(self, x: ArrayLike, y: ArrayLike) -> tuple[NDArray[np.float64], ...]:
        """Fractional (row, column) of map points; (0, 0) is the first pixel's centre."""
        inverse = ~self.transform
        x, y = np.asarray(x, float), np.asarray(y, float)
        col = inverse.a * x + inverse.b * y + inverse.c - 0.5
        row = inverse.d * x + inverse.e * y + inverse.f - 0.5
        return row, col

    def at_shares(self, shares: ArrayLike) -> NDArray[np.float64]:
        """Points (n, 2), x and y, from (row, column) as shares of the grid, 0 to 1."""
        rows, cols = (np.asarray(shares, np.float64) * self.shape).T
        t = self.transform
        return np.stack([t.c + t.a * cols, t.f + t.e * rows], axis=1)

    def window(self, row: int, col: int, shape: tuple[int, int]) -> Grid:
        """The part of this grid (or beyond it) that starts at (row, col)."""
        return Grid(self.transform @ Affine.translation(col, row), shape, self.crs)

    def to_wgs84(self, x: float, y: float) -> tuple[float, float]:
        """(latitude, longitude) in degrees of one map point."""
        lon, lat = Transformer.from_crs(CRS(self.crs), 4326, always_xy=True).transform(x, y)
        return float(lat), float(lon)

    def image(self, values: ArrayLike, name: str | None = None) -> xr.DataArray:
        """Values of shape (..., rows, columns), at most one leading axis, as a DataArray."""
        values = np.asarray(values)
        if values.shape[-2:] != self.shape:
            raise InputError(f"values of shape {values.shape} do not fit the grid {self.shape}")
        y, x = self.coordinates()
        dims = ("y", "x") if values.ndim == 2 else ("band", "y", "x")
        array = xr.DataArray(values, dims=dims, coords={"y": y, "x": x}, name=name)
        written: xr.DataArray = array.rio.write_crs(self.crs).rio.write_transform(self.transform)
        return written


def _transform(image: xr.DataArray) -> Affine:
    """The transform as written, unless the image was sliced since; then from its coordinates."""
    y, x = image["y"].values, image["x"].values
    written = image.coords[image.rio.grid_mapping].attrs.get("GeoTransform")
    if written is not None:
        kept = Affine.from_gdal(*map(float, written.split()))
        first = kept @ (0.5, 0.5)
        last = kept @ (len(x) - 0.5, len(y) - 0.5)
        if np.allclose(
            [*first, *last], [x[0], y[0], x[-1], y[-1]], rtol=0, atol=1e-3 * abs(kept.a)
        ):
            return kept
    dx, dy = (x[-1] - x[0]) / max(len(x) - 1, 1), (y[-1] - y[0]) / max(len(y) - 1, 1)
    return Affine(dx, 0.0, x[0] - dx / 2, 0.0, dy, y[0] - dy / 2)
