"""One set of parameters that makes comparable flights over any map."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

import numpy as np
import xarray as xr

from pcnav_study.errors import InputError
from pcnav_study.navigation.loop.chart import Chart
from pcnav_study.navigation.loop.closed_loop import Mission
from pcnav_study.navigation.loop.pilot import Pilot
from pcnav_study.navigation.loop.route import Route, random_route
from pcnav_study.navigation.loop.sensors import Instruments
from pcnav_study.navigation.loop.world import Air, Scene
from pcnav_study.scene.albedo import fractal_albedo
from pcnav_study.scene.camera import Camera
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.shading import shade
from pcnav_study.scene.sun import SunPosition

ROOM = 1.1  # frame widths kept between a route and the map's border, over two


@dataclass(frozen=True)
class Setup:
    """Lengths count in pixels of the map, so that one setup suits every map.

    Parameters
    ----------
    frame_px : float
        Width of a frame on mean ground; with the field of view it sets the height.
    camera_px : int
        Rows and columns of the camera.
    field_of_view : float
        Degrees, across the columns.
    leg_px, legs : float, int
        Way between two frames, and how many make a route.
    speed : float
        Cruising, m/s.
    wind : float
        Mean wind, m/s, from a direction drawn for each flight.
    turbulence : float
        m/s, see `Air`.
    attitude_sigma : float
        Degrees of true pitch and roll.
    start_sigma_px : float
        Of the position believed at take-off, each axis.
    corridor_px : float
        Off the route by less is on it.
    noise, haze, albedo_contrast, shadows
        Of the scene.
    failed_share : float
        Share of frames that come out black.
    instruments : Instruments
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}  # refuse misspelt keys

    frame_px: float = 128.0
    camera_px: int = 128
    field_of_view: float = 45.0
    leg_px: float = 20.0
    legs: int = 10
    speed: float = 50.0
    wind: float = 8.0
    turbulence: float = 1.0
    attitude_sigma: float = 2.0
    start_sigma_px: float = 0.5
    corridor_px: float = 12.0
    noise: float = 0.02
    haze: float = 0.0
    albedo_contrast: float = 0.1
    shadows: bool = True
    failed_share: float = 0.0
    instruments: Instruments = field(default_factory=Instruments)

    def __post_init__(self) -> None:
        lengths = (
            self.frame_px,
            self.camera_px,
            self.leg_px,
            self.legs,
            self.speed,
            self.corridor_px,
        )
        if min(lengths) <= 0 or not 0 < self.field_of_view < 120:
            raise InputError(
                "frame, camera, leg, legs, speed and corridor must be positive, and the field of "
                "view below 120 degrees"
            )
        if self.leg_px < 1:
            raise InputError("waypoints lie closer than a map pixel; give a leg_px of 1 or more")
        if 4 * self.attitude_sigma + 0.71 * self.field_of_view > 85:
            raise InputError(
                f"with an attitude_sigma of {self.attitude_sigma:g} degrees the camera would see "
                "the horizon; lower it or the field of view"
            )
        if min(self.wind, self.turbulence, self.noise, self.attitude_sigma) < 0:
            raise InputError("wind, turbulence, noise and attitude cannot be negative")
        if not (0 <= self.haze < 1 and 0 <= self.failed_share <= 1):
            raise InputError("haze must be within 0 and 1, and so must the share of failed frames")

    @property
    def camera(self) -> Camera:
        """Square, without distortion."""
        return Camera.from_field_of_view((self.camera_px, self.camera_px), self.field_of_view)


class Place(NamedTuple):
    """A map under one sun and the same ground under another."""

    chart: Chart
    scene: Scene


def place(
    elevation: xr.DataArray,
    map_sun: SunPosition,
    flight_sun: SunPosition,
    setup: Setup,
    seed: int,
) -> Place:
    """Shade the map and the world; ``seed`` fixes the reflectance of the ground.

    Raises
    ------
    InputError
        If a sun is below the horizon.
    """
    for whose, sun in (("map", map_sun), ("flight", flight_sun)):
        if not sun.is_up:
            raise InputError(
                f"the sun of the {whose} is {sun.zenith - 90:.0f} degrees below the horizon: "
                "nothing can be seen; choose a daylight time"
            )
    rng = np.random.default_rng(seed)
    albedo = fractal_albedo(
        (elevation.sizes["y"], elevation.sizes["x"]), setup.albedo_contrast, rng
    )
    pictures = [
        shade(elevation, sun=sun, shadows=setup.shadows) * albedo for sun in (map_sun, flight_sun)
    ]
    chart = Chart(pictures[0].astype(np.float32), elevation)
    height = chart.level + setup.frame_px * chart.pixel * setup.camera.focal_px / setup.camera_px
    scene = Scene(pictures[1], elevation, setup.camera, height, setup.noise, setup.haze)
    return Place(chart, scene)


def mission(
    where: Place, setup: Setup, seed: int, route: Route | None = None, gust: float = 0.0
) -> Mission:
    """A flight; its wind, its gust and, unless given, its route are drawn from ``seed``.

    Parameters
    ----------
    gust : float
        Of one gust, drawn from a tenth of a frame's width to this share of it; 0 for none.
    """
    chart = where.chart
    rng = np.random.default_rng([seed, 99])
    width, leg = setup.frame_px * chart.pixel, setup.leg_px * chart.pixel
    grid = Grid.of(chart.elevation)
    if route is None:
        route = random_route(grid, setup.legs, leg, ROOM * width / 2, rng)
    angle = 2 * np.pi * rng.random()
    air = Air((setup.wind * np.sin(angle), setup.wind * np.cos(angle)), setup.turbulence)
    legs = max(int(np.ceil(route.length / leg)), 3)
    share, step = (
        rng.uniform(min(0.1, gust), gust) if gust else 0.0,
        int(rng.integers(2, legs)),
    )
    failed = frozenset(np.flatnonzero(rng.random(10 * legs) < setup.failed_share).tolist()) - {0}
    pilot = Pilot(route, leg, leg / setup.speed, setup.corridor_px * chart.pixel)
    return Mission(
        chart, where.scene, pilot, air, setup.instruments,
        attitude_sigma=setup.attitude_sigma,
        start_sigma_m=setup.start_sigma_px * chart.pixel,
        gust_m=share * width, gust_step=step, failed_frames=failed, seed=seed,
    ).checked()  # fmt: skip
