"""The quality pipeline: one base in the matchers' namespaces, then all side by side."""

from kedro.pipeline import Node, Pipeline

from pcnav_study.pipelines.match.pipeline import NAMESPACES
from pcnav_study.pipelines.quality.nodes import assess_matches, summarise_matches


def create_pipeline() -> Pipeline:
    """Quality tables by namespace, and their summary."""
    settings = {"params:quality", "params:rectify"}
    inputs = ["match_table", "params:quality", "params:rectify"]
    base = Pipeline([Node(assess_matches, inputs, "quality_table", name="assess")])
    each = [Pipeline(base, namespace=n, parameters=settings) for n in NAMESPACES]
    plain = {f"{n}.quality_table": f"{n}_quality_table" for n in NAMESPACES}
    inputs = ["params:quality", *plain.values()]
    summary = Node(summarise_matches, inputs, "match_summary", name="summarise_matches")
    together = Pipeline(
        [summary], inputs={v: k for k, v in plain.items()}, parameters={"params:quality"}
    )
    return sum(each, together)
