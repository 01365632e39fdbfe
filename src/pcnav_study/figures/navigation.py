"""Fleets of flights: arrivals, errors, alarms, drift, and where the time of a step goes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from pcnav_study.figures.style import COLOUR, NAME, styled

SUN = "difference of sun azimuth, map to flight, deg"
ON_TOP = "pc-sectors"
APART = 0.7  # degrees between the marks of methods at one sun, so that none hides another
PX_TICKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)
SLOPE_TICKS = (-1000, -100, -10, -1, 0, 1, 10, 100, 1000)  # metres per kilometre
PART = {
    "rectify": "#0072B2", "match": "#CC79A7", "trust": "#E69F00", "next position": "#56B4E9",
    "decide and steer": "#BBBBBB",
}  # fmt: skip
OUTCOME = {
    "alarm_recall": "gusts that raised an alarm at once",
    "false_alarm_rate": "false alarms among right fixes",
    "recovery_rate": "flights back on their route",
}
Panel = tuple[str, pd.DataFrame]


def arrival_by_sun(summary: pd.DataFrame) -> go.Figure:
    """Share of flights that arrive over the suns' difference, by site and gust.

    Whiskers are Wilson's 95 % intervals.
    """
    panels = _panels(summary)
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    figure = make_subplots(
        rows, columns, subplot_titles=[title for title, _ in panels], shared_yaxes=True,
        horizontal_spacing=0.04, vertical_spacing=0.3 / rows,
    )  # fmt: skip
    known: set[str] = set()
    for k, (_, panel) in enumerate(panels):
        for shift, method, line in _by_method(panel):
            figure.add_scatter(
                x=line["sun_difference_deg"] + shift, y=line["arrival_rate"],
                error_y={
                    "array": line["arrival_high"] - line["arrival_rate"],
                    "arrayminus": line["arrival_rate"] - line["arrival_low"],
                    "thickness": 1, "width": 2,
                },
                customdata=line["flights"],
                hovertemplate="%{y:.0%} of %{customdata} flights<extra>" + method + "</extra>",
                **_look(method, known), row=k // columns + 1, col=k % columns + 1,
            )  # fmt: skip
    figure.update_yaxes(range=[-0.04, 1.06], tickformat=".0%")
    figure.update_yaxes(title="arrived", col=1)
    figure.update_xaxes(tick0=0, dtick=30)
    figure.update_xaxes(title=SUN, row=rows)
    title = f"Flights that arrive (n = {_count(summary)} a point; whiskers: 95 % interval)"
    return _below(styled(figure, title, 300 * rows + 170))


def error_by_sun_difference(summary: pd.DataFrame) -> go.Figure:
    """RMSE of the trusted position, and of the one predicted a leg ahead, in map pixels."""
    panels = _panels(summary)
    kinds = (("rmse_px", 0.5, "position"), ("next_rmse_px", 1.0, "next position"))
    rows = len(panels)
    figure = make_subplots(
        rows, 2, subplot_titles=[f"{what}: {title}" for title, _ in panels for *_, what in kinds],
        shared_yaxes="all", horizontal_spacing=0.04, vertical_spacing=0.3 / rows,
    )  # fmt: skip
    known: set[str] = set()
    for row, (_, panel) in enumerate(panels, 1):
        for col, (column, limit, _) in enumerate(kinds, 1):
            for shift, method, line in _by_method(panel):
                figure.add_scatter(
                    x=line["sun_difference_deg"] + shift, y=line[column],
                    customdata=line[["flights", "trusted_share"]],
                    hovertemplate="%{y:.3g} px; n = %{customdata[0]} flights, trusted in "
                    "%{customdata[1]:.0%} of frames<extra>" + method + "</extra>",
                    **_look(method, known), row=row, col=col,
                )  # fmt: skip
            figure.add_hline(
                y=limit, line={"dash": "dash", "color": "#555", "width": 1}, row=row, col=col
            )
    figure.update_yaxes(type="log", tickvals=PX_TICKS)
    figure.update_yaxes(title="RMSE, px (log)", col=1)
    figure.update_xaxes(tick0=0, dtick=30)
    figure.update_xaxes(title=SUN, row=rows)
    title = f"Error while it trusts its position (n = {_count(summary)} flights a point)"
    return _below(styled(figure, title, 300 * rows + 170))


def error_by_hour(summary: pd.DataFrame) -> go.Figure:
    """RMSE of the trusted position over the time of day, a panel for each site and day."""
    calm = summary[summary["gust"] == summary["gust"].min()]
    calm = calm.assign(
        day=calm["time"].str[:10], hour=pd.to_datetime(calm["time"].str[11:16], format="%H:%M")
    )
    panels = list(calm.groupby(["site", "day"], sort=False))
    figure = make_subplots(
        len(panels), 1, subplot_titles=[f"{site}, {day}" for (site, day), _ in panels],
        shared_yaxes=True, vertical_spacing=0.35 / len(panels),
    )  # fmt: skip
    known: set[str] = set()
    for row, (_, panel) in enumerate(panels, 1):
        for _, method, line in _by_method(panel):
            line = line.sort_values("hour")
            figure.add_scatter(
                x=line["hour"], y=line["rmse_px"],
                customdata=line[["arrival_rate", "flights", "sun_difference_deg"]],
                hovertemplate="%{y:.2f} px, %{customdata[0]:.0%} of %{customdata[1]} arrived, suns "
                "%{customdata[2]:.0f}° apart<extra>" + method + "</extra>",
                **_look(method, known), row=row, col=1,
            )  # fmt: skip
    figure.update_yaxes(type="log", tickvals=PX_TICKS, title="RMSE, px (log)")
    figure.update_xaxes(tickformat="%H:%M")
    figure.update_xaxes(title="time of the flight, UTC", row=len(panels))
    title = f"Error by the hour (n = {_count(calm)} flights a point)"
    return _below(styled(figure, title, 240 * len(panels) + 170))


def alarm_outcomes(table: pd.DataFrame) -> go.Figure:
    """What the alarm catches, what it cries about in vain, and what heeding it is worth.

    Parameters
    ----------
    table : DataFrame
        Made by `pcnav_study.navigation.verdicts.pooled`, by gust and method.
    """
    figure = make_subplots(
        1, len(OUTCOME), subplot_titles=list(OUTCOME.values()), shared_yaxes=True,
        horizontal_spacing=0.04,
    )  # fmt: skip
    known: set[str] = set()
    for col, outcome in enumerate(OUTCOME, 1):
        for method, rows in table[table["outcome"] == outcome].groupby("method", sort=False):
            name = NAME.get(str(method), str(method))
            told = zip(rows["value"], rows["n"], strict=True)
            figure.add_bar(
                x=[f"≤ {gust:g}" for gust in rows["gust"]], y=rows["value"],
                error_y={"array": rows["high"] - rows["value"],
                         "arrayminus": rows["value"] - rows["low"]},
                text=[f"{share:.1%}<br>n = {n}" for share, n in told],
                textposition=np.where(rows["value"] > 0.2, "inside", "outside").tolist(),
                insidetextanchor="start", insidetextfont={"color": "white"}, textangle=0,
                name=name, legendgroup=name, showlegend=name not in known,
                marker={"color": COLOUR.get(str(method))}, row=1, col=col,
            )  # fmt: skip
            known.add(name)
    figure.update_yaxes(range=[0, 1.08], tickformat=".0%")
    figure.update_xaxes(title="largest gust, widths of a frame", type="category")
    figure.update_annotations(font_size=13)
    return _below(styled(figure, "What the alarm is worth (whiskers: 95 % interval)", 480))


def drift(slopes: pd.DataFrame) -> go.Figure:
    """Growth of the position's error with the way flown, with 95 % intervals over flights."""
    figure = go.Figure()
    for k, (site, rows) in enumerate(slopes.groupby("site", sort=False)):
        order = list(COLOUR)
        rows = rows.sort_values("method", key=lambda names: names.map(order.index))
        slope, low, high = (
            np.arcsinh(rows[name].to_numpy(float))
            for name in ("slope_m_per_km", "slope_low", "slope_high")
        )
        figure.add_scatter(
            x=slope, y=[NAME.get(m, m) for m in rows["method"]], mode="markers", name=str(site),
            error_x={"array": high - slope, "arrayminus": slope - low},
            marker={"size": 10, "symbol": k, "color": [COLOUR.get(m) for m in rows["method"]]},
            customdata=rows[["slope_m_per_km", "routes"]],
            hovertemplate="%{customdata[0]:.2f} m/km, n = %{customdata[1]} routes<extra></extra>",
            showlegend=slopes["site"].nunique() > 1,
        )  # fmt: skip
    figure.add_vline(x=0, line={"color": "#555", "width": 1})
    figure.update_xaxes(
        title="growth of the error, m per km flown (linear near 0, logarithmic beyond)",
        tickvals=np.arcsinh(SLOPE_TICKS), ticktext=[str(v) for v in SLOPE_TICKS],
    )  # fmt: skip
    figure.update_yaxes(autorange="reversed", automargin=True)
    return styled(
        figure,
        f"Drift without gusts (n = {_count(slopes)} flights a method; 95 % over routes)",
        440,
    )


