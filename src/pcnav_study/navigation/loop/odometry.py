"""Visual odometry: how far the ground moved between two frames.

Both frames are rectified where they are believed to be, over the same map pixels; what is
left between them is the error of the believed way. It needs no map and no sun, but every
error stays in the sum. Over level ground the relief's parallax passes for motion; with the
ground's height known, relief-constrained odometry takes it out. [literature: the idea of
geo-referenced SLAM over a known elevation model; the form is ours]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching import match
from pcnav_study.navigation.loop.estimators import Belief
from pcnav_study.navigation.loop.lookout import Lookout
from pcnav_study.navigation.loop.patch import SMALLEST_PX, Patch
from pcnav_study.navigation.loop.sensors import Observation

Array = NDArray[np.float64]
REACH_PX = 12
SIGMA_PX = 0.2  # of one frame-to-frame match, each axis


class Odometry:
    """Sums the way from frame to frame, starting from dead reckoning's guess.

    Parameters
    ----------
    start : Belief
    lookout : Lookout
        Its camera and elevation serve; its reference picture is not looked at.
    relief : bool
        True rectifies over the elevation model, False over level ground at its mean height.

    Attributes
    ----------
    pixel : float
        Of the map, metres.
    """

    def __init__(self, start: Belief, lookout: Lookout, *, relief: bool) -> None:
        self._belief, self._lookout = start, lookout
        self._ground = None if relief else lookout.chart.level
        self._last: Observation | None = None
        self.pixel = lookout.chart.pixel

    def predict(self, seen: Observation) -> Belief:
        """The last position plus the way as the frames show it."""
        guess = self._belief.position + seen.velocity * seen.seconds
        way = self.way(seen, self._belief.position, guess)
        sigma = float(np.hypot(self._belief.sigma, SIGMA_PX * self.pixel))
        self._belief = Belief(self._belief.position + way, sigma)
        return self._belief

    def way(self, seen: Observation, start: Array, guess: Array) -> Array:
        """Displacement (east, north) since the last frame; the guessed one if none is seen."""
        before, self._last = self._last, seen
        if before is None:
            return guess - start
        try:
            one = self._lookout.rectified(before, start, ground=self._ground)
            other = self._lookout.rectified(seen, guess, ground=self._ground)
            reference, moving = _common(one, other)
            result = match(reference, moving, self._lookout.method, max_shift=REACH_PX)
        except InputError:  # no common ground
            return guess - start
        dy, dx = self._lookout.chart.grid.pixel_size
        shown: Array = guess - start + np.array([result.shift[1] * dx, -result.shift[0] * dy])
        return shown

    def correct(self, position: Array, sigma: float, *, anew: bool = False) -> Belief:
        """The fix itself."""
        self._belief = Belief(position, sigma)
        return self._belief


def _common(one: Patch, other: Patch) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """The map pixels that both patches cover."""
    firsts, lasts = [], []
    for axis in (0, 1):
        firsts.append(max(one.corner[axis], other.corner[axis]))
        ends = [p.corner[axis] + p.values.shape[axis] for p in (one, other)]
        lasts.append(min(ends))
    shape = (lasts[0] - firsts[0], lasts[1] - firsts[1])
    if min(shape) < SMALLEST_PX:
        raise InputError("two frames have no ground in common")
    cuts = [
        p.part((firsts[0] - p.corner[0], firsts[1] - p.corner[1]), shape).values
        for p in (one, other)
    ]
    return cuts[0], cuts[1]
