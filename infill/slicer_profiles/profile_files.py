"""Print profiles as files: those of a user, the changes to them, and the backups beside them.

A backup has the bytes of a profile before the line was written. While nothing but the line has changed since, removing
the line puts these bytes back, and the backup goes.
"""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from infill.errors import FormatError, OutputError
from infill.files.whole_files import copy_mode, wrap_os_errors, write_all_files
from infill.slicer_profiles.desktops import INSTALLED, ConfigFolder, ProfiledSlicer
from infill.slicer_profiles.ini_scripts import read_ini_scripts, write_ini_scripts
from infill.slicer_profiles.json_scripts import read_json_scripts, read_parent, write_json_scripts
from infill.slicer_profiles.script_lines import drop_lines, is_refill_line, list_lines, put_line

BACKUP = ".before-infill"
MOST_PARENTS = 20  # that inherit from one another


@dataclass(frozen=True, kw_only=True)
class PrintProfile:
    """A user's own print profile.

    Parameters
    ----------
    path : Path
    folder : ConfigFolder
    data : bytes
        Contents of the file.
    inherited : tuple of str
        Scripts of the profile that it inherits from, which hold while it has none.
    problem : str
        Why it cannot be read; empty if it can.
    """

    path: Path
    folder: ConfigFolder
    data: bytes = b""
    inherited: tuple[str, ...] = ()
    problem: str = ""

    @property
    def name(self) -> str:
        """Name of the profile in the slicer."""
        return self.path.stem

    @property
    def scripts(self) -> list[str]:
        """The texts of the field, its own or inherited."""
        return [] if self.problem else read_scripts(self.path, self.data, self.inherited)

    @property
    def lines(self) -> list[str]:
        """The lines of the field."""
        return list_lines(self.scripts)

    @property
    def backup(self) -> Path:
        """The file of its backup."""
        return self.path.with_name(self.path.name + BACKUP)


@dataclass(frozen=True, kw_only=True)
class FileChange:
    """New contents of a file.

    Parameters
    ----------
    path : Path
    data : bytes or None
        Its contents; None to remove it.
    like : Path, optional
        A file from which it takes its permissions.
    """

    path: Path
    data: bytes | None
    like: Path | None = None


def read_scripts(path: Path, data: bytes, inherited: Sequence[str] = ()) -> list[str]:
    """Read the scripts of a profile by its suffix.

    Raises
    ------
    FormatError
        If it cannot be read.
    """
    text = _decode(path, data)
    if path.suffix == ".ini":
        return read_ini_scripts(text)
    scripts = read_json_scripts(text)
    return list(inherited) if scripts is None else scripts


def write_scripts(path: Path, data: bytes, scripts: Sequence[str]) -> bytes:
    """Write scripts into the contents of a profile, by its suffix; nothing else changes."""
    text = _decode(path, data)
    if path.suffix == ".ini":
        return write_ini_scripts(text, scripts).encode(errors="surrogateescape")
    return write_json_scripts(text, scripts).encode()


def list_profiles(slicer: ProfiledSlicer, folders: Iterable[ConfigFolder]) -> list[PrintProfile]:
    """List a user's own print profiles by name, folder by folder."""
    return [
        _load_profile(path, folder)
        for folder in folders
        for path in sorted(
            (path for pattern in INSTALLED[slicer].profiles for path in folder.path.glob(pattern)),
            key=lambda path: (path.stem.casefold(), path),
        )
        if path.is_file() and not path.name.startswith(".")
    ]


def plan_writing(profile: PrintProfile, line: str) -> list[FileChange]:
    """Plan the changes that put the line into a profile; none if it is there."""
    if [text for text in profile.lines if is_refill_line(text)] == [line]:
        return []
    changes = _change_scripts(profile, put_line(profile.scripts, line))
    return changes if _read_original(profile) is not None else [_back_up(profile), *changes]


def plan_removal(profile: PrintProfile) -> list[FileChange]:
    """Plan the changes that remove every refill line from a profile; none if it has no such line."""
    if not any(map(is_refill_line, profile.lines)):
        return []
    original = _read_original(profile)
    if original is not None:
        return [
            FileChange(path=profile.path, data=original, like=profile.path),
            FileChange(path=profile.backup, data=None),
        ]
    return [_back_up(profile), *_change_scripts(profile, drop_lines(profile.scripts))]


