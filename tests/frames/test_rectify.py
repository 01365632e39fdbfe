"""Rectification against scikit-image's homography, and the square in a footprint."""

import numpy as np
import pytest
from scipy import ndimage
from skimage.transform import ProjectiveTransform, warp

from pcnav_study.errors import InputError
from pcnav_study.frames import bounding_grid, central_grid, occluded, rectify
from pcnav_study.scene import Camera, Grid, Pose

CRS = "EPSG:32616"
CAMERA = Camera((90, 120), 130.0)


def smooth(rng, shape):
    return ndimage.gaussian_filter(rng.normal(size=shape), 2.5) * 50


@pytest.mark.parametrize("angles", [(0, 0, 0), (90, 0, 0), (37, 0, 0), (200, 8, -6), (310, -12, 9)])
def test_level_ground_is_rectified_as_scikit_image_warps_the_footprint(rng, angles):
    frame = smooth(rng, CAMERA.shape)
    pose = Pose.from_yaw_pitch_roll((1000, 2000, 700), *angles)
    corners = CAMERA.footprint(pose, 100.0)
    grid = Grid.centred(*corners.mean(axis=0), (5.0, 4.0), (60, 70), CRS)
    in_frame = np.array([[-0.5, -0.5], [119.5, -0.5], [119.5, 89.5], [-0.5, 89.5]])
    rows, cols = grid.row_col(corners[:, 0], corners[:, 1])
    # scikit-image's warp asks where each output pixel (column, row) comes from.
    back = ProjectiveTransform.from_estimate(np.column_stack([cols, rows]), in_frame)
    expected = warp(frame, back, output_shape=grid.shape, order=1, cval=np.nan)
    found = rectify(frame, CAMERA, pose, grid, 100.0)
    both = np.isfinite(found) & np.isfinite(expected)
    assert both.mean() > 0.6
    np.testing.assert_allclose(found[both], expected[both], atol=1e-3)
    assert (np.isfinite(found) != np.isfinite(expected)).mean() < 0.02


def test_ground_given_as_a_number_or_as_a_level_array_is_the_same(rng):
    frame = smooth(rng, CAMERA.shape)
    pose = Pose.from_yaw_pitch_roll((0, 0, 500), 20, 3, 4)
    grid = Grid.centred(0.0, 0.0, (4.0, 4.0), (40, 40), CRS)
    one = rectify(frame, CAMERA, pose, grid, 60.0)
    other = rectify(frame, CAMERA, pose, grid, np.full((40, 40), 60.0))
    np.testing.assert_array_equal(one, other)
    assert one.dtype == np.float32


def test_higher_ground_is_looked_up_farther_from_the_middle():
    cols = np.indices(CAMERA.shape)[1].astype(float)
    pose = Pose.from_yaw_pitch_roll((0, 0, 1000), 0)
    grid = Grid.centred(0.0, 0.0, (4.0, 4.0), (41, 41), CRS)
    low, high = (rectify(cols, CAMERA, pose, grid, g) for g in (0.0, 500.0))
    x, _ = grid.mesh()
    np.testing.assert_allclose(low, 59.5 + 130 * x / 1000, atol=1e-3)
    np.testing.assert_allclose(high, 59.5 + 130 * x / 500, atol=1e-3)


def test_shrinking_by_four_averages_fine_chequers_out():
    camera = Camera((400, 400), 400.0)
    chequers = np.indices((400, 400)).sum(axis=0) % 2 * 2.0
    pose = Pose.from_yaw_pitch_roll((0, 0, 400), 0)  # one metre a frame pixel
    grid = Grid.centred(0.5, 0.5, (4.0, 4.0), (80, 80), CRS)  # centres on frame pixels
    found = rectify(chequers, camera, pose, grid, 0.0)
    np.testing.assert_allclose(found, 1, atol=0.05)


@pytest.mark.parametrize("shrink", [2, 3, 4, 7])
def test_shrinking_keeps_everything_in_its_place(shrink):
    camera = Camera((403, 401), 400.0)
    rows, cols = np.indices(camera.shape).astype(float)
    pose = Pose.from_yaw_pitch_roll((50, 70, 400), 0)
    grid = Grid.centred(50.0, 70.0, (float(shrink), float(shrink)), (40, 40), CRS)
    x, y = grid.mesh()
    for ramp, expected in ((cols, 200 + x - 50), (rows, 201 - (y - 70))):
        np.testing.assert_allclose(rectify(ramp, camera, pose, grid, 0.0), expected, atol=1e-3)


