"""Map windows in many reference systems against linear ramps whose values are known."""

import numpy as np
import pytest
import rasterio
from affine import Affine
from pyproj import CRS, Transformer
from rasterio.enums import ColorInterp

from pcnav_study.errors import InputError
from pcnav_study.frames import metric_crs, read_elevation, read_window
from pcnav_study.scene import Grid

UTM = "EPSG:32610"
EAST, NORTH = 650000.0, 4200000.0
WANTED = Grid.centred(EAST, NORTH, (10.0, 10.0), (20, 24), UTM)

# Each map covers WANTED with some 10 m a pixel.
MAPS = {
    "utm": (UTM, Affine(10, 0, EAST - 503, 0, -10, NORTH + 507)),
    "utm, long pixels": (UTM, Affine(12, 0, EAST - 603, 0, -7, NORTH + 350)),
    "utm, rotated": (
        UTM,
        Affine.translation(EAST, NORTH)
        @ Affine.rotation(30)
        @ Affine.scale(10, -10)
        @ Affine.translation(-50, -50),
    ),
}


def at(crs, x, y):
    return Transformer.from_crs(UTM, crs, always_xy=True).transform(x, y)


MAPS["degrees"] = (
    "EPSG:4326",
    Affine(1e-4, 0, at("EPSG:4326", EAST, NORTH)[0] - 5e-3, 0, -1e-4, 0)
    @ Affine.translation(0, -(at("EPSG:4326", EAST, NORTH)[1] + 5e-3) / 1e-4),
)
FEET = at("EPSG:2226", EAST, NORTH)
MAPS["survey feet"] = (
    "EPSG:2226",
    Affine(33, 0, FEET[0] - 33 * 50, 0, -33, FEET[1] + 33 * 50),
)
MAPS["survey feet, rotated"] = (
    "EPSG:2226",
    Affine.translation(*FEET)
    @ Affine.rotation(45)
    @ Affine.scale(33, -33)
    @ Affine.translation(-50, -50),
)


def ramp(x, y):
    """Grows by 0.2 a metre to the east and falls by 0.1 a metre to the north."""
    return 500 + 0.2 * (np.asarray(x) - EAST) - 0.1 * (np.asarray(y) - NORTH)


def assert_on_ramp(values, grid, part=np.s_[:]):
    """No pixel is off by 1.5 m (half a map pixel is 5 m), and all together by 0.7 m.

    GDAL's kernels move a ramp by up to 0.06 of a pixel.
    """
    off = (values - ramp(*grid.mesh()))[part]
    assert np.abs(off).max() < 0.3
    assert abs(off.mean()) < 0.15


def write(path, values, crs, transform, colours=None, **profile):
    bands = np.asarray(values)
    bands = bands[None] if bands.ndim == 2 else bands
    settings = {
        "driver": "GTiff",
        "count": len(bands),
        "height": bands.shape[1],
        "width": bands.shape[2],
        "dtype": bands.dtype,
        "crs": crs,
        "transform": transform,
    }
    with rasterio.open(path, "w", **settings | profile) as raster:
        raster.write(bands)
        if colours:
            raster.colorinterp = colours
    return str(path)


def ramp_map(path, name, shape=(100, 100), **profile):
    """A map that holds ``ramp`` of each of its pixel centres."""
    crs, transform = MAPS[name]
    rows, cols = np.indices(shape)
    x, y = transform @ (cols + 0.5, rows + 0.5)
    x, y = Transformer.from_crs(crs, UTM, always_xy=True).transform(x, y)
    return write(path, ramp(x, y).astype(np.float32), crs, transform, **profile)


@pytest.mark.parametrize("name", MAPS)
def test_a_window_holds_the_maps_value_at_each_of_its_pixel_centres(tmp_path, name):
    window = read_window(ramp_map(tmp_path / "map.tif", name), WANTED)
    assert window.dtype == np.float32
    assert_on_ramp(window, WANTED)


@pytest.mark.parametrize("pixel", [4.0, 10.0, 25.0, 40.0])
@pytest.mark.parametrize("name", ["utm", "degrees", "survey feet"])
def test_windows_may_be_sharper_or_coarser_than_the_map(tmp_path, name, pixel):
    grid = Grid.centred(EAST + 3, NORTH - 5, (pixel, pixel), (12, 14), UTM)
    window = read_window(ramp_map(tmp_path / "map.tif", name), grid)
    assert_on_ramp(window, grid)


