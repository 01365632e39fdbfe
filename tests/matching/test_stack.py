"""The batched form is the single one, many times."""

import numpy as np
import pytest

from pcnav_study.errors import InputError
from pcnav_study.matching import match, match_stack


def test_stack_equals_single_matches(make_pair):
    pairs = [make_pair((k, -k), size=64) for k in (1.0, 4.5)]
    references, movings = (np.stack(side) for side in zip(*(p[:2] for p in pairs), strict=True))
    found = match_stack(references, movings)
    for k, pair in enumerate(pairs):
        single = match(pair.reference, pair.moving)
        np.testing.assert_array_equal(found.shifts[k], single.shift)
        assert found.qualities[k] == single.quality
    one = match_stack(references[0], movings)
    np.testing.assert_array_equal(one.shifts[0], found.shifts[0])


def test_stack_of_another_length_is_named():
    images = np.random.default_rng(0).standard_normal((3, 32, 32))
    with pytest.raises(InputError, match="2 references"):
        match_stack(images[:2], images)
