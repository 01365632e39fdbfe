"""Nodes of the match pipeline."""

from __future__ import annotations

import logging

import pandas as pd
import xarray as xr

from pcnav_study.matching.table import match_pairs
from pcnav_study.pipelines.parameters import Matcher
from pcnav_study.pipelines.simulate.nodes import map_sun

logger = logging.getLogger(__name__)


def match_windows(
    window_pairs: xr.Dataset, suns: pd.DataFrame, matcher: Matcher
) -> tuple[pd.DataFrame, xr.Dataset]:
    """Every pair matched by one method: a table, and the surfaces."""
    table, surfaces = match_pairs(window_pairs, matcher.method, matcher.max_shift_px, map_sun(suns))
    logger.info(
        "Matched %d frames by %s: median error %.2f px",
        len(table), matcher.method, table["error_px"].median(),
    )  # fmt: skip
    return table, surfaces
