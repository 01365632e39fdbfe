"""Reflectance that belongs to the ground and not to the light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.scene.relief import power_law_field


def fractal_albedo(
    shape: tuple[int, int], contrast: float, rng: np.random.Generator, *, exponent: float = 1.2
) -> NDArray[np.float64]:
    """Reflectance of mean 1 and standard deviation ``contrast``, never negative.

    The amplitude spectrum of natural texture falls about as f**-1.2 [1]_.

    References
    ----------
    .. [1] Field (1987), JOSA A 4(12), 2379-2394.
    """
    if not 0 <= contrast < 1:
        raise InputError(f"albedo contrast {contrast} is not within 0 and 1 (0.1 means 10 %)")
    if contrast == 0:
        return np.ones(shape)
    return np.clip(1.0 + contrast * power_law_field(shape, exponent, rng), 0.0, None)
