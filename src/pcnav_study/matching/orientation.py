"""Gradient orientation, doubled: a front end that keeps edges and forgets their contrast.

The gradient's angle is doubled, so that an edge and its contrast reversal are the same,
and its length is dropped, so that a strong edge counts as much as a weak one [1]_ [2]_.
On built-up ground, where edges outlive every change of light and season, correlating
this field finds matches that phase alone misses; on bare relief it is the weaker cue.

References
----------
.. [1] Fitch, Kadyrov, Christmas, Kittler (2002), British Machine Vision Conference, 133-142.
.. [2] Ye, Bruzzone, Shan, Bovolo, Zhu (2019), IEEE TGRS 57(11), 9059-9070.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.windows import Window


def doubled_orientation(window: Window, step: int) -> NDArray[np.float32]:
    """Cosine and sine of twice the gradient's angle, (2, rows // step, columns // step).

    Central differences over about 4 px of 2 px means, whatever the step; zero at the
    rim, around missing pixels and where there is no gradient.
    """
    smooth = _means(window.centred(), max(step, 2), step)
    reach = max(2 // step, 1)
    out = np.zeros((2, *(n // step for n in window.shape)), np.float32)
    inside = tuple(slice(reach, reach + n - 2 * reach) for n in smooth.shape)
    south = smooth[2 * reach :, reach:-reach] - smooth[: -2 * reach, reach:-reach]
    east = smooth[reach:-reach, 2 * reach :] - smooth[reach:-reach, : -2 * reach]
    square_south, square_east = south * south, east * east
    length = square_south + square_east
    length += np.float32(1e-30)
    out[0][inside] = (square_east - square_south) / length
    south *= east
    south *= 2
    out[1][inside] = south / length
    out *= sp.taper((out.shape[1], out.shape[2]), ("tukey", 0.25))
    if window.valid is not None:
        out *= sp.feather(window)[::step, ::step][: out.shape[1], : out.shape[2]]
    return out


def orientation_spectrum(window: Window, shape: tuple[int, int], step: int) -> sp.Spectrum:
    """Half-plane spectra (2, rows // step, columns // (2 step) + 1) of the doubled orientation.

    Orientation is taken on a grid twice as fine and averaged, for sampling it alone would
    fold its noise into the band; large windows can bear that.
    """
    fine = 1 if step <= 2 else step
    field = doubled_orientation(window, fine)
    if fine < step:
        field = np.stack([_means(part, step // fine, step // fine) for part in field])
    return sp.low_spectrum(field, (shape[0] // step, shape[1] // step), 1)


def _means(image: NDArray[np.float32], size: int, step: int) -> NDArray[np.float32]:
    """Means of ``size`` x ``size`` px blocks, every ``step`` px."""
    rows, cols = image.shape
    if size == step:
        image = image[: rows // step * step, : cols // step * step]
        tall = image[::step].copy()
        for k in range(1, step):
            tall += image[k::step]
        wide = tall[:, ::step].copy()
        for k in range(1, step):
            wide += tall[:, k::step]
        return wide
    tall = image[1:] + image[:-1]
    means: NDArray[np.float32] = tall[:, 1:] + tall[:, :-1]
    return means
