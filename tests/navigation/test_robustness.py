"""Damage is what it says, and the curves count what happened."""

import json

import numpy as np
import pandas as pd
import pytest
import rasterio
from PIL import Image

from pcnav_study.errors import InputError
from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, robustness_curves
from pcnav_study.navigation.robustness import blurred, clouded, compressed, resampled
from pcnav_study.scene import Camera, Grid, Pose, SunPosition, fractal_relief, render, shade

UTM = "EPSG:32616"
GRID = Grid.centred(500000.0, 4000000.0, (2.0, 2.0), (320, 320), UTM)
CAMERA = Camera((160, 180), 160.0)


@pytest.fixture
def picture(rng):
    return (rng.random((120, 160)) * 200).astype(np.float32)


def test_damage_is_what_it_says(picture, rng):
    assert resampled(picture, 0.5, rng).shape == (60, 80)
    assert resampled(picture, 2.0, rng).shape == (240, 320)
    assert resampled(picture, 0.5, rng).mean() == pytest.approx(picture.mean(), rel=0.01)
    assert blurred(picture, 8.0, rng).std() < 0.5 * picture.std()
    fine, coarse = (np.abs(compressed(picture, q, rng)).std() for q in (95, 5))
    assert coarse < fine
    for share in (0.25, 0.5, 0.75):
        white = clouded(picture, share, rng) > 0.98 * picture.max()
        assert white.mean() == pytest.approx(share, abs=0.12)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("flight")
    (path / "frames").mkdir()
    relief = fractal_relief(GRID.shape, (2.0, 2.0), np.random.default_rng(3), median_slope=15)
    light = shade(GRID.image(relief), sun=SunPosition(135, 45))
    with rasterio.open(
        path / "reference.tif", "w", driver="GTiff", count=1, height=320, width=320,
        dtype="float32", crs=UTM, transform=GRID.transform,
    ) as raster:  # fmt: skip
        raster.write(np.asarray(light, np.float32)[None])
    pose = Pose.from_yaw_pitch_roll((500000, 4000000, 400), 30.0)
    image = render(light, GRID.image(np.zeros(GRID.shape)), CAMERA, pose)
    grey = np.clip(np.nan_to_num(image) / np.nanmax(image) * 255, 0, 255).astype(np.uint8)
    Image.fromarray(grey).save(path / "frames" / "a.png")
    spec = {"image_size_px": [180, 160], "focal_length_mm": 1.6, "sensor_size_mm": [1.8, 1.6]}
    (path / "camera.json").write_text(json.dumps(spec))
    latitude, longitude = GRID.to_wgs84(500000.0, 4000000.0)
    log = {"latitude_deg": latitude, "longitude_deg": longitude, "flight_yaw_deg": 30.0}
    log |= {"frame": "a.png", "height_above_ground_m": 400.0}
    pd.DataFrame([log]).to_csv(path / "flight_log.csv", index=False)
    return FlightFolder.open(path)


SETTINGS = FlightSettings(prior_error_m=10.0, prior_offset_m=6.0, seed=2)


def test_mild_damage_is_borne_and_ruin_raises_the_alarm(folder):
    levels = {"resampled": [0.7, 1.4], "jpeg": [60], "yaw": [0.0, 90.0], "clouded": [0.98]}
    table = robustness_curves(folder, SETTINGS, levels=levels, tolerance_m=4.0, every=1)
    found = table.set_index(["damage", "level"])
    assert (found["n"] == 1).all()
    mild = [("resampled", 0.7), ("resampled", 1.4), ("jpeg", 60), ("yaw", 0.0)]
    assert (found.loc[mild, "success"] == 1.0).all()
    assert (found.loc[mild, "wrong_unalarmed"] == 0).all()
    ruined = found.loc[[("yaw", 90.0), ("clouded", 0.98)]]
    assert (ruined["alarm_rate"] == 1.0).all()


def test_unknown_damage_is_refused(folder):
    with pytest.raises(InputError, match="damage 'rust' is unknown; use resampled"):
        robustness_curves(folder, SETTINGS, levels={"rust": [1]}, tolerance_m=1.0, every=1)
