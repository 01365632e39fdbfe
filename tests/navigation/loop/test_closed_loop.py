"""Whole flights: what happens must follow from what was put in."""

import math

import numpy as np
import pandas as pd
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop import NAVIGATORS, navigator
from pcnav_study.navigation.loop.outcomes import ARRIVED_PX
from pcnav_study.scene import SunPosition


def flown(mission, name="pc-sectors"):
    return pd.DataFrame(list(mission.fly(navigator(name, mission))))


def test_without_wind_and_errors_the_uav_follows_its_route(flight):
    one = flight(calm=True)
    log = flown(one)
    assert log["ending"].iloc[-1] == "arrived"
    assert not log["alarm"].any()
    assert log["error_m"].max() < 0.3 * one.chart.pixel
    assert log["off_route_m"].max() < 0.5 * one.chart.pixel
    assert len(log) == 6
    assert log["next_error_m"].iloc[1:].max() < 0.6 * one.chart.pixel


def test_wind_turbulence_and_poor_sensors_do_not_lose_it(flight):
    one = flight(wind=12.0, turbulence=2.0, noise=0.05)
    log = flown(one)
    assert log["ending"].iloc[-1] == "arrived"
    assert log["error_m"].max() < one.chart.pixel


def test_a_bent_route_is_flown_round_its_corner(flight):
    grid = flight().chart.grid
    x, y = (float(axis.mean()) for axis in grid.mesh())
    route = [[x - 1500, y], [x, y], [x, y + 1500]]
    one = flight(calm=True, route=route, leg_px=12.0)
    log = flown(one)
    assert log["ending"].iloc[-1] == "arrived"
    assert log["to_end_m"].iloc[-1] < one.pilot.leg_m / 6
    assert log["off_route_m"].max() < one.pilot.leg_m


def test_a_flight_does_not_end_on_the_verge_of_arrival(flight):
    # What counts as arrived is five pixels; the UAV must aim closer than it is judged.
    ends = [flown(flight(seed=s, leg_px=20.0, legs=4)).iloc[-1] for s in range(8)]
    assert all(end["ending"] == "arrived" for end in ends)
    assert max(end["to_end_m"] for end in ends) < 0.7 * ARRIVED_PX * 30.0


def test_a_gust_raises_the_alarm_and_the_uav_comes_back(flight):
    one = flight(seed=4).with_gust(0.7 * 80 * 30.0, 2)
    log = flown(one)
    hit = log[log["push_m"] > 0].iloc[0]
    assert hit["step"] == 2 and hit["alarm"] and hit["reason"]
    assert hit["action"].startswith("found")
    assert hit["error_m"] < one.chart.pixel
    assert "re-planned" in hit["note"] or hit["off_route_m"] < one.pilot.corridor_m
    assert log["ending"].iloc[-1] == "arrived"
    assert not log.loc[log["push_m"] == 0, "alarm"].any()


def test_without_heeding_the_alarm_the_same_gusts_lose_it(flight):
    there = {"pc-sectors": 0, "pc-sectors, alarm off": 0}
    for seed in range(8):
        one = flight(seed=seed).with_gust(0.7 * 80 * 30.0, 2)
        for name in there:
            log = flown(one, name)
            there[name] += log["to_end_m"].iloc[-1] <= ARRIVED_PX * 30.0
            assert log["alarm"].any() == (name == "pc-sectors")
    assert there["pc-sectors"] == 8
    assert there["pc-sectors, alarm off"] <= 4  # some come back by chance


def test_failed_frames_raise_the_alarm_and_are_flown_through(flight):
    one = flight(failed_share=0.4, seed=6)
    assert one.failed_frames
    log = flown(one)
    failed = log["step"].isin(one.failed_frames)
    assert failed.any() and not failed.all()
    assert log.loc[failed, "alarm"].all()
    assert set(log.loc[failed, "action"]) <= {"hold", "return"}
    assert log["ending"].iloc[-1] == "arrived"


def test_when_every_frame_fails_the_uav_holds_then_turns_back_then_gives_up(flight):
    one = flight(failed_share=1.0)
    log = flown(one)
    assert log["action"].iloc[0] == "fix"  # the first frame is always good
    assert log["action"].tolist()[1:] == ["hold", "hold", "return", "return", "return"]
    assert "lost after 5 alarms" in log["ending"].iloc[-1]


def test_wind_and_gusts_are_the_same_whoever_navigates(flight):
    one = flight(seed=6, gust=1.0)
    logs = [flown(one, name) for name in ("pc-sectors", "odometry over relief")]
    pushes = [log["push_m"].max() for log in logs]
    assert pushes[0] == pushes[1] > 0
    assert logs[0]["push_m"].argmax() == logs[1]["push_m"].argmax()
    np.testing.assert_allclose(logs[0]["pitch"].iloc[:4], logs[1]["pitch"].iloc[:4])


def test_equal_seeds_give_equal_logs_and_others_do_not(flight):
    logs = [flown(flight(seed=s)).drop(columns="ms") for s in (3, 3, 5)]
    pd.testing.assert_frame_equal(logs[0], logs[1])
    assert not logs[0].equals(logs[2])


@pytest.mark.parametrize("name", NAVIGATORS)
def test_every_navigator_flies(flight, name):
    log = flown(flight(legs=3, suns=(SunPosition(100, 50), SunPosition(110, 50))), name)
    assert log["ending"].iloc[-1] == "arrived"
    assert np.isfinite(log["error_m"]).all()
    assert all(isinstance(a, str) and a for a in log["action"])


def test_an_unknown_navigator_is_refused_with_the_known_ones(flight):
    with pytest.raises(InputError, match=r"'astrolabe' is unknown; use one of: pc-sectors"):
        navigator("astrolabe", flight())


def test_a_sun_below_the_horizon_is_refused_before_take_off(flight):
    with pytest.raises(InputError, match=r"sun of the flight is 12 degrees below the horizon"):
        flight(suns=(SunPosition(100, 50), SunPosition(300, 102)))
    with pytest.raises(InputError, match=r"sun of the map"):
        flight(suns=(SunPosition(100, 95), SunPosition(300, 50)))


def test_a_route_off_the_map_is_refused_before_take_off(flight):
    grid = flight().chart.grid
    x, y = (float(axis.mean()) for axis in grid.mesh())
    with pytest.raises(InputError, match=r"waypoint 1 .*off the map"):
        flight(route=[[x, y], [x + 9000, y]])
    with pytest.raises(InputError, match="less than a map pixel"):
        flight(route=[[x, y], [x + 4, y]])


def test_a_flight_into_the_summits_is_refused(flight):
    with pytest.raises(InputError, match="meets the summits"):
        flight(frame_px=14.0, field_of_view=80.0)


@pytest.mark.parametrize(
    "wrong",
    [
        {"leg_px": 0.5},
        {"speed": 0.0},
        {"turbulence": -1.0},
        {"haze": 1.0},
        {"field_of_view": 150},
        {"attitude_sigma": 20},
    ],
)
def test_settings_that_make_no_sense_are_refused(flight, wrong):
    with pytest.raises(InputError):
        flight(**wrong)


def test_every_row_is_plain_enough_to_be_written(flight):
    for row in flight(legs=3).fly(navigator("odometry", flight(legs=3))):
        assert len(row["footprint"]) == 4
        for value in row.values():
            assert isinstance(value, (int, float, str, bool, list, np.generic))
        assert not math.isnan(row["error_m"])
