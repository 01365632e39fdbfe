"""Real flights, where their folders are at hand.

The offsets of the priors are seeded; the tolerances are the study's goals, not its results.
"""

import os
from pathlib import Path

import numpy as np
import pytest
import rasterio
from scipy import ndimage

from pcnav_study.frames import FlightFolder, occluded, read_grey, read_metadata, rectify
from pcnav_study.frames.poses import pose_records
from pcnav_study.matching import match
from pcnav_study.navigation import (
    FlightSettings,
    Site,
    calibrated,
    flight_table,
    localise_flight,
)
from pcnav_study.scene import Grid

DATA = Path(os.environ.get("PCNAV_DATA") or Path(__file__).resolve().parents[3] / "shared" / "data")
MAPS = {"sentinel2_b432_byte.tif": 15.0, "landsat8_byte.tif": 30.0}


def folder(name, reference=None):
    if not (DATA / name).is_dir():
        pytest.skip(f"no real flight {name} in {DATA}; set PCNAV_DATA to its parent folder")
    return FlightFolder.open(DATA / name, str(DATA / name / reference) if reference else None)


@pytest.mark.parametrize("reference", MAPS)
def test_aerial_frames_are_placed_on_a_satellite_map_from_priors_wrong_by_300_m(reference):
    flight = folder("baviaanskloof", reference)
    for seed in range(3):
        settings = FlightSettings(prior_error_m=300.0, prior_offset_m=300.0, seed=seed)
        table = flight_table([row for row, _ in localise_flight(flight, settings)])
        assert len(table) == 2
        assert not table["alarm"].astype(bool).any()
        assert table["error_m"].max() < MAPS[reference]
        assert table["prior_error_m"].max() > 100
        assert (table["pose_source"] == "camera_pose.csv").all()
        out, _ = calibrated(table, "cross-validate", Site(flight).crs)
        assert out["error_m"].max() < 5.0, "by the map's offset on the other frame"


@pytest.mark.parametrize("frame", ["3324c_2015_1004_05_0182", "3324c_2015_1004_05_0184"])
def test_frames_are_rectified_as_the_published_orthophotos_are(frame):
    flight = folder("baviaanskloof")
    site = Site(flight)
    path = next(p for p in flight.frames if p.name.startswith(frame))
    metadata = read_metadata(path)
    record = pose_records((path,), {path.name: metadata}, flight.camera_pose)[path.name]
    with rasterio.open(DATA / "baviaanskloof" / "orthos" / f"{frame}_ortho.tif") as raster:
        published = raster.read(masked=True).astype(np.float32).filled(np.nan).mean(axis=0)
        grid = Grid(raster.transform, raster.shape, site.crs)
    pose, _ = site.pose(record, *site.position(record))
    heights = site.ground(grid)
    ours = rectify(read_grey(path), site.camera(metadata), pose, grid, heights)
    ours[occluded(heights, grid, pose)] = np.nan
    side, shifts = 64, []
    for row in range(0, grid.shape[0] - side, side):
        for col in range(0, grid.shape[1] - side, side):
            block = np.s_[row : row + side, col : col + side]
            both = np.isfinite(published[block]) & np.isfinite(ours[block])
            if both.all():
                shifts.append(match(published[block], ours[block], "pc").shift)
    assert len(shifts) > 50
    rmse = np.sqrt((np.array(shifts) ** 2).sum(axis=1).mean())
    assert rmse <= 1.0, f"{rmse:.2f} px of 5 m over {len(shifts)} blocks"


def test_drone_photos_over_a_town_are_placed_without_their_gps_position():
    flight = folder("fengyuan")
    settings = FlightSettings(prior_error_m=40.0, prior_offset_m=40.0, seed=11)
    raw = flight_table([row for row, _ in localise_flight(flight, settings)])
    table, constants = calibrated(raw, "cross-validate", Site(flight).crs)
    assert len(table) == 31
    good = table["error_m"] < 5.0
    assert good.mean() >= 0.9
    assert (~good & ~table["alarm"].astype(bool)).sum() <= 1
    assert constants.frames > 15
    assert table["sun"].str.startswith("unknown").all()
    assert ((table["status"] == "placed") == ~table["alarm"].astype(bool)).all()


def test_a_town_turned_upside_down_is_mostly_refused(tmp_path):
    flight = folder("fengyuan")
    with rasterio.open(flight.reference) as raster:
        profile = raster.profile | {"compress": "deflate", "photometric": "rgb"}
        bands = raster.read()
    small = ndimage.zoom(bands[:, ::-1, ::-1], (1, 0.25, 0.25), order=1)
    profile |= {"height": small.shape[1], "width": small.shape[2]}
    profile["transform"] *= rasterio.Affine.scale(
        bands.shape[2] / small.shape[2], bands.shape[1] / small.shape[1]
    )
    with rasterio.open(tmp_path / "reference.tif", "w", **profile) as raster:
        raster.write(small)
    wrong = FlightFolder.open(DATA / "fengyuan", str(tmp_path / "reference.tif"))
    settings = [
        FlightSettings(prior_error_m=40.0, prior_offset_m=40.0, seed=seed) for seed in range(3)
    ]
    rows = [row for one in settings for row, _ in localise_flight(wrong, one)]
    alarms = flight_table(rows)["alarm"].astype(bool)
    assert len(alarms) == 93
    assert alarms.mean() >= 0.85
