"""The simulate pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.simulate.nodes import fly_route, paint_ground, photograph_map


def create_pipeline() -> Pipeline:
    """A satellite map under one sun, and a flight's frames under others."""
    scene = ["elevation", "albedo", "suns", "params:simulate"]
    return Pipeline(
        [
            Node(paint_ground, ["elevation", "params:simulate"], "albedo", name="paint_ground"),
            Node(photograph_map, scene, "reference_map", name="photograph_map"),
            Node(fly_route, scene, "frames", name="fly_route"),
        ]
    )
