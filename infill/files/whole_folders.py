"""Folders that appear complete or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from pathlib import Path

from infill.errors import OutputError
from infill.files.whole_files import wrap_os_errors


def check_folder_target(path: Path, *, overwrite: bool, mark: str = "") -> None:
    """Raise OutputError if a folder cannot be written; with a mark, it replaces only folders that hold such a file."""
    if os.path.lexists(path) and not (overwrite and path.is_dir()):
        advice = "give another name, or --force to overwrite it" if path.is_dir() else "give another name"
        raise OutputError(f"{path} exists; {advice}")
    if mark and path.is_dir() and any(path.iterdir()) and not (path / mark).is_file():
        raise OutputError(f"{path} is a folder that holds other files; give another name")
    if not path.absolute().parent.is_dir():
        raise OutputError(f"there is no folder {path.parent}; make it first or write elsewhere")


@contextlib.contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """Yield a folder to write to, which is not made yet; it takes the place of the path at the end.

    If anything fails, or is interrupted, the path is left as it was.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    partial = path.absolute().parent / f".{secrets.token_hex(4)}.partial"
    try:
        with wrap_os_errors(path):
            yield partial
            _replace(partial, path)
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def _replace(partial: Path, path: Path) -> None:
    """Move a folder to its place; a folder that is there is kept until then."""
    backup = partial.with_suffix(".kept")
    if path.exists():
        os.replace(path, backup)
    try:
        os.replace(partial, path)
    except OSError as error:
        if backup.exists():
            os.replace(backup, path)
        raise OSError(error.errno or errno.EACCES, error.strerror) from error
    shutil.rmtree(backup, ignore_errors=True)
