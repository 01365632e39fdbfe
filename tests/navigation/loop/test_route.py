"""Routes against brute force."""

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.pilot import Pilot
from pcnav_study.navigation.loop.route import Route, random_route
from pcnav_study.scene import Grid

BENT = np.array([[0.0, 0.0], [300.0, 0.0], [300.0, 400.0], [-100.0, 400.0]])
GRID = Grid.centred(0.0, 0.0, (30.0, 20.0), (100, 200), "EPSG:32611")  # 4000 m by 3000 m


def test_the_nearest_point_of_a_route_is_the_nearest_of_all(rng):
    route = Route(BENT)
    alongs = np.linspace(0, route.length, 20001)
    points = np.array([route.at(a) for a in alongs])
    for position in rng.uniform(-300, 600, (20, 2)):
        distances = np.hypot(*(points - position).T)
        place = route.place(position)
        assert place.off == pytest.approx(distances.min(), abs=0.1)
        assert np.hypot(*(route.at(place.along) - position)) == pytest.approx(place.off, abs=1e-6)


def test_a_point_along_a_route_is_clipped_to_its_ends():
    route = Route(BENT)
    assert route.length == 1100
    np.testing.assert_allclose(route.at(500), [300, 200])
    np.testing.assert_allclose(route.at(-5), BENT[0])
    np.testing.assert_allclose(route.at(5000), BENT[-1])


@pytest.mark.parametrize(
    ("points", "says"),
    [
        ([[0, 0]], "two waypoints"),
        ([[0, 0], [np.nan, 1]], "not a number"),
    ],
)
def test_what_is_no_route_is_refused(points, says):
    with pytest.raises(InputError, match=says):
        Route(np.array(points, float))


def test_waypoints_closer_than_a_pixel_are_refused():
    with pytest.raises(InputError, match=r"waypoints 1 and 2 .*pixel"):
        Route(np.array([[0.0, 0], [500, 0], [510, 0]])).checked(GRID, 100.0)


def test_a_waypoint_off_the_map_or_near_its_border_is_refused():
    route = Route(np.array([[0.0, 0], [1950.0, 0]]))
    assert route.checked(GRID, 40.0) is route
    with pytest.raises(InputError, match=r"waypoint 1 .*border"):
        route.checked(GRID, 60.0)
    with pytest.raises(InputError, match=r"waypoint 1 .*off the map"):
        Route(np.array([[0.0, 0], [0.0, 9000.0]])).checked(GRID, 0.0)


def test_random_routes_stay_on_the_map_and_differ():
    routes = [random_route(GRID, 8, 150.0, 300.0, np.random.default_rng(k)) for k in range(20)]
    for route in routes:
        route.checked(GRID, 300.0)
        np.testing.assert_allclose(route.legs, 150.0)
    assert len({tuple(r.waypoints[0]) for r in routes}) == 20


def test_a_map_too_small_for_a_route_is_refused():
    with pytest.raises(InputError, match="no route of 8 legs"):
        random_route(GRID, 8, 600.0, 300.0, np.random.default_rng(0))


def test_the_pilot_aims_one_leg_ahead_and_comes_back_from_the_side():
    pilot = Pilot(Route(BENT), 100.0, 10.0, 50.0)
    np.testing.assert_allclose(pilot.target(np.array([50.0, 0.0])), [150.0, 0.0])
    position = np.array([50.0, 260.0])
    assert "re-planned" in pilot.note(np.array([50.0, 80.0]))
    for _ in range(12):
        position = pilot.reached(position, pilot.target(position))
    assert pilot.route.place(position).off < 1e-6
    assert pilot.note(position) == ""


def test_the_pilot_flies_no_faster_than_it_can_and_against_the_wind():
    pilot = Pilot(Route(BENT), 100.0, 10.0, 50.0, sprint=1.5)
    far = np.array([0.0, -1000.0])
    assert np.hypot(*(pilot.reached(far, pilot.target(far)) - far)) == pytest.approx(150.0)
    wind = np.array([3.0, -4.0])
    start = np.array([0.0, 0.0])
    velocity = pilot.air_velocity(start, pilot.target(start), wind)
    np.testing.assert_allclose((velocity + wind) * 10.0, [100.0, 0.0])


def test_a_pilot_without_time_or_speed_is_refused():
    with pytest.raises(InputError, match="positive"):
        Pilot(Route(BENT), 100.0, 0.0, 50.0)
