"""The benchmark table: success, its interval, error and time, method by method."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.special import ndtri

from pcnav_study.bench.cells import Cell, KnownPair, Scene, window_pairs
from pcnav_study.bench.peers import Loaded, load_peers
from pcnav_study.matching import METHODS, match, prepare

Timed = Callable[[KnownPair], tuple[NDArray[np.float64], float]]
KINDS = {"ncc": "ncc", "ssd": "ncc", "mi": "mi"}


def benchmark_table(
    scenes: Sequence[Scene],
    cells: Sequence[Cell],
    n: int,
    seed: int,
    *,
    methods: Sequence[str] | None = None,
    peers: Sequence[str] | None = None,
    tolerance: float = 1.0,
) -> pd.DataFrame:
    """Run every method and peer on the same arrays, in turn, pair by pair.

    Give the process one thread (``OMP_NUM_THREADS=1``) for times that mean something. The
    reference's spectrum is kept, the images are copied before the clock starts, and a
    first, unmeasured pair fills every cache.

    Parameters
    ----------
    n : int
        Window pairs per scene and cell.
    methods, peers : sequence of str, optional
        Names in ``METHODS`` and in ``PEERS``; all by default.
    tolerance : float
        Largest radial error of a success, px.

    Returns
    -------
    DataFrame
        One row per scene, cell and method: ``method, kind, scene``, the cell's fields,
        ``n, success, success_low, success_high`` (95 % Wilson interval), ``rmse_px`` and
        ``median_error_px`` of the successes, ``median_ms, p95_ms, ratio_to_fastest_peer``
        (of the same kind), ``note``. An absent peer has n = 0 and says why.
    """
    loaded = load_peers(None if peers is None else list(peers))
    rows = []
    for scene in scenes:
        for number, cell in enumerate(cells):
            rng = np.random.default_rng([seed, number])
            pairs = window_pairs(scene, cell, n, rng)
            rows += _cell_rows(scene, cell, pairs, list(methods or METHODS), loaded, tolerance)
    return pd.DataFrame(rows)


def break_points(table: pd.DataFrame, parameter: str, level: float = 0.95) -> pd.Series:
    """First value of ``parameter``, from the smallest, at which each method falls below.

    NaN for a method that never does. The table must vary nothing else.
    """
    found = {}
    for method, rows in table[table["n"] > 0].groupby("method"):
        mean = rows.groupby(parameter)["success"].mean().sort_index()
        below = mean.index[mean.to_numpy() < level]
        found[method] = float(below[0]) if len(below) else np.nan
    return pd.Series(found, name=parameter)


def wilson_interval(successes: int, n: int, confidence: float = 0.95) -> tuple[float, float]:
    """Interval of a proportion that stays honest near 0 and 1 [1]_.

    References
    ----------
    .. [1] Wilson (1927), J. American Statistical Association 22(158), 209-212.
    """
    if n == 0:
        return 0.0, 1.0
    z = float(ndtri(0.5 + confidence / 2))
    share, spread = successes / n, z * z / n
    middle = (share + spread / 2) / (1 + spread)
    half = z * np.sqrt(share * (1 - share) / n + spread / (4 * n)) / (1 + spread)
    return max(middle - half, 0.0), min(middle + half, 1.0)


def _cell_rows(
    scene: Scene,
    cell: Cell,
    pairs: list[KnownPair],
    methods: list[str],
    peers: dict[str, Loaded],
    tolerance: float,
) -> list[dict[str, Any]]:
    """Rows of one scene and cell; the methods take turns on every pair."""
    runs: dict[str, Timed] = {name: _ours(name, cell) for name in methods}
    runs |= {name: _theirs(peer) for name, peer in peers.items() if peer.match is not None}
    errors: dict[str, list[float]] = {name: [] for name in runs}
    times: dict[str, list[float]] = {name: [] for name in runs}
    for run in runs.values():
        run(pairs[0])
    for pair in pairs:
        for name, run in runs.items():
            shift, seconds = run(pair)
            errors[name].append(float(np.hypot(*(shift - pair.shift))))
            times[name].append(1e3 * seconds)
    medians = {name: float(np.median(spent)) for name, spent in times.items()}
    rows = []
    for name in [*runs, *(p for p in peers if p not in runs)]:
        kind = peers[name].kind if name in peers else KINDS.get(name, "phase")
        rivals = [medians[p] for p in peers if p in runs and peers[p].kind == kind]
        row = {"method": name, "kind": kind, "scene": scene.name, **asdict(cell)}
        row |= _measures(errors.get(name, []), times.get(name, []), tolerance)
        row["ratio_to_fastest_peer"] = row["median_ms"] / min(rivals, default=np.nan)
        row["note"] = peers[name].note if name in peers else ""
        rows.append(row)
    return rows


def _measures(errors: list[float], times: list[float], tolerance: float) -> dict[str, Any]:
    """The numbers of one row; NaN where nothing was measured."""
    n, good = len(errors), [e for e in errors if e <= tolerance]
    low, high = wilson_interval(len(good), n)
    return {
        "n": n,
        "success": len(good) / n if n else np.nan,
        "success_low": low,
        "success_high": high,
        "rmse_px": float(np.sqrt(np.mean(np.square(good)))) if good else np.nan,
        "median_error_px": float(np.median(good)) if good else np.nan,
        "median_ms": float(np.median(times)) if n else np.nan,
        "p95_ms": float(np.quantile(times, 0.95)) if n else np.nan,
    }


def _ours(name: str, cell: Cell) -> Timed:
    """One of our methods, its reference prepared and its spectrum kept."""

    def run(pair: KnownPair) -> tuple[NDArray[np.float64], float]:
        reference = prepare(pair.reference)
        match(reference, pair.moving, name, sun=cell.suns)
        start = time.perf_counter()
        result = match(reference, pair.moving, name, sun=cell.suns)
        return result.shift, time.perf_counter() - start

    return run


def _theirs(peer: Loaded) -> Timed:
    """A peer on copies: some write to their inputs."""

    def run(pair: KnownPair) -> tuple[NDArray[np.float64], float]:
        assert peer.match is not None
        reference, moving = pair.reference.copy(), pair.moving.copy()
        start = time.perf_counter()
        shift = peer.match(reference, moving)
        return shift, time.perf_counter() - start

    return run
