"""Success and error by azimuth and zenith difference, and curves of what breaks a method."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from pcnav_study.figures.style import COLOUR, NAME, styled

UNIT = {
    "noise": "noise, share of the picture's standard deviation",
    "size": "window side, px",
    "rotation": "residual rotation, deg",
    "scale": "residual scale",
    "relief_displacement": "relief displacement, px per sigma of height",
    "albedo_change": "share of the reflectance that is new",
}


def light_maps(table: pd.DataFrame, value: str, title: str) -> go.Figure:
    """A map for each method: ``success`` or ``rmse_px`` by azimuth difference and zenith."""
    methods = list(dict.fromkeys(table["method"]))
    figure = make_subplots(
        2, (len(methods) + 1) // 2, subplot_titles=[NAME.get(m, m) for m in methods],
        horizontal_spacing=0.07, vertical_spacing=0.2,
    )  # fmt: skip
    columns = (len(methods) + 1) // 2
    for k, method in enumerate(methods):
        rows = table[table["method"] == method]
        weights = rows["n"] * (rows["success"] if value == "rmse_px" else 1)
        power = 2 if value == "rmse_px" else 1
        amount = (rows[value].fillna(0) ** power * weights).rename("amount")
        keyed = rows[["moving_zenith", "azimuth_difference"]].assign(amount=amount, weight=weights)
        sums = keyed.groupby(["moving_zenith", "azimuth_difference"]).sum()
        with np.errstate(invalid="ignore"):
            mean = (sums["amount"] / sums["weight"]) ** (1 / power)
        grid = mean.unstack()
        text = grid.map(lambda v: "-" if np.isnan(v) else f"{v:.2f}")
        figure.add_heatmap(
            x=[f"{v:.0f}" for v in grid.columns],
            y=[f"{v:.0f}" for v in grid.index],
            z=grid.to_numpy(),
            text=text.to_numpy(),
            texttemplate="%{text}",
            zmin=0,
            zmax=1 if value == "success" else 0.5,
            colorscale="RdYlGn" if value == "success" else "YlOrRd",
            showscale=False,
            hovertemplate="azimuth %{x}°, zenith %{y}°: %{z:.3f}<extra></extra>",
            row=k // columns + 1,
            col=k % columns + 1,
        )
    figure.update_xaxes(title="azimuth difference, deg")
    figure.update_yaxes(title="zenith of the frame's sun, deg")
    return styled(figure, title, 560)


def sweep_curves(table: pd.DataFrame, varied: str, level: float = 0.95) -> go.Figure:
    """Success of every method over one swept quantity, one panel an azimuth difference."""
    swept = table[table["varied"] == varied]
    differences = sorted(swept["azimuth_difference"].unique())
    titles = [f"suns {difference:.0f}° apart" for difference in differences]
    figure = make_subplots(1, len(differences), subplot_titles=titles, shared_yaxes=True)
    for col, difference in enumerate(differences, 1):
        for name, rows in swept[swept["azimuth_difference"] == difference].groupby(
            "method", sort=False
        ):
            method = str(name)
            hits = rows.assign(hits=rows["success"] * rows["n"]).groupby(varied)[["hits", "n"]]
            total = hits.sum()
            figure.add_scatter(
                x=total.index,
                y=total["hits"] / total["n"],
                mode="lines+markers",
                name=NAME.get(method, method),
                legendgroup=method,
                showlegend=col == 1,
                line={"color": COLOUR.get(method)},
                row=1,
                col=col,
            )
        figure.add_hline(y=level, line={"dash": "dot", "color": "#888"}, row=1, col=col)
    figure.update_xaxes(title=UNIT[varied])
    if varied == "size":
        figure.update_xaxes(autorange="reversed")
    figure.update_yaxes(range=[-0.03, 1.05], tickformat=".0%")
    n = int(swept.groupby(["method", "azimuth_difference", varied])["n"].sum().max())
    return styled(figure, f"Success within 1 px (n = {n} a point)", 360)
