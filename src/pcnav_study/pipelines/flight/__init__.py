"""Localise a user's flight folder."""

from pcnav_study.pipelines.flight.pipeline import create_pipeline

__all__ = ["create_pipeline"]
