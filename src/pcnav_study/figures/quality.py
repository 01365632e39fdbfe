"""How far a quality can be trusted: reliability, ROC, evidence, mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import plotly.graph_objects as go
import xarray as xr
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from pcnav_study.figures.style import styled

Array = NDArray[np.float64]
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999")


def reliability_diagram(bins: pd.DataFrame, error: float) -> go.Figure:
    """Observed share of right matches over the stated probability, with 95 % intervals."""
    figure = go.Figure()
    figure.add_scatter(
        x=[0, 1], y=[0, 1], mode="lines", line={"dash": "dot", "color": "#888"}, showlegend=False
    )
    figure.add_scatter(
        x=bins["stated"],
        y=bins["observed"],
        error_y={
            "array": bins["high"] - bins["observed"],
            "arrayminus": bins["observed"] - bins["low"],
        },
        mode="markers+lines",
        text=[f"n = {n}" for n in bins["n"]],
        hovertemplate="stated %{x:.2f}, right %{y:.2f}, %{text}<extra></extra>",
        line={"color": PALETTE[0]},
        showlegend=False,
    )
    figure.update_xaxes(title="stated probability to be within 1 px", range=[-0.03, 1.03])
    figure.update_yaxes(title="observed share", range=[-0.03, 1.03])
    title = f"Reliability (n = {bins['n'].sum()}, expected calibration error {error:.3f})"
    return styled(figure, title)


def roc_curves(curves: Mapping[str, tuple[Array, Array, float]], title: str) -> go.Figure:
    """Right matches kept over wrong ones let through, both logarithmic from the good corner.

    ``curves`` holds, by name, the share of wrong ones let through, the share of right ones
    alarmed, and the area under the curve.
    """
    figure = go.Figure()
    for k, (name, (missed, false, area)) in enumerate(curves.items()):
        figure.add_scatter(
            x=np.maximum(missed, 1e-4),
            y=np.maximum(false, 1e-4),
            mode="lines",
            name=f"{name} (AUC {area:.4f})",
            line={"color": PALETTE[k % len(PALETTE)], "shape": "hv"},
        )
    axis = {"type": "log", "range": [-3.3, 0.05], "dtick": 1, "tickformat": ".1%"}
    figure.update_xaxes(title="missed alarms: wrong shifts let through", **axis)
    figure.update_yaxes(title="false alarms: right matches refused", **axis)
    return styled(figure, title, 460)


def null_histogram(qualities: Array, values: Array, density: Array, level: float) -> go.Figure:
    """Simulated qualities of unrelated windows, the density in theory, and the level."""
    figure = go.Figure()
    figure.add_histogram(
        x=qualities, histnorm="probability density", name="simulated", marker={"color": "#9ecae1"}
    )
    figure.add_scatter(x=values, y=density, mode="lines", name="theory", line={"color": "#D55E00"})
    figure.add_vline(x=level, line={"dash": "dot", "color": "#555"})
    figure.update_xaxes(title="Dirac-delta quality at one shift")
    figure.update_yaxes(title="density")
    return styled(figure, f"Unrelated windows (n = {len(qualities)}; dotted: exceeded by 1 %)", 360)


def evidence_by_distance(distance: Sequence[float], curves: Mapping[str, Array]) -> go.Figure:
    """Each kind of evidence as the claimed shift moves away from the truth."""
    figure = make_subplots(1, len(curves), subplot_titles=list(curves))
    for k, (_, values) in enumerate(curves.items(), 1):
        for line in values:
            figure.add_scatter(
                x=list(distance), y=line, mode="lines", showlegend=False,
                line={"color": PALETTE[0], "width": 1}, opacity=0.5, row=1, col=k,
            )  # fmt: skip
        figure.add_scatter(
            x=list(distance), y=np.median(values, axis=0), mode="lines", showlegend=False,
            line={"color": "#000", "width": 3}, row=1, col=k,
        )  # fmt: skip
    figure.update_xaxes(title="px off")
    count = len(next(iter(curves.values())))
    return styled(
        figure, f"Evidence for a shift that is so far off (n = {count}; bold: median)", 340
    )


def mistake_pictures(mistakes: xr.Dataset) -> go.Figure:
    """The windows of every case that the alarm gets wrong, reference above frame."""
    count = mistakes.sizes["case"]
    titles = []
    for k in range(count):
        one = mistakes.isel(case=k)
        verdict = "false alarm" if bool(one["alarm"]) else "missed"
        titles.append(
            f"{str(one['kind'].values).replace('_', ' ')}, {float(one['difference']):.0f}°<br>"
            f"off {float(one['error_px']):.2f} px: {verdict}<br>p = {float(one['probability']):.2f}"
        )
    figure = make_subplots(
        2, max(count, 1), subplot_titles=titles, horizontal_spacing=0.02, vertical_spacing=0.03
    )
    for k in range(count):
        for row, name in enumerate(("reference", "moving"), 1):
            image = mistakes[name].isel(case=k).values
            low, high = np.nanpercentile(image, [1, 99])
            figure.add_heatmap(
                z=image, colorscale="gray", zmin=low, zmax=high, showscale=False, row=row, col=k + 1
            )
    figure.update_xaxes(showticklabels=False, constrain="domain")
    figure.update_yaxes(showticklabels=False, autorange="reversed", constrain="domain")
    for k in range(2 * count):
        anchor = "x" if k == 0 else f"x{k + 1}"
        figure.layout["yaxis" if k == 0 else f"yaxis{k + 1}"].scaleanchor = anchor
    figure.update_annotations(font_size=11)
    styled(figure, "Cases it gets wrong: reference above, frame below", 480)
    return figure.update_layout(margin={"t": 120})
