"""The benchmark pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.benchmark.nodes import load_relief, run_benchmark
from pcnav_study.pipelines.reporting.nodes import report, site


def create_pipeline() -> Pipeline:
    """The benchmark table, its report, and the site with it."""
    nodes = [
        Node(load_relief, None, "relief", name="load_relief"),
        Node(run_benchmark, ["relief", "params:benchmark"], "benchmark_table", name="benchmark"),
    ]
    page = report("reports", "speed", ("benchmark_table",))
    return Pipeline(nodes) + page + site("speed", prefix="benchmark_")
