"""Constants of an installation: where the camera looks, and where the map lies.

A camera that looks ahead, and a map that lies a few metres off, shift every position found
by the same amounts: the one turns with the aircraft, the other does not. Both are
estimated from frames whose position is known, robustly, and taken off the others [ours].

    found - recorded = heading (look_along, look_across) + (bias_east, bias_north)

Frames flown in one direction cannot tell the two apart; then all of it is called map bias,
which serves that direction.

References
----------
.. [1] Huber and Ronchetti (2009), Robust Statistics, section 7.8: iterated weights.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from pyproj import CRS, Transformer

from pcnav_study.errors import InputError

Array = NDArray[np.float64]
FOLDS = 5
LEAST_FRAMES = 4  # to fit four constants with a frame or two to spare
SAME_DIRECTION = 0.97  # length of the mean heading vector: within some 14 deg
MAD_TO_SIGMA = 1.4826
KEPT_SIGMAS = 3.0
SMALLEST_SIGMA_M = 0.05


@dataclass(frozen=True)
class Installation:
    """Metres that found positions lie off: along and across the heading, east and north.

    ``frames`` is how many they were estimated from, ``scatter_m`` the normalised median
    absolute deviation, per axis, of what they leave.
    """

    look_along_m: float = 0.0
    look_across_m: float = 0.0
    bias_east_m: float = 0.0
    bias_north_m: float = 0.0
    frames: int = 0
    scatter_m: float = 0.0

    def offsets(self, heading: ArrayLike) -> Array:
        """(n, 2) metres, east and north, that positions found at these headings lie off."""
        constants = [self.look_along_m, self.look_across_m, self.bias_east_m, self.bias_north_m]
        return np.asarray(_design(np.asarray(heading, float)) @ constants)

    @property
    def bias(self) -> Array:
        """(east, north) metres that the map lies off."""
        return np.array([self.bias_east_m, self.bias_north_m])

    @classmethod
    def read(cls, path: str | Path) -> Installation:
        """From a JSON file as the dataset ``flight_calibration`` has it.

        Raises
        ------
        InputError
            If there is no such file, or it holds something else.
        """
        try:
            known = json.loads(Path(path).read_text())
            return cls(**{k: v for k, v in known.items() if k in cls.__dataclass_fields__})
        except OSError as error:
            raise InputError(
                f"flight.calibration {path} cannot be opened; give none, cross-validate, or a "
                "file of constants"
            ) from error
        except (ValueError, AttributeError, TypeError) as error:
            raise InputError(
                f"{path} holds no installation constants ({error}); write it as flight_calibration"
            ) from error

    def as_dict(self) -> dict[str, float]:
        """For JSON."""
        return asdict(self)


def fit(misfit: ArrayLike, heading: ArrayLike, trusted: ArrayLike | None = None) -> Installation:
    """Constants from frames of known position.

    Least absolute distances of the trusted frames by iterated weights [1]_, then least
    squares over all frames within three scatters of that.

    Parameters
    ----------
    misfit : (n, 2)
        Found less recorded position, east and north, metres.
    heading : (n,)
        Of the image's top, degrees clockwise from north.
    trusted : (n,) bool, optional
        Frames without alarm; all by default.

    Raises
    ------
    InputError
        If there is no trusted frame.
    """
    misfit, heading = np.asarray(misfit, float).reshape(-1, 2), np.asarray(heading, float)
    sure = np.ones(len(misfit)) if trusted is None else np.asarray(trusted, float)
    if not sure.any():
        raise InputError("no frame without alarm to fit the calibration on; use calibration=none")
    design = _design(heading)
    if sure.sum() < LEAST_FRAMES or _one_direction(heading[sure > 0]):
        design[..., :2] = 0.0
    constants = _weighted(design, misfit, sure)
    for _ in range(50):
        distance = np.linalg.norm(misfit - design @ constants, axis=1)
        constants = _weighted(design, misfit, sure / np.maximum(distance, 1e-3))
    left = misfit - design @ constants
    sigma = max(_scatter(left[sure > 0]), SMALLEST_SIGMA_M)
    kept = np.linalg.norm(left, axis=1) <= KEPT_SIGMAS * np.sqrt(2) * sigma
    constants = _weighted(design, misfit, kept.astype(float))
    along, across, east, north = constants.tolist()
    return Installation(
        along, across, east, north, int(kept.sum()), _scatter((misfit - design @ constants)[kept])
    )


def cross_validated(misfit: ArrayLike, heading: ArrayLike, trusted: ArrayLike) -> Array:
    """(n, 2) metres each frame lies off, by constants fitted without its own fold.

    Every fifth frame is of a fold; of fewer than five frames each is a fold by itself.

    Parameters
    ----------
    misfit, heading
        As for `fit`.
    trusted : (n,) bool
        Frames without alarm.
    """
    misfit, heading = np.asarray(misfit, float), np.asarray(heading, float)
    trusted = np.asarray(trusted, bool)
    fold = np.arange(len(misfit)) % FOLDS
    offsets = np.zeros_like(misfit)
    for k in np.unique(fold):
        own, others = fold == k, fold != k
        constants = fit(misfit[others], heading[others], trusted[others])
        offsets[own] = constants.offsets(heading[own])
    return offsets


def calibrated(table: pd.DataFrame, choice: str, crs: str) -> tuple[pd.DataFrame, Installation]:
    """A flight's table with the constants taken off its positions.

    Parameters
    ----------
    table : DataFrame
        As ``flight_table`` gives it.
    choice : str
        "none"; "cross-validate": each frame by constants of the other folds, so that
        ``error_m`` judges no frame by itself; or a file of constants.
    crs : str
        Of the table's metres.

    Returns
    -------
    table : DataFrame
        Camera positions less look and bias, picture centres less the bias alone.
    constants : Installation
        Those of the file, or those of all frames without alarm, for the next flight.
    """
    if choice == "none":
        return table, Installation()
    placed = table["easting"].notna().to_numpy()
    heading = table.loc[placed, "heading_deg"].to_numpy(float)
    found = table.loc[placed, ["easting", "northing"]].to_numpy(float)
    recorded = table.loc[placed, ["recorded_easting", "recorded_northing"]].to_numpy(float)
    if choice == "cross-validate":
        trusted = ~table.loc[placed, "alarm"].to_numpy(bool)
        constants = fit(found - recorded, heading, trusted)
        offsets = cross_validated(found - recorded, heading, trusted)
    else:
        constants = Installation.read(choice)
        offsets = constants.offsets(heading)
    moved = found - offsets
    out = table.copy()
    out.loc[placed, ["easting", "northing"]] = moved.round(3)
    out.loc[placed, "error_m"] = np.hypot(*(moved - recorded).T).round(3)
    out.loc[placed, "calibration"] = choice if choice == "cross-validate" else Path(choice).name
    for name, bias in zip(("centre_easting", "centre_northing"), constants.bias, strict=True):
        out.loc[placed, name] = (table.loc[placed, name].astype(float) - bias).round(3)
    to_degrees = Transformer.from_crs(CRS(crs), 4326, always_xy=True)
    longitude, latitude = to_degrees.transform(*moved.T)
    out.loc[placed, "latitude"] = np.round(latitude, 8)
    out.loc[placed, "longitude"] = np.round(longitude, 8)
    return out, constants


def _design(heading: Array) -> Array:
    """(n, 2, 4): offsets east and north by the four constants."""
    sin, cos = np.sin(np.radians(heading)), np.cos(np.radians(heading))
    zero, one = np.zeros_like(sin), np.ones_like(sin)
    rows = [np.stack([sin, cos, one, zero], -1), np.stack([cos, -sin, zero, one], -1)]
    return np.stack(rows, axis=-2)


def _weighted(design: Array, misfit: Array, weight: Array) -> Array:
    """Weighted least squares, of smallest constants where they cannot be told apart."""
    root = np.sqrt(weight)[:, None]
    solved = np.linalg.lstsq(
        (design * root[..., None]).reshape(-1, 4), (misfit * root).ravel(), rcond=1e-9
    )
    return np.asarray(solved[0], float)


def _one_direction(heading: Array) -> bool:
    return bool(np.abs(np.exp(1j * np.radians(heading)).mean()) > SAME_DIRECTION)


def _scatter(left: Array) -> float:
    """Normalised median absolute deviation from zero, of both axes together."""
    return float(MAD_TO_SIGMA * np.median(np.abs(left))) if left.size else 0.0
