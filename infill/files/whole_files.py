"""Files that appear complete or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import BinaryIO

from infill.errors import OutputError

REASONS = {
    errno.ENOSPC: "the disk is full; free some space or write elsewhere",
    errno.EDQUOT: "the disk quota is used up; free some space or write elsewhere",
    errno.EFBIG: "the file would be larger than is allowed; choose larger cells or a smaller block",
    errno.EACCES: "it may not be written to, or another program has it open; choose another name or folder",
    errno.EPERM: "it may not be written to, or another program has it open; choose another name or folder",
    errno.EROFS: "the folder is read-only; choose another",
}


def check_targets(paths: Iterable[str | os.PathLike[str]], *, overwrite: bool) -> None:
    """Raise OutputError if one of `paths` cannot be written to, or two of them are the same file."""
    seen: set[Path] = set()
    for path in paths:
        resolved = check_target(path, overwrite=overwrite).resolve()
        if resolved in seen:
            raise OutputError(f"{path} is named twice; give every output a name of its own")
        seen.add(resolved)


def check_target(path: str | os.PathLike[str], *, overwrite: bool) -> Path:
    """Return `path`, or raise OutputError if a file cannot be written there; call it before the work."""
    target = Path(path)
    with wrap_os_errors(target):
        if target.is_dir():
            raise OutputError(f"{target} is a folder; give a file name")
        if not target.parent.is_dir():
            raise OutputError(f"there is no folder {target.parent}; make it first or write elsewhere")
        if not os.access(target.parent, os.W_OK):
            raise OutputError(f"cannot write {target}: {REASONS[errno.EACCES]}")
        if os.path.lexists(target) and not overwrite:  # a dangling link counts as existing
            raise OutputError(f"{target} exists; give another name, or --force to overwrite it")
    return target


@contextlib.contextmanager
def wrap_os_errors(target: Path) -> Iterator[None]:
    """Turn an error of the operating system about a file into an OutputError."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        reason = REASONS.get(error.errno or 0, error.strerror or str(error))
        raise OutputError(f"cannot write {target}: {reason}") from error


@contextlib.contextmanager
def atomic_files(paths: Sequence[str | os.PathLike[str]]) -> Iterator[list[BinaryIO]]:
    """Yield a file to write to for each path; they replace the paths together at the end.

    If anything fails, or is interrupted, all paths are left as they were.

    Raises
    ------
    OutputError
        If a file cannot be written: full disk, missing or read-only folder.
    """
    targets = [Path(path) for path in paths]
    partials = [_partial_path(target) for target in targets]
    try:
        with wrap_os_errors(targets[0]), contextlib.ExitStack() as stack:
            files: list[BinaryIO] = []
            for target, partial in zip(targets, partials, strict=True):
                with wrap_os_errors(target):
                    files.append(stack.enter_context(open(partial, "wb" if partial == target else "xb")))
            yield files
            for target, file in zip(targets, files, strict=True):
                with wrap_os_errors(target):
                    file.close()  # writes the last bytes, or raises
        _move_to_targets(
            [(partial, target) for partial, target in zip(partials, targets, strict=True) if partial != target]
        )
    finally:
        for target, partial in zip(targets, partials, strict=True):
            if partial != target:
                _remove(partial)


@contextlib.contextmanager
def atomic_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Yield one file to write to, as `atomic_files` does."""
    with atomic_files([path]) as files, wrap_os_errors(Path(path)):
        yield files[0]


def copy_mode(source: Path, file: BinaryIO) -> None:
    """Give a new file the permissions of another, where the system has them."""
    if hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):
            os.fchmod(file.fileno(), source.stat().st_mode & 0o7777)


@contextlib.contextmanager
def scratch_file(folder: Path | None) -> Iterator[BinaryIO]:
    """Yield a nameless file in the folder of the result, so that the same disk holds both.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    with wrap_os_errors(folder or Path("a temporary file")), tempfile.TemporaryFile(dir=folder) as file:
        yield file


def write_all_files(
    parts: Mapping[Path, Callable[[BinaryIO], object]], *, then: Callable[[], object] | None = None
) -> list[Path]:
    """Write the files of one run, each by its function, and return their paths.

    Parameters
    ----------
    parts : mapping of Path to callable
    then : callable, optional
        Called once all are written, before they take their places; if it raises, none of them does.

    Raises
    ------
    OutputError
        If one of the files cannot be written; then none of them is.
    """
    paths = list(parts)
    partials = [_partial_path(path) for path in paths]
    try:
        for path, partial in zip(paths, partials, strict=True):  # one at a time: there may be hundreds
            with wrap_os_errors(path), open(partial, "wb" if partial == path else "xb") as file:
                parts[path](file)
        if then is not None:
            then()
        _move_to_targets([(partial, path) for partial, path in zip(partials, paths, strict=True) if partial != path])
    finally:
        for path, partial in zip(paths, partials, strict=True):
            if partial != path:
                _remove(partial)
    return paths


def _move_to_targets(moves: Sequence[tuple[Path, Path]]) -> None:
    """Move each file to its target; if one move fails, restore all targets."""
    with contextlib.ExitStack() as tidy, contextlib.ExitStack() as undo:
        for partial, target in moves:
            with wrap_os_errors(target):
                if len(moves) > 1:
                    backup = target.with_name(f".{secrets.token_hex(4)}.kept")
                    tidy.callback(_remove, backup)
                    undo.callback(_restore, target, backup if _back_up(target, backup) else None)
                os.replace(partial, target)
        undo.pop_all()  # all are in place


def _back_up(target: Path, backup: Path) -> bool:
    """Keep the file at a target under a second name, by a link or else a copy; return False if there is none."""
    if not target.exists():
        return False
    try:
        os.link(target, backup)
    except OSError:  # a file system without links
        shutil.copy2(target, backup)
    return True


def _restore(target: Path, backup: Path | None) -> None:
    """Put the backup of a target back, or remove the target without one; do nothing if that fails."""
    with contextlib.suppress(OSError):
        if backup is None:
            target.unlink(missing_ok=True)
        else:
            os.replace(backup, target)


def _remove(path: Path) -> None:
    """Remove a file if it exists; ignore errors."""
    with contextlib.suppress(OSError):
        path.unlink(missing_ok=True)


def _partial_path(target: Path) -> Path:
    """Return the name to write under: a file next to the target, or the target itself if it is a device."""
    if target.exists() and not target.is_file() and not target.is_dir():
        return target
    return target.with_name(f".{secrets.token_hex(4)}.partial")
