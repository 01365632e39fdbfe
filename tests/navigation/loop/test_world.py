"""Wind, gusts and instruments against their own statistics."""

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.sensors import Instruments, Sensors
from pcnav_study.navigation.loop.world import Air, Aircraft, push_on_the_map
from pcnav_study.scene import Grid

NOWHERE = np.zeros(2)


def aircraft(air, seed=0, sigma=0.0):
    return Aircraft(NOWHERE, 3000.0, 45.0, air, sigma, np.random.default_rng(seed))


def test_in_still_air_the_uav_flies_as_commanded_and_turns_into_its_way():
    uav = aircraft(Air())
    uav.fly(np.array([-20.0, 0.0]), 10.0, NOWHERE)
    np.testing.assert_allclose(uav.position, [-200.0, 0.0])
    assert uav.yaw == pytest.approx(270.0)
    uav.fly(NOWHERE, 10.0, NOWHERE)
    assert uav.yaw == pytest.approx(270.0)


def test_the_wind_carries_and_the_gust_pushes():
    uav = aircraft(Air((3.0, -1.0)))
    uav.fly(np.array([10.0, 0.0]), 10.0, np.array([0.0, 500.0]))
    np.testing.assert_allclose(uav.position, [130.0, 490.0])
    np.testing.assert_allclose(uav.velocity, [13.0, -1.0])  # the push is not in it


def test_turbulence_displaces_as_an_integrated_gauss_markov_process():
    sigma, memory, seconds, ends = 1.5, 20.0, 60.0, []
    for seed in range(1500):
        uav = aircraft(Air(turbulence=sigma, correlation_s=memory), seed)
        uav.fly(NOWHERE, seconds, NOWHERE)
        ends.append(uav.position[0])
    share = seconds / memory
    expected = sigma * memory * np.sqrt(2 * (share - 1 + np.exp(-share)))
    assert np.std(ends) == pytest.approx(expected, rel=0.08)


def test_negative_turbulence_is_refused():
    with pytest.raises(InputError, match="turbulence"):
        Air(turbulence=-1.0)


def test_pushes_stay_on_the_map_and_are_as_long_as_asked_where_there_is_room():
    grid = Grid.centred(0.0, 0.0, (30.0, 30.0), (200, 200), "EPSG:32611")
    rng = np.random.default_rng(1)
    for _ in range(200):
        start = rng.uniform(-2000, 2000, 2)
        push = push_on_the_map(start, 1500.0, grid, 900.0, rng)
        assert np.abs(start + push).max() <= 2100.0
        assert np.hypot(*push) == pytest.approx(1500.0)
    assert np.hypot(*push_on_the_map(NOWHERE, 50_000.0, grid, 900.0, rng)) < 2970.0


def test_instruments_without_error_tell_the_truth(flight):
    one = flight(calm=True)
    uav = aircraft(Air((3.0, 1.0)))
    uav.position = one.pilot.route.waypoints[0]
    uav.height = one.scene.height
    seen = Sensors(one.instruments, np.random.default_rng(0)).observe(uav, one.scene, 0.0)
    assert (seen.yaw, seen.pitch, seen.roll, seen.height) == (45.0, 0.0, 0.0, one.scene.height)
    np.testing.assert_allclose(seen.velocity, [3.0, 1.0])
    assert np.isfinite(seen.frame).all()


def test_the_velocitys_bias_walks_and_the_height_is_off_by_a_constant(flight):
    one = flight(calm=True)
    uav = aircraft(Air())
    uav.position, uav.height = one.pilot.route.waypoints[0], one.scene.height
    of = Instruments(0.0, 50.0, 0.0, 0.0, 0.2, 0.0)
    ends, heights = [], []
    for seed in range(40):
        sensors = Sensors(of, np.random.default_rng(seed))
        seen = [sensors.observe(uav, one.scene, 25.0, failed=True) for _ in range(4)]
        ends.append(seen[-1].velocity)
        heights.append({s.height for s in seen})
    assert np.std(ends) == pytest.approx(0.2 * np.sqrt(100.0), rel=0.25)
    assert all(len(h) == 1 for h in heights)
    assert np.std([h.pop() for h in heights]) == pytest.approx(50.0, rel=0.4)


def test_a_failed_frame_is_black(flight):
    one = flight(calm=True)
    uav = aircraft(Air())
    uav.position, uav.height = one.pilot.route.waypoints[0], one.scene.height
    sensors = Sensors(one.instruments, np.random.default_rng(0))
    assert not sensors.observe(uav, one.scene, 0.0, failed=True).frame.any()


def test_haze_takes_contrast_and_leaves_the_mean(flight):
    clear, veiled = (flight(calm=True, haze=h) for h in (0.0, 0.75))
    uav = aircraft(Air())
    uav.position, uav.height = clear.pilot.route.waypoints[0], clear.scene.height
    one, other = (m.scene.photograph(uav.pose, np.random.default_rng(0)) for m in (clear, veiled))
    assert other.mean() == pytest.approx(one.mean(), rel=1e-4)
    assert other.std() == pytest.approx(0.25 * one.std(), rel=1e-4)
