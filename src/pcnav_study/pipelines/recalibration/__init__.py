"""Make the calibration that ships with the package anew; on request only."""

from pcnav_study.pipelines.recalibration.pipeline import create_pipeline

__all__ = ["create_pipeline"]
