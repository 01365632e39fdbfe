"""Kedro's project settings."""

from pcnav_study.hooks import RunManifest, RunVersions

HOOKS = (RunVersions(), RunManifest())
# Soft: conf/ENV and --params change the keys they name and leave the others.
CONFIG_LOADER_ARGS = {
    "base_env": "base",
    "default_run_env": "local",
    "merge_strategy": {"parameters": "soft"},
}
