"""Footprints as RFC 7946 wants them."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from pcnav_study.navigation import Installation, footprint_collection
from pcnav_study.scene import Grid

CRS = "EPSG:32616"
ROW = {
    "frame": "a.jpg", "status": "placed", "alarm": False, "quality": 0.5, "method": "pc",
    "latitude": 36.1, "longitude": -87.0,
}  # fmt: skip


@pytest.mark.parametrize("order", [1, -1])
def test_rings_are_closed_counter_clockwise_and_in_degrees(order):
    grid = Grid.centred(500000.0, 4000000.0, (1.0, 1.0), (8, 8), CRS)
    corners = np.array([[0, 0], [100, 0], [100, 50], [0, 50.0]])[::order]
    corners += np.array([500000, 4000000])
    fix = SimpleNamespace(footprint=corners, fine=SimpleNamespace(grid=grid))
    lost = ROW | {"frame": "lost.jpg"}
    table = pd.DataFrame([ROW, lost])
    found = footprint_collection(table, {"a.jpg": fix}, Installation(bias_north_m=7.0))
    assert found["type"] == "FeatureCollection"
    (feature,) = found["features"]
    ring = np.array(feature["geometry"]["coordinates"][0])
    assert ring.shape == (5, 2) and (ring[0] == ring[-1]).all()
    x, y = ring[:-1].T
    assert (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() > 0
    assert np.allclose(x, -87, atol=0.01) and np.allclose(y, 36.14, atol=0.01)
    assert grid.to_wgs84(500000, 4000000 - 7)[0] == pytest.approx(y.min(), abs=1e-6)
    assert feature["properties"]["frame"] == "a.jpg"
