"""The light pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.light.nodes import run_light_grid, run_sweeps


def create_pipeline() -> Pipeline:
    """Success by azimuth and zenith, and break points."""
    inputs = ["elevation", "params:light"]
    return Pipeline(
        [
            Node(run_light_grid, inputs, "light_table", name="run_light_grid"),
            Node(run_sweeps, inputs, ["sweep_table", "break_points"], name="run_sweeps"),
        ]
    )
