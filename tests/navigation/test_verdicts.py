"""Verdicts count what the summary says."""

import numpy as np
import pandas as pd
import pytest

from pcnav_study.navigation.verdicts import pooled, verdicts


def row(difference, gust, arrived, rmse, recall=np.nan, false_alarms=0.0):
    return {
        "site": "here", "sun_difference_deg": difference, "gust": gust, "method": "pc-sectors",
        "flights": 20, "arrival_rate": arrived, "arrival_low": arrived - 0.1,
        "arrival_high": min(arrived + 0.1, 1.0), "rmse_px": rmse, "rmse_px_low": 0.9 * rmse,
        "rmse_px_high": 1.1 * rmse, "next_rmse_px": 2 * rmse,
        "alarm_recall": recall, "gusts": 20 if gust else 0, "recovery_rate": recall,
        "false_alarm_rate": false_alarms, "right_fixes": 100,
    }  # fmt: skip


TIMING = pd.DataFrame(
    {"part": ["match", "whole step"], "ms": [20.0, 60.0], "frame_px": 512, "method": "pc-sectors"}
)


def test_pooled_shares_are_of_all_counts():
    table = pd.DataFrame(
        [row(0, 1.0, 1.0, 0.2, 1.0, 0.01), row(90, 1.0, 0.9, 0.2, 0.5, 0.03), row(0, 0.0, 1.0, 0.2)]
    )
    found = pooled(table, ["method"]).set_index("outcome")
    assert found.loc["arrival_rate", ["value", "n"]].tolist() == pytest.approx([58 / 60, 60])
    assert found.loc["alarm_recall", ["value", "n"]].tolist() == pytest.approx([0.75, 40])
    assert found.loc["false_alarm_rate", ["value", "n"]].tolist() == pytest.approx([4 / 300, 300])
    assert (found["low"] < found["value"]).all() and (found["value"] < found["high"]).all()


def test_worst_sun_decides_and_its_place_is_named():
    table = pd.DataFrame([row(0, 0.0, 1.0, 0.2), row(90, 0.0, 0.9, 0.6)])
    found = verdicts(table, TIMING, "pc-sectors").set_index("demand")
    arrives = found.loc["arrives, without gusts"]
    assert not arrives["holds"] and "90°" in arrives["where"] and arrives["n"] == 20
    assert not found.loc["RMSE of the position, px, without gusts", "holds"]
    assert not found.loc["ms of a step, frames of 512 px", "holds"]


def test_position_never_trusted_does_not_hold():
    table = pd.DataFrame([row(0, 0.0, 1.0, 0.2), row(90, 0.0, 1.0, np.nan)])
    found = verdicts(table, TIMING, "pc-sectors").set_index("demand")
    position = found.loc["RMSE of the position, px, without gusts"]
    assert np.isnan(position["value"]) and not position["holds"] and position["n"] == 20


def test_what_was_not_flown_has_no_verdict():
    table = pd.DataFrame([row(0, 0.0, 1.0, 0.2)])
    found = verdicts(table, TIMING[:1], "pc-sectors").set_index("demand")
    for demand in (
        "arrives, with a gust",
        "recovers from a gust",
        "ms of a step, frames of 512 px",
    ):
        assert found.loc[demand, "holds"] is None
        assert pd.isna(found.loc[demand, "value"])
