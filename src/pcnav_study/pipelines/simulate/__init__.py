"""Render the satellite map and the UAV's frames."""

from pcnav_study.pipelines.simulate.pipeline import create_pipeline

__all__ = ["create_pipeline"]
