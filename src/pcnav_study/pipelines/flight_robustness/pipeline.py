"""The robustness pipeline: slow, and only by name."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.flight_robustness.nodes import measure_robustness


def create_pipeline() -> Pipeline:
    """Curves of success and alarm under damage."""
    inputs = ["params:flight", "params:flight_robustness"]
    return Pipeline(
        [Node(measure_robustness, inputs, "flight_robustness", name="measure_flight_robustness")]
    )
