"""What flights came to, in a few honest numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from scipy import stats

from pcnav_study.quality.summary import wilson

ARRIVED_PX = 5.0  # true distance from the route's end
RIGHT_PX = 1.0  # a fix as good as that is right
ASTRAY_PX = 3.0  # a belief worse than that was disturbed before the frame
WRONG_PX = 2.0  # a trusted position worse than that is wrong
COLUMNS = (
    "method",
    "sun_difference_deg",
    "flights",
    "arrival_rate",
    "rmse_m",
    "max_error_m",
    "next_rmse_m",
    "alarm_recall",
    "false_alarm_rate",
    "recovery_rate",
    "ms_per_step",
)
KEYS = ["site", "time", "sun_difference_deg", "gust", "method"]


def navigation_summary(steps: pd.DataFrame, corridor_px: float) -> pd.DataFrame:
    """A row for each site, light, gust and method.

    Parameters
    ----------
    steps : DataFrame
        Logs, as `fly_all` writes them.
    corridor_px : float
        Nearer to the route than that is on it.

    Returns
    -------
    DataFrame
        ``rmse_m`` and ``max_error_m`` are over the moments at which the UAV trusts its
        position, ``rmse_all_m`` over all. ``next_rmse_m`` is of the position predicted one
        leg ahead from a trusted one, gusts apart. ``alarm_recall``: gusts that raised an
        alarm in the very next frame. ``false_alarm_rate``: alarms among frames of an
        undisturbed UAV whose first fix was right within a pixel. ``recovery_rate``: flights
        with a gust that came back to the route and knew where they were.
        ``wrong_rate``: moments of trust more than two pixels from the truth.
    """
    rows = [
        dict(zip(KEYS, key, strict=True)) | _outcome(group, corridor_px)
        for key, group in steps.groupby(KEYS, sort=True)
    ]
    table = pd.DataFrame(rows)
    first = list(COLUMNS)
    return table[first + [name for name in table if name not in first]]


def drift_slopes(steps: pd.DataFrame) -> pd.DataFrame:
    """How the position's error grows with the way flown without gusts, metres per kilometre.

    A line is fitted to each flight; mean and 95 % t interval are over flights.
    """
    calm = steps[steps["gust"] == 0]
    rows = []
    for (site, method), group in calm.groupby(["site", "method"], sort=True):
        slopes = np.array([_slope(flight) for _, flight in group.groupby(["time", "flight"])])
        slopes = slopes[np.isfinite(slopes)]
        n = len(slopes)
        error = stats.sem(slopes) * stats.t.ppf(0.975, n - 1) if n > 1 else np.nan
        mean = float(slopes.mean()) if n else np.nan
        rows.append(
            {
                "site": site,
                "method": method,
                "flights": n,
                "slope_m_per_km": mean,
                "slope_low": mean - error,
                "slope_high": mean + error,
            }
        )
    return pd.DataFrame(rows)


def lost_from(summary: pd.DataFrame, level: float = 0.95) -> pd.DataFrame:
    """The first sun difference at which fewer than ``level`` of a method's calm flights arrive."""
    calm = summary[summary["gust"] == 0].sort_values("sun_difference_deg")
    rows = []
    for (site, method), group in calm.groupby(["site", "method"]):
        failing = group[group["arrival_rate"] < level]["sun_difference_deg"]
        first = float(failing.iloc[0]) if len(failing) else np.nan
        rows.append({"site": site, "method": method, "lost_from_deg": first})
    return pd.DataFrame(rows)


def _outcome(steps: pd.DataFrame, corridor_px: float) -> dict[str, Any]:
    """One row of the summary, from the steps of comparable flights."""
    pixel = float(steps["pixel_m"].iloc[0])
    steps = _judged(steps, pixel)
    flights = steps.groupby("flight")
    last = flights.tail(1)
    arrived = (last["ending"] == "arrived") & (last["to_end_m"] <= ARRIVED_PX * pixel)
    trusted, ahead = steps[steps["trusted"]], steps[steps["foretold"]]
    gusts, calm = steps[steps["push_m"] > 0], steps[steps["undisturbed"]]
    back = [_came_back(f, corridor_px * pixel, pixel) for _, f in flights if f["push_m"].any()]
    low, high = wilson(int(arrived.sum()), len(last))
    return {
        "flights": len(last),
        "arrival_rate": float(arrived.mean()),
        "arrival_low": low,
        "arrival_high": high,
        "rmse_m": _rms(trusted["error_m"]),
        "rmse_px": _rms(trusted["error_m"]) / pixel,
        "rmse_all_m": _rms(steps["error_m"]),
        "max_error_m": float(trusted["error_m"].max()) if len(trusted) else np.nan,
        "next_rmse_m": _rms(ahead["next_error_m"]),
        "next_rmse_px": _rms(ahead["next_error_m"]) / pixel,
        "alarm_recall": _mean(gusts["alarm"]) if _has_alarm(steps) else np.nan,
        "gusts": len(gusts),
        "false_alarm_rate": _mean(calm["alarm"]) if _has_alarm(steps) else np.nan,
        "right_fixes": len(calm),
        "recovery_rate": float(np.mean(back)) if back else np.nan,
        "trusted_share": float(steps["trusted"].mean()),
        "wrong_rate": _mean(trusted["error_m"] > WRONG_PX * pixel),
        "ms_per_step": float(steps["ms"].median()),
        "pixel_m": pixel,
        "sun_zenith_deg": float(steps["sun_zenith_deg"].iloc[0]),
    }


def _judged(steps: pd.DataFrame, pixel: float) -> pd.DataFrame:
    """With ``undisturbed`` and ``foretold``; see `navigation_summary`."""
    before = steps.groupby("flight")[["trusted", "error_m"]].shift(1)
    sure = before["trusted"].fillna(True).astype(bool)
    near = before["error_m"].fillna(0.0) < ASTRAY_PX * pixel
    calm = steps["push_m"] == 0
    right = steps["sight_error_m"] <= RIGHT_PX * pixel
    return steps.assign(
        undisturbed=calm & sure & near & right,
        foretold=calm & sure & (steps["step"] > 0),
    )


def _came_back(flight: pd.DataFrame, corridor: float, pixel: float) -> bool:
    """True if, from the gust on, the UAV was on its route again and knew it."""
    after = flight[flight["step"] >= flight.loc[flight["push_m"] > 0, "step"].iloc[0]]
    knows = after["trusted"] & (after["error_m"] <= WRONG_PX * pixel)
    return bool((knows & (after["off_route_m"] <= corridor)).any())


def _slope(flight: pd.DataFrame) -> float:
    way = np.hypot(flight["east"].diff().fillna(0), flight["north"].diff().fillna(0)).cumsum()
    if len(flight) < 3 or not np.ptp(way):
        return float("nan")
    return float(np.polyfit(way / 1000, flight["error_m"], 1)[0])


def _has_alarm(steps: pd.DataFrame) -> bool:
    return bool(steps["sight_error_m"].notna().any()) and "off" not in steps["method"].iloc[0]


def _rms(values: pd.Series) -> float:
    return float(np.sqrt((values**2).mean())) if len(values) else float("nan")


def _mean(values: pd.Series) -> float:
    return float(values.mean()) if len(values) else float("nan")
