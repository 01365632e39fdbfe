"""The house stands: floors import downwards only, and nothing below the third knows Kedro."""

import ast
from pathlib import Path

import pytest

import pcnav_study

ROOT = Path(pcnav_study.__file__).parent
FLOOR = {"scene": 1, "frames": 1, "matching": 1, "quality": 1, "experiments": 2, "navigation": 2}
EVERYWHERE = {"errors", "progress"}
MODULES = sorted(p for floor in FLOOR for p in (ROOT / floor).rglob("*.py"))


def imported(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_a_module_imports_only_from_its_floor_and_below(path):
    own = FLOOR[path.relative_to(ROOT).parts[0]]
    for name in imported(path):
        parts = name.split(".")
        assert parts[0] not in {"kedro", "kedro_datasets", "papermill", "plotly"}, name
        if parts[0] == "pcnav_study" and len(parts) > 1 and parts[1] not in EVERYWHERE:
            assert FLOOR.get(parts[1], 3) <= own, name


@pytest.mark.parametrize("path", sorted(ROOT.rglob("*.py")), ids=lambda p: p.name)
def test_a_module_holds_at_most_300_lines(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 300
