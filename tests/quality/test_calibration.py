"""Calibration against scikit-learn, hand algebra and simulation."""

import json

import numpy as np
import pandas as pd
import pytest
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import roc_auc_score
from sklearn.preprocessing import PolynomialFeatures

from pcnav_study.errors import InputError
from pcnav_study.quality import Evidence, fit, frozen
from pcnav_study.quality.calibration import (
    as_json,
    conformal_radius,
    conformal_threshold,
    from_json,
    terms,
)
from pcnav_study.quality.judge import auc, calibration_error, judge_quality, reliability

FIELDS = list(Evidence._fields)


def table(rng, n=900):
    """Right matches have more of everything, by a factor that varies."""
    right = rng.random(n) < 0.5
    logs = rng.normal(0, 0.5, (n, len(FIELDS))) + np.where(right, 0.0, -0.8)[:, None]
    errors = np.where(right, rng.uniform(0, 1, n), rng.uniform(1.01, 30, n))
    kinds = np.where(right, "match", np.where(rng.random(n) < 0.5, "beside", "off_route"))
    logs[:, FIELDS.index("above_null")] += 4.0  # well above chance
    columns = dict(zip(FIELDS, np.exp(logs).T, strict=True))
    return pd.DataFrame(columns | {"error_px": errors, "kind": kinds})


@pytest.fixture
def made(rng):
    return fit(table(rng), table(rng), false_alarm_rate=0.05)


def test_the_score_is_scikit_learns_logistic_regression(rng):
    training = table(rng)
    made = fit(training, table(rng), false_alarm_rate=0.05)
    logs = np.log(training[FIELDS].to_numpy())
    x = (logs - logs.mean(axis=0)) / logs.std(axis=0)
    features = PolynomialFeatures(2, include_bias=False).fit_transform(x)
    model = LogisticRegression(C=1.0, max_iter=10_000, tol=1e-8)
    model.fit(features, training["error_px"] <= 1)
    expected = model.decision_function(features)
    np.testing.assert_allclose(made.score(training[FIELDS].to_numpy()), expected, atol=2e-3)


def test_terms_by_hand():
    found = terms(np.exp([[1.0, 3.0]]), np.array([0.0, 1.0]), np.array([1.0, 2.0]))
    np.testing.assert_allclose(found, [[1, 1, 1, 1, 1, 1]])
    found = terms(np.exp([[2.0, 7.0]]), np.array([0.0, 1.0]), np.array([1.0, 2.0]))
    np.testing.assert_allclose(found, [[1, 2, 3, 4, 6, 9]])


def test_probabilities_rise_with_the_score_and_mean_what_they_say(made, rng):
    fresh = table(rng, 3000)
    score = made.score(fresh[FIELDS].to_numpy())
    probability = made.probability(score)
    assert (np.diff(probability[np.argsort(score)]) >= 0).all()
    assert probability.min() > 0
    assert probability.max() < 1
    assert calibration_error(probability, (fresh["error_px"] <= 1).to_numpy()) < 0.04


@pytest.mark.parametrize(("n", "rate"), [(19, 0.05), (60, 0.05), (150, 0.02)])
def test_the_false_alarm_promise_holds_in_small_samples(rng, n, rate):
    scores = rng.gamma(2.0, size=(6000, n + 1))
    false = np.mean([row[-1] < conformal_threshold(row[:-1], rate) for row in scores])
    assert false <= rate + 3 * np.sqrt(rate / 6000)
    assert false >= np.floor(rate * (n + 1)) / (n + 1) - 3 * np.sqrt(rate / 6000)


def test_too_small_a_sample_cannot_promise():
    with pytest.raises(InputError, match=r"98 right matches .* give at least 99"):
        conformal_threshold(np.arange(98.0), 0.01)
    assert conformal_threshold(np.arange(99.0), 0.01) == 0


@pytest.mark.parametrize(("n", "coverage"), [(19, 0.95), (40, 0.9)])
def test_the_radius_covers_as_often_as_it_says(rng, n, coverage):
    errors = rng.exponential(size=(5000, n + 1))
    inside = np.mean([row[-1] <= conformal_radius(row[:-1], coverage) for row in errors])
    assert coverage - 0.015 < inside < coverage + 1 / (n + 1) + 0.015
    assert conformal_radius(np.ones(18), 0.95) == np.inf


