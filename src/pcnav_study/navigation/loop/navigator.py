"""Decide: believe the fix, or raise the alarm and correct oneself, stage by stage.

The alarm has two causes: a match whose calibrated trust is too low, unless the forward part
of the frame, matched by itself, finds the same place; and a fix that the motion model
cannot explain (an innovation gate). Then the search is widened, next the whole frame is
used, and if neither is trusted the UAV holds on dead reckoning, returns towards the last
trusted point, and re-plans to the route as soon as it knows where it is. [ours]
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pcnav_study.navigation.loop.estimators import Belief, Estimator
from pcnav_study.navigation.loop.lookout import Lookout, Sight
from pcnav_study.navigation.loop.pilot import Pilot
from pcnav_study.navigation.loop.sensors import Observation

Array = NDArray[np.float64]
REACH_PX = 12  # of the ordinary search
GATE_SIGMAS = 4.0  # of the belief: what the motion model explains
GATE_PX = 3.0  # and at least so far
ACCORD_PX = 2.0  # forward part and whole agree within this distance
PLAUSIBLE = 0.02  # probability below which no accord helps
STAGES = (("found by a wider search", False), ("found by the whole frame", True))
HOLDS = 2  # alarms flown through on dead reckoning before turning back
FIX_PX = 0.3  # standard deviation of a fix on each axis


@dataclass(frozen=True)
class Decision:
    """What the UAV makes of one observation.

    Attributes
    ----------
    position, next_position : (east, north)
        Where it believes to be, and to be after the next leg, metres.
    target : (east, north)
        Where it steers.
    action : str
        "fix", "found by a wider search", "found by the whole frame", "hold", "return", or, of
        navigators without a map, "odometry".
    alarm : bool
    reason : str
        Why the alarm was raised; empty without one.
    note : str
        What else was decided, and why.
    trusted : bool
        False while the UAV does not know where it is.
    quality, probability : float
        Of the first fix, believed or not; NaN without one.
    sighted : (east, north) or None
        That fix.
    """

    position: Array
    next_position: Array
    target: Array
    action: str
    alarm: bool = False
    reason: str = ""
    note: str = ""
    trusted: bool = True
    quality: float = float("nan")
    probability: float = float("nan")
    sighted: Array | None = None


class Navigator(Protocol):
    """Makes a decision of each observation."""

    def step(self, seen: Observation) -> Decision:
        """Decide where the UAV is and where it flies."""
        ...


class Drifter:
    """Navigation without a map: whatever its estimator says."""

    def __init__(self, estimator: Estimator, pilot: Pilot) -> None:
        self._estimator, self._pilot = estimator, pilot

    def step(self, seen: Observation) -> Decision:
        """Believe the estimator."""
        belief = self._estimator.predict(seen)
        target = self._pilot.target(belief.position)
        return Decision(
            belief.position, self._pilot.reached(belief.position, target), target, "odometry"
        )


class MapNavigator:
    """Navigation by fixes on the map.

    Parameters
    ----------
    lookout : Lookout
    estimator : Estimator
    pilot : Pilot
    frame_px : float
        Width of a frame in map pixels: how far a gust may have pushed the UAV.
    heeds_alarm : bool
        False believes every fix, to see what the alarm is worth.
    """

    def __init__(
        self,
        lookout: Lookout,
        estimator: Estimator,
        pilot: Pilot,
        frame_px: float,
        *,
        heeds_alarm: bool = True,
    ) -> None:
        self._lookout, self._estimator, self._pilot = lookout, estimator, pilot
        self._wide = int(np.ceil(frame_px)) + REACH_PX
        self._heeds = heeds_alarm
        self._pixel = lookout.chart.pixel
        self._trusted_at: Array | None = None
        self._held = 0

    def step(self, seen: Observation) -> Decision:
        """Look, doubt, and correct."""
        belief = self._estimator.predict(seen)
        sight = self._lookout.look(seen, belief.position, REACH_PX)
        ahead = self._ahead(sight)
        reason = self._doubt(sight, ahead, belief)
        if not reason or not self._heeds:
            return self._accepted(sight, ahead, sight, "fix")
        for action, whole in STAGES:
            again = self._lookout.look(seen, belief.position, self._wide, whole=whole)
            ahead = self._ahead(again)
            if not self._distrust(again, ahead):
                away = float(np.hypot(*(again.position - belief.position)))
                note = f"{away:.0f} m ({away / self._pixel:.1f} px) from where it was believed"
                return self._accepted(again, ahead, sight, action, reason, note)
        return self._lost(belief, sight, reason)

    def _ahead(self, sight: Sight) -> Array | None:
        """Position by the forward part of the frame."""
        if sight.patch is None:
            return None
        target = self._pilot.target(sight.position)
        return self._lookout.ahead(sight, target, REACH_PX)

    def _doubt(self, sight: Sight, ahead: Array | None, belief: Belief) -> str:
        """Why the fix should not be believed; empty if it should."""
        reason = self._distrust(sight, ahead)
        if reason:
            return reason
        jump = float(np.hypot(*(sight.position - belief.position)))
        explained = max(GATE_SIGMAS * belief.sigma, GATE_PX * self._pixel)
        if jump > explained:
            return f"a jump of {jump:.0f} m, where the motion model explains {explained:.0f} m"
        return ""

    def _distrust(self, sight: Sight, ahead: Array | None) -> str:
        if sight.patch is None:
            return "the frame shows nothing that the map has"
        if not sight.trust.alarm:
            return ""
        apart = np.inf if ahead is None else np.hypot(*(ahead - sight.position)) / self._pixel
        if apart <= ACCORD_PX and sight.trust.probability >= PLAUSIBLE:
            return ""
        return f"right with a probability of only {sight.trust.probability:.2g}"

    def _accepted(
        self,
        sight: Sight,
        ahead: Array | None,
        first: Sight,
        action: str,
        reason: str = "",
        note: str = "",
    ) -> Decision:
        sigma = FIX_PX * self._pixel
        position = self._estimator.correct(sight.position, sigma, anew=bool(reason)).position
        self._trusted_at, self._held = position, 0
        target = self._pilot.target(position)
        leg = self._pilot.reached(position, target) - position
        return Decision(
            position,
            (position if ahead is None else ahead) + leg,
            target,
            action,
            alarm=bool(reason),
            reason=reason,
            note="; ".join(filter(None, (note, self._pilot.note(position)))),
            quality=first.quality,
            probability=first.trust.probability,
            sighted=first.position,
        )

    def _lost(self, belief: Belief, sight: Sight, reason: str) -> Decision:
        self._held += 1
        home = self._trusted_at
        if self._held <= HOLDS or home is None:
            action, target = "hold", self._pilot.target(belief.position)
        else:
            action, target = "return", home
        return Decision(
            belief.position,
            self._pilot.reached(belief.position, target),
            target,
            action,
            alarm=True,
            reason=reason,
            note=f"alarm number {self._held} in a row",
            trusted=False,
            quality=sight.quality,
            probability=sight.trust.probability,
            sighted=sight.position,
        )
