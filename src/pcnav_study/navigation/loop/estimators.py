"""What the UAV believes between fixes.

An estimator carries the position from one moment to the next, and takes a fix. Dead
reckoning is the simplest; odometry and Kalman filters are others.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from pcnav_study.navigation.loop.sensors import Instruments, Observation

Array = NDArray[np.float64]


class Belief(NamedTuple):
    """A position (east, north), metres, and its standard deviation on each axis."""

    position: Array
    sigma: float


class Estimator(Protocol):
    """Carries a belief through time."""

    def predict(self, seen: Observation) -> Belief:
        """The belief at the moment of an observation, before its frame is compared with a map."""
        ...

    def correct(self, position: Array, sigma: float, *, anew: bool = False) -> Belief:
        """The belief after a fix on the map; ``anew`` forgets where it was believed to be."""
        ...


class DeadReckoning:
    """Measured velocity times time. A fix replaces the belief: no error is handed on."""

    def __init__(self, start: Belief, instruments: Instruments) -> None:
        self._belief = start
        self._of = instruments
        self._bias_variance = instruments.velocity_bias**2

    def predict(self, seen: Observation) -> Belief:
        """The last position plus the way since; its error grows with the velocity's."""
        self._bias_variance += self._of.velocity_drift**2 * seen.seconds
        fresh = np.sqrt(self._bias_variance + self._of.velocity_noise**2) * seen.seconds
        position = self._belief.position + seen.velocity * seen.seconds
        # The bias is the same in every leg, so its part of the error adds up linearly.
        self._belief = Belief(position, self._belief.sigma + float(fresh))
        return self._belief

    def correct(self, position: Array, sigma: float, *, anew: bool = False) -> Belief:
        """The fix itself."""
        self._belief = Belief(position, sigma)
        return self._belief
