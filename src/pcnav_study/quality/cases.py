"""Cases with known truth to train and to judge a quality on: right shifts and wrong ones.

Wrong shifts come as they come in flight: next to the truth, from a neighbouring period of
a repeated texture, from ground that was never in view, from cloud, water and flat ground,
from a season in which the reflectance has changed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.matching import MatchResult, match, prepare
from pcnav_study.matching.windows import Window
from pcnav_study.quality.calibration import Calibration
from pcnav_study.quality.evidence import evidence_of
from pcnav_study.quality.measures import measured
from pcnav_study.quality.trust import judged
from pcnav_study.scene.relief import power_law_field
from pcnav_study.scene.sun import SunPosition
from pcnav_study.scene.trials import RIM, Conditions, Site

Array = NDArray[np.float64]
HARD = ("repeated", "flat", "vignette", "cloud", "water", "season")
NEAR = (1.0, 5.0)  # px from the truth that make a near miss


@dataclass(frozen=True)
class Plan:
    """What to draw at one site.

    Parameters
    ----------
    size : int
        Windows' side, px.
    differences : sequence of float
        Of the suns' azimuths, degrees.
    n : int
        Windows a difference.
    seed : int
    peers : tuple of str
        Competing measures to take as well; names in ``measures.MEASURES``.
    """

    size: int
    differences: Sequence[float]
    n: int
    seed: int
    peers: tuple[str, ...] = ()


@dataclass(frozen=True)
class Case:
    """Two windows, a shift between them that somebody claims, and how wrong it is.

    ``error_px`` is infinite where the windows have no ground in common.
    """

    kind: str
    reference: Window
    moving: Window
    found: MatchResult
    shift: Array
    error_px: float
    about: dict[str, Any] = field(default_factory=dict)


def collect(
    site: Site, name: str, plan: Plan, calibration: Calibration | None = None, shown: int = 2
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """A row for each case of a plan: its kind, error, evidence and measures.

    With a calibration the rows gain its probability, alarm and radius, and up to ``shown``
    cases of each sort that it gets wrong are handed back with their pictures.
    """
    rows: list[dict[str, Any]] = []
    mistakes: list[dict[str, Any]] = []
    for case in cases(site, plan):
        quality = case.found.quality if case.shift is case.found.shift else None
        evidence = evidence_of(case.reference, case.moving, case.shift, case.found.surface, quality)
        row = {"site": name, "size": plan.size, "kind": case.kind, "error_px": case.error_px}
        row |= case.about | evidence._asdict()
        row |= measured(case.reference, case.moving, case.shift, plan.peers)
        if calibration is not None:
            probability, alarm, radius, _ = judged(evidence, calibration)
            row |= {"probability": probability, "alarm": alarm, "radius_px": radius}
            alike = [m for m in mistakes if m["kind"] == case.kind]
            if alarm == (case.error_px <= calibration.tolerance_px) and len(alike) < shown:
                pictures = {"reference": case.reference.values, "moving": case.moving.values}
                mistakes.append(row | pictures)
        rows.append(row)
    return rows, mistakes


def cases(site: Site, plan: Plan) -> Iterator[Case]:
    """The cases of a plan, a few of every kind at every sun difference."""
    rng = np.random.default_rng([plan.seed, plan.size])
    for k, difference in enumerate(plan.differences):
        conditions = _drawn(difference, rng)
        about = {"difference": float(difference), "noise": conditions.noise}
        about |= {"albedo": conditions.albedo_contrast}
        trials = site.draw(conditions, plan.size, plan.n, rng)
        for pair in zip(trials.reference, trials.moving, trials.shift, strict=True):
            yield from _of_pair(*pair, about, rng)
        for one, other in _apart(site, conditions, plan, rng):
            yield _matched("off_route", one, other, None, about)
        for kind in (HARD[k % len(HARD)], HARD[(k + 3) % len(HARD)]):
            for pair in _hard(kind, site, conditions, plan, rng):
                yield _matched(kind, *pair, about)


def _drawn(difference: float, rng: np.random.Generator) -> Conditions:
    """Suns so far apart, and noise, reflectance and zeniths at random."""
    azimuth = rng.uniform(0, 360)
    return Conditions(
        SunPosition(azimuth, rng.uniform(25, 65)),
        SunPosition(azimuth + difference, rng.uniform(25, 65)),
        noise=float(rng.choice([0.02, 0.05, 0.15])),
        albedo_contrast=float(rng.choice([0.0, 0.1, 0.3])),
        albedo_change=float(rng.choice([0.0, 0.3])),
    )


def _matched(
    kind: str, reference: Any, moving: Any, truth: Array | None, about: dict[str, Any]
) -> Case:
    ours, theirs = prepare(reference), prepare(moving)
    found = match(ours, theirs)
    error = np.inf if truth is None else float(np.hypot(*(found.shift - truth)))
    return Case(kind, ours, theirs, found, found.shift, error, about)


def _of_pair(
    reference: Any, moving: Any, truth: Array, about: dict[str, Any], rng: np.random.Generator
) -> Iterator[Case]:
    """What the default method finds, a shift next to the truth, and plain pc's if near."""
    own = _matched("match", reference, moving, truth, about)
    yield own
    distance, angle = rng.uniform(*NEAR), rng.uniform(0, 2 * np.pi)
    beside = truth + distance * np.array([np.sin(angle), np.cos(angle)])
    yield Case("beside", own.reference, own.moving, own.found, beside, distance, about)
    plain = match(own.reference, own.moving, "pc").shift
    error = float(np.hypot(*(plain - truth)))
    if NEAR[0] < error <= NEAR[1]:
        yield Case("plain_pc", own.reference, own.moving, own.found, plain, error, about)


