"""Real flights, where their folders are at hand."""

import os
from pathlib import Path

import numpy as np
import pytest

from pcnav_study.frames import FlightFolder
from pcnav_study.navigation import FlightSettings, flight_table, localise_flight

DATA = Path(os.environ.get("PCNAV_DATA") or Path(__file__).resolve().parents[3] / "shared" / "data")


def positions(name):
    if not (DATA / name).is_dir():
        pytest.skip(f"no real flight {name} in {DATA}; set PCNAV_DATA to its parent folder")
    folder = FlightFolder.open(DATA / name)
    rows = [row for row, _ in localise_flight(folder, FlightSettings("pc"))]
    return flight_table(rows).set_index("frame")


def test_aerial_frames_over_mountains_are_placed_on_the_satellite_map():
    table = positions("baviaanskloof")
    assert len(table) == 2
    assert (table["status"] == "placed").all()
    assert not table["alarm"].any()
    assert table["error_m"].max() < 30
    assert (table["pose_source"] == "camera_pose.csv").all()


def test_every_drone_photo_over_a_town_gets_a_row_with_status_and_position():
    table = positions("fengyuan")
    assert len(table) == 31
    assert table["status"].str.len().min() > 0
    assert np.isfinite(
        table[["easting", "northing", "latitude", "longitude"]].to_numpy(float)
    ).all()
    assert table["latitude"].between(24.25, 24.27).all()
    assert table["longitude"].between(120.71, 120.73).all()
    assert ((table["status"] == "placed") == ~table["alarm"].astype(bool)).all()
