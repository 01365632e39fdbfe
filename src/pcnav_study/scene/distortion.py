"""Brown's lens distortion [1]_ [2]_, as OpenCV writes it.

References
----------
.. [1] Brown (1966), Photogrammetric Engineering 32(3), 444-462.
.. [2] OpenCV documentation, calib3d: k1, k2, k3 radial, p1, p2 tangential.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ITERATIONS = 12


class Distortion(NamedTuple):
    """Radial k1, k2, k3 and tangential p1, p2 of normalised image points (x right, y down)."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0

    @property
    def largest_radius(self) -> float:
        """Normalised radius beyond which the radial polynomial folds back; infinite if never."""
        roots = np.roots([7 * self.k3, 5 * self.k2, 3 * self.k1, 1.0])
        real = roots.real[(np.abs(roots.imag) < 1e-12) & (roots.real > 0)]
        return float(np.sqrt(real.min())) if real.size else float("inf")

    def apply(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Distorted points; NaN where the model folds back and means nothing."""
        square = x * x + y * y
        square = np.where(square > self.largest_radius**2, np.nan, square)
        radial = 1 + square * (self.k1 + square * (self.k2 + square * self.k3))
        return (
            x * radial + 2 * self.p1 * x * y + self.p2 * (square + 2 * x * x),
            y * radial + self.p1 * (square + 2 * y * y) + 2 * self.p2 * x * y,
        )

    def remove(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Points whose distortion is (x, y), by Newton's method; NaN where there are none."""
        u, v = np.array(x, float), np.array(y, float)
        for _ in range(ITERATIONS):
            got_x, got_y = self.apply(u, v)
            square = u * u + v * v
            radial = 1 + square * (self.k1 + square * (self.k2 + square * self.k3))
            slope = 2 * (self.k1 + square * (2 * self.k2 + square * 3 * self.k3))
            xx = radial + slope * u * u + 2 * self.p1 * v + 6 * self.p2 * u
            yy = radial + slope * v * v + 6 * self.p1 * v + 2 * self.p2 * u
            xy = slope * u * v + 2 * self.p1 * u + 2 * self.p2 * v
            determinant = xx * yy - xy * xy
            off_x, off_y = x - got_x, y - got_y
            u = u + (yy * off_x - xy * off_y) / determinant
            v = v + (xx * off_y - xy * off_x) / determinant
        return u, v


NO_DISTORTION = Distortion()
