"""The animation shows what the log says, frame by frame."""

import numpy as np
import pandas as pd
import pytest

from pcnav_study.figures import mission_animation, mission_panels
from pcnav_study.scene import Grid

GUST = 2


def flight(method, steps, ending):
    rows = []
    for k in range(steps):
        east = 1000.0 * k
        rows.append(
            {
                "method": method, "step": k, "east": east, "north": 0.0, "believed_east": east,
                "believed_north": 10.0, "target_east": east + 1000, "target_north": 0.0,
                "error_m": 10.0, "next_error_m": np.nan if k == 0 else 20.0, "push_m": 0.0,
                "footprint": [[east, 0], [east + 1, 0], [east + 1, 1], [east, 1]],
                "quality": 0.3, "action": "fix", "alarm": False, "reason": "", "note": "",
                "ending": ending if k == steps - 1 else "",
            }
        )  # fmt: skip
    table = pd.DataFrame(rows)
    table.loc[GUST, ["push_m", "alarm", "reason"]] = [500.0, True, "a jump"]
    return table


@pytest.fixture
def log():
    return pd.concat([flight("pc", 5, "arrived"), flight("ncc", 3, "left the map")])


@pytest.fixture
def picture():
    grid = Grid.centred(2000.0, 0.0, (50.0, 50.0), (90, 120), "EPSG:32611")
    image = grid.image(np.random.default_rng(0).random((90, 120)), "radiance")
    image.attrs["route"] = [0.0, 0.0, 4000.0, 0.0]
    return image


def named(figure, frame, name):
    """The trace of that name in one frame."""
    shown = figure.frames[frame]
    (number,) = [i for i in shown.traces if figure.data[i].name == name]
    return shown.data[list(shown.traces).index(number)]


def test_way_grows_by_a_frame_and_is_broken_by_the_gust(log, picture):
    figure = mission_animation(log, picture, "pc")
    assert len(figure.frames) == 5
    assert list(named(figure, 1, "where it is").x) == [0.0, 1.0]
    assert list(named(figure, 4, "where it is").x) == [0.0, 1.0, None, 2.0, 3.0, 4.0]
    assert list(named(figure, 1, "gust").x) == [None]
    assert list(named(figure, GUST, "gust").x) == [1.0, 2.0]


def test_footprint_changes_its_colour_under_an_alarm(log, picture):
    figure = mission_animation(log, picture, "pc")
    for frame in range(5):
        calm = named(figure, frame, "this frame on the ground").x
        alarmed = named(figure, frame, "the same, under an alarm").x
        assert len(alarmed if frame == GUST else calm) == 5, "a closed outline"
        assert list(calm if frame == GUST else alarmed) == [None]
    assert "a jump" in figure.frames[GUST].layout.title.text


def test_flight_that_is_over_stays_and_says_how_it_ended(log, picture):
    figure = mission_panels(log, picture)
    assert [f.name for f in figure.frames] == ["0", "1", "2", "3", "4"]
    at_end, later = (figure.frames[k] for k in (2, 4))
    half = len(later.data) // 2
    assert later.data[half:] == at_end.data[half:]
    told = [note.text for note in later.layout.annotations]
    assert "arrived" in told[0] and "left the map" in told[1]
