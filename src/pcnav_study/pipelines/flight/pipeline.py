"""The flight pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.flight.nodes import localise


def create_pipeline() -> Pipeline:
    """Positions of a user's frames."""
    return Pipeline([Node(localise, "params:flight", "flight_positions", name="localise_flight")])
