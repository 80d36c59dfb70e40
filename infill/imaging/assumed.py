"""Assumptions of volume readers: logged at once, and collected for the report."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from contextvars import ContextVar

LOG = logging.getLogger("infill")
_COLLECTED: ContextVar[list[str] | None] = ContextVar("kept", default=None)


def warn(text: str, *values: object) -> None:
    """Log a warning and collect it for the volume that is being read.

    Parameters
    ----------
    text : str
        As for `logging.Logger.warning`.
    *values : object
    """
    LOG.warning(text, *values)
    collected = _COLLECTED.get()
    if collected is not None:
        collected.append(text % values if values else text)


@contextlib.contextmanager
def keep_warnings() -> Iterator[list[str]]:
    """Collect the warnings of `warn` within a `with` block.

    Yields
    ------
    list of str
        The warnings so far; the list grows.

    >>> with keep_warnings() as collected:
    ...     warn("%s has no unit", "a.nii")
    >>> collected
    ['a.nii has no unit']
    """
    collected: list[str] = []
    token = _COLLECTED.set(collected)
    try:
        yield collected
    finally:
        _COLLECTED.reset(token)
