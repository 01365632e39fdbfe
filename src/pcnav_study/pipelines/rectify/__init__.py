"""Bring the frames onto the map's pixels."""

from pcnav_study.pipelines.rectify.pipeline import create_pipeline

__all__ = ["create_pipeline"]
