"""One flight in motion: where the UAV is, where it believes to be, and what it decides."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
import plotly.graph_objects as go
import xarray as xr
from plotly.subplots import make_subplots

from pcnav_study.figures.player import played
from pcnav_study.figures.style import NAME, styled
from pcnav_study.scene.grid import Grid

ROUTE, TRUTH, BELIEF, SEEN, ALARM, GUST = (
    "#FFFFFF", "#56B4E9", "#F0E442", "#00C08B", "#FF7F2A", "#FF4FA3",
)  # fmt: skip
SIDE_PX, PANEL_PX = 420, 210  # most rows or columns of the picture under a flight
COLUMNS = 3  # of small panels
KM = 1e-3
AXES = (("x", "east"), ("y", "north"))
Trace = dict[str, Any]


def mission_animation(log: pd.DataFrame, picture: xr.DataArray, method: str) -> go.Figure:
    """One method's flight over the map, frame by frame, with its errors and its quality.

    Parameters
    ----------
    log : DataFrame
        ``mission_log``.
    picture : DataArray (y, x)
        ``mission_map``: the picture on board, with the route in its attributes.
    method : str
    """
    flight = _flights(log)[method]
    figure = make_subplots(
        2, 2, specs=[[{"rowspan": 2}, {}], [None, {}]], column_widths=[0.6, 0.4],
        horizontal_spacing=0.09, vertical_spacing=0.12,
    )  # fmt: skip
    _ground(figure, picture, SIDE_PX, 1, 1)
    last = len(flight) - 1
    start = len(figure.data)
    for place, traces in zip(((1, 1), (1, 2), (2, 2)), _all(flight, last), strict=True):
        for trace in traces:
            figure.add_scatter(**trace, row=place[0], col=place[1])
    numbers = list(range(start, len(figure.data)))
    frames = []
    for step in range(last + 1):
        data = [_moving(t) for traces in _all(flight, step) for t in traces]
        frames.append(_frame(step, data, numbers, {"title": {"text": _story(flight, step)}}))
    figure.frames = frames
    _errors_axes(figure, flight, picture)
    return played(styled(figure, _story(flight, last), 850), last, top=90)


def mission_panels(log: pd.DataFrame, picture: xr.DataArray) -> go.Figure:
    """The same flight under every method of the log, with one slider.

    A method whose flight is over stays at its last frame and says how it ended.
    """
    flights = _flights(log)
    rows = -(-len(flights) // COLUMNS)
    figure = make_subplots(
        rows, COLUMNS, subplot_titles=list(flights), horizontal_spacing=0.03,
        vertical_spacing=0.2 / rows,
    )  # fmt: skip
    numbers: list[int] = []
    last = int(log["step"].max())
    for k, flight in enumerate(flights.values()):
        row, col = k // COLUMNS + 1, k % COLUMNS + 1
        _ground(figure, picture, PANEL_PX, row, col, legend=k == 0)
        start = len(figure.data)
        for trace in _on_map(flight, last):
            figure.add_scatter(**trace | {"showlegend": k == 0}, row=row, col=col)
        numbers += range(start, len(figure.data))
    figure.update_xaxes(title="", showticklabels=False)
    figure.update_yaxes(title="", showticklabels=False)
    titles = [a.to_plotly_json() for a in figure.layout.annotations]
    frames = []
    for step in range(last + 1):
        data = [_moving(t) for flight in flights.values() for t in _on_map(flight, step)]
        frames.append(_frame(step, data, numbers, {"annotations": _told(titles, flights, step)}))
    figure.frames = frames
    figure.update_layout(annotations=_told(titles, flights, last))
    styled(figure, "The same flight under every method", 350 * rows + 290)
    return played(figure, last, top=110)


def _flights(log: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Each method's rows, in the order of the log."""
    return {str(m): f.reset_index(drop=True) for m, f in log.groupby("method", sort=False)}


