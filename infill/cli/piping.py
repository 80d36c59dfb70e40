"""``-o -``: a file on stdout, so that another program can read it; complete or not at all, like every file.

The suffix after the dash decides the format, as in ``-o -.3mf``, like that of every file.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import BinaryIO

import typer

from infill.errors import OutputError
from infill.files.whole_files import check_targets, write_all_files

STDOUT = "-"


def with_suffix(path: Path, suffix: str = ".stl") -> Path:
    """Return the path of an output, the one of stdout with a suffix.

    >>> with_suffix(Path("-")).name, with_suffix(Path("-.3mf")).name, with_suffix(Path("a.obj")).name
    ('-.stl', '-.3mf', 'a.obj')
    """
    return Path(f"{STDOUT}{suffix}") if str(path) == STDOUT else path


def is_piped(path: Path) -> bool:
    """Tell whether a path stands for stdout.

    >>> is_piped(Path("-")), is_piped(Path("-.stl")), is_piped(Path("-a.stl")), is_piped(Path("b/-.stl"))
    (True, True, False, False)
    """
    return len(path.parts) == 1 and path.stem == STDOUT


def check_outputs(
    paths: Iterable[Path | None], *, overwrite: bool, as_json: bool, text: Path | None = None, dry_run: bool = False
) -> None:
    """Raise an error, before the work, if an output cannot be written, or if several would go to stdout.

    Parameters
    ----------
    paths : iterable of Path
        Binary files; None for those that are not requested.
    overwrite, as_json : bool
    text : Path, optional
        A text file, which a terminal can show.
    dry_run : bool
        Whether no output is written, not even to stdout.

    Raises
    ------
    BadParameter
        If stdout is named twice, or the report goes there.
    OutputError
        If stdout is a terminal or does not exist, or as `infill.files.whole_files.check_targets`.
    """
    binary = [path for path in paths if path is not None]
    outputs = [*binary, *([] if text is None else [text])]
    piped = [path for path in outputs if is_piped(path)]
    if len(piped) > 1:
        raise typer.BadParameter("two outputs are '-' and would both go to stdout; give one of them a name")
    if dry_run:
        piped = []
    if piped and as_json:
        raise typer.BadParameter("'-' and --json would both go to stdout; give a file name, or leave --json out")
    if piped and getattr(sys.stdout, "name", "") == os.devnull:
        raise OutputError("'-' is stdout, and this process has none; name a file")
    if any(path in binary for path in piped) and sys.stdout.isatty():
        raise OutputError("'-' is stdout, and that is a terminal; send it on (> FILE, | PROGRAM), or name a file")
    check_targets((path for path in outputs if not is_piped(path)), overwrite=overwrite)


def deliver_all(parts: Mapping[Path, Callable[[BinaryIO], object]]) -> list[str]:
    """Write the files of one run, each by its function, also the one on stdout, and return their names.

    The file on stdout is complete before its first byte is sent, and sent before the files take their places: if the
    reader is gone, none of them does.
    """
    files = {path: write for path, write in parts.items() if not is_piped(path)}
    buffer = io.BytesIO()
    for path, write in parts.items():
        if path not in files:
            write(buffer)
    write_all_files(files, then=partial(_send, buffer))
    return [STDOUT if is_piped(path) else str(path) for path in parts]


def send_file(path: Path) -> None:
    """Send a file that is complete to stdout."""
    with path.open("rb") as file:
        while part := file.read(2**20):
            _write(part)
    sys.stdout.buffer.flush()


def _send(buffer: io.BytesIO) -> None:
    """Write a buffer to standard output and flush it."""
    _write(buffer.getbuffer())
    sys.stdout.buffer.flush()


def _write(data: bytes | memoryview) -> None:
    """Write all bytes to stdout: an unbuffered stream, as with PYTHONUNBUFFERED, may take only part of them at once."""
    remaining = memoryview(data)
    while remaining:
        remaining = remaining[sys.stdout.buffer.write(remaining) :]
