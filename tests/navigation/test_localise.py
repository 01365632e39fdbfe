"""A synthetic flight folder of known truth, whole and with bad frames in it."""

import json
import shutil

import numpy as np
import pandas as pd
import pytest
import rasterio
from PIL import Image
from pyproj import Transformer

from pcnav_study.errors import InputError
from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, flight_table, localise_flight, located
from pcnav_study.scene import (
    Camera,
    Grid,
    Pose,
    SunPosition,
    fractal_albedo,
    fractal_relief,
    render,
    shade,
)

UTM = "EPSG:32616"
PIXEL = 2.0
GRID = Grid.centred(500000.0, 4000000.0, (PIXEL, PIXEL), (420, 420), UTM)
CAMERA = Camera.from_field_of_view((200, 220), 60.0)
SETTINGS = FlightSettings("pc", prior_error_m=10.0, prior_offset_m=8.0, seed=3)
# East, north of the middle; height; omega, phi, kappa.
POSES = {
    "f1.png": (-90.0, 60.0, 420.0, 1.5, -2.0, -35.0),
    "f2.tif": (10.0, -40.0, 400.0, -3.0, 1.0, 100.0),
    "f3.png": (80.0, 70.0, 430.0, 0.0, 0.0, 0.0),
}


def write_map(path, image, crs=UTM):
    with rasterio.open(
        path,
        "w",
        driver="GTiff",
        count=1,
        height=GRID.shape[0],
        width=GRID.shape[1],
        dtype="float32",
        crs=crs,
        transform=GRID.transform,
    ) as raster:
        raster.write(np.asarray(image, np.float32)[None])


def write_frame(path, image):
    low, high = np.nanmin(image), np.nanmax(image)
    grey = np.rint((np.nan_to_num(image, nan=low) - low) / (high - low) * 255).astype(np.uint8)
    Image.fromarray(grey).convert("RGB").save(path)


def write_camera(folder):
    spec = {
        "type": "pinhole",
        "image_size_px": [220, 200],
        "focal_length_mm": CAMERA.focal_px * 0.01,
        "sensor_size_mm": [2.2, 2.0],
    }
    (folder / "camera.json").write_text(json.dumps(spec))


def world(slope, seed=8):
    rng = np.random.default_rng(seed)
    ground = GRID.image(50 + fractal_relief(GRID.shape, (PIXEL, PIXEL), rng, median_slope=slope))
    light = shade(ground, sun=SunPosition(135, 45))
    return ground, light * fractal_albedo(GRID.shape, 0.25, rng, exponent=1.6)


@pytest.fixture(scope="module")
def over_relief(tmp_path_factory):
    """Frames over relief, with a DEM and photogrammetric poses."""
    folder = tmp_path_factory.mktemp("relief")
    (folder / "frames").mkdir()
    ground, radiance = world(slope=12.0)
    write_map(folder / "reference.tif", radiance)
    write_map(folder / "dem.tif", ground)
    write_camera(folder)
    rows = []
    for name, (east, north, height, *angles) in POSES.items():
        position = (500000 + east, 4000000 + north, height)
        pose = Pose.from_omega_phi_kappa(position, *angles)
        write_frame(folder / "frames" / name, render(radiance, ground, CAMERA, pose))
        rows.append([name, *position, *angles])
    columns = ["frame", "easting_m", "northing_m", "altitude_m"]
    columns += ["omega_deg", "phi_deg", "kappa_deg"]
    pd.DataFrame(rows, columns=columns).to_csv(folder / "camera_pose.csv", index=False)
    return folder


