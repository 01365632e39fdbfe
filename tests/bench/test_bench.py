"""The benchmark on a handful of windows, with a known interval and an absent peer."""

import numpy as np
import pytest

from pcnav_study.bench import Cell, Scene, benchmark_table, break_points, wilson_interval
from pcnav_study.bench import peers as peer_module
from pcnav_study.bench.cells import window_pairs
from pcnav_study.errors import InputError
from pcnav_study.scene import fractal_relief


@pytest.fixture(scope="module")
def scene():
    return Scene(
        "fractal", fractal_relief((180, 200), (30, 30), np.random.default_rng(9)), (30, 30)
    )


def test_wilson_interval_of_ten_out_of_ten():
    low, high = wilson_interval(10, 10)
    assert low == pytest.approx(0.7225, abs=1e-4)
    assert high == pytest.approx(1)
    assert wilson_interval(0, 0) == (0, 1)


def test_windows_of_one_sun_register_by_their_known_shift(scene):
    for pair in window_pairs(scene, Cell(noise=0.0, size=64), 4, np.random.default_rng(1)):
        whole = np.rint(pair.shift).astype(int)
        moved = np.roll(pair.moving, whole, (0, 1))[16:-16, 16:-16]
        fixed = pair.reference[16:-16, 16:-16]
        assert np.corrcoef(moved.ravel(), fixed.ravel())[0, 1] > 0.8
        assert np.abs(pair.shift).max() <= 64 / 6 + 0.5


def test_scene_too_small_is_named(scene):
    with pytest.raises(InputError, match="too small"):
        window_pairs(scene, Cell(size=180), 1, np.random.default_rng(1))


def test_table_has_every_method_and_reports_the_absent(scene, monkeypatch):
    def missing():
        raise ImportError("no such library")

    monkeypatch.setitem(peer_module.PEERS, "nobody", ("phase", missing))
    cells = [Cell(size=64), Cell(90.0, size=64)]
    table = benchmark_table(
        [scene], cells, 5, 3, methods=["pc-sectors", "pc"], peers=["scikit-image", "nobody"]
    )
    assert set(table["method"]) == {"pc-sectors", "pc", "scikit-image", "nobody"}
    ours = table[table["method"] == "pc-sectors"]
    assert (ours["success"] == 1).all()
    assert (ours["ratio_to_fastest_peer"] > 0).all()
    absent = table[table["method"] == "nobody"]
    assert (absent["n"] == 0).all()
    assert absent["note"].str.contains("absent").all()
    plain = break_points(table, "azimuth_difference")
    assert np.isnan(plain["pc-sectors"])
    assert plain["pc"] == 90
