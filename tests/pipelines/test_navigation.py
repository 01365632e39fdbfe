"""The closed loop's pages: one flight in motion, and a fleet's verdicts."""

import json

import pandas as pd
import pytest


def test_mission_page_plays_when_asked_and_comes_out_equal_again(finished):
    page = finished.versions("mission.html")[0]
    text = page.read_text()
    assert text.count("Plotly.addFrames(") == 2, "one flight, and all methods side by side"
    assert "Plotly.animate(" not in text, "it does not start by itself"
    assert len(text) < 3e6
    log = pd.read_json(finished.versions("mission_log.jsonl")[0], lines=True)
    for method, flight in log.groupby("method"):
        assert f"<strong>{method}</strong>: {flight['ending'].iloc[-1]}" in text
    assert all(reason in text for reason in log["reason"])
    version = page.parent.name
    pinned = f"--load-versions=mission_log:{version},mission_map:{version}"
    done = finished.run("--nodes=run_mission,render_mission", pinned)
    assert done.returncode == 0, done.stderr
    again = finished.versions("mission.html")[-1]
    assert again != page
    assert again.read_bytes() == page.read_bytes()


@pytest.mark.slow
def test_fleet_page_judges_every_demand(finished):
    done = finished.run("--pipelines=navigate", "--params=navigate.jobs=1")
    assert done.returncode == 0, done.stderr
    text = finished.versions("navigation.html")[-1].read_text()
    assert text.count("Plotly.newPlot(") == 5
    assert text.count("<td>holds") + text.count("<strong>does not hold</strong>") >= 6
    for method in ("pc-sectors", "odometry"):
        assert f">{method}</td>" in text
    assert "not measured" in text, "the small study times no large frame"
    index = (finished.path / "data/08_reporting/site/index.html").read_text()
    assert "Does it find its way?" in index
    manifest = json.loads(finished.versions("run_manifest.json")[-1].read_text())
    assert "navigation_summary" in manifest["outputs"]
