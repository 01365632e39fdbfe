"""Run the notebooks and build the site."""

from pcnav_study.pipelines.reporting.pipeline import create_pipeline

__all__ = ["create_pipeline"]
