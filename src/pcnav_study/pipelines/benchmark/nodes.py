"""Nodes of the benchmark pipeline."""

from __future__ import annotations

import logging

import pandas as pd
import xarray as xr
from threadpoolctl import threadpool_limits

from pcnav_study.experiments import benchmark, experiment_sites, light_grid
from pcnav_study.pipelines.parameters import Benchmark
from pcnav_study.progress import progress
from pcnav_study.scene import Grid, jacksboro

logger = logging.getLogger(__name__)


def load_relief() -> xr.DataArray:
    """The embedded tile, so that the benchmark needs no earlier run."""
    return jacksboro()


def run_benchmark(relief: xr.DataArray, bench: Benchmark) -> pd.DataFrame:
    """Every method and peer, paired, in this process, on one thread."""
    cells = [
        cell
        for size in bench.window_px
        for cell in light_grid(
            bench.sites, size, bench.azimuth_differences, 45.0, [45.0], noise=bench.noise
        )
    ]
    pixel_size = Grid.of(relief).pixel_size
    sites = experiment_sites(
        bench.sites, relief.values, pixel_size, max(bench.window_px), bench.seed
    )
    with threadpool_limits(1):
        tables = benchmark(
            sites, cells, n=bench.trials, seed=bench.seed,
            tolerance_px=bench.tolerance_px, methods=bench.methods, peers=bench.peers,
            roaming_n=bench.roaming_trials,
        )  # fmt: skip
        table = pd.concat(progress(tables, "benchmarking", len(cells)), ignore_index=True)
    for name, note in table[table["n"] == 0].groupby("method")["note"].first().items():
        logger.info("%s: %s", name, note)
    return table
