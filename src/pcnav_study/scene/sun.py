"""Where the sun stands, from place and time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
import pvlib

from pcnav_study.errors import InputError


@dataclass(frozen=True)
class SunPosition:
    """Azimuth clockwise from north and zenith from the vertical, both in degrees."""

    azimuth: float
    zenith: float

    def __post_init__(self) -> None:
        if not 0 <= self.zenith <= 180:
            raise InputError(f"sun zenith {self.zenith} is not within 0 to 180 degrees")

    @property
    def is_up(self) -> bool:
        """True above the geometric horizon."""
        return self.zenith < 90


def sun_position(time: str | pd.Timestamp, latitude: float, longitude: float) -> SunPosition:
    """Sun position after the NREL algorithm of pvlib [1]_.

    Parameters
    ----------
    time : str or Timestamp
        With its time zone, e.g. "2016-06-21 09:30-05:00".
    latitude, longitude : float
        WGS 84, in degrees.

    Raises
    ------
    InputError
        If the time cannot be read or has no time zone: local noon and UTC noon are other suns.

    References
    ----------
    .. [1] Reda and Andreas (2004), Solar Energy 76(5), 577-589.
    """
    try:
        stamp = pd.Timestamp(time)
    except ValueError as error:
        raise InputError(
            f"time {time!r} is no time; write it as in '2016-06-21 09:30-05:00'"
        ) from error
    if stamp.tzinfo is None:
        raise InputError(f"time {time!r} has no time zone; add one, as in '{stamp}+00:00'")
    row = pvlib.solarposition.get_solarposition(
        pd.DatetimeIndex([stamp]), latitude, longitude, method="nrel_numpy"
    ).iloc[0]
    return SunPosition(float(row["azimuth"]), float(row["zenith"]))


def azimuth_difference(one: SunPosition, other: SunPosition) -> float:
    """Unsigned difference of azimuth, 0 to 180 degrees."""
    return abs((one.azimuth - other.azimuth + 180) % 360 - 180)


def solar_time(day: str, hour: float, longitude: float) -> pd.Timestamp:
    """When a meridian's mean solar clock shows ``hour`` on ``day``: UTC, to the minute.

    Raises
    ------
    InputError
        If the day cannot be read.
    """
    try:
        midnight = pd.Timestamp(day).normalize()
    except ValueError as error:
        raise InputError(f"day {day!r} is no date; write it as in '2016-06-21'") from error
    if midnight.tzinfo is not None:
        raise InputError(f"day {day!r} has a time zone; give the date alone")
    moment = midnight + pd.Timedelta(hours=hour - longitude / 15)
    return moment.round("min").tz_localize("UTC")


def time_of_azimuth(
    day: str, azimuth: float, latitude: float, longitude: float, highest_zenith: float = 80.0
) -> pd.Timestamp:
    """Moment of a solar day, to the minute, at which the sun stands in an azimuth.

    Raises
    ------
    InputError
        If it never does with its zenith below ``highest_zenith``.
    """
    first = solar_time(day, 0.0, longitude)
    minutes = pd.date_range(first, periods=24 * 60, freq="min")
    path = pvlib.solarposition.get_solarposition(minutes, latitude, longitude, method="nrel_numpy")
    away = ((path["azimuth"] - azimuth + 180) % 360 - 180).abs()
    away = away.where(path["zenith"] < highest_zenith, np.inf)
    if not away.min() < 1.0:
        raise InputError(
            f"on {day} the sun never stands at azimuth {azimuth % 360:.0f} higher than "
            f"{90 - highest_zenith:.0f} degrees; choose a longer day or another map hour"
        )
    return pd.Timestamp(minutes[int(away.to_numpy().argmin())])
