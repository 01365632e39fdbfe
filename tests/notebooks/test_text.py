"""Notebooks are committed as text, and each can be given its run's versions."""

from pathlib import Path

import jupytext
import pytest
from kedro.framework.project import configure_project

from pcnav_study.pipeline_registry import register_pipelines
from pcnav_study.pipelines.reporting.pipeline import NOTEBOOKS

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "notebooks").rglob("*.py"))


def test_every_notebook_is_run_by_some_pipeline():
    configure_project("pcnav_study")
    pipelines = register_pipelines().values()
    run = {node.name for pipeline in pipelines for node in pipeline.nodes}
    assert {f"run_{path.stem}" for path in SOURCES} <= run
    default = {ROOT / "notebooks" / shelf / f"{name}.py" for shelf, name, _ in NOTEBOOKS}
    assert default <= set(SOURCES)


def test_no_executed_notebook_lies_among_the_sources():
    assert not list((ROOT / "notebooks").rglob("*.ipynb"))


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_notebook_has_title_lead_and_one_parameters_cell(path):
    notebook = jupytext.read(path)
    first = notebook.cells[0]
    assert first.cell_type == "markdown"
    assert first.source.startswith("# ")
    assert len(first.source.split("\n\n")) > 1, "the site's card shows the first paragraph"
    tagged = [c for c in notebook.cells if "parameters" in c.metadata.get("tags", [])]
    assert len(tagged) == 1
    names: dict[str, object] = {}
    exec(tagged[0].source, names)
    assert {"env", "versions"} <= names.keys()


@pytest.mark.parametrize(
    "path", [p for p in SOURCES if p.parent.name == "walkthroughs"], ids=lambda path: path.stem
)
def test_walkthrough_checks_what_it_says(path):
    code = [c.source for c in jupytext.read(path).cells if c.cell_type == "code"]
    assert sum("assert " in source for source in code) >= 3