def test_no_data_and_ground_outside_the_picture_become_nan():
    frame = np.ones(CAMERA.shape)
    frame[:, :60] = np.nan
    pose = Pose.from_yaw_pitch_roll((0, 0, 130), 0)  # one metre a pixel, 120 by 90
    grid = Grid.centred(0.0, 0.0, (1.0, 1.0), (140, 140), CRS)
    found = rectify(frame, CAMERA, pose, grid, 0.0)
    assert np.isnan(found[:20]).all() and np.isnan(found[:, 135:]).all()
    assert np.isnan(found[:, :69]).all()
    assert (found[30:110, 72:125] == 1).all()


def test_rectifying_leaves_the_frame_as_it_was(rng):
    frame = smooth(rng, CAMERA.shape)
    frame.setflags(write=False)
    pose = Pose.from_yaw_pitch_roll((0, 0, 500), 20)
    before = frame.copy()
    rectify(frame, CAMERA, pose, Grid.centred(0.0, 0.0, (9.0, 9.0), (40, 40), CRS), 60.0)
    np.testing.assert_array_equal(frame, before)


@pytest.mark.parametrize("shape", [(120, 90), (90, 119), (45, 60)])
def test_a_frame_of_another_size_is_refused(shape):
    pose = Pose.from_yaw_pitch_roll((0, 0, 500), 0)
    grid = Grid.centred(0.0, 0.0, (4.0, 4.0), (40, 40), CRS)
    with pytest.raises(InputError, match=r"does not fit the camera"):
        rectify(np.zeros(shape), CAMERA, pose, grid, 0.0)


def inside(points, corners):
    """True where all edges of a convex polygon have the point on their same side."""
    edges = np.roll(corners, -1, axis=0) - corners
    to_point = points[:, None, :] - corners[None]
    cross = edges[:, 0] * to_point[..., 1] - edges[:, 1] * to_point[..., 0]
    return (cross >= -1e-6).all(axis=1) | (cross <= 1e-6).all(axis=1)


def square(middle, half):
    return np.asarray(middle) + half * np.array([[-1, -1], [-1, 1], [1, 1], [1, -1]])


@pytest.mark.parametrize("yaw", range(0, 360, 20))
@pytest.mark.parametrize("tilt", [(0, 0), (12, -8)])
def test_the_bounding_grid_holds_the_footprint_and_hardly_more(yaw, tilt):
    corners = CAMERA.footprint(Pose.from_yaw_pitch_roll((300, 400, 900), yaw, *tilt), 0.0)
    grid = bounding_grid(corners, 2.0, CRS)
    rows, cols = grid.row_col(corners[:, 0], corners[:, 1])
    assert rows.min() >= -0.5 and cols.min() >= -0.5
    assert rows.max() <= grid.shape[0] - 0.5 and cols.max() <= grid.shape[1] - 0.5
    assert np.ptp(rows) > grid.shape[0] - 2.01 and np.ptp(cols) > grid.shape[1] - 2.01


@pytest.mark.parametrize("yaw", [0, 25, 45, 200])
def test_the_central_square_is_as_wide_as_the_footprint_is_narrow(yaw):
    corners = CAMERA.footprint(Pose.from_yaw_pitch_roll((300, 400, 900), yaw), 0.0)
    grid = central_grid(corners, 2.0, CRS)
    side = grid.shape[0]
    assert grid.shape == (side, side) and side % 2 == 0
    assert side * 2.0 == pytest.approx(900 * 90 / 130, abs=4)
    middle = grid.transform @ (side / 2, side / 2)
    np.testing.assert_allclose(middle, corners.mean(axis=0), atol=1e-6)


def test_a_wall_hides_the_ground_behind_it_and_nothing_else():
    grid = Grid.centred(0.0, 0.0, (10.0, 10.0), (21, 101), CRS)
    ground = np.zeros(grid.shape)
    ground[:, 70] = 100.0  # 200 m east of the middle
    pose = Pose.from_yaw_pitch_roll((0, 0, 500), 0)
    hidden = np.flatnonzero(occluded(ground, grid, pose)[10])
    # From 500 m the crest of 100 m at 200 m throws a blind strip to 250 m, less interpolation.
    assert set(range(72, 74)) <= set(hidden) <= set(range(71, 76))
    assert not occluded(np.zeros(grid.shape), grid, pose).any()
