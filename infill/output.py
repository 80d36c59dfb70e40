"""Files appear whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from infill.errors import OutputError

REASONS = {
    errno.ENOSPC: "the disk is full; free some space or write elsewhere",
    errno.EDQUOT: "the disk quota is used up; free some space or write elsewhere",
    errno.EFBIG: "the file would be larger than is allowed; choose larger cells or a smaller block",
    errno.EACCES: "the folder may not be written to; choose another",
    errno.EPERM: "the folder may not be written to; choose another",
    errno.EROFS: "the folder is read-only; choose another",
}


def check_targets(paths: Iterable[str | os.PathLike[str]], *, overwrite: bool) -> None:
    """Raise OutputError if a file could not be put at one of `paths`, or two of them are the same file."""
    taken: set[Path] = set()
    for path in paths:
        place = check_target(path, overwrite=overwrite).resolve()
        if place in taken:
            raise OutputError(f"{path} is named twice; give every output a name of its own")
        taken.add(place)


def check_target(path: str | os.PathLike[str], *, overwrite: bool) -> Path:
    """Return `path`, or raise OutputError if a file could not be put there; called before the work."""
    target = Path(path)
    with _told(target):
        if target.is_dir():
            raise OutputError(f"{target} is a folder; give a file name")
        if not target.parent.is_dir():
            raise OutputError(f"there is no folder {target.parent}; make it first or write elsewhere")
        if not os.access(target.parent, os.W_OK):
            raise OutputError(f"cannot write {target}: {REASONS[errno.EACCES]}")
        if target.exists() and not overwrite:
            raise OutputError(f"{target} exists; give another name, or --force to overwrite it")
    return target


@contextlib.contextmanager
def _told(target: Path) -> Iterator[None]:
    """Turn what the system says of a file into an error of ours."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        reason = REASONS.get(error.errno or 0, error.strerror or str(error))
        raise OutputError(f"cannot write {target}: {reason}") from error


@contextlib.contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Yield a file to write to; `path` is replaced by it at the end, and untouched if anything fails.

    Raises
    ------
    OutputError
        If the file cannot be written: full disk, missing or read-only folder.
    """
    target = Path(path)
    partial = target.with_name(f".{secrets.token_hex(4)}.partial")
    if target.exists() and not target.is_file() and not target.is_dir():
        partial = target  # a device such as /dev/null has no name to be replaced
    try:
        with _told(target):
            with open(partial, "wb" if partial == target else "xb") as file:
                yield file
            if partial != target:
                os.replace(partial, target)
    finally:
        if partial != target:
            with contextlib.suppress(OSError):
                partial.unlink(missing_ok=True)
