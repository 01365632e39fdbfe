"""Window pairs: each frame on the map's own pixels, beside the map where it should be."""

from __future__ import annotations

import numpy as np
import xarray as xr

from pcnav_study.errors import InputError
from pcnav_study.frames.rectify import rectify
from pcnav_study.progress import progress
from pcnav_study.scene.camera import Camera, Pose
from pcnav_study.scene.grid import Grid


def window_pairs(
    flight: xr.Dataset,
    reference: xr.DataArray,
    elevation: xr.DataArray,
    *,
    size: int,
    relief: bool = True,
) -> xr.Dataset:
    """Rectify every frame around its believed position.

    The windows lie on whole pixels of the map, so the map is never resampled.

    Parameters
    ----------
    flight : Dataset
        As ``scene.flight.fly`` gives it.
    reference, elevation : DataArray (y, x)
        On one grid, in metres.
    size : int
        Side of the square windows, px.
    relief : bool
        Rectify over the elevation; otherwise over level ground at its mean.

    Returns
    -------
    Dataset
        ``reference`` and ``moving`` (frame, row, col), float32; the true shift in px
        ``true_row``, ``true_col``; and the flight's columns.

    Raises
    ------
    InputError
        If a window would leave the map.
    """
    grid = Grid.of(reference)
    camera = Camera((flight.sizes["row"], flight.sizes["col"]), float(flight.attrs["focal_px"]))
    level = float(elevation.mean())
    moving, windows, truth = [], [], []
    for name in progress(flight["frame"].values, "rectifying", flight.sizes["frame"]):
        one = flight.sel(frame=name)
        believed = float(one["believed_east"]), float(one["believed_north"])
        row, col = (int(np.rint(v)) - size // 2 for v in grid.row_col(*believed))
        if min(row, col) < 0 or row + size > grid.shape[0] or col + size > grid.shape[1]:
            raise InputError(
                f"the window of frame {name!r} leaves the map; shorten the route or lower "
                "rectify.window_px"
            )
        part = np.s_[row : row + size, col : col + size]
        pose = Pose.from_yaw_pitch_roll(
            (*believed, float(one["height"])),
            float(one["yaw"]),
            float(one["pitch"]),
            float(one["roll"]),
        )
        ground = elevation.values[part].astype(np.float64) if relief else level
        patch_grid = grid.window(row, col, (size, size))
        moving.append(rectify(one["frames"].values, camera, pose, patch_grid, ground))
        windows.append(reference.values[part].astype(np.float32))
        dy, dx = grid.pixel_size
        truth.append(
            [(believed[1] - float(one["north"])) / dy, (float(one["east"]) - believed[0]) / dx]
        )
    dims = ("frame", "row", "col")
    true_row, true_col = np.array(truth).T
    return xr.Dataset(
        {"reference": (dims, np.stack(windows)), "moving": (dims, np.stack(moving))},
        coords=dict(flight.drop_vars("frames").coords)
        | {"true_row": ("frame", true_row), "true_col": ("frame", true_col)},
        attrs={"pixel_m": list(grid.pixel_size)},
    )
