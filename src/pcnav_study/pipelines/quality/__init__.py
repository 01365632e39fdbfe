"""Say how far each match can be trusted."""

from pcnav_study.pipelines.quality.pipeline import create_pipeline

__all__ = ["create_pipeline"]
