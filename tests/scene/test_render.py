"""Rendered frames against ray-plane algebra, and a simulated flight."""

import sys

import numpy as np
import pandas as pd
import pytest

from pcnav_study.errors import InputError
from pcnav_study.frames import rectify
from pcnav_study.scene import (
    Camera,
    Grid,
    Pose,
    SunPosition,
    fly,
    fractal_albedo,
    fractal_relief,
    jacksboro,
    render,
    shade,
    waypoints,
)

GRID = Grid.centred(5000.0, 9000.0, (30.0, 20.0), (120, 160), "EPSG:32616")
CAMERA = Camera((40, 56), 60.0)
POSES = {
    "straight down": (0, 0, 0),
    "flying east": (90, 0, 0),
    "tilted": (215, 12, -9),
}


def ramp(x, y):
    """Brightness that grows to the east and falls to the north; bilinear look-up is exact."""
    return 2.0 + 0.003 * (x - 5000) - 0.001 * (y - 9000)


@pytest.mark.parametrize("name", POSES)
@pytest.mark.parametrize(("east_rise", "north_rise"), [(0, 0), (0.2, 0), (0, -0.15), (0.1, 0.2)])
def test_each_pixel_shows_the_ground_point_that_its_ray_meets(name, east_rise, north_rise):
    x, y = GRID.mesh()
    ground = GRID.image(400 + east_rise * (x - 5000) + north_rise * (y - 9000))
    pose = Pose.from_yaw_pitch_roll((5050, 8950, 1600), *POSES[name])
    image = render(GRID.image(ramp(x, y)), ground, CAMERA, pose)
    rows, cols = np.indices(CAMERA.shape)
    inside = np.stack(
        [(cols - 27.5) / 60.0, (19.5 - rows) / 60.0, np.full(CAMERA.shape, -1.0)], axis=-1
    )
    rays = inside @ pose.rotation.T
    normal = np.array([-east_rise, -north_rise, 1.0])
    depth = (np.array([5000, 9000, 400]) - pose.position) @ normal / (rays @ normal)
    hit = pose.position + depth[..., None] * rays
    assert np.isfinite(image).all()
    np.testing.assert_allclose(image, ramp(hit[..., 0], hit[..., 1]), atol=2e-4)


def hilly(seed=5):
    rng = np.random.default_rng(seed)
    ground = GRID.image(600 + fractal_relief(GRID.shape, (30, 20), rng, median_slope=15))
    return ground, GRID.image(fractal_albedo(GRID.shape, 0.2, rng, exponent=2.2))


@pytest.mark.parametrize("name", POSES)
def test_rectifying_over_the_true_relief_undoes_rendering_and_level_ground_does_not(name):
    ground, radiance = hilly()
    camera = Camera((160, 160), 200.0)
    pose = Pose.from_yaw_pitch_roll((5000, 9000, 2600), *POSES[name])
    image = render(radiance, ground, camera, pose)
    inner = GRID.window(48, 60, (24, 40))
    part = np.s_[48:72, 60:100]
    truth = radiance.values[part]
    over_relief = rectify(image, camera, pose, inner, ground.values[part])
    over_level = rectify(image, camera, pose, inner, float(ground.mean()))
    seen = np.isfinite(over_relief) & np.isfinite(over_level)
    assert seen.mean() > 0.6

    def error(rectified):
        return np.sqrt(np.mean((rectified - truth)[seen] ** 2)) / truth[seen].std()

    assert error(over_relief) < 0.1
    assert error(over_level) > 2 * error(over_relief)


def test_a_ray_stops_at_the_first_ground_it_meets():
    x, _ = GRID.mesh()
    wall = GRID.image(np.where(np.abs(x - 5000) < 45, 500.0, 0.0))
    colour = GRID.image(np.where(x < 5000, 1.0, 2.0))
    # From the west, looking east and down: what lies behind the wall is hidden by it.
    pose = Pose.from_yaw_pitch_roll((4500, 9000, 700), 90, 45)
    row, col = CAMERA.project(np.array([5150.0, 9000.0, 0.0]), pose)
    image = render(colour, wall, CAMERA, pose)
    assert image[round(float(row)), round(float(col))] < 1.5


