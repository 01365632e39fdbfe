"""What a fleet's summary says of the demands on the navigation, with n and intervals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pandas as pd

from pcnav_study.quality.summary import wilson

COUNTED = {
    "arrival_rate": "flights",
    "alarm_recall": "gusts",
    "false_alarm_rate": "right_fixes",
    "recovery_rate": "gusts",
}
ARRIVAL, RMSE_PX, NEXT_PX, RECALL, FALSE_ALARMS, RECOVERY = 0.99, 0.5, 1.0, 0.99, 0.01, 0.95
STEP_MS, STEP_PX = 50.0, 512


def pooled(summary: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Outcomes of all flights alike in ``by``, with Wilson's 95 % intervals.

    Returns
    -------
    DataFrame
        ``outcome`` (a column of the summary), ``value``, ``low``, ``high``, ``n``; outcomes
        that cannot occur, such as the recall without gusts, are left out.
    """
    rows: list[dict[str, Any]] = []
    for key, group in summary.groupby(list(by), sort=True):
        for outcome, count in COUNTED.items():
            known = group[group[outcome].notna()]
            n = int(known[count].sum())
            if n:
                hits = round(float((known[outcome] * known[count]).sum()))
                low, high = wilson(hits, n)
                entry = {"outcome": outcome, "value": hits / n, "low": low, "high": high, "n": n}
                rows.append(dict(zip(by, key, strict=True)) | entry)
    return pd.DataFrame(rows, columns=[*by, "outcome", "value", "low", "high", "n"])


def verdicts(summary: pd.DataFrame, timing: pd.DataFrame, method: str) -> pd.DataFrame:
    """Every demand on ``method``, what was found, and whether it holds.

    Arrivals and errors are those of the worst sun difference; the alarm's outcomes are of
    all flights together. ``holds`` is missing where nothing was measured.
    """
    own = summary[summary["method"] == method]
    rows = []
    for gusty, words in ((False, "without gusts"), (True, "with a gust")):
        part = own[(own["gust"] > 0) == gusty]
        rows += [
            _worst(part, "arrival_rate", f"arrives, {words}", ARRIVAL, least=True),
            _worst(part, "rmse_px", f"RMSE of the position, px, {words}", RMSE_PX),
            _worst(part, "next_rmse_px", f"RMSE of the next position, px, {words}", NEXT_PX),
        ]
    whole = pooled(own, ["method"]).set_index("outcome")
    rows += [
        _share(whole, "alarm_recall", "gusts that raise an alarm at once", RECALL, least=True),
        _share(whole, "false_alarm_rate", "false alarms among right fixes", FALSE_ALARMS),
        _share(whole, "recovery_rate", "recovers from a gust", RECOVERY, least=True),
        _step(timing, method),
    ]
    return pd.DataFrame(rows, columns=_COLUMNS)


_COLUMNS = ["demand", "least", "limit", "value", "low", "high", "n", "where", "holds"]


def _entry(
    demand: str,
    limit: float,
    value: float | None,
    *,
    least: bool = False,
    interval: tuple[float, float] | None = None,
    n: int = 0,
    where: str = "",
) -> dict[str, Any]:
    low, high = interval or (None, None)
    holds = None if value is None else bool(value >= limit if least else value <= limit)
    return dict(
        zip(_COLUMNS, (demand, least, limit, value, low, high, n, where, holds), strict=True)
    )


def _worst(
    rows: pd.DataFrame, column: str, demand: str, limit: float, *, least: bool = False
) -> dict[str, Any]:
    """The demand at the sun difference at which it is met worst."""
    if rows.empty:
        return _entry(demand, limit, None, least=least)
    # A position that was never trusted has no error; then the demand is not met either.
    worst = rows[column].isna().idxmax() if rows[column].isna().any() else None
    if worst is None:
        worst = rows[column].idxmin() if least else rows[column].idxmax()
    row = rows.loc[worst]
    ends = {"arrival_rate": "arrival", "rmse_px": "rmse_px"}.get(column)
    interval = (row[f"{ends}_low"], row[f"{ends}_high"]) if ends else None
    where = f"{row['site']}, suns {row['sun_difference_deg']:.0f}° apart"
    return _entry(
        demand, limit, float(row[column]), least=least, interval=interval,
        n=int(row["flights"]), where=where,
    )  # fmt: skip


def _share(
    whole: pd.DataFrame, outcome: str, demand: str, limit: float, *, least: bool = False
) -> dict[str, Any]:
    if outcome not in whole.index:
        return _entry(demand, limit, None, least=least)
    row = whole.loc[outcome]
    return _entry(
        demand, limit, float(row["value"]), least=least, interval=(row["low"], row["high"]),
        n=int(row["n"]), where="all flights",
    )  # fmt: skip


def _step(timing: pd.DataFrame, method: str) -> dict[str, Any]:
    demand = f"ms of a step, frames of {STEP_PX} px"
    whole = timing[
        (timing["part"] == "whole step")
        & (timing["frame_px"] == STEP_PX)
        & (timing["method"] == method)
    ]
    value = float(whole["ms"].iloc[0]) if len(whole) else None
    return _entry(demand, STEP_MS, value, where="median, one thread" if len(whole) else "")
