"""The camera and its pose.

Camera axes are photogrammetry's: x to the right of the image, y to its top, z out of
its back, so that the scene lies at negative z. Pixel (0, 0) is the centre of the first
pixel. World axes are east, north, up, in metres of a projected CRS.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from pcnav_study.errors import InputError
from pcnav_study.scene.distortion import NO_DISTORTION, Distortion

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Where the camera is (east, north, height in metres) and how it is turned.

    ``rotation`` (3, 3) takes camera axes to world axes.
    """

    east: float
    north: float
    height: float
    rotation: Array

    @classmethod
    def from_yaw_pitch_roll(
        cls, position: ArrayLike, yaw: float, pitch: float = 0.0, roll: float = 0.0
    ) -> Pose:
        """A camera that looks straight down from a level aircraft.

        Degrees: yaw of the image's top clockwise from north, nose up, right wing down.
        """
        turn = Rotation.from_euler("ZXY", [-yaw, pitch, roll], degrees=True)
        east, north, height = np.asarray(position, float).tolist()
        return cls(east, north, height, turn.as_matrix())

    @classmethod
    def from_omega_phi_kappa(
        cls, position: ArrayLike, omega: float, phi: float, kappa: float
    ) -> Pose:
        """Photogrammetric angles in degrees: R = Rx(omega) Ry(phi) Rz(kappa) [1]_.

        References
        ----------
        .. [1] Kraus (2007), Photogrammetry, section 2.1.3.
        """
        turn = Rotation.from_euler("XYZ", [omega, phi, kappa], degrees=True)
        east, north, height = np.asarray(position, float).tolist()
        return cls(east, north, height, turn.as_matrix())

    @property
    def position(self) -> Array:
        """(east, north, height) in metres."""
        return np.array([self.east, self.north, self.height])

    @property
    def heading(self) -> float:
        """Direction on the ground of the image's top, degrees clockwise from north."""
        return float(np.degrees(np.arctan2(self.rotation[0, 1], self.rotation[1, 1])) % 360)

    def moved(self, east: float, north: float) -> Pose:
        """The same attitude and height, displaced by metres."""
        return Pose(self.east + east, self.north + north, self.height, self.rotation)


@dataclass(frozen=True)
class Camera:
    """A pinhole camera, with Brown's distortion where its lens has any.

    Parameters
    ----------
    shape : tuple of int
        (rows, columns) of the image.
    focal_px : float
        Focal length in pixels.
    principal_point : tuple of float
        Offset (row, column) in pixels of the principal point from the image's middle.
    distortion : Distortion
        Of the lens; none by default.
    """

    shape: tuple[int, int]
    focal_px: float
    principal_point: tuple[float, float] = (0.0, 0.0)
    distortion: Distortion = NO_DISTORTION

    def __post_init__(self) -> None:
        if min(self.shape) < 1 or not self.focal_px > 0:
            raise InputError(
                f"camera of {self.shape} pixels and focal length {self.focal_px} px is no camera; "
                "both must be positive"
            )

    @classmethod
    def from_field_of_view(cls, shape: tuple[int, int], degrees: float) -> Camera:
        """A camera whose columns span ``degrees``."""
        return cls(shape, shape[1] / 2 / np.tan(np.radians(degrees) / 2))

    @property
    def centre(self) -> tuple[float, float]:
        """(row, column) of the principal point."""
        rows, cols = self.shape
        return (
            (rows - 1) / 2 + self.principal_point[0],
            (cols - 1) / 2 + self.principal_point[1],
        )

    def project(self, points: Array, pose: Pose) -> tuple[Array, Array]:
        """(row, column) of world points (..., 3); NaN for points behind the camera."""
        return self._seen(*np.moveaxis((points - pose.position) @ pose.rotation, -1, 0))

    def project_map(
        self, east: Array, north: Array, height: ArrayLike, pose: Pose
    ) -> tuple[Array, Array]:
        """(row, column), each (rows, columns), of a map's pixels; as `project`, but sooner.

        Parameters
        ----------
        east : (columns,)
        north : (rows,)
        height : (rows, columns) or a number
        """
        right, top = east - pose.east, (north - pose.north)[:, None]
        up = np.asarray(height, np.float64) - pose.height
        turn = pose.rotation
        x, y, z = (up * turn[2, k] + turn[0, k] * right + turn[1, k] * top for k in range(3))
        return self._seen(x, y, z)

    def _seen(self, x: Array, y: Array, z: Array) -> tuple[Array, Array]:
        """(row, column) of points in camera axes."""
        depth = np.where(z < 0, -z, np.nan)
        right, down = x / depth, -y / depth
        if any(self.distortion):
            right, down = self.distortion.apply(right, down)
        row0, col0 = self.centre
        return row0 + self.focal_px * down, col0 + self.focal_px * right

    def rays(self, rows: ArrayLike, cols: ArrayLike, pose: Pose) -> Array:
        """World directions (..., 3), not normalised, seen at image points."""
        row0, col0 = self.centre
        right, down = np.broadcast_arrays(
            (np.asarray(cols, float) - col0) / self.focal_px,
            (np.asarray(rows, float) - row0) / self.focal_px,
        )
        if any(self.distortion):
            right, down = self.distortion.remove(right, down)
        inside = np.stack([right, -down, np.full(right.shape, -1.0)], axis=-1)
        directions: Array = inside @ pose.rotation.T
        return directions

    def footprint(self, pose: Pose, ground_height: float) -> Array:
        """Corners (4, 2), east and north, of the picture on level ground.

        Raises
        ------
        InputError
            If a corner looks at or above the horizon, or the camera is below ground.
        """
        rows, cols = self.shape
        rays = self.rays(
            [-0.5, -0.5, rows - 0.5, rows - 0.5], [-0.5, cols - 0.5, cols - 0.5, -0.5], pose
        )
        drop = pose.height - ground_height
        if drop <= 0:
            raise InputError(
                f"camera at {pose.height:.0f} m is not above ground {ground_height:.0f} m"
            )
        if not np.all(rays[:, 2] < -1e-6):
            raise InputError("the camera sees the horizon; only downward views can be rectified")
        ground: Array = pose.position[:2] + rays[:, :2] * (drop / -rays[:, 2])[:, None]
        return ground
