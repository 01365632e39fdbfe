"""What every method owes its caller: the sign, the sizes, the types, the bad input."""

import pickle
import warnings

import numpy as np
import pytest
from skimage.registration import phase_cross_correlation

from pcnav_study.errors import InputError
from pcnav_study.matching import ESTIMATORS, METHODS, match, prepare

every_method = pytest.mark.parametrize("method", METHODS)


@every_method
def test_shift_has_the_sign_of_scikit_image(method, make_pair):
    pair = make_pair()
    theirs = phase_cross_correlation(pair.reference, pair.moving, normalization=None)[0]
    assert np.abs(theirs - pair.shift).max() <= 1
    result = match(pair.reference, pair.moving, method)
    assert np.abs(result.shift - pair.shift).max() < 0.6
    assert 0.3 < result.quality <= 1


@every_method
def test_shift_applied_to_the_moving_image_gives_the_reference(method, make_pair):
    pair = make_pair(shift=(4.0, -9.0), noise=0.0)
    found = match(pair.reference, pair.moving, method).shift
    moved = np.roll(pair.moving, np.rint(found).astype(int), (0, 1))
    np.testing.assert_allclose(moved[20:-20, 20:-20], pair.reference[20:-20, 20:-20], atol=1e-9)


@every_method
@pytest.mark.parametrize(("rows", "cols"), [(97, 128), (128, 75), (101, 101)])
def test_odd_and_non_square_windows(method, rows, cols, make_pair):
    pair = make_pair()
    found = match(pair.reference[:rows, :cols], pair.moving[:rows, :cols], method)
    assert np.abs(found.shift - pair.shift).max() < 0.6


@every_method
@pytest.mark.parametrize(("top", "left", "rows", "cols"), [(30, 22, 64, 64), (20, 41, 75, 60)])
def test_larger_reference_measures_between_centres(method, top, left, rows, cols, make_pair):
    pair = make_pair(shift=(0.0, 0.0))
    moving = pair.moving[top : top + rows, left : left + cols]
    expected = np.array([top + rows / 2 - 64, left + cols / 2 - 64])
    found = match(pair.reference, moving, method)
    assert np.abs(found.shift - expected).max() < 0.6


@every_method
@pytest.mark.parametrize("dtype", ["uint8", "int16", "uint16", "int32", "float16", ">f4", ">f8"])
def test_any_real_type(method, dtype, make_pair):
    pair = make_pair()
    one, other = ((200 * image).astype(dtype) for image in (pair.reference, pair.moving))
    assert np.abs(match(one, other, method).shift - pair.shift).max() < 0.6


@every_method
@pytest.mark.parametrize(("gain", "offset"), [(1e-20, 0.0), (1e20, 0.0), (1.0, 3e4)])
def test_units_do_not_matter(method, gain, offset, make_pair):
    pair = make_pair()
    plain = match(pair.reference, pair.moving, method).shift
    other = match(gain * pair.reference + offset, gain * pair.moving + offset, method).shift
    np.testing.assert_allclose(other, plain, atol=0.01)


@every_method
def test_inputs_are_not_written_to(method, make_pair):
    pair = make_pair()
    one, other = pair.reference.astype(np.float32), pair.moving.astype(np.float32)
    one[:9, :30] = np.nan
    copies = one.copy(), other.copy()
    one.flags.writeable = other.flags.writeable = False
    match(one, other, method)
    np.testing.assert_array_equal(one, copies[0])
    np.testing.assert_array_equal(other, copies[1])


@every_method
def test_missing_corners_do_not_pull_to_zero(method, make_pair):
    pair = make_pair(noise=0.05)
    one, other = pair.reference.copy(), pair.moving.copy()
    rows, cols = np.indices(one.shape)
    for image in (one, other):
        image[np.abs(rows - 63.5) + np.abs(cols - 63.5) > 88] = np.nan
    assert np.abs(match(one, other, method).shift - pair.shift).max() < 0.6


