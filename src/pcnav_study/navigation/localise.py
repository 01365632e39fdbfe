"""One frame on the map: from a believed pose to a found position, coarse to fine.

The whole footprint, rectified coarsely, is sought in all of the prior's reach. The square
in its middle, where lens and tilt distort least, is then placed at the map's own sharpness;
it is rectified anew at each position found, until position and rectification agree.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.frames.images import read_grey
from pcnav_study.frames.maps import read_window
from pcnav_study.frames.occlusion import occluded
from pcnav_study.frames.poses import PoseRecord
from pcnav_study.frames.rectify import bounding_grid, central_grid, rectify
from pcnav_study.matching import MatchResult, match
from pcnav_study.navigation.agreement import LEAST, agreement
from pcnav_study.navigation.site import Site, Suns
from pcnav_study.quality.alarm import is_alarm
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid

MAP_SHARE = 0.3  # of a search area that must hold map data
SEARCH_SIGMAS = 3.5  # one prior in a thousand, of two axes, lies beyond
SEARCH_PX = 200  # side of the coarse footprint
LARGEST_SEARCH_PX = 4096
FINE_REACH = 0.1  # of the shorter side: what the coarse search may be wrong by
SETTLED_PX = 0.1
ITERATIONS = 8
DAMPED = 4  # first step of which only half is taken
SMALLEST_PX = 16


def located(
    believed: tuple[float, float], shift: NDArray[np.floating], pixel_size: tuple[float, float]
) -> tuple[float, float]:
    """Position (east, north): the believed one plus the shift on the ground.

    The shift (row, column) registers the rectified frame with the map, so it is where the
    frame really is as seen from where it was believed to be.
    """
    dy, dx = pixel_size
    return believed[0] + float(shift[1]) * dx, believed[1] - float(shift[0]) * dy


@dataclass(frozen=True)
class FlightSettings:
    """How a flight is localised.

    Parameters
    ----------
    method : str
        A name in ``pcnav_study.matching.METHODS``.
    prior_error_m : float or None
        Standard deviation, per axis, of the believed position; 3.5 of them are searched.
        None: a tenth of the picture's shorter side on the ground.
    prior_offset_m : float
        Standard deviation, per axis, of an error added to the recorded position, to see
        what a poor prior does.
    seed : int
        Of that error.
    largest_patch_px : int
        Side of the finely rectified square; larger footprints are down-sampled.
    false_match_rate : float
        Share of unrelated pairs that may pass unalarmed.
    calibration : str
        "none", "cross-validate", or a file of constants; see `navigation.calibration`.
    """

    method: str = "pc-sectors"
    prior_error_m: float | None = None
    prior_offset_m: float = 0.0
    seed: int = 0
    largest_patch_px: int = 256
    false_match_rate: float = 0.01
    calibration: str = "none"


@dataclass(frozen=True)
class Step:
    """One match: the frame on a grid, the map around it, and the result."""

    grid: Grid
    patch: NDArray[np.float32]
    window: NDArray[np.float32]
    result: MatchResult


@dataclass(frozen=True)
class Fix:
    """A placed frame, with what it was placed by.

    ``position`` is the camera's, ``centre`` that of the picture's middle on the ground, and
    ``footprint`` (4, 2) the corners of the picture there: east and north, metres.
    """

    position: tuple[float, float]
    centre: tuple[float, float]
    footprint: NDArray[np.float64]
    shift: NDArray[np.float64]
    yaw: float
    coarse: Step
    fine: Step
    agreement: float
    iterations: int
    alarm: bool
    reason: str


@dataclass(frozen=True)
class View:
    """One frame with all that is known of it, ready to be rectified anywhere."""

    site: Site
    image: NDArray[np.float32]
    camera: Camera
    record: PoseRecord
    settings: FlightSettings

    def footprint(self, at: tuple[float, float]) -> tuple[Pose, float, NDArray[np.float64]]:
        """Pose, ground level, and the picture's corners if the camera is at (east, north)."""
        pose, level = self.site.pose(self.record, *at)
        return pose, level, self.camera.footprint(pose, level)

    def rectified(self, at: tuple[float, float], grid: Grid) -> NDArray[np.float32]:
        """The frame on ``grid`` if the camera is at (east, north)."""
        pose, level = self.site.pose(self.record, *at)
        heights = self.site.ground(grid)
        if heights is None:
            return rectify(self.image, self.camera, pose, grid, level)
        patch = rectify(self.image, self.camera, pose, grid, heights)
        patch[occluded(heights, grid, pose)] = np.nan
        return patch

    def step(self, at: tuple[float, float], grid: Grid, reach: int, suns: Suns | None) -> Step:
        """Rectify on ``grid`` and match within ``reach`` px."""
        rows, cols = grid.shape
        around = grid.window(-reach, -reach, (rows + 2 * reach, cols + 2 * reach))
        window = read_window(self.site.folder.reference, around)
        covered = float(np.isfinite(window).mean())
        if covered < MAP_SHARE:
            raise InputError(
                f"off the map: the map holds {covered:.0%} of the area searched; "
                "give a map that covers the flight"
            )
        patch = self.rectified(at, grid)
        result = match(window, patch, self.settings.method, suns, max_shift=reach)
        return Step(grid, patch, window, result)


