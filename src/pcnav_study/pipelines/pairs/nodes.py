"""Nodes of the pairs pipeline."""

from __future__ import annotations

import logging

import numpy as np
import pandas as pd

from pcnav_study.errors import InputError
from pcnav_study.experiments import draw_registered, registered, score
from pcnav_study.pipelines.parameters import Pairs
from pcnav_study.progress import progress

logger = logging.getLogger(__name__)


def match_real_pairs(pairs: Pairs) -> pd.DataFrame:
    """A row for each method: how it does on windows of the two pictures."""
    if not (pairs.reference and pairs.moving):
        raise InputError(
            "pairs.reference and pairs.moving are not set; name two pictures of one place with "
            "--params=pairs.reference=PATH,pairs.moving=PATH"
        )
    pictures = registered(pairs.reference, pairs.moving, pairs.affine)
    rng = np.random.default_rng(pairs.seed)
    trials = draw_registered(*pictures, pairs.window_px, pairs.trials, rng)
    rows = []
    for method in progress(pairs.methods, "matching", len(pairs.methods)):
        row = {"reference": pairs.reference, "moving": pairs.moving, "size": pairs.window_px}
        row |= {"method": method, "tolerance_px": pairs.tolerance_px}
        rows.append(row | score(trials, method, pairs.tolerance_px))
        logger.info("%s: %.2f within %g px", method, rows[-1]["success"], pairs.tolerance_px)
    return pd.DataFrame(rows)
