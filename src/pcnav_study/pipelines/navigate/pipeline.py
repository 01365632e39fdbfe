"""The navigate pipeline: the fleet, its outcomes, and the pages that show them."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.navigate.nodes import (
    fly_fleet,
    load_sites,
    summarise_fleet,
    time_steps,
)
from pcnav_study.pipelines.reporting.nodes import report, site

READS = ("navigation_summary", "navigation_slopes", "navigation_lost", "navigation_timing")


def create_pipeline() -> Pipeline:
    """Flights under every light, their summary, and the report."""
    wanted = "params:navigate"
    nodes = [
        Node(load_sites, wanted, "navigation_reliefs", name="load_navigation_sites"),
        Node(fly_fleet, ["navigation_reliefs", wanted], "navigation_steps", name="fly_fleet"),
        Node(
            summarise_fleet,
            ["navigation_steps", wanted],
            ["navigation_summary", "navigation_slopes", "navigation_lost"],
            name="summarise_fleet",
        ),
        Node(time_steps, wanted, "navigation_timing", name="time_steps"),
    ]
    page = report("reports", "navigation", READS)
    return Pipeline(nodes) + page + site("navigation", prefix="navigation_")
