"""GeoTIFF files as DataArrays."""

from __future__ import annotations

import json
from typing import Any

import rasterio
import xarray as xr

from pcnav_study.datasets._local import LocalVersionedDataset
from pcnav_study.errors import InputError
from pcnav_study.scene.grid import Grid

_TAG = "PCNAV_DATAARRAY"  # name, dims and attributes, as JSON: GDAL tags are text alone


class GeoTIFFDataset(LocalVersionedDataset):
    """A DataArray (y, x) or (band, y, x) with CRS and transform, as a GeoTIFF.

    Values, dtype, dims, band coordinate, transform, CRS, no-data value and (JSON-like)
    attributes come back as they were saved. A file of other makers with one band loads
    as (y, x); its tags become attributes.
    """

    def load(self) -> xr.DataArray:
        """Read the raster into memory."""
        with rasterio.open(str(self._get_load_path())) as source:
            if source.crs is None:
                raise InputError(f"{source.name} has no CRS; assign one, as with gdal_edit -a_srs")
            tags = source.tags()
            default: dict[str, Any] = {
                "name": None,
                "attrs": {k: v for k, v in tags.items() if k != _TAG},
            }
            memo: dict[str, Any] = json.loads(tags[_TAG]) if _TAG in tags else default
            flat = memo.get("dims", 2 if source.count == 1 else 3) == 2
            values = source.read(1) if flat else source.read()
            grid = Grid(source.transform, source.shape, source.crs.to_wkt())
            image = grid.image(values, memo["name"])
            nodata = source.nodata
        if "bands" in memo:
            image = image.assign_coords(band=memo["bands"])
        image.attrs.update(memo["attrs"])
        return image if nodata is None else image.rio.write_nodata(nodata)

    def save(self, data: xr.DataArray) -> None:
        """Write all bands, losslessly compressed."""
        grid = Grid.of(data)
        nodata = data.rio.nodata
        attrs = {k: v for k, v in data.attrs.items() if k not in ("grid_mapping", "_FillValue")}
        memo: dict[str, Any] = {"name": data.name, "dims": data.ndim, "attrs": attrs}
        if "band" in data.coords:
            memo["bands"] = data["band"].values.tolist()
        bands = data.values.reshape(-1, *grid.shape)
        with rasterio.open(
            self._target(),
            "w",
            driver="GTiff",
            height=grid.shape[0],
            width=grid.shape[1],
            count=len(bands),
            dtype=data.dtype,
            crs=grid.crs,
            transform=grid.transform,
            nodata=nodata,
            compress="deflate",
        ) as target:
            target.write(bands)
            target.update_tags(**{_TAG: json.dumps(memo, sort_keys=True)})