def time_parts(timing: pd.DataFrame, limit_ms: float = 50.0) -> go.Figure:
    """Median milliseconds of a step by part, and of the whole step, for each frame size."""
    figure = go.Figure()
    sizes = [f"{side} px" for side in sorted(timing["frame_px"].unique())]
    for part, colour in PART.items():
        rows = timing[timing["part"] == part].sort_values("frame_px")
        figure.add_bar(
            y=[f"{side} px" for side in rows["frame_px"]], x=rows["ms"], name=part,
            orientation="h", marker={"color": colour}, texttemplate="%{x:.1f}",
            hovertemplate=part + ": %{x:.2f} ms<extra></extra>",
        )  # fmt: skip
    whole = timing[timing["part"] == "whole step"]
    figure.add_scatter(
        y=[f"{side} px" for side in whole["frame_px"]], x=whole["ms"], mode="markers",
        name="whole step", marker={"symbol": "diamond", "size": 11, "color": "black"},
        hovertemplate="whole step: %{x:.2f} ms<extra></extra>",
    )  # fmt: skip
    figure.add_vline(
        x=limit_ms, line={"dash": "dash", "color": "#555"},
        annotation={"text": f"{limit_ms:g} ms", "yanchor": "bottom"},
    )  # fmt: skip
    figure.update_layout(barmode="stack", legend={"traceorder": "normal"})
    figure.update_xaxes(title="median ms of an ordinary step, one thread", rangemode="tozero")
    figure.update_yaxes(title="side of the frame", categoryorder="array", categoryarray=sizes)
    return _below(styled(figure, "Where the time of a step goes", 200 + 80 * len(sizes)))


