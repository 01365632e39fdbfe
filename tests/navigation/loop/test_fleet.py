"""Suns of the fleet against pvlib, and outcomes of logs made by hand."""

import numpy as np
import pandas as pd
import pvlib
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop import (
    Setup,
    drift_slopes,
    flight_tasks,
    fly_all,
    lights_by_difference,
    lights_by_hour,
    lost_from,
    navigation_summary,
    step_times,
)
from pcnav_study.scene import jacksboro

DAY = "2016-06-21"


def test_lights_differ_by_what_was_asked():
    lights = lights_by_difference(jacksboro(), DAY, 8.0, [0, 45, 90, 180])
    np.testing.assert_allclose([light.difference for light in lights], [0, 45, 90, 180], atol=0.6)
    assert all(light.flight_sun.is_up for light in lights)
    where = pvlib.solarposition.get_solarposition(
        pd.DatetimeIndex([pd.Timestamp(lights[2].time.replace("Z", "+00:00"))]), 36.58958, -84.24583
    )
    assert float(where["azimuth"].iloc[0]) == pytest.approx(lights[2].flight_sun.azimuth, abs=0.5)


def test_a_difference_that_no_hour_has_is_refused():
    with pytest.raises(InputError, match="never stands at azimuth"):
        lights_by_difference(jacksboro(), "2016-12-21", 10.0, [180])


@pytest.mark.parametrize("day", ["yesterday's", "2016-06-21 10:00Z"])
def test_a_day_that_is_none_is_refused(day):
    with pytest.raises(InputError, match="date"):
        lights_by_difference(jacksboro(), day, 8.0, [0])


def test_only_hours_of_daylight_are_flown_and_winter_has_fewer():
    summer, winter = (
        lights_by_hour(jacksboro(), day, 10.5, range(24), 5.0) for day in (DAY, "2016-12-21")
    )
    assert 12 <= len(summer) <= 14 and 8 <= len(winter) <= 9
    assert all(light.flight_sun.zenith <= 85 for light in summer + winter)


def test_only_navigators_with_a_map_are_flown_into_gusts():
    lights = lights_by_difference(jacksboro(), DAY, 8.0, [0])
    tasks = flight_tasks("x", lights, [0.0, 1.0], ["pc", "odometry"], 3, Setup(), 10)
    assert [(t.gust, t.method) for t in tasks] == [(0, "pc"), (0, "odometry"), (1, "pc")]
    assert tasks[0].seeds == (10, 11, 12)


def test_a_task_gives_the_log_of_all_its_flights(relief):
    setup = Setup(frame_px=80, camera_px=80, legs=3, leg_px=14)
    lights = lights_by_difference(relief, DAY, 8.0, [60])
    (task,) = flight_tasks("hills", lights, [1.0], ["pc-sectors"], 2, setup, 5)
    log = fly_all(relief, task)
    assert set(log["flight"]) == {5, 6}
    assert (log.groupby("flight")["push_m"].max() > 0).all()
    summary = navigation_summary(log, setup.corridor_px)
    assert summary["flights"].item() == 2
    assert summary["sun_difference_deg"].item() == pytest.approx(60, abs=0.6)


def flight_rows(number, errors, **columns):
    n = len(errors)
    rows = {
        "site": "s", "method": "pc", "sweep": "difference", "time": "t",
        "sun_difference_deg": 30.0,
        "sun_zenith_deg": 40.0, "gust": 0.0, "flight": number, "step": range(n),
        "east": np.arange(n) * 1000.0, "north": 0.0,
        "believed_east": np.arange(n) * 1000.0, "believed_north": errors,
        "error_m": errors, "sight_error_m": errors,
        "next_error_m": errors, "off_route_m": 0.0, "to_end_m": 0.0, "push_m": 0.0,
        "trusted": True, "alarm": False, "ending": [""] * (n - 1) + ["arrived"], "ms": 5.0,
        "pixel_m": 10.0,
    }  # fmt: skip
    return pd.DataFrame(rows | columns)


def test_arrival_needs_the_truth_and_errors_count_where_the_uav_trusts_itself():
    steps = pd.concat(
        [
            flight_rows(1, [3.0, 4.0, 0.0]),
            flight_rows(2, [0.0, 99.0, 0.0], trusted=[True, False, True]),
            flight_rows(3, [0.0, 0.0, 60.0], to_end_m=60.0),
            flight_rows(4, [0.0, 0.0, 0.0], ending=["", "", "out of time"]),
        ]
    )
    row = navigation_summary(steps, 12.0).iloc[0]
    assert (row["flights"], row["arrival_rate"]) == (4, 0.5)
    assert row["rmse_m"] == pytest.approx(np.sqrt((9 + 16 + 3600) / 11))
    assert row["rmse_all_m"] == pytest.approx(np.sqrt((9 + 16 + 3600 + 99**2) / 12))
    assert row["max_error_m"] == 60.0
    assert row["wrong_rate"] == pytest.approx(1 / 11)


