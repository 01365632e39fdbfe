"""The pairs pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.pairs.nodes import match_real_pairs


def create_pipeline() -> Pipeline:
    """The methods on two real pictures."""
    return Pipeline(
        [Node(match_real_pairs, "params:pairs", "pairs_table", name="match_real_pairs")]
    )