@pytest.fixture(scope="module")
def over_level_ground(tmp_path_factory):
    """Frames over level ground, with a flight log and no DEM."""
    folder = tmp_path_factory.mktemp("level")
    (folder / "frames").mkdir()
    _, radiance = world(slope=5.0, seed=9)
    ground = GRID.image(np.full(GRID.shape, 50.0))
    write_map(folder / "reference.tif", radiance)
    write_camera(folder)
    to_degrees = Transformer.from_crs(UTM, 4326, always_xy=True)
    rows = []
    for name, (east, north, *_), yaw in zip(POSES, POSES.values(), (0, 75, 200), strict=True):
        pose = Pose.from_yaw_pitch_roll((500000 + east, 4000000 + north, 50 + 350), yaw)
        write_frame(folder / "frames" / name, render(radiance, ground, CAMERA, pose))
        longitude, latitude = to_degrees.transform(500000 + east, 4000000 + north)
        rows.append([name, latitude, longitude, 350, yaw])
    columns = ["frame", "latitude_deg", "longitude_deg", "height_above_ground_m", "flight_yaw_deg"]
    pd.DataFrame(rows, columns=columns).to_csv(folder / "flight_log.csv", index=False)
    return folder


@pytest.fixture
def folder(over_relief, tmp_path):
    """A copy to spoil."""
    return shutil.copytree(over_relief, tmp_path / "flight")


def run(folder, settings=SETTINGS, **given):
    rows = localise_flight(FlightFolder.open(folder, **given), settings)
    return flight_table([row for row, _ in rows]).set_index("frame")


def distance(row, name):
    east, north = POSES[name][:2]
    return np.hypot(row["easting"] - 500000 - east, row["northing"] - 4000000 - north)


@pytest.mark.parametrize("flight", ["over_relief", "over_level_ground"])
@pytest.mark.parametrize("method", ["pc", "ncc", "mi"])
def test_frames_are_placed_within_a_map_pixel_from_an_offset_prior(request, flight, method):
    settings = FlightSettings(method, prior_error_m=10.0, prior_offset_m=8.0, seed=3)
    table = run(request.getfixturevalue(flight), settings)
    assert table.index.tolist() == list(POSES)
    assert (table["status"] == "placed").all()
    assert not table["alarm"].any()
    assert table["prior_error_m"].min() > 2
    for name, row in table.iterrows():
        assert distance(row, name) < 1.2 * PIXEL
        assert row["error_m"] == pytest.approx(distance(row, name), abs=0.02)
        found_m = np.hypot(row["shift_row_px"], row["shift_col_px"]) * row["pixel_m"]
        assert found_m == pytest.approx(row["prior_error_m"], abs=1.2 * PIXEL)
    assert (table["method"] == method).all()
    assert (table["crs"] == UTM).all()


def test_positions_in_degrees_are_the_positions_in_metres(over_relief):
    table = run(over_relief)
    to_degrees = Transformer.from_crs(UTM, 4326, always_xy=True)
    for _, row in table.iterrows():
        longitude, latitude = to_degrees.transform(row["easting"], row["northing"])
        assert (row["latitude"], row["longitude"]) == pytest.approx((latitude, longitude), abs=2e-8)


def test_an_elevation_model_makes_frames_over_relief_fit_better(over_relief, tmp_path):
    with_relief = run(over_relief)
    with rasterio.open(over_relief / "dem.tif") as dem:
        level = float(dem.read(1).mean())
    write_map(tmp_path / "level.tif", np.full(GRID.shape, level))
    without = run(over_relief, dem=str(tmp_path / "level.tif"))
    assert (with_relief["quality"] > without["quality"] + 0.02).all()
    assert (with_relief["quality"] / without["quality"]).max() > 1.3


def test_the_sources_of_the_poses_are_told(over_relief, over_level_ground):
    assert (run(over_relief)["pose_source"] == "camera_pose.csv").all()
    assert (run(over_level_ground)["pose_source"] == "flight_log.csv").all()


def test_equal_seeds_give_equal_tables_and_others_do_not(over_relief):
    one = run(over_relief)
    pd.testing.assert_frame_equal(one, run(over_relief))
    other = run(over_relief, FlightSettings("pc", 10.0, 8.0, seed=4))
    assert (one["prior_error_m"] != other["prior_error_m"]).all()


