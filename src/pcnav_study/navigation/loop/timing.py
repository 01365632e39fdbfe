"""Where the time of one step goes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from pcnav_study.navigation.loop.estimators import Belief, DeadReckoning
from pcnav_study.navigation.loop.lookout import Lookout
from pcnav_study.navigation.loop.navigator import MapNavigator
from pcnav_study.navigation.loop.setup import Setup, mission, place
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.relief import fractal_relief
from pcnav_study.scene.sun import SunPosition

SIDE_PX = 1200  # of the relief flown over
PIXEL = (30.0, 30.0)  # metres
SUNS = (SunPosition(100, 50), SunPosition(190, 40))


def step_times(setup: Setup, frame_px: int, flights: int, method: str, seed: int) -> pd.DataFrame:
    """Median milliseconds of each part of an ordinary step, in this process.

    Parameters
    ----------
    frame_px : int
        Side of the frame, as wide on the ground as on the map.
    flights : int

    Returns
    -------
    DataFrame
        ``part``, ``ms``, ``share`` and ``steps``; the last row is the whole step. Medians of the
        parts need not add up to that of the whole.
    """
    shape = (SIDE_PX, SIDE_PX)
    heights = fractal_relief(shape, PIXEL, np.random.default_rng(seed)).astype(np.float32)
    grid = Grid.centred(400_000.0, 3_800_000.0, PIXEL, shape, "EPSG:32611")
    setup = replace(setup, frame_px=float(frame_px), camera_px=frame_px, legs=6)
    where = place(grid.image(heights, "elevation"), *SUNS, setup, seed)
    laps: list[dict[str, float]] = []
    for k in range(flights):
        flight = mission(where, setup, seed + k)
        lookout = Lookout(where.chart, setup.camera, method)
        reckoning = DeadReckoning(Belief(*flight.start()), setup.instruments)
        uav = MapNavigator(lookout, reckoning, flight.pilot, frame_px)
        for row in flight.fly(uav):
            if row["action"] == "fix":
                laps.append({part: 1e3 * s for part, s in lookout.seconds.items()})
                laps[-1]["whole step"] = row["ms"]
            lookout.seconds.clear()
    table = pd.DataFrame(laps).fillna(0.0)
    steps = table.pop("whole step")
    table["decide and steer"] = steps - table.sum(axis=1)
    table["whole step"] = steps
    medians = table.median().rename("ms").rename_axis("part").reset_index()
    whole = float(medians["ms"].iloc[-1])
    return medians.assign(
        share=medians["ms"] / whole, steps=len(table), frame_px=frame_px, method=method
    )