def check_writable(profile: PrintProfile) -> None:
    """Raise OutputError if a profile or its folder is read-only."""
    path = profile.path.resolve()
    if not (path.stat().st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH) and os.access(path, os.W_OK)):
        raise OutputError(f"{profile.path} is read-only; allow writing to it, or leave it out with --profile")
    if not os.access(path.parent, os.W_OK):
        raise OutputError(f"the folder {path.parent} is read-only; allow writing to it")


def apply_changes(changes: Sequence[FileChange]) -> None:
    """Write the files of changes, all or none, and then remove those without contents.

    Raises
    ------
    OutputError
        If a file cannot be written; then none is.
    """
    for change in changes:
        if change.data is not None:
            with wrap_os_errors(change.path):
                change.path.parent.mkdir(exist_ok=True)
    write_all_files({change.path.resolve(): _writer(change) for change in changes if change.data is not None})
    for change in changes:
        if change.data is None:
            with contextlib.suppress(OSError):
                change.path.unlink()


def _decode(path: Path, data: bytes) -> str:
    """Decode the contents of a profile; an .ini file may have any bytes."""
    if path.suffix == ".ini":
        return data.decode(errors="surrogateescape")
    try:
        return data.decode()
    except UnicodeDecodeError:
        raise FormatError("it is not text in UTF-8; save it again in the slicer") from None


def _load_profile(path: Path, folder: ConfigFolder) -> PrintProfile:
    """Load a profile, and with it the scripts that it inherits."""
    try:
        data = path.read_bytes()
        inherited = () if path.suffix == ".ini" else tuple(_find_inherited(path, data, folder.path))
        read_scripts(path, data)
    except FormatError as error:
        return PrintProfile(path=path, folder=folder, problem=str(error))
    except OSError as error:
        return PrintProfile(path=path, folder=folder, problem=f"it cannot be read: {error.strerror or error}")
    return PrintProfile(path=path, folder=folder, data=data, inherited=inherited)


def _find_inherited(path: Path, data: bytes, folder: Path) -> list[str]:
    """Find the scripts that a process without any inherits; a parent that is not there has none."""
    with contextlib.suppress(FormatError, OSError):
        for _ in range(MOST_PARENTS):
            name = read_parent(_decode(path, data))
            if not name or any(letter in name for letter in "/\\*?["):
                break
            patterns = (f"user/*/process/**/{name}.json", f"system/*/process/**/{name}.json")
            parents = (parent for pattern in patterns for parent in sorted(folder.glob(pattern)) if parent != path)
            path = next(parents, folder)  # a folder cannot be read
            data = path.read_bytes()
            scripts = read_json_scripts(_decode(path, data))
            if scripts is not None:
                return scripts
    return []


def _read_original(profile: PrintProfile) -> bytes | None:
    """Read the backup of a profile, if nothing but the line has changed since; None otherwise."""
    refills = [line for line in profile.lines if is_refill_line(line)]
    with contextlib.suppress(OSError, FormatError):
        original = profile.backup.read_bytes()
        scripts = read_scripts(profile.path, original, profile.inherited)
        if len(refills) == 1 and not any(map(is_refill_line, list_lines(scripts))):
            written = write_scripts(profile.path, original, put_line(scripts, refills[0]))
            return original if written == profile.data else None
    return None


def _change_scripts(profile: PrintProfile, scripts: Sequence[str]) -> list[FileChange]:
    """Plan the change of a profile to other scripts."""
    data = write_scripts(profile.path, profile.data, scripts)
    return [FileChange(path=profile.path, data=data, like=profile.path)]


def _back_up(profile: PrintProfile) -> FileChange:
    """Plan the backup of a profile as it is."""
    return FileChange(path=profile.backup, data=profile.data, like=profile.path)


def _writer(change: FileChange) -> Callable[[BinaryIO], object]:
    """Return a function that writes a change to a file."""

    def write(file: BinaryIO) -> None:
        if change.like is not None:
            with wrap_os_errors(change.path):
                copy_mode(change.like, file)
        file.write(change.data or b"")

    return write