def test_without_an_offset_the_recorded_position_is_believed(over_relief):
    table = run(over_relief, FlightSettings("pc"))
    assert (table["prior_error_m"] == 0).all()
    assert (np.abs(table[["shift_row_px", "shift_col_px"]].to_numpy(float)) < 1.2).all()


def unreadable(folder):
    image = folder / "frames" / "bad.png"
    image.write_bytes((folder / "frames" / "f1.png").read_bytes()[:2000])
    return add_pose(folder, "bad.png", 500000, 4000000, 420)


def of_another_camera(folder):
    Image.new("RGB", (300, 200)).save(folder / "frames" / "bad.png")
    add_pose(folder, "bad.png", 500000, 4000000, 420)


def without_position(folder):
    shutil.copy(folder / "frames" / "f1.png", folder / "frames" / "bad.png")


def off_the_map(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 500700, 4000000, 420)


def off_the_map_and_the_dem(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 590000, 4000000, 420)


def below_ground(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 500000, 4000000, -300)


def at_the_horizon(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 500000, 4000000, 420, "80,0,0")


def with_half_a_position(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 500000, "", 420)


def with_half_an_attitude(folder):
    without_position(folder)
    add_pose(folder, "bad.png", 500000, 4000000, 420, "1,,")


def add_pose(folder, name, east, north, height, angles="0,0,0"):
    with (folder / "camera_pose.csv").open("a") as table:
        table.write(f"{name},{east},{north},{height},{angles}\n")


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (unreadable, r"bad\.png cannot be read as an image"),
        (of_another_camera, "does not fit the camera"),
        (without_position, r"no position for bad\.png; add a row"),
        (off_the_map, "off the map.*give a map that covers"),
        (off_the_map_and_the_dem, "off the map"),
        (below_ground, r"bad\.png lies at -300 m, not above the ground"),
        (at_the_horizon, "horizon"),
        (with_half_a_position, r"no position for bad\.png"),
        (with_half_an_attitude, r"no yaw for bad\.png"),
    ],
)
def test_a_bad_frame_becomes_a_row_with_its_reason_and_the_others_are_placed(folder, spoil, reason):
    spoil(folder)
    table = run(folder)
    assert sorted(table.index) == ["bad.png", *POSES]
    bad = table.loc["bad.png"]
    assert pd.Series([bad["status"]]).str.contains(reason).all(), bad["status"]
    assert "\n" not in bad["status"]
    assert bad["alarm"] and bad["quality"] == 0
    assert bad[["easting", "northing", "latitude", "longitude", "error_m"]].isna().all()
    assert (table.drop("bad.png")["status"] == "placed").all()


def test_a_frame_with_half_a_table_position_is_placed_by_its_other_source(folder):
    longitude, latitude = Transformer.from_crs(UTM, 4326, always_xy=True).transform(
        500000 + POSES["f3.png"][0], 4000000 + POSES["f3.png"][1]
    )
    pose = pd.read_csv(folder / "camera_pose.csv").set_index("frame")
    pose.loc["f3.png", "northing_m"] = np.nan
    pose.to_csv(folder / "camera_pose.csv")
    (folder / "flight_log.csv").write_text(
        f"frame,latitude_deg,longitude_deg\nf3.png,{latitude},{longitude}\n"
    )
    row = run(folder).loc["f3.png"]
    assert row["status"] == "placed"
    assert distance(row, "f3.png") < 1.2 * PIXEL


