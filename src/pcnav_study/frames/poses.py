"""Where each frame was taken, from the sources a flight folder may hold.

``camera_pose.csv`` (photogrammetric) goes before ``flight_log.csv``, and that before the
frame's own XMP and EXIF; values that a source lacks are taken from the next.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from pcnav_study.errors import InputError

POSE_COLUMNS = {
    "easting_m": "easting",
    "northing_m": "northing",
    "altitude_m": "altitude",
    "omega_deg": "omega",
    "phi_deg": "phi",
    "kappa_deg": "kappa",
}
LOG_COLUMNS = {
    "latitude_deg": "latitude",
    "longitude_deg": "longitude",
    "gps_altitude_m": "altitude",
    "height_above_ground_m": "height_above_ground",
    "flight_yaw_deg": "yaw",
}


@dataclass(frozen=True)
class PoseRecord:
    """What is known of a frame's pose: values by name, and each value's origin.

    Names: ``easting``, ``northing`` (map CRS) or ``latitude``, ``longitude``; ``altitude``
    (above the vertical datum) and ``height_above_ground`` in metres; ``omega``, ``phi``,
    ``kappa`` or ``yaw``, ``pitch``, ``roll`` of the camera in degrees. ``time`` holds the
    texts ``time`` and, if recorded apart, ``utc_offset``.
    """

    frame: str
    values: dict[str, float] = field(default_factory=dict)
    sources: dict[str, str] = field(default_factory=dict)
    time: dict[str, str] = field(default_factory=dict)

    def offer(self, source: str, values: dict[str, float]) -> None:
        """Add the values not known from a better source."""
        for name, value in values.items():
            if name not in self.values and np.isfinite(value):
                self.values[name] = value
                self.sources[name] = source

    def turned(self, degrees: float) -> PoseRecord:
        """The same record with its heading wrong by that much, clockwise."""
        signs = {"yaw": 1, "kappa": -1}  # kappa runs the other way
        values = {k: v + degrees * signs.get(k, 0) for k, v in self.values.items()}
        return PoseRecord(self.frame, values, self.sources, self.time)

    @property
    def has_position(self) -> bool:
        """True if the horizontal position is known."""
        return {"easting", "northing"} <= self.values.keys() or {
            "latitude",
            "longitude",
        } <= self.values.keys()

    @property
    def source(self) -> str:
        """The sources used, best first, as text."""
        return "+".join(dict.fromkeys(v for k, v in self.sources.items() if k != "time"))

    @property
    def origins(self) -> str:
        """Every value's origin, as text: "latitude: flight_log.csv; yaw: XMP"."""
        return "; ".join(f"{name}: {source}" for name, source in self.sources.items())

    def take_time(self, source: str, time: dict[str, str]) -> None:
        """Take the time of the best source that has one."""
        if time.get("time") and not self.time:
            self.time.update(time)
            self.sources["time"] = source


def pose_records(
    frames: tuple[Path, ...],
    metadata: dict[str, dict[str, Any]],
    camera_pose: Path | None = None,
    flight_log: Path | None = None,
) -> dict[str, PoseRecord]:
    """Pose of every frame, keyed by file name, in the frames' order.

    Raises
    ------
    InputError
        If a CSV lacks a column or holds text where a number belongs.
    """
    poses = {} if camera_pose is None else _read(camera_pose, tuple(POSE_COLUMNS))
    log = {} if flight_log is None else _read(flight_log, ("latitude_deg", "longitude_deg"))
    records = {}
    for path in frames:
        record = PoseRecord(path.name)
        row = poses.get(path.name, poses.get(path.stem))
        if row:
            record.offer("camera_pose.csv", {n: row[k] for k, n in POSE_COLUMNS.items()})
        row = log.get(path.name, log.get(path.stem))
        if row:
            record.offer("flight_log.csv", {v: row[k] for k, v in LOG_COLUMNS.items() if k in row})
        seen = metadata.get(path.name, {})
        record.offer("XMP", _from_xmp(seen.get("xmp", {})))
        names = ("latitude", "longitude", "altitude")
        record.offer("EXIF", {name: seen[name] for name in names if name in seen})
        record.take_time("flight_log.csv", {"time": str((row or {}).get("time", "") or "")})
        record.take_time("EXIF GPS", {"time": seen.get("gps_time", "")})
        record.take_time("EXIF", {k: seen[k] for k in ("time", "utc_offset") if k in seen})
        records[path.name] = record
    return records


def _read(path: Path, required: tuple[str, ...]) -> dict[str, dict[str, Any]]:
    """Numeric columns of a CSV by frame."""
    try:
        table = pd.read_csv(path, dtype={"frame": str})
    except (ValueError, UnicodeDecodeError) as error:
        raise InputError(f"{path} cannot be read as CSV ({error}); correct it") from error
    missing = [name for name in ("frame", *required) if name not in table]
    if missing:
        raise InputError(f"{path} lacks the column {', '.join(missing)}; add it")
    twice = table["frame"][table["frame"].duplicated()]
    if len(twice):
        raise InputError(f"{path} lists frame {twice.iloc[0]} twice; keep one row for each frame")
    for name in table.columns.intersection([*POSE_COLUMNS, *LOG_COLUMNS]):
        numbers = pd.to_numeric(table[name], errors="coerce")
        bad = table["frame"][numbers.isna() & table[name].notna()]
        if len(bad):
            raise InputError(f"{path} column {name}, frame {bad.iloc[0]}: not a number; correct it")
        table[name] = numbers
    kept = table.select_dtypes("number").assign(frame=table["frame"])
    if "time" in table:
        kept["time"] = table["time"].astype(object).where(table["time"].notna(), "").astype(str)
    return {str(k): row for k, row in kept.set_index("frame").to_dict("index").items()}


def _from_xmp(xmp: dict[str, str]) -> dict[str, float]:
    """Drone values of XMP (DJI's names).

    A gimbal whose three angles are all zero was not recorded: it would look at the
    horizon. The camera is then taken to look straight down, turned as the aircraft.
    """

    def number(name: str) -> float:
        try:
            return float(xmp.get(name, "nan"))
        except ValueError:
            return float("nan")

    values = {
        "height_above_ground": number("RelativeAltitude"),
        "altitude": number("AbsoluteAltitude"),
        "yaw": number("FlightYawDegree"),
    }
    gimbal = [number(f"Gimbal{axis}Degree") for axis in ("Yaw", "Pitch", "Roll")]
    if np.isfinite(gimbal).all() and np.any(gimbal):
        values |= {"yaw": gimbal[0], "pitch": gimbal[1] + 90.0, "roll": gimbal[2]}
    return values
