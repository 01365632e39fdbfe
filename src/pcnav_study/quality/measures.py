"""Competing measures of a match, all asked the same: is this shift right?

Each takes two windows already cropped to the overlap that the shift claims, and the part
of the shift that is left. For a right shift a peer then has nothing to register. The
measures of a single surface take the plain phase correlation of those crops.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.overlap import Overlap, overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.windows import SMALLEST, Window

Array = NDArray[np.float64]


class Crops:
    """Both windows where they overlap, (rows, columns) each, for one claimed shift."""

    def __init__(self, reference: Window, moving: Window, shift: Array) -> None:
        self.pair = Pair(reference, moving, (1.0, 1.0))
        self.shift = shift
        cuts = []
        for s, o, r, m in zip(shift, self.pair.offset, reference.shape, moving.shape, strict=True):
            whole = round(float(s + o))
            first, last = max(0, whole), max(min(r, whole + m), max(0, whole))
            cuts.append((slice(first, last), slice(first - whole, last - whole)))
        self.one = np.asarray(reference.values[cuts[0][0], cuts[1][0]], np.float32)
        self.other = np.asarray(moving.values[cuts[0][1], cuts[1][1]], np.float32)

    @property
    def overlap(self) -> Overlap | None:
        """Phasors of the overlap; None if it is too small."""
        return overlap_of(self.pair, self.shift)

    def plain(self) -> Array:
        """Plain phase correlation of the crops, no shift in the middle."""
        weight = sp.taper(self.one.shape, "hann")
        spectra = fft.rfft2(np.stack([(c - c.mean()) * weight for c in (self.one, self.other)]))
        surface = fft.irfft2(sp.whitened(spectra[0] * spectra[1].conj()), self.one.shape)
        return np.asarray(fft.fftshift(surface), np.float64)


def peak_height(crops: Crops) -> float:
    """Highest value of the plain surface within a pixel of the shift."""
    return float(_split(crops.plain())[0].max())


def peak_to_second(crops: Crops) -> float:
    """The same over the highest value elsewhere."""
    near, far = _split(crops.plain())
    return float(near.max() / max(far.max(), 1e-30))


def peak_to_sidelobe(crops: Crops) -> float:
    """The same, less the mean elsewhere, in units of the scatter there."""
    near, far = _split(crops.plain())
    return float((near.max() - far.mean()) / max(far.std(), 1e-30))


def plane_residual(crops: Crops) -> float:
    """Minus the RMS phase, radians, that a plane leaves after the signs' repair."""
    overlap = crops.overlap
    if overlap is None:
        return -np.pi
    residual = crops.shift - overlap.whole
    bank = overlap.band.bank
    turned = overlap.turned(residual)
    signs = np.sign(overlap.sector_sums(residual))
    phase = np.angle(turned * np.tensordot(signs, (bank > 0).astype(np.float32), 1))
    weight = bank.sum(axis=0)
    return -float(np.sqrt((weight * phase**2).sum() / weight.sum()))


def sector_agreement(crops: Crops) -> float:
    """The weakest quarter of the sectors: mean cosine of their phases at the shift."""
    overlap = crops.overlap
    if overlap is None:
        return 0.0
    weight = overlap.band.bank.sum(axis=(1, 2))
    heights = np.sort(np.abs(overlap.sector_sums(crops.shift - overlap.whole)) / weight)
    return float(heights[: len(heights) // 4].mean())


def scikit_image_error(crops: Crops) -> float:
    """Minus the error of ``skimage.registration.phase_cross_correlation``."""
    registration = importlib.import_module("skimage.registration")
    return -float(registration.phase_cross_correlation(crops.one, crops.other)[1])


def opencv_response(crops: Crops) -> float:
    """The response of ``cv2.phaseCorrelate`` with a Hann window."""
    cv2 = importlib.import_module("cv2")
    taper = cv2.createHanningWindow(crops.one.shape[::-1], cv2.CV_32F)
    return float(cv2.phaseCorrelate(crops.one.copy(), crops.other.copy(), taper)[1])


def arosics_reliability(crops: Crops) -> float:
    """``shift_reliability`` of AROSICS, per cent."""
    coreg = importlib.import_module("arosics").COREG
    array = importlib.import_module("geoarray").GeoArray
    grid = {"geotransform": (0.0, 1.0, 0.0, 0.0, 0.0, -1.0), "projection": ""}
    images = (array(image, **grid) for image in (crops.one, crops.other))
    side = min(crops.one.shape)
    found = coreg(*images, ws=(side, side), max_shift=side // 4, q=True, ignore_errors=True)
    found.calculate_spatial_shifts()
    return float(found.shift_reliability or 0.0)


MEASURES: dict[str, Callable[[Crops], float]] = {
    "peak height": peak_height,
    "peak to second peak": peak_to_second,
    "peak to sidelobe": peak_to_sidelobe,
    "plane-fit residual": plane_residual,
    "sector agreement": sector_agreement,
    "scikit-image error": scikit_image_error,
    "OpenCV response": opencv_response,
    "AROSICS reliability": arosics_reliability,
}
PEERS = {"OpenCV response": "cv2", "AROSICS reliability": "arosics"}


def absent(names: tuple[str, ...]) -> dict[str, str]:
    """Why a measure cannot be taken, for those whose package is not there."""
    reasons = {}
    for name in names:
        try:
            importlib.import_module(PEERS.get(name, "skimage"))
        except ImportError as error:
            reasons[name] = f"absent: {error}"
    return reasons


def measured(
    reference: Window, moving: Window, shift: Array, names: tuple[str, ...]
) -> dict[str, Any]:
    """The named measures of a shift; larger always means better, NaN without overlap."""
    if not names:
        return {}
    crops = Crops(reference, moving, shift)
    if min(crops.one.shape) < SMALLEST:
        return dict.fromkeys(names, np.nan)
    return {name: MEASURES[name](crops) for name in names}


def _split(surface: Array) -> tuple[Array, Array]:
    """Absolute values within a pixel of the middle, and further than three from it."""
    row, col = (n // 2 for n in surface.shape)
    height = np.abs(surface)
    near = height[row - 1 : row + 2, col - 1 : col + 2].copy()
    far = height.copy()
    far[max(row - 3, 0) : row + 4, max(col - 3, 0) : col + 4] = np.nan
    return near, far[np.isfinite(far)]