def test_a_window_on_the_maps_own_pixels_is_the_map_itself(tmp_path, rng):
    crs, transform = MAPS["utm"]
    values = rng.normal(size=(100, 100)).astype(np.float32)
    path = write(tmp_path / "map.tif", values, crs, transform)
    grid = Grid(transform, (100, 100), crs).window(7, 30, (20, 25))
    np.testing.assert_allclose(read_window(path, grid), values[7:27, 30:55], atol=1e-6)


@pytest.mark.parametrize("name", ["utm", "degrees", "survey feet"])
def test_shrinking_averages_instead_of_picking(tmp_path, name):
    crs, transform = MAPS[name]
    chequers = (np.indices((400, 400)).sum(axis=0) % 2 * 200).astype(np.uint8)
    path = write(tmp_path / "map.tif", chequers, crs, transform @ Affine.scale(0.25))
    grid = Grid.centred(EAST, NORTH, (20.0, 20.0), (10, 10), UTM)
    np.testing.assert_allclose(read_window(path, grid), 100, atol=15)


def test_a_coarser_window_on_the_maps_own_lines_holds_the_means_of_its_blocks(tmp_path, rng):
    crs, transform = MAPS["utm"]
    values = rng.normal(size=(100, 100)).astype(np.float32)
    path = write(tmp_path / "map.tif", values, crs, transform)
    grid = Grid(transform @ Affine.scale(4), (25, 25), crs)
    means = values.reshape(25, 4, 25, 4).mean(axis=(1, 3))
    np.testing.assert_allclose(read_window(path, grid), means, atol=1e-5)


def test_the_first_three_bands_are_averaged(tmp_path):
    crs, transform = MAPS["utm"]
    bands = np.stack([np.full((100, 100), v, np.uint8) for v in (10, 20, 60, 250)])
    path = write(tmp_path / "map.tif", bands, crs, transform, photometric="MINISBLACK")
    np.testing.assert_allclose(read_window(path, WANTED), 30, atol=1e-4)


@pytest.mark.parametrize("crs", [UTM, "EPSG:4326"])
def test_transparent_pixels_are_no_data_and_transparency_is_no_brightness(tmp_path, crs):
    transform = MAPS["utm" if crs == UTM else "degrees"][1]
    bands = np.full((4, 100, 100), 90, np.uint8)
    bands[3] = 255
    bands[3, :50] = 0
    C = ColorInterp
    path = write(tmp_path / "map.tif", bands, crs, transform, [C.red, C.green, C.blue, C.alpha])
    window = read_window(path, WANTED)
    assert np.isnan(window[:8]).all()
    np.testing.assert_allclose(window[12:], 90, atol=1)


@pytest.mark.parametrize("dtype", ["uint8", "int16", "float32"])
def test_no_data_is_nan_and_does_not_bleed_into_its_neighbours(tmp_path, dtype):
    crs, transform = MAPS["utm"]
    values = np.full((100, 100), 80, dtype)
    values[40:45, 40:60] = 0
    path = write(tmp_path / "map.tif", values, crs, transform, nodata=0)
    whole = read_window(path, Grid(transform, (100, 100), crs))
    np.testing.assert_array_equal(np.isnan(whole), values == 0)
    half = read_window(path, Grid(transform @ Affine.translation(0.5, 0.5), (99, 99), crs))
    assert np.nanmin(half) == pytest.approx(80)


@pytest.mark.parametrize("nodata", [None, 0, 255])
@pytest.mark.parametrize("dtype", ["uint8", "float32"])
@pytest.mark.parametrize("name", ["utm", "degrees"])
def test_outside_the_map_there_is_no_data(tmp_path, name, dtype, nodata):
    crs, transform = MAPS[name]
    path = write(tmp_path / "map.tif", np.full((100, 100), 7, dtype), crs, transform, nodata=nodata)
    beyond = Grid.centred(EAST + 5000, NORTH, (10.0, 10.0), (20, 24), UTM)
    assert np.isnan(read_window(path, beyond)).all()
    wide = read_window(path, Grid.centred(EAST, NORTH, (10.0, 10.0), (300, 300), UTM))
    assert np.isnan(wide[:50]).all() and np.isnan(wide[:, -50:]).all()
    np.testing.assert_allclose(wide[140:160, 140:160], 7)


