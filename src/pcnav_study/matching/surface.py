"""A match surface: one score for every candidate shift."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pcnav_study.matching.subpixel import quadratic_peak


@dataclass(frozen=True)
class Surface:
    """Scores of candidate shifts one pixel apart; the larger, the better.

    Parameters
    ----------
    values : (rows, columns) float
        Score of the shift ``origin + (row, column)``.
    origin : (row, column)
        Shift in px of ``values[0, 0]``.
    """

    values: NDArray[np.float64]
    origin: tuple[float, float]

    def peak(self) -> tuple[int, int]:
        """Index of the best whole-pixel candidate."""
        row, col = np.unravel_index(np.argmax(self.values), self.values.shape)
        return int(row), int(col)

    def best_shift(self) -> NDArray[np.float64]:
        """Shift of the peak in px, refined by a quadratic through its neighbours."""
        peak = self.peak()
        return np.asarray(self.origin) + peak + quadratic_peak(self.values, peak)

    def at(self, shift: NDArray[np.floating]) -> tuple[int, int]:
        """Index of the candidate nearest to a shift, clipped to the surface."""
        index = np.rint(np.asarray(shift) - self.origin).astype(int)
        row, col = np.clip(index, 0, np.array(self.values.shape) - 1)
        return int(row), int(col)
