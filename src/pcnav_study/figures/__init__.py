"""Interactive Plotly figures, built from datasets; they draw and measure nothing."""

from pcnav_study.figures.flight import flight_errors, flight_map, frame_pictures
from pcnav_study.figures.matches import error_by_sun, match_pictures, success_by_sun
from pcnav_study.figures.terrain import image_row, slope_aspect_surface

__all__ = [
    "error_by_sun",
    "flight_errors",
    "flight_map",
    "frame_pictures",
    "image_row",
    "match_pictures",
    "slope_aspect_surface",
    "success_by_sun",
]
