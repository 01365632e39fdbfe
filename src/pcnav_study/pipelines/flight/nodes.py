"""Nodes of the flight pipeline."""

from __future__ import annotations

import logging

import pandas as pd

from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, flight_table, localise_flight
from pcnav_study.pipelines.parameters import Flight
from pcnav_study.progress import progress

logger = logging.getLogger(__name__)


def localise(flight: Flight) -> pd.DataFrame:
    """A row for each frame of the folder."""
    folder = FlightFolder.open(flight.folder, flight.reference, flight.dem)
    logger.info(
        "%d frames, map %s, %s", len(folder.frames), folder.reference, folder.dem or "no DEM"
    )
    settings = FlightSettings(**flight.model_dump(exclude={"folder", "reference", "dem"}))
    found = progress(localise_flight(folder, settings), "localising", len(folder.frames))
    table = flight_table([row for row, _ in found])
    for status, count in table["status"].value_counts().items():
        logger.info("%d of %d frames: %s", count, len(table), status)
    return table