def test_alarms_are_counted_where_they_are_due_and_where_not():
    gust = {"gust": 1.0, "push_m": [0.0, 300.0, 0.0, 0.0]}
    steps = pd.concat(
        [
            # Noticed and back; noticed, never back; not noticed; and a false alarm before it.
            flight_rows(1, [0.0] * 4, alarm=[False, True, False, False], **gust),
            flight_rows(2, [0.0, 0.0, 500.0, 500.0], alarm=[False, True, False, False],
                        off_route_m=[0.0, 300.0, 300.0, 300.0], **gust),
            flight_rows(3, [0.0, 300.0, 300.0, 300.0], **gust),
            flight_rows(4, [0.0] * 4, alarm=[True, True, False, False], **gust),
        ]
    )  # fmt: skip
    row = navigation_summary(steps, 12.0).iloc[0]
    assert row["gusts"] == 4
    assert row["alarm_recall"] == 0.75
    assert row["recovery_rate"] == 0.5
    # Right fixes of an undisturbed UAV: three in the first flight, one in the second and
    # third, three in the last, where one was alarmed.
    assert row["right_fixes"] == 8
    assert row["false_alarm_rate"] == pytest.approx(1 / 8)


def test_what_cannot_alarm_has_no_alarm_rates():
    blind = flight_rows(1, [0.0] * 3, sight_error_m=np.nan)
    off = flight_rows(1, [0.0] * 3, method="pc-sectors, alarm off", gust=1.0, push_m=[0, 90.0, 0])
    for steps in (blind, off):
        row = navigation_summary(steps, 12.0).iloc[0]
        assert np.isnan(row["alarm_recall"]) and np.isnan(row["false_alarm_rate"])


def test_the_next_position_is_not_blamed_for_a_gust_or_a_lost_uav():
    steps = flight_rows(
        1, [0.0] * 4, next_error_m=[np.nan, 6.0, 900.0, 800.0],
        push_m=[0.0, 0.0, 300.0, 0.0], trusted=[True, True, False, True],
    )  # fmt: skip
    assert navigation_summary(steps, 12.0)["next_rmse_m"].item() == 6.0


def test_drift_is_the_slope_of_what_was_added_since_take_off_with_an_interval_over_routes():
    grown = [-40.0 + slope * np.arange(6) for slope in (1.0, 2.0, 3.0)]
    steps = pd.concat(
        [
            flight_rows(k, errors, time=time)
            for k, errors in enumerate(grown)
            for time in ("morning", "evening")
        ]
    )
    row = drift_slopes(steps).iloc[0]
    assert row["slope_m_per_km"] == pytest.approx(2.0)
    assert row["slope_low"] == pytest.approx(2.0 - 4.303 / np.sqrt(3), abs=1e-3)
    assert (row["flights"], row["routes"]) == (6, 3)


def test_without_calm_flights_the_tables_are_empty_but_whole():
    steps = flight_rows(1, [0.0] * 3, gust=1.0, push_m=[0.0, 9.0, 0.0])
    assert drift_slopes(steps).empty and "slope_m_per_km" in drift_slopes(steps)
    assert lost_from(navigation_summary(steps, 12.0)).columns.tolist()[-1] == "lost_from_deg"


def test_the_interval_of_an_error_holds_it_and_shrinks_with_the_flights():
    rng = np.random.default_rng(1)
    few, many = (
        pd.concat([flight_rows(k, np.abs(rng.normal(0, 8, 10))) for k in range(n)])
        for n in (8, 200)
    )
    widths = []
    for steps in (few, many):
        row = navigation_summary(steps, 12.0).iloc[0]
        assert row["rmse_px_low"] < row["rmse_px"] < row["rmse_px_high"]
        widths.append(row["rmse_px_high"] - row["rmse_px_low"])
    assert row["rmse_px_low"] < 0.8 < row["rmse_px_high"]
    assert widths[1] < widths[0] / 2


def test_a_method_is_lost_from_the_first_difference_where_flights_fail():
    summary = pd.DataFrame(
        {"site": "s", "method": "pc", "sweep": "difference", "gust": 0.0,
         "sun_difference_deg": [90.0, 0.0, 180.0],
         "arrival_rate": [0.4, 1.0, 1.0]}
    )  # fmt: skip
    assert lost_from(summary)["lost_from_deg"].item() == 90.0


@pytest.mark.slow
def test_the_parts_of_a_step_are_timed():
    table = step_times(Setup(), 96, 1, "pc-sectors", 3)
    assert table["part"].iloc[-1] == "whole step"
    assert {"rectify", "match", "trust", "next position"} <= set(table["part"])
    assert (table["ms"] >= 0).all() and table["share"].iloc[-1] == 1
