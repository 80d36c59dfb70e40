"""What every command prints with: messages, a progress bar, plain-text tables."""

from __future__ import annotations

import contextlib
import json
import logging
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TextIO

import typer

from infill.errors import printable

UNITS = ("B", "kB", "MB", "GB")


def say(text: str) -> None:
    """Print a message to stderr; what it quotes of a file or its name cannot steer the terminal."""
    typer.echo("\n".join(printable(line) for line in text.split("\n")), err=True)


def warn(
    message: Warning | str,
    category: type[Warning],  # noqa: ARG001 - the signature of warnings.showwarning
    filename: str,  # noqa: ARG001
    lineno: int,  # noqa: ARG001
    file: TextIO | None = None,  # noqa: ARG001
    line: str | None = None,  # noqa: ARG001
) -> None:
    """Print a warning as one line."""
    say(f"warning: {printable(str(message))}")


@contextlib.contextmanager
def progress_bar(*, shown: bool) -> Iterator[Callable[[str, float], None] | None]:
    """Yield a function (stage, share done) that moves a bar on stderr, or None where nobody sees it."""
    if not shown or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description:>8}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda stage, share: bar.update(task, description=stage, completed=share)


@contextlib.contextmanager
def log_said(*, shown: bool) -> Iterator[None]:
    """Print what the library logs, hints too, or nothing."""
    log = logging.getLogger("infill")
    told = _Said() if shown else logging.NullHandler()
    spreads, level = log.propagate, log.level
    log.addHandler(told)
    log.propagate = False
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.removeHandler(told)
        log.propagate = spreads
        log.setLevel(level)


class _Said(logging.Handler):
    """A handler that prints every record on stderr."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print one record."""
        say(printable(record.getMessage()))


def is_typed(context: typer.Context, name: str) -> bool:
    """Return whether an option was given, even if its value is the default; `name` is that of its longest flag."""
    flag = f"--{name.replace('_', '-')}"
    for each in context.command.params:
        if flag in each.opts and each.name is not None:
            source = context.get_parameter_source(each.name)
            return source is not None and source.name != "DEFAULT"
    return False


def table(rows: Mapping[str, str], title: str = "") -> str:
    """Return rows of a name and a text, with the texts aligned below each other."""
    width = max(len(name) for name in rows)
    lines = [f"  {name:<{width}}  {text}" for name, text in rows.items()]
    return "\n".join([title, *lines] if title else lines)


def can_show(text: str) -> bool:
    """Return whether stdout can show the characters of a text."""
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return False
    return True


def print_json(value: Mapping[str, Any] | Sequence[Mapping[str, Any]]) -> None:
    """Print one JSON object to stdout, or a list of them."""
    typer.echo(json.dumps(value, indent=2, allow_nan=False))


def as_bytes(count: float) -> str:
    """Return a number of bytes in readable form.

    >>> as_bytes(10_625_284)
    '10.6 MB'
    """
    for unit in UNITS:
        if count < 1000 or unit == UNITS[-1]:
            break
        count /= 1000
    return f"{count:.3g} {unit}"
