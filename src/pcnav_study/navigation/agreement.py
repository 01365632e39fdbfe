"""Do the parts of a frame agree on where it is?

At the true place every part of the frame finds the map under it; at a false one, which the
whole frame chose by chance, the parts scatter over all that they search. The frame is cut
into overlapping tiles, each is matched by itself, and the share that agrees with the whole
is the agreement. [ours]
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.matching import match

TILES = 3  # along each axis; neighbours overlap by half
VALID = 0.6  # least share of a tile inside the picture
NEAR = 1 / 3  # of the tiles' search reach: as near as that is agreement
LEAST = 0.5  # share of tiles that must agree; one in nine does by chance


def agreement(
    reference: NDArray[np.floating],
    moving: NDArray[np.floating],
    shift: NDArray[np.floating],
    method: str,
) -> float:
    """Share, 0 to 1, of the moving image's tiles whose own shift is that of the whole.

    Parameters
    ----------
    reference : (rows, columns)
        Search area, larger than ``moving`` by its margins; NaN is no data.
    moving : (rows, columns)
    shift : (2,)
        Of the whole moving image, px, between the two centres.
    method : str
        A name in ``METHODS``.
    """
    margins = [(r - m) // 2 for r, m in zip(reference.shape, moving.shape, strict=True)]
    reach = min(margins)
    sides = [n // (TILES + 1) * 2 for n in moving.shape]
    agreed, tried = 0, 0
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
        tried += 1
        agreed += bool(np.abs(found - shift).max() <= max(NEAR * reach, 1.0))
    return agreed / tried if tried else 0.0
