"""Nodes of the mission pipeline."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from itertools import chain
from typing import Any

import xarray as xr

from pcnav_study.navigation.loop import (
    Route,
    lights_by_difference,
    mission,
    navigator,
    place,
)
from pcnav_study.navigation.loop.closed_loop import Mission as Flight
from pcnav_study.navigation.loop.sites import elevation_of
from pcnav_study.pipelines.parameters import Mission
from pcnav_study.progress import progress

logger = logging.getLogger(__name__)


def prepare_mission(plan: Mission) -> tuple[Flight, xr.DataArray]:
    """The flight, checked before take-off, and the map it carries."""
    elevation = elevation_of(plan.site)
    light = lights_by_difference(elevation, plan.day, plan.map_hour, [plan.sun_difference])[0]
    where = place(elevation, light.map_sun, light.flight_sun, plan.setup, plan.seed)
    route = Route(where.chart.grid.at_shares(plan.route))
    flight = mission(where, plan.setup, plan.seed, route)
    flight = flight.with_gust(plan.gust * flight.frame_m, plan.gust_step)
    logger.info(
        "Mission of %.0f km: map's sun at azimuth %.0f, flight's at %.0f on %s",
        flight.pilot.route.length / 1000, light.map_sun.azimuth, light.flight_sun.azimuth,
        light.time,
    )  # fmt: skip
    picture = where.chart.reference.rename("radiance")
    picture.attrs.update(
        map_azimuth=light.map_sun.azimuth,
        flight_azimuth=light.flight_sun.azimuth,
        time=light.time,
        route=flight.pilot.route.waypoints.ravel().tolist(),
    )
    return flight, picture


def fly_mission(flight: Flight, plan: Mission) -> Iterator[dict[str, Any]]:
    """Rows of the log as they come, one method after the other."""
    return chain.from_iterable(
        _logged(flight, method) for method in progress(plan.methods, "flying", len(plan.methods))
    )


def _logged(flight: Flight, method: str) -> Iterator[dict[str, Any]]:
    for row in flight.fly(navigator(method, flight)):
        del row["ms"]  # equal inputs give equal logs
        if row["ending"]:
            logger.info("%s: %s after %d frames", method, row["ending"], row["step"] + 1)
        yield {"method": method} | row
