"""netCDF files as xarray objects."""

from __future__ import annotations

import xarray as xr

from pcnav_study.datasets._local import LocalVersionedDataset

_KIND = "pcnav_kind"
_ALONE = "pcnav_values"


class NetCDFDataset(LocalVersionedDataset):
    """A Dataset or DataArray as a netCDF 4 file; it comes back as the one it was.

    Values are neither scaled nor masked on the way: a uint8 band with a fill value stays
    uint8. A DataArray keeps its name, CRS and transform.
    """

    def load(self) -> xr.Dataset | xr.DataArray:
        """Read the file into memory."""
        data = xr.load_dataset(
            str(self._get_load_path()), engine="h5netcdf", mask_and_scale=False, decode_coords="all"
        )
        if data.attrs.pop(_KIND, "Dataset") == "Dataset":
            return data
        name = data.attrs.pop("pcnav_name", None)
        return data[_ALONE].rename(name)

    def save(self, data: xr.Dataset | xr.DataArray) -> None:
        """Write all variables, losslessly compressed."""
        if isinstance(data, xr.DataArray):
            marks = {_KIND: "DataArray"} | ({} if data.name is None else {"pcnav_name": data.name})
            data = data.to_dataset(name=_ALONE).assign_attrs(marks)
        encoding = {
            str(name): ({} if "_FillValue" in variable.attrs else {"_FillValue": None})
            | (
                {"zlib": True, "complevel": 1}
                if variable.ndim and variable.dtype.kind in "iuf"
                else {}
            )
            for name, variable in data.variables.items()
            if variable.dtype.kind not in "OUS"
        }
        data.drop_encoding().to_netcdf(self._target(), engine="h5netcdf", encoding=encoding)
