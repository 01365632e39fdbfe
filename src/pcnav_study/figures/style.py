"""Colours and sizes that all figures share."""

from __future__ import annotations

import plotly.graph_objects as go

COLOUR = {
    "pc": "#0072B2",
    "ncc": "#D55E00",
    "mi": "#009E73",
    "pc-abs": "#56B4E9",
    "pc-solar": "#E69F00",
    "pc-sectors": "#CC79A7",
    "ssd": "#999999",
    "pc-sectors, alarm off": "#882255",
    "odometry": "#AA7700",
    "odometry over relief": "#117733",
    "odometry, Kalman": "#332288",
    "odometry and fixes, EKF": "#000000",
}
NAME = {
    "pc": "phase correlation (signed peak)",
    "ncc": "normalised cross-correlation",
    "mi": "mutual information",
    "pc-abs": "phase correlation (absolute peak)",
    "pc-solar": "phase correlation (known suns)",
    "pc-sectors": "phase correlation (sectors)",
    "ssd": "sum of squared differences",
    "pc-sectors, alarm off": "phase correlation (sectors), alarm off",
    "odometry": "visual odometry",
    "odometry over relief": "visual odometry over relief",
    "odometry, Kalman": "visual odometry, Kalman filter",
    "odometry and fixes, EKF": "visual odometry and fixes, EKF",
}


def styled(figure: go.Figure, title: str, height: int = 420) -> go.Figure:
    """The figure with the study's fonts, margins and background."""
    return figure.update_layout(
        title={"text": title, "font": {"size": 15}},
        height=height,
        margin={"l": 60, "r": 20, "t": 70, "b": 50},
        template="plotly_white",
        font={"family": "system-ui, sans-serif", "size": 13},
    )
