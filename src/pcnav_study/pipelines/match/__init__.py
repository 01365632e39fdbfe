"""Find every frame on the map, by several methods."""

from pcnav_study.pipelines.match.pipeline import create_pipeline

__all__ = ["create_pipeline"]
