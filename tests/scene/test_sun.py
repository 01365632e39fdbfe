"""The sun's position against textbook spherical astronomy."""

import numpy as np
import pandas as pd
import pytest

from pcnav_study.errors import InputError
from pcnav_study.scene import SunPosition, azimuth_difference, sun_position


def textbook_sun(time: str, latitude: float, longitude: float):
    """Azimuth and zenith from Spencer's (1971) declination and equation of time."""
    utc = pd.Timestamp(time).tz_convert("UTC")
    hours = utc.hour + utc.minute / 60 + utc.second / 3600
    g = 2 * np.pi / (366 if utc.is_leap_year else 365) * (utc.day_of_year - 1 + (hours - 12) / 24)
    declination = (
        0.006918
        - 0.399912 * np.cos(g)
        + 0.070257 * np.sin(g)
        - 0.006758 * np.cos(2 * g)
        + 0.000907 * np.sin(2 * g)
        - 0.002697 * np.cos(3 * g)
        + 0.00148 * np.sin(3 * g)
    )
    minutes = 229.18 * (
        0.000075
        + 0.001868 * np.cos(g)
        - 0.032077 * np.sin(g)
        - 0.014615 * np.cos(2 * g)
        - 0.040849 * np.sin(2 * g)
    )
    hour_angle = np.radians(15 * (hours + minutes / 60 - 12) + longitude)
    lat = np.radians(latitude)
    east = -np.cos(declination) * np.sin(hour_angle)
    north = np.cos(lat) * np.sin(declination) - np.sin(lat) * np.cos(declination) * np.cos(
        hour_angle
    )
    up = np.sin(lat) * np.sin(declination) + np.cos(lat) * np.cos(declination) * np.cos(hour_angle)
    return np.degrees(np.arctan2(east, north)) % 360, np.degrees(np.arccos(up))


PLACES = {
    "Tennessee": (36.59, -84.25),
    "South Africa": (-33.6, 24.3),
    "Taiwan": (24.26, 120.72),
    "Norway": (69.6, 18.9),
}
TIMES = [
    "2016-03-20 09:30-05:00",
    "2016-06-21 15:00+02:00",
    "2015-10-03 07:58+00:00",
    "2024-12-21 08:15+08:00",
]


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("place", PLACES)
def test_azimuth_and_zenith_follow_declination_and_hour_angle(place, time):
    sun = sun_position(time, *PLACES[place])
    azimuth, zenith = textbook_sun(time, *PLACES[place])
    assert sun.zenith == pytest.approx(zenith, abs=0.5)
    off = (sun.azimuth - azimuth + 180) % 360 - 180
    assert abs(off) * np.sin(np.radians(zenith)) < 0.5


def test_the_sun_of_a_satellite_scene_is_the_one_in_its_metadata():
    """Landsat 8 over 33.65 S 24.4 E, 2015-09-23 08:10 UTC: azimuth 47.0, elevation 46.2."""
    sun = sun_position("2015-09-23 08:10+00:00", -33.65, 24.4)
    assert sun.azimuth == pytest.approx(47.0, abs=1)
    assert sun.zenith == pytest.approx(90 - 46.2, abs=1)


def test_the_sun_goes_from_east_through_south_to_west_in_the_northern_hemisphere():
    day = [sun_position(f"2016-03-20 {h:02}:00-05:00", 36.6, -84.25) for h in (8, 12, 18)]
    assert day[0].azimuth < 120 < day[1].azimuth < 240 < day[2].azimuth
    assert day[1].zenith < min(day[0].zenith, day[2].zenith)


def test_equal_instants_in_different_zones_have_one_sun():
    assert sun_position("2016-06-21 09:30-05:00", 10, 20) == sun_position(
        "2016-06-21 14:30+00:00", 10, 20
    )


def test_a_timestamp_is_as_good_as_text():
    stamp = pd.Timestamp("2016-06-21 09:30", tz="America/New_York")
    assert sun_position(stamp, 10, 20) == sun_position("2016-06-21 09:30-04:00", 10, 20)


def test_a_time_without_zone_is_refused_with_the_remedy():
    with pytest.raises(InputError, match=r"2016-06-21 09:30.*time zone.*\+00:00"):
        sun_position("2016-06-21 09:30", 36, -84)


@pytest.mark.parametrize("text", ["noon", "2016-13-45 09:30+00:00"])
def test_what_is_no_time_is_refused_by_name(text):
    with pytest.raises(InputError, match=text.split("+")[0]):
        sun_position(text, 36, -84)


@pytest.mark.parametrize("zenith", [-1, 181, float("nan")])
def test_an_impossible_zenith_is_refused(zenith):
    with pytest.raises(InputError, match="zenith"):
        SunPosition(10, zenith)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [(10, 350, 20), (350, 10, 20), (0, 180, 180), (90, 90, 0), (359, 1, 2), (45, 300, 105)],
)
def test_azimuth_differences_go_the_short_way_round(one, other, expected):
    assert azimuth_difference(SunPosition(one, 40), SunPosition(other, 70)) == pytest.approx(
        expected
    )


@pytest.mark.parametrize(("zenith", "up"), [(0, True), (89.9, True), (90, False), (120, False)])
def test_the_sun_is_up_above_the_horizon_alone(zenith, up):
    assert SunPosition(0, zenith).is_up is up
