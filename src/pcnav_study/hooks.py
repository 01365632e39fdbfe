"""What every run records: which versions it read and wrote, and from what."""

from __future__ import annotations

import hashlib
import json
import logging
import subprocess
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

from kedro.framework.context import KedroContext
from kedro.framework.hooks import hook_impl
from kedro.io import AbstractVersionedDataset, CatalogProtocol, MemoryDataset
from kedro.pipeline import Pipeline
from packaging.requirements import Requirement

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class Run:
    """The run in progress, for nodes that hand its versions to a notebook.

    Parameters
    ----------
    save_version : str
        Version that this run writes; also its id.
    env : str or None
        Configuration environment.
    """

    save_version: str
    env: str | None
    catalog: CatalogProtocol[Any, Any]

    def version(self, name: str) -> str | None:
        """Version of a dataset that this run reads; None if it has none."""
        dataset = self.catalog[name]
        versioned = isinstance(dataset, AbstractVersionedDataset) and dataset._version
        return dataset.resolve_load_version() if versioned else None

    def versions(self, name: str) -> list[str]:
        """All versions of a dataset on disk, newest first."""
        path = Path(str(getattr(self.catalog[name], "_filepath", "")))
        return sorted((p.parent.name for p in path.glob(f"*/{path.name}")), reverse=True)


class RunVersions:
    """Offers the run itself as the dataset ``run``."""

    def __init__(self) -> None:
        self._env: str | None = None

    @hook_impl
    def after_context_created(self, context: KedroContext) -> None:
        """Remember the environment."""
        self._env = context.env

    @hook_impl
    def after_catalog_created(self, catalog: CatalogProtocol[Any, Any], save_version: str) -> None:
        """Put the run into the catalog."""
        run = Run(save_version, self._env, catalog)
        catalog["run"] = MemoryDataset(run, copy_mode="assign")


class RunManifest:
    """Writes ``run_manifest`` when a run ends, well or not."""

    def __init__(self) -> None:
        self._parameters: dict[str, Any] = {}
        self._read: dict[str, None] = {}
        self._written: dict[str, None] = {}

    @hook_impl
    def after_catalog_created(self, parameters: dict[str, Any]) -> None:
        """Remember the parameters and start anew."""
        self._parameters, self._read, self._written = parameters["parameters"], {}, {}

    @hook_impl
    def after_dataset_loaded(self, dataset_name: str) -> None:
        """Remember an input."""
        self._read[dataset_name] = None

    @hook_impl
    def after_dataset_saved(self, dataset_name: str) -> None:
        """Remember an output."""
        self._written[dataset_name] = None

    @hook_impl
    def after_pipeline_run(
        self, run_params: dict[str, Any], pipeline: Pipeline, catalog: CatalogProtocol[Any, Any]
    ) -> None:
        """Record a finished run."""
        self._write(run_params, pipeline, catalog, None)

    @hook_impl
    def on_pipeline_error(
        self,
        error: Exception,
        run_params: dict[str, Any],
        pipeline: Pipeline,
        catalog: CatalogProtocol[Any, Any],
    ) -> None:
        """Record a run that failed, and why."""
        self._write(run_params, pipeline, catalog, f"{type(error).__name__}: {error}")

    def _write(
        self,
        run_params: dict[str, Any],
        pipeline: Pipeline,
        catalog: CatalogProtocol[Any, Any],
        error: str | None,
    ) -> None:
        if "run_manifest" not in catalog:
            return
        inputs = {n: _fingerprint(catalog, n) for n in self._read if n not in self._written}
        outputs = {n: _fingerprint(catalog, n) for n in self._written}
        plain = json.loads(json.dumps(self._parameters, sort_keys=True, default=_plain))
        run: Run = catalog["run"].load()
        catalog.save(
            "run_manifest",
            {
                "run_id": run.save_version,
                "status": "failed" if error else "finished",
                "error": error,
                "git": _git_state(Path(run_params["project_path"])),
                "env": run.env,
                "pipelines": run_params.get("pipeline_names"),
                "nodes": [node.name for node in pipeline.nodes],
                "parameters": plain,
                "parameters_sha256": hashlib.sha256(
                    json.dumps(plain, sort_keys=True).encode()
                ).hexdigest(),
                "packages": _packages(),
                "inputs": {name: entry for name, entry in inputs.items() if entry},
                "outputs": {name: entry for name, entry in outputs.items() if entry},
            },
        )


def _plain(value: Any) -> Any:
    return value.model_dump(mode="json") if hasattr(value, "model_dump") else str(value)


def _fingerprint(catalog: CatalogProtocol[Any, Any], name: str) -> dict[str, Any] | None:
    """Path, version and sha256 of a dataset's file; None for what is not on disk."""
    dataset = catalog[name]
    path = Path(str(getattr(dataset, "_filepath", "")))
    version = None
    if isinstance(dataset, AbstractVersionedDataset) and dataset._version:
        version = dataset.resolve_load_version()
        path = path / str(version) / path.name
    if not path.is_file():
        return None
    project = Path.cwd()
    shown = path.relative_to(project) if path.is_relative_to(project) else path
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return {"path": shown.as_posix(), "version": version, "sha256": digest}


def _git_state(project: Path) -> dict[str, Any] | None:
    """Commit, and whether tracked files differ from it; None outside a checkout."""

    def git(*words: str) -> str:
        done = subprocess.run(
            ["git", "-C", str(project), *words], capture_output=True, text=True, check=True
        )
        return done.stdout.strip()

    try:
        changed = git("status", "--porcelain", "--untracked-files=no")
        return {"commit": git("rev-parse", "HEAD"), "changed": bool(changed)}
    except (OSError, subprocess.CalledProcessError):
        return None


def _packages() -> dict[str, str]:
    """Installed versions of what the study directly depends on."""
    wanted = [Requirement(line) for line in metadata.requires("pcnav-study") or []]
    names = sorted({r.name for r in wanted if r.marker is None or r.marker.evaluate()})
    return {name: metadata.version(name) for name in ["pcnav-study", *names]}
