"""Many flights under many suns, each navigator on the same ones."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

import pandas as pd
import xarray as xr

from pcnav_study.navigation.loop.navigators import navigator
from pcnav_study.navigation.loop.setup import Setup, mission, place
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.sun import (
    SunPosition,
    azimuth_difference,
    solar_time,
    sun_position,
    time_of_azimuth,
)

ALBEDO = 7  # seed of the ground's reflectance
WITHOUT_MAP = ("odometry", "odometry over relief", "odometry, Kalman")


@dataclass(frozen=True)
class Light:
    """The suns of map and flight, when the flight's is (UTC), and in which sweep.

    ``sweep`` is "difference" or "hour".
    """

    map_sun: SunPosition
    flight_sun: SunPosition
    time: str
    sweep: str = "difference"

    @property
    def difference(self) -> float:
        """Of the azimuths, degrees, 0 to 180."""
        return azimuth_difference(self.map_sun, self.flight_sun)


@dataclass(frozen=True)
class FlightTask:
    """Flights of one navigator over one site under one light; one for each seed."""

    site: str
    light: Light
    gust: float
    method: str
    seeds: tuple[int, ...]
    setup: Setup


def lights_by_difference(
    elevation: xr.DataArray, day: str, map_hour: float, differences: Iterable[float]
) -> list[Light]:
    """Times of one day at which the sun stands so many degrees from where it stood on the map.

    Parameters
    ----------
    map_hour : float
        Mean solar time of the map.

    Raises
    ------
    InputError
        If the sun is down at the map's hour, or never so far from it by day.
    """
    latitude, longitude = _middle(elevation)
    mapped = solar_time(day, map_hour, longitude)
    sun = sun_position(mapped, latitude, longitude)
    times = [
        mapped if not d else time_of_azimuth(day, sun.azimuth + d, latitude, longitude)
        for d in differences
    ]
    return [Light(sun, sun_position(t, latitude, longitude), f"{t:%Y-%m-%d %H:%MZ}") for t in times]


def lights_by_hour(
    elevation: xr.DataArray, day: str, map_hour: float, hours: Iterable[float], lowest: float
) -> list[Light]:
    """The hours (mean solar time) of one day at which the sun is above ``lowest`` degrees."""
    latitude, longitude = _middle(elevation)
    sun = sun_position(solar_time(day, map_hour, longitude), latitude, longitude)
    times = [solar_time(day, hour, longitude) for hour in hours]
    lights = [
        Light(sun, sun_position(t, latitude, longitude), f"{t:%Y-%m-%d %H:%MZ}", "hour")
        for t in times
    ]
    return [light for light in lights if 90 - light.flight_sun.zenith >= lowest]


def flight_tasks(
    site: str,
    lights: Iterable[Light],
    gusts: Iterable[float],
    methods: Iterable[str],
    flights: int,
    setup: Setup,
    seed: int,
) -> list[FlightTask]:
    """Every combination; a navigator without a map or an alarm is not flown into gusts.

    The one without the alarm is, to show what the alarm is worth.
    """
    seeds = tuple(seed + k for k in range(flights))
    return [
        FlightTask(site, light, gust, method, seeds, setup)
        for light, gust, method in product(lights, gusts, methods)
        if not (gust and method in WITHOUT_MAP)
    ]


def fly_all(elevation: xr.DataArray, task: FlightTask) -> pd.DataFrame:
    """The logs of a task's flights, a row for each frame.

    Raises
    ------
    InputError
        Before take-off, if a flight cannot be flown.
    """
    light = task.light
    where = place(elevation, light.map_sun, light.flight_sun, task.setup, ALBEDO)
    rows = []
    for seed in task.seeds:
        flight = mission(where, task.setup, seed, gust=task.gust)
        for row in flight.fly(navigator(task.method, flight)):
            rows.append({"flight": seed} | {k: v for k, v in row.items() if k != "footprint"})
    table = pd.DataFrame(rows)
    table.insert(0, "site", task.site)
    table.insert(1, "method", task.method)
    table.insert(2, "sweep", light.sweep)
    table.insert(3, "time", light.time)
    table.insert(4, "sun_difference_deg", float(round(light.difference)))
    table.insert(5, "sun_zenith_deg", float(round(light.flight_sun.zenith)))
    table.insert(6, "gust", task.gust)
    table["pixel_m"] = where.chart.pixel
    return table


def _middle(elevation: xr.DataArray) -> tuple[float, float]:
    """Latitude and longitude of the map's middle."""
    grid = Grid.of(elevation)
    y, x = (float(axis.mean()) for axis in grid.coordinates())
    return grid.to_wgs84(x, y)
