"""Installation constants: recovered from spoilt data, and never from the frame they judge."""

import json

import numpy as np
import pandas as pd
import pytest

from pcnav_study.errors import InputError
from pcnav_study.navigation import Installation, calibrated, cross_validated, fit

TRUTH = Installation(18.0, -1.5, 3.0, -6.0)


def misfits(heading, noise=0.5, wrong=0, seed=1):
    rng = np.random.default_rng(seed)
    misfit = TRUTH.offsets(heading) + noise * rng.standard_normal((len(heading), 2))
    misfit[:wrong] += rng.choice([-1, 1], (wrong, 2)) * rng.uniform(30, 90, (wrong, 2))
    return misfit


def test_looking_ahead_moves_the_find_along_the_heading():
    ahead = Installation(look_along_m=10.0)
    expected = [[0, 10], [10, 0], [0, -10], [-10, 0]]
    np.testing.assert_allclose(ahead.offsets([0, 90, 180, 270]), expected, atol=1e-9)
    aside = Installation(look_across_m=10.0)
    np.testing.assert_allclose(aside.offsets([0, 90]), [[10, 0], [0, -10]], atol=1e-9)


@pytest.mark.parametrize("wrong", [0, 8])
def test_constants_are_recovered_from_opposite_headings_with_a_quarter_wrong(wrong):
    heading = np.tile([152.0, -26.0, 150.0, -34.0], 8)
    found = fit(misfits(heading, wrong=wrong), heading)
    for name in ("look_along_m", "look_across_m", "bias_east_m", "bias_north_m"):
        assert getattr(found, name) == pytest.approx(getattr(TRUTH, name), abs=0.6)
    assert found.scatter_m == pytest.approx(0.5, abs=0.2)
    assert 24 - wrong <= found.frames <= 32 - wrong


def test_one_heading_is_served_by_a_bias_alone():
    heading = np.full(6, 40.0)
    found = fit(misfits(heading, noise=0.0), heading)
    assert (found.look_along_m, found.look_across_m) == (0.0, 0.0)
    np.testing.assert_allclose(found.offsets(heading), TRUTH.offsets(heading), atol=1e-6)


def test_a_frame_never_judges_itself():
    heading = np.tile([152.0, -26.0, 60.0, 240.0, 10.0], 4)
    misfit = misfits(heading, noise=0.0)
    misfit[7] += 500.0
    offsets = cross_validated(misfit, heading, np.ones(20, bool))
    np.testing.assert_allclose(offsets, TRUTH.offsets(heading), atol=0.01)
    alone = cross_validated([[1.0, 0.0], [5.0, 0.0]], [0.0, 0.0], [True, True])
    np.testing.assert_allclose(alone, [[5, 0], [1, 0]], atol=1e-9)


def table(heading):
    misfit = misfits(np.asarray(heading, float), noise=0.0)
    recorded = np.array([[500000.0 + 10 * k, 4000000.0] for k in range(len(heading))])
    found = recorded + misfit
    columns = {
        "easting": found[:, 0], "northing": found[:, 1], "latitude": 0.0, "longitude": 0.0,
        "error_m": np.hypot(*misfit.T), "heading_deg": heading, "alarm": False,
        "recorded_easting": recorded[:, 0], "recorded_northing": recorded[:, 1],
        "centre_easting": found[:, 0], "centre_northing": found[:, 1], "calibration": "none",
    }  # fmt: skip
    return pd.DataFrame(columns)


def test_constants_from_a_file_serve_the_next_flight(tmp_path):
    first = table(np.tile([152.0, -26.0, 60.0], 5))
    out, constants = calibrated(first, "cross-validate", "EPSG:32616")
    assert out["error_m"].max() < 0.01
    path = tmp_path / "flight_calibration.json"
    path.write_text(json.dumps(constants.as_dict()))
    raw = table([0.0, 90.0])
    placed, _ = calibrated(raw, str(path), "EPSG:32616")
    assert placed["error_m"].max() < 0.01
    assert (placed["calibration"] == path.name).all()
    assert placed["latitude"].iloc[0] == pytest.approx(36.14, abs=0.05)
    # The camera's look moves the camera, not what it saw.
    np.testing.assert_allclose(raw["centre_easting"] - placed["centre_easting"], 3.0, atol=0.01)
    untouched, none = calibrated(raw, "none", "EPSG:32616")
    pd.testing.assert_frame_equal(untouched, raw)
    assert none == Installation()


def test_bad_constants_are_refused_by_name(tmp_path):
    with pytest.raises(InputError, match=r"missing\.json cannot be opened"):
        Installation.read(tmp_path / "missing.json")
    (tmp_path / "list.json").write_text("[1]")
    with pytest.raises(InputError, match=r"list\.json holds no installation constants"):
        Installation.read(tmp_path / "list.json")
    with pytest.raises(InputError, match="no frame without alarm"):
        fit(np.empty((0, 2)), np.empty(0))
