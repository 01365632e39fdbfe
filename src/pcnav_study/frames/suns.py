"""Under which sun a map was imaged, and under which a frame was taken."""

from __future__ import annotations

from typing import Any

import pandas as pd
from pyproj import Transformer

from pcnav_study.errors import InputError
from pcnav_study.frames.maps import open_map
from pcnav_study.scene.sun import SunPosition, sun_position

# Azimuth tag, zenith tag, or the tag of an elevation above the horizon in its place.
SUN_TAGS = (
    ("MEAN_SOLAR_AZIMUTH_ANGLE", "MEAN_SOLAR_ZENITH_ANGLE", None),  # Sentinel-2
    ("SUN_AZIMUTH", None, "SUN_ELEVATION"),  # Landsat
    ("view:sun_azimuth", None, "view:sun_elevation"),  # STAC
    ("NITF_USE00A_SUN_AZ", None, "NITF_USE00A_SUN_EL"),
)
# A date tag, and the tag of the time of day where that is kept apart.
TIME_TAGS = (
    ("system-time_start", None),
    ("ACQUISITIONDATETIME", None),
    ("DATE_ACQUIRED", "SCENE_CENTER_TIME"),
    ("datetime", None),
    ("TIFFTAG_DATETIME", None),
)


def map_sun(path: str) -> tuple[SunPosition | None, str]:
    """The sun of a map, and in words where it is known from.

    Tags that give the sun go before tags that give the time of acquisition; satellites
    keep UTC, but a bare TIFF time without zone is not believed.

    Raises
    ------
    InputError
        If the map cannot be opened or has no CRS.
    """
    with open_map(path) as raster:
        tags = {key: value for space in _spaces(raster) for key, value in space.items()}
        middle = raster.transform @ (raster.width / 2, raster.height / 2)
        lon, lat = Transformer.from_crs(raster.crs, 4326, always_xy=True).transform(*middle)
    for azimuth, zenith, elevation in SUN_TAGS:
        try:
            height = 90 - float(tags[zenith]) if zenith else float(tags[str(elevation)])
            return SunPosition(float(tags[azimuth]), 90 - height), f"tag {azimuth}"
        except (KeyError, ValueError, InputError):
            continue
    for date, hour in TIME_TAGS:
        time = _time(tags, date, hour)
        if time is not None:
            return sun_position(time, lat, lon), f"tag {date}"
    return None, "the map's tags tell neither sun nor time"


def frame_time(metadata: dict[str, Any]) -> tuple[pd.Timestamp | None, str]:
    """When a frame was taken, with its time zone; otherwise why that is not known."""
    text, zone = metadata.get("time"), metadata.get("utc_offset")
    if not text:
        return None, "no time recorded"
    if str(text)[4:5] == str(text)[7:8] == ":":  # EXIF writes 2024:10:30 10:05:15
        text = f"{text[:4]}-{text[5:7]}-{text[8:]}"
    try:
        stamp = pd.Timestamp(f"{text}{zone or ''}")
    except ValueError:
        return None, f"time {text!r} cannot be read"
    if stamp is pd.NaT:
        return None, f"time {text!r} cannot be read"
    if stamp.tzinfo is None:
        return None, "time zone missing"
    return stamp, "recorded"


def frame_sun(
    metadata: dict[str, Any], latitude: float, longitude: float
) -> tuple[SunPosition | None, str]:
    """The sun of a frame from its own time and place; otherwise why it is not known."""
    time, note = frame_time(metadata)
    if time is None:
        return None, note
    return sun_position(time, latitude, longitude), note


def _spaces(raster: Any) -> list[dict[str, str]]:
    """Tags of a raster's namespaces, the most general last so that it wins."""
    return [raster.tags(ns=ns) for ns in ("IMAGERY", "EXIF")] + [raster.tags()]


def _time(tags: dict[str, str], date: str, hour: str | None) -> pd.Timestamp | None:
    if date not in tags or (hour and hour not in tags):
        return None
    text = tags[date] + (f"T{tags[hour]}" if hour else "")
    try:
        stamp = pd.Timestamp(int(text), unit="ms", tz="UTC") if text.isdigit() else None
        stamp = stamp if stamp is not None else pd.Timestamp(text)
    except (ValueError, OverflowError):
        return None
    if stamp is pd.NaT or stamp.tzinfo is None:
        return None
    return stamp
