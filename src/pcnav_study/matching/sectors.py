"""Pattern energy: phase correlation that no sun can break.

Between two suns the cross-power spectrum of a shaded relief keeps its fringes and flips
its sign in whole angular sectors (`phase`). As a function of the angle that sign follows a
constant and a wave of twice the angle, whatever the suns (`overlap.light_patterns`).
Weight the spectrum with each of these three, transform, and add the squared surfaces:
their sum peaks at the shift, and nothing about the suns is needed. The correlation of
doubled gradient orientation is added for ground where edges say more than shading does.
Each of the two surfaces counts in units of its own scatter.

The search runs on a grid as coarse as the low-pass allows. At its peak each sector's
sign is read, the spectrum of the overlap is repaired, and its phase plane fitted.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.orientation import orientation_spectrum
from pcnav_study.matching.overlap import light_patterns
from pcnav_study.matching.pair import Found, Pair
from pcnav_study.matching.phase import Search, cross_power
from pcnav_study.matching.refine import energy, refined
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window

BAND = 0.2  # cycles/px, standard deviation of the Gaussian low-pass
ORIENTATION = 2.5  # weight of the orientation surface
NEARBY = 4  # px, how far around a peak of the first search the last one looks
CONTENDERS = 4  # peaks of the first search that may be looked at
CLOSE = 0.6  # share of the first peak's height from which on another one is a contender
STANDING = 0.02  # of Dirac-delta quality, what one scatter of height is worth among contenders
TAPER = ("tukey", 0.25)


def sector_phase_correlation(pair: Pair) -> Found:
    """The default method: pattern energy, then signs, repair and a sub-pixel estimate.

    Peaks of nearly the same height are all looked at; the best sum of quality there and
    height here wins. The last search, pixel by pixel, is by pattern energy alone: near the
    true shift gradients turn with the sun, so that their correlation peaks some 2 px off it.
    """
    score = score_surface(pair)
    answers = []
    for peak in score.peaks(CONTENDERS, CLOSE):
        start = np.array(score.origin) + score.step * np.array(peak)
        shift, quality = refined(pair, start, NEARBY + score.step - 1)
        merit = quality + STANDING * float(score.values[peak])
        answers.append((merit, Found(score, shift, quality)))
    return max(answers, key=lambda answer: answer[0])[1]


def pattern_spectra(pair: Pair, search: Search) -> sp.Spectrum:
    """Cross-power spectrum times each light pattern, and last the orientation's, (4, ...)."""
    product = cross_power(pair, search, TAPER)
    stack = np.empty((4, *product.shape), np.complex64)
    np.multiply(product, pattern_bank(search.shape, search.step), out=stack[:-1])
    _orientation_product(pair, search, out=stack[-1])
    return stack


def score_surface(pair: Pair) -> Surface:
    """Pattern energy plus orientation correlation of every candidate shift."""
    search = Search.of(pair, step_of(pair.reference.shape))
    spectra = pattern_spectra(pair, search)
    surfaces = sp.part_of_surface(spectra, search.shape[1] // search.step, search.size)
    score = _in_scatter(energy(surfaces[:-1]))
    score += np.float32(ORIENTATION) * _in_scatter(surfaces[-1])
    return search.surface(pair, score)


def step_of(shape: tuple[int, int]) -> int:
    """Spacing of the search grid, px: small windows need their whole band."""
    side = min(shape)
    return 1 if side < 96 else 2 if side < 384 else 4


@lru_cache(maxsize=64)
def pattern_bank(shape: tuple[int, int], step: int) -> NDArray[np.float32]:
    """Low-passed light patterns, (3, rows, columns)."""
    f_rows, f_cols = sp.frequencies(shape, step)
    squared = f_rows**2 + f_cols**2
    weight = np.exp(-0.5 * squared / BAND**2) * (squared > 0)
    if step > 1:
        weight *= (f_rows > -0.5 / step) & (f_cols < 0.5 / step)
    bank: NDArray[np.float32] = (light_patterns(f_rows, f_cols) * weight).astype(np.float32)
    bank.flags.writeable = False
    return bank


def _orientation_product(pair: Pair, search: Search, out: sp.Spectrum) -> None:
    shape, step, start, _ = search

    def delayed(window: Window) -> sp.Spectrum:
        plain = orientation_spectrum(window, shape, step)
        return sp.delayed(plain, shape, step, np.array(start))

    def conjugate(window: Window) -> sp.Spectrum:
        plain = orientation_spectrum(window, shape, step)
        return np.conj(plain, out=plain)

    one = pair.reference.kept(("orientation", shape, step, start), lambda: delayed(pair.reference))
    other = pair.moving.kept(("orientation*", shape, step), lambda: conjugate(pair.moving))
    np.multiply(one[0], other[0], out=out)
    out += one[1] * other[1]


def _in_scatter(surface: NDArray[np.float32]) -> NDArray[np.float32]:
    """The surface in units of its own standard deviation, less its mean."""
    flat = surface.ravel()
    mean = float(np.add.reduce(flat)) / flat.size
    scatter = float(np.dot(flat, flat)) / flat.size - mean**2
    scaled: NDArray[np.float32] = surface - np.float32(mean)
    scaled *= np.float32(max(scatter, 1e-36) ** -0.5)
    return scaled
