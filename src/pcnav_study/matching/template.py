"""A template roaming inside the reference: sums over every placement, by FFT and running sums.

Shared by the three methods of that kind (`ncc`, `ssd`, `mutual_information`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from pcnav_study.matching import spectrum as sp
from pcnav_study.matching.pair import Pair, template_of
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window

Cut = tuple[slice, slice]
SHARE = 0.3  # least share of the fullest overlap of valid pixels that a placement needs


class Roaming:
    """One pair as a template (the middle of the moving image) and its placements.

    Attributes
    ----------
    cut : (slice, slice)
        The template within the moving image.
    size : (rows, columns)
        Number of placements, which is the surface's shape.
    fft_shape : (rows, columns)
        At least the reference's, so that no kept placement wraps around.
    """

    def __init__(self, pair: Pair) -> None:
        self.pair = pair
        self.cut, self.origin = template_of(pair)
        self.shape = tuple(s.stop - s.start for s in self.cut)
        rows, cols = (r - t + 1 for r, t in zip(pair.reference.shape, self.shape, strict=True))
        self.size = (rows, cols)
        self.fft_shape = sp.transform_shape(pair.reference.shape)

    @property
    def masked(self) -> bool:
        """True if pixels are missing from the reference or from the template."""
        moving = self.pair.moving.valid
        return self.pair.reference.valid is not None or (
            moving is not None and not bool(moving[self.cut].all())
        )

    def correlated(self, reference: NDArray[Any], template: NDArray[Any]) -> NDArray[Any]:
        """Sum of products at every placement, from `forward` spectra (..., rows, columns)."""
        columns = fft.ifft(reference * np.conj(template), axis=-2, overwrite_x=True)
        product: NDArray[Any] = fft.irfft(
            columns[..., : self.size[0], :], self.fft_shape[1], axis=-1
        )
        return product[..., : self.size[1]]

    def forward(self, image: NDArray[Any]) -> NDArray[Any]:
        """Half-plane spectrum of (..., rows, columns) images, padded, in their precision."""
        spectrum: NDArray[Any] = fft.rfft2(image, self.fft_shape)
        return spectrum

    def running_sum(self, image: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums over the template's footprint at every placement."""
        total = np.pad(image.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
        rows, cols = self.shape
        return np.asarray(
            total[rows:, cols:]
            - total[:-rows, cols:]
            - total[rows:, :-cols]
            + total[:-rows, :-cols]
        )

    def surface(self, values: NDArray[Any]) -> Surface:
        """The values as a surface over shifts between the two centres."""
        return Surface(values, self.origin)


def filled(
    window: Window, cut: Cut | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Pixels less their mean, zero where missing, and 1 where valid; both float64."""
    values = window.values if cut is None else window.values[cut]
    valid = np.isfinite(values)
    level = values[valid].mean(dtype=np.float64) if valid.any() else 0.0
    return np.where(valid, values.astype(np.float64) - level, 0.0), valid.astype(np.float64)
