"""Thin Kedro pipelines: load, call the floors below, hand on."""
