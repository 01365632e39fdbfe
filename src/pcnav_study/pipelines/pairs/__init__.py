"""The methods on two real pictures of one place; not in the default run."""

from pcnav_study.pipelines.pairs.pipeline import create_pipeline

__all__ = ["create_pipeline"]
