"""Rotation and scale against images resampled by a known amount, blind to the sun."""

import numpy as np
import pytest
from scipy import ndimage

from pcnav_study.matching import match, rotation_scale
from pcnav_study.matching.rotation_scale import rotated_scaled


def turned(image, angle, scale, size=128):
    """What a camera turned and nearer or farther sees of the middle of an image."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    rows, cols = np.indices((size, size)) - (size - 1) / 2
    middle = (np.array(image.shape) - 1) / 2
    at = [
        middle[0] + (cos * rows + sin * cols) * scale,
        middle[1] + (cos * cols - sin * rows) * scale,
    ]
    return ndimage.map_coordinates(image, at, order=3)


@pytest.mark.parametrize("difference", [0, 90, 180])
@pytest.mark.parametrize(("angle", "scale"), [(17.0, 0.83), (-12.3, 1.21)])
def test_recovers_rotation_and_scale(angle, scale, difference, make_pair):
    pair = make_pair((0.0, 0.0), (40.0, 40.0 + difference), size=190)
    reference = pair.reference[31:-31, 31:-31]
    moving = turned(pair.moving, angle, scale)
    found = rotation_scale(reference, moving)
    assert abs(found.angle - angle) < 0.3
    assert abs(found.scale / scale - 1) < 0.01
    upright = rotated_scaled(moving, found.angle, found.scale)
    assert np.hypot(*match(reference, upright).shift) < 0.5


def test_image_turned_by_nothing_is_itself(make_pair):
    image = make_pair().reference
    np.testing.assert_allclose(rotated_scaled(image, 0.0, 1.0), image, atol=1e-5)
    found = rotation_scale(image, np.zeros_like(image))
    assert tuple(found) == (0.0, 1.0, 0.0)
