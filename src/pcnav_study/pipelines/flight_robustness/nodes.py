"""Nodes of the robustness pipeline."""

from __future__ import annotations

import pandas as pd

from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, robustness_curves
from pcnav_study.pipelines.flight.nodes import PLACES
from pcnav_study.pipelines.parameters import Flight, FlightRobustness


def measure_robustness(flight: Flight, robustness: FlightRobustness) -> pd.DataFrame:
    """Success and alarms of a flight's frames under growing damage."""
    folder = FlightFolder.open(flight.folder, flight.reference, flight.dem)
    settings = FlightSettings(**flight.model_dump(exclude=PLACES))
    return robustness_curves(folder, settings, **robustness.model_dump())
