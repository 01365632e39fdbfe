"""Suns of maps and frames, from tags and times, checked against the tags of satellites."""

import numpy as np
import pytest
import rasterio
from PIL import Image
from rasterio.transform import from_origin

from pcnav_study.frames import frame_sun, map_sun, read_metadata, read_window
from pcnav_study.frames.suns import frame_time
from pcnav_study.scene import Grid

CRS = "EPSG:32735"


def write(path, bands=1, tags=None, band_tags=()):
    values = np.stack([np.full((40, 40), 10.0 * (k + 1), np.float32) for k in range(bands)])
    with rasterio.open(
        path, "w", driver="GTiff", count=bands, height=40, width=40, dtype="float32", crs=CRS,
        transform=from_origin(258000, 6269000, 10, 10),
    ) as raster:  # fmt: skip
        raster.write(values)
        raster.update_tags(**(tags or {}))
        for k, wavelength in enumerate(band_tags, 1):
            raster.update_tags(k, center_wavelength=wavelength)
    return str(path)


@pytest.mark.parametrize(
    ("tags", "azimuth", "zenith"),
    [
        ({"MEAN_SOLAR_AZIMUTH_ANGLE": 43.9, "MEAN_SOLAR_ZENITH_ANGLE": 38.3}, 43.9, 38.3),
        ({"SUN_AZIMUTH": 47.0, "SUN_ELEVATION": 46.2}, 47.0, 43.8),
        # Landsat's own sun of this scene is 47.02, 43.81: its time gives the same within a degree.
        ({"DATE_ACQUIRED": "2015-09-23", "SCENE_CENTER_TIME": "08:10:29.3656940Z"}, 47.0, 43.8),
        ({"system-time_start": "1442995829365"}, 47.0, 43.8),
        ({"ACQUISITIONDATETIME": "2015-09-23T08:10:29Z"}, 47.0, 43.8),
    ],
)
def test_a_map_tells_its_sun_or_its_time(tmp_path, tags, azimuth, zenith):
    sun, note = map_sun(write(tmp_path / "map.tif", tags=tags))
    assert note == f"tag {next(iter(tags))}"
    assert sun.azimuth == pytest.approx(azimuth, abs=2.0)
    assert sun.zenith == pytest.approx(zenith, abs=2.0)


@pytest.mark.parametrize(
    "tags",
    [
        {},
        {"TIFFTAG_DATETIME": "2015:09:23 08:10:29"},
        {"SUN_AZIMUTH": "high", "SUN_ELEVATION": "1"},
    ],
)
def test_a_map_without_sun_or_zone_has_no_sun_and_says_so(tmp_path, tags):
    sun, note = map_sun(write(tmp_path / "map.tif", tags=tags))
    assert sun is None
    assert "neither sun nor time" in note


def test_a_frame_has_the_sun_of_its_own_time_and_place():
    zoned = {"time": "2015:09:23 10:10:29", "utc_offset": "+02:00"}
    sun, note = frame_sun(zoned, -33.7, 24.4)
    assert note == "recorded"
    assert (sun.azimuth, sun.zenith) == pytest.approx((47.0, 43.8), abs=1.0)


@pytest.mark.parametrize(
    ("metadata", "says"),
    [
        ({}, "no time"),
        ({"time": "2024:10:30 10:05:15"}, "time zone missing"),
        ({"time": "soon", "utc_offset": "+02:00"}, "cannot be read"),
        ({"time": "0000:00:00 00:00:00", "utc_offset": "Z"}, "cannot be read"),
    ],
)
def test_without_a_zoned_time_the_sun_is_unknown_and_no_error(metadata, says):
    assert says in frame_time(metadata)[1]
    assert frame_sun(metadata, 0.0, 0.0)[0] is None


def test_the_gps_clock_is_utc(tmp_path):
    exif = Image.Exif()
    exif.get_ifd(0x8825).update({7: (8.0, 10.0, 29.5), 29: "2015:09:23"})
    Image.new("RGB", (20, 20)).save(tmp_path / "a.jpg", exif=exif)
    assert read_metadata(tmp_path / "a.jpg")["gps_time"] == "2015-09-23T08:10:29.500+00:00"


def test_the_bands_in_the_visible_are_read_where_a_map_tells(tmp_path):
    grid = Grid.centred(258200.0, 6268800.0, (10.0, 10.0), (20, 20), CRS)
    landsat = write(tmp_path / "l8.tif", 5, band_tags=("0.443", "0.482", "0.562", "0.655", "0.865"))
    np.testing.assert_allclose(read_window(landsat, grid), 30.0)
    plain = write(tmp_path / "plain.tif", 5)
    np.testing.assert_allclose(read_window(plain, grid), 20.0)


def test_a_reprojected_map_is_averaged_when_it_shrinks(tmp_path):
    chequers = (np.indices((600, 600)).sum(axis=0) % 2 * 100.0).astype(np.float32)
    with rasterio.open(
        tmp_path / "fine.tif", "w", driver="GTiff", count=1, height=600, width=600,
        dtype="float32", crs="EPSG:4326", transform=from_origin(24.39, -33.69, 1e-5, 1e-5),
    ) as raster:  # fmt: skip
        raster.write(chequers[None])
    utm = "EPSG:32735"
    middle = rasterio.warp.transform("EPSG:4326", utm, [24.393], [-33.693])
    grid = Grid.centred(middle[0][0], middle[1][0], (10.0, 10.0), (30, 30), utm)
    small = read_window(str(tmp_path / "fine.tif"), grid)
    assert np.isfinite(small).all()
    np.testing.assert_allclose(small, 50.0, atol=6.0)
