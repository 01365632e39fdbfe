"""Versioned Kedro datasets for georeferenced images.

The stock GeoTIFF dataset moves multiband rasters by half a pixel and cannot be versioned;
the stock netCDF one is not versioned.
"""

from pcnav_study.datasets.geotiff import GeoTIFFDataset
from pcnav_study.datasets.netcdf import NetCDFDataset

__all__ = ["GeoTIFFDataset", "NetCDFDataset"]
