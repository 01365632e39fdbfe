"""Nodes of the navigate pipeline."""

from __future__ import annotations

import logging
from pathlib import Path

import pandas as pd
import xarray as xr
from joblib import Parallel, delayed
from threadpoolctl import threadpool_limits

from pcnav_study.navigation.loop import (
    FlightTask,
    drift_slopes,
    flight_tasks,
    fly_all,
    lights_by_difference,
    lights_by_hour,
    lost_from,
    navigation_summary,
    step_times,
)
from pcnav_study.navigation.loop.sites import elevation_of
from pcnav_study.pipelines.parameters import Navigate
from pcnav_study.progress import progress

logger = logging.getLogger(__name__)
Reliefs = dict[str, xr.DataArray]


def load_sites(navigate: Navigate) -> Reliefs:
    """Elevation of every site, by its short name."""
    return {Path(site).stem: elevation_of(site) for site in navigate.sites}


def fly_fleet(reliefs: Reliefs, navigate: Navigate) -> pd.DataFrame:
    """Logs of all flights, in parallel, a row for each frame."""
    tasks = [task for site, relief in reliefs.items() for task in _tasks(site, relief, navigate)]
    parallel = Parallel(n_jobs=navigate.jobs, backend=navigate.backend, return_as="generator")
    flown = parallel(delayed(fly_all)(reliefs[task.site], task) for task in tasks)
    steps = pd.concat(progress(flown, "flying", len(tasks)), ignore_index=True)
    logger.info("%d flights, %d frames", len(tasks) * navigate.flights, len(steps))
    return steps


def summarise_fleet(
    steps: pd.DataFrame, navigate: Navigate
) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Outcomes, drift, and where each method is lost."""
    summary = navigation_summary(steps, navigate.setup.corridor_px)
    return summary, drift_slopes(steps), lost_from(summary)


def time_steps(navigate: Navigate) -> pd.DataFrame:
    """Where the time of a step goes, on one thread."""
    with threadpool_limits(1):
        tables = [
            step_times(navigate.setup, side, navigate.timed_flights, "pc-sectors", navigate.seed)
            for side in navigate.timed_frames_px
        ]
    return pd.concat(tables, ignore_index=True)


def _tasks(site: str, relief: xr.DataArray, navigate: Navigate) -> list[FlightTask]:
    one, other = navigate.by_difference, navigate.by_hour
    lights = lights_by_difference(relief, one.day, one.map_hour, one.differences)
    for day in other.days:
        lights += lights_by_hour(relief, day, other.map_hour, other.hours, other.lowest_sun)
    return flight_tasks(
        site, lights, navigate.gusts, navigate.methods, navigate.flights, navigate.setup,
        navigate.seed,
    )  # fmt: skip
