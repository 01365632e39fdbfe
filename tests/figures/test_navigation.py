"""Figures of fleets show what the summary says."""

import pandas as pd

from pcnav_study.figures import error_by_hour


def test_every_day_has_a_panel_and_its_hours_in_order():
    rows = [
        {"site": "hills", "time": f"{day} {hour:02d}:30Z", "gust": gust, "method": "pc",
         "rmse_px": hour / 10, "arrival_rate": 1.0, "flights": 7, "sun_difference_deg": 20.0}
        for day in ("2016-06-21", "2016-12-21")
        for hour in (15, 9, 12)
        for gust in (0.0, 1.0)
    ]  # fmt: skip
    figure = error_by_hour(pd.DataFrame(rows))
    assert [t.y.tolist() for t in figure.data] == [[0.9, 1.2, 1.5]] * 2
    titles = [note.text for note in figure.layout.annotations]
    assert titles == ["hills, 2016-06-21", "hills, 2016-12-21"]
    assert "n = 7 flights" in figure.layout.title.text
