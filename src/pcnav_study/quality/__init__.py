"""How far to trust a match."""

from pcnav_study.quality.alarm import is_alarm
from pcnav_study.quality.dirac import delta_similarity, null_level
from pcnav_study.quality.summary import assess, summarise, wilson

__all__ = ["assess", "delta_similarity", "is_alarm", "null_level", "summarise", "wilson"]
