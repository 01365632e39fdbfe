"""Every method against its peers: accuracy, robustness and speed, in one process."""

from pcnav_study.bench.cells import Cell, Scene, window_pairs
from pcnav_study.bench.peers import PEERS, Peer, load_peers
from pcnav_study.bench.table import benchmark_table, break_points, wilson_interval

__all__ = [
    "PEERS",
    "Cell",
    "Peer",
    "Scene",
    "benchmark_table",
    "break_points",
    "load_peers",
    "wilson_interval",
    "window_pairs",
]
