"""Many pairs matched, as a table and a stack of surfaces."""

from __future__ import annotations

import numpy as np
import pandas as pd
import xarray as xr

from pcnav_study.matching import match
from pcnav_study.progress import progress
from pcnav_study.scene.sun import SunPosition

CARRIED = ("time", "waypoint", "sun_difference", "true_row", "true_col")


def match_pairs(
    pairs: xr.Dataset, method: str, max_shift: float | None, map_sun: SunPosition
) -> tuple[pd.DataFrame, xr.Dataset]:
    """Match every pair.

    Parameters
    ----------
    pairs : Dataset
        As ``frames.pairs.window_pairs`` gives it.
    method : str
        A name in ``METHODS``.
    max_shift : float or None
        Px.

    Returns
    -------
    table : DataFrame
        A row a frame: found and true shift, error in px and in metres, quality, candidates.
    surfaces : Dataset
        ``surface`` (frame, row, col), float32, over the shifts in its coordinates.
    """
    dy, dx = pairs.attrs["pixel_m"]
    rows, surfaces = [], []
    for k in progress(range(pairs.sizes["frame"]), f"matching by {method}"):
        pair = pairs.isel(frame=k)
        sun = SunPosition(float(pair["sun_azimuth"]), float(pair["sun_zenith"]))
        found = match(
            pair["reference"].values,
            pair["moving"].values,
            method,
            sun=(map_sun, sun),
            max_shift=max_shift,
            pixel_size=(dy, dx),
        )
        error = found.shift - [float(pair["true_row"]), float(pair["true_col"])]
        surfaces.append(found.surface)
        rows.append(
            {"frame": str(pair["frame"].values), "method": method}
            | {name: pair[name].item() for name in CARRIED}
            | {
                "shift_row_px": found.shift[0],
                "shift_col_px": found.shift[1],
                "error_px": float(np.hypot(*error)),
                "error_m": float(np.hypot(error[0] * dy, error[1] * dx)),
                "quality": found.quality,
                "candidates": found.surface.values.size,
            }
        )
    first = max(surfaces, key=lambda surface: surface.values.size)
    shifts = {
        name: first.origin[axis] + first.step * np.arange(first.values.shape[axis])
        for axis, name in enumerate(("row", "col"))
    }
    stack = np.stack([np.broadcast_to(s.values, first.values.shape) for s in surfaces])
    named = xr.Dataset(
        {"surface": (("frame", "row", "col"), stack.astype(np.float32))},
        coords={"frame": pairs["frame"].values} | shifts,
        attrs={"method": method},
    )
    return pd.DataFrame(rows), named
