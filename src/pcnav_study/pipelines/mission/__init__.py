"""One flight, step by step, under several matchers."""

from pcnav_study.pipelines.mission.pipeline import create_pipeline

__all__ = ["create_pipeline"]
