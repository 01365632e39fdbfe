"""``kedro run``, with bad input answered by a sentence instead of a traceback."""

from __future__ import annotations

import re
from typing import Any

import click
from kedro.framework.cli.project import run as kedro_run
from kedro.framework.cli.utils import CONTEXT_SETTINGS
from kedro.io.core import DatasetError
from kedro.validation.exceptions import ParameterValidationError

from pcnav_study.errors import InputError

PLAIN = (InputError, ParameterValidationError)
_FAULT = re.compile(
    r"^- Parameter '([^']+)': Failed to instantiate .*? for parameter '[^']+': (.*)$", re.M
)


def _plain_reason(error: BaseException | None) -> str | None:
    """The message of the first plain error on the chain of causes."""
    while error is not None:
        if isinstance(error, ParameterValidationError):
            faults = _FAULT.findall(str(error))
            return "; ".join(f"parameter {key}.{fault}" for key, fault in faults) or str(error)
        if isinstance(error, InputError):
            return str(error)
        error = error.__cause__ or error.__context__
    return None


class _Run(click.Command):
    """Kedro's run command; an InputError ends it with its message and exit code 1."""

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except (*PLAIN, DatasetError) as error:
            reason = _plain_reason(error)
            if reason is None:
                raise
            raise click.ClickException(reason) from error


@click.group(context_settings=CONTEXT_SETTINGS, name=__file__)
def cli() -> None:
    """Commands of the study."""


run = _Run("run", callback=kedro_run.callback, params=kedro_run.params, help="Run the pipelines.")
cli.add_command(run)
