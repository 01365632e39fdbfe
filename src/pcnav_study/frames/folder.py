"""A flight folder: what a user brings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from pcnav_study.errors import InputError
from pcnav_study.frames.maps import metric_crs

IMAGE_SUFFIXES = {".jpg", ".jpeg", ".png", ".tif", ".tiff"}
LAYOUT = "frames/ with images, and a map such as reference.tif"


@dataclass(frozen=True)
class FlightFolder:
    """The files of one flight; ``reference`` and ``dem`` may also be URLs GDAL reads."""

    path: Path
    frames: tuple[Path, ...]
    reference: str
    dem: str | None
    camera: Path | None
    flight_log: Path | None
    camera_pose: Path | None

    @classmethod
    def open(
        cls, folder: str | Path | None, reference: str | None = None, dem: str | None = None
    ) -> FlightFolder:
        """Find a flight's files; a given ``reference`` or ``dem`` overrides the folder's.

        Raises
        ------
        InputError
            If the folder, its frames or its map is missing.
        """
        if not folder:
            raise InputError(
                "flight.folder is not set; name your flight's folder with "
                "--params=flight.folder=PATH"
            )
        path = Path(folder).expanduser()
        if not path.is_dir():
            raise InputError(f"flight folder {path} does not exist; it should hold {LAYOUT}")
        if not (path / "frames").is_dir():
            raise InputError(f"flight folder {path} has no frames/; it should hold {LAYOUT}")
        frames = sorted(
            p for p in (path / "frames").iterdir() if p.suffix.lower() in IMAGE_SUFFIXES
        )
        if not frames:
            raise InputError(
                f"{path / 'frames'} holds no image; put JPEG, PNG or TIFF frames there"
            )
        found_dem = dem or next((str(p) for p in _rasters(path, "dem")), None)

        def optional(name: str) -> Path | None:
            return path / name if (path / name).is_file() else None

        return cls(
            path=path,
            frames=tuple(frames),
            reference=reference or _find_reference(path),
            dem=found_dem,
            camera=optional("camera.json"),
            flight_log=optional("flight_log.csv"),
            camera_pose=optional("camera_pose.csv"),
        )


def _find_reference(folder: Path) -> str:
    """``reference*.tif``, or else the sharpest georeferenced raster that is no DEM."""
    named = _rasters(folder, "reference")
    candidates = named or [p for p in _rasters(folder) if p not in _rasters(folder, "dem")]
    if not candidates:
        raise InputError(
            f"flight folder {folder} has no map; add reference.tif or name one with "
            "--params=flight.reference=PATH"
        )
    return str(min(candidates, key=_pixel_side))


def _rasters(folder: Path, prefix: str = "") -> list[Path]:
    """GeoTIFF files by name, in any case of letters."""
    return sorted(
        p
        for p in folder.iterdir()
        if p.suffix.lower() in {".tif", ".tiff"} and p.name.lower().startswith(prefix)
    )


def _pixel_side(path: Path) -> float:
    """Side of a pixel in metres; infinite for what is no map."""
    try:
        return metric_crs(str(path))[1]
    except InputError:
        return float("inf")