def test_a_better_score_has_no_larger_radius_than_the_worst(made, rng):
    score = made.score(table(rng)[FIELDS].to_numpy())
    radius = made.radius(np.sort(score))
    assert radius[-1] <= 1.01
    assert radius[0] > 5
    assert made.radius(np.array([-1e9]))[0] == np.inf


def test_json_and_back(made):
    stored = json.loads(json.dumps(as_json(made)))
    assert from_json(stored) == made


def test_one_sided_tables_are_refused(rng):
    good = table(rng)
    with pytest.raises(InputError, match="the training table has only right matches"):
        fit(good[good["error_px"] <= 1], good, false_alarm_rate=0.05)
    with pytest.raises(InputError, match="the calibration table has only wrong matches"):
        fit(good, good[good["error_px"] > 1], false_alarm_rate=0.05)


def test_the_shipped_calibration_promises_what_it_states():
    shipped = frozen()
    count = 1 + len(FIELDS) + len(FIELDS) * (len(FIELDS) + 1) // 2
    assert len(shipped.weights) == count, "made for other evidence: run recalibration"
    assert 0 < shipped.false_alarm_rate <= 0.01
    assert shipped.made_from["n_right"] > 1000
    assert (np.diff(shipped.probabilities) >= 0).all()


def test_the_area_is_scikit_learns_and_its_interval_covers_the_truth(rng):
    hits = 0
    for _ in range(300):
        right, wrong = rng.normal(1.5, 1, 40).round(1), rng.normal(0, 1, 60).round(1)
        area, low, high = auc(right, wrong)
        labels = np.r_[np.ones(40), np.zeros(60)]
        assert area == pytest.approx(roc_auc_score(labels, np.r_[right, wrong]))
        hits += low <= 0.8556 <= high  # the normal distribution at 1.5 / sqrt(2)
    assert hits / 300 == pytest.approx(0.95, abs=0.04)


def test_calibration_error_and_reliability_by_hand():
    probability = np.array([0.05, 0.05, 0.95, 0.95, 1.0])
    right = np.array([False, True, True, True, False])
    expected = (2 * abs(0.05 - 0.5) + 3 * abs(2.9 / 3 - 2 / 3)) / 5
    assert calibration_error(probability, right) == pytest.approx(expected)
    bins = reliability(probability, right)
    assert bins["n"].tolist() == [2, 3]
    assert bins["observed"].tolist() == pytest.approx([0.5, 2 / 3])


def test_rates_are_counted_among_their_own(made):
    rows = pd.DataFrame(
        {
            "kind": ["match", "match", "match", "beside", "plain_pc", "off_route", "cloud"],
            "error_px": [0.2, 0.3, 0.9, 1.5, 2.5, np.inf, 0.4],
            "alarm": [False, True, False, True, False, True, True],
            "probability": [0.9, 0.2, 0.9, 0.1, 0.8, 0.0, 0.3],
            "radius_px": [0.3, np.inf, 0.5, np.inf, 1.0, np.inf, np.inf],
        }
        | {name: np.linspace(1, 0.1, 7) for name in FIELDS}
    )
    report = judge_quality(rows, made)
    assert report["false_alarm_rate"]["value"] == pytest.approx(1 / 3)
    assert report["false_alarm_rate_all"]["value"] == pytest.approx(2 / 4)
    assert report["missed_alarm_rate"]["value"] == pytest.approx(1 / 3)
    assert report["missed_alarm_rate_beyond_2_px"]["n"] == 2
    assert report["radius_coverage"]["value"] == pytest.approx(1 / 3)
    assert report["auc_off_route"]["n_wrong"] == 1
    assert set(report["missed_by_kind"]) == {"beside", "plain_pc", "off_route"}


def test_the_null_overrules_whatever_the_regression_says(made):
    good = np.exp(np.full((1, len(FIELDS)), 0.5))
    column = FIELDS.index("above_null")
    strong, weak = good.copy(), good.copy()
    strong[0, column], weak[0, column] = 10.0, 1.5
    free = terms(weak, np.array(made.mean), np.array(made.scale)) @ made.weights
    assert made.score(weak)[0] < free[0] - 10
    assert made.score(strong)[0] == pytest.approx(
        (terms(strong, np.array(made.mean), np.array(made.scale)) @ made.weights)[0]
    )


def test_a_full_separation_of_few_is_not_certain():
    assert auc(np.array([2.0, 3.0, 4.0]), np.array([0.0, 1.0])) == pytest.approx(
        (1.0, np.sqrt(0.025), 1.0)
    )
