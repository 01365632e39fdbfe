"""Grids, the built-in tile, and synthetic relief and albedo."""

import matplotlib.cbook
import numpy as np
import pytest
import xarray as xr
from affine import Affine
from pyproj import Geod

from pcnav_study.errors import InputError
from pcnav_study.scene import Grid, fractal_albedo, fractal_relief, jacksboro, slope_aspect

GRID = Grid(Affine(20.0, 0, 400000.0, 0, -30.0, 4000000.0), (50, 40), "EPSG:32616")


def test_the_built_in_tile_lies_where_it_should():
    ground = jacksboro()
    grid = Grid.of(ground)
    assert ground.shape == grid.shape == (344, 403)
    assert grid.pixel_size == pytest.approx((92.8, 74.5), abs=0.15)
    t = grid.transform
    middle = t @ (403 / 2, 344 / 2)
    assert grid.to_wgs84(*middle) == pytest.approx((36.59, -84.25), abs=0.01)
    assert grid.to_wgs84(*(t @ (0, 0)))[0] > grid.to_wgs84(*(t @ (0, 344)))[0]


def test_pixels_of_the_built_in_tile_are_as_long_on_the_ellipsoid():
    grid = Grid.of(jacksboro())
    y, x = grid.coordinates()
    here, south, east = (
        grid.to_wgs84(*at) for at in ((x[200], y[170]), (x[200], y[171]), (x[201], y[170]))
    )
    geod = Geod(ellps="WGS84")
    metres = [geod.inv(here[1], here[0], there[1], there[0])[2] for there in (south, east)]
    assert grid.pixel_size == pytest.approx(metres, rel=0.005)


def test_heights_of_the_built_in_tile_are_the_measured_ones():
    path = matplotlib.cbook.get_sample_data("jacksboro_fault_dem.npz", asfileobj=False)
    with np.load(path) as tile:
        np.testing.assert_array_equal(jacksboro().values, tile["elevation"])


def test_the_first_pixel_centre_is_row_0_column_0():
    row, col = GRID.row_col(400010.0, 3999985.0)
    assert (float(row), float(col)) == pytest.approx((0, 0))
    row, col = GRID.row_col(400010.0 + 20 * 7, 3999985.0 - 30 * 3)
    assert (float(row), float(col)) == pytest.approx((3, 7))


@pytest.mark.parametrize("grid", [GRID, Grid.of(jacksboro())], ids=["utm", "tile"])
def test_mesh_and_row_col_undo_each_other(grid):
    row, col = grid.row_col(*grid.mesh())
    rows, cols = np.indices(grid.shape)
    np.testing.assert_allclose(row, rows, atol=1e-6)
    np.testing.assert_allclose(col, cols, atol=1e-6)


def test_north_is_up_and_west_is_left_in_the_mesh():
    x, y = GRID.mesh()
    assert (np.diff(y, axis=0) == -30).all()
    assert (np.diff(x, axis=1) == 20).all()


@pytest.mark.parametrize(("row", "col"), [(5, 3), (0, 0), (-4, -7), (48, 39)])
def test_a_window_keeps_every_pixel_in_its_place(row, col):
    part = GRID.window(row, col, (6, 8))
    assert part.shape == (6, 8)
    rows, cols = GRID.row_col(*part.mesh())
    np.testing.assert_allclose(rows[:, 0], row + np.arange(6), atol=1e-9)
    np.testing.assert_allclose(cols[0], col + np.arange(8), atol=1e-9)


def test_a_centred_grid_has_its_middle_there():
    grid = Grid.centred(1000.0, 2000.0, (30.0, 20.0), (10, 12), "EPSG:32616")
    x, y = grid.mesh()
    assert (x.mean(), y.mean()) == pytest.approx((1000, 2000))
    assert grid.pixel_size == (30, 20)
    assert y[0, 0] > y[-1, 0]


@pytest.mark.parametrize(
    ("rows", "cols"),
    [
        (slice(None), slice(None)),
        (slice(10, 30), slice(5, 25)),
        (slice(0, 20), slice(None)),
        (slice(3, 43, 4), slice(1, 31, 3)),
    ],
)
def test_a_sliced_image_knows_its_new_place(rows, cols):
    x, y = GRID.mesh()
    eastings = GRID.image(x)[rows, cols]
    northings = GRID.image(y)[rows, cols]
    found_x, found_y = Grid.of(eastings).mesh()
    np.testing.assert_allclose(found_x, eastings.values, atol=1e-6)
    np.testing.assert_allclose(found_y, northings.values, atol=1e-6)


