"""The recalibration pipeline: ``kedro run --pipelines=ingest,recalibration``."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.calibration.nodes import make_calibration


def create_pipeline() -> Pipeline:
    """One node, which overwrites the package's calibration."""
    inputs = ["elevation", "params:calibration"]
    return Pipeline([Node(make_calibration, inputs, "frozen_calibration", name="recalibrate")])
