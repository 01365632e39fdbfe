"""Progress bars for long work."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeVar

from tqdm import tqdm

T = TypeVar("T")


def progress(items: Iterable[T], doing: str, total: int | None = None) -> Iterator[T]:
    """The items, with a bar on standard error; silent where that is no terminal."""
    yield from tqdm(items, desc=doing, total=total, disable=None, leave=False)
