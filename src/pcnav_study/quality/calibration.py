"""From evidence to the probability that a shift is right, with a guaranteed alarm.

A logistic regression of the evidence's logarithms, their squares and products ranks the
matches; an isotonic regression on other sites turns the rank into a probability. The
alarm's threshold is a conformal quantile [1]_: if new matches are exchangeable with the
calibration's, a right one raises the alarm with probability ``false_alarm_rate`` at most,
whatever the distributions and for any sample size. The error radius is the same kind of
quantile of the errors, among matches of like score [2]_.

References
----------
.. [1] Vovk, Gammerman, Shafer (2005), Algorithmic Learning in a Random World, chapter 2.
.. [2] Vovk (2012), Proc. Machine Learning Research 25, 475-490 (Mondrian classes).
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from functools import lru_cache
from importlib import resources
from math import ceil, floor
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pcnav_study.errors import InputError
from pcnav_study.quality.evidence import Evidence

Array = NDArray[np.float64]
SMALLEST_VALUE = 1e-3  # of any evidence before its logarithm
TOLERANCE = 1.0  # px
CHANCE = 2.8  # times the null's mean; unrelated windows reach 2.4 to 2.8 at the best of shifts
FINE = 20.0  # log odds for each unit below
FROZEN = "calibration.json"


@dataclass(frozen=True)
class Calibration:
    """Everything that turns evidence into trust.

    Attributes
    ----------
    mean, scale : (features,)
        Of the logarithms of the evidence.
    weights : (terms,)
        Of the terms 1, x_i, and x_i x_j with i <= j.
    scores, probabilities : (knots,)
        Isotonic map, both ascending.
    threshold : float
        Score below which the alarm is raised.
    radius_scores, radii_px : (classes,)
        Lower ends of the classes of scores, and the error radius of each.
    tolerance_px, false_alarm_rate, radius_coverage : float
        What is promised.
    made_from : dict
        Sample sizes and parameters.
    """

    mean: tuple[float, ...]
    scale: tuple[float, ...]
    weights: tuple[float, ...]
    scores: tuple[float, ...]
    probabilities: tuple[float, ...]
    threshold: float
    radius_scores: tuple[float, ...]
    radii_px: tuple[float | None, ...]
    tolerance_px: float
    false_alarm_rate: float
    radius_coverage: float
    made_from: dict[str, Any]

    def score(self, evidence: Array) -> Array:
        """Log odds (n,) of evidence (n, features), before the isotonic map."""
        return scored(evidence, np.array(self.mean), np.array(self.scale), np.array(self.weights))

    def probability(self, score: Array) -> Array:
        """Probability that the shift is within ``tolerance_px``."""
        return np.asarray(np.interp(score, self.scores, self.probabilities))

    def radius(self, score: Array) -> Array:
        """Radius in px that holds the truth with ``radius_coverage``; infinite if none does."""
        which = np.searchsorted(self.radius_scores, score, side="right") - 1
        radii = np.array([np.inf if r is None else r for r in self.radii_px])
        return np.where(which < 0, np.inf, radii[np.maximum(which, 0)])


def terms(evidence: Array, mean: Array, scale: Array) -> Array:
    """1, x_i and x_i x_j (n, terms) of the standardised logarithms x."""
    x = (np.log(np.maximum(evidence, SMALLEST_VALUE)) - mean) / scale
    rows, cols = np.triu_indices(x.shape[1])
    return np.concatenate([np.ones((len(x), 1)), x, x[:, rows] * x[:, cols]], axis=1)


def scored(evidence: Array, mean: Array, scale: Array, weights: Array) -> Array:
    """Log odds, less a fine for a quality that chance reaches at the best of many shifts.

    Far from its training a regression may say anything; the null may not be overruled.
    """
    short = CHANCE - evidence[:, Evidence._fields.index("above_null")]
    return np.asarray(terms(evidence, mean, scale) @ weights - FINE * np.maximum(short, 0.0))


def fit(
    training: pd.DataFrame,
    calibration: pd.DataFrame,
    *,
    false_alarm_rate: float,
    radius_coverage: float = 0.95,
    classes: int = 24,
) -> Calibration:
    """Learn the ranking from one table and everything else from another.

    Parameters
    ----------
    training, calibration : DataFrame
        Columns as `Evidence`, ``kind`` and ``error_px``; of different sites. The alarm's
        promise is for right matches of kind ``match``: a clear view of the ground.
    false_alarm_rate : float
        Share of right matches that may raise the alarm.
    radius_coverage : float
        Share of matches whose truth lies within the radius.
    classes : int
        Of scores that share a radius.

    Raises
    ------
    InputError
        If either table lacks right or wrong matches, or too few right ones for the rate.
    """
    from sklearn.isotonic import IsotonicRegression
    from sklearn.linear_model import LogisticRegression

    x, right = _known(training, "training")
    logs = np.log(np.maximum(x, SMALLEST_VALUE))
    mean, scale = logs.mean(axis=0), np.maximum(logs.std(axis=0), 1e-6)
    model = LogisticRegression(C=1.0, max_iter=10_000, tol=1e-8)
    model.fit(terms(x, mean, scale)[:, 1:], right)
    weights = np.concatenate([model.intercept_, model.coef_[0]])

    x, right = _known(calibration, "calibration")
    scores = scored(x, mean, scale, weights)
    plain = (calibration["kind"] == "match").to_numpy()
    isotonic = IsotonicRegression(out_of_bounds="clip").fit(scores, right)
    edge = 1 / (len(right) + 2)
    probabilities = np.clip(isotonic.y_thresholds_, edge, 1 - edge)
    ends, radii = _radii(scores, calibration["error_px"].to_numpy(), radius_coverage, classes)
    return Calibration(
        mean=_plain(mean), scale=_plain(scale), weights=_plain(weights),
        scores=_plain(isotonic.X_thresholds_), probabilities=_plain(probabilities),
        threshold=conformal_threshold(scores[right & plain], false_alarm_rate),
        radius_scores=_plain(ends),
        radii_px=tuple(round(float(r), 6) if np.isfinite(r) else None for r in radii),
        tolerance_px=TOLERANCE, false_alarm_rate=false_alarm_rate,
        radius_coverage=radius_coverage,
        made_from={"n_training": len(training), "n_calibration": len(calibration),
                   "n_right": int(right.sum())},
    )  # fmt: skip


def conformal_threshold(right_scores: Array, rate: float) -> float:
    """Level that a new right score falls below with probability ``rate`` at most.

    The floor(rate (n + 1))-th smallest of n scores: by exchangeability the new one is
    equally likely to take any of the n + 1 ranks.

    Raises
    ------
    InputError
        If n is too small for the rate.
    """
    rank = floor(rate * (len(right_scores) + 1))
    if rank < 1:
        raise InputError(
            f"{len(right_scores)} right matches cannot promise a rate of {rate:g}; "
            f"give at least {ceil(1 / rate) - 1}"
        )
    return float(np.sort(right_scores)[rank - 1])


def conformal_radius(errors: Array, coverage: float) -> float:
    """Radius that holds a new error with probability ``coverage`` at least; may be infinite."""
    rank = ceil(round(coverage * (len(errors) + 1), 9))
    return float(np.sort(errors)[rank - 1]) if rank <= len(errors) else float("inf")


def _radii(scores: Array, errors: Array, coverage: float, classes: int) -> tuple[Array, Array]:
    """Lower ends of equally filled classes of scores, and each one's radius."""
    ends = np.quantile(scores, np.arange(classes) / classes)
    which = np.searchsorted(ends, scores, side="right") - 1
    radii = [conformal_radius(errors[which == k], coverage) for k in range(classes)]
    return ends, np.array(radii)


def _known(table: pd.DataFrame, name: str) -> tuple[Array, NDArray[np.bool_]]:
    right = (table["error_px"] <= TOLERANCE).to_numpy()
    if right.all() or not right.any():
        raise InputError(
            f"the {name} table has only {'right' if right.any() else 'wrong'} matches; "
            "draw more kinds of pairs"
        )
    return table[list(Evidence._fields)].to_numpy(float), right


def _plain(values: Any) -> tuple[float, ...]:
    return tuple(float(f"{v:.9g}") for v in np.asarray(values, float))


def as_json(calibration: Calibration) -> dict[str, Any]:
    """The calibration in types that JSON knows."""
    plain: dict[str, Any] = json.loads(json.dumps(asdict(calibration)))
    return plain


def from_json(stored: dict[str, Any]) -> Calibration:
    """The calibration that `as_json` stored."""
    lists: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in stored.items()}
    return Calibration(**lists)


@lru_cache(maxsize=1)
def frozen() -> Calibration:
    """The calibration that ships with the package."""
    text = resources.files("pcnav_study.quality").joinpath(FROZEN).read_text("utf-8")
    return from_json(json.loads(text))
