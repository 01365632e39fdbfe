"""A flight's place: its map, elevation model and cameras, in one CRS in metres."""

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
from pcnav_study.frames.maps import metric_crs, read_window
from pcnav_study.frames.poses import PoseRecord
from pcnav_study.frames.suns import frame_sun, map_sun
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.sun import SunPosition

Suns = tuple[SunPosition, SunPosition]
OFF_THE_MAP = "off the map: neither map nor DEM covers the frame; give a map that covers the flight"


@dataclass(frozen=True)
class Site:
    """A flight folder with the CRS, in metres, that its frames are placed in."""

    folder: FlightFolder

    @cached_property
    def sun(self) -> SunPosition | None:
        """Under which the map was imaged, if its tags tell."""
        return map_sun(self.folder.reference)[0]

    def suns(self, time: dict[str, Any], east: float, north: float) -> Suns | None:
        """Of map and frame, if both are known; ``time`` holds ``time`` and ``utc_offset``."""
        if self.sun is None:
            return None
        to_degrees = Transformer.from_crs(self.crs, 4326, always_xy=True)
        longitude, latitude = to_degrees.transform(east, north)
        seen, _ = frame_sun(time, latitude, longitude)
        return None if seen is None else (self.sun, seen)

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
                raise InputError(OFF_THE_MAP)
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
