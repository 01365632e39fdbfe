"""Rotation and scale between two windows, as a step before `match` [1]_.

The magnitude of a spectrum does not feel a shift, and a rotation or a scale of the image
rotates it or scales it inversely: on a log-polar grid both are shifts. Two suns weight the
directions of the magnitude differently, |cos(theta - tau)|, so each ring and each direction
of the logarithm is centred before the grids are matched, and the candidates are judged by
pattern energy of the turned images themselves, which no sun's sign can reach.

References
----------
.. [1] Reddy and Chatterji (1996), IEEE Trans. Image Processing 5(8), 1266-1271.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft, ndimage, optimize

from pcnav_study.matching.pair import Pair, reach_of
from pcnav_study.matching.refine import refined
from pcnav_study.matching.sectors import score_surface
from pcnav_study.matching.spectrum import faded
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window, prepare

ANGLE_STEP = 0.5  # degrees
DIRECTIONS = 360  # half a turn
RING_STEP = 0.02  # of the logarithm of frequency
RINGS = 120
LOWEST = 0.04  # cycles/px of the first ring
CANDIDATES = 12


class RotationScale(NamedTuple):
    """What turns the moving image into the reference's frame.

    Attributes
    ----------
    angle : float
        Degrees by which to rotate the moving image, clockwise as displayed (row 0 on top).
    scale : float
        Factor by which to magnify it.
    quality : float
        Dirac-delta quality, 0 to 1, of the match after both.
    """

    angle: float
    scale: float
    quality: float


def rotation_scale(
    reference_image: ArrayLike | Window,
    moving_image: ArrayLike | Window,
    *,
    max_angle: float = 20.0,
    max_scale: float = 1.25,
) -> RotationScale:
    """Rotation and scale that bring the moving image into the reference's frame.

    Parameters
    ----------
    reference_image, moving_image : (rows, columns) real array or Window
    max_angle : float
        Largest rotation sought either way, degrees.
    max_scale : float
        Largest magnification, and the inverse of the smallest.
    """
    reference, moving = prepare(reference_image, "reference"), prepare(moving_image, "moving")
    if reference.is_empty or moving.is_empty:
        return RotationScale(0.0, 1.0, 0.0)
    smooth = ndimage.spline_filter(moving.centred().astype(np.float64), order=3)

    def quality(at: NDArray[np.float64]) -> float:
        turned = _turned(smooth, moving, float(at[0]), float(at[1]))
        return 0.0 if turned.is_empty else _quality(reference, turned)

    places = _candidates(reference, moving, max_angle, float(np.log(max_scale)))
    start = max(places, key=quality)
    simplex = start + np.array([[0.0, 0.0], [0.6, 0.0], [0.0, 0.01]])
    best = optimize.minimize(
        lambda at: -quality(at),
        start,
        method="Nelder-Mead",
        options={"initial_simplex": simplex, "xatol": 3e-3, "fatol": 1e-4, "maxfev": 80},
    )
    return RotationScale(float(best.x[0]), float(np.exp(best.x[1])), -float(best.fun))


def rotated_scaled(image: ArrayLike, angle: float, scale: float) -> NDArray[np.float64]:
    """The image turned clockwise by degrees and magnified about its middle; NaN outside it."""
    window = prepare(image)
    smooth = ndimage.spline_filter(window.centred().astype(np.float64), order=3)
    turned = _turned(smooth, window, angle, float(np.log(scale))).values.astype(np.float64)
    unit = 1.0 if window.is_tame else window.high - window.low
    return np.asarray(turned * unit + window.mean)


def _turned(smooth: NDArray[np.float64], window: Window, angle: float, log_scale: float) -> Window:
    """Window of the spline-filtered image after rotation and scale."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    matrix = np.array([[cos, -sin], [sin, cos]]) / np.exp(log_scale)
    middle = (np.array(window.shape) - 1) / 2
    offset = middle - matrix @ middle
    image = ndimage.affine_transform(
        smooth, matrix, offset, order=3, prefilter=False, cval=np.nan, mode="constant"
    )
    if window.valid is not None:
        valid = ndimage.affine_transform(window.valid.astype(np.float32), matrix, offset, order=1)
        image[valid < 0.99] = np.nan
    return prepare(image.astype(np.float32))


def _quality(reference: Window, turned: Window) -> float:
    """Dirac-delta quality of the best shift between two windows."""
    pair = Pair(reference, turned, reach_of(reference, turned, None))
    score = score_surface(pair)
    start = np.array(score.origin) + score.step * np.array(score.peak())
    return refined(pair, start, 3)[1]


def _candidates(
    reference: Window, moving: Window, max_angle: float, max_log_scale: float
) -> list[NDArray[np.float64]]:
    """Likely (angle in degrees, log scale), from the log-polar magnitudes [1]_."""
    one, other = (fft.rfft2(log_polar(w), (DIRECTIONS, 2 * RINGS)) for w in (reference, moving))
    surface = fft.irfft2(one * np.conj(other), (DIRECTIONS, 2 * RINGS))
    angles = min(int(max_angle / ANGLE_STEP), DIRECTIONS // 2 - 1)
    rings = min(int(max_log_scale / RING_STEP) + 1, RINGS - 1)
    rows, cols = np.arange(-angles, angles + 1), np.arange(-rings, rings + 1)
    near = ndimage.gaussian_filter(surface, 1.0, mode="wrap")[np.ix_(rows, cols)]
    peaks = Surface(near, (-angles, -rings)).peaks(CANDIDATES)
    found = [np.array([rows[i] * ANGLE_STEP, -cols[j] * RING_STEP]) for i, j in peaks]
    return [*found, np.zeros(2)]


def log_polar(window: Window) -> NDArray[np.float64]:
    """Log magnitude spectrum (DIRECTIONS, RINGS), each direction and each ring centred.

    Directions run clockwise from the columns' axis over half a turn, rings from the
    lowest frequency up.
    """
    image = faded(window, "hann")
    size = 2 * max(window.shape)
    log = np.log(np.abs(fft.fftshift(fft.fft2(image, (size, size)))) + 1e-6)
    bearing = np.radians(np.arange(DIRECTIONS) * ANGLE_STEP)[:, None]
    radius = LOWEST * np.exp(RING_STEP * np.arange(RINGS))[None, :] * size
    at = np.array([size / 2 + radius * np.sin(bearing), size / 2 + radius * np.cos(bearing)])
    polar = ndimage.map_coordinates(log, at, order=1)
    polar -= polar.mean(axis=1, keepdims=True)
    polar -= polar.mean(axis=0, keepdims=True)
    return np.asarray(polar)
