"""The pinhole camera against explicit matrices and plane geometry."""

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.scene import Camera, Pose

CAMERA = Camera((121, 161), 150.0, (3.0, -5.0))
LEVEL = Camera((100, 140), 120.0)


def rx(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def ry(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def rz(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def random_pose(rng):
    yaw, pitch, roll = rng.uniform([0, -25, -25], [360, 25, 25])
    east, north, height = rng.uniform([-500, -500, 1500], [500, 500, 2500])
    return Pose.from_yaw_pitch_roll((east, north, height), yaw, pitch, roll)


@pytest.mark.parametrize("k", range(8))
def test_projecting_a_point_on_a_ray_gives_the_pixel_back(k):
    rng = np.random.default_rng(k)
    pose = random_pose(rng)
    rows, cols = rng.uniform(0, 120, (5, 6)), rng.uniform(0, 160, (5, 6))
    depth = rng.uniform(10, 3000, (5, 6, 1))
    points = pose.position + depth * CAMERA.rays(rows, cols, pose)
    found_rows, found_cols = CAMERA.project(points, pose)
    np.testing.assert_allclose(found_rows, rows, atol=1e-8)
    np.testing.assert_allclose(found_cols, cols, atol=1e-8)


def test_points_behind_the_camera_have_no_image():
    pose = Pose.from_yaw_pitch_roll((0, 0, 100), 30)
    rows, cols = LEVEL.project(np.array([[0, 0, 150.0], [0, 0, 100.0], [0, 0, 50.0]]), pose)
    np.testing.assert_array_equal(np.isnan(rows), [True, True, False])
    np.testing.assert_array_equal(np.isnan(cols), [True, True, False])


@pytest.mark.parametrize(
    ("yaw", "towards"), [(0, (0, 1)), (90, (1, 0)), (180, (0, -1)), (270, (-1, 0)), (45, (1, 1))]
)
def test_the_top_of_the_image_points_where_the_yaw_says(yaw, towards):
    ray = LEVEL.rays(0, LEVEL.centre[1], Pose.from_yaw_pitch_roll((0, 0, 0), yaw))
    np.testing.assert_allclose(
        ray[:2] / np.linalg.norm(ray[:2]), np.array(towards) / np.hypot(*towards), atol=1e-12
    )
    assert ray[2] < 0


def test_the_right_of_the_image_is_east_when_flying_north():
    ray = LEVEL.rays(LEVEL.centre[0], 139, Pose.from_yaw_pitch_roll((0, 0, 0), 0))
    assert ray[0] > 0 and ray[1] == pytest.approx(0)


@pytest.mark.parametrize(
    ("yaw", "pitch", "roll", "east", "north"),
    [
        (0, 10, 0, 0, 1),  # nose up: looks ahead, to the north
        (0, -10, 0, 0, -1),
        (90, 10, 0, 1, 0),
        (0, 0, 10, -1, 0),  # right wing down: the belly looks to the left, west
        (0, 0, -10, 1, 0),
        (90, 0, 10, 0, 1),  # flying east, left is north
    ],
)
def test_nose_up_looks_ahead_and_right_wing_down_looks_left(yaw, pitch, roll, east, north):
    ray = LEVEL.rays(*LEVEL.centre, Pose.from_yaw_pitch_roll((0, 0, 0), yaw, pitch, roll))
    aside = np.sin(np.radians(10))
    np.testing.assert_allclose(
        ray, [east * aside, north * aside, -np.cos(np.radians(10))], atol=1e-12
    )


@pytest.mark.parametrize("angles", [(0, 0, 90), (5, 0, 0), (0, 7, 0), (3, -4, 170), (-8, 6, -33)])
def test_omega_phi_kappa_are_the_three_turns_in_that_order(angles):
    omega, phi, kappa = angles
    pose = Pose.from_omega_phi_kappa((1, 2, 3), *angles)
    np.testing.assert_allclose(pose.rotation, rx(omega) @ ry(phi) @ rz(kappa), atol=1e-12)
    np.testing.assert_array_equal(pose.position, [1, 2, 3])


@pytest.mark.parametrize("angles", [(90, 0, 0), (30, 12, 0), (200, 5, -9), (300, -15, 8)])
def test_yaw_pitch_roll_are_heading_then_nose_then_wing(angles):
    yaw, pitch, roll = angles
    pose = Pose.from_yaw_pitch_roll((0, 0, 0), *angles)
    np.testing.assert_allclose(pose.rotation, rz(-yaw) @ rx(pitch) @ ry(roll), atol=1e-12)


def test_kappa_is_minus_yaw():
    one = Pose.from_omega_phi_kappa((0, 0, 0), 0, 0, -40)
    other = Pose.from_yaw_pitch_roll((0, 0, 0), 40)
    np.testing.assert_allclose(one.rotation, other.rotation, atol=1e-12)


@pytest.mark.parametrize("k", range(5))
def test_level_ground_is_imaged_by_the_plane_homography(k):
    rng = np.random.default_rng(100 + k)
    pose = random_pose(rng)
    ground_height = 120.0
    # Image (column, row) from camera axes that look along +z with y down.
    calibration = np.array(
        [[150.0, 0, CAMERA.centre[1]], [0, 150.0, CAMERA.centre[0]], [0, 0, 1]]
    ) @ np.diag([1, -1, -1])
    to_camera = pose.rotation.T
    homography = calibration @ np.stack(
        [
            to_camera[:, 0],
            to_camera[:, 1],
            to_camera @ (np.array([0, 0, ground_height]) - pose.position),
        ],
        axis=1,
    )
    ground = rng.uniform(-400, 400, (30, 2)) + pose.position[:2]
    col, row, scale = homography @ np.vstack([ground.T, np.ones(30)])
    points = np.column_stack([ground, np.full(30, ground_height)])
    rows, cols = CAMERA.project(points, pose)
    np.testing.assert_allclose(rows, row / scale, atol=1e-7)
    np.testing.assert_allclose(cols, col / scale, atol=1e-7)


@pytest.mark.parametrize("fov", [20.0, 60.0, 100.0])
@pytest.mark.parametrize("yaw", [0.0, 90.0, 33.0])
def test_the_footprint_is_as_wide_as_the_field_of_view_says(fov, yaw):
    camera = Camera.from_field_of_view((80, 120), fov)
    pose = Pose.from_yaw_pitch_roll((500, 600, 1200), yaw)
    corners = camera.footprint(pose, 200.0)
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=0), axis=1)
    width = 2 * 1000 * np.tan(np.radians(fov) / 2)
    np.testing.assert_allclose(sides, [width, width * 80 / 120] * 2, rtol=1e-9)
    np.testing.assert_allclose(corners.mean(axis=0), [500, 600], atol=1e-6)


def test_footprint_corners_go_round_from_the_upper_left():
    corners = LEVEL.footprint(Pose.from_yaw_pitch_roll((0, 0, 100), 0), 0.0)
    np.testing.assert_array_equal(np.sign(corners), [[-1, 1], [1, 1], [1, -1], [-1, -1]])


def test_a_moved_pose_keeps_height_and_attitude():
    pose = Pose.from_yaw_pitch_roll((1, 2, 3), 40, 5, 6)
    moved = pose.moved(10, -20)
    np.testing.assert_array_equal(moved.position, [11, -18, 3])
    np.testing.assert_array_equal(moved.rotation, pose.rotation)


@pytest.mark.parametrize(("pitch", "roll"), [(90, 0), (75, 0), (0, 80), (180, 0)])
def test_a_camera_that_sees_the_horizon_has_no_footprint(pitch, roll):
    with pytest.raises(InputError, match="horizon"):
        LEVEL.footprint(Pose.from_yaw_pitch_roll((0, 0, 100), 0, pitch, roll), 0.0)


@pytest.mark.parametrize("height", [50.0, 49.0, -100.0])
def test_a_camera_under_ground_has_no_footprint(height):
    with pytest.raises(InputError, match="not above ground 50 m"):
        LEVEL.footprint(Pose.from_yaw_pitch_roll((0, 0, height), 0), 50.0)


@pytest.mark.parametrize(
    ("shape", "focal"), [((0, 10), 5), ((10, -1), 5), ((10, 10), 0), ((10, 10), float("nan"))]
)
def test_an_impossible_camera_is_refused(shape, focal):
    with pytest.raises(InputError, match="must be positive"):
        Camera(shape, focal)
