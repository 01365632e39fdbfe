"""A short simulated flight: what the camera took, where it was, where it was thought to be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.progress import progress
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.render import render
from pcnav_study.scene.shading import shade
from pcnav_study.scene.sun import SunPosition, azimuth_difference


def waypoints(
    elevation: xr.DataArray, start: Sequence[float], end: Sequence[float], number: int
) -> NDArray[np.float64]:
    """(number, 2) east and north along a straight route.

    ``start`` and ``end`` are (row, column) as shares of the map, 0 to 1.
    """
    ends = np.array([start, end], float)
    if ends.shape != (2, 2) or ends.min() < 0 or ends.max() > 1:
        raise InputError(
            f"route {list(start)} to {list(end)} leaves the map; "
            "give (row, column) as shares, 0 to 1"
        )
    shares = ends[0] + np.linspace(0, 1, number)[:, None] * (ends[1] - ends[0])
    return Grid.of(elevation).at_shares(shares)


def fly(
    elevation: xr.DataArray,
    albedo: NDArray[np.floating],
    suns: pd.DataFrame,
    map_sun: SunPosition,
    route: NDArray[np.float64],
    camera: Camera,
    *,
    height_above_ground: float,
    attitude_sigma: float,
    position_sigma: float,
    noise: float,
    shadows: bool,
    rng: np.random.Generator,
) -> xr.Dataset:
    """Frames along the route, the whole route once under every sun.

    Parameters
    ----------
    elevation : DataArray (y, x)
        Metres, in a metric CRS.
    albedo : (rows, columns)
        On the elevation's grid.
    suns : DataFrame
        Columns ``time`` (text), ``azimuth``, ``zenith`` in degrees: one flight each.
    route : (waypoints, 2)
        East, north.
    height_above_ground : float
        Of the camera over the mean ground, metres.
    attitude_sigma, position_sigma : float
        Standard deviations of roll and pitch (degrees; known to the UAV) and of the error,
        per axis, of the believed position (metres; unknown to it).
    noise : float
        Standard deviation as a share of the frame's own.

    Returns
    -------
    Dataset
        ``frames`` (frame, row, col), float32, and for every frame the sun, the true and the
        believed position and the attitude.
    """
    level = float(elevation.mean())
    to_next = np.diff(route, axis=0, append=2 * route[-1:] - route[-2:-1])
    yaws = np.degrees(np.arctan2(to_next[:, 0], to_next[:, 1])) % 360
    images, rows = [], []
    for sun_row in progress(suns.itertuples(), "flying", len(suns)):
        sun = SunPosition(float(sun_row.azimuth), float(sun_row.zenith))
        radiance = shade(elevation, sun=sun, shadows=shadows) * albedo
        for k, (east, north) in enumerate(route):
            pitch, roll = attitude_sigma * rng.standard_normal(2)
            error = position_sigma * rng.standard_normal(2)
            position = (east, north, level + height_above_ground)
            pose = Pose.from_yaw_pitch_roll(position, yaws[k], pitch, roll)
            image = render(radiance, elevation, camera, pose)
            images.append(image + noise * np.nanstd(image) * rng.standard_normal(image.shape))
            rows.append(
                {
                    "time": sun_row.time,
                    "waypoint": k,
                    "sun_azimuth": sun.azimuth,
                    "sun_zenith": sun.zenith,
                    "sun_difference": azimuth_difference(map_sun, sun),
                    "east": east,
                    "north": north,
                    "height": position[2],
                    "yaw": yaws[k],
                    "pitch": pitch,
                    "roll": roll,
                    "believed_east": east + error[0],
                    "believed_north": north + error[1],
                }
            )
    log = pd.DataFrame(rows)
    names = [f"{stamp} #{k}" for stamp, k in zip(log["time"], log["waypoint"], strict=True)]
    return xr.Dataset(
        {"frames": (("frame", "row", "col"), np.stack(images).astype(np.float32))},
        coords={"frame": names} | {name: ("frame", log[name].to_numpy()) for name in log},
        attrs={"focal_px": camera.focal_px},
    )
