"""Interactive Plotly figures, built from datasets; they draw and measure nothing."""

from pcnav_study.figures.flight import flight_errors, flight_map, frame_pictures
from pcnav_study.figures.light import light_maps, sweep_curves
from pcnav_study.figures.matches import error_by_sun, match_pictures, success_by_sun
from pcnav_study.figures.mission import mission_animation, mission_panels
from pcnav_study.figures.navigation import (
    alarm_outcomes,
    arrival_by_sun,
    drift,
    error_by_hour,
    error_by_sun_difference,
    time_parts,
)
from pcnav_study.figures.phase import peak_by_azimuth, signs_and_surface
from pcnav_study.figures.quality import (
    evidence_by_distance,
    mistake_pictures,
    null_histogram,
    reliability_diagram,
    roc_curves,
)
from pcnav_study.figures.speed import time_bars
from pcnav_study.figures.terrain import image_row, slope_aspect_surface

__all__ = [
    "alarm_outcomes",
    "arrival_by_sun",
    "drift",
    "error_by_hour",
    "error_by_sun",
    "error_by_sun_difference",
    "evidence_by_distance",
    "flight_errors",
    "flight_map",
    "frame_pictures",
    "image_row",
    "light_maps",
    "match_pictures",
    "mission_animation",
    "mission_panels",
    "mistake_pictures",
    "null_histogram",
    "peak_by_azimuth",
    "reliability_diagram",
    "roc_curves",
    "signs_and_surface",
    "slope_aspect_surface",
    "success_by_sun",
    "sweep_curves",
    "time_bars",
    "time_parts",
]
