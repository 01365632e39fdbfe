"""Matching under changing light, and where each method breaks."""

from pcnav_study.pipelines.light.pipeline import create_pipeline

__all__ = ["create_pipeline"]
