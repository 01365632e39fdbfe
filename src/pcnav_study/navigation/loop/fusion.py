"""A Kalman filter over velocity sensor, odometry and fixes, by Stone Soup.

The state is the position and the bias of the velocity sensor. Measured velocity carries
the position; what odometry shows less tells the bias, unless it is beyond a gate; fixes tell the
position. The models
are linear, so the extended filter equals the plain one [1]_; a non-linear sensor needs no
other class.

References
----------
.. [1] Bar-Shalom, Li, Kirubarajan (2001), Estimation with Applications to Tracking and
   Navigation, sections 5.2 and 10.3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from stonesoup.models.control.linear import LinearControlModel
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.linear import LinearGaussianTimeInvariantTransitionModel
from stonesoup.predictor.kalman import ExtendedKalmanPredictor
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState, State
from stonesoup.updater.kalman import ExtendedKalmanUpdater

from pcnav_study.navigation.loop.estimators import Belief
from pcnav_study.navigation.loop.odometry import SIGMA_PX, Odometry
from pcnav_study.navigation.loop.sensors import Instruments, Observation

Array = NDArray[np.float64]
GATE = 18.4  # of the squared Mahalanobis distance in the plane: once in 10,000
POSITION, BIAS = (0, 1), (2, 3)  # in the state: each (east, north)


class Kalman:
    """An estimator; see the module. Units are metres and metres per second."""

    def __init__(self, start: Belief, odometry: Odometry, instruments: Instruments) -> None:
        self._odometry, self._of = odometry, instruments
        self._updater = ExtendedKalmanUpdater()
        variances = [start.sigma**2] * 2 + [instruments.velocity_bias**2] * 2
        self._state = GaussianState(
            np.concatenate([start.position, np.zeros(2)])[:, None], np.diag(variances)
        )

    def predict(self, seen: Observation) -> Belief:
        """Carry the position by the measured velocity, then learn its bias from odometry."""
        seconds, before = seen.seconds, self._belief().position
        bias = np.asarray(self._state.state_vector, np.float64)[list(BIAS), 0]
        guess = before + (seen.velocity - bias) * seconds
        way = self._odometry.way(seen, before, guess)
        if seconds == 0:
            return self._belief()
        self._state = self._predictor(seconds).predict(
            self._state, control_input=State(seen.velocity[:, None])
        )
        spread = SIGMA_PX * self._odometry.pixel / seconds
        shown = seen.velocity - way / seconds
        if self._explains(shown, spread):
            return self._measured(shown, BIAS, spread)
        return self._belief()

    def correct(self, position: Array, sigma: float, *, anew: bool = False) -> Belief:
        """Take in a fix; ``anew`` places the state there and keeps the bias."""
        if anew:
            mean = np.array(self._state.state_vector, np.float64)
            covariance = np.array(self._state.covar, np.float64)
            mean[list(POSITION), 0] = position
            covariance[:2, :] = covariance[:, :2] = 0.0
            covariance[:2, :2] = sigma**2 * np.eye(2)
            self._state = GaussianState(mean, covariance)
            return self._belief()
        return self._measured(position, POSITION, sigma)

    def _explains(self, bias: Array, spread: float) -> bool:
        """Whether the odometer's word on the bias is within reach; frames may not overlap."""
        mean = np.asarray(self._state.state_vector, np.float64)[list(BIAS), 0]
        own = np.asarray(self._state.covar, np.float64)[2:, 2:] + spread**2 * np.eye(2)
        away = bias - mean
        return bool(away @ np.linalg.solve(own, away) < GATE)

    def _predictor(self, seconds: float) -> ExtendedKalmanPredictor:
        eye, nothing = np.eye(2), np.zeros((2, 2))
        carried = np.block([[eye, -seconds * eye], [nothing, eye]])
        walk = (self._of.velocity_drift**2) * seconds
        noise = (self._of.velocity_noise * seconds) ** 2
        return ExtendedKalmanPredictor(
            LinearGaussianTimeInvariantTransitionModel(
                transition_matrix=carried, covariance_matrix=np.diag([noise] * 2 + [walk] * 2)
            ),
            LinearControlModel(np.vstack([seconds * eye, nothing])),
        )

    def _measured(self, value: Array, which: tuple[int, int], sigma: float) -> Belief:
        model = LinearGaussian(4, which, np.eye(2) * sigma**2)
        detection = Detection(np.asarray(value)[:, None], measurement_model=model)
        self._state = self._updater.update(SingleHypothesis(self._state, detection))
        return self._belief()

    def _belief(self) -> Belief:
        mean = np.asarray(self._state.state_vector, np.float64)[:2, 0]
        sigma = float(np.sqrt(np.trace(np.asarray(self._state.covar, np.float64)[:2, :2]) / 2))
        return Belief(mean, sigma)
