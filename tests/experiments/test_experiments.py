"""Trials with a known shift, and how methods are judged by them."""

import numpy as np
import pandas as pd
import pytest

from pcnav_study.errors import InputError
from pcnav_study.experiments import Task, benchmark, break_points, judge, light_grid, sweep
from pcnav_study.experiments import peers as peer_module
from pcnav_study.matching import match
from pcnav_study.scene import SunPosition, fractal_relief
from pcnav_study.scene.trials import Conditions, Site


@pytest.fixture(scope="module")
def site():
    return Site(fractal_relief((200, 220), (30, 30), np.random.default_rng(9)), (30.0, 30.0))


def same_sun(**changes):
    return Conditions(SunPosition(100, 45), SunPosition(100, 45), **{"noise": 0.0} | changes)


def test_windows_of_one_sun_register_by_their_known_shift(site):
    trials = site.draw(same_sun(), 64, 6, np.random.default_rng(1))
    for reference, moving, shift in zip(trials.reference, trials.moving, trials.shift, strict=True):
        moved = np.roll(moving, np.rint(shift).astype(int), (0, 1))[16:-16, 16:-16]
        assert np.corrcoef(moved.ravel(), reference[16:-16, 16:-16].ravel())[0, 1] > 0.9
        assert np.abs(shift).max() <= 64 / 6


def test_rims_show_different_ground_as_in_flight(site):
    trials = site.draw(same_sun(), 64, 6, np.random.default_rng(1))
    k = int(np.abs(trials.shift[:, 0]).argmax())
    assert abs(trials.shift[k, 0]) > 2
    rolled = np.roll(trials.moving[k], np.rint(trials.shift[k]).astype(int), (0, 1))
    wrapped = rolled[:2] if trials.shift[k, 0] > 0 else rolled[-2:]
    fixed = trials.reference[k][:2] if trials.shift[k, 0] > 0 else trials.reference[k][-2:]
    assert np.corrcoef(wrapped.ravel(), fixed.ravel())[0, 1] < 0.9


def test_noise_is_a_share_of_the_picture_s_own_scatter(site):
    clean, noisy = (
        site.draw(same_sun(noise=noise), 64, 8, np.random.default_rng(2)) for noise in (0.0, 0.5)
    )
    # Equal seeds draw equal places only for the first pair.
    added = (noisy.reference[0] - clean.reference[0]).std()
    assert added == pytest.approx(0.5 * clean.reference.std(), rel=0.35)


def test_turned_and_magnified_windows_are_so_about_their_middle(site):
    plain, turned = (
        site.draw(same_sun(**change), 65, 1, np.random.default_rng(3)).moving[0]
        for change in ({}, {"rotation": 90.0})
    )
    np.testing.assert_allclose(turned, np.rot90(plain), atol=1e-3)
    larger = site.draw(same_sun(scale=2.0), 65, 1, np.random.default_rng(3)).moving[0]
    np.testing.assert_allclose(larger[::2, ::2], plain[16:49, 16:49], atol=1e-3)


def test_relief_too_small_is_named(site):
    with pytest.raises(InputError, match="do not fit"):
        site.draw(same_sun(), 190, 1, np.random.default_rng(1))


def test_grid_has_every_combination_and_sweep_varies_one_thing(site):
    cells = light_grid(["a", "b"], 64, [0, 90], 45, [30, 60, 75])
    assert (
        len({(c.site, c.azimuth_difference, c.conditions.moving_sun.zenith) for c in cells}) == 12
    )
    swept = sweep(["a"], 64, [0], {"noise": [0.0, 1.0], "size": [32]}, shadows=True)
    assert [c.size for c in swept] == [64, 64, 32]
    assert [c.conditions.noise for c in swept] == [0.0, 1.0, same_sun().noise + 0.01]
    assert all(c.conditions.shadows for c in swept)
    with pytest.raises(InputError, match="'haze' cannot be swept; use some of noise"):
        sweep(["a"], 64, [0], {"haze": [1.0]})


def test_judge_counts_what_match_finds(site):
    (cell,) = light_grid(["f"], 64, [90], 45, [45], noise=0.01)
    rows = judge(site, Task(cell, ("pc", "pc-sectors"), 6, 1.0, seed=4))
    trials = site.draw(cell.conditions, 64, 6, np.random.default_rng(4))
    for row in rows:
        right = [
            np.hypot(*(match(a, b, row["method"]).shift - d)) <= 1
            for a, b, d in zip(trials.reference, trials.moving, trials.shift, strict=True)
        ]
        assert row["success"] == np.mean(right)
        assert row["success_low"] <= row["success"] <= row["success_high"]
        assert (row["n"], row["azimuth_difference"]) == (6, 90)
    with pytest.raises(InputError, match="'guess' is unknown"):
        Task(cell, ("guess",), 1, 1.0, 0)


def test_break_point_is_the_first_value_below_the_level():
    def rows(varied, values, successes):
        return pd.DataFrame(
            {"varied": varied, varied: values, "azimuth_difference": 0.0, "method": "m",
             "success": successes, "n": 20}
        )  # fmt: skip

    noise = break_points(rows("noise", [0.0, 0.1, 0.5], [1.0, 0.96, 0.5])).iloc[0]
    assert (noise["holds_to"], noise["breaks_at"]) == (0.1, 0.5)
    size = break_points(rows("size", [32, 64, 128], [0.4, 0.99, 1.0])).iloc[0]
    assert (size["holds_to"], size["breaks_at"]) == (64, 32)
    never = break_points(rows("noise", [0.0, 0.1], [1.0, 1.0])).iloc[0]
    assert never["holds_to"] == 0.1
    assert np.isnan(never["breaks_at"])
    at_once = break_points(rows("noise", [0.0, 0.1], [0.2, 0.1])).iloc[0]
    assert np.isnan(at_once["holds_to"])
    assert at_once["breaks_at"] == 0.0


def test_benchmark_pairs_ours_with_peers_and_reports_the_absent(site, monkeypatch):
    def missing():
        raise ImportError("no such library")

    monkeypatch.setitem(peer_module.PEERS, "nobody", ("phase", missing))
    cells = light_grid(["f"], 64, [0], 45, [45], noise=0.01)
    (table,) = benchmark(
        {"f": site}, cells, n=3, seed=3, methods=["pc-sectors", "ncc"],
        peers=["scikit-image", "nobody"], roaming_n=1,
    )  # fmt: skip
    table = table.set_index("method")
    assert table.loc["pc-sectors", "success"] == 1
    assert table.loc["scikit-image", "ratio_to_fastest_peer"] == 1
    ratio = table.loc["pc-sectors", "median_ms"] / table.loc["scikit-image", "median_ms"]
    assert table.loc["pc-sectors", "ratio_to_fastest_peer"] == pytest.approx(ratio)
    assert table.loc["nobody", "n"] == 0
    assert table.loc["nobody", "note"].startswith("absent")
    assert (table.loc[["ncc, roaming", "mi, roaming"], "n"] == 1).all()
    assert table.loc["ncc, roaming", "median_ms"] > 5 * table.loc["ncc", "median_ms"]
    assert table.loc["ncc, roaming", "median_px"] == pytest.approx(
        table.loc["ncc", "median_px"], abs=0.2
    )
