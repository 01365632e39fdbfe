"""Where the moving image lies on the reference: one ``match`` for every method."""

from pcnav_study.matching.methods import METHODS, MatchResult, match
from pcnav_study.matching.pair import Found, Matcher, Pair
from pcnav_study.matching.rotation_scale import RotationScale, rotation_scale
from pcnav_study.matching.stack import StackResult, match_stack
from pcnav_study.matching.subpixel import ESTIMATORS
from pcnav_study.matching.surface import Surface
from pcnav_study.matching.windows import Window, prepare

__all__ = [
    "ESTIMATORS",
    "METHODS",
    "Found",
    "MatchResult",
    "Matcher",
    "Pair",
    "RotationScale",
    "StackResult",
    "Surface",
    "Window",
    "match",
    "match_stack",
    "prepare",
    "rotation_scale",
]
