"""Nodes of the rectify pipeline."""

from __future__ import annotations

import logging

import xarray as xr

from pcnav_study.frames import window_pairs
from pcnav_study.pipelines.parameters import Rectify

logger = logging.getLogger(__name__)


def rectify_frames(
    frames: xr.Dataset, reference_map: xr.DataArray, elevation: xr.DataArray, rectify: Rectify
) -> xr.Dataset:
    """Frames on the map's pixels, each beside the map where the UAV believed to be."""
    relief = rectify.ground == "relief"
    pairs = window_pairs(frames, reference_map, elevation, size=rectify.window_px, relief=relief)
    logger.info(
        "Rectified %d frames over %s ground to windows of %d px",
        pairs.sizes["frame"], rectify.ground, rectify.window_px,
    )  # fmt: skip
    return pairs