def test_an_image_without_crs_is_refused_with_the_remedy():
    bare = xr.DataArray(np.zeros((3, 3)), dims=("y", "x"), coords={"y": [2, 1, 0], "x": [0, 1, 2]})
    with pytest.raises(InputError, match=r"no CRS.*write_crs"):
        Grid.of(bare.rename("bare"))


def test_values_of_another_shape_are_refused():
    with pytest.raises(InputError, match="do not fit"):
        GRID.image(np.zeros((50, 41)))


@pytest.mark.parametrize("median", [5.0, 15.0, 35.0])
@pytest.mark.parametrize("pixel_size", [(30.0, 30.0), (90.0, 70.0)])
def test_fractal_relief_has_the_median_slope_asked_for(rng, median, pixel_size):
    ground = fractal_relief((128, 96), pixel_size, rng, median_slope=median)
    dy, dx = pixel_size
    by_hand = np.hypot(
        (ground[2:, 1:-1] - ground[:-2, 1:-1]) / (2 * dy),
        (ground[1:-1, 2:] - ground[1:-1, :-2]) / (2 * dx),
    )
    assert np.degrees(np.arctan(np.median(by_hand))) == pytest.approx(median, rel=0.02)
    assert np.median(slope_aspect(ground, pixel_size)[0]) == pytest.approx(median, rel=1e-6)


@pytest.mark.parametrize("make", ["relief", "albedo"])
@pytest.mark.parametrize("shape", [(64, 64), (33, 47)])
def test_equal_seeds_give_equal_ground_and_others_do_not(make, shape):
    def ground(seed):
        rng = np.random.default_rng(seed)
        if make == "relief":
            return fractal_relief(shape, (30, 30), rng)
        return fractal_albedo(shape, 0.1, rng)

    assert ground(1).shape == shape
    np.testing.assert_array_equal(ground(1), ground(1))
    assert np.abs(ground(1) - ground(2)).max() > 1e-3


def test_fractal_relief_is_smoother_for_a_higher_hurst_exponent():
    def roughness(hurst):
        ground = fractal_relief((128, 128), (30, 30), np.random.default_rng(3), hurst=hurst)
        return np.abs(np.diff(ground, 2, axis=0)).mean() / ground.std()

    assert roughness(0.9) < 0.8 * roughness(0.5)


@pytest.mark.parametrize("hurst", [0.5, 0.8])
def test_the_amplitude_spectrum_of_relief_falls_as_the_hurst_exponent_says(rng, hurst):
    ground = fractal_relief((256, 256), (30, 30), rng, hurst=hurst)
    amplitude = np.abs(np.fft.fft2(ground)).ravel()
    f = np.hypot(*np.meshgrid(np.fft.fftfreq(256), np.fft.fftfreq(256))).ravel()
    band = (f > 0.02) & (f < 0.4)
    falls = np.polyfit(np.log(f[band]), np.log(amplitude[band]), 1)[0]
    assert falls == pytest.approx(-(hurst + 1), abs=0.05)


@pytest.mark.parametrize("contrast", [0.05, 0.1, 0.2])
def test_albedo_has_mean_one_and_the_contrast_asked_for(rng, contrast):
    albedo = fractal_albedo((200, 150), contrast, rng)
    assert albedo.mean() == pytest.approx(1, abs=1e-3)
    assert albedo.std() == pytest.approx(contrast, rel=0.01)
    assert albedo.min() >= 0


def test_albedo_without_contrast_is_one_and_with_much_of_it_never_negative(rng):
    np.testing.assert_array_equal(fractal_albedo((4, 5), 0, rng), np.ones((4, 5)))
    assert fractal_albedo((200, 200), 0.9, rng).min() == 0


@pytest.mark.parametrize("contrast", [-0.1, 1.0, 10, float("nan")])
def test_an_albedo_contrast_out_of_range_is_refused(rng, contrast):
    with pytest.raises(InputError, match="contrast"):
        fractal_albedo((8, 8), contrast, rng)
