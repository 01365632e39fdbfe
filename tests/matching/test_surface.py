"""Peaks of a match surface: best first, apart from one another, and high enough."""

import numpy as np
import pytest

from pcnav_study.matching.surface import Surface


@pytest.fixture
def surface():
    values = np.zeros((12, 14))
    values[2, 3], values[2, 5], values[8, 4], values[7, 11] = 10.0, 9.0, 7.0, 4.0
    return Surface(values - 1, (0.0, 0.0))


def test_peaks_come_best_first_and_skip_their_own_slopes(surface):
    assert surface.peaks(3) == [(2, 3), (8, 4), (7, 11)]


def test_one_peak_is_the_peak(surface):
    assert surface.peaks(1) == [surface.peak()]


def test_share_leaves_out_what_is_too_low(surface):
    assert surface.peaks(4, 0.6) == [(2, 3), (8, 4)]
    assert surface.peaks(4, 0.9) == [(2, 3)]


def test_negative_scores_count_without_a_share(surface):
    assert len(surface.peaks(4)) == 4


def test_a_flat_surface_has_no_more_peaks_than_places():
    assert len(Surface(np.zeros((3, 3)), (0.0, 0.0)).peaks(4)) == 1
