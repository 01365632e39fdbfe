"""No sun breaks the default; the plain peak breaks as the sign pattern says."""

import numpy as np
import pytest

from pcnav_study.matching import match
from pcnav_study.matching.overlap import SECTORS, band_of, light_patterns, overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.phase import Search, _sun_pattern, cross_power, phase_correlation
from pcnav_study.matching.sectors import pattern_bank
from pcnav_study.matching.windows import prepare
from pcnav_study.scene import SunPosition, fractal_relief
from pcnav_study.scene.trials import Conditions, Site


@pytest.mark.parametrize("difference", range(0, 181, 15))
@pytest.mark.parametrize("size", [64, 128])
def test_every_azimuth_difference(difference, size, make_pair):
    pair = make_pair((6.4, -3.7), (33.0, 33.0 + difference), size, noise=0.05)
    found = match(pair.reference, pair.moving)
    assert np.hypot(*(found.shift - pair.shift)) < 0.25
    assert found.quality > 0.4


@pytest.mark.parametrize("seed", [3, 8, 9])
def test_a_flipped_sector_does_not_pull_the_summit_half_a_wave_aside(seed):
    """Half a wave, some 2 px, beside the true shift every sector is positive."""
    heights = fractal_relief((300, 300), (30.0, 30.0), np.random.default_rng(seed))
    site = Site(heights, (30.0, 30.0), seed=seed + 100)
    suns = SunPosition(120.0, 45.0), SunPosition(270.0, 45.0)
    trials = site.draw(Conditions(*suns, albedo_contrast=0.3), 128, 12, np.random.default_rng(1))
    for reference, moving, shift in zip(trials.reference, trials.moving, trials.shift, strict=True):
        assert np.hypot(*(match(reference, moving).shift - shift)) < 1


def test_plain_peak_turns_negative_with_the_sun_and_vanishes_between(make_pair):
    """On gentle relief, where shading is linear, the height is 1 - 2 difference / 180."""
    heights = []
    for difference in (0, 90, 180):
        suns = (33.0, 33.0 + difference)
        pair = make_pair((6.0, -3.0), suns, noise=0.0, slope=2.0, zenith=60.0)
        surface = match(pair.reference, pair.moving, "pc").surface
        heights.append(surface.values[surface.at(pair.shift)])
    assert heights[0] > 0.5
    assert abs(heights[1]) < 0.1
    assert heights[2] < -0.2


def test_absolute_peak_finds_the_opposite_sun(make_pair):
    pair = make_pair((6.0, -3.0), (33.0, 213.0))
    assert np.hypot(*(match(pair.reference, pair.moving, "pc-abs").shift - pair.shift)) < 0.5
    assert np.hypot(*(match(pair.reference, pair.moving, "pc").shift - pair.shift)) > 1


@pytest.mark.parametrize("difference", [60, 90, 120, 180])
def test_known_suns_repair_the_signed_peak(difference, make_pair):
    pair = make_pair((6.0, -3.0), (33.0, 33.0 + difference))
    found = match(pair.reference, pair.moving, "pc-solar", sun=pair.sun)
    assert np.hypot(*(found.shift - pair.shift)) < 0.25


@pytest.mark.parametrize("difference", [60, 90, 150])
def test_sun_pattern_is_the_sign_of_the_measured_spectrum(difference, make_pair):
    """Gentle relief is linear: nearly every low coefficient has the predicted sign."""
    pair = make_pair((0.0, 0.0), (20.0, 20.0 + difference), noise=0.0, slope=2.0, zenith=60.0)
    task = Pair(prepare(pair.reference), prepare(pair.moving), (1.0, 1.0))
    search = Search((128, 128), 1, (0, 0), (3, 3))
    measured = np.sign(cross_power(task, search, ("tukey", 0.25)).real)
    suns = (pair.sun[0].azimuth, pair.sun[1].azimuth)
    predicted = np.sign(_sun_pattern((128, 128), suns, (1.0, 1.0)))
    low = pattern_bank((128, 128), 1)[0] > 0.5
    assert np.mean((measured == predicted)[low]) > 0.85


def test_sectors_part_the_spectrum():
    bank = band_of((96, 128)).bank
    assert bank.shape[0] == SECTORS
    assert np.all((bank > 0).sum(axis=0) <= 1)
    assert bank.sum() == pytest.approx(1, abs=1e-5)


@pytest.mark.parametrize("azimuths", [(0.0, 0.0), (20.0, 75.0), (200.0, 310.0), (45.0, 225.0)])
def test_light_patterns_make_up_the_light_of_any_two_suns(azimuths):
    rows, cols = np.meshgrid(np.linspace(-0.3, 0.3, 13), np.linspace(0.01, 0.3, 9), indexing="ij")
    bearing = np.arctan2(cols, -rows)
    one, other = (np.cos(bearing - np.radians(azimuth)) for azimuth in azimuths)
    patterns = light_patterns(rows, cols).reshape(3, -1)
    shares = np.linalg.lstsq(patterns.T, (one * other).ravel(), rcond=None)[0]
    np.testing.assert_allclose(shares @ patterns, (one * other).ravel(), atol=1e-12)


def test_sectors_flip_where_two_suns_disagree(make_pair):
    pair = make_pair((3.0, 4.0), (0.0, 90.0))
    task = Pair(prepare(pair.reference), prepare(pair.moving), (20.0, 20.0))
    overlap = overlap_of(task, pair.shift)
    assert overlap is not None
    signs = np.sign(overlap.sector_sums(np.zeros(2)))
    # cos(bearing) cos(bearing - 90): positive for bearings of the north-east quarter, whose
    # row frequency is negative while its column frequency is positive.
    assert np.all(signs[: SECTORS // 2] < 0)
    assert np.all(signs[SECTORS // 2 :] > 0)


def test_unrelated_windows_have_a_low_quality(make_pair):
    related = make_pair((3.2, 4.1), (20.0, 110.0))
    other = make_pair((3.2, 4.1), (20.0, 110.0), seed=502)
    high = match(related.reference, related.moving).quality
    low = match(related.reference, other.moving).quality
    assert high > 0.5 > 0.35 > low


def test_phase_correlation_of_a_circular_shift_is_a_delta():
    image = np.random.default_rng(4).standard_normal((64, 64))
    pair = Pair(prepare(image), prepare(image), (16.0, 16.0))
    surface = phase_correlation(pair).surface
    assert surface.values[16, 16] == pytest.approx(1, abs=1e-5)
    assert np.abs(np.delete(surface.values.ravel(), 16 * 33 + 16)).max() < 1e-5
