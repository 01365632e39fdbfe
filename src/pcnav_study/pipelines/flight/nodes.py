"""Nodes of the flight pipeline."""

from __future__ import annotations

import logging
from typing import Any

import pandas as pd
import xarray as xr

from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import (
    FlightSettings,
    Site,
    calibrated,
    flight_pictures,
    flight_table,
    footprint_collection,
    localise_flight,
)
from pcnav_study.pipelines.parameters import Flight
from pcnav_study.progress import progress

logger = logging.getLogger(__name__)
PLACES = {"folder", "reference", "dem", "pictures"}

Outputs = tuple[pd.DataFrame, dict[str, Any], dict[str, float], xr.Dataset]


def localise(flight: Flight) -> Outputs:
    """A row and a footprint for each frame, the constants used, and pictures of a few."""
    folder = FlightFolder.open(flight.folder, flight.reference, flight.dem)
    logger.info(
        "%d frames, map %s, %s", len(folder.frames), folder.reference, folder.dem or "no DEM"
    )
    settings = FlightSettings(**flight.model_dump(exclude=PLACES))
    found = list(progress(localise_flight(folder, settings), "localising", len(folder.frames)))
    fixes = {row["frame"]: fix for row, fix in found if fix is not None}
    table, constants = calibrated(
        flight_table([row for row, _ in found]), flight.calibration, Site(folder).crs
    )
    for status, count in table["status"].value_counts().items():
        logger.info("%d of %d frames: %s", count, len(table), status)
    footprints = footprint_collection(table, fixes, constants)
    pictures = flight_pictures(folder, table, fixes, flight.pictures)
    return table, footprints, constants.as_dict(), pictures
