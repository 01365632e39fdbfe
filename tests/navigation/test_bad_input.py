"""What a user may bring by mistake: each frame says what is wrong, and the others go on."""

import json
import struct
import zlib

import numpy as np
import pandas as pd
import pytest
import rasterio
from PIL import Image
from rasterio.transform import from_origin

from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, flight_table, localise_flight
from pcnav_study.scene import Camera, Grid, Pose, SunPosition, fractal_relief, render, shade

UTM = "EPSG:32616"
GRID = Grid.centred(500000.0, 4000000.0, (2.0, 2.0), (320, 320), UTM)
CAMERA = Camera((160, 180), 160.0)
SETTINGS = FlightSettings(prior_error_m=10.0, prior_offset_m=6.0, seed=2)
COLUMNS = ["frame", "latitude_deg", "longitude_deg"]
COLUMNS += ["height_above_ground_m", "flight_yaw_deg", "time"]


def entry(name, height=400.0, yaw=30.0, time=""):
    latitude, longitude = GRID.to_wgs84(500000.0, 4000000.0)
    return [name, latitude, longitude, height, yaw, time]


def write_map(path, image, crs=UTM, transform=GRID.transform):
    with rasterio.open(
        path, "w", driver="GTiff", count=1, height=image.shape[0], width=image.shape[1],
        dtype="float32", crs=crs, transform=transform,
    ) as raster:  # fmt: skip
        raster.write(np.asarray(image, np.float32)[None])


@pytest.fixture(scope="module")
def scene():
    relief = fractal_relief(GRID.shape, (2.0, 2.0), np.random.default_rng(3), median_slope=15)
    light = shade(GRID.image(relief), sun=SunPosition(135, 45))
    pose = Pose.from_yaw_pitch_roll((500000, 4000000, 400), 30.0)
    image = render(light, GRID.image(np.zeros(GRID.shape)), CAMERA, pose)
    low, high = np.nanmin(image), np.nanmax(image)
    return light, np.rint((np.nan_to_num(image, nan=low) - low) / (high - low) * 255)


@pytest.fixture
def folder(tmp_path, scene):
    light, image = scene
    (tmp_path / "frames").mkdir()
    write_map(tmp_path / "reference.tif", light)
    Image.fromarray(image.astype(np.uint8)).save(tmp_path / "frames" / "good.png")
    spec = {"image_size_px": [180, 160], "focal_length_mm": 1.6, "sensor_size_mm": [1.8, 1.6]}
    (tmp_path / "camera.json").write_text(json.dumps(spec))
    return tmp_path


def run(folder, *bad):
    log = [entry("good.png", time="2016-06-21T15:00:00+00:00"), *bad]
    pd.DataFrame(log, columns=COLUMNS).to_csv(folder / "flight_log.csv", index=False)
    rows = [row for row, _ in localise_flight(FlightFolder.open(folder), SETTINGS)]
    table = flight_table(rows).set_index("frame")
    assert table.loc["good.png", "status"] == "placed"
    assert table.loc["good.png", "error_m"] < 4.0
    return table


def copy_of_good(folder, name):
    (folder / "frames" / name).write_bytes((folder / "frames" / "good.png").read_bytes())


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"height": 0.0}, "not above the ground"),
        ({"height": -50.0}, "not above the ground"),
        ({"height": np.nan}, "no height above ground"),
        ({"yaw": np.nan}, "no yaw for bad.png"),
    ],
)
def test_a_pose_that_cannot_be_is_named(folder, values, says):
    copy_of_good(folder, "bad.png")
    row = run(folder, entry("bad.png", **values)).loc["bad.png"]
    assert says in row["status"]
    assert row["alarm"]
    assert np.isnan(float(row["easting"] or np.nan))


@pytest.mark.parametrize("size", [(2, 2), (90, 80), (160, 180)])
def test_a_frame_of_another_camera_is_refused(folder, size):
    Image.new("RGB", size, "grey").save(folder / "frames" / "bad.jpg")
    status = run(folder, entry("bad.jpg")).loc["bad.jpg", "status"]
    assert "does not fit the camera" in status


def test_a_decompression_bomb_is_refused_unopened(folder):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", 25_000, 20_000, 8, 0, 0, 0, 0))
    data = chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b"")
    (folder / "frames" / "bomb.png").write_bytes(b"\x89PNG\r\n\x1a\n" + header + data)
    status = run(folder, entry("bomb.png")).loc["bomb.png", "status"]
    assert "too large to open safely" in status


def test_a_time_without_zone_leaves_the_sun_unknown_and_the_frame_placed(folder):
    copy_of_good(folder, "local.png")
    with rasterio.open(folder / "reference.tif", "r+") as raster:
        raster.update_tags(SUN_AZIMUTH="135", SUN_ELEVATION="45")
    table = run(folder, entry("local.png", time="2016-06-21T15:00:00"))
    assert table.loc["local.png", "status"] == "placed"
    assert table.loc["local.png", "sun"] == "unknown: time zone missing"
    assert table.loc["good.png", "sun"].startswith("known")
    assert "time: flight_log.csv" in table.loc["good.png", "pose_origins"]


def test_a_dem_that_does_not_cover_is_named(folder):
    far = from_origin(700000, 4100000, 10, 10)
    write_map(folder / "dem.tif", np.zeros((50, 50)), transform=far)
    log = [entry("good.png")]
    pd.DataFrame(log, columns=COLUMNS).to_csv(folder / "flight_log.csv", index=False)
    ((row, fix),) = localise_flight(FlightFolder.open(folder), SETTINGS)
    assert fix is None
    assert "dem.tif does not cover the frame" in row["status"]


@pytest.mark.parametrize("crs", ["EPSG:4326", "EPSG:2274", "turned"])
def test_a_map_in_degrees_in_feet_or_turned_places_the_frame_all_the_same(folder, scene, crs):
    light, _ = scene
    if crs == "turned":
        turn = GRID.transform @ rasterio.Affine.translation(160, -70) @ rasterio.Affine.rotation(40)
        shape, target = (450, 450), UTM
    else:
        turn, cols, rows = rasterio.warp.calculate_default_transform(
            UTM, crs, 320, 320, *rasterio.transform.array_bounds(320, 320, GRID.transform)
        )
        shape, target = (rows, cols), crs
    out = np.full(shape, np.nan, np.float32)
    rasterio.warp.reproject(
        np.asarray(light, np.float32), out, src_transform=GRID.transform, src_crs=UTM,
        dst_transform=turn, dst_crs=target, resampling=rasterio.enums.Resampling.cubic,
        src_nodata=np.nan, dst_nodata=np.nan,
    )  # fmt: skip
    write_map(folder / "reference.tif", out, crs=target, transform=turn)
    table = run(folder)
    assert table.loc["good.png", "error_m"] < 4.0


def test_a_search_area_beyond_all_bounds_is_refused(folder):
    pd.DataFrame([entry("good.png")], columns=COLUMNS).to_csv(
        folder / "flight_log.csv", index=False
    )
    settings = FlightSettings(prior_error_m=1e6)
    ((row, fix),) = localise_flight(FlightFolder.open(folder), settings)
    assert fix is None
    assert "lower prior_error_m" in row["status"]
