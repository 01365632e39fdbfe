"""All pipelines by name; the default leaves out those that need a folder or hours."""

import warnings

from kedro.framework.project import find_pipelines
from kedro.pipeline import Pipeline

ON_REQUEST = {"flight", "flight_robustness", "benchmark", "pairs", "recalibration", "navigate"}


def register_pipelines() -> dict[str, Pipeline]:
    """Pipelines found in ``pcnav_study.pipelines``, and their sum as ``__default__``."""
    # Nodes that put the matchers side by side do read from several namespaces.
    warnings.filterwarnings("ignore", "One or more dataset names contain '.'", UserWarning)
    pipelines = find_pipelines(raise_errors=True)
    pipelines["__default__"] = sum(
        (pipeline for name, pipeline in pipelines.items() if name not in ON_REQUEST),
        Pipeline([]),
    )
    return pipelines
