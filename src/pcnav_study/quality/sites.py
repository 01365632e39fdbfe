"""The sites of calibration and of judgement, which never meet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.scene.relief import fractal_relief
from pcnav_study.scene.trials import Site

SHAPE = (460, 400)  # px of a fractal site
PIXEL = (30.0, 30.0)  # metres
SLOPES = (8.0, 26.0)  # degrees, the medians of fractal sites lie between


def site_of(name: str, elevation: NDArray[np.floating], pixel_size: tuple[float, float]) -> Site:
    """A site by name: ``west`` or ``east``, a half of the given relief, or a fractal's seed.

    Parameters
    ----------
    name : str
    elevation : (rows, columns)
        Metres.
    pixel_size : (dy, dx)
        Metres, of ``elevation``.
    """
    heights = np.asarray(elevation, np.float64)
    middle = heights.shape[1] // 2
    if name == "west":
        return Site(heights[:, :middle], pixel_size, seed=1)
    if name == "east":
        return Site(heights[:, middle + 1 :], pixel_size, seed=2)
    if not name.isdigit():
        raise InputError(f"site {name!r} is unknown; use west, east, or a fractal's seed")
    rng = np.random.default_rng(int(name))
    slope = float(rng.uniform(*SLOPES))
    return Site(fractal_relief(SHAPE, PIXEL, rng, median_slope=slope), PIXEL, seed=int(name))
