"""Dead reckoning and odometry against the truth, the filter against its textbook algebra."""

import numpy as np
import pytest

from pcnav_study.navigation.loop import navigator
from pcnav_study.navigation.loop.estimators import Belief, DeadReckoning
from pcnav_study.navigation.loop.fusion import Kalman
from pcnav_study.navigation.loop.lookout import Lookout
from pcnav_study.navigation.loop.odometry import SIGMA_PX, Odometry
from pcnav_study.navigation.loop.sensors import Instruments, Observation, Sensors
from pcnav_study.navigation.loop.world import Air, Aircraft

ORIGIN = Belief(np.array([10.0, -5.0]), 3.0)


def reading(velocity, seconds):
    return Observation(np.zeros((4, 4), np.float32), 0, 0, 0, 1000.0, np.array(velocity), seconds)


def test_dead_reckoning_adds_the_way_and_its_error_grows():
    reckoning = DeadReckoning(ORIGIN, Instruments())
    one = reckoning.predict(reading((4.0, 1.0), 10.0))
    two = reckoning.predict(reading((0.0, -2.0), 5.0))
    np.testing.assert_allclose(two.position, [50.0, -5.0])
    assert 3.0 < one.sigma < two.sigma
    assert reckoning.correct(np.zeros(2), 1.0).sigma == 1.0
    np.testing.assert_allclose(reckoning.predict(reading((1.0, 0.0), 2.0)).position, [2.0, 0.0])


@pytest.fixture(scope="module")
def frames(flight):
    """A mission and what is seen at five places 300 m apart, with a velocity 2 m/s wrong."""
    one = flight(calm=True)
    direction = np.diff(one.pilot.route.waypoints[:2], axis=0)[0]
    direction = direction / np.hypot(*direction)
    uav = Aircraft(
        one.pilot.route.waypoints[0], one.scene.height, 0.0, Air(), 1.0, np.random.default_rng(2)
    )
    sensors = Sensors(one.instruments, np.random.default_rng(0))
    seen = [sensors.observe(uav, one.scene, 0.0)]
    truth = [uav.position]
    for _ in range(4):
        uav.fly(30.0 * direction, 10.0, np.zeros(2))
        told = sensors.observe(uav, one.scene, 10.0)
        seen.append(
            Observation(told.frame, told.yaw, told.pitch, told.roll, told.height,
                        told.velocity + np.array([2.0, 0.0]), 10.0)
        )  # fmt: skip
        truth.append(uav.position)
    return one, seen, np.array(truth)


def test_odometry_over_relief_follows_the_truth_where_dead_reckoning_drifts(frames):
    one, seen, truth = frames
    lookout = Lookout(one.chart, one.scene.camera)
    start = Belief(truth[0], 1.0)
    relief, level = (Odometry(start, lookout, relief=r) for r in (True, False))
    reckoning = DeadReckoning(start, Instruments())
    ends = [[e.predict(s).position for s in seen][-1] for e in (relief, level, reckoning)]
    errors = [np.hypot(*(end - truth[-1])) for end in ends]
    assert errors[0] < 0.5 * one.chart.pixel
    assert errors[0] < errors[1]
    assert errors[2] == pytest.approx(80.0, abs=1.0)


class Told(Odometry):
    """Odometry that is told the way."""

    def __init__(self, ways, pixel):
        self.pixel, self._ways = pixel, iter(ways)

    def way(self, seen, start, guess):
        return next(self._ways)


def test_the_filter_equals_the_kalman_equations(rng):
    of = Instruments(velocity_bias=0.7, velocity_drift=0.1, velocity_noise=0.3)
    seconds, pixel = 8.0, 30.0
    ways = rng.normal(0, 1.0, (5, 2))
    ours = Kalman(ORIGIN, Told(ways, pixel), of)
    mean = np.concatenate([ORIGIN.position, np.zeros(2)])
    spread = np.diag([9.0, 9.0, 0.49, 0.49])
    carry = np.eye(4)
    carry[:2, 2:] = -seconds * np.eye(2)
    noise = np.diag([(0.3 * seconds) ** 2] * 2 + [0.01 * seconds] * 2)

    def update(mean, spread, value, rows, sigma):
        look = np.eye(4)[rows]
        gain = spread @ look.T @ np.linalg.inv(look @ spread @ look.T + sigma**2 * np.eye(2))
        return mean + gain @ (value - look @ mean), (np.eye(4) - gain @ look) @ spread

    for k, way in enumerate(ways):
        velocity = rng.normal(0, 0.3, 2)  # within the odometer's gate
        belief = ours.predict(reading(velocity, seconds))
        mean, spread = carry @ mean, carry @ spread @ carry.T + noise
        mean[:2] += seconds * velocity
        sigma = SIGMA_PX * pixel / seconds
        mean, spread = update(mean, spread, velocity - way / seconds, [2, 3], sigma)
        np.testing.assert_allclose(belief.position, mean[:2], rtol=1e-9)
        assert belief.sigma == pytest.approx(np.sqrt(np.trace(spread[:2, :2]) / 2))
        if k == 2:
            fix = mean[:2] + np.array([40.0, -10.0])
            belief = ours.correct(fix, 9.0)
            mean, spread = update(mean, spread, fix, [0, 1], 9.0)
            np.testing.assert_allclose(belief.position, mean[:2], rtol=1e-9)


def test_a_filter_that_starts_anew_is_where_the_fix_is():
    filter_ = Kalman(ORIGIN, Told([], 30.0), Instruments())
    belief = filter_.correct(np.array([9000.0, 1.0]), 5.0, anew=True)
    np.testing.assert_allclose(belief.position, [9000.0, 1.0])
    assert belief.sigma == pytest.approx(5.0)


def test_the_filter_does_not_believe_an_odometer_that_lost_its_ground():
    filter_ = Kalman(
        ORIGIN, Told([np.array([80.0, 0.0]), np.array([900.0, 0.0])], 30.0), Instruments()
    )
    filter_.predict(reading((10.0, 0.0), 8.0))
    belief = filter_.predict(reading((10.0, 0.0), 8.0))
    assert belief.position[0] == pytest.approx(170.0, abs=2.0)


def test_after_a_gust_the_fused_navigator_is_as_good_as_before(flight):
    one = flight(seed=4).with_gust(0.7 * 80 * 30.0, 2)
    log = list(one.fly(navigator("odometry and fixes, EKF", one)))
    late = [row["error_m"] for row in log if row["step"] >= 2]
    assert max(late) < 0.7 * one.chart.pixel
    assert sum(row["alarm"] for row in log) == 1
