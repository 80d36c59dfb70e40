"""Output of all commands: messages, a progress bar, plain-text tables."""

from __future__ import annotations

import contextlib
import json
import logging
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TextIO

import typer

from infill.errors import escape_unprintable
from infill.plain_numbers import plain_number

UNITS = ("B", "kB", "MB", "GB")
PROGRESS = "INFILL_PROGRESS"


def say(text: str) -> None:
    """Print a message to stderr; control characters that it quotes from a file or a name are made harmless."""
    typer.echo("\n".join(escape_unprintable(line) for line in text.split("\n")), err=True)


def warn(
    message: Warning | str,
    category: type[Warning],  # noqa: ARG001 - the signature of warnings.showwarning
    filename: str,  # noqa: ARG001
    lineno: int,  # noqa: ARG001
    file: TextIO | None = None,  # noqa: ARG001
    line: str | None = None,  # noqa: ARG001
) -> None:
    """Print a warning as one line."""
    say(f"warning: {escape_unprintable(str(message))}")


@contextlib.contextmanager
def progress_bar(*, shown: bool) -> Iterator[Callable[[str, float], None] | None]:
    """Yield a function (stage, share done) that moves a bar on stderr, or None if stderr is not a terminal.

    A program that runs a command and sets the environment variable INFILL_PROGRESS to ``lines`` gets lines instead.
    """
    if shown and os.environ.get(PROGRESS) == "lines":
        yield _print_progress_lines()
        return
    if not shown or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    # A stage that cannot tell how far it is still shows that it works, by a spinner and the time since the beginning.
    shown_time = (TimeElapsedColumn(), TextColumn("so far,"), TimeRemainingColumn(), TextColumn("left"))
    columns = (SpinnerColumn(), TextColumn("{task.description:>8}"), BarColumn(), *shown_time)
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda stage, share: bar.update(task, description=stage, completed=share)


def _print_progress_lines() -> Callable[[str, float], None]:
    """Return a function that prints a line on stderr for each stage and each hundredth: ``progress: 0.25 smooth``."""
    latest = [("", -1.0)]

    def report(stage: str, share: float) -> None:
        """Print how far the command is, if that is new."""
        seen = (stage, round(share, 2))
        if seen != latest[0]:
            latest[0] = seen
            say(f"progress: {seen[1]:.2f} {stage}")

    return report


@contextlib.contextmanager
def print_log(*, shown: bool) -> Iterator[None]:
    """Print messages that the library logs, including hints, or none."""
    log = logging.getLogger("infill")
    handler = _PrintHandler() if shown else logging.NullHandler()
    propagates, level = log.propagate, log.level
    log.addHandler(handler)
    log.propagate = False
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.propagate = propagates
        log.setLevel(level)


class _PrintHandler(logging.Handler):
    """A handler that prints every record on stderr."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print one record."""
        say(escape_unprintable(record.getMessage()))


def format_table(rows: Mapping[str, str], title: str = "") -> str:
    """Format rows of a name and a text, with aligned texts."""
    width = max(len(name) for name in rows)
    lines = [f"  {name:<{width}}  {text}" for name, text in rows.items()]
    return "\n".join([title, *lines] if title else lines)


def can_show(text: str) -> bool:
    """Tell whether stdout can show the characters of a text."""
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return False
    return True


def print_json(value: Mapping[str, Any] | Sequence[Mapping[str, Any]]) -> None:
    """Print one JSON object to stdout, or a list of them."""
    typer.echo(json.dumps(value, indent=2, allow_nan=False))


def format_bytes(count: float) -> str:
    """Format a number of bytes in a readable unit.

    >>> format_bytes(10_625_284)
    '10.6 MB'
    """
    for unit in UNITS:
        if count < 1000 or unit == UNITS[-1]:
            break
        count /= 1000
    return f"{plain_number(count)} {unit}"
