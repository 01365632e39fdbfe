"""How much damage a flight's frames bear."""

from pcnav_study.pipelines.flight_robustness.pipeline import create_pipeline

__all__ = ["create_pipeline"]
