"""Shading against vector algebra, and shadows against trigonometry."""

import numpy as np
import pytest
import xarray as xr

from pcnav_study.scene import Grid, SunPosition, cast_shadows, jacksboro, shade, slope_aspect

PIXELS = [(1.0, 1.0), (3.0, 1.0), (1.0, 2.5), (92.8, 74.5)]


def east_north(shape, pixel_size):
    """Metres to the east and to the north of the south-west pixel; row 0 is north."""
    rows, cols = np.indices(shape)
    return cols * pixel_size[1], (shape[0] - 1 - rows) * pixel_size[0]


def plane(facing: float, slope: float, pixel_size, shape=(9, 11)):
    """Ground that falls towards the azimuth ``facing``."""
    east, north = east_north(shape, pixel_size)
    a = np.radians(facing)
    return 100 - np.tan(np.radians(slope)) * (east * np.sin(a) + north * np.cos(a))


def sun_vector(sun: SunPosition):
    a, z = np.radians([sun.azimuth, sun.zenith])
    return np.array([np.sin(a) * np.sin(z), np.cos(a) * np.sin(z), np.cos(z)])


@pytest.mark.parametrize("zenith", [0, 17, 45, 60, 89])
@pytest.mark.parametrize("azimuth", [0, 135, 359])
def test_level_ground_is_as_bright_as_the_cosine_of_the_zenith(zenith, azimuth):
    image = shade(np.full((5, 7), 250.0), (30, 30), SunPosition(azimuth, zenith))
    np.testing.assert_allclose(image, np.cos(np.radians(zenith)), atol=1e-12)


@pytest.mark.parametrize("pixel_size", PIXELS)
@pytest.mark.parametrize("facing", [0, 90, 180, 270])
def test_a_slope_is_bright_under_the_sun_it_faces_and_dark_under_the_opposite_one(
    facing, pixel_size
):
    ground = plane(facing, 35, pixel_size)
    towards = shade(ground, pixel_size, SunPosition(facing, 60))
    away = shade(ground, pixel_size, SunPosition((facing + 180) % 360, 60))
    np.testing.assert_allclose(towards, np.cos(np.radians(60 - 35)), atol=1e-9)
    np.testing.assert_allclose(away, np.cos(np.radians(60 + 35)).clip(0), atol=1e-9)


@pytest.mark.parametrize("pixel_size", PIXELS)
@pytest.mark.parametrize("sun", [SunPosition(135, 45), SunPosition(280, 70), SunPosition(10, 20)])
def test_brightness_is_the_cosine_between_the_surface_normal_and_the_sun(pixel_size, sun):
    dy, dx = pixel_size
    east, north = east_north((12, 14), pixel_size)
    u, v = east / dx, north / dy
    ground = 0.02 * u**2 * dx - 0.03 * v**2 * dy + 0.01 * u * v * min(dx, dy)
    # A quadratic's central differences are its exact derivatives away from the rim.
    rise_east = (0.04 * u * dx + 0.01 * v * min(dx, dy)) / dx
    rise_north = (-0.06 * v * dy + 0.01 * u * min(dx, dy)) / dy
    normal = np.stack([-rise_east, -rise_north, np.ones_like(u)])
    normal /= np.linalg.norm(normal, axis=0)
    expected = np.tensordot(sun_vector(sun), normal, 1).clip(0)
    inner = np.s_[1:-1, 1:-1]
    image = shade(ground, pixel_size, sun)
    np.testing.assert_allclose(image[inner], expected[inner], atol=1e-12)


@pytest.mark.parametrize("sun", [SunPosition(135, 45), SunPosition(300, 75)])
def test_brightness_agrees_with_the_slope_and_aspect_formula(rng, sun):
    ground = rng.normal(0, 20, (40, 50))
    slope, aspect = np.radians(slope_aspect(ground, (30, 20)))
    zenith, azimuth = np.radians([sun.zenith, sun.azimuth])
    expected = np.cos(zenith) * np.cos(slope)
    expected += np.sin(zenith) * np.sin(slope) * np.cos(azimuth - aspect)
    np.testing.assert_allclose(shade(ground, (30, 20), sun), expected.clip(0), atol=1e-12)


@pytest.mark.parametrize("pixel_size", PIXELS)
@pytest.mark.parametrize("facing", [0, 45, 90, 200, 315])
@pytest.mark.parametrize("steepness", [5, 30, 60])
def test_slope_and_aspect_of_a_plane_are_its_own(facing, steepness, pixel_size):
    slope, aspect = slope_aspect(plane(facing, steepness, pixel_size), pixel_size)
    np.testing.assert_allclose(slope, steepness, atol=1e-6)
    np.testing.assert_allclose((aspect - facing + 180) % 360 - 180, 0, atol=1e-6)


