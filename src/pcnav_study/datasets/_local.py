"""What these datasets share: a versioned file on a local disk."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any

from kedro.io import AbstractVersionedDataset, Version
from kedro.io.core import DatasetError


class LocalVersionedDataset(AbstractVersionedDataset[Any, Any]):
    """A file of the local disk, in a folder of its own for each version."""

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        self.metadata = metadata
        super().__init__(PurePosixPath(filepath), version)

    def _exists(self) -> bool:
        try:
            return Path(self._get_load_path()).is_file()
        except DatasetError:
            return False

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath, "version": self._version}

    def _target(self) -> Path:
        """Path to save to, its folder made."""
        path = Path(self._get_save_path())
        path.parent.mkdir(parents=True, exist_ok=True)
        return path
