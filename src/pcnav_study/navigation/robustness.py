"""How much damage a real photograph bears before it is lost, and whether the alarm says so."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.frames.folder import FlightFolder
from pcnav_study.frames.images import read_grey, read_metadata
from pcnav_study.frames.poses import pose_records
from pcnav_study.navigation.localise import FlightSettings, localise_image
from pcnav_study.navigation.site import Site
from pcnav_study.quality.summary import wilson
from pcnav_study.scene.camera import Camera

Picture = NDArray[np.float32]
Damage = Callable[[Picture, float, np.random.Generator], Picture]


def resampled(image: Picture, factor: float, rng: np.random.Generator) -> Picture:
    """Magnified by ``factor``; the camera is told."""
    shape = tuple(max(1, round(n * factor)) for n in image.shape)
    grey = Image.fromarray(np.nan_to_num(image))
    small = grey.resize(
        shape[::-1], Image.Resampling.BOX if factor < 1 else Image.Resampling.BICUBIC
    )
    return np.asarray(small, np.float32)


def blurred(image: Picture, sigma: float, rng: np.random.Generator) -> Picture:
    """By a Gaussian of ``sigma`` px per 1000 px of the frame's width."""
    return np.asarray(ndimage.gaussian_filter(image, sigma * image.shape[1] / 1000), np.float32)


def compressed(image: Picture, quality: float, rng: np.random.Generator) -> Picture:
    """Through JPEG of that quality."""
    low, high = np.nanpercentile(image, [0.1, 99.9])
    grey = np.clip(np.nan_to_num((image - low) / max(high - low, 1e-9)) * 255, 0, 255)
    kept = io.BytesIO()
    Image.fromarray(grey.astype(np.uint8)).save(kept, "JPEG", quality=int(quality))
    with Image.open(kept) as again:
        return np.asarray(again, np.float32)


def clouded(image: Picture, share: float, rng: np.random.Generator) -> Picture:
    """With that share hidden under white, in soft lumps a fifth of the picture wide."""
    lumps = ndimage.gaussian_filter(rng.standard_normal((64, 64)), 6, mode="wrap")
    at = [np.linspace(0, 63, n) for n in image.shape]
    field = ndimage.map_coordinates(lumps, np.meshgrid(*at, indexing="ij"), order=1)
    cover = ndimage.gaussian_filter((field > np.quantile(field, 1 - share)).astype(np.float32), 2)
    return np.asarray(image * (1 - cover) + np.nanmax(image) * cover, np.float32)


DAMAGE: dict[str, Damage] = {
    "resampled": resampled,
    "blurred": blurred,
    "jpeg": compressed,
    "clouded": clouded,
}


def robustness_curves(
    folder: FlightFolder,
    settings: FlightSettings,
    *,
    levels: dict[str, list[float]],
    tolerance_m: float,
    every: int,
) -> pd.DataFrame:
    """Success and alarms by kind and level of damage.

    Parameters
    ----------
    levels : dict
        Levels by kind: a name in ``DAMAGE``, or "yaw": a standard deviation, in degrees, of
        an error of the heading.
    tolerance_m : float
        A frame counts as placed if found within this of where its undamaged self was found.
    every : int
        Use every such frame only.

    Returns
    -------
    DataFrame
        ``damage, level, n, success, success_low, success_high, alarm_rate, wrong_unalarmed,
        median_error_m``.

    Raises
    ------
    InputError
        For an unknown kind of damage, or a flight none of whose frames can be placed.
    """
    unknown = set(levels) - {*DAMAGE, "yaw"}
    if unknown:
        raise InputError(f"damage {unknown.pop()!r} is unknown; use {', '.join(DAMAGE)} or yaw")
    subset = replace(folder, frames=folder.frames[::every])
    cases = [(kind, level) for kind, values in levels.items() for level in values]
    rows = [row for row in _placements(subset, settings, cases)]
    if not rows:
        raise InputError(f"no frame of {folder.path} can be placed undamaged; see flight_positions")
    table = pd.DataFrame(rows)
    curves = []
    for (kind, level), group in table.groupby(["damage", "level"], sort=False):
        good = group["error_m"] <= tolerance_m
        low, high = wilson(int(good.sum()), len(group))
        curves.append(
            {
                "damage": kind,
                "level": level,
                "n": len(group),
                "success": float(good.mean()),
                "success_low": low,
                "success_high": high,
                "alarm_rate": float(group["alarm"].mean()),
                "wrong_unalarmed": int((~good & ~group["alarm"]).sum()),
                "median_error_m": float(group["error_m"].median()),
            }
        )
    return pd.DataFrame(curves)


def _placements(
    folder: FlightFolder, settings: FlightSettings, cases: Iterable[tuple[str, float]]
) -> Iterator[dict[str, object]]:
    """Every frame under every damage, from a prior wrong by the settings' offset."""
    site = Site(folder)
    metadata = {path.name: read_metadata(path) for path in folder.frames}
    records = pose_records(folder.frames, metadata, folder.camera_pose, folder.flight_log)
    rng = np.random.default_rng(settings.seed)
    for path in folder.frames:
        record = records[path.name]
        try:
            camera, recorded = site.camera(metadata[path.name]), site.position(record)
            image = read_grey(path)
            truth = localise_image(site, image, camera, record, recorded, settings)
        except InputError:
            continue
        if truth.alarm:
            continue
        for kind, level in cases:
            offset = settings.prior_offset_m * rng.standard_normal(2)
            believed = recorded[0] + float(offset[0]), recorded[1] + float(offset[1])
            seen, turned = image, record
            if kind == "yaw":
                turned = record.turned(level * float(rng.standard_normal()))
            else:
                seen = DAMAGE[kind](image, level, rng)
            eye = _fitting(camera, seen.shape)
            row = {"frame": path.name, "damage": kind, "level": level}
            try:
                fix = localise_image(site, seen, eye, turned, believed, settings)
            except InputError:
                yield row | {"error_m": np.inf, "alarm": True}
            else:
                error = float(np.hypot(*np.subtract(fix.position, truth.position)))
                yield row | {"error_m": error, "alarm": fix.alarm}


def _fitting(camera: Camera, shape: tuple[int, ...]) -> Camera:
    """The camera of the resampled picture."""
    factor = shape[1] / camera.shape[1]
    row, col = camera.principal_point
    return replace(
        camera,
        shape=(shape[0], shape[1]),
        focal_px=camera.focal_px * factor,
        principal_point=(row * factor, col * factor),
    )
