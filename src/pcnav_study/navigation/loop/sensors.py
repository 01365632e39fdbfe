"""What the UAV knows: its instruments' readings, each with its own error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pcnav_study.navigation.loop.world import Aircraft, Scene

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Instruments:
    """Standard deviations of the instruments' errors.

    Parameters
    ----------
    attitude_deg : float
        Of yaw, pitch and roll, each, anew in every frame.
    height_bias_m, height_noise_m : float
        Of the barometric height: constant in a flight, and anew in every frame.
    velocity_bias, velocity_drift, velocity_noise : float
        Of the velocity over ground, each axis: at take-off, m/s; its random walk, m/s per
        square root of a second; and anew in every reading, m/s.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}  # refuse misspelt keys

    attitude_deg: float = 0.05
    height_bias_m: float = 10.0
    height_noise_m: float = 2.0
    velocity_bias: float = 0.5
    velocity_drift: float = 0.05
    velocity_noise: float = 0.1


@dataclass(frozen=True)
class Observation:
    """One moment as the UAV sees it.

    Attributes
    ----------
    frame : (rows, columns)
        NaN is no data.
    yaw, pitch, roll : float
        Measured, degrees.
    height : float
        Measured, metres above the elevation's datum.
    velocity : (east, north)
        Measured over the ground since the last moment, m/s; a gust's push is not in it.
    seconds : float
        Since the last moment.
    """

    frame: NDArray[np.float32]
    yaw: float
    pitch: float
    roll: float
    height: float
    velocity: Array
    seconds: float


class Sensors:
    """The instruments of one flight."""

    def __init__(self, instruments: Instruments, rng: np.random.Generator) -> None:
        self._of, self._rng = instruments, rng
        self._height_bias = instruments.height_bias_m * rng.standard_normal()
        self._velocity_bias = instruments.velocity_bias * rng.standard_normal(2)

    def observe(
        self, aircraft: Aircraft, scene: Scene, seconds: float, *, failed: bool = False
    ) -> Observation:
        """Read every instrument; a failed frame is black."""
        of, rng = self._of, self._rng
        walk = of.velocity_drift * np.sqrt(seconds) * rng.standard_normal(2)
        self._velocity_bias = self._velocity_bias + walk
        velocity = (
            aircraft.velocity + self._velocity_bias + of.velocity_noise * rng.standard_normal(2)
        )
        turned = of.attitude_deg * rng.standard_normal(3)
        height = aircraft.height + self._height_bias + of.height_noise_m * rng.standard_normal()
        frame = scene.photograph(aircraft.pose, rng)
        return Observation(
            np.zeros_like(frame) if failed else frame,
            aircraft.yaw + float(turned[0]),
            aircraft.pitch + float(turned[1]),
            aircraft.roll + float(turned[2]),
            float(height),
            velocity,
            seconds,
        )
