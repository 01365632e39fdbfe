"""Cells of an experiment: conditions, a number of trials, and how each method did."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching import METHODS, match
from pcnav_study.quality.summary import wilson
from pcnav_study.scene.sun import SunPosition
from pcnav_study.scene.trials import Conditions, Site, Trials

BASE_AZIMUTH = 100.0  # of the reference sun, degrees
SWEPT = ("noise", "size", "rotation", "scale", "relief_displacement", "albedo_change")


@dataclass(frozen=True)
class Cell:
    """One point of an experiment: ``size`` is the windows' side in px."""

    site: str
    size: int
    conditions: Conditions
    varied: str = ""

    @property
    def azimuth_difference(self) -> float:
        """Degrees between the two suns."""
        return self.conditions.moving_sun.azimuth - self.conditions.reference_sun.azimuth


@dataclass(frozen=True)
class Task:
    """A cell with how it is judged; ``seed`` draws its windows and noise."""

    cell: Cell
    methods: tuple[str, ...]
    n: int
    tolerance_px: float
    seed: int

    def __post_init__(self) -> None:
        unknown = [name for name in self.methods if name not in METHODS]
        if unknown:
            raise InputError(f"method {unknown[0]!r} is unknown; use some of {', '.join(METHODS)}")


def light_grid(
    sites: Iterable[str],
    size: int,
    azimuth_differences: Iterable[float],
    reference_zenith: float,
    moving_zeniths: Iterable[float],
    **ground: Any,
) -> list[Cell]:
    """Every combination of site, azimuth difference and zenith of the moving sun."""
    return [
        Cell(site, size, under(difference, reference_zenith, zenith, **ground))
        for site, difference, zenith in product(sites, azimuth_differences, moving_zeniths)
    ]


def sweep(
    sites: Iterable[str],
    size: int,
    azimuth_differences: Iterable[float],
    values: Mapping[str, Sequence[float]],
    **ground: Any,
) -> list[Cell]:
    """One quantity of ``SWEPT`` after the other through its values, the rest at ease.

    Raises
    ------
    InputError
        For a quantity that cannot be swept.
    """
    cells = []
    for site, difference, (name, levels) in product(sites, azimuth_differences, values.items()):
        if name not in SWEPT:
            raise InputError(f"{name!r} cannot be swept; use some of {', '.join(SWEPT)}")
        for level in levels:
            changed = ground if name == "size" else ground | {name: level}
            conditions = under(difference, 45.0, 45.0, **changed)
            cells.append(Cell(site, int(level) if name == "size" else size, conditions, name))
    return cells


def under(difference: float, reference_zenith: float, zenith: float, **ground: Any) -> Conditions:
    """Conditions with suns ``difference`` degrees of azimuth apart."""
    return Conditions(
        SunPosition(BASE_AZIMUTH, reference_zenith),
        SunPosition(BASE_AZIMUTH + difference, zenith),
        **ground,
    )


def judge(site: Site, task: Task) -> list[dict[str, Any]]:
    """A row for each method on the same pairs, as ``described`` and ``success`` fill it."""
    cell = task.cell
    trials = site.draw(cell.conditions, cell.size, task.n, np.random.default_rng(task.seed))
    given: dict[str, Any] = {
        "sun": (cell.conditions.reference_sun, cell.conditions.moving_sun),
        "pixel_size": site.pixel_size,
    }
    rows = []
    for method in task.methods:
        row = described(cell) | {"method": method, "tolerance_px": task.tolerance_px}
        rows.append(row | score(trials, method, task.tolerance_px, **given))
    return rows


def score(trials: Trials, method: str, tolerance_px: float, **given: Any) -> dict[str, Any]:
    """How a method does on trials, as ``success`` counts it; ``given`` goes to ``match``."""
    errors = [
        np.hypot(*(match(reference, moving, method, **given).shift - shift))
        for reference, moving, shift in zip(
            trials.reference, trials.moving, trials.shift, strict=True
        )
    ]
    return success(np.array(errors), tolerance_px)


def described(cell: Cell) -> dict[str, Any]:
    """The cell as columns of a table."""
    plain = {k: v for k, v in asdict(cell.conditions).items() if not k.endswith("_sun")}
    return {
        "site": cell.site,
        "size": cell.size,
        "varied": cell.varied,
        "azimuth_difference": cell.azimuth_difference,
        "reference_zenith": cell.conditions.reference_sun.zenith,
        "moving_zenith": cell.conditions.moving_sun.zenith,
    } | plain


def success(errors: NDArray[np.float64], tolerance_px: float) -> dict[str, Any]:
    """Share of errors (radial, px) within the tolerance, its Wilson interval, and their size.

    ``rmse_px`` counts the correct matches alone, ``median_px`` and ``p95_px`` all of them.
    """
    n, correct = len(errors), errors <= tolerance_px
    low, high = wilson(int(correct.sum()), n) if n else (0.0, 1.0)
    return {
        "n": n,
        "success": correct.mean() if n else np.nan,
        "success_low": low,
        "success_high": high,
        "rmse_px": np.sqrt((errors[correct] ** 2).mean()) if correct.any() else np.nan,
        "median_px": np.median(errors) if n else np.nan,
        "p95_px": np.quantile(errors, 0.95) if n else np.nan,
    }


def break_points(table: pd.DataFrame, level: float = 0.95) -> pd.DataFrame:
    """First value of each swept quantity at which a method's success is below ``level``.

    ``holds_to`` is the last value before it; NaN where the first value already fails, or
    (``breaks_at``) where none does.
    """
    rows = []
    swept = table[table["varied"] != ""]
    keys = ["varied", "azimuth_difference", "method"]
    for (varied, difference, method), group in swept.groupby(keys, sort=True):
        counts = group.assign(hits=group["success"] * group["n"]).groupby(str(varied))
        success = (counts["hits"].sum() / counts["n"].sum()).sort_index()
        if varied == "size":
            success = success[::-1]
        failing = np.flatnonzero(success.to_numpy() < level)
        first = int(failing[0]) if len(failing) else len(success)
        rows.append(
            {
                "varied": varied,
                "azimuth_difference": difference,
                "method": method,
                "holds_to": success.index[first - 1] if first else np.nan,
                "breaks_at": success.index[first] if first < len(success) else np.nan,
            }
        )
    return pd.DataFrame(rows)
