"""Controlled trials: every method on the same pairs, over everything that may break it."""

from pcnav_study.experiments.cells import Cell, Task, break_points, judge, light_grid, sweep

__all__ = ["Cell", "Task", "break_points", "judge", "light_grid", "sweep"]
