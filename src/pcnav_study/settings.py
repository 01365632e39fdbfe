"""Kedro's project settings."""

from pcnav_study.hooks import RunManifest, RunVersions

HOOKS = (RunVersions(), RunManifest())
CONFIG_LOADER_ARGS = {"base_env": "base", "default_run_env": "local"}
