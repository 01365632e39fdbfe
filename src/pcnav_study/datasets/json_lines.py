"""A table written row by row, so that a run that breaks off leaves what it had."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pandas as pd

from pcnav_study.datasets._local import LocalVersionedDataset


class JSONLinesDataset(LocalVersionedDataset):
    """Rows as JSON lines, each on the disk before the next one is asked for.

    A node returns an iterator of rows (not a generator, which Kedro would take apart).
    """

    def load(self) -> pd.DataFrame:
        """All whole rows; one that was cut off while it was written is left out."""
        rows = []
        for line in Path(self._get_load_path()).read_text(encoding="utf-8").splitlines():
            try:
                rows.append(json.loads(line))
            except json.JSONDecodeError:
                break
        return pd.DataFrame(rows)

    def save(self, data: Iterable[dict[str, Any]]) -> None:
        """Write the rows as they come; infinite and missing numbers become null."""
        with self._target().open("w", encoding="utf-8") as file:
            for row in data:
                file.write(json.dumps({name: _plain(v) for name, v in row.items()}) + "\n")
                file.flush()


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        value = value.tolist()
    return None if isinstance(value, float) and not math.isfinite(value) else value
