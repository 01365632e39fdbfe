"""The study as its users run it: whole, in parts, again, and on bad input."""

import hashlib
import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from pcnav_study.pipelines.match.pipeline import NAMESPACES
from pcnav_study.pipelines.reporting.pipeline import NOTEBOOKS

DATA = {".nc", ".tif", ".csv", ".parquet", ".jsonl"}
ON_REQUEST = {"flight", "navigation"}  # pages that other tests may have made


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_default_run_ends_in_a_site_whose_links_lead_somewhere(finished):
    site = finished.path / "data/08_reporting/site"
    index = (site / "index.html").read_text()
    pages = [line.split('href="')[1].split('"')[0] for line in index.splitlines() if "<h3>" in line]
    names = {page.split(".html")[0] for page in pages}
    always = {name for _, name, _ in NOTEBOOKS}
    assert always <= names <= always | ON_REQUEST
    for page in pages:
        text = (site / page).read_text()
        assert "Plotly.newPlot" in text
        assert 'src="../../plotly.min.js"' in text
        assert "http" not in "".join(part[:30] for part in text.split("<script")[1:])
    assert (site / "plotly.min.js").stat().st_size > 1_000_000


def test_matches_are_judged_against_the_flown_truth(finished):
    """At the map's own sun every method is right; the table says what the summary says."""
    (path,) = finished.versions("match_summary.csv")[:1]
    summary = pd.read_csv(path)
    assert set(summary["method"]) == {"pc-sectors", "pc", "ncc", "mi"}
    same_sun = summary[summary["sun_difference_deg"] == 0]
    assert (same_sun["success"] == 1).all()
    assert (same_sun["rmse_px"] < 0.5).all()
    (pairs,) = finished.versions("window_pairs.nc")[:1]
    with xr.open_dataset(pairs) as stored:
        flown = np.hypot(stored["true_row"], stored["true_col"])
        assert float(flown.min()) > 0.5, "the UAV must not know where it is"


def test_manifest_names_inputs_outputs_and_their_hashes(finished):
    path = finished.versions("run_manifest.json")[0]
    manifest = json.loads(path.read_text())
    assert manifest["run_id"] == path.parent.name
    assert manifest["status"] == "finished"
    assert manifest["parameters"]["simulate"]["route"]["waypoints"] == 2
    assert {"numpy", "kedro", "pcnav-study"} <= manifest["packages"].keys()
    for entry in manifest["outputs"].values():
        if entry["version"] is not None:
            assert entry["version"] == manifest["run_id"]
            assert digest(finished.path / entry["path"]) == entry["sha256"]
    assert {"frames", "pc.match_table", "match_summary"} <= manifest["outputs"].keys()


def test_second_run_writes_equal_bytes_beside_the_first(finished):
    before = {p: digest(p) for p in finished.versions("*") if p.suffix in DATA}
    done = finished.run("--pipelines=ingest,simulate,rectify,match,quality,mission")
    assert done.returncode == 0, done.stderr
    after = {p: digest(p) for p in finished.versions("*") if p.suffix in DATA}
    assert before.items() <= after.items(), "nothing written before has changed"
    new = [p for p in after if p not in before]
    assert len(new) >= 15
    for path in new:
        twins = [p for p in before if p.parents[1] == path.parents[1]]
        assert twins
        assert all(before[twin] == after[path] for twin in twins), path.name


