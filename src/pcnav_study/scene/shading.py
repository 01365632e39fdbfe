"""Lambertian terrain shading with optional cast shadows."""

from __future__ import annotations

from typing import overload

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.scene.grid import Grid
from pcnav_study.scene.relief import gradient
from pcnav_study.scene.sun import SunPosition


@overload
def shade(
    elevation: xr.DataArray,
    pixel_size: tuple[float, float] | None = ...,
    sun: SunPosition = ...,
    shadows: bool = ...,
) -> xr.DataArray: ...
@overload
def shade(
    elevation: NDArray[np.floating],
    pixel_size: tuple[float, float] | None = ...,
    sun: SunPosition = ...,
    shadows: bool = ...,
) -> NDArray[np.float64]: ...
def shade(
    elevation: xr.DataArray | NDArray[np.floating],
    pixel_size: tuple[float, float] | None = None,
    sun: SunPosition = SunPosition(135, 45),  # noqa: B008  (frozen)
    shadows: bool = False,
) -> xr.DataArray | NDArray[np.float64]:
    """Radiance of a white Lambertian relief under one sun, 0 to 1 [1]_.

    ``I = max(0, cos(zenith) cos(slope) + sin(zenith) sin(slope) cos(azimuth - aspect))``

    Parameters
    ----------
    elevation : (rows, columns) array or DataArray
        Metres; row 0 is north, column 0 is west.
    pixel_size : (dy, dx), optional
        Metres. A DataArray in a metric CRS brings its own.
    sun : SunPosition
        Below the horizon the image is black.
    shadows : bool
        Also darken what other relief hides from the sun.

    References
    ----------
    .. [1] Horn (1981), Proceedings of the IEEE 69(1), 14-47.
    """
    if isinstance(elevation, xr.DataArray):
        size = pixel_size or Grid.of(elevation).pixel_size
        image: xr.DataArray = elevation.copy(data=shade(elevation.values, size, sun, shadows))
        return image.rename("radiance")
    size = pixel_size or (1.0, 1.0)
    if not sun.is_up:
        return np.zeros(elevation.shape)
    to_north, to_east = gradient(elevation, size)
    zenith, azimuth = np.radians([sun.zenith, sun.azimuth])
    towards_sun = -np.sin(zenith) * (np.sin(azimuth) * to_east + np.cos(azimuth) * to_north)
    radiance: NDArray[np.float64] = (np.cos(zenith) + towards_sun) / np.sqrt(
        1 + to_north**2 + to_east**2
    )
    radiance = np.maximum(radiance, 0.0)
    if shadows:
        radiance[cast_shadows(elevation, size, sun)] = 0.0
    return radiance


def cast_shadows(
    elevation: NDArray[np.floating], pixel_size: tuple[float, float], sun: SunPosition
) -> NDArray[np.bool_]:
    """True where another part of the relief stands between the ground and the sun.

    Marches from every pixel towards the sun in steps of the shorter pixel side; what
    lies beyond the grid casts no shadow.
    """
    heights = np.asarray(elevation, np.float64)
    dy, dx = pixel_size
    step = min(dy, dx)
    climb = step / np.tan(np.radians(max(sun.zenith, 1e-6)))
    azimuth = np.radians(sun.azimuth)
    # Rounded: the cosine of 90 degrees is not quite 0 and would march off the grid's rim.
    per_step = np.round([-np.cos(azimuth) * step / dy, np.sin(azimuth) * step / dx], 12)
    rows, cols = np.indices(heights.shape, dtype=np.float64)
    hidden = np.zeros(heights.shape, bool)
    relief = float(np.nanmax(heights) - np.nanmin(heights))
    across = int(np.hypot(heights.shape[0] * dy, heights.shape[1] * dx) / step)
    for k in range(1, min(int(relief / climb), across) + 2):
        at = [rows + k * per_step[0], cols + k * per_step[1]]
        obstacle = ndimage.map_coordinates(heights, at, order=1, cval=-np.inf)
        hidden |= obstacle > heights + k * climb
    return hidden
