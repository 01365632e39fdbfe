"""Windows of maps and elevation models, on the grid they are wanted on.

GDAL's warped virtual raster reads only what the window needs, through overviews where the
map has them, from any CRS and any geotransform.
"""

from __future__ import annotations

import warnings

import numpy as np
import rasterio
import xarray as xr
from numpy.typing import NDArray
from pyproj import CRS, Transformer
from pyproj.aoi import AreaOfInterest
from pyproj.database import query_utm_crs_info
from pyproj.exceptions import ProjError
from rasterio.enums import ColorInterp, Resampling
from rasterio.errors import NotGeoreferencedWarning, RasterioIOError
from rasterio.vrt import WarpedVRT
from rasterio.warp import calculate_default_transform
from scipy.ndimage import distance_transform_edt

from pcnav_study.errors import InputError
from pcnav_study.frames.images import colour_bands
from pcnav_study.scene.grid import Grid

VISIBLE_UM = (0.45, 0.70)


def open_map(path: str) -> rasterio.DatasetReader:
    """A raster to read from; raises InputError if it cannot be opened or has no CRS."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            raster = rasterio.open(path)
    except RasterioIOError as error:
        raise InputError(f"map {path} cannot be opened ({error}); check the path") from error
    if raster.crs is None:
        raster.close()
        raise InputError(
            f"map {path} has no CRS; assign one, as with: gdal_edit.py -a_srs EPSG:CODE {path}"
        )
    return raster


def metric_crs(path: str) -> tuple[str, float]:
    """A CRS in metres to work in, and the map's pixel size in it.

    The map's own CRS where that is projected in metres, otherwise the UTM zone of its middle.

    Raises
    ------
    InputError
        If the map cannot be opened or has no CRS.
    """
    with open_map(path) as raster:
        own = CRS.from_wkt(raster.crs.to_wkt())
        horizontal = own.sub_crs_list[0] if own.is_compound else own
        middle = raster.transform @ (raster.width / 2, raster.height / 2)
        if horizontal.is_projected and horizontal.axis_info[0].unit_conversion_factor == 1.0:
            return horizontal.to_wkt(), float(np.sqrt(abs(raster.transform.determinant)))
        try:
            lon, lat = Transformer.from_crs(horizontal, 4326, always_xy=True).transform(*middle)
            zone = query_utm_crs_info("WGS 84", AreaOfInterest(lon, lat, lon, lat))[0]
        except (ProjError, IndexError) as error:
            raise InputError(
                f"map {path} lies in no UTM zone; reproject it to a CRS in metres, with gdalwarp"
            ) from error
        utm = CRS.from_authority(zone.auth_name, zone.code)
        to_utm = Transformer.from_crs(horizontal, utm, always_xy=True)
        corners = [(raster.width / 2 + i, raster.height / 2 + j) for i, j in ((1, 0), (0, 1))]
        sides = [
            np.subtract(to_utm.transform(*(raster.transform @ corner)), to_utm.transform(*middle))
            for corner in corners
        ]
        return utm.to_wkt(), float(np.sqrt(abs(np.linalg.det(sides))))


def read_window(path: str, grid: Grid) -> NDArray[np.float32]:
    """Mean of a map's visible bands on ``grid``; NaN where it has no data.

    Where the grid is coarser than the map, map pixels are averaged, through overviews.
    """
    with open_map(path) as raster:
        missing = {"dtype": "float32", "nodata": np.nan}
        if ColorInterp.alpha in raster.colorinterp:
            missing = {}  # transparency says it
        elif raster.nodata is None:
            missing |= {"src_nodata": np.nan}
        shrinking = _pixel_side(raster, grid) < 0.9 * grid.pixel_size[0]
        with WarpedVRT(
            raster,
            crs=grid.crs,
            transform=grid.transform,
            height=grid.shape[0],
            width=grid.shape[1],
            resampling=Resampling.average if shrinking else Resampling.bilinear,
            **missing,
        ) as warped:
            bands = warped.read(visible_bands(raster), masked=True).astype(np.float32)
    return np.asarray(bands.filled(np.nan).mean(axis=0), np.float32)


def visible_bands(raster: rasterio.DatasetReader) -> list[int]:
    """Indices of the bands that a camera's red, green and blue come closest to.

    Bands tagged with a ``center_wavelength`` in the visible (0.45 to 0.70 micrometres; the
    coastal band below is haze); otherwise the first (up to three) that are no alpha band.
    """
    tagged = []
    for index in raster.indexes:
        try:
            wavelength = float(raster.tags(index)["center_wavelength"])
        except (KeyError, ValueError):
            continue
        if VISIBLE_UM[0] <= wavelength <= VISIBLE_UM[1]:
            tagged.append(index)
    return tagged or colour_bands(raster)


def _pixel_side(raster: rasterio.DatasetReader, grid: Grid) -> float:
    """Side of a raster's pixel in units of ``grid``, at the grid's middle."""
    x, y = grid.transform @ (grid.shape[1] / 2, grid.shape[0] / 2)
    dy, dx = grid.pixel_size
    if raster.crs is None or raster.crs == CRS(grid.crs):
        return float(np.sqrt(abs(raster.transform.determinant)))
    to_raster = Transformer.from_crs(grid.crs, raster.crs, always_xy=True)
    east, north = to_raster.transform([x, x + dx, x], [y, y, y - dy])
    sides = (
        np.array([np.diff(east[:2])[0], np.diff(north[:2])[0]]),
        np.array([east[2] - east[0], north[2] - north[0]]),
    )
    area = abs(float(np.linalg.det(np.stack(sides))))
    ratio = abs(raster.transform.determinant) / area if area > 0 and np.isfinite(area) else 1.0
    return float(np.sqrt(ratio * dx * dy))


def read_elevation(path: str) -> xr.DataArray:
    """A whole elevation model in metres, in a metric CRS; gaps at the nearest height.

    Raises
    ------
    InputError
        If it cannot be opened, has no CRS, or holds no height.
    """
    crs, _ = metric_crs(path)
    with open_map(path) as raster:
        transform, cols, rows = calculate_default_transform(
            raster.crs, crs, raster.width, raster.height, *raster.bounds
        )
    grid = Grid(transform, (int(rows or 0), int(cols or 0)), crs)
    heights = read_window(path, grid)
    missing = np.isnan(heights)
    if missing.all():
        raise InputError(f"elevation model {path} holds no height; check its no-data value")
    if missing.any():
        nearest = distance_transform_edt(missing, return_distances=False, return_indices=True)
        heights = heights[tuple(nearest)]
    return grid.image(heights, "elevation")