@pytest.mark.parametrize(
    ("name", "pixel"),
    [
        ("utm", 10),
        ("utm, long pixels", np.sqrt(84)),
        ("utm, rotated", 10),
        ("degrees", np.sqrt(11.1 * 8.79)),
        ("survey feet", 33 * 1200 / 3937),
        ("survey feet, rotated", 33 * 1200 / 3937),
    ],
)
def test_the_working_crs_is_in_metres_and_so_is_the_pixel(tmp_path, name, pixel):
    crs, found = metric_crs(ramp_map(tmp_path / "map.tif", name))
    assert CRS(crs).axis_info[0].unit_name == "metre"
    assert CRS(crs).to_epsg() == 32610
    assert found == pytest.approx(pixel, rel=0.005)


def test_a_map_of_the_southern_hemisphere_works_in_its_own_zone(tmp_path):
    path = write(
        tmp_path / "map.tif",
        np.zeros((10, 10), np.uint8),
        "EPSG:4326",
        Affine(1e-4, 0, 24.3, 0, -1e-4, -33.6),
    )
    assert CRS(metric_crs(path)[0]).to_epsg() == 32735


@pytest.mark.parametrize("read", [metric_crs, read_elevation, lambda p: read_window(p, WANTED)])
@pytest.mark.parametrize("transform", [None, Affine(10, 0, EAST, 0, -10, NORTH)])
@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning:rasterio")
def test_a_map_without_crs_is_refused_with_the_remedy(tmp_path, read, transform):
    profile = {} if transform is None else {"transform": transform}
    with rasterio.open(
        tmp_path / "bare.tif",
        "w",
        driver="GTiff",
        count=1,
        height=9,
        width=9,
        dtype="uint8",
        **profile,
    ) as raster:
        raster.write(np.ones((1, 9, 9), np.uint8))
    with pytest.raises(InputError, match=r"bare\.tif has no CRS.*gdal_edit"):
        read(str(tmp_path / "bare.tif"))


@pytest.mark.parametrize("read", [metric_crs, read_elevation, lambda p: read_window(p, WANTED)])
@pytest.mark.parametrize("exists", [False, True])
def test_a_map_that_cannot_be_opened_is_refused_by_name(tmp_path, read, exists):
    path = tmp_path / "lost.tif"
    if exists:
        path.write_text("no raster")
    with pytest.raises(InputError, match=r"lost\.tif cannot be opened.*check the path"):
        read(str(path))


@pytest.mark.parametrize("name", ["utm", "degrees", "survey feet"])
def test_an_elevation_model_is_read_where_it_lies_in_metres(tmp_path, name):
    ground = read_elevation(ramp_map(tmp_path / "dem.tif", name))
    grid = Grid.of(ground)
    assert CRS(grid.crs).to_epsg() == 32610
    assert np.isfinite(ground).all()
    inner = np.s_[10:-10, 10:-10]
    assert_on_ramp(ground.values, grid, inner)


def test_gaps_of_an_elevation_model_take_the_nearest_height(tmp_path):
    crs, transform = MAPS["utm"]
    heights = np.full((100, 100), 300, np.int16)
    heights[:, 60:] = 700
    holed = heights.copy()
    holed[20:25, 10:20] = -999
    holed[50:53, 80:90] = -999
    ground = read_elevation(write(tmp_path / "dem.tif", holed, crs, transform, nodata=-999))
    np.testing.assert_array_equal(ground.values, heights)


def test_an_elevation_model_without_any_height_is_refused(tmp_path):
    crs, transform = MAPS["utm"]
    path = write(tmp_path / "dem.tif", np.zeros((9, 9), np.float32), crs, transform, nodata=0)
    with pytest.raises(InputError, match=r"dem\.tif holds no height"):
        read_elevation(path)


def test_map_beyond_every_utm_zone_is_refused(tmp_path):
    path = tmp_path / "pole.tif"
    transform = Affine(0.01, 0, 0, 0, -0.01, 89.9)
    with rasterio.open(
        path, "w", driver="GTiff", height=4, width=4, count=1, dtype="uint8",
        crs="EPSG:4326", transform=transform,
    ) as raster:  # fmt: skip
        raster.write(np.ones((1, 4, 4), "uint8"))
    with pytest.raises(InputError, match=r"pole\.tif lies in no UTM zone; reproject it"):
        metric_crs(str(path))
