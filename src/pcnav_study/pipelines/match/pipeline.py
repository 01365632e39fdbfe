"""The match pipeline: one base, a namespace for each matcher."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.match.nodes import match_windows

NAMESPACES = ("pc_sectors", "pc", "ncc", "mi")


def create_pipeline() -> Pipeline:
    """Match tables and surfaces, by namespace."""
    inputs = ["window_pairs", "suns", "params:matcher"]
    base = Pipeline([Node(match_windows, inputs, ["match_table", "surfaces"], name="match")])
    shared = {"window_pairs", "suns"}
    return sum((Pipeline(base, namespace=n, inputs=shared) for n in NAMESPACES), Pipeline([]))
