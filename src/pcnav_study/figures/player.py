"""Play, pause and a slider under a figure that has frames."""

from __future__ import annotations

import plotly.graph_objects as go

PACE_MS = 700  # of one frame while playing


def played(figure: go.Figure, last: int, top: int) -> go.Figure:
    """With play, pause, a slider over frames 0 to ``last`` (shown at the last), and a legend."""
    at_once = {"mode": "immediate", "transition": {"duration": 0}}
    play = at_once | {"fromcurrent": True, "frame": {"duration": PACE_MS, "redraw": True}}
    jump = at_once | {"frame": {"duration": 0, "redraw": True}}
    steps = [
        {"label": str(k), "method": "animate", "args": [[str(k)], jump]} for k in range(last + 1)
    ]
    buttons = [
        {"label": "▶ play", "method": "animate", "args": [None, play]},
        {"label": "❚❚ pause", "method": "animate", "args": [[None], jump]},
    ]
    slider = {
        "steps": steps, "active": last, "x": 0.18, "len": 0.82, "y": 0, "pad": {"t": 50},
        "currentvalue": {"prefix": "frame ", "font": {"size": 13}},
    }  # fmt: skip
    menu = {
        "type": "buttons", "direction": "left", "showactive": False, "buttons": buttons,
        "x": 0.0, "xanchor": "left", "y": 0, "yanchor": "top", "pad": {"t": 72},
    }  # fmt: skip
    legend = {
        "orientation": "h", "yref": "container", "y": 0.0, "yanchor": "bottom", "x": 0,
        "bgcolor": "#B8BEC7", "font": {"size": 12, "color": "black"},
    }  # fmt: skip
    return figure.update_layout(
        sliders=[slider], updatemenus=[menu], legend=legend,
        margin={"l": 55, "r": 20, "t": top, "b": 200, "autoexpand": False},
    )  # fmt: skip
