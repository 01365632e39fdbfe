"""The planned route: a polyline on the map, and where on it the UAV is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pcnav_study.errors import InputError
from pcnav_study.scene.grid import Grid

Array = NDArray[np.float64]
TRIES = 10_000  # random routes drawn before a map is called too small


class Place(NamedTuple):
    """Nearest point of a route: metres flown up to it, and metres off it."""

    along: float
    off: float


@dataclass(frozen=True)
class Route:
    """Waypoints (n, 2), east and north, in metres."""

    waypoints: Array

    def __post_init__(self) -> None:
        points = np.asarray(self.waypoints, np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
            raise InputError("a route needs at least two waypoints, each (east, north)")
        if not np.isfinite(points).all():
            raise InputError("a waypoint is not a number; give east and north in metres")
        object.__setattr__(self, "waypoints", points)

    @property
    def legs(self) -> Array:
        """Length of each leg, metres."""
        lengths: Array = np.hypot(*np.diff(self.waypoints, axis=0).T)
        return lengths

    @property
    def length(self) -> float:
        """Of the whole route, metres."""
        return float(self.legs.sum())

    def at(self, along: float) -> Array:
        """Point (east, north) after ``along`` metres, clipped to the route."""
        passed = np.concatenate([[0.0], np.cumsum(self.legs)])
        return np.array([np.interp(along, passed, axis) for axis in self.waypoints.T])

    def place(self, position: ArrayLike) -> Place:
        """Where on the route a position (east, north) is nearest."""
        starts, legs = self.waypoints[:-1], np.diff(self.waypoints, axis=0)
        away = np.asarray(position, np.float64) - starts
        share = np.clip((away * legs).sum(axis=1) / self.legs**2, 0.0, 1.0)
        off = np.hypot(*(away - share[:, None] * legs).T)
        nearest = int(off.argmin())
        along = self.legs[:nearest].sum() + share[nearest] * self.legs[nearest]
        return Place(float(along), float(off[nearest]))

    def checked(self, grid: Grid, margin: float) -> Route:
        """The route itself, if it can be flown over a map.

        Parameters
        ----------
        margin : float
            Metres from a waypoint to the map's border: half a frame.

        Raises
        ------
        InputError
            If a waypoint lies off the map or too near its border, or two lie closer than a
            pixel.
        """
        if self.legs.min() < max(grid.pixel_size):
            short = int(self.legs.argmin())
            raise InputError(
                f"waypoints {short} and {short + 1} are {self.legs.min():.1f} m apart, less than "
                f"a map pixel ({max(grid.pixel_size):.1f} m); leave one of them out"
            )
        inside = _inside(self.waypoints, grid, margin)
        if not inside.all():
            number = int(np.flatnonzero(~inside)[0])
            east, north = self.waypoints[number]
            raise InputError(
                f"waypoint {number} at ({east:.0f}, {north:.0f}) is off the map or nearer than "
                f"half a frame ({margin:.0f} m) to its border; move the route or give a larger map"
            )
        return self


def random_route(
    grid: Grid, legs: int, leg_m: float, margin: float, rng: np.random.Generator
) -> Route:
    """A straight route in a random direction, wholly ``margin`` metres within the map.

    Raises
    ------
    InputError
        If the map is too small for it.
    """
    t, (rows, cols) = grid.transform, grid.shape
    east, north = t.c + t.a * cols * rng.random(TRIES), t.f + t.e * rows * rng.random(TRIES)
    angle = 2 * np.pi * rng.random(TRIES)
    start = np.stack([east, north], axis=1)
    heading = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    fits = _inside(start, grid, margin) & _inside(start + legs * leg_m * heading, grid, margin)
    if not fits.any():
        raise InputError(
            f"no route of {legs} legs of {leg_m:.0f} m fits the map with {margin:.0f} m to its "
            "border; shorten it, lower the frame's width, or give a larger map"
        )
    k = int(fits.argmax())
    return Route(start[k] + leg_m * np.arange(legs + 1)[:, None] * heading[k])


def _inside(points: Array, grid: Grid, margin: float) -> NDArray[np.bool_]:
    """Which points (n, 2) lie on the map, ``margin`` metres from its border or more."""
    t, (rows, cols) = grid.transform, grid.shape
    east, north = points.T
    inside: NDArray[np.bool_] = (
        (east >= t.c + margin)
        & (east <= t.c + t.a * cols - margin)
        & (north <= t.f - margin)
        & (north >= t.f + t.e * rows + margin)
    )
    return inside
