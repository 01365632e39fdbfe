"""The reliefs that experiments are run on."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from pcnav_study.scene.relief import fractal_relief
from pcnav_study.scene.trials import Site

PIXEL = (30.0, 30.0)  # metres, of the fractal relief
SMALLEST = 400  # px


def experiment_sites(
    names: Iterable[str],
    elevation: NDArray[np.floating],
    pixel_size: tuple[float, float],
    window_px: int,
    seed: int,
) -> dict[str, Site]:
    """Sites by name: ``map`` is the given relief, ``fractal`` a self-affine one.

    The fractal relief is large enough for windows of ``window_px``.
    """
    sites = {}
    for name in names:
        if name == "map":
            relief, pixel = np.asarray(elevation, np.float64), pixel_size
        else:
            side = max(SMALLEST, 3 * window_px // 2)
            rng = np.random.default_rng([seed, 7])
            relief, pixel = fractal_relief((side, side), PIXEL, rng), PIXEL
        sites[name] = Site(relief, pixel, seed=seed)
    return sites
