"""A small relief to fly over, quick to render."""

import numpy as np
import pytest

from pcnav_study.navigation.loop import Instruments, Route, Setup, mission, place
from pcnav_study.navigation.loop.world import Air
from pcnav_study.scene import Grid, SunPosition, fractal_relief

PIXEL = 30.0
GRID = Grid.centred(400_000.0, 3_800_000.0, (PIXEL, PIXEL), (300, 320), "EPSG:32611")
SUNS = (SunPosition(100, 50), SunPosition(190, 45))
EXACT = Instruments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.fixture(scope="session")
def relief():
    heights = fractal_relief(GRID.shape, (PIXEL, PIXEL), np.random.default_rng(77))
    return GRID.image(heights.astype(np.float32), "elevation")


@pytest.fixture(scope="session")
def flight(relief):
    """Missions over the relief; ``calm`` ones have neither wind nor errors."""

    def make(*, calm=False, seed=1, gust=0.0, suns=SUNS, route=None, **changes):
        perfect = {
            "wind": 0.0, "turbulence": 0.0, "attitude_sigma": 0.0, "start_sigma_px": 0.0,
            "noise": 0.0, "instruments": EXACT,
        }  # fmt: skip
        given = {"frame_px": 80.0, "camera_px": 80, "legs": 5, "leg_px": 14.0}
        setup = Setup(**(given | (perfect if calm else {}) | changes))
        where = place(relief, *suns, setup, 3)
        return mission(where, setup, seed, None if route is None else Route(route), gust)

    return make


@pytest.fixture
def still_air():
    return Air()
