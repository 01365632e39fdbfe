"""A user's flight folder, through ``kedro run --pipelines=flight``."""

import json
import shutil

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from PIL import Image
from scipy.spatial.transform import Rotation

from pcnav_study.scene import Pose

COLUMNS = [
    "frame", "status", "easting", "northing", "latitude", "longitude", "quality", "alarm",
    "shift_row_px", "shift_col_px", "prior_error_m", "error_m", "method",
]  # fmt: skip


@pytest.fixture(scope="module")
def folder(finished, tmp_path_factory):
    """The first flight of the small study (the map's own sun), as a user would bring it."""
    path = tmp_path_factory.mktemp("flight")
    (path / "frames").mkdir()
    shutil.copy(finished.versions("reference_map.tif")[0], path / "reference.tif")
    shutil.copy(finished.versions("elevation.tif")[0], path / "dem.tif")
    flight = xr.load_dataset(finished.versions("frames.nc")[0])
    rows = []
    for k in range(2):
        one = flight.isel(frame=k)
        image = one["frames"].values
        grey = np.clip(255 * image / image.max(), 0, 255).astype(np.uint8)
        Image.fromarray(grey).save(path / "frames" / f"{k}.png")
        pose = Pose.from_yaw_pitch_roll(
            (0, 0, 0), *(float(one[n]) for n in ("yaw", "pitch", "roll"))
        )
        angles = Rotation.from_matrix(pose.rotation).as_euler("XYZ", degrees=True)
        rows.append([str(k), *(float(one[n]) for n in ("east", "north", "height")), *angles])
    names = ["easting_m", "northing_m", "altitude_m", "omega_deg", "phi_deg", "kappa_deg"]
    pd.DataFrame(rows, columns=["frame", *names]).to_csv(path / "camera_pose.csv", index=False)
    width = 2 * np.tan(np.radians(40))
    camera = {"image_size_px": [96, 96], "focal_length_mm": 1.0, "sensor_size_mm": [width, width]}
    (path / "camera.json").write_text(json.dumps(camera))
    return path


def test_good_frames_are_placed_and_bad_ones_say_why(finished, folder):
    good = (folder / "frames" / "0.png").read_bytes()
    (folder / "frames" / "7_truncated.png").write_bytes(good[: len(good) // 2])
    (folder / "frames" / "8_nowhere.png").write_bytes(good)
    (folder / "frames" / "9_far.png").write_bytes(good)
    poses = pd.read_csv(folder / "camera_pose.csv", dtype={"frame": str})
    first = poses.iloc[[0]]
    far = first.assign(frame="9_far", easting_m=first["easting_m"] + 90_000)
    pd.concat([poses, first.assign(frame="7_truncated"), far]).to_csv(
        folder / "camera_pose.csv", index=False
    )
    done = finished.run(
        "--pipelines=flight",
        f"--params=flight.folder={folder},flight.prior_offset_m=200,flight.prior_error_m=300",
    )
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(finished.versions("flight_positions.csv")[-1]).set_index("frame")
    assert [table.index.name, *table.columns][: len(COLUMNS)] == COLUMNS
    assert list(table.index) == ["0.png", "1.png", "7_truncated.png", "8_nowhere.png", "9_far.png"]
    placed = table.loc[["0.png", "1.png"]]
    assert (placed["status"] == "placed").all()
    assert not placed["alarm"].any()
    assert (placed["prior_error_m"] > 10).all()
    assert (placed["error_m"] < 93).all(), "within a pixel of the map"
    footprints = json.loads(finished.versions("flight_footprints.geojson")[-1].read_text())
    assert [f["properties"]["frame"] for f in footprints["features"]] == ["0.png", "1.png"]
    for feature in footprints["features"]:
        ring = np.array(feature["geometry"]["coordinates"][0])
        inside = ring.min(axis=0), ring.max(axis=0)
        camera = [feature["properties"][f"camera_{n}"] for n in ("longitude", "latitude")]
        assert (inside[0] < camera).all() and (camera < inside[1]).all()
    page = finished.versions("flight.html")[-1].read_text()
    assert "A flight, found on its map" in page
    assert "9_far.png" in page and "off the map" in page
    assert page.count('id="figure-') >= 3
    reasons = {
        "7_truncated.png": "cannot be read",
        "8_nowhere.png": "no position",
        "9_far.png": "off the map",
    }
    for frame, reason in reasons.items():
        assert reason in table.loc[frame, "status"]
        assert table.loc[frame, "alarm"]


@pytest.mark.parametrize(
    ("params", "says"),
    [
        ("flight.method=guess", "parameter flight.method = 'guess': method 'guess' is unknown"),
        ("flight.reference=missing.tif", "map missing.tif cannot be opened"),
        ("flight.largest_patch_px=tiny", "largest_patch_px"),
    ],
)
def test_what_concerns_the_whole_flight_stops_it_at_once(finished, folder, params, says):
    done = finished.run("--pipelines=flight", f"--params=flight.folder={folder},{params}")
    assert done.returncode == 1
    assert says in done.stderr.split("Error:")[-1]
    assert "Traceback" not in done.stderr
