"""The closed loop's pages: one flight in motion."""

import pandas as pd


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
