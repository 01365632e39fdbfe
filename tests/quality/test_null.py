"""The null of the sectors' quality: theory against simulation."""

import numpy as np
import pytest

from pcnav_study.matching import match, prepare
from pcnav_study.matching.overlap import overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.refine import delta_quality
from pcnav_study.matching.spectrum import taper
from pcnav_study.quality import null_tail, sector_null_level, unrelated_level
from pcnav_study.quality.null import (
    crowding,
    density,
    expected_null,
    phasor_correlation,
    sector_spread,
)

STILL = np.zeros(2)


def unrelated(rng, shape, n):
    """Sector surfaces (n, sectors) and qualities (n,) of unrelated windows at one shift."""
    sums, qualities = [], []
    for _ in range(n):
        one, other = (prepare(rng.standard_normal(shape)) for _ in range(2))
        overlap = overlap_of(Pair(one, other, (4.0, 4.0)), STILL)
        sums.append(overlap.sector_sums(STILL))
        qualities.append(delta_quality(overlap, STILL))
    return np.array(sums), np.array(qualities)


@pytest.mark.parametrize("shape", [(32, 32), (64, 48), (96, 96)])
def test_the_spread_and_the_level_are_those_of_simulated_windows(rng, shape):
    sums, qualities = unrelated(rng, shape, 500)
    np.testing.assert_allclose(sums.std(axis=0), sector_spread(shape), rtol=0.15)
    assert np.mean(sums.std(axis=0) / sector_spread(shape)) == pytest.approx(1, abs=0.05)
    assert qualities.mean() == pytest.approx(expected_null(shape), rel=0.04)
    for rate in (0.05, 0.2):
        above = np.mean(qualities > sector_null_level(shape, false_match_rate=rate))
        assert above == pytest.approx(rate, abs=4 * np.sqrt(rate / 500))


@pytest.mark.parametrize("rho", [0.0, 0.3, 0.7, 0.95, 1.0])
def test_phasors_of_correlated_normals_correlate_as_in_theory(rng, rho):
    one, new = (rng.standard_normal((2, 40_000, 2)) @ [1, 1j]).reshape(2, -1)
    other = rho * one + np.sqrt(1 - rho**2) * new
    measured = np.mean(one / np.abs(one) * np.conj(other / np.abs(other))).real
    assert phasor_correlation(rho) == pytest.approx(measured, abs=0.015)


@pytest.mark.parametrize("size", [48, 96])
def test_the_best_shift_of_unrelated_windows_stays_below_the_level(rng, size):
    found = [match(*rng.standard_normal((2, size, size))).quality for _ in range(150)]
    level = unrelated_level("pc-sectors", (size, size), false_match_rate=0.05)
    assert np.mean(np.array(found) > level) < 0.05 + 2 * np.sqrt(0.05 / 150)
    assert level < 1.6 * np.quantile(found, 0.95), "a bound, but a useful one"


def test_the_best_shift_of_plain_correlation_stays_below_its_own_level(rng):
    found = [match(*rng.standard_normal((2, 64, 64)), "pc").quality for _ in range(200)]
    level = unrelated_level("pc", (64, 64), false_match_rate=0.05)
    assert np.mean(np.array(found) > level) < 0.05 + 2 * np.sqrt(0.05 / 200)
    assert level < 1.4 * np.quantile(found, 0.95), "a bound, but a useful one"


def test_tail_and_level_are_each_others_inverse():
    for rate in (0.5, 0.05, 1e-4):
        level = sector_null_level((64, 64), 100, false_match_rate=rate)
        assert null_tail(level, (64, 64), 100) == pytest.approx(rate, rel=0.02)
    assert null_tail(0.0, (64, 64)) == pytest.approx(1)


def test_the_density_has_unit_area_and_the_expected_mean():
    values, height = density((64, 64))
    assert np.trapezoid(height, values) == pytest.approx(1, abs=0.01)
    assert np.trapezoid(height * values, values) == pytest.approx(expected_null((64, 64)), rel=0.01)


@pytest.mark.parametrize("kind", ["hann", ("tukey", 0.25)])
def test_the_middle_of_an_unrelated_surface_is_as_crowded_as_in_theory(rng, kind):
    weight = taper((48, 48), kind)
    spectra = np.fft.fft2(rng.standard_normal((1200, 2, 48, 48)) * weight)
    product = spectra[:, 0] * spectra[:, 1].conj()
    middle = (product / np.abs(product)).real.mean(axis=(1, 2))
    measured = np.mean(middle**2) * 48 * 48
    assert crowding((48, 48), kind) == pytest.approx(measured, rel=0.15)
