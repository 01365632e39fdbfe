"""A match surface: one score for every candidate shift."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Surface:
    """Scores of candidate shifts ``step`` px apart; the larger, the better.

    Attributes
    ----------
    values : (rows, columns) float
        Score of the shift ``origin + step * (row, column)``; finite.
    origin : (row, column)
        Shift in px of ``values[0, 0]``.
    step : int
        Distance of neighbouring candidates, px.
    """

    values: NDArray[np.floating[Any]]
    origin: tuple[float, float]
    step: int = 1

    def peak(self) -> tuple[int, int]:
        """Index of the best candidate."""
        row, col = divmod(int(self.values.argmax()), self.values.shape[1])
        return row, col

    def peaks(self, count: int, share: float | None = None) -> list[tuple[int, int]]:
        """Indices of the best candidates, best first, at least 3 apart along an axis.

        At most ``count``, and with ``share`` none below that part of the first's score.
        """
        first = self.peak()
        found = [first]
        floor = -np.inf if share is None else share * float(self.values[first])
        left = self.values.copy()
        for _ in range(min(count, left.size) - 1):
            row, col = found[-1]
            left[max(row - 2, 0) : row + 3, max(col - 2, 0) : col + 3] = -np.inf
            row, col = divmod(int(left.argmax()), left.shape[1])
            if left[row, col] < floor or np.isneginf(left[row, col]):
                break
            found.append((row, col))
        return found

    def best_shift(self) -> NDArray[np.float64]:
        """Shift of the peak in px, refined by a quadratic through its neighbours."""
        row, col = self.peak()
        off_row, off_col = quadratic_peak(self.values, (row, col))
        top, left = self.origin
        return np.array([top + self.step * (row + off_row), left + self.step * (col + off_col)])

    def at(self, shift: NDArray[np.floating[Any]]) -> tuple[int, int]:
        """Index of the candidate nearest to a shift, clipped to the surface."""
        index = np.rint((np.asarray(shift) - self.origin) / self.step).astype(int)
        row, col = np.clip(index, 0, np.array(self.values.shape) - 1)
        return int(row), int(col)


def quadratic_peak(values: NDArray[np.floating[Any]], peak: tuple[int, int]) -> tuple[float, float]:
    """Offset (row, column) of the summit of a quadratic through the 3 x 3 neighbourhood.

    All six coefficients are fitted by least squares: a separable parabola ignores the
    cross term of a diagonal ridge. At the border, or where the neighbourhood is no summit,
    the offset is zero; it never exceeds one candidate.
    """
    row, col = peak
    rows, cols = values.shape
    if not (0 < row < rows - 1 and 0 < col < cols - 1):
        return 0.0, 0.0
    (a, b, c), (d, e, f), (g, h, i) = values[row - 1 : row + 2, col - 1 : col + 2].tolist()
    grad_row, grad_col = (g + h + i - a - b - c) / 6, (c + f + i - a - d - g) / 6
    curve_row = (a + b + c + g + h + i - 2 * (d + e + f)) / 3
    curve_col = (a + d + g + c + f + i - 2 * (b + e + h)) / 3
    cross = (i - g - c + a) / 4
    determinant = curve_row * curve_col - cross * cross
    if determinant <= 0 or curve_row >= 0:
        return 0.0, 0.0
    off_row = (cross * grad_col - curve_col * grad_row) / determinant
    off_col = (cross * grad_row - curve_row * grad_col) / determinant
    return min(max(off_row, -1.0), 1.0), min(max(off_col, -1.0), 1.0)
