"""The types of all parameters: Kedro checks conf/ and --params against them before a run."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from pcnav_study.matching import METHODS
from pcnav_study.navigation.loop import NAVIGATORS, Setup


def _known(method: str) -> str:
    if method not in METHODS:
        raise ValueError(f"method {method!r} is unknown; use one of {', '.join(METHODS)}")
    return method


def _known_navigator(name: str) -> str:
    if name not in NAVIGATORS:
        raise ValueError(f"navigator {name!r} is unknown; use one of: {'; '.join(NAVIGATORS)}")
    return name


def _listed(value: Any) -> Any:
    """A single name, as the command line gives it, as a list."""
    return [value] if isinstance(value, str) else value


Sites = Annotated[list[str], BeforeValidator(_listed), Field(min_length=1)]
NavigatorName = Annotated[str, AfterValidator(_known_navigator)]
Method = Annotated[str, AfterValidator(_known)]


class Parameters(BaseModel):
    """No unknown keys: a misspelt one is an error, not a silent default."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @classmethod
    def model_validate(cls, obj: Any, **options: Any) -> Self:
        """As pydantic's, with each fault as ``key = value: what is wrong``."""
        try:
            return super().model_validate(obj, **options)
        except ValidationError as error:
            raise ValueError("; ".join(_fault(**fault) for fault in error.errors())) from None


def _fault(loc: tuple[int | str, ...], input: Any, msg: str, **_: Any) -> str:
    """A fault in words; a whole block is named but not repeated."""
    value = "" if isinstance(input, dict) else f" = {input!r}"
    return f"{'.'.join(map(str, loc))}{value}: {msg.removeprefix('Value error, ')}"


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

    method: Method
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
    method: Method
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


class LightGrid(Parameters):
    """Suns of the light experiment, degrees."""

    azimuth_differences: list[float] = Field(min_length=1)
    reference_zenith: float = Field(ge=0, lt=90)
    moving_zeniths: list[float] = Field(min_length=1)


class Sweeps(Parameters):
    """What gets worse, step by step, at which azimuth differences."""

    azimuth_differences: list[float] = Field(min_length=1)
    albedo_contrast: float = Field(ge=0, lt=1)
    values: dict[str, list[float]]


class Light(Parameters):
    """The experiment on matching under changing light."""

    sites: list[Literal["map", "fractal"]] = Field(min_length=1)
    methods: list[Method] = Field(min_length=1)
    window_px: int = Field(ge=16)
    trials: int = Field(ge=1)
    tolerance_px: float = Field(gt=0)
    noise: float = Field(ge=0)
    albedo_contrast: float = Field(ge=0, lt=1)
    shadows: bool
    seed: int
    jobs: int
    backend: str
    grid: LightGrid
    sweeps: Sweeps


class CaseSet(Parameters):
    """Cases drawn for one purpose: ``west``, ``east`` or fractal seeds, and how many."""

    sites: list[Literal["west", "east"] | int] = Field(min_length=1)
    sizes: list[Annotated[int, Field(ge=32)]] = Field(min_length=1)
    differences: list[float] = Field(min_length=1)
    trials: int = Field(ge=1)
    seed: int


class Calibration(Parameters):
    """What the quality is calibrated on, what it promises, and what it is judged on."""

    train: CaseSet
    calibrate: CaseSet
    judge: CaseSet
    false_alarm_rate: float = Field(gt=0, lt=1)
    radius_coverage: float = Field(gt=0, lt=1)
    shown: int = Field(ge=0)
    jobs: int
    backend: str


class Benchmark(Parameters):
    """The benchmark against peers."""

    sites: list[Literal["map", "fractal"]] = Field(min_length=1)
    methods: list[Method] = Field(min_length=1)
    peers: list[str]
    window_px: list[int] = Field(min_length=1)
    azimuth_differences: list[float] = Field(min_length=1)
    trials: int = Field(ge=1)
    roaming_trials: int = Field(ge=0)
    noise: float = Field(ge=0)
    tolerance_px: float = Field(gt=0)
    seed: int


class Pairs(Parameters):
    """Two real pictures of one place."""

    reference: str | None
    moving: str | None
    affine: str | None
    methods: list[Method] = Field(min_length=1)
    window_px: int = Field(ge=16)
    trials: int = Field(ge=1)
    tolerance_px: float = Field(gt=0)
    seed: int


class Mission(Parameters):
    """One simulated flight under several navigators; ``route`` is in shares of the map."""

    site: str
    day: str
    map_hour: float = Field(ge=0, lt=24)
    sun_difference: float = Field(ge=-180, le=180)
    route: list[tuple[float, float]] = Field(min_length=2)
    gust: float = Field(ge=0)
    gust_step: int = Field(ge=1)
    methods: list[NavigatorName] = Field(min_length=1)
    seed: int = Field(ge=0)
    setup: Setup


class ByDifference(Parameters):
    """Suns of one day, by their azimuths' difference from the map's, degrees."""

    day: str
    map_hour: float = Field(ge=0, lt=24)
    differences: list[Annotated[float, Field(ge=-180, le=180)]]


class ByHour(Parameters):
    """Suns of several days, by the hour."""

    days: list[str]
    map_hour: float = Field(ge=0, lt=24)
    hours: list[float]
    lowest_sun: float = Field(ge=0, lt=90)


class Navigate(Parameters):
    """Fleets of simulated flights."""

    sites: Sites
    by_difference: ByDifference
    by_hour: ByHour
    gusts: list[Annotated[float, Field(ge=0)]] = Field(min_length=1)
    methods: list[NavigatorName] = Field(min_length=1)
    flights: int = Field(ge=1)
    seed: int = Field(ge=0)
    timed_frames_px: list[Annotated[int, Field(ge=64, le=600)]] = Field(min_length=1)
    timed_flights: int = Field(ge=1)
    jobs: int
    backend: str
    setup: Setup
