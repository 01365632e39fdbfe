"""Nodes of the reporting pipeline."""

from __future__ import annotations

import json
import logging
from typing import Any

from pcnav_study.hooks import Run
from pcnav_study.notebook import project_path
from pcnav_study.pipelines.reporting import pages
from pcnav_study.pipelines.reporting.execution import execute

logger = logging.getLogger(__name__)


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


def build_site(
    shelves: dict[str, tuple[str, ...]], run: Run, *notebooks_and_pages: str
) -> tuple[str, str]:
    """The index over the newest page of each notebook, and the figures' library."""
    names = [name for shelf in shelves.values() for name in shelf]
    notebooks = dict(zip(names, notebooks_and_pages[: len(names)], strict=True))
    cards: dict[str, list[dict[str, Any]]] = {}
    for shelf, members in shelves.items():
        for name in members:
            shown = run.version(f"{name}_page")
            cards.setdefault(shelf, []).append(_card(name, notebooks[name], shown, run))
    flights = run.versions("flight_page")
    if flights:
        cards.setdefault("reports", []).append(
            _card("flight", run.catalog.load("flight_notebook"), flights[0], run)
        )
    where = project_path() / "data" / "08_reporting" / "site" / "index.html"
    logger.info("The report is ready: %s", where)
    return pages.index(cards, run.save_version), pages.plotly_js()


def _card(name: str, notebook: str, shown: str | None, run: Run) -> dict[str, Any]:
    """What the index says of a page, and of its earlier versions."""
    title, lead = pages.heading(pages.parse(notebook))
    others = [v for v in run.versions(f"{name}_page") if v != shown]
    earlier = [{"version": v, "href": _href(name, v)} for v in others]
    return {"title": title, "lead": lead, "href": _href(name, shown), "earlier": earlier}


def _href(name: str, version: str | None) -> str:
    return f"{name}.html/{version}/{name}.html"
