"""Nodes of the quality pipeline."""

from __future__ import annotations

import logging

import pandas as pd

from pcnav_study.pipelines.parameters import Quality, Rectify
from pcnav_study.quality import assess, summarise

logger = logging.getLogger(__name__)


def assess_matches(match_table: pd.DataFrame, quality: Quality, rectify: Rectify) -> pd.DataFrame:
    """Each match with its alarm."""
    return assess(
        match_table,
        window=(rectify.window_px, rectify.window_px),
        false_match_rate=quality.false_match_rate,
        tolerance_px=quality.tolerance_px,
    )


def summarise_matches(quality: Quality, *tables: pd.DataFrame) -> pd.DataFrame:
    """All methods side by side, by sun difference."""
    summary = summarise(tables, bin_deg=quality.sun_bin_deg)
    for method, rows in summary.groupby("method", sort=False):
        share = (rows["success"] * rows["n"]).sum() / rows["n"].sum()
        logger.info(
            "%s places %.0f %% of the frames within %g px",
            method,
            100 * share,
            quality.tolerance_px,
        )
    return summary
