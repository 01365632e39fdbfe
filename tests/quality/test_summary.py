"""Match tables in numbers that can be worked out by hand."""

import numpy as np
import pandas as pd
import pytest

from pcnav_study.quality import assess, summarise, unrelated_level, wilson


@pytest.mark.parametrize(
    ("successes", "n"), [(0, 10), (10, 10), (3, 7), (1, 1), (49, 60), (500, 1000)]
)
def test_wilsons_interval_is_the_closed_formula(successes, n):
    z, p = 1.959963984540054, successes / n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    assert wilson(successes, n) == pytest.approx((middle - half, middle + half), abs=1e-9)


def test_wilsons_interval_covers_the_true_share_as_often_as_it_says():
    rng = np.random.default_rng(2)
    shares = rng.uniform(0.05, 0.95, 1500)
    inside = [
        low <= p <= high
        for p, (low, high) in ((p, wilson(int(rng.binomial(40, p)), 40)) for p in shares)
    ]
    assert np.mean(inside) == pytest.approx(0.95, abs=0.02)


def table(**columns):
    n = len(columns["error_px"])
    defaults = {"method": ["pc"] * n, "sun_difference": [0.0] * n, "quality": [0.5] * n}
    return pd.DataFrame(defaults | {"candidates": [1089] * n} | columns)


def test_a_match_is_correct_within_the_tolerance():
    found = assess(
        table(error_px=[0.0, 0.99, 1.0, 1.01, 30, np.nan]),
        window=(64, 64),
        false_match_rate=0.01,
        tolerance_px=1.0,
    )
    assert found["correct"].tolist() == [True, True, True, False, False, False]
    assert (found["tolerance_px"] == 1).all()


@pytest.mark.parametrize("rate", [0.001, 0.01, 0.2])
@pytest.mark.parametrize("side", [48, 128])
def test_assessing_alarms_below_each_methods_own_level(rate, side):
    levels = {
        m: unrelated_level(m, (side, side), false_match_rate=rate) for m in ("pc", "pc-sectors")
    }
    rows = [(m, level + step) for m, level in levels.items() for step in (-1e-6, 1e-6)]
    methods, qualities = zip(*rows, strict=True)
    found = assess(
        table(error_px=np.zeros(4), quality=qualities, method=methods),
        window=(side, side),
        false_match_rate=rate,
        tolerance_px=1.0,
    )
    assert found["alarm"].tolist() == [True, False, True, False]
    assert len(set(levels.values())) == 2


def test_assessing_adds_columns_and_changes_none():
    before = table(error_px=[0.5, 2.0])
    kept = before.copy(deep=True)
    after = assess(before, window=(64, 64), false_match_rate=0.01, tolerance_px=1.0)
    pd.testing.assert_frame_equal(before, kept)
    pd.testing.assert_frame_equal(after[before.columns.tolist()], before)


def judged(**columns):
    return table(**columns).assign(
        tolerance_px=1.0, correct=lambda t: t["error_px"] <= 1, alarm=columns.get("alarm", False)
    )


def test_a_hand_made_table_is_summarised_as_by_hand():
    one = judged(
        error_px=[0.3, 0.4, 20.0, 0.5],
        sun_difference=[2.0, 7.0, 1.0, 8.0],  # bins 0, 0, 0 and 15
        quality=[0.5, 0.7, 0.1, 0.9],
        alarm=[False, False, True, False],
    )
    other = judged(error_px=[5.0, 9.0], method=["ncc"] * 2, sun_difference=[88.0, 92.0])
    found = summarise([one, other], bin_deg=15.0)
    assert found["method"].tolist() == ["ncc", "pc", "pc"]
    assert found["sun_difference_deg"].tolist() == [90, 0, 15]
    assert found["n"].tolist() == [2, 3, 1]
    assert found["success"].tolist() == pytest.approx([0, 2 / 3, 1])
    assert found["median_error_px"].tolist() == pytest.approx([7, 0.4, 0.5])
    assert found["median_quality"].tolist() == pytest.approx([0.5, 0.5, 0.9])
    assert found["alarm_rate"].tolist() == pytest.approx([0, 1 / 3, 0])
    assert found["rmse_px"].tolist()[1:] == pytest.approx([np.sqrt((0.09 + 0.16) / 2), 0.5])
    assert np.isnan(found["rmse_px"][0])
    assert (found["success_low"] <= found["success"]).all()
    assert (found["success"] <= found["success_high"]).all()


@pytest.mark.parametrize("width", [5.0, 15.0, 30.0])
def test_every_match_is_counted_in_the_bin_nearest_to_its_sun_difference(width):
    differences = np.random.default_rng(4).uniform(0, 180, 300)
    found = summarise([judged(error_px=np.zeros(300), sun_difference=differences)], bin_deg=width)
    assert found["n"].sum() == 300
    for row in found.itertuples():
        assert row.n == (np.abs(differences - row.sun_difference_deg) < width / 2).sum()


def test_the_order_of_the_tables_does_not_matter():
    rng = np.random.default_rng(6)
    tables = [
        judged(error_px=rng.exponential(1, 30), sun_difference=rng.uniform(0, 90, 30))
        for _ in range(3)
    ]
    pd.testing.assert_frame_equal(summarise(tables), summarise(tables[::-1]))
