"""Every method and its peers on the same arrays: success, error and time, paired.

The contenders take turns on every pair. The reference's spectrum is kept, as a UAV keeps
its map's; images are copied before the clock starts; a first, unmeasured pair fills every
cache. Times mean something in a process of one thread.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pcnav_study.experiments.cells import Cell, described, success
from pcnav_study.experiments.peers import Loaded, load_peers
from pcnav_study.matching import Pair, match, prepare
from pcnav_study.matching.pair import Found, reach_of
from pcnav_study.matching.roaming import roaming_mi, roaming_ncc, roaming_ssd
from pcnav_study.scene.trials import Site

Shift = NDArray[np.float64]
KINDS = {"ncc": "ncc", "ssd": "ncc", "mi": "mi"}
ROAMING: dict[str, Callable[[Pair], Found]] = {
    "ncc, roaming": roaming_ncc,
    "ssd, roaming": roaming_ssd,
    "mi, roaming": roaming_mi,
}


class Trial(NamedTuple):
    """One pair, its site and cell."""

    reference: NDArray[np.float32]
    moving: NDArray[np.float32]
    site: Site
    cell: Cell


@dataclass(frozen=True)
class Contender:
    """Something that answers a pair: ``run`` gives its shift and the seconds it took."""

    name: str
    kind: str
    whose: str
    run: Callable[[Trial], tuple[Shift, float]] | None
    note: str = ""
    most: int | None = None


def benchmark(
    sites: Mapping[str, Site],
    cells: Sequence[Cell],
    *,
    n: int,
    seed: int,
    tolerance_px: float = 1.0,
    methods: Sequence[str],
    peers: Sequence[str],
    roaming_n: int = 0,
) -> Iterator[pd.DataFrame]:
    """The table of each cell in turn; a row for each contender.

    Parameters
    ----------
    n : int
        Pairs a cell.
    methods : sequence of str
        Names in ``METHODS``.
    peers : sequence of str
        Names in ``peers.PEERS``. An absent one has n = 0 and a note that says why.
    roaming_n : int
        Pairs on which the template methods also roam window by window, and MI peers take
        part: either takes seconds.

    Yields
    ------
    DataFrame
        ``method, kind, whose``, the cell's columns, ``n, success, success_low,
        success_high, rmse_px, median_px, p95_px``, ``median_ms, p95_ms`` and
        ``ratio_to_fastest_peer``, the median over that of the fastest peer of its kind.
    """
    contenders = [_ours(name) for name in methods]
    for name, peer in load_peers(list(peers)).items():
        contenders.append(_theirs(name, peer, roaming_n if peer.kind == "mi" else None))
    if roaming_n:
        contenders += [_roaming(name, matcher, roaming_n) for name, matcher in ROAMING.items()]
    for number, cell in enumerate(cells):
        rng = np.random.default_rng([seed, number])
        yield _cell_table(sites[cell.site], cell, contenders, n, tolerance_px, rng)


def _cell_table(
    site: Site,
    cell: Cell,
    contenders: Sequence[Contender],
    n: int,
    tolerance_px: float,
    rng: np.random.Generator,
) -> pd.DataFrame:
    """All contenders on one cell, in turn on every pair."""
    drawn = site.draw(cell.conditions, cell.size, n, rng)
    trials = [Trial(*pair, site, cell) for pair in zip(drawn.reference, drawn.moving, strict=True)]
    errors: dict[str, list[float]] = {c.name: [] for c in contenders}
    times: dict[str, list[float]] = {c.name: [] for c in contenders}
    for contender in contenders:
        if contender.run is not None and contender.most is None:
            contender.run(trials[0])
    for k, trial in enumerate(trials):
        for contender in contenders:
            if contender.run is None or k >= (n if contender.most is None else contender.most):
                continue
            shift, seconds = contender.run(trial)
            errors[contender.name].append(float(np.hypot(*(shift - drawn.shift[k]))))
            times[contender.name].append(1e3 * seconds)
    rows = []
    for contender in contenders:
        spent = times[contender.name]
        row: dict[str, Any] = {"method": contender.name, "kind": contender.kind}
        row |= (
            {"whose": contender.whose}
            | described(cell)
            | success(np.array(errors[contender.name]), tolerance_px)
        )
        row["median_ms"] = np.median(spent) if spent else np.nan
        row["p95_ms"] = np.quantile(spent, 0.95) if spent else np.nan
        rows.append(row | {"note": contender.note})
    table = pd.DataFrame(rows)
    fastest = table[table["whose"] == "peer"].groupby("kind")["median_ms"].min()
    ratio = table["median_ms"] / table["kind"].map(fastest)
    return table.assign(ratio_to_fastest_peer=ratio.astype(float))


def _ours(name: str) -> Contender:
    """One of our methods, its reference prepared and its spectra kept."""

    def run(trial: Trial) -> tuple[Shift, float]:
        suns = trial.cell.conditions.reference_sun, trial.cell.conditions.moving_sun
        reference = prepare(trial.reference)
        given: dict[str, Any] = {"sun": suns, "pixel_size": trial.site.pixel_size}
        match(reference, trial.moving, name, **given)
        start = time.perf_counter()
        result = match(reference, trial.moving, name, **given)
        return result.shift, time.perf_counter() - start

    return Contender(name, KINDS.get(name, "phase"), "study", run)


def _theirs(name: str, peer: Loaded, most: int | None) -> Contender:
    """A peer, on copies: some write to their inputs."""
    matcher = peer.match
    if matcher is None:
        return Contender(name, peer.kind, "peer", None, peer.note)

    def run(trial: Trial) -> tuple[Shift, float]:
        reference, moving = trial.reference.copy(), trial.moving.copy()
        start = time.perf_counter()
        shift = matcher(reference, moving)
        return shift, time.perf_counter() - start

    return Contender(name, peer.kind, "peer", run, most=most)


def _roaming(name: str, matcher: Callable[[Pair], Found], most: int) -> Contender:
    """A template method as the paper describes it."""

    def run(trial: Trial) -> tuple[Shift, float]:
        reference, moving = prepare(trial.reference), prepare(trial.moving)
        start = time.perf_counter()
        surface = matcher(Pair(reference, moving, reach_of(reference, moving, None))).surface
        return surface.best_shift(), time.perf_counter() - start

    return Contender(name, KINDS[name.split(",")[0]], "paper", run, "as the paper describes", most)
