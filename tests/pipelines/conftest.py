"""A copy of the project, run once at the small size."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


class Project:
    """A project folder in which ``kedro run`` is called as a user calls it."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @classmethod
    def fresh(cls, path: Path) -> "Project":
        for name in ("conf", "notebooks", "src"):
            shutil.copytree(ROOT / name, path / name)
        shutil.copy(ROOT / "pyproject.toml", path)
        (path / "data").mkdir()
        return cls(path)

    def run(self, *words: str, env: str | None = "test") -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "kedro", "run", *words]
        if env:
            command.append(f"--env={env}")
        environment = os.environ | {"PYTHONPATH": str(self.path / "src"), "DO_NOT_TRACK": "1"}
        return subprocess.run(
            command, cwd=self.path, env=environment, capture_output=True, text=True, check=False
        )

    def versions(self, name: str) -> list[Path]:
        """Files of a dataset, oldest first."""
        return sorted(p for p in (self.path / "data").rglob(name) if p.is_file())


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A project whose default pipelines have run once. Tests may add runs, never remove."""
    project = Project.fresh(tmp_path_factory.mktemp("study"))
    done = project.run()
    assert done.returncode == 0, done.stderr
    return project


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """An empty project."""
    return Project.fresh(tmp_path)
