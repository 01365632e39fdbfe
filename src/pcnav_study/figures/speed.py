"""Time of every matcher, by window size."""

from __future__ import annotations

import pandas as pd
import plotly.graph_objects as go

from pcnav_study.figures.style import styled

WHOSE = {"study": "#CC79A7", "peer": "#0072B2", "paper": "#999999"}
LABEL = {"study": "this study", "peer": "peer library", "paper": "as the paper describes"}


def time_bars(table: pd.DataFrame) -> go.Figure:
    """Median time of a match by method and window size; whiskers reach the 95 % quantile."""
    figure = go.Figure()
    measured = table[table["n"] > 0]
    for whose, rows in measured.groupby("whose", sort=False):
        times = rows.groupby(["size", "method"], sort=False)[["median_ms", "p95_ms"]].median()
        times = times.reset_index()
        figure.add_bar(
            x=[times["size"].map("{} px".format).tolist(), times["method"].tolist()],
            y=times["median_ms"],
            error_y={"array": times["p95_ms"] - times["median_ms"], "arrayminus": [0] * len(times)},
            name=LABEL[str(whose)],
            marker={"color": WHOSE[str(whose)]},
            hovertemplate="%{x}: %{y:.3g} ms<extra></extra>",
        )
    figure.update_yaxes(type="log", title="ms a match (log)")
    figure.update_xaxes(tickangle=-60)
    return styled(figure, "Median time of a match, one thread; whisker to 95 %", 560)
