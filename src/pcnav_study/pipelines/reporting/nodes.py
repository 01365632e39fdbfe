"""Nodes that turn a notebook into a page, and pages into a site."""

from __future__ import annotations

import json
import logging
from functools import partial, update_wrapper
from typing import Any

import jupytext
from kedro.pipeline import Node, Pipeline

from pcnav_study.hooks import Run
from pcnav_study.notebook import project_path
from pcnav_study.pipelines.reporting import pages
from pcnav_study.pipelines.reporting.execution import execute

logger = logging.getLogger(__name__)


def report(shelf: str, name: str, reads: tuple[str, ...]) -> Pipeline:
    """Two nodes: ``notebooks/<shelf>/<name>.py`` executed on ``reads``, and its page."""
    plain = {dataset: dataset.replace(".", "__") for dataset in reads}
    execution = update_wrapper(partial(run_notebook, shelf, name, reads), run_notebook)
    rendering = update_wrapper(partial(render_page, shelf), render_page)
    nodes = [
        Node(execution, ["run", *plain.values()], f"{name}_notebook", name=f"run_{name}"),
        Node(rendering, f"{name}_notebook", f"{name}_page", name=f"render_{name}"),
    ]
    return Pipeline(nodes, inputs={v: k for k, v in plain.items()})


def site(*names: str, prefix: str = "") -> Pipeline:
    """One node that builds the index once the named pages are there.

    ``prefix`` keeps the nodes of several pipelines apart; the file is the same.
    """
    inputs = ["run", *(f"{name}_page" for name in names)]
    outputs = [f"{prefix}site_index", f"{prefix}plotly_js"]
    return Pipeline([Node(build_site, inputs, outputs, name=f"{prefix}build_site")])


def run_notebook(shelf: str, name: str, reads: tuple[str, ...], run: Run, *_: Any) -> str:
    """Execute a notebook on the versions this run reads; its .ipynb as text."""
    project = project_path()
    logger.info("Running the notebook %s/%s", shelf, name)
    versions = {dataset: run.version(dataset) for dataset in reads}
    source = project / "notebooks" / shelf / f"{name}.py"
    notebook = execute(source, {"env": run.env, "versions": versions}, project)
    return json.dumps(notebook, indent=1, sort_keys=True) + "\n"


def render_page(shelf: str, notebook: str) -> str:
    """An executed notebook as a page; walkthroughs show their code."""
    return pages.page(pages.parse(notebook), show_code=shelf == "walkthroughs")


def build_site(run: Run, *_: str) -> tuple[str, str]:
    """The index over the newest page of every notebook that has one, and the figures' library."""
    project = project_path()
    cards: dict[str, list[dict[str, Any]]] = {"walkthroughs": [], "reports": []}
    for shelf, shown in cards.items():
        for source in sorted((project / "notebooks" / shelf).glob("*.py")):
            name = source.stem
            versions = run.versions(f"{name}_page")
            if not versions:
                continue
            title, lead = pages.heading(jupytext.read(source))
            links = [{"version": v, "href": f"{name}.html/{v}/{name}.html"} for v in versions]
            card = {"title": title, "lead": lead, "href": links[0]["href"], "earlier": links[1:]}
            shown.append(card)
    index = project / "data" / "08_reporting" / "site" / "index.html"
    logger.info("The report is ready: %s", index)
    return pages.index(cards, run.save_version), pages.plotly_js()
