"""Window pairs of known shift: one relief, two suns, two noises.

The part of a pixel is put into the heights by a spline before they are shaded, the whole
pixels by where the windows are cut, so the rims show different ground, as in flight.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.scene import SunPosition, fractal_albedo, shade

MARGIN = 8  # px at the edge of a scene that no window shows


@dataclass(frozen=True, eq=False)
class Scene:
    """A relief: heights (rows, columns) in metres, pixel size (dy, dx) in metres."""

    name: str
    heights: NDArray[np.floating]
    pixel_size: tuple[float, float]


@dataclass(frozen=True)
class Cell:
    """One setting of the light, the camera and the window.

    Attributes
    ----------
    azimuth_difference, azimuth : float
        Degrees between the suns, and azimuth of the reference's.
    zenith, zenith_difference : float
        Degrees, of the reference's sun, and how much lower the moving image's stands.
    noise : float
        Standard deviation of the sensor's noise, in units of the image's.
    albedo : float
        Contrast (standard deviation over mean) of a reflectance that the sun cannot move.
    shadows : bool
        Cast shadows.
    size : int
        Side of the square windows, px.
    largest_shift : float
        Along each axis, as a share of ``size``.
    """

    azimuth_difference: float = 0.0
    azimuth: float = 101.0
    zenith: float = 45.0
    zenith_difference: float = 0.0
    noise: float = 0.01
    albedo: float = 0.0
    shadows: bool = False
    size: int = 128
    largest_shift: float = 1 / 6

    @property
    def suns(self) -> tuple[SunPosition, SunPosition]:
        """Of the reference and of the moving image."""
        other = (self.azimuth + self.azimuth_difference) % 360
        return (
            SunPosition(self.azimuth % 360, self.zenith),
            SunPosition(other, self.zenith + self.zenith_difference),
        )


class KnownPair(NamedTuple):
    """Two float32 windows and the shift (row, column) that registers the second."""

    reference: NDArray[np.float32]
    moving: NDArray[np.float32]
    shift: NDArray[np.float64]


def window_pairs(scene: Scene, cell: Cell, n: int, rng: np.random.Generator) -> list[KnownPair]:
    """``n`` pairs at random places with random shifts.

    Raises
    ------
    InputError
        If the scene is too small for the windows and their shifts.
    """
    part = tuple(float(p) for p in np.round(rng.uniform(-0.5, 0.5, 2), 3))
    one, other = (
        _image(scene, sun, at, cell.shadows, cell.albedo)
        for sun, at in zip(cell.suns, ((0.0, 0.0), part), strict=True)
    )
    reach = int(cell.largest_shift * cell.size - 0.5)
    room = np.array(one.shape) - 2 * MARGIN - cell.size
    if (room <= reach).any():
        raise InputError(
            f"scene {scene.name} of {one.shape} px is too small for {cell.size} px windows"
        )
    pairs = []
    for _ in range(n):
        whole = rng.integers(-reach, reach + 1, 2)
        corner = MARGIN + rng.integers(np.maximum(0, whole), room - np.maximum(0, -whole) + 1)
        windows = []
        for image, at in ((one, corner), (other, corner - whole)):
            cut = image[at[0] : at[0] + cell.size, at[1] : at[1] + cell.size]
            noise = cell.noise * image.std() * rng.standard_normal(cut.shape)
            windows.append((cut + noise).astype(np.float32))
        pairs.append(KnownPair(windows[0], windows[1], -(whole + np.array(part))))
    return pairs


@lru_cache(maxsize=16)
def _image(
    scene: Scene, sun: SunPosition, part: tuple[float, ...], shadows: bool, contrast: float
) -> NDArray[np.float64]:
    """Radiance of the scene moved by a part of a pixel."""
    albedo = fractal_albedo(scene.heights.shape, contrast, np.random.default_rng(7))
    heights = np.asarray(scene.heights, np.float64)
    if any(part):
        heights = ndimage.shift(heights, part, order=5, mode="nearest")
        albedo = ndimage.shift(albedo, part, order=3, mode="nearest")
    return shade(heights, scene.pixel_size, sun, shadows) * albedo
