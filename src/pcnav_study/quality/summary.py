"""Match tables in a few honest numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from pcnav_study.quality.alarm import unrelated_level


def assess(
    table: pd.DataFrame,
    *,
    window: tuple[int, int],
    false_match_rate: float,
    tolerance_px: float,
) -> pd.DataFrame:
    """The match table with ``correct`` (within the tolerance) and ``alarm``.

    The alarm sounds where unrelated windows of this shape, (rows, columns) px, would reach
    the quality too often.
    """
    levels = {
        method: unrelated_level(method, window, false_match_rate=false_match_rate)
        for method in table["method"].unique()
    }
    alarms = table["quality"] < table["method"].map(levels)
    correct = table["error_px"] <= tolerance_px
    return table.assign(tolerance_px=tolerance_px, correct=correct, alarm=alarms)


def wilson(successes: int, n: int) -> tuple[float, float]:
    """Wilson's 95 % interval of a share [1]_.

    References
    ----------
    .. [1] Wilson (1927), J. American Statistical Association 22, 209-212.
    """
    interval = binomtest(successes, n).proportion_ci(method="wilson")
    return float(interval.low), float(interval.high)


def summarise(tables: Sequence[pd.DataFrame], *, bin_deg: float = 15.0) -> pd.DataFrame:
    """Success, error, quality and alarms by method and sun difference.

    ``sun_difference_deg`` is the middle of a bin; ``rmse_px`` counts the correct matches
    alone, ``median_error_px`` all of them.
    """
    table = pd.concat(tables, ignore_index=True)
    middle = np.rint(table["sun_difference"] / bin_deg) * bin_deg
    rows = []
    for (method, difference), group in table.groupby(["method", middle]):
        n, good = len(group), int(group["correct"].sum())
        low, high = wilson(good, n)
        errors = group["error_px"]
        rows.append(
            {
                "method": method,
                "sun_difference_deg": difference,
                "tolerance_px": float(group["tolerance_px"].iloc[0]),
                "n": n,
                "success": good / n,
                "success_low": low,
                "success_high": high,
                "rmse_px": float(np.sqrt((errors[group["correct"]] ** 2).mean())),
                "median_error_px": float(errors.median()),
                "median_quality": float(group["quality"].median()),
                "alarm_rate": float(group["alarm"].mean()),
            }
        )
    return pd.DataFrame(rows)
