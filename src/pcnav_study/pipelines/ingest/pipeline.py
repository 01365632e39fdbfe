"""The ingest pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.ingest.nodes import load_elevation, place_suns


def create_pipeline() -> Pipeline:
    """Elevation and suns."""
    return Pipeline(
        [
            Node(load_elevation, "params:ingest", "elevation", name="load_elevation"),
            Node(place_suns, ["elevation", "params:ingest"], "suns", name="place_suns"),
        ]
    )
