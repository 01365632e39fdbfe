"""Window pairs: what shift is called true, and what leaves the map."""

import numpy as np
import pandas as pd
import pytest
from scipy import ndimage

from pcnav_study.errors import InputError
from pcnav_study.frames import window_pairs
from pcnav_study.scene import (
    Camera,
    Grid,
    SunPosition,
    fly,
    fractal_albedo,
    fractal_relief,
    shade,
    waypoints,
)

GRID = Grid.centred(5000.0, 9000.0, (30.0, 20.0), (150, 180), "EPSG:32616")
SUN = SunPosition(135, 45)
SUNS = pd.DataFrame({"time": ["now"], "azimuth": [135.0], "zenith": [45.0]})


def scene(slope=10.0, position_sigma=60.0, seed=1, ends=((0.45, 0.4), (0.55, 0.6))):
    rng = np.random.default_rng(seed)
    ground = GRID.image(500 + fractal_relief(GRID.shape, (30, 20), rng, median_slope=slope))
    albedo = fractal_albedo(GRID.shape, 0.1, rng, exponent=2.2)
    flight = fly(
        ground,
        albedo,
        SUNS,
        SUN,
        waypoints(ground, *ends, 3),
        Camera.from_field_of_view((200, 200), 70),
        height_above_ground=1500.0,
        attitude_sigma=2.0,
        position_sigma=position_sigma,
        noise=0.0,
        shadows=False,
        rng=rng,
    )
    return flight, shade(ground, sun=SUN) * albedo, ground


def misfit(moving, reference, shift):
    """RMS difference in the middle once the moving window is shifted."""
    moved = ndimage.shift(np.nan_to_num(moving, nan=np.nanmean(moving)), shift, order=1)
    middle = np.s_[12:-12, 12:-12]
    return np.sqrt(np.mean((moved - reference)[middle] ** 2)) / reference[middle].std()


@pytest.mark.parametrize("seed", range(3))
def test_the_true_shift_applied_to_the_moving_window_registers_it(seed):
    flight, reference, ground = scene(slope=1.0, seed=seed)
    pairs = window_pairs(flight, reference, ground, size=48)
    assert np.abs([pairs["true_row"], pairs["true_col"]]).max() > 1.5
    for k in range(3):
        pair = pairs.isel(frame=k)
        shift = np.array([float(pair["true_row"]), float(pair["true_col"])])
        best = misfit(pair["moving"].values, pair["reference"].values, shift)
        assert best < 0.25
        wrong = [shift * s for s in ([-1, 1], [1, -1], [-1, -1], [0, 0])]
        wrong.append(shift[::-1])
        for other in wrong:
            if np.abs(other - shift).max() > 1.5:
                assert misfit(pair["moving"].values, pair["reference"].values, other) > 1.5 * best


def test_the_true_shift_is_the_position_error_in_pixels():
    flight, reference, ground = scene()
    flight = flight.assign_coords(  # the truth lies east and south of where it is believed
        believed_east=flight["east"] - 40, believed_north=flight["north"] + 90
    )
    pairs = window_pairs(flight, reference, ground, size=48)
    assert float(pairs["true_row"][0]) == pytest.approx(3)  # so the window moves down
    assert float(pairs["true_col"][0]) == pytest.approx(2)  # and to the right


def test_relief_matters_under_the_frames():
    flight, reference, ground = scene(slope=25.0, position_sigma=0.0)
    over_relief = window_pairs(flight, reference, ground, size=64)
    over_level = window_pairs(flight, reference, ground, size=64, relief=False)

    def worst(pairs):
        return max(
            misfit(p["moving"].values, p["reference"].values, (0, 0))
            for p in (pairs.isel(frame=k) for k in range(3))
        )

    assert worst(over_relief) < 0.6 * worst(over_level)


def test_reference_windows_are_the_maps_own_pixels_around_the_believed_position():
    flight, reference, ground = scene()
    pairs = window_pairs(flight, reference, ground, size=48)
    assert pairs["reference"].shape == pairs["moving"].shape == (3, 48, 48)
    assert pairs.attrs["pixel_m"] == [30, 20]
    for k in range(3):
        at = float(flight["believed_east"][k]), float(flight["believed_north"][k])
        row, col = (int(np.rint(v)) for v in GRID.row_col(*at))
        part = reference.values[row - 24 : row + 24, col - 24 : col + 24]
        np.testing.assert_array_equal(pairs["reference"][k], part.astype(np.float32))


def test_the_flights_columns_come_along():
    flight, reference, ground = scene()
    pairs = window_pairs(flight, reference, ground, size=48)
    for name in ("time", "waypoint", "sun_difference", "believed_east", "yaw"):
        np.testing.assert_array_equal(pairs[name], flight[name])


@pytest.mark.parametrize("end", [(0.02, 0.5), (0.98, 0.5), (0.5, 0.02), (0.5, 0.98)])
def test_a_route_whose_windows_leave_the_map_is_refused(end):
    flight, reference, ground = scene(position_sigma=0.0, ends=((0.5, 0.5), end))
    with pytest.raises(InputError, match=r"now #2.*leaves the map; shorten the route"):
        window_pairs(flight, reference, ground, size=48)