def test_pixels_off_the_map_hold_no_data():
    flat, ones = GRID.image(np.zeros(GRID.shape)), GRID.image(np.ones(GRID.shape))
    west = GRID.mesh()[0].min()
    image = render(ones, flat, CAMERA, Pose.from_yaw_pitch_roll((west, 9000, 1000), 0))
    assert np.isnan(image[:, :27]).all()
    assert (image[:, 29:] == 1).all()
    far = render(ones, flat, CAMERA, Pose.from_yaw_pitch_roll((0, 0, 1000), 0))
    assert np.isnan(far).all()


@pytest.mark.parametrize("pitch", [75, 90, 110, 180])
def test_the_sky_holds_no_data(pitch):
    flat, ones = GRID.image(np.zeros(GRID.shape)), GRID.image(np.ones(GRID.shape))
    pose = Pose.from_yaw_pitch_roll((5000, 9000, 50), 0, pitch)
    image = render(ones, flat, CAMERA, pose)
    upward = CAMERA.rays(*np.indices(CAMERA.shape), pose)[..., 2] >= 0
    assert upward.any()
    assert np.isnan(image[upward]).all()


def test_summits_above_the_camera_do_not_show_behind_it():
    x, _ = GRID.mesh()
    ground = GRID.image(np.where(x < 4950, 500.0, 0.0))  # a cliff to the west, above the camera
    colour = GRID.image(np.where(ground.values > 0, 5.0, 1.0))
    pose = Pose.from_yaw_pitch_roll((5000, 9000, 200), 90, 40)  # looks east, away from it
    image = render(colour, ground, CAMERA, pose)
    seen = image[np.isfinite(image)]
    assert seen.size and seen.max() == 1


def test_a_ray_that_comes_in_under_the_ground_sees_nothing():
    x, _ = GRID.mesh()
    west = x.min()
    ground = GRID.image(np.where(x < west + 2500, 500.0, 0.0))
    ones = GRID.image(np.ones(GRID.shape))
    pose = Pose.from_yaw_pitch_roll((west - 300, 9000, 1100), 90, 35)
    # Both lie in the map below the plateau; the ray to the one leaves the air off the map.
    points = np.array([[west + 50, 9000, 300.0], [west + 300, 9000, 500.0]])
    rows, cols = (np.rint(v).astype(int) for v in CAMERA.project(points, pose))
    image = render(ones, ground, CAMERA, pose)
    assert np.isnan(image[rows[0], cols[0]])
    assert image[rows[1], cols[1]] == 1


FLAT = GRID.image(np.full(GRID.shape, 100.0))
SUNS = pd.DataFrame({"time": ["a", "b"], "azimuth": [10.0, 250.0], "zenith": [40.0, 55.0]})


def flight(seed=0, **changes):
    settings = dict(
        height_above_ground=800.0,
        attitude_sigma=0.0,
        position_sigma=0.0,
        noise=0.0,
        shadows=False,
        rng=np.random.default_rng(seed),
    )
    route = waypoints(FLAT, (0.5, 0.4), (0.4, 0.6), 3)
    albedo = fractal_albedo(GRID.shape, 0.1, np.random.default_rng(9))
    sun = SunPosition(350, 40)
    return fly(FLAT, albedo, SUNS, sun, route, Camera((12, 16), 20), **settings | changes)


def test_waypoints_run_straight_and_evenly_from_start_to_end():
    route = waypoints(FLAT, (0.25, 0.0), (0.75, 1.0), 5)
    west, north = GRID.transform.c, GRID.transform.f
    np.testing.assert_allclose(route[0], [west, north - 0.25 * 120 * 30])
    np.testing.assert_allclose(route[-1], [west + 160 * 20, north - 0.75 * 120 * 30])
    np.testing.assert_allclose(np.diff(route, 2, axis=0), 0, atol=1e-6)


