"""The reporting pipeline: two nodes for each notebook, then the site."""

from functools import partial, update_wrapper

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.match.pipeline import NAMESPACES
from pcnav_study.pipelines.reporting.nodes import build_site, render_page, run_notebook

# Shelf, notebook, and the datasets it reads.
NOTEBOOKS = (
    ("walkthroughs", "image_formation", ("elevation", "suns")),
    ("walkthroughs", "phase_correlation", ("elevation",)),
    ("walkthroughs", "dirac_delta", ("elevation",)),
    (
        "reports",
        "matches",
        (
            "match_summary",
            "window_pairs",
            *(f"{n}.quality_table" for n in NAMESPACES),
            *(f"{n}.surfaces" for n in NAMESPACES),
        ),
    ),
    (
        "reports",
        "quality",
        ("quality_cases", "quality_calibration", "quality_measures", "quality_mistakes"),
    ),
    ("reports", "changing_light", ("light_table", "sweep_table", "break_points")),
)


def create_pipeline() -> Pipeline:
    """Executed notebooks, their pages, and the site's index."""
    pipelines = []
    shelves: dict[str, tuple[str, ...]] = {}
    for shelf, name, reads in NOTEBOOKS:
        shelves[shelf] = (*shelves.get(shelf, ()), name)
        plain = {dataset: dataset.replace(".", "__") for dataset in reads}
        execute = update_wrapper(partial(run_notebook, shelf, name, reads), run_notebook)
        render = update_wrapper(partial(render_page, shelf), render_page)
        inputs = ["run", *plain.values()]
        nodes = [
            Node(execute, inputs, f"{name}_notebook", name=f"run_{name}"),
            Node(render, f"{name}_notebook", f"{name}_page", name=f"render_{name}"),
        ]
        pipelines.append(Pipeline(nodes, inputs={v: k for k, v in plain.items()}))
    names = [name for shelf in shelves.values() for name in shelf]
    site = Node(
        update_wrapper(partial(build_site, shelves), build_site),
        ["run", *(f"{n}_notebook" for n in names), *(f"{n}_page" for n in names)],
        ["site_index", "plotly_js"],
        name="build_site",
    )
    return sum(pipelines, Pipeline([site]))
