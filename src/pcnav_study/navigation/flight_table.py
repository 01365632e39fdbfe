"""A whole flight folder, frame by frame; no frame's fault ends the flight."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from pyproj import CRS

from pcnav_study.errors import InputError
from pcnav_study.frames.cameras import camera_from_file
from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_metadata
from pcnav_study.frames.maps import metric_crs
from pcnav_study.frames.poses import PoseRecord, pose_records
from pcnav_study.frames.suns import frame_time, map_sun
from pcnav_study.matching import METHODS
from pcnav_study.navigation.localise import Fix, FlightSettings, localise_frame
from pcnav_study.navigation.site import Site

COLUMNS = (
    "frame",
    "status",
    "easting",
    "northing",
    "latitude",
    "longitude",
    "quality",
    "alarm",
    "shift_row_px",
    "shift_col_px",
    "prior_error_m",
    "error_m",
    "method",
    "pixel_m",
    "crs",
    "recorded_easting",
    "recorded_northing",
    "centre_easting",
    "centre_northing",
    "heading_deg",
    "agreement",
    "iterations",
    "calibration",
    "sun",
    "pose_source",
    "pose_origins",
)


def localise_flight(
    folder: FlightFolder, settings: FlightSettings
) -> Iterator[tuple[dict[str, Any], Fix | None]]:
    """Place every frame in turn: its row (see ``COLUMNS``) and, if placed, its fix.

    Raises
    ------
    InputError
        Before the first frame, for what concerns the whole flight: the method, the map, the
        elevation model, the camera file, the pose tables.
    """
    if settings.method not in METHODS:
        raise InputError(
            f"flight.method {settings.method!r} is unknown; use one of {', '.join(METHODS)}"
        )
    site = Site(folder)
    short_crs = _short(site.crs)
    if folder.camera:
        camera_from_file(folder.camera)
    if folder.dem:
        metric_crs(folder.dem)
    map_note = map_sun(folder.reference)[1]
    metadata = {path.name: read_metadata(path) for path in folder.frames}
    records = pose_records(folder.frames, metadata, folder.camera_pose, folder.flight_log)
    rng = np.random.default_rng(settings.seed)
    offsets = settings.prior_offset_m * rng.standard_normal((len(folder.frames), 2))
    for path, offset in zip(folder.frames, offsets, strict=True):
        record = records[path.name]
        row: dict[str, Any] = dict.fromkeys(COLUMNS)
        row |= {"frame": path.name, "alarm": True, "method": settings.method, "crs": short_crs}
        row |= {"quality": 0.0, "pose_source": record.source, "pose_origins": record.origins}
        row |= {"calibration": "none", "sun": _sun_note(site, record, map_note)}
        try:
            recorded = np.array(site.position(record))
            row["prior_error_m"] = float(np.hypot(*offset))
            believed = recorded + offset
            at = (float(believed[0]), float(believed[1]))
            fix = localise_frame(site, path, metadata[path.name], record, at, settings)
        except InputError as error:
            yield row | {"status": str(error)}, None
        else:
            yield row | _placed(fix, recorded), fix


def flight_table(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows as a table with every column of ``COLUMNS``."""
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _placed(fix: Fix, recorded: NDArray[np.float64]) -> dict[str, Any]:
    """Row entries of a placed frame."""
    east, north = fix.position
    latitude, longitude = fix.fine.grid.to_wgs84(east, north)
    return {
        "status": f"alarm: {fix.reason}" if fix.alarm else "placed",
        "easting": round(east, 3),
        "northing": round(north, 3),
        "latitude": round(latitude, 8),
        "longitude": round(longitude, 8),
        "quality": round(fix.fine.result.quality, 6),
        "alarm": fix.alarm,
        "shift_row_px": round(float(fix.shift[0]), 4),
        "shift_col_px": round(float(fix.shift[1]), 4),
        "error_m": round(float(np.hypot(*(np.array(fix.position) - recorded))), 3),
        "pixel_m": round(fix.fine.grid.pixel_size[0], 4),
        "recorded_easting": round(float(recorded[0]), 3),
        "recorded_northing": round(float(recorded[1]), 3),
        "centre_easting": round(fix.centre[0], 3),
        "centre_northing": round(fix.centre[1], 3),
        "heading_deg": round(fix.yaw, 3),
        "agreement": round(fix.agreement, 3),
        "iterations": fix.iterations,
    }


def _sun_note(site: Site, record: PoseRecord, map_note: str) -> str:
    """Whether both suns are known, and if not, why."""
    if site.sun is None:
        return f"unknown: {map_note}"
    time, note = frame_time(record.time)
    return f"unknown: {note}" if time is None else f"known: map by {map_note}, frame by its time"


def _short(crs: str) -> str:
    """An authority code where the CRS has one, else its PROJ or WKT text."""
    known = CRS(crs)
    authority = known.to_authority()
    return ":".join(authority) if authority else known.name
