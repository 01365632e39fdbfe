"""Window pairs of one relief under two suns, with the shift between them known.

The relief itself is displaced by a fraction of a pixel and shaded anew, so the truth is
sub-pixel and free of image interpolation; the whole pixels come from where the windows
are cut, so that their rims show different ground, as in flight.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.scene.relief import power_law_field
from pcnav_study.scene.shading import shade
from pcnav_study.scene.sun import SunPosition

Array = NDArray[np.float64]
RIM = 8  # px at the relief's border where the displaced relief is extrapolated


@dataclass(frozen=True)
class Conditions:
    """What differs between the two windows.

    Parameters
    ----------
    reference_sun, moving_sun : SunPosition
    noise : float
        Standard deviation, as a share of each picture's own.
    albedo_contrast : float
        Standard deviation of the reflectance over its mean; the same ground in both.
    albedo_change : float
        Share, 0 to 1, of the reflectance's variance that the moving picture has anew.
    shadows : bool
        With cast shadows.
    rotation : float
        Degrees by which the moving picture is turned, counter-clockwise.
    scale : float
        Its magnification.
    relief_displacement : float
        Px by which ground one standard deviation above the mean is displaced, along the
        columns, as a residual of rectification.
    """

    reference_sun: SunPosition
    moving_sun: SunPosition
    noise: float = 0.01
    albedo_contrast: float = 0.0
    albedo_change: float = 0.0
    shadows: bool = False
    rotation: float = 0.0
    scale: float = 1.0
    relief_displacement: float = 0.0


@dataclass(frozen=True)
class Trials:
    """Pairs and their truth: (n, size, size), (n, size, size) and (n, 2) row, column."""

    reference: NDArray[np.float32]
    moving: NDArray[np.float32]
    shift: Array


@dataclass
class Site:
    """A relief that trials are cut from; pictures of it are kept.

    Parameters
    ----------
    elevation : (rows, columns)
        Metres.
    pixel_size : (dy, dx)
        Metres.
    fraction : (row, column)
        Sub-pixel part of every shift.
    seed : int
        Of the reflectance.
    """

    elevation: Array
    pixel_size: tuple[float, float]
    fraction: tuple[float, float] = (0.37, -0.21)
    seed: int = 0
    _kept: dict[object, Array] = field(default_factory=dict, repr=False)

    def draw(self, conditions: Conditions, size: int, n: int, rng: np.random.Generator) -> Trials:
        """Cut ``n`` pairs at random places, |shift| up to a sixth of the window by axis.

        Raises
        ------
        InputError
            If the relief is too small for such windows.
        """
        reach = size // 6 - 1
        room = np.array(self.elevation.shape) - 2 * RIM - size
        if room.min() < reach:
            raise InputError(
                f"windows of {size} px do not fit a relief of {self.elevation.shape} px; "
                "lower the window size or give a larger relief"
            )
        fixed, moved = self._pictures(conditions)
        spread = [conditions.noise * p[RIM:-RIM, RIM:-RIM].std() for p in (fixed, moved)]
        references, movings, shifts = [], [], []
        for _ in range(n):
            whole = rng.integers(-reach, reach + 1, 2)
            first, last = np.maximum(0, -whole), room - np.maximum(0, whole)
            corner = RIM + rng.integers(first, last + 1)
            reference = _cut(fixed, corner, size)
            moving = self._seen(moved, corner + whole, size, conditions)
            references.append(reference + spread[0] * rng.standard_normal(reference.shape))
            movings.append(moving + spread[1] * rng.standard_normal(moving.shape))
            shifts.append(whole - self.fraction)
        return Trials(
            np.array(references, np.float32), np.array(movings, np.float32), np.array(shifts)
        )

    def _pictures(self, conditions: Conditions) -> tuple[Array, Array]:
        """The whole relief as reference, and displaced as moving picture."""
        c = conditions
        ground, later = self._reflectance(c.albedo_contrast, c.albedo_change)
        fixed = self._shaded(c.reference_sun, c.shadows, displaced=False) * ground
        moved = self._shaded(c.moving_sun, c.shadows, displaced=True) * self._displaced(later, 3)
        return fixed, moved

    def _shaded(self, sun: SunPosition, shadows: bool, *, displaced: bool) -> Array:
        key = (sun, shadows, displaced)
        if key not in self._kept:
            relief = self._displaced(self.elevation, 5) if displaced else self.elevation
            self._kept[key] = shade(relief, self.pixel_size, sun, shadows)
        return self._kept[key]

    def _displaced(self, image: Array, order: int) -> Array:
        moved: Array = ndimage.shift(image, self.fraction, order=order, mode="nearest")
        return moved

    def _reflectance(self, contrast: float, change: float) -> tuple[Array, Array]:
        rng = np.random.default_rng(self.seed)
        own, new = (power_law_field(self.elevation.shape, 1.2, rng) for _ in range(2))
        later = np.sqrt(1 - change) * own + np.sqrt(change) * new
        return np.clip(1 + contrast * own, 0, None), np.clip(1 + contrast * later, 0, None)

    def _seen(
        self, picture: Array, corner: NDArray[np.integer], size: int, conditions: Conditions
    ) -> Array:
        """The window at ``corner``, turned, magnified and displaced by relief about its middle."""
        c = conditions
        if c.rotation == 0 and c.scale == 1 and c.relief_displacement == 0:
            return _cut(picture, corner, size)
        middle = (size - 1) / 2
        rows, cols = np.indices((size, size)) - middle
        cos, sin = np.cos(np.radians(c.rotation)), np.sin(np.radians(c.rotation))
        at_rows = (cos * rows + sin * cols) / c.scale + middle + corner[0]
        at_cols = (-sin * rows + cos * cols) / c.scale + middle + corner[1]
        heights = (self.elevation - self.elevation.mean()) / self.elevation.std()
        above = ndimage.map_coordinates(heights, [at_rows, at_cols], order=1, mode="nearest")
        at_cols = at_cols + c.relief_displacement * above
        seen: Array = ndimage.map_coordinates(picture, [at_rows, at_cols], order=3, mode="nearest")
        return seen


def _cut(picture: Array, corner: NDArray[np.integer], size: int) -> Array:
    row, col = (int(v) for v in corner)
    return picture[row : row + size, col : col + size]
