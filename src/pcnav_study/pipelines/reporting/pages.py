"""Executed notebooks as pages that need no network.

Figures share one plotly.js; formulas are MathML, which browsers draw by themselves.
"""

from __future__ import annotations

import json
import re
from importlib import resources
from typing import Any

import nbformat
import plotly.io
from jinja2 import Environment, PackageLoader
from latex2mathml.converter import convert as to_mathml
from nbconvert import HTMLExporter
from nbconvert.filters import markdown2html
from nbformat import NotebookNode
from plotly.offline import get_plotlyjs
from pygments.formatters import HtmlFormatter

_PLOTLY = "application/vnd.plotly.v1+json"
_MATH = re.compile(r"\$\$(.+?)\$\$|(?<![\\$\w])\$([^$\n]+?)\$(?![\w$])", re.DOTALL)
_templates = Environment(loader=PackageLoader("pcnav_study.pipelines.reporting"), autoescape=False)


def page(notebook: NotebookNode, *, show_code: bool) -> str:
    """One notebook as a page two folders below the site's root."""
    copy = nbformat.v4.new_notebook(metadata={"kernelspec": notebook.metadata["kernelspec"]})
    copy.cells = [_with_figures(c, k) for k, c in enumerate(_visible(notebook))]
    exporter = HTMLExporter(
        template_name="basic",
        exclude_input=not show_code,
        exclude_input_prompt=True,
        exclude_output_prompt=True,
        exclude_anchor_links=True,
        filters={"markdown2html": _markdown},
    )
    body, _ = exporter.from_notebook_node(copy)
    versions = notebook.metadata["papermill"]["parameters"].get("versions", {})
    return _templates.get_template("page.html").render(
        title=heading(notebook)[0],
        body=body,
        versions=versions,
        root="../../",
        style=_style(),
        pygments=HtmlFormatter(style="default").get_style_defs(".highlight"),
    )


def index(shelves: dict[str, list[dict[str, Any]]], run_id: str) -> str:
    """The site's first page: a card for each page, by shelf."""
    return _templates.get_template("index.html").render(
        shelves=shelves, run_id=run_id, style=_style()
    )


def parse(text: str) -> NotebookNode:
    """A notebook from the text of its file."""
    notebook: NotebookNode = nbformat.from_dict(json.loads(text))
    return notebook


def heading(notebook: NotebookNode) -> tuple[str, str]:
    """A notebook's title and first paragraph."""
    text = next(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    lines = text.strip().split("\n\n")
    return lines[0].lstrip("# ").strip(), " ".join(lines[1].split()) if len(lines) > 1 else ""


def plotly_js() -> str:
    """The library that all pages share."""
    return str(get_plotlyjs())


def _style() -> str:
    return (resources.files("pcnav_study.pipelines.reporting") / "templates/page.css").read_text()


def _visible(notebook: NotebookNode) -> list[NotebookNode]:
    """Cells without the parameters, which the footer shows."""
    hidden = {"parameters", "injected-parameters", "hide"}
    return [c for c in notebook.cells if not hidden & set(c.metadata.get("tags", []))]


def _with_figures(cell: NotebookNode, number: int) -> NotebookNode:
    """The cell with its Plotly outputs as HTML that finds the shared library."""
    copy: NotebookNode = nbformat.from_dict(json.loads(json.dumps(cell)))
    for k, output in enumerate(copy.get("outputs", [])):
        if _PLOTLY in output.get("data", {}):
            shown = output["data"][_PLOTLY]
            text = plotly.io.to_html(
                {name: shown[name] for name in ("data", "layout", "frames") if name in shown},
                include_plotlyjs=False,
                full_html=False,
                validate=False,
                auto_play=False,
                div_id=f"figure-{number}-{k}",
                config={"responsive": True, "displaylogo": False},
            )
            output["data"] = nbformat.from_dict({"text/html": text})
    return copy


def _markdown(source: str) -> str:
    """Markdown with its TeX formulas as MathML."""
    kept: list[str] = []

    def keep(found: re.Match[str]) -> str:
        display = "block" if found[1] else "inline"
        kept.append(to_mathml((found[1] or found[2]).strip(), display=display))
        return f"MATH{len(kept) - 1}HTAM"

    text = markdown2html(_MATH.sub(keep, source))
    return re.sub(r"MATH(\d+)HTAM", lambda found: kept[int(found[1])], text)
