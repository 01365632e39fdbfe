"""What a camera did see: images, poses, cameras, maps, rectification."""

from pcnav_study.frames.cameras import camera_from_file, camera_from_metadata
from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_grey, read_metadata
from pcnav_study.frames.maps import metric_crs, read_elevation, read_window
from pcnav_study.frames.pairs import window_pairs
from pcnav_study.frames.poses import PoseRecord, pose_records
from pcnav_study.frames.rectify import inscribed_grid, rectify

__all__ = [
    "FlightFolder",
    "PoseRecord",
    "camera_from_file",
    "camera_from_metadata",
    "inscribed_grid",
    "metric_crs",
    "pose_records",
    "read_elevation",
    "read_grey",
    "read_metadata",
    "read_window",
    "rectify",
    "window_pairs",
]
