"""From one frame to a position, and to the next one.

The frame is rectified over the relief with the attitude measured and the position believed,
on the map's own pixels. The largest full square of it, or all of it, is sought in the map
around the believed position: the current position. The part of it that lies around where
the UAV flies next is sought by itself: the next position, from the same frame.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.frames.rectify import rectify
from pcnav_study.matching import MatchResult, match, prepare
from pcnav_study.navigation.loop.chart import Chart
from pcnav_study.navigation.loop.patch import Patch, block_means, inscribed
from pcnav_study.navigation.loop.sensors import Observation
from pcnav_study.quality.evidence import NOTHING
from pcnav_study.quality.trust import Trust, trust
from pcnav_study.scene.camera import Camera, Pose

Array = NDArray[np.float64]
SETTLED_PX = 1.5  # a larger shift moves the relief under the frame: rectify anew
COARSE_PX = 64  # side to which a wide search may shrink the frame
COARSE_REACH = 32  # px, from where on a search is wide
SETTLE_REACH = 8  # px
SETTLINGS = 3  # times a frame is rectified anew at most
FORWARD = 0.75  # side of the forward part over the full square's
MAP_SHARE = 0.3  # of a search area that must hold map data
LOST = Trust(0.0, True, float("inf"), NOTHING)


class Sight(NamedTuple):
    """A frame found on the map.

    Attributes
    ----------
    position : (east, north)
        Of the camera, metres; where it was believed to be if nothing was found.
    trust : Trust
        In it.
    quality : float
        Dirac-delta quality of the last match.
    patch : Patch or None
        The frame as it was rectified last.
    """

    position: Array
    trust: Trust
    quality: float
    patch: Patch | None


@dataclass
class Lookout:
    """Everything that turns an observation into positions.

    Parameters
    ----------
    chart : Chart
    camera : Camera
    method : str
        A name in ``METHODS``.

    Attributes
    ----------
    seconds : dict
        Wall time spent so far, by part of the work.
    """

    chart: Chart
    camera: Camera
    method: str = "pc-sectors"
    seconds: dict[str, float] = field(default_factory=dict)

    def look(self, seen: Observation, at: Array, reach: int, *, whole: bool = False) -> Sight:
        """Find the camera within ``reach`` px of ``at``, by the full square or the whole frame."""
        try:
            return self._look(seen, at, reach, whole)
        except InputError:  # nothing of the frame or of the map is in view
            return Sight(at, LOST, 0.0, None)

    def ahead(self, sight: Sight, place: Array, reach: int) -> Array | None:
        """The camera's position by the part of the frame around ``place`` (east, north)."""
        patch = sight.patch
        if patch is None or patch.square is None:
            return None
        to_map = sight.position - patch.at
        row, col = self.chart.grid.row_col(*(place - to_map))
        goal = (float(row) - patch.corner[0], float(col) - patch.corner[1])
        part = patch.towards(goal, int(FORWARD * patch.square.values.shape[0]) // 2 * 2)
        if part is None:
            return None
        start = self._pixels_of(to_map)
        with self._timed("next position"):
            try:
                result = self._match(part, start, reach)
            except InputError:
                return None
        return self._located(part, start, result.shift)

    def rectified(
        self, seen: Observation, at: Array, *, whole: bool = False, ground: float | None = None
    ) -> Patch:
        """The frame on the map's pixels if the camera is ``at`` (east, north).

        The largest square that fits into it, or all of it if ``whole``; over the relief, or
        over level ``ground`` (metres).
        """
        pose = Pose.from_yaw_pitch_roll((*at, seen.height), seen.yaw, seen.pitch, seen.roll)
        level = self.chart.level if ground is None else ground
        rows, cols = self.chart.grid.row_col(*self.camera.footprint(pose, level).T)
        corners = np.stack([rows, cols], axis=1)
        if not whole:
            corners = inscribed(corners)
        first, last = np.floor(corners.min(axis=0)), np.ceil(corners.max(axis=0))
        corner = int(first[0]), int(first[1])
        shape = int(last[0] - first[0]) + 1, int(last[1] - first[1]) + 1
        grid = self.chart.grid.window(*corner, shape)
        heights = self.chart.heights(corner, shape) if ground is None else ground
        row, col = (corners.mean(axis=0) - first).tolist()
        with self._timed("rectify"):
            values = rectify(seen.frame, self.camera, pose, grid, heights)
        return Patch(values, corner, (row, col), at)

    def _look(self, seen: Observation, at: Array, reach: int, whole: bool) -> Sight:
        sight = self._found(seen, at, reach, whole)
        for _ in range(SETTLINGS):
            if np.abs(self._pixels_of(sight.position - at)).max() <= SETTLED_PX:
                break
            at = sight.position
            sight = self._found(seen, at, min(reach, SETTLE_REACH), whole)
        return sight

    def _found(self, seen: Observation, at: Array, reach: int, whole: bool) -> Sight:
        patch = self.rectified(seen, at, whole=whole)
        part = patch if whole else patch.square
        if part is None:
            raise InputError("no full square of the frame lies in the picture")
        coarse = max(1, min(part.values.shape) // COARSE_PX) if reach > COARSE_REACH else 1
        with self._timed("match"):
            reach = -(-reach // coarse) * coarse
            area = self._around(part, np.zeros(2), reach)
            moving = prepare(block_means(part.values, coarse), "moving")
            reference = prepare(block_means(area, coarse), "reference")
            result = match(reference, moving, self.method, max_shift=reach // coarse)
        with self._timed("trust"):
            trusted = trust(result, reference, moving)
        position = self._located(part, np.zeros(2), coarse * result.shift)
        return Sight(position, trusted, result.quality, patch)

    def _match(self, part: Patch, start: Array, reach: int) -> MatchResult:
        around = self._around(part, start, reach)
        return match(around, part.values, self.method, max_shift=reach)

    def _around(self, part: Patch, start: Array, reach: int) -> NDArray[np.float32]:
        """The reference ``reach`` px around a part moved by ``start`` (row, column) px."""
        rows, cols = part.values.shape
        row, col = (round(float(c + s)) for c, s in zip(part.corner, start, strict=True))
        area = self.chart.pixels((row - reach, col - reach), (rows + 2 * reach, cols + 2 * reach))
        if np.isfinite(area).mean() < MAP_SHARE:
            raise InputError("the frame lies off the map")
        return area

    def _located(self, part: Patch, start: Array, shift: Array) -> Array:
        moved = np.round(start) + shift
        dy, dx = self.chart.grid.pixel_size
        found: Array = part.at + np.array([moved[1] * dx, -moved[0] * dy])
        return found

    def _pixels_of(self, metres: Array) -> Array:
        """(row, column) px of a displacement (east, north)."""
        dy, dx = self.chart.grid.pixel_size
        return np.array([-metres[1] / dy, metres[0] / dx])

    @contextmanager
    def _timed(self, part: str) -> Iterator[None]:
        before = time.perf_counter()
        yield
        self.seconds[part] = self.seconds.get(part, 0.0) + time.perf_counter() - before