def _ground(
    figure: go.Figure, picture: xr.DataArray, most: int, row: int, col: int, *, legend: bool = True
) -> None:
    """The picture in grey, and the planned route on it."""
    step = max(1, -(-max(picture.shape) // most))
    small = picture.coarsen(y=step, x=step, boundary="trim").mean()
    low, high = np.nanpercentile(small.values, [1, 99])
    grey = np.nan_to_num(255 * np.clip((small.values - low) / (high - low), 0, 1)).astype(np.uint8)
    (x0, x1), (y0, y1) = (KM * small[axis].values[:2] for axis in ("x", "y"))
    figure.add_heatmap(
        z=grey, x0=x0, dx=x1 - x0, y0=y0, dy=y1 - y0, colorscale="gray", zmin=0, zmax=255,
        showscale=False, hoverinfo="skip", name="map", row=row, col=col,
    )  # fmt: skip
    route = KM * np.array(picture.attrs["route"]).reshape(-1, 2)
    figure.add_scatter(
        x=route[:, 0].tolist(), y=route[:, 1].tolist(), mode="lines", name="planned route",
        line={"color": ROUTE, "width": 2, "dash": "dot"}, hoverinfo="skip", showlegend=legend,
        legendgroup="planned route", row=row, col=col,
    )  # fmt: skip
    axes = figure.get_subplot(row, col)
    width, height = (KM * np.ptp(small[axis].values) / 2 for axis in ("x", "y"))
    middle = [KM * float(small[axis].mean()) for axis in ("x", "y")]
    figure.update_xaxes(
        title="east, km", range=[middle[0] - width, middle[0] + width], constrain="domain",
        showgrid=False, row=row, col=col,
    )  # fmt: skip
    figure.update_yaxes(
        title="north, km", range=[middle[1] - height, middle[1] + height], tickformat="d",
        scaleanchor=axes.xaxis.plotly_name.replace("axis", ""), constrain="domain",
        showgrid=False, row=row, col=col,
    )  # fmt: skip


def _all(flight: pd.DataFrame, step: int) -> tuple[list[Trace], list[Trace], list[Trace]]:
    """Traces of the large figure at one frame: on the map, errors, quality."""
    steers = flight.iloc[[min(step, len(flight) - 1)]]
    target = _path(steers, "target_") | {
        "mode": "markers", "name": "steers for", "hoverinfo": "skip",
        "marker": {"symbol": "diamond-open", "size": 11, "color": ROUTE, "line": {"width": 2}},
    }  # fmt: skip
    past = flight.iloc[: step + 1]
    return [*_on_map(flight, step), target], _errors(past), _quality(past)


def _on_map(flight: pd.DataFrame, step: int) -> list[Trace]:
    """Traces on the map: truth, belief, what the frame shows, and the gust."""
    past = flight.iloc[: step + 1]
    now = past.iloc[-1]
    ring = KM * np.array([*now["footprint"], now["footprint"][0]])
    outline = {"x": _numbers(ring[:, 0]), "y": _numbers(ring[:, 1])}
    nothing = {"x": [None], "y": [None]}
    alarmed = bool(now["alarm"])
    blown = [i for k in past.index[past["push_m"] > 0] for i in (k - 1, k)]
    lines: list[tuple[str, Trace, Trace]] = [
        ("this frame on the ground", nothing if alarmed else outline, {"color": SEEN, "width": 2}),
        ("the same, under an alarm", outline if alarmed else nothing, {"color": ALARM, "width": 3}),
        ("gust", _path(flight.loc[blown]) if blown else nothing,
         {"color": GUST, "width": 2.5, "dash": "dash"}),
        ("where it is", _broken(past), {"color": TRUTH, "width": 3}),
    ]  # fmt: skip
    traces: list[Trace] = [
        {"mode": "lines", "name": name, "line": line, "hoverinfo": "skip", "legendgroup": name}
        | points
        for name, points, line in lines
    ]
    belief = _path(past, "believed_") | {
        "mode": "markers", "name": "where it believes to be", "legendgroup": "belief",
        "marker": {"color": BELIEF, "size": 6, "line": {"width": 1, "color": "black"}},
        "text": [f"frame {s}: {a}" for s, a in zip(past["step"], past["action"], strict=True)],
        "hovertemplate": "%{text}<extra></extra>",
    }  # fmt: skip
    alarms = past[past["alarm"]]
    return [*traces, belief, _crosses(alarms) | _path(alarms, "believed_")]


def _errors(past: pd.DataFrame) -> list[Trace]:
    """Errors so far, on a log axis."""
    alarms = past[past["alarm"]]
    return [
        _curve(past, "error_m", "position: off by", "#0072B2"),
        _curve(past, "next_error_m", "as predicted a leg before: off by", "#999999", dash="dot"),
        _crosses(alarms) | {"showlegend": False},
    ]


def _quality(past: pd.DataFrame) -> list[Trace]:
    """Quality of the accepted match so far, alarms marked."""
    alarms = past[past["alarm"]]
    curve = _curve(past, "quality", "quality", "#CC79A7") | {"showlegend": False}
    return [curve, _crosses(alarms, "quality") | {"showlegend": False}]


def _curve(past: pd.DataFrame, column: str, name: str, colour: str, dash: str = "solid") -> Trace:
    return {
        "x": past["step"].tolist(), "y": _numbers(past[column]), "mode": "lines+markers",
        "name": name, "line": {"color": colour, "dash": dash}, "marker": {"size": 5},
        "hovertemplate": "frame %{x}: %{y:.3g}<extra></extra>",
    }  # fmt: skip


def _crosses(alarms: pd.DataFrame, column: str = "error_m") -> Trace:
    return {
        "x": alarms["step"].tolist(), "y": _numbers(alarms[column]), "mode": "markers",
        "name": "alarm", "legendgroup": "alarm", "text": alarms["reason"].tolist(),
        "marker": {"symbol": "x", "size": 10, "color": ALARM},
        "hovertemplate": "%{text}<extra>alarm</extra>",
    }  # fmt: skip


def _errors_axes(figure: go.Figure, flight: pd.DataFrame, picture: xr.DataArray) -> None:
    """Axes that stand still while the curves grow, and the map's pixel as a yardstick."""
    pixel = float(np.sqrt(np.prod(Grid.of(picture).pixel_size)))
    found = flight[["error_m", "next_error_m"]].to_numpy(float)
    low, high = np.nanmin(found), max(np.nanmax(found), pixel)
    figure.update_xaxes(range=[-0.5, len(flight) - 0.5], col=2)
    figure.update_xaxes(title="frame", row=2, col=2)
    figure.update_yaxes(
        title="error, m (log)", type="log", range=[np.log10(low / 2), np.log10(high * 2)],
        dtick=1, row=1, col=2,
    )  # fmt: skip
    figure.add_hline(y=pixel, line={"dash": "dash", "color": "#555", "width": 1}, row=1, col=2)
    figure.add_annotation(
        x=len(flight) - 0.5, y=np.log10(pixel), text=f"1 px of the map, {pixel:.0f} m",
        xanchor="right", yanchor="bottom", showarrow=False, font={"size": 11}, row=1, col=2,
    )  # fmt: skip
    top = np.nanmax([*flight["quality"].astype(float), 0.1])
    figure.update_yaxes(title="quality of the match", range=[0, 1.15 * top], row=2, col=2)


def _story(flight: pd.DataFrame, step: int) -> str:
    """What happens at a frame, in two lines."""
    row = flight.iloc[min(step, len(flight) - 1)]
    name = NAME.get(str(row["method"]), str(row["method"]))
    told = [f"{name}, frame {row['step']}: {row['action']}"]
    told += [f"<b>{_end(row)}</b>"] if row["ending"] else []
    told += [f"<b>alarm</b>: {row['reason']}"] if row["alarm"] else []
    return ", ".join(told) + f"<br><span style='font-size:13px'>{row['note'] or ' '}</span>"


def _told(
    titles: list[dict[str, Any]], flights: dict[str, pd.DataFrame], step: int
) -> list[dict[str, Any]]:
    """Titles of the small panels at one frame."""
    told = []
    for title, (method, flight) in zip(titles, flights.items(), strict=False):
        row = flight.iloc[min(step, len(flight) - 1)]
        state = _end(row) if row["ending"] else ("alarm: " if row["alarm"] else "") + row["action"]
        text = f"<b>{method}</b>, frame {row['step']}<br>{state}"
        told.append(title | {"text": text, "font": {"size": 13}})
    return told


def _end(row: pd.Series) -> str:
    """How the flight ended for the UAV, and how far from there it really is."""
    return f"{row['ending']}, off by {row['error_m']:.0f} m"


def _path(rows: pd.DataFrame, prefix: str = "") -> Trace:
    return {axis: _numbers(KM * rows[prefix + name]) or [None] for axis, name in AXES}


def _broken(past: pd.DataFrame) -> Trace:
    """The way flown, interrupted where a gust carried the UAV off."""
    path = _path(past)
    for k in past.index[past["push_m"] > 0][::-1]:
        path["x"].insert(k, None)
        path["y"].insert(k, None)
    return path


def _numbers(values: Any) -> list[float | None]:
    return [None if not np.isfinite(v) else round(float(v), 4) for v in np.asarray(values, float)]


def _moving(trace: Trace) -> Trace:
    """What of a trace changes from frame to frame."""
    return {"type": "scatter"} | {k: v for k, v in trace.items() if k in ("x", "y", "text")}


def _frame(step: int, data: list[Trace], numbers: list[int], layout: dict[str, Any]) -> Trace:
    return {"name": str(step), "data": data, "traces": numbers, "layout": layout}
