"""Window pairs whose shift is known because it was put into the heights, before the light."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from scipy import fft, ndimage

from pcnav_study.scene import SunPosition, fractal_relief, shade


class KnownPair(NamedTuple):
    reference: np.ndarray
    moving: np.ndarray
    shift: np.ndarray
    sun: tuple[SunPosition, SunPosition]


MakePair = Callable[..., KnownPair]


@pytest.fixture(scope="session")
def make_pair() -> MakePair:
    """Two windows of one relief under two suns; the rims show different ground."""

    def make(
        shift: tuple[float, float] = (5.3, -7.6),
        azimuths: tuple[float, float] = (20.0, 20.0),
        size: int = 128,
        noise: float = 0.01,
        seed: int = 501,
        slope: float = 15.0,
        zenith: float = 45.0,
    ) -> KnownPair:
        rng = np.random.default_rng(seed)
        heights = fractal_relief((256, 256), (30.0, 30.0), rng, median_slope=slope)
        moved = fft.ifft2(ndimage.fourier_shift(fft.fft2(heights), np.negative(shift))).real
        suns = (SunPosition(azimuths[0], zenith), SunPosition(azimuths[1], zenith))
        images = []
        for relief, sun in zip((heights, moved), suns, strict=True):
            image = shade(relief, (30.0, 30.0), sun)[60 : 60 + size, 60 : 60 + size]
            images.append(image + noise * image.std() * rng.standard_normal(image.shape))
        return KnownPair(images[0], images[1], np.array(shift), suns)

    return make
