"""How good a quality is, in numbers with their sample sizes and 95 % intervals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import norm, rankdata

from pcnav_study.quality.calibration import Calibration
from pcnav_study.quality.evidence import Evidence
from pcnav_study.quality.summary import wilson

Array = NDArray[np.float64]
NEAR_MISS = ("beside", "plain_pc")
OFF_ROUTE = ("off_route",)
BINS = 10
RESAMPLES = 200


def auc(right: Array, wrong: Array) -> tuple[float, float, float]:
    """Probability that a right match scores above a wrong one, with DeLong's interval [1]_.

    Where the two part without overlap DeLong's variance is zero; the interval then ends
    where Clopper and Pearson's does for as many successes as the smaller class has members.

    References
    ----------
    .. [1] DeLong, DeLong, Clarke-Pearson (1988), Biometrics 44(3), 837-845.
    """
    m, n = len(right), len(wrong)
    together = rankdata(np.concatenate([right, wrong]))
    above = (together[:m] - rankdata(right)) / n
    below = 1 - (together[m:] - rankdata(wrong)) / m
    area = float(above.mean())
    variance = above.var(ddof=1) / m + below.var(ddof=1) / n if min(m, n) > 1 else np.inf
    if area == 1:
        return 1.0, float(0.025 ** (1 / min(m, n))), 1.0
    half = float(norm.isf(0.025) * np.sqrt(variance))
    return area, max(area - half, 0.0), min(area + half, 1.0)


def calibration_error(probability: Array, right: NDArray[np.bool_]) -> float:
    """Expected calibration error over ``BINS`` bins of equal width."""
    which = np.minimum((probability * BINS).astype(int), BINS - 1)
    gaps = np.bincount(which, probability - right, BINS)
    return float(np.abs(gaps).sum() / len(right))


def reliability(probability: Array, right: NDArray[np.bool_]) -> pd.DataFrame:
    """Stated and observed probability of each bin, with n and Wilson's interval."""
    which = np.minimum((probability * BINS).astype(int), BINS - 1)
    rows = []
    for k in np.unique(which):
        inside = which == k
        n, hits = int(inside.sum()), int(right[inside].sum())
        low, high = wilson(hits, n)
        stated = float(probability[inside].mean())
        rows.append({"stated": stated, "observed": hits / n, "low": low, "high": high, "n": n})
    return pd.DataFrame(rows)


def judge_quality(table: pd.DataFrame, calibration: Calibration, seed: int = 0) -> dict[str, Any]:
    """All that ``quality_calibration`` holds.

    Parameters
    ----------
    table : DataFrame
        As `cases.collect` gives it with a calibration.
    """
    right = (table["error_px"] <= calibration.tolerance_px).to_numpy()
    kind, alarm = table["kind"], table["alarm"].to_numpy(bool)
    score = scores(table, calibration)
    clear = right & (kind == "match").to_numpy()
    near, off = (~right & kind.isin(k).to_numpy() for k in (NEAR_MISS, OFF_ROUTE))
    far_off = ~right & (table["error_px"] > 2 * calibration.tolerance_px).to_numpy()
    probability = table["probability"].to_numpy()
    report: dict[str, Any] = {
        "auc_near_miss": _auc(score, clear, near),
        "auc_off_route": _auc(score, clear, off),
        "false_alarm_rate": _rate(alarm, clear, "right matches in a clear view that are alarmed"),
        "missed_alarm_rate": _rate(~alarm, near | off, "near misses and off-route, unalarmed"),
        "expected_calibration_error": _ece(probability, right, seed),
        "radius_coverage": _rate(
            (table["error_px"] <= table["radius_px"]).to_numpy(), ~alarm,
            "unalarmed matches whose truth lies within the stated radius",
        ),
        "missed_alarm_rate_all": _rate(~alarm, ~right, "wrong shifts of every kind, unalarmed"),
        "missed_alarm_rate_beyond_2_px": _rate(~alarm, far_off, "those wrong by over 2 px"),
        "false_alarm_rate_all": _rate(alarm, right, "right matches of every kind, alarmed"),
        "promised_false_alarm_rate": calibration.false_alarm_rate,
        "base_rate": float(right.mean()),
        "tolerance_px": calibration.tolerance_px,
    }  # fmt: skip
    report["missed_by_kind"] = {
        str(k): _rate(~alarm, ~right & (kind == k).to_numpy(), "wrong shifts, unalarmed")
        for k in sorted(kind.unique())
        if (~right & (kind == k)).any()
    }
    return report


def compare_measures(
    table: pd.DataFrame, calibration: Calibration, names: Sequence[str], missing: dict[str, str]
) -> pd.DataFrame:
    """AUC of every measure against near misses and off-route windows, suns pooled."""
    right = (table["error_px"] <= calibration.tolerance_px).to_numpy()
    clear = right & (table["kind"] == "match").to_numpy()
    columns: dict[str, Array] = {
        "calibrated (ours)": scores(table, calibration),
        "Dirac-delta quality": table["quality"].to_numpy(),
        "energy share": table["share"].to_numpy(),
    }
    columns |= {n: table[n].to_numpy() for n in names if n not in missing}
    rows = []
    for name, values in columns.items():
        known = np.nan_to_num(values, nan=-np.inf)
        for against, kinds in (("near miss", NEAR_MISS), ("off route", OFF_ROUTE)):
            wrong = ~right & table["kind"].isin(kinds).to_numpy()
            rows.append({"measure": name, "against": against} | _auc(known, clear, wrong))
    for name, why in missing.items():
        rows.append({"measure": name, "against": why})
    return pd.DataFrame(rows).rename(columns={"value": "auc"})


def scores(table: pd.DataFrame, calibration: Calibration) -> Array:
    """The calibration's score of every row."""
    return calibration.score(table[list(Evidence._fields)].to_numpy(float))


def _auc(score: Array, right: NDArray[np.bool_], wrong: NDArray[np.bool_]) -> dict[str, Any]:
    n = {"n_right": int(right.sum()), "n_wrong": int(wrong.sum())}
    if 0 in n.values():
        return {"value": None, "low": None, "high": None, "n": 0} | n
    area, low, high = auc(score[right], score[wrong])
    return {"value": area, "low": low, "high": high, "n": sum(n.values())} | n


def _rate(happened: NDArray[np.bool_], among: NDArray[np.bool_], means: str) -> dict[str, Any]:
    n, hits = int(among.sum()), int((happened & among).sum())
    if n == 0:
        return {"value": None, "low": None, "high": None, "n": 0, "means": means}
    low, high = wilson(hits, n)
    return {"value": hits / n, "low": low, "high": high, "n": n, "means": means}


def _ece(probability: Array, right: NDArray[np.bool_], seed: int) -> dict[str, Any]:
    rng = np.random.default_rng(seed)
    n = len(right)
    again = [
        calibration_error(probability[pick], right[pick])
        for pick in (rng.integers(0, n, n) for _ in range(RESAMPLES))
    ]
    low, high = np.quantile(again, [0.025, 0.975])
    value = calibration_error(probability, right)
    return {"value": value, "low": float(low), "high": float(high), "n": n}
