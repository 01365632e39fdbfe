"""From a match to a position: of real frames, and in the closed loop of a simulated flight."""

from pcnav_study.navigation.agreement import agreement
from pcnav_study.navigation.calibration import Installation, calibrated, cross_validated, fit
from pcnav_study.navigation.flight_table import flight_table, localise_flight
from pcnav_study.navigation.footprints import footprint_collection
from pcnav_study.navigation.localise import Fix, FlightSettings, localise_frame, located
from pcnav_study.navigation.loop import (
    NAVIGATORS,
    Setup,
    fly_all,
    mission,
    navigation_summary,
    navigator,
    place,
)
from pcnav_study.navigation.pictures import flight_pictures
from pcnav_study.navigation.robustness import robustness_curves
from pcnav_study.navigation.site import Site

__all__ = [
    "NAVIGATORS",
    "Fix",
    "FlightSettings",
    "Installation",
    "Setup",
    "Site",
    "agreement",
    "calibrated",
    "cross_validated",
    "fit",
    "flight_pictures",
    "flight_table",
    "fly_all",
    "footprint_collection",
    "localise_flight",
    "localise_frame",
    "located",
    "mission",
    "navigation_summary",
    "navigator",
    "place",
    "robustness_curves",
]
