"""Estimators against phasors written down, and against heights moved by a known part."""

import numpy as np
import pytest

from pcnav_study.matching import ESTIMATORS, match
from pcnav_study.matching.overlap import Overlap, band_of
from pcnav_study.matching.surface import quadratic_peak


@pytest.mark.parametrize("name", ESTIMATORS)
@pytest.mark.parametrize("truth", [(0.37, -0.21), (-0.49, 0.03), (0.0, 0.0)])
def test_estimators_read_a_phase_plane(name, truth):
    band = band_of((96, 112))
    phase = truth[0] * band.omega_rows[:, None] + truth[1] * band.omega_cols
    overlap = Overlap(np.exp(-1j * phase).astype(np.complex64), band, np.zeros(2))
    weight = band.bank.sum(axis=0)
    found = ESTIMATORS[name](overlap, weight, np.zeros(2))
    np.testing.assert_allclose(found, truth, atol=0.0051 if name == "upsampled-dft" else 1e-3)


@pytest.mark.parametrize("name", ESTIMATORS)
def test_estimators_read_through_flipped_sectors(name):
    band = band_of((96, 96))
    signs = np.array([1, 1, -1, -1, -1, 1, 1, 1], np.float32)
    weight = np.tensordot(signs, band.bank, 1)
    phase = 0.3 * band.omega_rows[:, None] - 0.2 * band.omega_cols
    phasors = np.exp(-1j * phase) * np.where(weight < 0, -1, 1)
    overlap = Overlap(phasors.astype(np.complex64), band, np.zeros(2))
    found = ESTIMATORS[name](overlap, weight, np.zeros(2))
    np.testing.assert_allclose(found, (0.3, -0.2), atol=0.0051)


@pytest.mark.parametrize(("difference", "limit"), [(0, 0.015), (90, 0.05), (180, 0.05)])
def test_radial_error_on_moderate_slopes(difference, limit, make_pair):
    errors = []
    for seed in range(600, 606):
        pair = make_pair((7.4, -4.7), (40.0, 40.0 + difference), seed=seed)
        errors.append(match(pair.reference, pair.moving).shift - pair.shift)
    assert np.sqrt(np.mean(np.sum(np.square(errors), axis=1))) < limit


def test_quadratic_peak_reads_a_diagonal_ridge():
    rows, cols = np.indices((5, 5)) - 2.0
    u, v = rows - 0.3, cols + 0.2
    values = 1 - (u * u + v * v - 1.6 * u * v)
    np.testing.assert_allclose(quadratic_peak(values, (2, 2)), (0.3, -0.2), atol=1e-9)


def test_quadratic_peak_stays_put_without_a_summit():
    assert quadratic_peak(np.zeros((5, 5)), (2, 2)) == (0.0, 0.0)
    assert quadratic_peak(np.eye(5), (0, 0)) == (0.0, 0.0)