@every_method
def test_masked_array_is_missing_data(method, make_pair):
    pair = make_pair()
    hidden = np.zeros(pair.moving.shape, bool)
    hidden[:20, :50] = True
    spoilt = np.where(hidden, 1e6, pair.moving)
    found = match(pair.reference, np.ma.MaskedArray(spoilt, hidden), method)
    assert np.abs(found.shift - pair.shift).max() < 0.6


@every_method
@pytest.mark.parametrize("empty", [np.zeros((64, 64)), np.full((64, 64), np.nan)])
def test_empty_image_has_no_quality_and_no_shift(method, empty):
    texture = np.random.default_rng(0).standard_normal((64, 64))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for one, other in ((empty, texture), (texture, empty), (empty, empty)):
            result = match(one, other, method)
            assert result.quality == 0
            np.testing.assert_array_equal(result.shift, 0)


@every_method
def test_barely_any_texture_stays_finite(method):
    texture = np.random.default_rng(0).standard_normal((64, 64))
    poor = np.zeros((64, 64))
    poor[5, 7] = 1
    holed = np.full((64, 64), np.nan)
    holed[30:34, 30:34] = texture[30:34, 30:34]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for other in (poor, holed, np.tile(texture[0], (64, 1))):
            for one in (texture, other):
                result = match(one, other, method)
                assert np.isfinite(result.shift).all()
                assert 0 <= result.quality <= 1


GOOD = np.random.default_rng(0).standard_normal((32, 32))


@every_method
@pytest.mark.parametrize(
    ("one", "other", "says"),
    [
        (GOOD, GOOD + 1j, "complex"),
        (GOOD, GOOD[0], "dimensions"),
        (GOOD, GOOD[None], "dimensions"),
        (np.where(GOOD > 2, np.inf, GOOD), GOOD, "infinities"),
        (GOOD[:20], GOOD, "smaller"),
        (GOOD[:5, :5], GOOD[:5, :5], "too small"),
        (GOOD.astype(str), GOOD, "numbers"),
    ],
)
def test_bad_images_are_named(method, one, other, says):
    with pytest.raises(InputError, match=says):
        match(one, other, method)


@every_method
@pytest.mark.parametrize("max_shift", [0, -3, np.nan, 17, np.inf])
def test_impossible_max_shift_is_named(method, max_shift):
    with pytest.raises(InputError, match="max_shift"):
        match(GOOD, GOOD, method, max_shift=max_shift)


def test_unknown_names_list_the_known():
    with pytest.raises(InputError, match="pc-sectors"):
        match(GOOD, GOOD, "magic")
    with pytest.raises(InputError, match="plane-fit"):
        match(GOOD, GOOD, subpixel="magic")


@every_method
def test_max_shift_bounds_the_surface(method, make_pair):
    pair = make_pair()
    surface = match(pair.reference, pair.moving, method, max_shift=12).surface
    last = surface.origin + surface.step * (np.array(surface.values.shape) - 1)
    assert np.abs(surface.origin).max() <= 12 + 2 * surface.step
    assert np.abs(last).max() <= 12 + 2 * surface.step


@every_method
def test_prepared_reference_is_the_same_and_keeps_its_spectrum(method, make_pair):
    pair = make_pair()
    reference = prepare(pair.reference)
    plain = match(pair.reference, pair.moving, method)
    for _ in range(2):
        again = match(reference, pair.moving, method)
        np.testing.assert_array_equal(again.shift, plain.shift)
        assert again.quality == plain.quality


@pytest.mark.parametrize("subpixel", ESTIMATORS)
@pytest.mark.parametrize("method", ["pc", "ncc", "mi"])
def test_any_method_takes_any_estimator(method, subpixel, make_pair):
    pair = make_pair()
    found = match(pair.reference, pair.moving, method, subpixel=subpixel)
    assert np.hypot(*(found.shift - pair.shift)) < 0.03


def test_result_pickles_without_the_images(make_pair):
    pair = make_pair()
    result = match(pair.reference, pair.moving, "ncc")
    packed = pickle.dumps(result)
    again = pickle.loads(packed)
    np.testing.assert_array_equal(again.shift, result.shift)
    assert again.quality == result.quality
    assert len(packed) < pair.reference.nbytes
