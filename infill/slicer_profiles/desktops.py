"""The machine of a user: the configuration folders of slicers on it, and the programs that run.

Folders by system, with the name of the slicer below: on Linux `~/.config` (`$XDG_CONFIG_HOME`) and, of a Flatpak,
`~/.var/app/ID/config`; on macOS `~/Library/Application Support`; on Windows `%APPDATA%`. Cura's scripts lie in its data
folder, `~/.local/share` (`$XDG_DATA_HOME`) on Linux, and below in the folder of a version.
"""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

ProfiledSlicer = Literal["prusaslicer", "superslicer", "orcaslicer", "bambustudio", "cura"]
PROFILED_SLICERS: tuple[ProfiledSlicer, ...] = get_args(ProfiledSlicer)


@dataclass(frozen=True, kw_only=True)
class InstalledSlicer:
    """How a slicer is installed.

    Parameters
    ----------
    title : str
        Its name as people write it.
    folders : tuple of str
        Names of its configuration folder, those of test versions too.
    profiles : tuple of str
        Patterns of a user's own print profiles, below that folder.
    programs : str
        Regular expression of the names of its processes, in lower case, letters and digits alone.
    save_hint : str
        Where a user saves a print profile.
    """

    title: str
    folders: tuple[str, ...]
    profiles: tuple[str, ...]
    programs: str
    save_hint: str = "in the process settings"


_PROCESSES = ("user/*/process/*.json", "user/*/process/base/*.json")
INSTALLED: Mapping[ProfiledSlicer, InstalledSlicer] = {
    "prusaslicer": InstalledSlicer(
        title="PrusaSlicer",
        folders=("PrusaSlicer", "PrusaSlicer-beta", "PrusaSlicer-alpha"),
        profiles=("print/*.ini",),
        programs="prusaslicer.*",
        save_hint="in Print Settings",
    ),
    "superslicer": InstalledSlicer(
        title="SuperSlicer",
        folders=("SuperSlicer",),
        profiles=("print/*.ini",),
        programs="superslicer.*",
        save_hint="in Print Settings",
    ),
    "orcaslicer": InstalledSlicer(
        title="OrcaSlicer", folders=("OrcaSlicer",), profiles=_PROCESSES, programs="orcaslicer.*"
    ),
    "bambustudio": InstalledSlicer(
        title="Bambu Studio",
        folders=("BambuStudio", "BambuStudioBeta"),
        profiles=_PROCESSES,
        programs="bambustudio.*",
    ),
    "cura": InstalledSlicer(title="Cura", folders=("cura",), profiles=(), programs="cura|ultimakercura.*"),
}


@dataclass(frozen=True, kw_only=True)
class ConfigFolder:
    """A configuration folder of a slicer.

    Parameters
    ----------
    path : Path
    flatpak : bool
        Whether a Flatpak uses it, whose scripts run inside a sandbox.
    """

    path: Path
    flatpak: bool = False


@dataclass(frozen=True, kw_only=True)
class Desktop:
    """The machine of a user.

    Parameters
    ----------
    system : str
        As `sys.platform`: `linux`, `darwin` or `win32`; any other is treated as `linux`.
    home : Path
    environment : mapping of str to str
    """

    system: str
    home: Path
    environment: Mapping[str, str]

    @classmethod
    def current(cls) -> Desktop:
        """Return the machine of the user who runs this process."""
        return cls(system=sys.platform, home=Path.home(), environment=os.environ)

    def settings_roots(self, *, data: bool = False) -> list[ConfigFolder]:
        """Return the folders that hold the configuration folders of programs, or those of their `data`."""
        if self.system == "win32":
            return [ConfigFolder(path=Path(self.environment.get("APPDATA") or self.home / "AppData" / "Roaming"))]
        if self.system == "darwin":
            return [ConfigFolder(path=self.home / "Library" / "Application Support")]
        variable, default = ("XDG_DATA_HOME", ".local/share") if data else ("XDG_CONFIG_HOME", ".config")
        sandboxes = sorted((self.home / ".var" / "app").glob(f"*/{'data' if data else 'config'}"))
        return [
            ConfigFolder(path=Path(self.environment.get(variable) or self.home / default)),
            *(ConfigFolder(path=path, flatpak=True) for path in sandboxes),
        ]


def find_folders(slicer: ProfiledSlicer, desktop: Desktop) -> list[ConfigFolder]:
    """Find the configuration folders of a slicer; of Cura, the data folder of the newest version.

    Parameters
    ----------
    slicer : {"prusaslicer", "superslicer", "orcaslicer", "bambustudio", "cura"}
    desktop : Desktop
    """
    folders = [
        ConfigFolder(path=root.path / name, flatpak=root.flatpak)
        for root in desktop.settings_roots(data=slicer == "cura")
        for name in INSTALLED[slicer].folders
        if (root.path / name).is_dir()
    ]
    if slicer != "cura":
        return folders
    return [
        ConfigFolder(path=path, flatpak=folder.flatpak)
        for folder in folders
        for path in [find_newest_version(folder.path)]
        if path is not None
    ]


def find_newest_version(folder: Path) -> Path | None:
    """Find the subfolder with the highest version for a name, such as `5.10`; None if there is none."""
    versions = {
        tuple(map(int, path.name.split("."))): path
        for path in folder.iterdir()
        if re.fullmatch(r"[0-9]+(\.[0-9]+)+", path.name) and path.is_dir()
    }
    return versions[max(versions)] if versions else None


def is_running(slicer: ProfiledSlicer, processes: list[str]) -> bool:
    """Tell whether a slicer is among the names of processes.

    >>> is_running("prusaslicer", ["bash", "PrusaSlicer-2.8.AppImage"]), is_running("cura", ["CuraEngine"])
    (True, False)
    """
    names = (re.sub(r"[^a-z0-9]", "", name.lower().removesuffix(".exe")) for name in processes)
    return any(re.fullmatch(INSTALLED[slicer].programs, name) for name in names)


def list_processes(system: str) -> list[str]:
    """List the names of running programs; empty if the system does not tell."""
    if system == "linux":
        return [name for folder in Path("/proc").glob("[0-9]*") for name in _process_names(folder)]
    command = ["tasklist", "/fo", "csv", "/nh"] if system == "win32" else ["ps", "-axco", "command"]
    try:
        done = subprocess.run(  # noqa: S603 - a fixed command of the system
            command, capture_output=True, encoding="utf-8", errors="replace", check=False, timeout=10
        )
    except (OSError, subprocess.SubprocessError):
        return []
    return [line.split('","')[0].strip('" \t') for line in done.stdout.splitlines()]


def _process_names(folder: Path) -> list[str]:
    """Return both names of a process of this user: that of its program, and that of its first argument."""
    with contextlib.suppress(OSError):
        if folder.stat().st_uid == os.getuid():
            argument = (folder / "cmdline").read_bytes().split(b"\0")[0].decode(errors="replace")
            return [(folder / "comm").read_text(errors="replace").strip(), argument.rpartition("/")[2]]
    return []
