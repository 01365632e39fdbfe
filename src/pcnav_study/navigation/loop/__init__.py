"""The closed loop: fly a route, find oneself, raise the alarm, come back."""

from pcnav_study.navigation.loop.fleet import (
    FlightTask,
    Light,
    flight_tasks,
    fly_all,
    lights_by_difference,
    lights_by_hour,
)
from pcnav_study.navigation.loop.navigators import MATCHERS, NAVIGATORS, navigator
from pcnav_study.navigation.loop.outcomes import drift_slopes, lost_from, navigation_summary
from pcnav_study.navigation.loop.route import Route
from pcnav_study.navigation.loop.sensors import Instruments
from pcnav_study.navigation.loop.setup import Setup, mission, place
from pcnav_study.navigation.loop.timing import step_times

__all__ = [
    "MATCHERS",
    "NAVIGATORS",
    "FlightTask",
    "Instruments",
    "Light",
    "Route",
    "Setup",
    "drift_slopes",
    "flight_tasks",
    "fly_all",
    "lights_by_difference",
    "lights_by_hour",
    "lost_from",
    "mission",
    "navigation_summary",
    "navigator",
    "place",
    "step_times",
]
