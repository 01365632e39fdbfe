"""How far to trust a match."""

from pcnav_study.quality.alarm import is_alarm, unrelated_level
from pcnav_study.quality.calibration import Calibration, fit, frozen
from pcnav_study.quality.dirac import delta_similarity, null_level
from pcnav_study.quality.evidence import Evidence, evidence_of
from pcnav_study.quality.null import null_tail, sector_null_level
from pcnav_study.quality.summary import assess, summarise, wilson
from pcnav_study.quality.trust import Trust, trust

__all__ = [
    "Calibration",
    "Evidence",
    "Trust",
    "assess",
    "delta_similarity",
    "evidence_of",
    "fit",
    "frozen",
    "is_alarm",
    "null_level",
    "null_tail",
    "sector_null_level",
    "summarise",
    "trust",
    "unrelated_level",
    "wilson",
]
