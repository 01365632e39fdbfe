"""What a report shows of a flight: the map under it, and a handful of frames in four views."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_grey
from pcnav_study.frames.maps import read_window
from pcnav_study.navigation.localise import Fix
from pcnav_study.scene.grid import Grid

SIDE = 160  # px of each picture
MAP_SIDE = 640  # px of the map's longer side
BORDER = 0.05
VIEWS = ("picture", "rectified", "reference", "surface")


def flight_pictures(
    folder: FlightFolder, table: pd.DataFrame, fixes: Mapping[str, Fix], number: int
) -> xr.Dataset:
    """Pictures for the report.

    Parameters
    ----------
    table : DataFrame
        As ``flight_table`` gives it.
    fixes : mapping
        Of the placed frames, by name; may be empty.
    number : int
        Frames to show: the worst alarm first, then evenly along the flight.

    Returns
    -------
    Dataset
        ``picture``, ``rectified``, ``reference``, ``surface`` (frame, row, col), each fitted
        into a square, NaN around it; and ``map`` (north, east), with its coordinates in metres.
    """
    names = _chosen(table, fixes, number)
    views: dict[str, list[NDArray[np.float32]]] = {view: [] for view in VIEWS}
    paths = {path.name: path for path in folder.frames}
    for name in names:
        fix = fixes[name]
        margin = (fix.fine.window.shape[0] - fix.fine.patch.shape[0]) // 2
        inside = np.s_[margin:-margin, margin:-margin]
        views["picture"].append(fitted(read_grey(paths[name])))
        views["rectified"].append(fitted(fix.fine.patch))
        views["reference"].append(fitted(fix.fine.window[inside]))
        views["surface"].append(fitted(np.asarray(fix.coarse.result.surface.values, np.float32)))
    dims = ("frame", "row", "col")
    empty = np.empty((0, SIDE, SIDE), np.float32)
    data = {view: (dims, np.stack(kept) if kept else empty) for view, kept in views.items()}
    pictures = xr.Dataset(data, coords={"frame": names})
    return _map_under(folder, fixes).merge(pictures) if fixes else pictures


def fitted(image: NDArray[np.floating], side: int = SIDE) -> NDArray[np.float32]:
    """An image shrunk or stretched into a square, in its own proportions; NaN around it."""
    factor = max(1, max(image.shape) // side)
    rows, cols = (n // factor * factor for n in image.shape)
    blocks = image[:rows, :cols].reshape(rows // factor, factor, cols // factor, factor)
    small = np.asarray(blocks.mean(axis=(1, 3)), np.float32)
    zoom = side / max(small.shape)
    middle = (np.array(small.shape) - 1) / 2
    at = (np.indices((side, side)) - (side - 1) / 2) / zoom + middle[:, None, None]
    return np.asarray(ndimage.map_coordinates(small, at, order=1, cval=np.nan), np.float32)


def _chosen(table: pd.DataFrame, fixes: Mapping[str, Fix], number: int) -> list[str]:
    placed = table[table["frame"].isin(list(fixes))]
    if placed.empty or number < 1:
        return []
    alarmed = placed[placed["alarm"].astype(bool)].sort_values("agreement")["frame"]
    along = placed["frame"].iloc[
        np.linspace(0, len(placed) - 1, min(number, len(placed))).astype(int)
    ]
    first = [str(name) for name in alarmed.iloc[:1]]
    names = list(dict.fromkeys([*first, *map(str, along)]))
    return names[:number]


def _map_under(folder: FlightFolder, fixes: Mapping[str, Fix]) -> xr.Dataset:
    """The reference under all footprints, at a screen's sharpness."""
    corners = np.concatenate([fix.footprint for fix in fixes.values()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    low, high = low - BORDER * (high - low), high + BORDER * (high - low)
    pixel = float((high - low).max()) / MAP_SIDE
    cols, rows = (max(1, int(side / pixel)) for side in high - low)
    crs = next(iter(fixes.values())).fine.grid.crs
    middle = (low + high) / 2
    grid = Grid.centred(middle[0], middle[1], (pixel, pixel), (rows, cols), crs)
    north, east = grid.coordinates()
    image = read_window(folder.reference, grid)
    data, coords = {"map": (("north", "east"), image)}, {"north": north, "east": east}
    return xr.Dataset(data, coords, attrs={"crs": crs})
