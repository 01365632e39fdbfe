"""How the matchers fare under changing suns."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
import plotly.graph_objects as go
import xarray as xr
from plotly.subplots import make_subplots

from pcnav_study.figures.style import COLOUR, NAME, styled


def success_by_sun(summary: pd.DataFrame, tolerance_px: float) -> go.Figure:
    """Share of correct matches over the sun's azimuth difference, with 95 % intervals."""
    figure = go.Figure()
    for k, (method, rows) in enumerate(summary.groupby("method", sort=False)):
        name = str(method)
        figure.add_scatter(
            x=rows["sun_difference_deg"] + 0.8 * k,
            y=rows["success"],
            error_y={
                "array": rows["success_high"] - rows["success"],
                "arrayminus": rows["success"] - rows["success_low"],
                "thickness": 1.2,
            },
            mode="lines+markers",
            name=NAME.get(name, name),
            line={"color": COLOUR.get(name)},
            customdata=rows["n"],
            hovertemplate="%{y:.0%} of %{customdata} frames<extra></extra>",
        )
    figure.update_xaxes(title="difference of sun azimuth, map to frame, deg (bins)")
    figure.update_yaxes(
        title=f"placed within {tolerance_px:g} px", range=[-0.03, 1.05], tickformat=".0%"
    )
    count = int(summary["n"].max())
    return styled(
        figure, f"Correct matches by sun difference (up to n = {count} a point, Wilson 95 %)"
    )


def error_by_sun(tables: Mapping[str, pd.DataFrame], tolerance_px: float) -> go.Figure:
    """Every match's error over the sun difference, on a logarithmic axis; alarms are crosses."""
    figure = go.Figure()
    for method, table in tables.items():
        symbol = np.where(table["alarm"], "x", "circle")
        figure.add_scatter(
            x=table["sun_difference"],
            y=np.maximum(table["error_px"], 1e-3),
            mode="markers",
            marker={"color": COLOUR.get(method), "symbol": symbol, "size": 7, "opacity": 0.75},
            name=NAME.get(method, method),
            text=table["frame"],
            customdata=table["quality"],
            hovertemplate="%{text}: %{y:.2f} px, quality %{customdata:.2f}<extra></extra>",
        )
    figure.add_hline(y=tolerance_px, line={"dash": "dot", "color": "#555"})
    figure.update_xaxes(title="difference of sun azimuth, map to frame, deg")
    figure.update_yaxes(title="error, px (log)", type="log", dtick=1)
    n = sum(len(table) for table in tables.values())
    return styled(figure, f"Error of every match (n = {n}; crosses raised the alarm)")


def match_pictures(
    pairs: xr.Dataset,
    surfaces: Mapping[str, xr.Dataset],
    tables: Mapping[str, pd.DataFrame],
    frame: str,
    aspect: float = 1.0,
) -> go.Figure:
    """One frame: map window, rectified frame, and each method's surface with truth and answer."""
    pair = pairs.sel(frame=frame)
    titles = ["map", "rectified frame", *(f"{name}: surface" for name in surfaces)]
    figure = make_subplots(1, len(titles), subplot_titles=titles, horizontal_spacing=0.025)
    for k, name in enumerate(("reference", "moving"), 1):
        image = pair[name].values
        low, high = np.nanpercentile(image, [1, 99])
        figure.add_heatmap(
            z=image, colorscale="gray", zmin=low, zmax=high, showscale=False, row=1, col=k
        )
    truth = float(pair["true_row"]), float(pair["true_col"])
    for k, (name, stack) in enumerate(surfaces.items(), 3):
        one = stack["surface"].sel(frame=frame)
        answer = tables[name].set_index("frame").loc[frame]
        found = float(answer["shift_row_px"]), float(answer["shift_col_px"])
        figure.add_heatmap(
            x=one["col"],
            y=one["row"],
            z=one.values,
            colorscale="Viridis",
            showscale=False,
            row=1,
            col=k,
        )
        for label, (y, x), symbol, colour in (
            ("true shift", truth, "circle-open", "#ffffff"),
            ("found shift", found, "x-thin-open", "#ff3030"),
        ):
            line = {"width": 2.5, "color": colour}
            figure.add_scatter(
                x=[x], y=[y], mode="markers", name=label, showlegend=k == 3, row=1, col=k,
                marker={"symbol": symbol, "size": 13, "color": colour, "line": line},
            )  # fmt: skip
    for k in range(1, len(titles) + 1):
        anchor = "x" if k == 1 else f"x{k}"
        figure.update_yaxes(
            autorange="reversed", scaleanchor=anchor, scaleratio=aspect, constrain="domain",
            showticklabels=k in (1, 3), row=1, col=k,
        )  # fmt: skip
        label = "column, px" if k < 3 else "column shift, px"
        figure.update_xaxes(constrain="domain", title=label, row=1, col=k)
    figure.update_layout(legend={"orientation": "h", "y": 1.36, "x": 0.43, "bgcolor": "#8899aa"})
    difference = float(pair["sun_difference"])
    return styled(figure, f"{frame}: sun {difference:.0f}° from the map's", 330)
