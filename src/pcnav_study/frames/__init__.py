"""What a camera did see: images, poses, cameras, maps, rectification."""

from pcnav_study.frames.cameras import camera_from_file, camera_from_metadata
from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_grey, read_metadata
from pcnav_study.frames.maps import metric_crs, read_elevation, read_window
from pcnav_study.frames.occlusion import occluded
from pcnav_study.frames.pairs import window_pairs
from pcnav_study.frames.poses import PoseRecord, pose_records
from pcnav_study.frames.rectify import bounding_grid, central_grid, rectify
from pcnav_study.frames.suns import frame_sun, map_sun

__all__ = [
    "FlightFolder",
    "PoseRecord",
    "bounding_grid",
    "camera_from_file",
    "camera_from_metadata",
    "central_grid",
    "frame_sun",
    "map_sun",
    "metric_crs",
    "occluded",
    "pose_records",
    "read_elevation",
    "read_grey",
    "read_metadata",
    "read_window",
    "rectify",
    "window_pairs",
]