def localise_frame(
    site: Site,
    path: Path,
    metadata: dict[str, Any],
    record: PoseRecord,
    believed: tuple[float, float],
    settings: FlightSettings,
) -> Fix:
    """Find one frame on the map around its believed position.

    Raises
    ------
    InputError
        With the reason, if the frame cannot be placed.
    """
    camera = site.camera(metadata)
    return localise_image(site, partial(read_grey, path), camera, record, believed, settings)


def localise_image(
    site: Site,
    image: NDArray[np.float32] | Callable[[], NDArray[np.float32]],
    camera: Camera,
    record: PoseRecord,
    believed: tuple[float, float],
    settings: FlightSettings,
) -> Fix:
    """The same for a picture (rows, columns) at hand, or a function that reads it."""
    pose, level = site.pose(record, *believed)
    corners = camera.footprint(pose, level)
    pixel, short_side = _fine_pixel(site, camera, corners, settings)
    suns = site.suns(record.time, *believed)
    view = View(site, image() if callable(image) else image, camera, record, settings)
    coarse = _search(view, believed, corners, pixel, short_side, suns)
    first = located(believed, coarse.result.shift, coarse.grid.pixel_size)
    reach = max(int(np.ceil(FINE_REACH * short_side / pixel)), 4)
    settled, fine, iterations, ends = _settle(view, first, pixel, reach, suns)
    parts = agreement(fine.window, fine.patch, fine.result.shift, settings.method)
    position = located(settled, parts.shift, fine.grid.pixel_size)
    pose, level, footprint = view.footprint(position)
    reason = _reason(coarse, parts.share, ends, settings)
    moved = np.subtract(position, believed) / pixel
    return Fix(
        position=position,
        centre=_centre(camera, pose, level),
        footprint=footprint,
        shift=np.array([-moved[1], moved[0]]),
        yaw=pose.heading,
        coarse=coarse,
        fine=fine,
        agreement=parts.share,
        iterations=iterations,
        alarm=bool(reason),
        reason=reason,
    )


def _fine_pixel(
    site: Site, camera: Camera, corners: NDArray[np.float64], settings: FlightSettings
) -> tuple[float, float]:
    """Pixel of the fine rectification, and the footprint's shorter side, metres."""
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
    short = float(sides.min())
    own = short / min(camera.shape)
    pixel = max(site.map_pixel, own, short / settings.largest_patch_px)
    if short / pixel < SMALLEST_PX:
        raise InputError(
            f"the frame covers only {short / pixel:.0f} map pixels; "
            f"use a map sharper than {pixel:.2g} m"
        )
    return pixel, short


def _search(
    view: View,
    believed: tuple[float, float],
    corners: NDArray[np.float64],
    pixel: float,
    short_side: float,
    suns: Suns | None,
) -> Step:
    """The whole footprint, coarsely, in all of the prior's reach."""
    sigma = view.settings.prior_error_m or short_side / 10
    extent = float(np.ptp(corners, axis=0).max())
    coarse = pixel * max(1, int(np.ceil(extent / pixel / SEARCH_PX)))
    reach = max(int(np.ceil(SEARCH_SIGMAS * sigma / coarse)), 4)
    if extent / coarse + 2 * reach > LARGEST_SEARCH_PX:
        raise InputError(
            f"a prior error of {sigma:g} m makes a search area beyond {LARGEST_SEARCH_PX} px; "
            "lower prior_error_m"
        )
    return view.step(believed, bounding_grid(corners, coarse, view.site.crs), reach, suns)


def _settle(
    view: View, at: tuple[float, float], pixel: float, reach: int, suns: Suns | None
) -> tuple[tuple[float, float], Step, int, bool]:
    """Rectify and match in turn until the shift is below a tenth of a pixel.

    From the fourth step on only half of each is taken, lest two near peaks take turns.
    Returns the position that the last step started from, that step, how many there were,
    and whether they ended near each other and not far from where they began.
    """
    start, step = at, None
    for count in range(1, ITERATIONS + 1):
        _, _, corners = view.footprint(at)
        grid = central_grid(corners, pixel, view.site.crs)
        step = view.step(at, grid, reach, suns)
        shift = step.result.shift
        if np.hypot(*shift) < SETTLED_PX:
            return at, step, count, True
        if count == ITERATIONS or np.hypot(*np.subtract(at, start)) > 2 * reach * pixel:
            break
        at = located(at, shift if count < DAMPED else shift / 2, grid.pixel_size)
    assert step is not None
    return at, step, count, bool(np.hypot(*step.result.shift) < reach / 2)


def _reason(coarse: Step, agreed: float, settled: bool, settings: FlightSettings) -> str:
    """Why the fix should not be believed, in words; empty if it should."""
    surface = coarse.result.surface
    candidates = surface.values.size * surface.step**2
    rate = settings.false_match_rate
    if is_alarm(coarse.result.quality, candidates, false_match_rate=rate):
        return "no trustworthy match"
    if agreed < LEAST:
        return f"only {agreed:.0%} of the frame's parts agree on the place"
    if not settled:
        return "position and rectification do not settle"
    return ""


def _centre(camera: Camera, pose: Pose, level: float) -> tuple[float, float]:
    """Ground point (east, north) under the picture's middle pixel."""
    rows, cols = camera.shape
    ray = camera.rays((rows - 1) / 2, (cols - 1) / 2, pose)
    east, north = pose.position[:2] + ray[:2] * ((pose.height - level) / -ray[2])
    return float(east), float(north)
