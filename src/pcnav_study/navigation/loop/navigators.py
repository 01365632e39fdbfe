"""Every navigator by name: five matchers on the map, and four without it or beside it."""

from __future__ import annotations

from collections.abc import Callable

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.closed_loop import Mission
from pcnav_study.navigation.loop.estimators import Belief, DeadReckoning
from pcnav_study.navigation.loop.fusion import Kalman
from pcnav_study.navigation.loop.lookout import Lookout
from pcnav_study.navigation.loop.navigator import Drifter, MapNavigator, Navigator
from pcnav_study.navigation.loop.odometry import Odometry

MATCHERS = ("pc-sectors", "pc", "pc-abs", "ncc", "mi")
Maker = Callable[[Mission], Navigator]


def _by_map(method: str, *, heeds_alarm: bool = True) -> Maker:
    def make(mission: Mission) -> Navigator:
        lookout = _lookout(mission, method)
        reckoning = DeadReckoning(Belief(*mission.start()), mission.instruments)
        return MapNavigator(
            lookout, reckoning, mission.pilot, _frame_px(mission), heeds_alarm=heeds_alarm
        )

    return make


def _by_odometry(*, relief: bool) -> Maker:
    def make(mission: Mission) -> Navigator:
        return Drifter(_odometry(mission, relief=relief), mission.pilot)

    return make


def _by_kalman(mission: Mission) -> Navigator:
    return Drifter(_kalman(mission), mission.pilot)


def _by_fusion(mission: Mission) -> Navigator:
    lookout = _lookout(mission, "pc-sectors")
    return MapNavigator(lookout, _kalman(mission), mission.pilot, _frame_px(mission))


NAVIGATORS: dict[str, Maker] = {
    **{method: _by_map(method) for method in MATCHERS},
    "pc-sectors, alarm off": _by_map("pc-sectors", heeds_alarm=False),
    "odometry": _by_odometry(relief=False),
    "odometry over relief": _by_odometry(relief=True),
    "odometry, Kalman": _by_kalman,
    "odometry and fixes, EKF": _by_fusion,
}


def navigator(name: str, mission: Mission) -> Navigator:
    """A navigator ready for take-off.

    Raises
    ------
    InputError
        For an unknown name.
    """
    if name not in NAVIGATORS:
        known = "; ".join(NAVIGATORS)
        raise InputError(f"navigator {name!r} is unknown; use one of: {known}")
    return NAVIGATORS[name](mission)


def _lookout(mission: Mission, method: str) -> Lookout:
    return Lookout(mission.chart, mission.scene.camera, method)


def _odometry(mission: Mission, *, relief: bool) -> Odometry:
    return Odometry(Belief(*mission.start()), _lookout(mission, "pc-sectors"), relief=relief)


def _kalman(mission: Mission) -> Kalman:
    return Kalman(Belief(*mission.start()), _odometry(mission, relief=True), mission.instruments)


def _frame_px(mission: Mission) -> float:
    return mission.frame_m / mission.chart.pixel
