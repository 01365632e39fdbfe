"""Fast template methods against themselves window pair by window pair, and scikit-image."""

import numpy as np
import pytest
from skimage.feature import match_template

from pcnav_study.matching.mutual_information import mutual_information, quantised
from pcnav_study.matching.ncc import normalised_cross_correlation
from pcnav_study.matching.pair import Pair, reach_of
from pcnav_study.matching.roaming import information, roaming_mi, roaming_ncc, roaming_ssd
from pcnav_study.matching.ssd import squared_differences
from pcnav_study.matching.template import Roaming
from pcnav_study.matching.windows import prepare

METHODS = [
    (normalised_cross_correlation, roaming_ncc, 2e-5),
    (squared_differences, roaming_ssd, 1e-9),
    (mutual_information, roaming_mi, 1e-9),
]


def task(reference, moving):
    one, other = prepare(reference), prepare(moving)
    return Pair(one, other, reach_of(one, other, None))


def images(missing, shape=(44, 37)):
    rng = np.random.default_rng(12)
    reference = rng.standard_normal(shape).cumsum(axis=1) + 40
    moving = reference[2:41, 3:35] + 0.3 * rng.standard_normal((39, 32))
    if missing:
        reference[3:12, 5:14] = np.nan
        moving[15:20, 12:22] = np.nan
    return reference, moving


@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize(("fast", "slow", "tolerance"), METHODS)
def test_fast_form_equals_brute_force(fast, slow, tolerance, missing):
    pair = task(*images(missing))
    one, other = fast(pair).surface, slow(pair).surface
    assert one.origin == other.origin
    np.testing.assert_allclose(one.values, other.values, atol=tolerance)


def test_brute_force_ncc_equals_scikit_image():
    pair = task(*images(missing=False))
    template = pair.moving.values[Roaming(pair).cut]
    theirs = match_template(pair.reference.values, template)
    np.testing.assert_allclose(roaming_ncc(pair).surface.values, theirs, atol=1e-9)


def test_information_of_an_image_with_itself_is_its_entropy():
    level = quantised(np.random.default_rng(3).random((20, 20)), 8)
    share = np.bincount(level.ravel()) / level.size
    assert information(level, level, 8) == pytest.approx(-(share * np.log(share)).sum())
    assert information(level, np.zeros_like(level), 8) == pytest.approx(0)


def test_quantised_covers_all_levels_and_marks_the_missing():
    image = np.linspace(-3, 5, 64).reshape(8, 8)
    assert set(np.unique(quantised(image, 16))) == set(range(16))
    image[0, 0] = np.nan
    assert quantised(image, 16)[0, 0] == -1


def test_flat_part_of_the_reference_scores_zero():
    reference, moving = images(missing=False)
    reference[:, :34] = 40.0
    score = normalised_cross_correlation(task(reference, moving)).surface.values
    assert np.abs(score[:, 0]).max() == 0
