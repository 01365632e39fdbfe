"""Nodes of the calibration pipelines."""

from __future__ import annotations

import logging
from typing import Any

import pandas as pd
import xarray as xr
from joblib import Parallel, delayed

from pcnav_study.pipelines.parameters import Calibration, CaseSet
from pcnav_study.progress import progress
from pcnav_study.quality.calibration import Calibration as Frozen
from pcnav_study.quality.calibration import as_json, fit, frozen
from pcnav_study.quality.cases import Plan, collect, stacked
from pcnav_study.quality.judge import compare_measures, judge_quality
from pcnav_study.quality.measures import MEASURES, absent
from pcnav_study.quality.sites import site_of
from pcnav_study.scene import Grid

logger = logging.getLogger(__name__)


def try_quality(
    elevation: xr.DataArray, calibration: Calibration
) -> tuple[pd.DataFrame, xr.Dataset]:
    """Cases on unseen sites with the shipped calibration's answers, and its mistakes."""
    missing = absent(tuple(MEASURES))
    for name, why in missing.items():
        logger.info("Leaving out %s (%s)", name, why)
    peers = tuple(name for name in MEASURES if name not in missing)
    rows, mistakes = _collected(elevation, calibration, calibration.judge, peers, frozen())
    return rows, stacked(mistakes, calibration.shown)


def judge_trust(
    cases: pd.DataFrame, calibration: Calibration
) -> tuple[dict[str, Any], pd.DataFrame]:
    """Whether the alarm keeps its promise, and how competing measures fare."""
    report = judge_quality(cases, frozen(), calibration.judge.seed)
    table = compare_measures(cases, frozen(), list(MEASURES), absent(tuple(MEASURES)))
    logger.info(
        "On %d unseen cases the alarm misses %.2f %% and is false for %.2f %% of right matches",
        len(cases),
        100 * report["missed_alarm_rate"]["value"],
        100 * report["false_alarm_rate"]["value"],
    )
    return report, table


def make_calibration(elevation: xr.DataArray, calibration: Calibration) -> dict[str, Any]:
    """Learn the calibration that ships with the package."""
    training, _ = _collected(elevation, calibration, calibration.train)
    apart, _ = _collected(elevation, calibration, calibration.calibrate)
    made = fit(
        training,
        apart,
        false_alarm_rate=calibration.false_alarm_rate,
        radius_coverage=calibration.radius_coverage,
    )
    return as_json(made)


def _collected(
    elevation: xr.DataArray,
    calibration: Calibration,
    wanted: CaseSet,
    peers: tuple[str, ...] = (),
    known: Frozen | None = None,
) -> tuple[pd.DataFrame, list[dict[str, Any]]]:
    pixel_size = Grid.of(elevation).pixel_size
    tasks = []
    for k, name in enumerate(map(str, wanted.sites)):
        site = site_of(name, elevation.values, pixel_size)
        for size in wanted.sizes:
            plan = Plan(size, wanted.differences, wanted.trials, wanted.seed + 1000 * k, peers)
            tasks.append(delayed(collect)(site, name, plan, known))
    parallel = Parallel(n_jobs=calibration.jobs, backend=calibration.backend, return_as="generator")
    found = list(progress(parallel(tasks), "trying the quality", len(tasks)))
    rows = pd.DataFrame([row for part, _ in found for row in part])
    return rows, [mistake for _, part in found for mistake in part]
