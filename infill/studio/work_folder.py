"""The folder for the files of all pages of a studio; one that a killed studio left is removed by the next studio.

A folder has a file that its studio holds locked, so that the lock goes with the process, however that ends. Where the
system has no such locks, as Windows, nothing is removed.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

PREFIX = "infill-studio-"
LOCK = "server.lock"


@contextlib.contextmanager
def make_work_folder() -> Iterator[Path]:
    """Remove what killed studios left, and make a temporary folder, which is removed at the end."""
    remove_leftovers(Path(tempfile.gettempdir()))
    with contextlib.ExitStack() as locked, tempfile.TemporaryDirectory(prefix=PREFIX) as name:
        _lock_new(Path(name), locked)  # until the folder is gone
        yield Path(name)


def _lock_new(folder: Path, locked: contextlib.ExitStack) -> None:
    """Lock a new folder; its lock has its name only once it is held."""
    if find_spec("fcntl") is None:
        return
    import fcntl

    new = folder / f"{LOCK}.new"
    file = locked.enter_context(new.open("wb"))
    with contextlib.suppress(OSError):  # a file system without locks: nobody finds the folder unused, then
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        new.rename(folder / LOCK)


def remove_leftovers(place: Path) -> None:
    """Remove the folders of studios in a folder that are this user's, and that no process holds locked."""
    if find_spec("fcntl") is None:
        return
    for folder in place.glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError):
            facts = folder.lstat()
            if stat.S_ISDIR(facts.st_mode) and facts.st_uid == os.getuid():
                _remove_unless_locked(folder)


def _remove_unless_locked(folder: Path) -> None:
    """Remove a folder with a lock that nobody holds; raise OSError if there is none, or somebody holds it."""
    import fcntl

    with open(os.open(folder / LOCK, os.O_RDWR | os.O_NOFOLLOW), "wb") as file:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        shutil.rmtree(folder, ignore_errors=True)
