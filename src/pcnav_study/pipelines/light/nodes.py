"""Nodes of the light pipeline."""

from __future__ import annotations

import logging

import pandas as pd
import xarray as xr
from joblib import Parallel, delayed

from pcnav_study.experiments import (
    Cell,
    Task,
    break_points,
    experiment_sites,
    judge,
    light_grid,
    sweep,
)
from pcnav_study.pipelines.parameters import Light
from pcnav_study.progress import progress
from pcnav_study.scene import Grid

logger = logging.getLogger(__name__)


def run_light_grid(elevation: xr.DataArray, light: Light) -> pd.DataFrame:
    """Every method at every azimuth difference and zenith."""
    grid = light.grid
    cells = light_grid(
        light.sites, light.window_px, grid.azimuth_differences, grid.reference_zenith,
        grid.moving_zeniths, noise=light.noise, albedo_contrast=light.albedo_contrast,
        shadows=light.shadows,
    )  # fmt: skip
    return _judged(elevation, light, cells, "changing the light")


def run_sweeps(elevation: xr.DataArray, light: Light) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Every method while one thing after another gets worse, and where it breaks."""
    cells = sweep(
        light.sites, light.window_px, light.sweeps.azimuth_differences, light.sweeps.values,
        noise=light.noise, albedo_contrast=light.sweeps.albedo_contrast,
    )  # fmt: skip
    table = _judged(elevation, light, cells, "looking for break points")
    return table, break_points(table)


def _judged(elevation: xr.DataArray, light: Light, cells: list[Cell], doing: str) -> pd.DataFrame:
    pixel_size = Grid.of(elevation).pixel_size
    sites = experiment_sites(light.sites, elevation.values, pixel_size, light.window_px, light.seed)
    tasks = [
        Task(cell, tuple(light.methods), light.trials, light.tolerance_px, light.seed + k)
        for k, cell in enumerate(cells)
    ]
    parallel = Parallel(n_jobs=light.jobs, backend=light.backend, return_as="generator")
    found = parallel(delayed(judge)(sites[task.cell.site], task) for task in tasks)
    table = pd.DataFrame([row for rows in progress(found, doing, len(tasks)) for row in rows])
    logger.info(
        "Judged %d methods on %d pairs (%s)", len(light.methods), len(tasks) * light.trials, doing
    )
    return table
