"""Positions from frames, where the truth is known."""

from dataclasses import replace

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.chart import Chart
from pcnav_study.navigation.loop.lookout import Lookout
from pcnav_study.navigation.loop.patch import inscribed
from pcnav_study.navigation.loop.sensors import Sensors
from pcnav_study.navigation.loop.world import Air, Aircraft


@pytest.fixture(scope="module")
def view(flight):
    """A mission, a lookout over it, and what is seen from 400 m off its first waypoint."""
    one = flight(calm=True)
    start = one.pilot.route.waypoints[0]
    uav = Aircraft(start, one.scene.height, 30.0, Air(), 2.0, np.random.default_rng(5))
    seen = Sensors(one.instruments, np.random.default_rng(0)).observe(uav, one.scene, 0.0)
    return one, Lookout(one.chart, one.scene.camera), seen, start


@pytest.mark.parametrize("off", [(0.0, 0.0), (130.0, -200.0), (-300.0, 55.0)])
def test_a_frame_is_found_to_a_fraction_of_a_pixel_wherever_it_was_believed(view, off):
    one, lookout, seen, truth = view
    sight = lookout.look(seen, truth + off, 12)
    assert np.hypot(*(sight.position - truth)) < 0.3 * one.chart.pixel
    assert not sight.trust.alarm


def test_the_forward_part_finds_the_same_place(view):
    one, lookout, seen, truth = view
    sight = lookout.look(seen, truth + 60.0, 12)
    ahead = lookout.ahead(sight, truth + np.array([200.0, 300.0]), 12)
    assert np.hypot(*(ahead - truth)) < 0.6 * one.chart.pixel


@pytest.mark.parametrize("whole", [False, True])
def test_a_wide_search_finds_what_is_a_frame_away(view, whole):
    one, lookout, seen, truth = view
    away = np.array([0.6, 0.5]) * one.frame_m * np.sign(one.chart.grid.mesh()[0].mean() - truth[0])
    sight = lookout.look(seen, truth + away, 90, whole=whole)
    assert np.hypot(*(sight.position - truth)) < 0.5 * one.chart.pixel
    assert np.hypot(*(lookout.look(seen, truth + away, 12).position - truth)) > one.frame_m / 3


@pytest.mark.parametrize("spoil", ["black", "missing", "infinite", "noise"])
def test_a_frame_that_shows_nothing_is_not_trusted(view, spoil):
    _, lookout, seen, truth = view
    frame = {
        "black": np.zeros_like(seen.frame),
        "missing": np.full_like(seen.frame, np.nan),
        "infinite": np.where(np.eye(*seen.frame.shape) > 0, np.inf, seen.frame),
        "noise": np.random.default_rng(0).standard_normal(seen.frame.shape).astype(np.float32),
    }[spoil]
    sight = lookout.look(replace(seen, frame=frame), truth, 12)
    assert sight.trust.alarm
    assert np.isfinite(sight.position).all()


def test_off_the_map_nothing_is_trusted_and_nothing_breaks(view):
    _, lookout, seen, truth = view
    sight = lookout.look(seen, truth + np.array([1e5, 0.0]), 12)
    assert sight.trust.alarm and sight.patch is None
    assert lookout.ahead(sight, truth, 12) is None


def test_the_inscribed_square_is_the_largest_that_fits(rng):
    for _ in range(20):
        turn = rng.uniform(0, np.pi)
        sides = rng.uniform(20, 60, 2)
        rot = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        unit = np.array([[-1, -1], [-1, 1], [1, 1], [1, -1]]) / 2
        corners = (unit * sides) @ rot.T + 100
        low, high = inscribed(corners)
        half = (high - low)[0] / 2
        square = np.array([[-1, -1], [-1, 1], [1, 1], [1, -1]])

        def fits(h, sides=sides, rot=rot, square=square):
            return (np.abs((h * square) @ rot) <= sides / 2 + 1e-9).all()

        assert fits(half) and not fits(half + 0.01)


def test_a_map_and_an_elevation_of_other_sizes_are_refused(relief):
    with pytest.raises(InputError, match="one grid"):
        Chart(relief[:-1], relief)


def test_beyond_its_border_a_chart_has_no_pixels(relief):
    chart = Chart(relief, relief)
    cut = chart.pixels((-3, 318), (5, 4))
    np.testing.assert_array_equal(cut[3:, :2], relief.values[:2, 318:])
    assert np.isnan(cut[:3]).all() and np.isnan(cut[:, 2:]).all()
    assert np.isfinite(chart.heights((-3, 318), (5, 4))).all()
    assert np.isnan(chart.pixels((900, 0), (4, 4))).all()
