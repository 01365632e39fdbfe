"""The cross-power spectrum under two suns, and what it does to the peak."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from pcnav_study.figures.style import styled

Array = NDArray[np.float64]


def signs_and_surface(
    labels: Sequence[str],
    measured: Sequence[Array],
    predicted: Sequence[Array],
    surfaces: Sequence[Array],
    title: str,
    *,
    frequency_step: float,
    prefix: str,
    first: int = 0,
) -> go.Figure:
    """A slider over cases: measured and predicted signs of the spectrum, and the surface.

    Parameters
    ----------
    measured, predicted : (rows, columns) each
        Real part of the spectrum without its fringes, -1 to 1, zero frequency in the middle.
    surfaces : (rows, columns) each
        Correlation around the true shift, which lies in the middle.
    frequency_step : float
        Distance of neighbouring frequencies, cycles/px.
    first : int
        The case shown first.
    """
    titles = ["measured sign", "predicted sign", "correlation around the true shift"]
    figure = make_subplots(1, 3, subplot_titles=titles, horizontal_spacing=0.07)
    for case in zip(measured, predicted, surfaces, strict=True):
        for k, image in enumerate(case, 1):
            rows, cols = image.shape
            limit = 1.0 if k < 3 else float(np.abs(image).max())
            step = 1 if k == 3 else frequency_step
            figure.add_heatmap(
                z=image.astype(np.float32),
                x=(np.arange(cols) - cols // 2) * step,
                y=(np.arange(rows) - rows // 2) * step,
                colorscale="RdBu",
                zmin=-limit,
                zmax=limit,
                showscale=k == 3,
                visible=False,
                row=1,
                col=k,
            )
    for k in range(1, 4):
        anchor = "x" if k == 1 else f"x{k}"
        unit = "cycles/px" if k < 3 else "shift, px"
        figure.update_yaxes(
            autorange="reversed", scaleanchor=anchor, constrain="domain", row=1, col=k
        )
        figure.update_xaxes(constrain="domain", title=f"column {unit}", row=1, col=k)
    figure.update_yaxes(title="row, cycles/px", row=1, col=1)
    steps = []
    for k, label in enumerate(labels):
        shown = [i // 3 == k for i in range(3 * len(labels))]
        steps.append({"label": label, "method": "update", "args": [{"visible": shown}]})
    for trace in figure.data[3 * first : 3 * first + 3]:
        trace.visible = True
    slider = {"steps": steps, "active": first, "currentvalue": {"prefix": prefix}, "pad": {"t": 45}}
    figure.update_layout(sliders=[slider])
    return styled(figure, title, 480)


def peak_by_azimuth(
    differences: Sequence[float], heights: Array, expected: Sequence[float]
) -> go.Figure:
    """Correlation at the true shift over azimuth difference: (differences, windows), theory."""
    figure = go.Figure()
    middle = np.median(heights, axis=1)
    low, high = np.quantile(heights, [0.1, 0.9], axis=1)
    figure.add_scatter(
        x=differences,
        y=middle,
        mode="lines+markers",
        name=f"median of {heights.shape[1]} windows, 10 to 90 %",
        error_y={"array": high - middle, "arrayminus": middle - low},
        line={"color": "#0072B2"},
    )
    figure.add_scatter(
        x=differences, y=expected, mode="lines", name="theory: mean of the signs",
        line={"color": "#555", "dash": "dash"},
    )  # fmt: skip
    figure.add_hline(y=0, line={"color": "#bbb"})
    figure.update_xaxes(title="azimuth difference, deg", dtick=30)
    figure.update_yaxes(title="correlation at the true shift")
    return styled(figure, "How the peak dies, and comes back upside down")
