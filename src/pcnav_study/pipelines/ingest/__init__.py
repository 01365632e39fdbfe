"""Elevation, and the suns of the map and of the flights."""

from pcnav_study.pipelines.ingest.pipeline import create_pipeline

__all__ = ["create_pipeline"]
