"""From a match to a position."""

from pcnav_study.navigation.agreement import agreement
from pcnav_study.navigation.calibration import Installation, calibrated, cross_validated, fit
from pcnav_study.navigation.flight_table import flight_table, localise_flight
from pcnav_study.navigation.footprints import footprint_collection
from pcnav_study.navigation.localise import Fix, FlightSettings, localise_frame, located
from pcnav_study.navigation.pictures import flight_pictures
from pcnav_study.navigation.robustness import robustness_curves
from pcnav_study.navigation.site import Site

__all__ = [
    "Fix",
    "FlightSettings",
    "Installation",
    "Site",
    "agreement",
    "calibrated",
    "cross_validated",
    "fit",
    "flight_pictures",
    "flight_table",
    "footprint_collection",
    "localise_flight",
    "localise_frame",
    "located",
    "robustness_curves",
]
