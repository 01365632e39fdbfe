"""A flight on its map, its frames in four views, and its errors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import plotly.graph_objects as go
import xarray as xr
from plotly.subplots import make_subplots
from pyproj import CRS, Transformer

from pcnav_study.figures.style import styled

RECORDED, FOUND, ALARM = "#56B4E9", "#00C08B", "#FF7F2A"  # seen on grey
TITLES = ("frame", "rectified", "map there", "score of every shift")


def flight_map(
    table: pd.DataFrame, footprints: Mapping[str, Any], pictures: xr.Dataset
) -> go.Figure:
    """Recorded route, footprints, found camera positions and alarms over the reference."""
    figure = go.Figure()
    if "map" in pictures:
        image = pictures["map"]
        low, high = np.nanpercentile(image.values, [1, 99])
        figure.add_heatmap(
            x=image["east"].values, y=image["north"].values, z=image.values, colorscale="gray",
            zmin=low, zmax=high, showscale=False, hoverinfo="skip", name="map",
        )  # fmt: skip
    placed = table[table["easting"].notna()]
    for alarmed, colour, name in ((False, FOUND, "footprint"), (True, ALARM, "footprint, alarm")):
        x, y = _rings(footprints, str(pictures.attrs.get("crs", "")), alarmed)
        if x:
            figure.add_scatter(
                x=x, y=y, mode="lines", line={"color": colour, "width": 1}, opacity=0.55,
                name=name, hoverinfo="skip",
            )  # fmt: skip
    recorded = table[table["recorded_easting"].notna()]
    figure.add_scatter(
        x=recorded["recorded_easting"], y=recorded["recorded_northing"], mode="lines+markers",
        line={"color": RECORDED, "width": 1.2, "dash": "dot"}, marker={"size": 5},
        name="recorded route", text=recorded["frame"],
        hovertemplate="%{text}, recorded<extra></extra>",
    )  # fmt: skip
    for alarmed, colour, symbol, name in (
        (False, FOUND, "circle", "found camera"), (True, ALARM, "x", "found camera, alarm"),
    ):  # fmt: skip
        rows = placed[placed["alarm"].astype(bool) == alarmed]
        figure.add_scatter(
            x=rows["easting"], y=rows["northing"], mode="markers", name=name,
            marker={"color": colour, "symbol": symbol, "size": 9,
                    "line": {"width": 1, "color": "white"}},
            text=rows["frame"] + ": " + rows["status"],
            customdata=rows[["error_m", "quality", "agreement"]],
            hovertemplate="%{text}<br>error %{customdata[0]:.1f} m, quality %{customdata[1]:.3f}, "
            "parts agreeing %{customdata[2]:.0%}<extra></extra>",
        )  # fmt: skip
    figure.update_xaxes(title="east, m", constrain="domain", tickformat="d")
    figure.update_yaxes(title="north, m", scaleanchor="x", constrain="domain", tickformat="d")
    figure.update_layout(legend={"orientation": "h", "y": 1.06})
    return styled(figure, f"{len(placed)} of {len(table)} frames on the map", 720)


def frame_pictures(pictures: xr.Dataset, frame: str, status: str) -> go.Figure:
    """One frame: as taken, rectified, the map where it was found, and the coarse surface."""
    one = pictures.sel(frame=frame)
    figure = make_subplots(1, 4, subplot_titles=TITLES, horizontal_spacing=0.02)
    for k, view in enumerate(("picture", "rectified", "reference", "surface"), 1):
        image = one[view].values
        low, high = np.nanpercentile(image, [1, 99 if k < 4 else 100])
        figure.add_heatmap(
            z=image, colorscale="gray" if k < 4 else "Viridis", zmin=low, zmax=high,
            showscale=False, hoverinfo="skip", row=1, col=k,
        )  # fmt: skip
        anchor = "x" if k == 1 else f"x{k}"
        figure.update_yaxes(
            autorange="reversed",
            scaleanchor=anchor,
            constrain="domain",
            visible=False,
            row=1,
            col=k,
        )
        figure.update_xaxes(constrain="domain", visible=False, row=1, col=k)
    return styled(figure, f"{frame}: {status}", 300)


def flight_errors(table: pd.DataFrame) -> go.Figure:
    """Distance of every found position from the recorded one, in the order of the flight."""
    placed = table[table["error_m"].notna()]
    alarmed = placed["alarm"].astype(bool)
    figure = go.Figure(
        go.Bar(
            x=placed["frame"],
            y=np.maximum(placed["error_m"].astype(float), 0.01),
            marker={"color": np.where(alarmed, ALARM, FOUND)},
            text=np.where(alarmed, "alarm", ""),
            hovertemplate="%{x}: %{y:.2f} m<extra></extra>",
        )
    )
    figure.update_yaxes(title="found less recorded, m (log)", type="log")
    return styled(figure, f"Distance from the recorded position (n = {len(placed)})")


def _rings(
    footprints: Mapping[str, Any], crs: str, alarmed: bool
) -> tuple[list[float | None], list[float | None]]:
    """Footprint outlines in the flight's CRS, as one broken line."""
    x: list[float | None] = []
    y: list[float | None] = []
    if not crs:
        return x, y
    to_map = Transformer.from_crs(4326, CRS(crs), always_xy=True)
    for feature in footprints["features"]:
        if bool(feature["properties"]["alarm"]) != alarmed:
            continue
        ring = np.array(feature["geometry"]["coordinates"][0])
        east, north = to_map.transform(ring[:, 0], ring[:, 1])
        x += [*map(float, east), None]
        y += [*map(float, north), None]
    return x, y
