"""Camera intrinsics from ``camera.json`` or from EXIF."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pcnav_study.errors import InputError
from pcnav_study.scene.camera import Camera
from pcnav_study.scene.distortion import Distortion

# Sensor widths in mm by EXIF model, from the makers' data sheets: the 35 mm equivalent
# is rounded and refers to the uncropped diagonal, so it is the second choice.
SENSOR_WIDTH_MM = {
    "FC7303": 6.17,  # DJI Mini 2
    "FC7203": 6.17,  # DJI Mavic Mini
    "FC220": 6.17,  # DJI Mavic Pro
    "FC330": 6.17,  # DJI Phantom 4
    "FC300X": 6.17,  # DJI Phantom 3 Professional
    "FC6310": 13.2,  # DJI Phantom 4 Pro
    "L1D-20c": 13.2,  # DJI Mavic 2 Pro
    "FC3170": 6.4,  # DJI Mavic Air 2
    "FC3411": 13.2,  # DJI Air 2S
}
_FULL_FRAME_WIDTH_MM = 36.0


def camera_from_file(path: Path) -> Camera:
    """A camera from JSON: image_size_px, focal_length_mm, sensor_size_mm.

    Sizes are (width, height); ``principal_point`` is (x right, y down), in px from the middle.
    ``type`` is "pinhole" (the default) or "brown"; the latter reads ``k1, k2, k3, p1, p2``,
    OpenCV's, zero where absent.

    Raises
    ------
    InputError
        Naming the missing or malformed key.
    """
    try:
        spec = json.loads(path.read_text())
        width, height = spec["image_size_px"]
        focal_px = spec["focal_length_mm"] / spec["sensor_size_mm"][0] * width
        x0, y0 = map(float, spec.get("principal_point", (0.0, 0.0)))
        kind = spec.get("type", "pinhole")
        lens = Distortion(*(float(spec.get(name, 0.0)) for name in Distortion._fields))
        lens = lens if kind == "brown" else Distortion()
        camera = Camera((int(height), int(width)), float(focal_px), (y0, x0), lens)
    except json.JSONDecodeError as error:
        raise InputError(f"{path} is not valid JSON ({error}); correct it") from error
    except KeyError as error:
        raise InputError(f"{path} lacks the key {error}; add it") from error
    except (TypeError, ValueError, IndexError, ZeroDivisionError) as error:
        raise InputError(f"{path} holds a malformed value ({error}); correct it") from error
    if kind not in {"pinhole", "brown"}:
        raise InputError(f"{path} asks for a {kind} camera; use pinhole or brown")
    return camera


def camera_from_metadata(metadata: dict[str, Any]) -> Camera:
    """A camera from a frame's EXIF focal length and the sensor table.

    Raises
    ------
    InputError
        If the frame carries no focal length.
    """
    if "shape" in metadata:
        rows, cols = metadata["shape"]
        sensor = SENSOR_WIDTH_MM.get(metadata.get("model", ""))
        if sensor and metadata.get("focal_mm"):
            return Camera((rows, cols), metadata["focal_mm"] / sensor * cols)
        if metadata.get("focal_35mm"):
            return Camera((rows, cols), metadata["focal_35mm"] / _FULL_FRAME_WIDTH_MM * cols)
    raise InputError("no focal length in its EXIF; describe the camera in camera.json")
