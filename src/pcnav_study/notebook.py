"""What notebooks need of the project: its data."""

from __future__ import annotations

from pathlib import Path

from kedro.config import OmegaConfigLoader
from kedro.io import DataCatalog
from kedro.utils import find_kedro_project

from pcnav_study.errors import InputError


def project_path(start: str | Path = ".") -> Path:
    """Root of the project that ``start`` lies in."""
    found = find_kedro_project(Path(start).resolve())
    if found is None:
        raise InputError(f"{Path(start).resolve()} is not inside the project; start Jupyter there")
    return Path(found)


def open_catalog(env: str | None = None, versions: dict[str, str] | None = None) -> DataCatalog:
    """The project's datasets: the newest versions, or those asked for.

    Parameters
    ----------
    env : str, optional
        Configuration environment, such as "test".
    versions : dict, optional
        Version by dataset name, as a run's manifest lists them.
    """
    project = project_path()
    config = OmegaConfigLoader(
        conf_source=str(project / "conf"), base_env="base", default_run_env="local", env=env
    )["catalog"]
    for entry in config.values():
        if "filepath" in entry:
            entry["filepath"] = (project / entry["filepath"]).as_posix()
    return DataCatalog.from_config(config, load_versions=versions or None)
