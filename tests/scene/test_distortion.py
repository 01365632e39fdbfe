"""Brown's distortion: OpenCV's formula, and the way back."""

import numpy as np
import pytest

from pcnav_study.scene import Camera, Distortion, Pose

LENSES = [
    Distortion(-0.28, 0.09, -0.01, 0.0008, -0.0006),
    Distortion(0.12, -0.05, 0.0, 0.0, 0.0),
    Distortion(0.0, 0.0, 0.0, 0.002, -0.003),
]
POSE = Pose.from_yaw_pitch_roll((1000, 2000, 700), 33, 4, -6)


def by_the_book(lens, x, y):
    """docs.opencv.org, calib3d: x'' = x'(1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x'y' + p2(r2 + 2x'2)."""
    r2 = x**2 + y**2
    radial = 1 + lens.k1 * r2 + lens.k2 * r2**2 + lens.k3 * r2**3
    return (
        x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x**2),
        y * radial + lens.p1 * (r2 + 2 * y**2) + 2 * lens.p2 * x * y,
    )


@pytest.mark.parametrize("lens", LENSES)
def test_pixels_are_where_opencv_puts_them(lens):
    camera = Camera((600, 800), 700.0, (5.0, -8.0), lens)
    rows, cols = np.meshgrid(np.linspace(0, 599, 13), np.linspace(0, 799, 17), indexing="ij")
    plain = Camera((600, 800), 700.0, (5.0, -8.0))
    points = POSE.position + plain.rays(rows, cols, POSE) * 500
    got_rows, got_cols = camera.project(points, POSE)
    # OpenCV's principal point counts right and down; ours is the middle plus the offset.
    cx, cy = 399.5 - 8.0, 299.5 + 5.0
    u, v = by_the_book(lens, (cols - cx) / 700, (rows - cy) / 700)
    np.testing.assert_allclose(got_cols, cx + 700 * u, atol=1e-6)
    np.testing.assert_allclose(got_rows, cy + 700 * v, atol=1e-6)


@pytest.mark.parametrize("lens", LENSES)
def test_project_and_rays_are_inverse(lens):
    camera = Camera((600, 800), 700.0, (5.0, -8.0), lens)
    rows, cols = np.meshgrid(np.linspace(0, 599, 13), np.linspace(0, 799, 17), indexing="ij")
    points = POSE.position + camera.rays(rows, cols, POSE) * 321.0
    back_rows, back_cols = camera.project(points, POSE)
    assert np.abs(back_rows - rows).max() < 1e-3
    assert np.abs(back_cols - cols).max() < 1e-3


def test_points_beyond_the_fold_are_not_seen_twice():
    lens = Distortion(k1=-0.3)
    camera = Camera((600, 800), 700.0, distortion=lens)
    assert lens.largest_radius == pytest.approx((1 / 0.9) ** 0.5)
    down = Pose.from_yaw_pitch_roll((0, 0, 100), 0)
    inside, outside = camera.project(np.array([[30.0, 0, 0], [300.0, 0, 0]]), down)[1]
    assert np.isfinite(inside)
    assert np.isnan(outside)
    assert Distortion().largest_radius == np.inf
