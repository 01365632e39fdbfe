"""Controlled trials: every method on the same pairs, over everything that may break it."""

from pcnav_study.experiments.benchmark import benchmark
from pcnav_study.experiments.cells import (
    Cell,
    Task,
    break_points,
    judge,
    light_grid,
    score,
    sweep,
)
from pcnav_study.experiments.peers import PEERS, load_peers
from pcnav_study.experiments.real import draw_registered, registered
from pcnav_study.experiments.sites import experiment_sites

__all__ = [
    "PEERS",
    "Cell",
    "Task",
    "benchmark",
    "break_points",
    "draw_registered",
    "experiment_sites",
    "judge",
    "light_grid",
    "load_peers",
    "registered",
    "score",
    "sweep",
]
