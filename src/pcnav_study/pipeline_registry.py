"""All pipelines by name; the default leaves out those on request."""

from kedro.framework.project import find_pipelines
from kedro.pipeline import Pipeline

ON_REQUEST = {"flight", "recalibration"}


def register_pipelines() -> dict[str, Pipeline]:
    """Pipelines found in ``pcnav_study.pipelines``, and their sum as ``__default__``."""
    pipelines = find_pipelines(raise_errors=True)
    pipelines["__default__"] = sum(
        (pipeline for name, pipeline in pipelines.items() if name not in ON_REQUEST),
        Pipeline([]),
    )
    return pipelines
