"""Do the parts of a frame agree on where it is?

At the true place every part of the frame finds the map under it; at a false one, which the
whole frame chose by chance, the parts scatter over all that they search. The frame is cut
into overlapping tiles, each is matched by itself, and the share that agrees with the whole
is the agreement. The median of the tiles' shifts serves as the frame's: buildings, tilt
and lens distort parts of a frame, and lead the whole astray by metres. [ours]
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching import match

TILES = 3  # along each axis; neighbours overlap by half
VALID = 0.6  # least share of a tile inside the picture
NEAR = 0.5  # of the tiles' search reach: as near as that is agreement
LEAST = 0.5  # share of tiles that must agree; a quarter does by chance alone
FEWEST = 3  # tiles for a median


class Agreement(NamedTuple):
    """Share, 0 to 1, of the tiles that agree with the whole; median (row, column) of all."""

    share: float
    shift: NDArray[np.float64]


def agreement(
    reference: NDArray[np.floating],
    moving: NDArray[np.floating],
    shift: NDArray[np.floating],
    method: str,
) -> Agreement:
    """How many of the moving image's tiles find the shift of the whole, and their median.

    Parameters
    ----------
    reference : (rows, columns)
        Search area, larger than ``moving`` by its margins; NaN is no data.
    moving : (rows, columns)
    shift : (2,)
        Of the whole moving image, px, between the two centres; returned as it is where
        fewer than three tiles can be matched.
    method : str
        A name in ``METHODS``.
    """
    margins = [(r - m) // 2 for r, m in zip(reference.shape, moving.shape, strict=True)]
    reach = min(margins)
    sides = [n // (TILES + 1) * 2 for n in moving.shape]
    shifts = []
    for place in product(range(TILES), repeat=2):
        first = [k * side // 2 for k, side in zip(place, sides, strict=True)]
        tile = moving[first[0] : first[0] + sides[0], first[1] : first[1] + sides[1]]
        area = reference[
            tuple(
                slice(f + m - reach, f + m + side + reach)
                for f, m, side in zip(first, margins, sides, strict=True)
            )
        ]
        if min(np.isfinite(tile).mean(), np.isfinite(area).mean()) < VALID:
            continue
        try:
            found = match(area, tile, method, max_shift=reach).shift
        except InputError:  # a tile too small for the method tells nothing
            continue
        shifts.append(found)
    found_shifts = np.array(shifts).reshape(-1, 2)
    near = np.abs(found_shifts - shift).max(axis=1, initial=0.0) <= max(NEAR * reach, 1.0)
    share = float(near.mean()) if len(near) else 0.0
    middle = np.median(found_shifts, axis=0) if len(near) >= FEWEST else shift
    return Agreement(share, np.asarray(middle, np.float64))
