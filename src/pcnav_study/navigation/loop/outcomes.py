"""What flights came to, in a few honest numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from scipy import stats

from pcnav_study.quality.summary import wilson

RESAMPLES = 1000  # of the bootstrap
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
KEYS = ["site", "sweep", "time", "sun_difference_deg", "gust", "method"]


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

    The error is counted from the one at take-off. A line is fitted to each flight from its
    second frame on, its slopes are averaged over the suns, and mean and 95 % t interval
    are over routes.
    """
    calm = steps[steps["gust"] == 0]
    rows = []
    for (site, method), group in calm.groupby(["site", "method"], sort=True):
        flights = [
            {"flight": number, "slope": _slope(flight)}
            for (number, _, _), flight in group.groupby(["flight", "sweep", "time"])
        ]
        slopes = pd.DataFrame(flights).groupby("flight")["slope"].mean().dropna()
        n = len(slopes)
        error = stats.sem(slopes) * stats.t.ppf(0.975, n - 1) if n > 1 else np.nan
        mean = float(slopes.mean()) if n else np.nan
        rows.append((site, method, len(flights), n, mean, mean - error, mean + error))
    columns = ["site", "method", "flights", "routes", "slope_m_per_km", "slope_low", "slope_high"]
    return pd.DataFrame(rows, columns=columns)


def lost_from(summary: pd.DataFrame, level: float = 0.95) -> pd.DataFrame:
    """The first sun difference at which fewer than ``level`` of a method's calm flights arrive."""
    calm = summary[(summary["gust"] == 0) & (summary["sweep"] == "difference")]
    rows = []
    for (site, method), group in calm.groupby(["site", "method"]):
        ordered = group.sort_values("sun_difference_deg")
        failing = ordered[ordered["arrival_rate"] < level]["sun_difference_deg"]
        rows.append((site, method, float(failing.iloc[0]) if len(failing) else np.nan))
    return pd.DataFrame(rows, columns=["site", "method", "lost_from_deg"])


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
    rms_low, rms_high = _rms_interval(trusted)
    return {
        "flights": len(last),
        "arrival_rate": float(arrived.mean()),
        "arrival_low": low,
        "arrival_high": high,
        "rmse_m": _rms(trusted["error_m"]),
        "rmse_px": _rms(trusted["error_m"]) / pixel,
        "rmse_px_low": rms_low / pixel,
        "rmse_px_high": rms_high / pixel,
        "trusted_frames": len(trusted),
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
    truth = flight[["east", "north"]].to_numpy(float)
    wrong = flight[["believed_east", "believed_north"]].to_numpy(float) - truth
    way = np.hypot(*np.diff(truth, axis=0).T).cumsum()
    if len(way) < 3 or not np.ptp(way):
        return float("nan")
    grown = np.hypot(*(wrong[1:] - wrong[0]).T)
    return float(np.polyfit(way / 1000, grown, 1)[0])


def _rms_interval(trusted: pd.DataFrame) -> tuple[float, float]:
    """95 % percentile bootstrap of the RMSE over flights."""
    squares = trusted["error_m"] ** 2
    flights = squares.groupby(trusted["flight"]).agg(["sum", "size"]).to_numpy(float)
    if len(flights) < 2:
        return np.nan, np.nan
    drawn = np.random.default_rng(0).integers(0, len(flights), (RESAMPLES, len(flights)))
    total = flights[drawn].sum(axis=1)
    low, high = np.quantile(np.sqrt(total[:, 0] / total[:, 1]), [0.025, 0.975])
    return float(low), float(high)


def _has_alarm(steps: pd.DataFrame) -> bool:
    return bool(steps["sight_error_m"].notna().any()) and "off" not in steps["method"].iloc[0]


def _rms(values: pd.Series) -> float:
    return float(np.sqrt((values**2).mean())) if len(values) else float("nan")


def _mean(values: pd.Series) -> float:
    return float(values.mean()) if len(values) else float("nan")
