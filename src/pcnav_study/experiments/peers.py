"""Other people's matchers under one signature; each is imported here and nowhere else.

A peer is first asked a question whose answer is known. One that cannot be imported, or
that answers wrongly, is reported and left out.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pcnav_study.matching.surface import Surface

Image = NDArray[np.floating[Any]]
Shift = NDArray[np.float64]
Peer = Callable[[Image, Image], Shift]


class Loaded(NamedTuple):
    """A peer ready to use, or the words that say why it is not."""

    kind: str
    match: Peer | None
    note: str


def scikit_image() -> Peer:
    """Phase correlation with an up-sampled peak [Guizar-Sicairos 2008]."""
    registration = importlib.import_module("skimage.registration")

    def match(reference: Image, moving: Image) -> Shift:
        found = registration.phase_cross_correlation(
            reference, moving, upsample_factor=100, normalization="phase"
        )
        return np.asarray(found[0], np.float64)

    return match


def opencv() -> Peer:
    """``cv2.phaseCorrelate`` with a Hann window, one thread."""
    cv2 = importlib.import_module("cv2")
    cv2.setNumThreads(1)
    tapers: dict[tuple[Any, ...], Any] = {}

    def match(reference: Image, moving: Image) -> Shift:
        key = (reference.shape, reference.dtype)
        if key not in tapers:
            depth = cv2.CV_32F if reference.dtype == np.float32 else cv2.CV_64F
            tapers[key] = cv2.createHanningWindow(reference.shape[::-1], depth)
        (x, y), _ = cv2.phaseCorrelate(reference, moving, tapers[key])
        return np.array([-y, -x], np.float64)

    return match


def opencv_ncc() -> Peer:
    """``cv2.matchTemplate`` of the moving image's middle, with a quadratic peak."""
    cv2 = importlib.import_module("cv2")
    cv2.setNumThreads(1)

    def match(reference: Image, moving: Image) -> Shift:
        rows, cols = (n // 4 for n in moving.shape)
        template = moving[rows : moving.shape[0] - rows, cols : moving.shape[1] - cols]
        scores = cv2.matchTemplate(
            reference.astype(np.float32), template.astype(np.float32), cv2.TM_CCOEFF_NORMED
        )
        return Surface(scores, (-float(rows), -float(cols))).best_shift()

    return match


def scikit_image_nmi() -> Peer:
    """``normalized_mutual_information``, 16 bins, roaming every other pixel, then every one."""
    metrics = importlib.import_module("skimage.metrics")

    def match(reference: Image, moving: Image) -> Shift:
        rows, cols = (n // 4 for n in moving.shape)
        template = moving[rows : moving.shape[0] - rows, cols : moving.shape[1] - cols]
        scores = np.full((2 * rows + 1, 2 * cols + 1), -np.inf)

        def score(row: int, col: int) -> None:
            here = reference[row : row + template.shape[0], col : col + template.shape[1]]
            scores[row, col] = metrics.normalized_mutual_information(here, template, bins=16)

        for row in range(0, scores.shape[0], 2):
            for col in range(0, scores.shape[1], 2):
                score(row, col)
        row, col = divmod(int(scores.argmax()), scores.shape[1])
        for r in range(max(row - 1, 0), min(row + 2, scores.shape[0])):
            for c in range(max(col - 1, 0), min(col + 2, scores.shape[1])):
                score(r, c)
        best = divmod(int(scores.argmax()), scores.shape[1])
        return np.array([best[0] - rows, best[1] - cols], np.float64)

    return match


def imreg_dft() -> Peer:
    """``imreg_dft.translation``, which also tries half a turn."""
    imreg = importlib.import_module("imreg_dft.imreg")

    def match(reference: Image, moving: Image) -> Shift:
        return np.asarray(imreg.translation(reference, moving)["tvec"], np.float64)

    return match


def arosics() -> Peer:
    """The core of AROSICS: one window as large as the images allow."""
    coreg = importlib.import_module("arosics").COREG
    geoarray = importlib.import_module("geoarray").GeoArray

    def match(reference: Image, moving: Image) -> Shift:
        grid = {"geotransform": (0.0, 1.0, 0.0, 0.0, 0.0, -1.0), "projection": ""}
        found = coreg(
            geoarray(reference, **grid),
            geoarray(moving, **grid),
            ws=reference.shape[::-1],
            max_shift=min(reference.shape) // 4,
            q=True,
            ignore_errors=True,
        )
        found.calculate_spatial_shifts()
        return np.array([found.y_shift_px, found.x_shift_px], np.float64)

    return match


PEERS: dict[str, tuple[str, Callable[[], Peer]]] = {
    "scikit-image": ("phase", scikit_image),
    "opencv": ("phase", opencv),
    "imreg_dft": ("phase", imreg_dft),
    "arosics": ("phase", arosics),
    "opencv-ncc": ("ncc", opencv_ncc),
    "scikit-image-nmi": ("mi", scikit_image_nmi),
}


def load_peers(names: list[str] | None = None) -> dict[str, Loaded]:
    """The named peers (all by default), each usable or with the reason why not."""
    return {name: _loaded(*PEERS[name]) for name in (PEERS if names is None else names)}


def _loaded(kind: str, load: Callable[[], Peer]) -> Loaded:
    try:
        peer = load()
    except ImportError as error:
        return Loaded(kind, None, f"absent: {error}")
    texture = ndimage.gaussian_filter(np.random.default_rng(0).standard_normal((140, 140)), 1.0)
    found = peer(texture[5:133, 8:136].copy(), texture[3:131, 11:139].copy())
    if np.abs(found - (-2.0, 3.0)).max() > 1:
        return Loaded(kind, None, f"left out: answered {found.tolist()} where (-2, 3) is right")
    return Loaded(kind, peer, "")
