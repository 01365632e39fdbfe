"""The reporting pipeline: the default run's notebooks, then the site."""

from kedro.pipeline import Pipeline

from pcnav_study.pipelines.match.pipeline import NAMESPACES
from pcnav_study.pipelines.reporting.nodes import report, site

# Shelf, notebook, and the datasets it reads.
NOTEBOOKS = (
    ("walkthroughs", "image_formation", ("elevation", "suns")),
    ("walkthroughs", "phase_correlation", ("elevation",)),
    ("walkthroughs", "rectification", ("elevation", "suns", "reference_map", "frames")),
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
    ("reports", "mission", ("mission_log", "mission_map")),
)


def create_pipeline() -> Pipeline:
    """Executed notebooks, their pages, and the site's index."""
    reports = [report(shelf, name, reads) for shelf, name, reads in NOTEBOOKS]
    return sum(reports, site(*(name for _, name, _ in NOTEBOOKS)))