@pytest.mark.parametrize(
    ("words", "writes"),
    [
        (["--pipelines=match"], {"match_table.parquet", "surfaces.nc"}),
        (["--namespaces=ncc"], {"match_table.parquet", "surfaces.nc", "quality_table.csv"}),
        (["--nodes=place_suns"], {"suns.csv"}),
        (["--from-nodes=summarise_matches", "--to-nodes=summarise_matches"], {"match_summary.csv"}),
        (
            ["--pipelines=quality", "--from-nodes=pc.assess"],
            {"quality_table.csv", "match_summary.csv"},
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)  # fmt: skip
def test_a_part_runs_alone(finished, words, writes):
    before = set(finished.versions("*"))
    done = finished.run(*words)
    assert done.returncode == 0, done.stderr
    new = {p.name for p in finished.versions("*") if p not in before} - {"run_manifest.json"}
    assert new == writes


def test_namespace_runs_only_its_own_matcher(finished):
    before = set(finished.versions("*"))
    assert finished.run("--namespaces=mi").returncode == 0
    tables = [p for p in finished.versions("match_table.parquet") if p not in before]
    assert [p.parents[2].name for p in tables] == ["mi"]


def test_load_versions_reproduce_an_old_report_exactly(finished):
    old_page = finished.versions("matches.html")[0]
    manifest = json.loads(finished.versions("run_manifest.json")[0].read_text())
    run_id = manifest["run_id"]
    # Newer, different data: what a report would show without pinned versions.
    done = finished.run("--pipelines=simulate,rectify,match,quality", "--params=simulate.noise=0.3")
    assert done.returncode == 0, done.stderr
    reads = ["match_summary", "window_pairs", "elevation", "suns"]
    reads += [f"{m}.{kind}" for m in NAMESPACES for kind in ("quality_table", "surfaces")]
    pinned = "--load-versions=" + ",".join(f"{name}:{run_id}" for name in reads)
    only = "--nodes=run_matches,render_matches"
    done = finished.run(only, pinned)
    assert done.returncode == 0, done.stderr
    new_page = finished.versions("matches.html")[-1]
    assert new_page != old_page
    assert new_page.read_bytes() == old_page.read_bytes()
    newest = finished.run(only)
    assert newest.returncode == 0, newest.stderr
    assert finished.versions("matches.html")[-1].read_bytes() != old_page.read_bytes()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--pipelines=flight"], "flight.folder is not set; name your flight's folder"),
        (["--pipelines=flight", "--params=flight.folder=nowhere"], "nowhere does not exist"),
        (["--params=pc.matcher.method=guess"], "method 'guess' is unknown; use one of"),
        (["--params=simulate.noise=loud"], "parameter simulate.noise = 'loud': Input should be"),
        (["--params=simulate.nois=0.1"], "parameter simulate.nois = 0.1: Extra inputs"),
        (["--params=ingest.map_time=2016-03-20 01:00-05:00"], "sun is below the horizon"),
        (["--params=ingest.map_time=2016-03-20 09:30"], "has no time zone"),
        (["--params=ingest.elevation=missing.tif"], "missing.tif cannot be opened"),
        (
            ["--pipelines=ingest,simulate,rectify", "--params=rectify.window_px=400"],
            "lower rectify.window_px",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_bad_input_ends_with_one_sentence_and_no_traceback(project, words, says):
    done = project.run(*words)
    assert done.returncode == 1
    assert says in done.stderr.split("Error:")[-1]
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--pipelines=mission", "--params=mission.map_hour=2"], "degrees below the horizon"),
        (["--pipelines=mission", "--params=mission.day=2016-12-21"], "never stands at azimuth"),
        (["--pipelines=mission", "--params=mission.setup.leg_px=0.2"], "closer than a map pixel"),
        (["--pipelines=mission", "--params=mission.setup.legs_px=2"], "mission.setup.legs_px = 2"),
        (["--pipelines=navigate", "--params=navigate.sites=no.tif"], "no.tif cannot be opened"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_a_mission_that_cannot_be_flown_is_refused_in_one_sentence(project, words, says):
    test_bad_input_ends_with_one_sentence_and_no_traceback(project, words, says)


def test_failed_run_keeps_what_was_written_and_says_why(finished):
    before = {p: digest(p) for p in finished.versions("*") if p.suffix in DATA}
    done = finished.run("--pipelines=ingest", "--params=ingest.elevation=guess.tif")
    assert done.returncode == 1
    assert all(digest(p) == value for p, value in before.items())
    manifest = json.loads(finished.versions("run_manifest.json")[-1].read_text())
    assert manifest["status"] == "failed"
    assert "guess" in manifest["error"]


def test_failing_notebook_leaves_its_traceback(project):
    source = project.path / "notebooks/walkthroughs/image_formation.py"
    source.write_text(source.read_text() + '\n# %%\nraise ArithmeticError("wrong sign")\n')
    done = project.run("--pipelines=ingest,reporting", "--to-nodes=run_image_formation")
    assert done.returncode == 1
    assert "wrong sign" in done.stderr.split("Error:")[-1]
    kept = project.path / "data/08_reporting/failed/image_formation.ipynb"
    assert "wrong sign" in kept.read_text()
