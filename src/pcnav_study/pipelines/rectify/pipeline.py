"""The rectify pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.rectify.nodes import rectify_frames


def create_pipeline() -> Pipeline:
    """Window pairs from frames."""
    inputs = ["frames", "reference_map", "elevation", "params:rectify"]
    return Pipeline([Node(rectify_frames, inputs, "window_pairs", name="rectify_frames")])
