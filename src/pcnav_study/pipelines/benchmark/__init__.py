"""Accuracy and speed against other people's matchers; not in the default run."""

from pcnav_study.pipelines.benchmark.pipeline import create_pipeline

__all__ = ["create_pipeline"]
