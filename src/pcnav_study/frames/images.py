"""A frame's pixels and its metadata."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import rasterio
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError
from PIL.ExifTags import IFD
from rasterio.enums import ColorInterp
from rasterio.errors import NotGeoreferencedWarning, RasterioError

from pcnav_study.errors import InputError

_EXIF = {
    "model": 0x0110,
    "focal_mm": 0x920A,
    "focal_35mm": 0xA405,
    "time": 0x9003,
    "utc_offset": 0x9011,
}
_UNREADABLE = (OSError, UnidentifiedImageError, ValueError, SyntaxError, RasterioError)


def read_grey(path: Path) -> NDArray[np.float32]:
    """Mean of a frame's colour bands, (rows, columns); no-data pixels are NaN.

    TIFF is read through GDAL, for its bands and no-data value; the rest through Pillow.

    Raises
    ------
    InputError
        If the file is no image, is truncated, or is larger than Pillow's safe size.
    """
    try:
        if path.suffix.lower() in {".tif", ".tiff"}:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", NotGeoreferencedWarning)
                with rasterio.open(path) as raster:
                    _refuse_bomb(raster.width * raster.height)
                    bands = raster.read(colour_bands(raster), masked=True).astype(np.float32)
            return np.asarray(bands.filled(np.nan).mean(axis=0), np.float32)
        with Image.open(path) as image:
            image.load()
            if image.mode == "F" or image.mode.startswith("I"):  # RGB would clip it at 255
                return np.asarray(image, np.float32)
            colours = np.asarray(image.convert("RGB"), np.float32)
        return np.asarray(colours.mean(axis=2), np.float32)
    except Image.DecompressionBombError as error:
        raise InputError(f"{path.name} is too large to open safely; down-sample it") from error
    except _UNREADABLE as error:
        raise InputError(f"{path.name} cannot be read as an image ({error}); replace it") from error


def read_metadata(path: Path) -> dict[str, Any]:
    """EXIF and XMP values of a frame, under plain names; empty where it carries none.

    Keys, each only if present: ``shape`` (rows, columns), ``model``, ``focal_mm``,
    ``focal_35mm``, ``time``, ``utc_offset``, ``gps_time`` (UTC), ``latitude``, ``longitude``,
    ``altitude``, and ``xmp``, a flat dictionary of the XMP attributes.
    """
    if path.suffix.lower() in {".tif", ".tiff"}:
        return {}
    try:
        with Image.open(path) as image:
            exif = image.getexif()
            details, gps = exif.get_ifd(IFD.Exif), exif.get_ifd(IFD.GPSInfo)
            found: dict[str, Any] = {"shape": (image.height, image.width)}
            try:
                found["xmp"] = _flat(image.getxmp())
            except _UNREADABLE:  # malformed or hostile XML costs the XMP alone
                found["xmp"] = {}
    except (*_UNREADABLE, Image.DecompressionBombError):
        return {}
    for name, tag in _EXIF.items():
        value = details.get(tag, exif.get(tag))
        if value is not None:
            text = not name.startswith("focal")
            found[name] = str(value).strip("\x00 ") if text else _number(value)
    for name, value_tag, sign_tag in (("latitude", 2, 1), ("longitude", 4, 3)):
        angle = gps.get(value_tag, ())
        if isinstance(angle, tuple) and len(angle) == 3:
            degrees, minutes, seconds = (_number(v) for v in angle)
            sign = -1 if str(gps.get(sign_tag, "")).upper() in {"S", "W"} else 1
            found[name] = sign * (degrees + minutes / 60 + seconds / 3600)
    if 6 in gps:
        below = gps.get(5, b"\x00") in (b"\x01", 1)
        found["altitude"] = _number(gps[6]) * (-1 if below else 1)
    stamp = _gps_time(gps)
    if stamp:
        found["gps_time"] = stamp
    return found


def _gps_time(gps: dict[int, Any]) -> str:
    """Date and time of the GPS fix, which is UTC; empty if not recorded."""
    date, clock = str(gps.get(29, "")).strip("\x00 "), gps.get(7)
    if len(date) != 10 or not isinstance(clock, tuple) or len(clock) != 3:
        return ""
    hours, minutes, seconds = (_number(value) for value in clock)
    if not np.isfinite([hours, minutes, seconds]).all():
        return ""
    day = date.replace(":", "-")
    return f"{day}T{int(hours):02d}:{int(minutes):02d}:{seconds:06.3f}+00:00"


def colour_bands(raster: rasterio.DatasetReader) -> list[int]:
    """Indices of a raster's first (up to three) bands that are no alpha band."""
    kinds = zip(raster.indexes, raster.colorinterp, strict=True)
    return [index for index, kind in kinds if kind != ColorInterp.alpha][:3]


def _refuse_bomb(pixels: int) -> None:
    """Pillow's own rule, for images that Pillow does not open."""
    if Image.MAX_IMAGE_PIXELS is not None and pixels > 2 * Image.MAX_IMAGE_PIXELS:
        raise Image.DecompressionBombError(f"{pixels} px")


def _number(value: Any) -> float:
    """A number out of EXIF; NaN for what is none."""
    try:
        return float(value)
    except (TypeError, ValueError, ZeroDivisionError):
        return float("nan")


def _flat(tree: Any) -> dict[str, str]:
    """Leaves of a nested XMP dictionary, by their own names."""
    flat: dict[str, str] = {}
    for name, value in tree.items() if isinstance(tree, dict) else []:
        for item in value if isinstance(value, list) else [value]:
            flat.update(_flat(item) if isinstance(item, dict) else {name: str(item)})
    return flat