def _apart(
    site: Site, conditions: Conditions, plan: Plan, rng: np.random.Generator
) -> list[tuple[Any, Any]]:
    """Windows from either half of the relief; none where the halves are too small."""
    axis = int(np.argmax(site.elevation.shape))
    halves = [
        Site(half, site.pixel_size, seed=site.seed + k)  # or both would wear one reflectance
        for k, half in enumerate(np.array_split(site.elevation, 2, axis))
    ]
    try:
        one, other = (half.draw(conditions, plan.size, plan.n, rng) for half in halves)
    except InputError:
        return []
    return list(zip(one.reference, other.moving, strict=True))


def _hard(
    kind: str, site: Site, conditions: Conditions, plan: Plan, rng: np.random.Generator
) -> list[tuple[Any, Any, Array | None]]:
    """A few pairs of one hard kind, each with its truth."""
    count = max(plan.n // 3, 1)
    if kind == "repeated":
        site = _tiled(site, plan.size, rng)
    if kind == "season":
        changed = {"albedo_contrast": 0.6, "albedo_change": 1.0}
        conditions = Conditions(**(vars(conditions) | changed))
    trials = site.draw(conditions, plan.size, count, rng)
    pairs: list[tuple[Any, Any, Array | None]] = []
    for one, other, truth in zip(trials.reference, trials.moving, trials.shift, strict=True):
        if kind in ("flat", "vignette"):
            pairs.append((*_featureless(one.shape, kind == "vignette", rng), None))
        elif kind == "water":
            pairs.append((one, _glint(one.shape, rng), None))
        elif kind == "cloud":
            pairs.append((one, _clouded(other, rng.uniform(0.4, 1.2), rng), truth))
        else:
            pairs.append((one, other, truth))
    return pairs


def _tiled(site: Site, size: int, rng: np.random.Generator) -> Site:
    """Relief that repeats itself a few times in a window, with a little of its own on top."""
    shape = tuple(size + 2 * (size // 6 - 1) + 2 * RIM + 16 for _ in range(2))
    period = int(rng.integers(max(size // 10, 6), max(size // 5, 8)))
    tile = power_law_field((period, period), 1.8, rng)
    copies = [-(-n // period) for n in shape]
    heights = np.tile(tile, copies)[: shape[0], : shape[1]]
    heights = heights + rng.uniform(0, 0.3) * power_law_field((shape[0], shape[1]), 1.8, rng)
    return Site(heights * site.pixel_size[0], site.pixel_size, seed=site.seed)


def _featureless(
    shape: tuple[int, ...], vignette: bool, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Noise alone, or on a darkening towards the rim that both pictures share."""
    rows, cols = np.meshgrid(*(np.linspace(-1, 1, n) for n in shape), indexing="ij")
    rim = -0.3 * (rows**2 + cols**2) if vignette else np.zeros(shape)
    return rim + 0.02 * rng.standard_normal(shape), rim + 0.02 * rng.standard_normal(shape)


def _glint(shape: tuple[int, ...], rng: np.random.Generator) -> Array:
    """Water: short waves that no other picture shows again."""
    waves = ndimage.gaussian_filter(rng.standard_normal(shape), (1.0, 2.5))
    return np.asarray(np.exp(waves / waves.std()))


def _clouded(image: Any, cover: float, rng: np.random.Generator) -> Array:
    """The picture under a cloud over about ``cover`` of it; everything from 1 on."""
    cloud = power_law_field((image.shape[0], image.shape[1]), 1.6, rng)
    veil = np.clip((cloud - np.quantile(cloud, max(1 - cover, 0.0))) * 3, 0, 1)
    veil = np.maximum(veil, 1.0 if cover >= 1 else 0.0)
    span = float(image.max() - image.min())
    return np.asarray(image * (1 - veil) + (image.max() + span * (0.5 + 0.2 * cloud)) * veil)


def stacked(mistakes: Sequence[dict[str, Any]], limit: int) -> xr.Dataset:
    """Pictures of up to ``limit`` mistakes, one of every kind before a second of any.

    Returns
    -------
    Dataset
        ``reference`` and ``moving`` (case, row, col) float32, NaN beyond smaller windows, and
        ``kind``, ``site``, ``difference``, ``error_px``, ``probability``, ``alarm`` by case.
    """
    seen: dict[str, int] = {}
    turns = []
    for mistake in mistakes:
        seen[mistake["kind"]] = turn = seen.get(mistake["kind"], 0) + 1
        turns.append(turn)
    chosen = [mistakes[k] for k in np.argsort(turns, kind="stable")[:limit]]
    side = max((m["size"] for m in chosen), default=1)
    pictures = {
        name: np.full((len(chosen), side, side), np.nan, np.float32)
        for name in ("reference", "moving")
    }
    for k, mistake in enumerate(chosen):
        for name, stack in pictures.items():
            rows, cols = mistake[name].shape
            stack[k, :rows, :cols] = mistake[name]
    about = {
        name: ("case", [m[name] for m in chosen])
        for name in ("kind", "site", "difference", "error_px", "probability", "alarm")
    }
    return xr.Dataset({n: (("case", "row", "col"), s) for n, s in pictures.items()} | about)
