"""When a match should not be believed."""

from __future__ import annotations

from pcnav_study.quality.dirac import null_level


def is_alarm(quality: float, candidates: int, *, false_match_rate: float = 0.01) -> bool:
    """True if unrelated windows would reach this quality too often.

    Parameters
    ----------
    quality : float
        Dirac-delta quality of the match.
    candidates : int
        Shifts it was chosen from.
    false_match_rate : float
        Share of unrelated pairs that may pass unalarmed.
    """
    return quality < null_level(candidates, false_match_rate=false_match_rate)
