"""What a camera would see: relief, sun, shading, albedo, camera, rendered frame."""

from pcnav_study.scene.albedo import fractal_albedo
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.distortion import Distortion
from pcnav_study.scene.flight import fly, waypoints
from pcnav_study.scene.grid import Grid
from pcnav_study.scene.relief import fractal_relief, jacksboro, slope_aspect
from pcnav_study.scene.render import render
from pcnav_study.scene.shading import cast_shadows, shade
from pcnav_study.scene.sun import (
    SunPosition,
    azimuth_difference,
    solar_time,
    sun_position,
    time_of_azimuth,
)

__all__ = [
    "Camera",
    "Distortion",
    "Grid",
    "Pose",
    "SunPosition",
    "azimuth_difference",
    "cast_shadows",
    "fly",
    "fractal_albedo",
    "fractal_relief",
    "jacksboro",
    "render",
    "shade",
    "slope_aspect",
    "solar_time",
    "sun_position",
    "time_of_azimuth",
    "waypoints",
]
