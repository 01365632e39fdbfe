"""Trust in real matches: right ones, wrong ones, and what cannot be matched at all."""

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.matching import match, prepare
from pcnav_study.matching.surface import Surface
from pcnav_study.quality import evidence_of, trust
from pcnav_study.quality.cases import HARD, Plan, cases, collect, stacked
from pcnav_study.quality.evidence import NOTHING, rival_of
from pcnav_study.quality.measures import MEASURES, Crops, absent, measured
from pcnav_study.quality.sites import site_of
from pcnav_study.scene import SunPosition, fractal_relief, jacksboro
from pcnav_study.scene.trials import Conditions, Site


@pytest.fixture(scope="module")
def site():
    relief = fractal_relief((330, 300), (30.0, 30.0), np.random.default_rng(777))
    return Site(relief, (30.0, 30.0))


def trials(site, difference, n=6, size=96, seed=5):
    suns = SunPosition(100, 45), SunPosition(100 + difference, 45)
    drawn = site.draw(Conditions(*suns, noise=0.03), size, n, np.random.default_rng(seed))
    return list(zip(drawn.reference, drawn.moving, drawn.shift, strict=True))


@pytest.mark.parametrize("difference", [0, 60, 90, 135, 180])
def test_right_matches_are_trusted_and_displaced_ones_are_not(site, difference):
    probabilities, alarms = [], []
    for one, other, shift in trials(site, difference):
        found = match(one, other)
        assert np.hypot(*(found.shift - shift)) < 1
        good = trust(found, one, other)
        probabilities.append(good.probability)
        alarms.append(good.alarm)
        assert good.radius_px < 8
        beside = shift + np.array([1.6, -1.9])
        near = evidence_of(prepare(one), prepare(other), beside, found.surface)
        assert near.pull > good.evidence.pull
        assert near.quality < good.evidence.quality
        assert near.summit < 1
    assert sum(alarms) <= 1
    assert np.mean(probabilities) > 0.9


def test_plain_correlations_near_misses_at_right_angles_raise_the_alarm(site):
    seen = 0
    for one, other, shift in trials(site, 90, n=12):
        found = match(one, other, "pc")
        if np.hypot(*(found.shift - shift)) > 1.3:
            seen += 1
            assert trust(found, one, other).alarm
    assert seen >= 6


def test_ground_that_was_never_in_view_raises_the_alarm(site):
    pairs = trials(site, 90)
    rng = np.random.default_rng(1)
    for one, *_ in pairs:
        other = rng.standard_normal(one.shape)
        assert trust(match(one, other), one, other).alarm


