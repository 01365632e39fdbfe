"""Where between the pixels a peak lies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def quadratic_peak(values: NDArray[np.floating], peak: tuple[int, int]) -> NDArray[np.float64]:
    """Offset (row, column) of the summit of a quadratic through the 3 x 3 neighbourhood.

    All six coefficients are fitted by least squares: a separable parabola ignores the
    cross term of a diagonal ridge. At the border, or where the neighbourhood is no summit,
    the offset is zero; it never exceeds one pixel.
    """
    row, col = peak
    rows, cols = values.shape
    if not (0 < row < rows - 1 and 0 < col < cols - 1):
        return np.zeros(2)
    near = np.asarray(values[row - 1 : row + 2, col - 1 : col + 2], np.float64)
    grad_row, grad_col = (near[2] - near[0]).sum() / 6, (near[:, 2] - near[:, 0]).sum() / 6
    curve_row = (near[2] - 2 * near[1] + near[0]).sum() / 3
    curve_col = (near[:, 2] - 2 * near[:, 1] + near[:, 0]).sum() / 3
    cross = (near[2, 2] - near[2, 0] - near[0, 2] + near[0, 0]) / 4
    determinant = curve_row * curve_col - cross**2
    if determinant <= 0 or curve_row >= 0:
        return np.zeros(2)
    offset = -np.array(
        [curve_col * grad_row - cross * grad_col, curve_row * grad_col - cross * grad_row]
    )
    clipped: NDArray[np.float64] = np.clip(offset / determinant, -1.0, 1.0)
    return clipped
