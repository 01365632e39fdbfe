"""The truth: air that moves, an aircraft in it, and what its camera sees.

Nothing here is known to the UAV; what is known comes through `sensors`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.render import render

Array = NDArray[np.float64]
SUBSTEP = 1.0  # s, in which the turbulence is stepped


@dataclass(frozen=True)
class Air:
    """Wind of a flight.

    Parameters
    ----------
    mean : (east, north)
        Metres per second.
    turbulence : float
        Standard deviation about the mean, each axis, metres per second.
    correlation_s : float
        Time after which the turbulence has lost 1/e of its memory: the Gauss-Markov model
        of low-altitude turbulence [1]_.

    References
    ----------
    .. [1] MIL-F-8785C (1980), section 3.7, Dryden form, first order.
    """

    mean: tuple[float, float] = (0.0, 0.0)
    turbulence: float = 0.0
    correlation_s: float = 20.0

    def __post_init__(self) -> None:
        if self.turbulence < 0 or not self.correlation_s > 0:
            raise InputError("turbulence must be 0 or more, and its correlation time positive")


@dataclass(frozen=True)
class Scene:
    """The ground under one sun, as the camera sees it.

    Parameters
    ----------
    radiance, elevation : DataArray (y, x)
        On one grid, in a metric CRS.
    camera : Camera
    height : float
        At which the UAV flies, metres above the elevation's datum.
    noise : float
        Standard deviation, as a share of a clear frame's own.
    haze : float
        Share, 0 to 1, of the contrast that the air swallows.
    """

    radiance: xr.DataArray
    elevation: xr.DataArray
    camera: Camera
    height: float
    noise: float = 0.01
    haze: float = 0.0

    def photograph(self, pose: Pose, rng: np.random.Generator) -> NDArray[np.float32]:
        """A frame (rows, columns); NaN where it sees off the map."""
        clear = render(self.radiance, self.elevation, self.camera, pose)
        seen = np.isfinite(clear)
        if not seen.any():
            return clear
        veiled = (1 - self.haze) * clear + self.haze * float(clear[seen].mean())
        grain = self.noise * float(clear[seen].std()) * rng.standard_normal(clear.shape)
        return np.asarray(veiled + grain, np.float32)


class Aircraft:
    """Where the UAV really is.

    Attributes
    ----------
    position : (east, north)
        Metres.
    velocity : (east, north)
        Over the ground, the mean of the last leg, metres per second.
    height, yaw, pitch, roll : float
        Metres; degrees.
    """

    def __init__(
        self,
        position: Array,
        height: float,
        yaw: float,
        air: Air,
        attitude_sigma: float,
        rng: np.random.Generator,
    ) -> None:
        self.position = np.array(position, np.float64)
        self.height, self.yaw, self.pitch, self.roll = height, yaw, 0.0, 0.0
        self._air, self._sigma, self._rng = air, attitude_sigma, rng
        self._gusts = air.turbulence * rng.standard_normal(2)
        self.velocity = np.array(air.mean) + self._gusts  # it hovers in the wind
        self._sway()

    @property
    def pose(self) -> Pose:
        """Of the camera."""
        place = (*self.position, self.height)
        return Pose.from_yaw_pitch_roll(place, self.yaw, self.pitch, self.roll)

    def fly(self, air_velocity: Array, seconds: float, push: Array) -> None:
        """Fly with a velocity through the air, carried by the wind, then pushed by metres."""
        steps = max(1, round(seconds / SUBSTEP))
        keep = np.exp(-seconds / steps / self._air.correlation_s)
        total = np.zeros(2)
        for _ in range(steps):
            fresh = self._air.turbulence * self._rng.standard_normal(2)
            self._gusts = keep * self._gusts + np.sqrt(1 - keep**2) * fresh
            total += self._gusts
        self.velocity = air_velocity + np.array(self._air.mean) + total / steps
        self.position = self.position + self.velocity * seconds + push
        if np.hypot(*air_velocity) > 0:
            self.yaw = float(np.degrees(np.arctan2(*air_velocity)) % 360)
        self._sway()

    def _sway(self) -> None:
        self.pitch, self.roll = (self._sigma * self._rng.standard_normal(2)).tolist()


def push_on_the_map(
    position: Array, distance: float, grid: Grid, margin: float, rng: np.random.Generator
) -> Array:
    """A displacement (east, north) in a random direction that stays ``margin`` m on the map.

    Where no direction does, the distance is halved until one does.
    """
    t, (rows, cols) = grid.transform, grid.shape
    low = np.array([t.c, t.f + t.e * rows]) + margin
    high = np.array([t.c + t.a * cols, t.f]) - margin
    while distance > 0:
        angles = 2 * np.pi * rng.random(64)
        pushes = distance * np.stack([np.sin(angles), np.cos(angles)], axis=1)
        ends = position + pushes
        fits = ((ends >= low) & (ends <= high)).all(axis=1)
        if fits.any():
            push: Array = pushes[int(fits.argmax())]
            return push
        distance = distance / 2 if distance > min(grid.pixel_size) else 0.0
    return np.zeros(2)
