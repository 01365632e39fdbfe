"""From a match to a position."""

from pcnav_study.navigation.flight_table import flight_table, localise_flight
from pcnav_study.navigation.localise import Fix, FlightSettings, Site, localise_frame, located

__all__ = [
    "Fix",
    "FlightSettings",
    "Site",
    "flight_table",
    "localise_flight",
    "localise_frame",
    "located",
]
