"""A frame, or a part of it, on the map's pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
STRIDES = 8  # tried from a goal back to the picture's middle
SMALLEST_PX = 24  # side of a square that is worth matching


@dataclass(frozen=True)
class Patch:
    """A frame on the map's pixels.

    Attributes
    ----------
    values : (rows, columns)
        NaN outside the picture.
    corner : (row, column)
        Of the map's pixel that is its first.
    middle : (row, column)
        Its own pixel in the middle of the picture.
    at : (east, north)
        From where it was rectified.
    """

    values: NDArray[np.float32]
    corner: tuple[int, int]
    middle: tuple[float, float]
    at: Array

    def part(self, corner: tuple[int, int], shape: tuple[int, int]) -> Patch:
        """A window of it; ``corner`` counts from its own first pixel."""
        (row, col), (rows, cols) = corner, shape
        place = (self.corner[0] + row, self.corner[1] + col)
        middle = (self.middle[0] - row, self.middle[1] - col)
        return Patch(self.values[row : row + rows, col : col + cols], place, middle, self.at)

    @cached_property
    def square(self) -> Patch | None:
        """The largest square about its middle that lies wholly in the picture."""
        (rows, cols), (row, col) = self.values.shape, self.middle
        half = min(row, col, rows - 1 - row, cols - 1 - col) + 0.5
        missing = np.isnan(self.values)
        if missing.any():
            away = np.maximum(np.abs(np.arange(rows) - row)[:, None], np.abs(np.arange(cols) - col))
            half = min(half, float(away[missing].min()) - 0.5)
        return self.about(self.middle, int(2 * half) // 2 * 2)

    def about(self, centre: tuple[float, float], side: int) -> Patch | None:
        """The square of ``side`` px about a pixel (row, column); None if it is too small."""
        corner = [round(c - (side - 1) / 2) for c in centre]
        if side < SMALLEST_PX or min(corner) < 0:
            return None
        part = self.part((corner[0], corner[1]), (side, side))
        return part if part.values.shape == (side, side) else None

    def towards(self, goal: tuple[float, float], side: int) -> Patch | None:
        """The square of ``side`` px, wholly in the picture, that lies nearest to ``goal``."""
        middle = np.array(self.middle)
        for share in np.linspace(1, 0, STRIDES + 1).tolist():
            row, col = middle + share * (np.array(goal) - middle)
            part = self.about((row, col), side)
            if part is not None and np.isfinite(part.values).all():
                return part
        return None


def block_means(image: NDArray[np.float32], size: int) -> NDArray[np.float32]:
    """Means of size x size px blocks about the middle; NaN where a pixel of a block is."""
    if size == 1:
        return image
    cuts = [slice((n % size) // 2, (n % size) // 2 + n // size * size) for n in image.shape]
    whole = image[cuts[0], cuts[1]]
    rows, cols = (n // size for n in whole.shape)
    means: NDArray[np.float32] = whole.reshape(rows, size, cols, size).mean(axis=(1, 3))
    return means


def inscribed(corners: Array) -> Array:
    """Two opposite corners of the largest upright square about the middle of a convex quadrangle.

    Corners are (4, 2) rows and columns, in order.
    """
    middle = corners.mean(axis=0)
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
    distances = np.abs(((corners - middle) * normals).sum(axis=1))
    half = float((distances / np.abs(normals).sum(axis=1)).min())
    return np.stack([middle - half, middle + half])
