"""Relief, shading, and the slope-aspect-intensity surface."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from pcnav_study.figures.style import styled
from pcnav_study.scene import SunPosition


def image_row(
    images: Mapping[str, NDArray[np.floating]],
    title: str,
    *,
    aspect: float = 1.0,
    colours: str = "gray",
    unit: str = "",
    height: int = 380,
) -> go.Figure:
    """Images side by side, each with its own grey range; ``aspect`` is dy / dx of a pixel."""
    figure = make_subplots(1, len(images), subplot_titles=list(images), horizontal_spacing=0.03)
    for k, image in enumerate(images.values(), 1):
        low, high = np.nanpercentile(image, [1, 99])
        figure.add_heatmap(
            z=np.asarray(image, np.float32),
            colorscale=colours,
            zmin=low,
            zmax=high,
            showscale=False,
            hovertemplate=f"row %{{y}}, column %{{x}}: %{{z:.3g}} {unit}<extra></extra>",
            row=1,
            col=k,
        )
        anchor = "x" if k == 1 else f"x{k}"
        figure.update_yaxes(
            autorange="reversed", scaleanchor=anchor, scaleratio=aspect, constrain="domain",
            showticklabels=k == 1, title="row, px" if k == 1 else None, row=1, col=k,
        )  # fmt: skip
        figure.update_xaxes(constrain="domain", title="column, px", row=1, col=k)
    return styled(figure, title, height)


def slope_aspect_surface(
    suns: list[SunPosition],
    slope: NDArray[np.floating],
    aspect: NDArray[np.floating],
    intensities: list[NDArray[np.floating]],
    *,
    points: int = 2500,
    seed: int = 0,
) -> go.Figure:
    """Intensity over slope and aspect: the Lambertian surface, and the image's own pixels.

    A slider moves the sun through ``suns``; ``intensities`` hold the image under each.
    """
    s, a = np.meshgrid(np.linspace(0, 60, 31), np.linspace(0, 360, 73))
    pick = np.random.default_rng(seed).choice(slope.size, min(points, slope.size), replace=False)
    figure = go.Figure()
    for sun, image in zip(suns, intensities, strict=True):
        zenith = np.radians(sun.zenith)
        facing = np.cos(np.radians(sun.azimuth - a))
        surface = (
            np.cos(zenith) * np.cos(np.radians(s)) + np.sin(zenith) * np.sin(np.radians(s)) * facing
        )
        figure.add_surface(
            x=a[:, 0], y=s[0], z=np.maximum(surface, 0).T.astype(np.float32), opacity=0.65,
            colorscale="Cividis", cmin=0, cmax=1, visible=False, colorbar={"title": "intensity"},
            name="Lambert",
        )  # fmt: skip
        figure.add_scatter3d(
            x=aspect.ravel()[pick].astype(np.float32),
            y=slope.ravel()[pick].astype(np.float32),
            z=image.ravel()[pick].astype(np.float32),
            mode="markers", marker={"size": 1.6, "color": "#D55E00"}, visible=False,
            name=f"{len(pick)} pixels of the image",
        )  # fmt: skip
    steps = []
    for k, sun in enumerate(suns):
        shown = [i // 2 == k for i in range(2 * len(suns))]
        label = f"{sun.azimuth:.0f}°/{sun.zenith:.0f}°"
        steps.append({"label": label, "method": "update", "args": [{"visible": shown}]})
    figure.data[0].visible = figure.data[1].visible = True
    figure.update_layout(
        sliders=[{"steps": steps, "currentvalue": {"prefix": "sun azimuth/zenith: "}}],
        showlegend=False,
        scene={
            "xaxis": {"title": "aspect, deg from north", "dtick": 90},
            "yaxis": {"title": "slope, deg"},
            "zaxis": {"title": "intensity", "range": [0, 1.05]},
            "camera": {"eye": {"x": -1.5, "y": -1.6, "z": 0.9}},
        },
    )
    return styled(figure, "Slope-aspect-intensity surface", 560)
