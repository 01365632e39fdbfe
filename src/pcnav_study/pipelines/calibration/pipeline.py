"""The calibration pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.calibration.nodes import judge_trust, try_quality


def create_pipeline() -> Pipeline:
    """Cases under the shipped calibration, and what they say about it."""
    return Pipeline(
        [
            Node(
                try_quality,
                ["elevation", "params:calibration"],
                ["quality_cases", "quality_mistakes"],
                name="try_quality",
            ),
            Node(
                judge_trust,
                ["quality_cases", "params:calibration"],
                ["quality_calibration", "quality_measures"],
                name="judge_trust",
            ),
        ]
    )
