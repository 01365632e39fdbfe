"""The types of all parameters: Kedro checks conf/ and --params against them before a run."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class Parameters(BaseModel):
    """No unknown keys: a misspelt one is an error, not a silent default."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Ingest(Parameters):
    """Where and when: the elevation model, the map's time, the flights' times."""

    elevation: str
    map_time: str
    flight_times: list[str] = Field(min_length=1)


class Route(Parameters):
    """A straight route, its ends as (row, column) shares of the map."""

    start: tuple[float, float]
    end: tuple[float, float]
    waypoints: int = Field(ge=2)


class CameraModel(Parameters):
    """A pinhole camera: (rows, columns) in px, and the columns' field of view in degrees."""

    shape: tuple[int, int]
    field_of_view: float = Field(gt=0, lt=170)


class Simulate(Parameters):
    """What the simulated world and flight are like."""

    route: Route
    camera: CameraModel
    height_above_ground_m: float = Field(gt=0)
    attitude_sigma_deg: float = Field(ge=0)
    position_sigma_m: float = Field(ge=0)
    albedo_contrast: float = Field(ge=0, lt=1)
    noise: float = Field(ge=0)
    shadows: bool
    seed: int


class Rectify(Parameters):
    """How frames are brought onto the map's pixels."""

    window_px: int = Field(ge=16)
    ground: Literal["relief", "flat"]


class Matcher(Parameters):
    """One matcher."""

    method: str
    max_shift_px: float | None = Field(default=None, gt=0)


class Quality(Parameters):
    """When a match counts as right, and when it raises an alarm."""

    tolerance_px: float = Field(gt=0)
    false_match_rate: float = Field(gt=0, lt=1)
    sun_bin_deg: float = Field(gt=0)


class Flight(Parameters):
    """A user's flight folder and how to localise it."""

    folder: str | None
    reference: str | None
    dem: str | None
    method: str
    prior_error_m: float | None = Field(gt=0)
    prior_offset_m: float = Field(ge=0)
    seed: int
    largest_patch_px: int = Field(ge=32)
    false_match_rate: float = Field(gt=0, lt=1)
    calibration: str
    pictures: int = Field(ge=0)


class FlightRobustness(Parameters):
    """How a flight's frames are damaged, kind by kind, and what counts as placed."""

    levels: dict[str, list[float]]
    tolerance_m: float = Field(gt=0)
    every: int = Field(ge=1)
