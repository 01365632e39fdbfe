"""Text notebooks, executed on a run's own versions."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import jupytext
import papermill
from nbformat import NotebookNode
from papermill.exceptions import PapermillExecutionError

from pcnav_study.errors import InputError


def execute(source: Path, parameters: dict[str, Any], project: Path) -> NotebookNode:
    """Run a py:percent notebook with ``parameters`` in its cell tagged so.

    Whatever depends on the moment (cell ids, timings) is taken out, so equal inputs give
    equal notebooks.

    Raises
    ------
    InputError
        If a cell fails; the half-run notebook with its traceback is kept beside the site.
    """
    os.environ["PLOTLY_RENDERER"] = "plotly_mimetype"
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / f"{source.stem}.ipynb"
        jupytext.write(jupytext.read(source), target)
        try:
            notebook = papermill.execute_notebook(
                target, target, parameters, cwd=str(project), kernel_name="python3",
                progress_bar=False, log_output=False, extra_arguments=["--log-level=CRITICAL"],
            )  # fmt: skip
        except PapermillExecutionError as error:
            kept = project / "data" / "08_reporting" / "failed" / target.name
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_bytes(target.read_bytes())
            raise InputError(
                f"notebook {source.name} failed ({error.ename}: {error.evalue}); "
                f"its traceback is in {kept}"
            ) from error
    return timeless(notebook)


def timeless(notebook: NotebookNode) -> NotebookNode:
    """The notebook without ids and timings of its own."""
    for k, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{k:03d}"
        cell.metadata.pop("papermill", None)
        cell.metadata.pop("execution", None)
    notebook.metadata["papermill"] = {
        "parameters": notebook.metadata.get("papermill", {}).get("parameters", {})
    }
    notebook.metadata.pop("language_info", None)
    return notebook
