"""The Dirac-delta quality against algebra, and its null level against simulation."""

import numpy as np
import pytest
from scipy.signal import convolve2d

from pcnav_study.quality import delta_similarity, is_alarm, null_level


def random_phase_surface(rng, shape=(32, 32)):
    """Inverse transform of a spectrum of modulus 1 and random, Hermitian phases."""
    spectrum = np.fft.fft2(rng.normal(size=shape))
    return np.fft.ifft2(spectrum / np.abs(spectrum)).real


def shifted_delta(shape, shift):
    rows, cols = (np.fft.fftfreq(n)[:, None] for n in shape)
    spectrum = np.exp(-2j * np.pi * (rows * shift[0] + cols.T * shift[1]))
    return np.fft.ifft2(spectrum).real


@pytest.mark.parametrize("peak", [(0, 0), (7, 3), (15, 20), (15, 0)])
@pytest.mark.parametrize("radius", [0, 1, 2])
@pytest.mark.parametrize("scale", [1.0, -3.0, 1e-9])
def test_a_delta_is_wholly_like_a_delta(peak, radius, scale):
    surface = np.zeros((16, 21))
    surface[peak] = scale
    assert delta_similarity(surface, peak, radius=radius) == pytest.approx(1)


@pytest.mark.parametrize("radius", [0, 1])
def test_a_delta_elsewhere_is_not_alike_at_all(radius):
    surface = np.zeros((16, 21))
    surface[3, 4] = 1
    assert delta_similarity(surface, (10, 10), radius=radius) == 0


@pytest.mark.parametrize("seed", range(5))
def test_with_unit_modulus_the_similarity_is_the_height_of_the_peak(seed):
    rng = np.random.default_rng(seed)
    surface = random_phase_surface(rng, (24, 31))
    for peak in [(0, 0), (5, 30), (12, 7)]:
        assert delta_similarity(surface, peak, radius=0) == pytest.approx(
            abs(surface[peak]), rel=1e-9
        )


@pytest.mark.parametrize("seed", range(3))
def test_it_is_the_cosine_with_the_best_delta_spread_over_the_neighbourhood(seed):
    surface = np.random.default_rng(seed).normal(size=(15, 18))
    delta = np.zeros_like(surface)
    delta[5:8, 8:11] = surface[5:8, 8:11]
    cosine = (surface * delta).sum() / np.linalg.norm(surface) / np.linalg.norm(delta)
    assert delta_similarity(surface, (6, 9)) == pytest.approx(cosine)


@pytest.mark.parametrize("shift", [(5.5, 7.5), (5.25, 7.0), (5.0, 7.4)])
def test_a_shift_between_pixels_stays_nearly_a_delta(shift):
    surface = shifted_delta((33, 33), shift)
    peak = tuple(int(v) for v in np.unravel_index(surface.argmax(), surface.shape))
    assert delta_similarity(surface, peak) > 0.85
    assert delta_similarity(surface, peak) > delta_similarity(surface, peak, radius=0)


@pytest.mark.parametrize("surface", [np.zeros((5, 6)), np.full((5, 6), np.nan), np.zeros((1, 1))])
def test_an_empty_surface_has_no_quality(surface):
    assert delta_similarity(surface, (0, 0)) == 0


def test_missing_scores_count_as_zero():
    surface = np.zeros((9, 9))
    surface[4, 4] = surface[0, 0] = 1
    holed = surface.copy()
    holed[surface == 0] = np.nan
    assert delta_similarity(holed, (4, 4)) == delta_similarity(surface, (4, 4))
    assert delta_similarity(surface, (4, 4)) == pytest.approx(np.sqrt(0.5))


def best_quality(surface, radius):
    """Quality of the best neighbourhood, as an alarm must expect from unrelated windows."""
    size = 2 * radius + 1
    near = convolve2d(surface**2, np.ones((size, size)), mode="valid")
    return np.sqrt(near.max() / (surface**2).sum())


@pytest.mark.parametrize("radius", [0, 1])
@pytest.mark.parametrize("rate", [0.01, 0.1])
def test_unrelated_phases_exceed_the_null_level_no_more_often_than_stated(radius, rate):
    rng = np.random.default_rng(11)
    qualities = np.array([best_quality(random_phase_surface(rng), radius) for _ in range(1500)])
    level = null_level(1024, radius=radius, false_match_rate=rate)
    passing = (qualities > level).mean()
    assert passing <= rate + 2 * np.sqrt(rate / 1500)
    assert level < 1.25 * np.quantile(qualities, 1 - rate)


def test_the_quality_of_an_unrelated_pair_at_its_peak_raises_the_alarm():
    rng = np.random.default_rng(5)
    passed = 0
    for _ in range(300):
        surface = random_phase_surface(rng, (40, 30))
        peak = np.unravel_index(surface.argmax(), surface.shape)
        passed += not is_alarm(delta_similarity(surface, tuple(map(int, peak))), surface.size)
    assert passed <= 8


@pytest.mark.parametrize("candidates", [100, 1024, 40_000])
def test_the_null_level_falls_with_candidates_and_with_the_rate_allowed(candidates):
    level = null_level(candidates)
    assert 0 < level < 1
    assert null_level(4 * candidates) < level
    assert null_level(candidates, false_match_rate=0.1) < level
    assert null_level(candidates, false_match_rate=0.001) > level
    assert null_level(candidates, radius=0) < level


@pytest.mark.parametrize("candidates", [0, 1, 9])
def test_few_candidates_can_prove_nothing(candidates):
    assert null_level(candidates) == 1
    assert is_alarm(0.999, candidates)


@pytest.mark.parametrize("candidates", [50, 1089, 60_000])
@pytest.mark.parametrize("rate", [0.001, 0.05])
def test_the_alarm_sounds_below_the_null_level_alone(candidates, rate):
    level = null_level(candidates, false_match_rate=rate)
    assert is_alarm(level - 1e-9, candidates, false_match_rate=rate)
    assert not is_alarm(level + 1e-9, candidates, false_match_rate=rate)
