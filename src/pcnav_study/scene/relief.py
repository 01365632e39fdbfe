"""Elevation grids: a real one that ships with a dependency, and fractal ones.

The real one is the 3-arc-second SRTM tile of the Jacksboro fault, Tennessee, in
matplotlib's sample data. Its rows are placed on an equirectangular map whose
true-scale parallel runs through the tile: an exact affine image of latitude and
longitude, so the measured heights are used as they are, without resampling, on
pixels of 92.8 m by 74.4 m. (North-south lengths are 0.3 % long: PROJ's ``eqc`` is
spherical.)
"""

from __future__ import annotations

import matplotlib.cbook
import numpy as np
import xarray as xr
from affine import Affine
from numpy.typing import NDArray
from pyproj import Transformer
from scipy import fft

from pcnav_study.scene.grid import Grid


def jacksboro() -> xr.DataArray:
    """Elevation in metres, float32 (344, 403), row 0 in the north."""
    path = matplotlib.cbook.get_sample_data("jacksboro_fault_dem.npz", asfileobj=False)
    with np.load(path) as tile:
        heights = tile["elevation"].astype(np.float32)
        west, step = float(tile["xmin"]), float(tile["dx"])
        north = max(float(tile["ymin"]), float(tile["ymax"]))  # the two keys are swapped
    rows, cols = heights.shape
    middle = north - step * rows / 2
    crs = f"+proj=eqc +lat_ts={middle:.6f} +lon_0={west:.6f} +datum=WGS84 +units=m +type=crs"
    to_map = Transformer.from_crs(4326, crs, always_xy=True).transform
    x0, y0 = to_map(west, north)
    x1, y1 = to_map(west + step * cols, north - step * rows)
    transform = Affine((x1 - x0) / cols, 0.0, x0, 0.0, (y1 - y0) / rows, y0)
    return Grid(transform, (rows, cols), crs).image(heights, "elevation")


def power_law_field(
    shape: tuple[int, int], exponent: float, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Gaussian field of zero mean, unit variance and amplitude spectrum f**-exponent."""
    rows, cols = shape
    frequency = np.hypot(fft.fftfreq(rows)[:, None], fft.rfftfreq(cols)[None, :])
    frequency[0, 0] = np.inf
    spectrum = fft.rfft2(rng.standard_normal(shape)) * frequency**-exponent
    field: NDArray[np.float64] = fft.irfft2(spectrum, shape)
    field /= field.std()
    return field


def fractal_relief(
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    rng: np.random.Generator,
    *,
    hurst: float = 0.8,
    median_slope: float = 15.0,
) -> NDArray[np.float64]:
    """Self-affine relief [1]_ in metres, scaled to a median slope in degrees.

    References
    ----------
    .. [1] Turcotte (1997), Fractals and Chaos in Geology and Geophysics, chapter 7.
    """
    heights = power_law_field(shape, hurst + 1.0, rng)
    slope, _ = slope_aspect(heights, pixel_size)
    heights *= np.tan(np.radians(median_slope)) / np.tan(np.radians(np.median(slope)))
    return heights


def slope_aspect(
    elevation: NDArray[np.floating], pixel_size: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Slope, and aspect (downslope, clockwise from north), of (rows, columns), in degrees."""
    to_north, to_east = gradient(elevation, pixel_size)
    slope = np.degrees(np.arctan(np.hypot(to_north, to_east)))
    aspect = np.degrees(np.arctan2(-to_east, -to_north)) % 360
    return slope, aspect


def gradient(
    elevation: NDArray[np.floating], pixel_size: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rise per metre towards north and towards east; pixel_size is (dy, dx) in metres."""
    dy, dx = pixel_size
    to_south, to_east = np.gradient(np.asarray(elevation, np.float64), dy, dx)
    return np.negative(to_south), np.asarray(to_east)
