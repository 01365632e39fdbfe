"""The flight pipeline: positions, and the page that shows them."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.flight.nodes import localise
from pcnav_study.pipelines.reporting.nodes import report, site

READS = ("flight_positions", "flight_footprints", "flight_calibration", "flight_pictures")


def create_pipeline() -> Pipeline:
    """Positions of a user's frames, their report, and the site with it."""
    placing = Pipeline([Node(localise, "params:flight", list(READS), name="localise_flight")])
    return placing + report("reports", "flight", READS) + site("flight", prefix="flight_")