def _panels(summary: pd.DataFrame) -> list[Panel]:
    """The summary by site and gust, with titles."""
    return [
        (f"{site}, {_gust(gust)}", rows)
        for (site, gust), rows in summary.groupby(["site", "gust"], sort=False)
    ]


def _by_method(panel: pd.DataFrame) -> Iterator[tuple[float, str, pd.DataFrame]]:
    """A method's rows from sun to sun, and by how much to move its marks aside."""
    present = set(panel["method"])
    methods = sorted((m for m in COLOUR if m in present), key=lambda m: m == ON_TOP)
    for k, method in enumerate(methods):
        rows = panel[panel["method"] == method].sort_values("sun_difference_deg")
        yield APART * (k - (len(methods) - 1) / 2), method, rows


def _look(method: str, known: set[str]) -> dict[str, object]:
    """Line and legend of a method; the legend names it once."""
    first = method not in known
    known.add(method)
    dash = "dot" if "odometry" in method or "off" in method else "solid"
    return {
        "mode": "lines+markers", "name": NAME.get(method, method), "legendgroup": method,
        "showlegend": first, "marker": {"size": 5},
        "line": {
            "color": COLOUR.get(method), "dash": dash, "width": 3 if method == ON_TOP else 1.5,
        },
    }  # fmt: skip


def _gust(gust: float) -> str:
    return f"gust up to {gust:g} frame" if gust else "no gust"


def _count(table: pd.DataFrame) -> str:
    low, high = int(table["flights"].min()), int(table["flights"].max())
    return str(low) if low == high else f"{low} to {high}"


def _below(figure: go.Figure) -> go.Figure:
    """The legend under the figure."""
    legend = {"orientation": "h", "yref": "container", "y": 0.0, "yanchor": "bottom", "x": 0}
    return figure.update_layout(legend=legend, margin={"b": 130})