def test_no_pixel_is_darker_than_black_or_brighter_than_white(rng):
    image = shade(rng.normal(0, 100, (60, 60)), (10, 10), SunPosition(200, 70), shadows=True)
    assert image.min() == 0
    assert 0 < image.max() <= 1


@pytest.mark.parametrize("zenith", [90, 100, 180])
@pytest.mark.parametrize("shadows", [False, True])
def test_the_image_is_black_with_the_sun_below_the_horizon(rng, zenith, shadows):
    ground = rng.normal(0, 30, (20, 20))
    assert not shade(ground, (10, 10), SunPosition(90, zenith), shadows=shadows).any()


@pytest.mark.parametrize("pixel_size", [(1.0, 1.0), (2.0, 1.0), (1.0, 3.0), (10.0, 1.0)])
@pytest.mark.parametrize("elevation", [45, 25, 10])
@pytest.mark.parametrize("azimuth", [0, 90, 180, 270, 360])
def test_the_shadow_of_a_wall_is_as_long_as_trigonometry_says_and_points_from_the_sun(
    azimuth, elevation, pixel_size
):
    along_rows = azimuth % 180 == 0  # sun in the north or south: the shadow runs along a column
    side = pixel_size[0] if along_rows else pixel_size[1]
    height = 20 * side * np.tan(np.radians(elevation))  # a shadow of 20 px
    ground = np.zeros((61, 7) if along_rows else (7, 61))
    ground[np.s_[30, :] if along_rows else np.s_[:, 30]] = height
    hidden = cast_shadows(ground, pixel_size, SunPosition(azimuth, 90 - elevation))
    profiles = hidden.T if along_rows else hidden
    before, after = profiles[:, :30].sum(axis=1), profiles[:, 31:].sum(axis=1)
    if azimuth in (180, 90):  # sun at high indices: the shadow lies at low ones
        before, after = after, before
    np.testing.assert_array_equal(before, 0)
    np.testing.assert_allclose(after, 20, atol=1)
    assert not profiles[:, 30].any()


def test_a_shadow_runs_diagonally_under_a_diagonal_sun():
    ground = np.zeros((41, 41))
    ground[19:22, 19:22] = 10
    hidden = cast_shadows(ground, (1, 1), SunPosition(45, 60))  # sun in the north-east
    rows, cols = np.nonzero(hidden)
    assert len(rows) > 5
    assert rows.min() >= 19 and cols.max() <= 21  # so the shadow lies in the south-west
    np.testing.assert_allclose(rows - 20, 20 - cols, atol=3)
    assert np.hypot(rows - 20, cols - 20).max() == pytest.approx(10 * np.tan(np.radians(60)), abs=2)


def test_shadowed_ground_is_black_and_the_rest_unchanged():
    ground = np.zeros((9, 40))
    ground[:, 20] = 5
    sun = SunPosition(270, 60)
    plain, shaded = shade(ground, (1, 1), sun), shade(ground, (1, 1), sun, shadows=True)
    length = int(5 * np.tan(np.radians(60)))
    assert not shaded[:, 22 : 21 + length - 1].any()
    np.testing.assert_array_equal(shaded[:, :20], plain[:, :20])
    np.testing.assert_array_equal(shaded[:, 32:], plain[:, 32:])
    assert plain[:, 22:].min() > 0


def test_level_ground_has_no_shadow():
    assert not cast_shadows(np.full((10, 10), 7.0), (1, 1), SunPosition(90, 85)).any()


def test_a_map_comes_back_as_a_map_in_its_own_pixel_size():
    ground = jacksboro()
    image = shade(ground, sun=SunPosition(135, 45))
    assert isinstance(image, xr.DataArray)
    before, after = Grid.of(ground), Grid.of(image)
    assert (after.transform, after.shape, after.crs) == (before.transform, before.shape, before.crs)
    plain = shade(ground.values, before.pixel_size, SunPosition(135, 45))
    np.testing.assert_array_equal(image.values, plain)
    assert not np.allclose(image.values, shade(ground.values, (1, 1), SunPosition(135, 45)))


@pytest.mark.parametrize("shadows", [False, True])
def test_shading_leaves_its_input_as_it_was(shadows):
    ground = jacksboro()[100:140, 100:150]
    before = ground.copy(deep=True)
    shade(ground, sun=SunPosition(90, 70), shadows=shadows)
    xr.testing.assert_identical(ground, before)
    array = before.values.copy()
    array.setflags(write=False)
    shade(array, (90, 75), SunPosition(90, 70), shadows)
    np.testing.assert_array_equal(array, before.values)