@pytest.mark.parametrize("end", [(1.2, 0.5), (0.5, -0.1)])
def test_a_route_that_leaves_the_map_is_refused(end):
    with pytest.raises(InputError, match="route"):
        waypoints(FLAT, (0.5, 0.5), end, 4)


def test_every_waypoint_is_flown_once_under_every_sun():
    log = flight()
    assert log["frames"].shape == (6, 12, 16)
    assert log["frames"].dtype == np.float32
    assert log["time"].values.tolist() == ["a"] * 3 + ["b"] * 3
    assert log["waypoint"].values.tolist() == [0, 1, 2] * 2
    np.testing.assert_allclose(log["sun_difference"], [20] * 3 + [100] * 3)
    np.testing.assert_allclose(log["height"], 900)
    assert len(set(log["frame"].values)) == 6


def test_the_camera_is_turned_along_the_route():
    log = flight()
    heading = np.degrees(np.arctan2(0.2 * 160 * 20, 0.1 * 120 * 30))
    np.testing.assert_allclose(log["yaw"], heading)


def test_a_flight_over_level_ground_darkens_with_the_zenith():
    log = flight()
    one, other = log["frames"][:3], log["frames"][3:]
    ratio = np.cos(np.radians(55)) / np.cos(np.radians(40))
    np.testing.assert_allclose(other, one * ratio, rtol=1e-5)


def test_without_errors_the_uav_believes_the_truth_and_with_them_it_does_not():
    exact = flight()
    np.testing.assert_array_equal(exact["believed_east"], exact["east"])
    assert not exact["pitch"].any() and not exact["roll"].any()
    wrong = flight(position_sigma=50.0, attitude_sigma=2.0)
    off = np.concatenate([wrong[f"believed_{n}"] - wrong[n] for n in ("east", "north")])
    assert 15 < off.std() < 120
    assert 0.5 < np.concatenate([wrong["pitch"], wrong["roll"]]).std() < 5


def test_noise_is_a_share_of_the_frames_own_deviation():
    clean, noisy = flight()["frames"].values, flight(noise=0.5)["frames"].values
    for one, other in zip(clean, noisy, strict=True):
        assert (other - one).std() / one.std() == pytest.approx(0.5, rel=0.25)


def test_equal_seeds_give_equal_flights_and_others_do_not():
    errors = {"position_sigma": 30.0, "attitude_sigma": 1.0, "noise": 0.1}
    assert flight(4, **errors).identical(flight(4, **errors))
    assert not flight(4, **errors).equals(flight(5, **errors))


def test_the_built_in_tile_can_be_flown_over():
    ground = jacksboro()
    albedo = np.ones(ground.shape)
    route = waypoints(ground, (0.5, 0.4), (0.5, 0.6), 2)
    log = fly(
        ground,
        albedo,
        SUNS[:1],
        SunPosition(10, 40),
        route,
        Camera.from_field_of_view((16, 16), 60),
        height_above_ground=5000.0,
        attitude_sigma=0.0,
        position_sigma=0.0,
        noise=0.0,
        shadows=False,
        rng=np.random.default_rng(0),
    )
    assert np.isfinite(log["frames"]).all()
    np.testing.assert_allclose(log["yaw"], 90)


def test_iteration_and_marching_find_the_same_ground(monkeypatch):
    ground = jacksboro()
    x, y = (axis.mean() for axis in Grid.of(ground).mesh())
    picture = shade(ground, sun=SunPosition(120, 50))
    camera = Camera.from_field_of_view((64, 64), 50)
    pose = Pose.from_yaw_pitch_roll((x, y, 9000), 30, 2, -1)
    iterated = render(picture, ground, camera, pose)
    monkeypatch.setattr(sys.modules["pcnav_study.scene.render"], "CONTRACTION", 0.0)
    marched = render(picture, ground, camera, pose)
    assert not np.array_equal(iterated, marched)
    assert np.abs(iterated - marched).max() < 0.05 * iterated.std()
