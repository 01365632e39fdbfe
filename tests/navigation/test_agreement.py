"""Parts of a frame agree at the true place, and not at a false one."""

import numpy as np
import pytest
from scipy import ndimage

from pcnav_study.navigation import agreement


@pytest.fixture
def area():
    noise = np.random.default_rng(5).normal(size=(180, 180))
    return ndimage.gaussian_filter(noise, 1.5).astype(np.float32)


@pytest.mark.parametrize("method", ["pc-sectors", "ncc"])
def test_all_parts_agree_at_the_true_place(area, method):
    moving = area[26 : 26 + 128, 26 + 3 : 26 + 3 + 128]
    found = agreement(area, moving, np.array([0.0, 3.0]), method)
    assert found.share == 1.0
    np.testing.assert_allclose(found.shift, [0, 3], atol=0.3)


def test_few_parts_agree_on_another_place(area):
    shares = []
    for seed in range(12):
        other = ndimage.gaussian_filter(
            np.random.default_rng(100 + seed).normal(size=(128, 128)), 1.5
        )
        shares.append(agreement(area, other, np.zeros(2), "pc-sectors").share)
    assert np.mean(np.array(shares) >= 0.5) <= 0.17


def test_one_spoilt_corner_does_not_move_the_median(area):
    moving = area[26:154, 26:154].copy()
    moving[:50, :50] = np.roll(moving[:50, :50], 9, axis=1)
    found = agreement(area, moving, np.zeros(2), "pc-sectors")
    assert 0.5 <= found.share <= 1.0
    assert np.abs(found.shift).max() < 0.3


def test_a_patch_too_small_to_be_cut_keeps_its_shift(area):
    found = agreement(area[:24, :24], area[4:20, 4:20], np.array([1.0, 2.0]), "pc-sectors")
    np.testing.assert_array_equal(found.shift, [1.0, 2.0]) if found.share == 0 else None
    assert 0.0 <= found.share <= 1.0
