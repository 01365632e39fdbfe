"""One frame on the map: from a believed pose to a found position."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer

from pcnav_study.errors import InputError
from pcnav_study.frames.cameras import camera_from_file, camera_from_metadata
from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_grey
from pcnav_study.frames.maps import metric_crs, read_window
from pcnav_study.frames.poses import PoseRecord
from pcnav_study.frames.rectify import inscribed_grid, rectify
from pcnav_study.matching import MatchResult, match
from pcnav_study.quality.alarm import is_alarm
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid

MAP_SHARE = 0.5  # of a search area that must hold map data


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
        Standard deviation of the believed position; three of them are searched. None: a
        tenth of the picture's shorter side on the ground.
    prior_offset_m : float
        Standard deviation, per axis, of an error added to the recorded position, to see
        what a poor prior does.
    seed : int
        Of that error.
    largest_patch_px : int
        Side of the rectified square; larger footprints are down-sampled.
    false_match_rate : float
        Share of unrelated pairs that may pass unalarmed.
    """

    method: str
    prior_error_m: float | None = None
    prior_offset_m: float = 0.0
    seed: int = 0
    largest_patch_px: int = 384
    false_match_rate: float = 0.01


@dataclass(frozen=True)
class Fix:
    """A placed frame, with what it was placed by."""

    position: tuple[float, float]
    grid: Grid
    patch: NDArray[np.float32]
    window: NDArray[np.float32]
    result: MatchResult
    alarm: bool


@dataclass(frozen=True)
class Site:
    """A flight folder with the CRS, in metres, that its frames are placed in."""

    folder: FlightFolder

    @cached_property
    def crs(self) -> str:
        """The map's own CRS if in metres, otherwise its UTM zone."""
        return metric_crs(self.folder.reference)[0]

    @cached_property
    def map_pixel(self) -> float:
        """Side of a map pixel in metres."""
        return metric_crs(self.folder.reference)[1]

    def camera(self, metadata: dict[str, Any]) -> Camera:
        """From camera.json if there is one, otherwise from the frame's EXIF."""
        if self.folder.camera:
            return camera_from_file(self.folder.camera)
        return camera_from_metadata(metadata)

    def position(self, record: PoseRecord) -> tuple[float, float]:
        """Recorded (east, north) in the working CRS."""
        if not record.has_position:
            raise InputError(
                f"no position for {record.frame}; add a row to camera_pose.csv or "
                "flight_log.csv, or keep the image's EXIF"
            )
        known = record.values
        if {"easting", "northing"} <= known.keys():
            return known["easting"], known["northing"]
        to_map = Transformer.from_crs(4326, self.crs, always_xy=True)
        east, north = to_map.transform(known["longitude"], known["latitude"])
        return float(east), float(north)

    def ground(self, grid: Grid) -> NDArray[np.float32] | None:
        """Heights of the elevation model on a grid, gaps at its mean; None without one."""
        if self.folder.dem is None:
            return None
        heights = read_window(self.folder.dem, grid)
        if np.isnan(heights).all():
            if np.isnan(read_window(self.folder.reference, grid)).all():
                raise InputError(
                    "off the map: neither map nor DEM covers the frame; "
                    "give a map that covers the flight"
                )
            raise InputError(
                f"{Path(self.folder.dem).name} does not cover the frame; give a DEM that does"
            )
        return np.where(np.isnan(heights), np.nanmean(heights), heights)

    def pose(self, record: PoseRecord, east: float, north: float) -> tuple[Pose, float]:
        """The believed pose, and the height of level ground under it.

        Without an elevation model heights count from the ground.
        """
        known = record.values
        around = self.ground(Grid.centred(east, north, (50.0, 50.0), (9, 9), self.crs))
        if around is not None and "altitude" in known:
            level, height = float(around.mean()), known["altitude"]
        elif "height_above_ground" in known:
            level = 0.0 if around is None else float(around.mean())
            height = level + known["height_above_ground"]
        else:
            raise InputError(
                f"no height above ground for {record.frame}; add dem.tif, or a column "
                "height_above_ground_m to flight_log.csv"
            )
        if height <= level:
            raise InputError(
                f"{record.frame} lies at {height:.0f} m, not above the ground at {level:.0f} m; "
                "correct its altitude"
            )
        position = (east, north, height)
        if {"omega", "phi", "kappa"} <= known.keys():
            angles = (known["omega"], known["phi"], known["kappa"])
            return Pose.from_omega_phi_kappa(position, *angles), level
        if "yaw" not in known:
            raise InputError(f"no yaw for {record.frame}; add flight_yaw_deg to flight_log.csv")
        tilt = known.get("pitch", 0.0), known.get("roll", 0.0)
        return Pose.from_yaw_pitch_roll(position, known["yaw"], *tilt), level


def localise_frame(
    site: Site,
    path: Path,
    metadata: dict[str, Any],
    record: PoseRecord,
    believed: tuple[float, float],
    settings: FlightSettings,
) -> Fix:
    """Rectify one frame around its believed position and find it on the map.

    Raises
    ------
    InputError
        With the reason, if the frame cannot be placed.
    """
    pose, level = site.pose(record, *believed)
    camera = site.camera(metadata)
    corners = camera.footprint(pose, level)
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
    pixel = max(site.map_pixel, float(sides.min()) / settings.largest_patch_px)
    grid = inscribed_grid(corners, pixel, site.crs, largest=settings.largest_patch_px)
    if min(grid.shape) < 16:
        raise InputError(
            f"the frame covers only {grid.shape[0]} map pixels; "
            f"use a map sharper than {pixel:.2g} m"
        )
    sigma = settings.prior_error_m or float(sides.min()) / 10
    margin = int(np.ceil(3 * sigma / pixel))
    side = grid.shape[0] + 2 * margin
    window = read_window(site.folder.reference, grid.window(-margin, -margin, (side, side)))
    covered = float(np.isfinite(window).mean())
    if covered < MAP_SHARE:
        raise InputError(
            f"off the map: the map holds {covered:.0%} of the area searched; "
            "give a map that covers the flight"
        )
    heights = site.ground(grid)
    patch = rectify(read_grey(path), camera, pose, grid, level if heights is None else heights)
    result = match(window, patch, settings.method, max_shift=margin)
    candidates = result.surface.values.size
    alarm = is_alarm(result.quality, candidates, false_match_rate=settings.false_match_rate)
    position = located(believed, result.shift, grid.pixel_size)
    return Fix(position, grid, patch, window, result, alarm)
