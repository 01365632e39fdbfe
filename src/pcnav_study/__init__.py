"""Illumination-invariant image matching for UAV localisation, as a reproducible study."""

__version__ = "0.1.0"
