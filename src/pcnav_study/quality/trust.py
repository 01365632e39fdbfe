"""How far to trust one match: a probability, an alarm and an error radius."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pcnav_study.matching import MatchResult, prepare
from pcnav_study.matching.pair import Pair, reach_of
from pcnav_study.matching.sectors import score_surface
from pcnav_study.matching.windows import Window
from pcnav_study.quality.calibration import Calibration, frozen
from pcnav_study.quality.evidence import NOTHING, Evidence, evidence_of


class Trust(NamedTuple):
    """What a match is worth.

    Attributes
    ----------
    probability : float
        That the shift is within the tolerance (1 px) of the truth.
    alarm : bool
        True if the match should not be believed.
    radius_px : float
        Holds the truth for 95 in 100 matches of like score; infinite if none can be stated.
    evidence : Evidence
        What it rests on.
    """

    probability: float
    alarm: bool
    radius_px: float
    evidence: Evidence


def trust(
    result: MatchResult,
    reference: ArrayLike | Window,
    moving: ArrayLike | Window,
    *,
    calibration: Calibration | None = None,
) -> Trust:
    """Trust in a match of two images, whatever their size and their suns.

    Parameters
    ----------
    result : MatchResult
        Of these very images. One of another method than ``pc-sectors`` is judged by the
        same ruler, which then costs a search of its own.
    reference, moving : (rows, columns) array, or Window
        As they were given to `match`; a Window spares checking the image again.
    calibration : Calibration, optional
        By default the one that ships with the package.

    Returns
    -------
    Trust
        With an alarm, probability near 0 and an infinite radius where nothing can be seen.
    """
    known = calibration or frozen()
    ours, theirs = prepare(reference, "reference"), prepare(moving, "moving")
    if ours.is_empty or theirs.is_empty:
        return judged(NOTHING, known)
    surface, quality = result.surface, None
    if result.method == "pc-sectors":
        quality = result.quality
    else:
        surface = score_surface(Pair(ours, theirs, reach_of(ours, theirs, None)))
    return judged(evidence_of(ours, theirs, result.shift, surface, quality), known)


def judged(evidence: Evidence, calibration: Calibration) -> Trust:
    """Trust that evidence deserves."""
    if evidence.quality <= 0:
        return Trust(calibration.probabilities[0], True, float("inf"), evidence)
    score = calibration.score(np.array([evidence]))
    return Trust(
        float(calibration.probability(score)[0]),
        bool(score[0] < calibration.threshold),
        float(calibration.radius(score)[0]),
        evidence,
    )
