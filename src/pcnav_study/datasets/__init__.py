"""Versioned Kedro datasets for georeferenced images, and for logs.

The stock GeoTIFF dataset moves multiband rasters by half a pixel and cannot be versioned;
the stock netCDF one is not versioned; none writes a table row by row.
"""

from pcnav_study.datasets.geotiff import GeoTIFFDataset
from pcnav_study.datasets.json_lines import JSONLinesDataset
from pcnav_study.datasets.netcdf import NetCDFDataset

__all__ = ["GeoTIFFDataset", "JSONLinesDataset", "NetCDFDataset"]