@pytest.mark.parametrize("size", [8, 9, 16, 33])
@pytest.mark.parametrize("spoil", ["constant", "masked", "nothing valid"])
def test_empty_masked_and_tiny_windows_give_an_alarm_and_no_warning(rng, size, spoil):
    one, other = rng.standard_normal((2, size, size))
    if spoil == "constant":
        other[:] = 3.0
    elif spoil == "masked":
        other[: size // 2] = np.nan
    else:
        other[:] = np.nan
    found = match(one, other)
    result = trust(found, one, other)
    assert result.alarm
    assert result.probability < 0.5
    if spoil != "masked":
        assert found.quality == 0
        assert result.evidence == NOTHING
        assert result.radius_px == np.inf


def test_a_constant_middle_is_no_evidence(rng):
    one = rng.standard_normal((128, 128))
    other = one.copy()
    other[20:108, 20:108] = 0
    assert trust(match(one, other), one, other).alarm


def test_bad_images_are_named(rng):
    image = rng.standard_normal((32, 32))
    found = match(image, image)
    with pytest.raises(InputError, match="moving has 3 dimensions"):
        trust(found, image, image[None])


def test_scale_and_reversal_of_a_picture_change_nothing(site):
    one, other, _ = trials(site, 45, n=1)[0]
    plain = trust(match(one, other), one, other)
    for changed in (1e9 * other.astype(np.float64), 7 - other):
        again = trust(match(one, changed), one, changed)
        assert again.alarm == plain.alarm
        assert again.evidence.share == pytest.approx(plain.evidence.share, rel=0.02)


def test_the_rival_is_the_second_peak_elsewhere():
    values = np.zeros((21, 21))
    values[5, 5], values[5, 7], values[15, 12] = 4, 3.9, 3
    assert rival_of(Surface(values, (0.0, 0.0))) == pytest.approx(3 / 4)
    assert rival_of(Surface(values, (0.0, 0.0), 2)) == pytest.approx(3.9 / 4)
    assert rival_of(Surface(np.zeros((1, 1)), (0.0, 0.0))) == 1


def test_every_measure_prefers_a_perfect_match_to_unrelated_noise(rng):
    one, other = rng.standard_normal((2, 64, 64))
    names = tuple(n for n in MEASURES if n not in absent(tuple(MEASURES)))
    perfect = measured(prepare(one), prepare(one), np.zeros(2), names)
    chance = measured(prepare(one), prepare(other), np.zeros(2), names)
    assert len(names) >= 6
    for name in names:
        assert perfect[name] > chance[name], name
    assert perfect["peak height"] == pytest.approx(1, abs=1e-3)
    assert perfect["plane-fit residual"] == pytest.approx(0, abs=1e-2)


def test_crops_show_the_same_ground(rng):
    ground = rng.standard_normal((60, 60))
    one, other = prepare(ground[5:45, 8:48]), prepare(ground[9:49, 2:42])
    crops = Crops(one, other, np.array([4.2, -6.3]))
    np.testing.assert_array_equal(crops.one, crops.other)
    assert crops.one.shape == (36, 34)


def test_a_peer_that_is_not_there_is_reported(monkeypatch):
    monkeypatch.setattr("pcnav_study.quality.measures.PEERS", {"OpenCV response": "no_such_peer"})
    assert "no_such_peer" in absent(("OpenCV response", "peak height"))["OpenCV response"]
    assert "peak height" not in absent(("peak height",))


def test_cases_carry_the_truth(site):
    plan = Plan(64, (0.0, 90.0, 180.0), 3, 8)
    found = list(cases(site, plan))
    kinds = {case.kind for case in found}
    assert {"match", "beside", "off_route", *HARD} <= kinds
    for case in found:
        if case.kind in ("off_route", "flat", "vignette", "water"):
            assert case.error_px == np.inf
        if case.kind == "beside":
            assert 1 <= case.error_px <= 5
    again = list(cases(site, plan))
    assert [c.error_px for c in again] == [c.error_px for c in found]


def test_rows_hold_what_the_calibration_says_and_mistakes_their_pictures(site):
    from pcnav_study.quality import frozen

    rows, mistakes = collect(site, "here", Plan(64, (0.0, 135.0), 3, 9), frozen())
    assert {"alarm", "probability", "radius_px", "kind", "site"} <= rows[0].keys()
    wrong = [r for r in rows if r["alarm"] == (r["error_px"] <= 1)]
    assert bool(wrong) == bool(mistakes)
    made = [
        rows[k] | {"reference": np.zeros((64, 64)), "moving": np.ones((64, 64))} for k in (0, 1, 3)
    ]
    pictures = stacked(made, 2)
    assert pictures.sizes == {"case": 2, "row": 64, "col": 64}
    assert len(set(pictures["kind"].values)) == 2
    assert stacked([], 5).sizes["case"] == 0


def test_the_halves_of_a_relief_do_not_meet():
    elevation = jacksboro().values
    west, east = (site_of(n, elevation, (90.0, 70.0)) for n in ("west", "east"))
    assert west.elevation.shape[1] + east.elevation.shape[1] < elevation.shape[1]
    np.testing.assert_array_equal(west.elevation[:, 0], elevation[:, 0])
    np.testing.assert_array_equal(east.elevation[:, -1], elevation[:, -1])
    with pytest.raises(InputError, match="site 'north' is unknown"):
        site_of("north", elevation, (90.0, 70.0))
