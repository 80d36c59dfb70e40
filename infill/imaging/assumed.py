"""What a reader of volumes had to assume: told at once, and kept for the report."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from contextvars import ContextVar

LOG = logging.getLogger("infill")
_KEPT: ContextVar[list[str] | None] = ContextVar("kept", default=None)


def warn(text: str, *values: object) -> None:
    """Log a warning, and keep it for the volume that is being read.

    Parameters
    ----------
    text : str
        As for `logging.Logger.warning`.
    *values : object
    """
    LOG.warning(text, *values)
    kept = _KEPT.get()
    if kept is not None:
        kept.append(text % values if values else text)


@contextlib.contextmanager
def keep_warnings() -> Iterator[list[str]]:
    """Keep what `warn` is told meanwhile.

    Yields
    ------
    list of str
        Which grows.

    >>> with keep_warnings() as kept:
    ...     warn("%s has no unit", "a.nii")
    >>> kept
    ['a.nii has no unit']
    """
    kept: list[str] = []
    token = _KEPT.set(kept)
    try:
        yield kept
    finally:
        _KEPT.reset(token)
