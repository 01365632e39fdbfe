"""Fleets of flights under many suns; not in the default run."""

from pcnav_study.pipelines.navigate.pipeline import create_pipeline

__all__ = ["create_pipeline"]
