"""The flight pipeline: positions, and the page that shows them."""

from functools import partial, update_wrapper

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.flight.nodes import build_flight_page, localise
from pcnav_study.pipelines.reporting.nodes import run_notebook

READS = ("flight_positions", "flight_footprints", "flight_calibration", "flight_pictures")
FLIGHT_NOTEBOOK = ("reports", "flight", READS)


def create_pipeline() -> Pipeline:
    """Positions of a user's frames, and a page that shows them."""
    execute = update_wrapper(partial(run_notebook, *FLIGHT_NOTEBOOK), run_notebook)
    return Pipeline(
        [
            Node(localise, "params:flight", list(READS), name="localise_flight"),
            Node(execute, ["run", *READS], "flight_notebook", name="run_flight"),
            Node(
                build_flight_page,
                "flight_notebook",
                ["flight_page", "flight_plotly_js"],
                name="render_flight",
            ),
        ]
    )
