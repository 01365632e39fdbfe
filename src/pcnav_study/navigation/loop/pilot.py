"""Steer: towards the route, along it, and against the wind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.route import Route

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pilot:
    """Pure pursuit [1]_: aim at the point of the route one leg ahead of the nearest one.

    A UAV that was blown off its route so flies back to it without turning round.

    Parameters
    ----------
    route : Route
    leg_m : float
        Look-ahead, and the way between two frames, metres.
    seconds : float
        Between two frames.
    sprint : float
        Largest speed over the cruising speed.
    corridor_m : float
        Distance from the route within which the UAV is on it.

    References
    ----------
    .. [1] Coulter (1992), CMU-RI-TR-92-01.
    """

    route: Route
    leg_m: float
    seconds: float
    corridor_m: float
    sprint: float = 1.5

    def __post_init__(self) -> None:
        if not (self.leg_m > 0 and self.seconds > 0 and self.corridor_m > 0 and self.sprint >= 1):
            raise InputError(
                "leg, time between frames and corridor must be positive, and sprint at least 1"
            )

    def target(self, position: Array) -> Array:
        """Where to steer from a position."""
        return self.route.at(self.route.place(position).along + self.leg_m)

    def reached(self, position: Array, target: Array) -> Array:
        """Where the next leg towards a target ends."""
        way = target - position
        distance = float(np.hypot(*way))
        longest = self.sprint * self.leg_m
        end: Array = position + way * min(1.0, longest / max(distance, 1e-9))
        return end

    def air_velocity(self, position: Array, target: Array, wind: Array) -> Array:
        """Velocity through the air that carries the UAV along the next leg."""
        velocity: Array = (self.reached(position, target) - position) / self.seconds - wind
        return velocity

    def note(self, position: Array) -> str:
        """What is decided about the route; empty on it."""
        along, off = self.route.place(position)
        if off <= self.corridor_m:
            return ""
        return f"re-planned: {off:.0f} m off the route, back to it after {along:.0f} m"

    def is_over(self, position: Array) -> bool:
        """True where the route's end is nearer than an eighth of a leg."""
        return bool(np.hypot(*(position - self.route.waypoints[-1])) < self.leg_m / 8)
