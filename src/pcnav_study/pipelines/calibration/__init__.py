"""Judge the shipped quality on sites and suns it was not made from."""

from pcnav_study.pipelines.calibration.pipeline import create_pipeline

__all__ = ["create_pipeline"]