def test_frames_of_another_place_raise_the_alarm(folder):
    _, elsewhere = world(slope=12.0, seed=77)
    ground = GRID.image(np.full(GRID.shape, 50.0))
    for k, yaw in enumerate(range(0, 360, 30)):
        name = f"else{k}.png"
        pose = Pose.from_yaw_pitch_roll((500000, 4000000, 400), yaw)
        write_frame(folder / "frames" / name, render(elsewhere, ground, CAMERA, pose))
        add_pose(folder, name, 500000, 4000000, 420, f"0,0,{-yaw}")
    table = run(folder)
    unrelated = table[table.index.str.startswith("else")]
    assert unrelated["alarm"].sum() >= len(unrelated) - 1
    assert unrelated["status"].str.startswith("alarm").sum() >= len(unrelated) - 1
    assert not table.loc[list(POSES), "alarm"].any()


def test_an_image_of_one_grey_raises_the_alarm(folder):
    Image.new("RGB", (220, 200), "grey").save(folder / "frames" / "bad.png")
    add_pose(folder, "bad.png", 500000, 4000000, 420)
    assert run(folder).loc["bad.png", "alarm"]


def first(folder, settings=SETTINGS):
    next(localise_flight(FlightFolder.open(folder), settings))


def test_an_unknown_method_is_refused_before_the_first_frame(folder):
    with pytest.raises(InputError, match=r"flight\.method 'magic' is unknown; use one of pc"):
        first(folder, FlightSettings("magic"))


def test_a_map_without_crs_is_refused_before_the_first_frame(folder):
    write_map(folder / "reference.tif", np.ones(GRID.shape), crs=None)
    with pytest.raises(InputError, match=r"reference\.tif has no CRS"):
        first(folder)


def test_a_pose_table_without_a_column_is_refused_before_the_first_frame(folder):
    (folder / "camera_pose.csv").write_text("frame,easting_m\nf1.png,1\n")
    with pytest.raises(InputError, match=r"camera_pose\.csv lacks the column northing_m"):
        first(folder)


def test_broken_metadata_of_one_frame_does_not_end_the_flight(folder):
    exif = Image.Exif()
    exif.get_ifd(0x8825).update({1: "N", 2: (24.0, 30.0), 3: "E", 4: 120.0})
    Image.new("RGB", (220, 200)).save(folder / "frames" / "bad.jpg", exif=exif)
    table = run(folder)
    assert "no position for bad.jpg" in table.loc["bad.jpg", "status"]
    assert (table.drop("bad.jpg")["status"] == "placed").all()


def test_a_flight_without_any_height_says_what_to_add(over_level_ground, tmp_path):
    folder = shutil.copytree(over_level_ground, tmp_path / "flight")
    log = pd.read_csv(folder / "flight_log.csv")
    log.drop(columns="height_above_ground_m").to_csv(folder / "flight_log.csv", index=False)
    status = run(folder)["status"]
    assert status.str.contains(r"no height above ground.*add dem\.tif").all()


def test_a_flight_without_a_camera_says_what_to_add(folder):
    (folder / "camera.json").unlink()
    assert run(folder)["status"].str.contains(r"no focal length.*camera\.json").all()


def test_a_map_too_coarse_for_the_frames_says_so(folder):
    with rasterio.open(folder / "reference.tif") as fine:
        values = fine.read(1)[::21, ::21]
    with rasterio.open(
        folder / "reference.tif",
        "w",
        driver="GTiff",
        count=1,
        height=20,
        width=20,
        dtype="float32",
        crs=UTM,
        transform=GRID.transform @ GRID.transform.scale(21),
    ) as coarse:
        coarse.write(values[None])
    assert run(folder)["status"].str.contains("map pixels; use a map sharper").all()


@pytest.mark.parametrize(
    ("shift", "east", "north"),
    [((0, 0), 0, 0), ((1, 0), 0, -30), ((-2, 0), 0, 60), ((0, 3), 60, 0), ((0.5, -1.5), -30, -15)],
)
def test_a_shift_down_is_south_and_a_shift_to_the_right_is_east(shift, east, north):
    found = located((1000.0, 2000.0), np.array(shift, float), (30.0, 20.0))
    assert found == pytest.approx((1000 + east, 2000 + north))
