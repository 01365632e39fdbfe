"""The mission pipeline."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.mission.nodes import fly_mission, prepare_mission

READS = ("mission_log", "mission_map")


def create_pipeline() -> Pipeline:
    """A map under one sun, and the log of one flight under another."""
    return Pipeline(
        [
            Node(
                prepare_mission,
                "params:mission",
                ["mission_plan", "mission_map"],
                name="prepare_mission",
            ),
            Node(
                fly_mission, ["mission_plan", "params:mission"], "mission_log", name="fly_mission"
            ),
        ]
    )
