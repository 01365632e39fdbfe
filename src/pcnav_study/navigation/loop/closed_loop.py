"""Fly: the world moves, the instruments read it, the navigator decides, the pilot steers."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.chart import Chart
from pcnav_study.navigation.loop.navigator import Decision, Navigator
from pcnav_study.navigation.loop.pilot import Pilot
from pcnav_study.navigation.loop.sensors import Instruments, Sensors
from pcnav_study.navigation.loop.world import Air, Aircraft, Scene, push_on_the_map
from pcnav_study.scene.camera import Camera

Array = NDArray[np.float64]
BLIND = 0.5  # share of a frame that must show the map
PATIENCE = 3  # times the planned number of frames


@dataclass(frozen=True)
class Mission:
    """One flight, all of it but the navigator.

    Parameters
    ----------
    chart : Chart
        What the UAV has on board.
    scene : Scene
        What there really is.
    pilot : Pilot
    air : Air
    instruments : Instruments
    attitude_sigma : float
        Of the true pitch and roll, degrees.
    start_sigma_m : float
        Of the position believed at take-off, each axis.
    gust_m : float
        Metres by which one gust displaces the UAV; 0 for none.
    gust_step : int
        Frame before which it comes.
    failed_frames : frozenset of int
        Frames that come out black.
    give_up : int
        Alarms in a row after which the flight is lost.
    seed : int
        Fixes wind, instruments and noise; the same for whoever navigates.
    """

    chart: Chart
    scene: Scene
    pilot: Pilot
    air: Air
    instruments: Instruments
    attitude_sigma: float = 2.0
    start_sigma_m: float = 0.0
    gust_m: float = 0.0
    gust_step: int = 0
    failed_frames: frozenset[int] = field(default_factory=frozenset)
    give_up: int = 5
    seed: int = 0

    @property
    def frame_m(self) -> float:
        """Width of a frame on level ground, metres."""
        camera, level = self.scene.camera, self.chart.level
        return frame_width(camera, self.scene.height - level)

    def start(self) -> tuple[Array, float]:
        """Believed position (east, north) at take-off, and its standard deviation, metres."""
        error = self.start_sigma_m * self._stream(0).standard_normal(2)
        sigma = max(self.start_sigma_m, 0.1 * self.chart.pixel)
        return self.pilot.route.waypoints[0] + error, sigma

    def fly(self, navigator: Navigator) -> Iterator[dict[str, Any]]:
        """Rows of the flight's log, one for each frame, as they come.

        Truth and belief are in metres; ``ms`` is the navigator's own time. The flight ends
        at the route's end as the UAV believes it to be, off the map, after too many alarms
        in a row, or when it has taken three times as long as planned: the last row's
        ``ending`` says which.
        """
        aircraft = self._aircraft()
        sensors = Sensors(self.instruments, self._stream(2))
        gusts = self._stream(3)
        alarms, planned = 0, None
        planned_steps = int(np.ceil(self.pilot.route.length / self.pilot.leg_m)) + 1
        limit = PATIENCE * planned_steps
        seconds, velocity = 0.0, np.zeros(2)
        for step in range(limit):
            push = np.zeros(2)
            if step:
                if self.gust_m and step == self.gust_step:
                    push = self._push(aircraft, gusts)
                seconds = self.pilot.seconds
                aircraft.fly(velocity, seconds, push)
            seen = sensors.observe(aircraft, self.scene, seconds, failed=step in self.failed_frames)
            before = time.perf_counter()
            decision = navigator.step(seen)
            spent = time.perf_counter() - before
            wind = seen.velocity - velocity
            alarms = alarms + 1 if not decision.trusted else 0
            row = self._row(step, aircraft, push, decision, planned) | {"ms": 1e3 * spent}
            shown = float(np.isfinite(seen.frame).mean())
            row["ending"] = self._ending(decision, shown, alarms, step + 1 == limit)
            yield row
            if row["ending"]:
                return
            planned = decision.next_position
            velocity = self.pilot.air_velocity(decision.position, decision.target, wind)

    def checked(self) -> Mission:
        """The mission itself, if it can be flown.

        Raises
        ------
        InputError
            If the UAV would meet a summit, or the route leaves the map.
        """
        if self.scene.height <= float(self.scene.elevation.max()):
            raise InputError(
                f"a flight at {self.scene.height:.0f} m meets the summits at "
                f"{float(self.scene.elevation.max()):.0f} m; widen the frame or narrow the "
                "camera's field of view"
            )
        self.pilot.route.checked(self.chart.grid, self.frame_m / 2)
        return self

    def with_gust(self, metres: float, step: int) -> Mission:
        """The same flight with one gust."""
        return replace(self, gust_m=metres, gust_step=step)

    def _aircraft(self) -> Aircraft:
        first, second = self.pilot.route.waypoints[:2]
        yaw = float(np.degrees(np.arctan2(*(second - first))) % 360)
        return Aircraft(
            first, self.scene.height, yaw, self.air, self.attitude_sigma, self._stream(1)
        )

    def _push(self, aircraft: Aircraft, rng: np.random.Generator) -> Array:
        return push_on_the_map(
            aircraft.position, self.gust_m, self.chart.grid, 0.55 * self.frame_m, rng
        )

    def _ending(self, decision: Decision, shown: float, alarms: int, spent: bool) -> str:
        if shown < BLIND and not decision.trusted:
            return "left the map"
        if decision.trusted and self.pilot.is_over(decision.position):
            return "arrived"
        if alarms >= self.give_up:
            return f"lost after {alarms} alarms in a row"
        return "out of time" if spent else ""

    def _row(
        self, step: int, aircraft: Aircraft, push: Array, decision: Decision, planned: Array | None
    ) -> dict[str, Any]:
        truth, belief = aircraft.position, decision.position
        return {
            "step": step,
            "east": truth[0],
            "north": truth[1],
            "believed_east": belief[0],
            "believed_north": belief[1],
            "error_m": _distance(belief, truth),
            "sight_error_m": _distance(decision.sighted, truth),
            "next_error_m": _distance(planned, truth),
            "off_route_m": self.pilot.route.place(truth).off,
            "to_end_m": _distance(self.pilot.route.waypoints[-1], truth),
            "push_m": float(np.hypot(*push)),
            "footprint": self.scene.camera.footprint(aircraft.pose, self.chart.level).tolist(),
            "height": aircraft.height,
            "yaw": aircraft.yaw,
            "pitch": aircraft.pitch,
            "roll": aircraft.roll,
            "target_east": decision.target[0],
            "target_north": decision.target[1],
            "quality": decision.quality,
            "probability": decision.probability,
            "action": decision.action,
            "trusted": decision.trusted,
            "alarm": decision.alarm,
            "reason": decision.reason,
            "note": decision.note,
        }

    def _stream(self, number: int) -> np.random.Generator:
        return np.random.default_rng([self.seed, number])


def _distance(found: Array | None, truth: Array) -> float:
    return float("nan") if found is None else float(np.hypot(*(found - truth)))


def frame_width(camera: Camera, height: float) -> float:
    """Metres across the columns of a frame taken ``height`` m above level ground."""
    return camera.shape[1] / camera.focal_px * height
