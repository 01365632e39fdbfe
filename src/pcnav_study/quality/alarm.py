"""When a quality is no better than unrelated windows reach."""

from __future__ import annotations

from pcnav_study.quality.dirac import null_level
from pcnav_study.quality.null import crowding, sector_null_level

PLAIN = ("pc", "pc-abs")  # methods whose quality is that of one surface, without sectors


def is_alarm(quality: float, candidates: int, *, false_match_rate: float = 0.01) -> bool:
    """True if one surface of unrelated phases would reach this quality too often.

    Where the windows' side is known, compare with `unrelated_level` instead.

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


def unrelated_level(
    method: str, window: tuple[int, int], *, false_match_rate: float = 0.01
) -> float:
    """Quality that unrelated windows exceed at a method's best shift, at most so often.

    For shifts up to a quarter of the window along each axis.

    Parameters
    ----------
    method : str
        The quality of ``pc`` and ``pc-abs`` is that of their own surface.
    window : (rows, columns)
        px
    false_match_rate : float
        Share of unrelated pairs that may pass.
    """
    searched = 1
    for side in window:
        searched *= 2 * (side // 4) + 1
    if method in PLAIN:
        whole = int(window[0] * window[1] / crowding(window, "hann"))
        return null_level(searched, false_match_rate=false_match_rate, whole=whole)
    smallest = (window[0] - window[0] // 4, window[1] - window[1] // 4)
    fitting = (smallest[0] // 4 * 4, smallest[1] // 4 * 4)
    return sector_null_level(fitting, searched, false_match_rate=false_match_rate)
