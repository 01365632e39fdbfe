"""What a flight folder must hold, and which map is taken."""

import os

import numpy as np
import pytest
import rasterio
from affine import Affine

from pcnav_study.errors import InputError
from pcnav_study.frames import FlightFolder


def raster(path, pixel, crs="EPSG:32616", at=(500000, 4000000)):
    with rasterio.open(
        path,
        "w",
        driver="GTiff",
        count=1,
        height=5,
        width=5,
        dtype="uint8",
        crs=crs,
        transform=Affine(pixel, 0, at[0], 0, -pixel, at[1]),
    ) as out:
        out.write(np.ones((1, 5, 5), np.uint8))


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "frames").mkdir()
    for name in ("b.JPG", "a.png", "c.tiff", "notes.txt", "d.jpeg"):
        (tmp_path / "frames" / name).touch()
    return tmp_path


@pytest.mark.parametrize("given", [None, ""])
def test_a_folder_that_is_not_set_is_asked_for(given):
    with pytest.raises(InputError, match=r"flight\.folder is not set.*--params"):
        FlightFolder.open(given)


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(InputError, match=r"nowhere does not exist; it should hold frames/"):
        FlightFolder.open(tmp_path / "nowhere")


def test_a_file_is_no_folder(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="file does not exist"):
        FlightFolder.open(tmp_path / "file")


def test_a_folder_without_frames_is_told_so(tmp_path):
    raster(tmp_path / "reference.tif", 10)
    with pytest.raises(InputError, match="has no frames/"):
        FlightFolder.open(tmp_path)


def test_a_folder_without_images_is_told_so(tmp_path):
    (tmp_path / "frames").mkdir()
    (tmp_path / "frames" / "readme.txt").touch()
    raster(tmp_path / "reference.tif", 10)
    with pytest.raises(InputError, match=r"holds no image; put JPEG, PNG or TIFF"):
        FlightFolder.open(tmp_path)


@pytest.mark.parametrize("others", [(), ("dem.tif", "dem_24m.tif")])
def test_a_folder_without_a_map_is_told_so(folder, others):
    for name in others:
        raster(folder / name, 10)
    with pytest.raises(InputError, match=r"has no map; add reference\.tif.*flight\.reference"):
        FlightFolder.open(folder)


def test_frames_are_the_images_in_the_order_of_their_names(folder):
    raster(folder / "reference.tif", 10)
    found = FlightFolder.open(str(folder))
    assert [p.name for p in found.frames] == ["a.png", "b.JPG", "c.tiff", "d.jpeg"]
    assert (found.dem, found.camera, found.flight_log, found.camera_pose) == (None,) * 4


def test_a_map_called_reference_goes_before_a_sharper_one(folder):
    raster(folder / "reference_map.tif", 10)
    raster(folder / "satellite.tif", 1)
    assert os.path.basename(FlightFolder.open(folder).reference) == "reference_map.tif"


def test_otherwise_the_sharpest_map_that_is_no_elevation_model_is_taken(folder):
    raster(folder / "a_coarse.tif", 30)
    raster(folder / "b_sharp.tif", 10)
    raster(folder / "dem_sharper.tif", 1)
    raster(folder / "z_bare.tif", 0.1, crs=None)
    found = FlightFolder.open(folder)
    assert os.path.basename(found.reference) == "b_sharp.tif"
    assert os.path.basename(found.dem) == "dem_sharper.tif"


def test_sharpness_is_compared_on_the_ground_not_in_degrees(folder):
    raster(folder / "degrees_28m.tif", 0.00025, "EPSG:4326", (-84, 36))
    raster(folder / "metres_10m.tif", 10)
    assert os.path.basename(FlightFolder.open(folder).reference) == "metres_10m.tif"
    raster(folder / "feet_3m.tif", 10, "EPSG:2225", (6_200_000, 2_100_000))
    assert os.path.basename(FlightFolder.open(folder).reference) == "feet_3m.tif"


def test_files_beside_the_frames_are_found_and_given_ones_override(folder):
    raster(folder / "reference.tif", 10)
    raster(folder / "dem.tif", 30)
    for name in ("camera.json", "flight_log.csv", "camera_pose.csv"):
        (folder / name).touch()
    found = FlightFolder.open(folder)
    assert found.dem == str(folder / "dem.tif")
    assert [p.name for p in (found.camera, found.flight_log, found.camera_pose)] == [
        "camera.json",
        "flight_log.csv",
        "camera_pose.csv",
    ]
    given = FlightFolder.open(folder, "https://maps.example/map.tif", "other_dem.tif")
    assert (given.reference, given.dem) == ("https://maps.example/map.tif", "other_dem.tif")


def test_capital_suffixes_are_found_and_the_dem_is_no_map(tmp_path):
    (tmp_path / "frames").mkdir()
    (tmp_path / "frames" / "A.JPG").write_bytes(b"x")
    for name in ("Reference.TIF", "DEM_10m.TIFF"):
        (tmp_path / name).write_bytes(b"x")
    folder = FlightFolder.open(tmp_path)
    assert folder.reference.endswith("Reference.TIF")
    assert folder.dem is not None
    assert folder.dem.endswith("DEM_10m.TIFF")
    assert len(folder.frames) == 1
