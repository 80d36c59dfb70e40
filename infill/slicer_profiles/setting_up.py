"""``infill setup``: the line of a slicer, the profiles that have it, and its writing and removal."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from infill.errors import FormatError, OutputError, ParameterError, join_names
from infill.files.excerpts import quote_value
from infill.reports.common import report_head
from infill.reports.profiles import ProfileKeys, SetupReport
from infill.slicer_profiles import cura_script
from infill.slicer_profiles.desktops import (
    INSTALLED,
    ConfigFolder,
    Desktop,
    ProfiledSlicer,
    find_folders,
    find_newest_version,
    is_running,
    list_processes,
)
from infill.slicer_profiles.profile_files import (
    BACKUP,
    FileChange,
    PrintProfile,
    apply_changes,
    check_writable,
    list_profiles,
    plan_removal,
    plan_writing,
)
from infill.slicer_profiles.script_lines import (
    OUTSIDE,
    find_program,
    is_refill_line,
    is_temporary,
    write_line,
)

SetupAction = Literal["look", "write", "remove"]


@dataclass(frozen=True, kw_only=True)
class SetupRequest:
    """What to do for a slicer.

    Parameters
    ----------
    slicer : {"prusaslicer", "superslicer", "orcaslicer", "bambustudio", "cura"}
    action : {"look", "write", "remove"}
        `look` writes nothing.
    words : tuple of str
        Words for `infill refill`, after it.
    profiles : tuple of str
        Names of profiles; empty for all.
    folder : Path, optional
        Configuration folder; by default all that are in their usual places.
    force : bool
        Write although the slicer seems to be running.
    """

    slicer: ProfiledSlicer
    action: SetupAction = "look"
    words: tuple[str, ...] = ()
    profiles: tuple[str, ...] = ()
    folder: Path | None = None
    force: bool = False

    @property
    def title(self) -> str:
        """Name of the slicer, as people write it."""
        return INSTALLED[self.slicer].title


@dataclass(frozen=True, kw_only=True)
class SetupMeans:
    """The machine on which a slicer is set up.

    Parameters
    ----------
    desktop : Desktop
    program : tuple of str
        Words that run `infill`.
    processes : tuple of str
        Names of running programs.
    """

    desktop: Desktop
    program: tuple[str, ...]
    processes: tuple[str, ...] = ()

    @classmethod
    def current(cls) -> SetupMeans:
        """Return the machine of the user who runs this process."""
        desktop = Desktop.current()
        return cls(
            desktop=desktop, program=find_program(desktop.system), processes=tuple(list_processes(desktop.system))
        )


def set_up_slicer(request: SetupRequest, means: SetupMeans) -> SetupReport:
    """Look for the profiles of a slicer, and write or remove the line as requested.

    Raises
    ------
    ParameterError
        If there is no such folder or profile, or the slicer takes no words.
    FormatError
        If a profile that is to be changed cannot be read.
    OutputError
        If a profile cannot be written, or the slicer seems to be running; then none is written.
    """
    folders = _choose_folders(request, means)
    if request.slicer == "cura":
        _check_cura(request, means)
    changed: set[Path] = set()
    if request.action != "look":
        _check_slicer(request, means, folders)
        changes = _plan_changes(request, means, folders)
        apply_changes(changes)
        changed = {change.path for change in changes}
    states = _list_states(request, means, folders, changed)
    head = report_head("setup")
    return {
        "form": head["form"],
        "version": head["version"],
        "product": head["product"],
        "slicer": request.slicer,
        "action": request.action,
        "line": _write_folder_line(request, means, ConfigFolder(path=Path())),
        "folders": [
            {
                "folder": str(folder.path),
                "flatpak": folder.flatpak,
                "line": _write_folder_line(request, means, folder),
            }
            for folder in folders
        ],
        "profiles": states,
        "notes": list(_list_notes(request, means, folders, states)),
    }


def _choose_folders(request: SetupRequest, means: SetupMeans) -> list[ConfigFolder]:
    """Choose the requested configuration folder, or else all in their usual places."""
    if request.folder is None:
        return find_folders(request.slicer, means.desktop)
    folder = request.folder.absolute()
    if not folder.is_dir():
        raise ParameterError.about("folder", f"is {request.folder}, and there is no such folder")
    if request.slicer == "cura":
        folder = find_newest_version(folder) or folder
    return [ConfigFolder(path=folder, flatpak=_flatpak_name(folder) != "")]


def _check_cura(request: SetupRequest, means: SetupMeans) -> None:
    """Raise ParameterError if a request has parts that Cura does not have."""
    if request.words:
        raise ParameterError("Cura's script takes its options in Cura's window; leave the words after cura out")
    if request.profiles:
        raise ParameterError.about("profile", "is for other slicers: Cura has one script for all of its profiles")
    if len(means.program) > 1:
        raise ParameterError("there is no program infill beside this Python; install phasefill with pipx, uv or pip")


def _check_slicer(request: SetupRequest, means: SetupMeans, folders: list[ConfigFolder]) -> None:
    """Raise an error if the profiles of a slicer cannot be changed now."""
    if not folders:
        raise ParameterError(_missing_folder(request))
    if not request.force and is_running(request.slicer, list(means.processes)):
        raise OutputError(
            f"{request.title} seems to be running and may overwrite its profiles; close it, or add --force"
        )
    if request.action == "write" and is_temporary(means.program[0]):
        raise ParameterError(_temporary_program(means))


def _plan_changes(request: SetupRequest, means: SetupMeans, folders: list[ConfigFolder]) -> list[FileChange]:
    """Plan the changes of all requested profiles, or raise an error if one of them cannot be made."""
    if request.slicer == "cura":
        return [
            change
            for folder in folders
            for change in (
                cura_script.plan_script(folder, means.program[0])
                if request.action == "write"
                else cura_script.plan_script_removal(folder)
            )
        ]
    changes = []
    for profile in _choose_profiles(request, folders):
        if profile.problem:
            raise FormatError(f"{profile.path}: {profile.problem}")
        line = _write_folder_line(request, means, profile.folder)
        planned = plan_writing(profile, line) if request.action == "write" else plan_removal(profile)
        if planned:
            check_writable(profile)
        changes += planned
    return changes


def _choose_profiles(request: SetupRequest, folders: list[ConfigFolder]) -> list[PrintProfile]:
    """Choose the requested profiles, or raise ParameterError if there is none."""
    profiles = list_profiles(request.slicer, folders)
    if not profiles:
        raise ParameterError(_missing_profile(request, folders))
    names = tuple(dict.fromkeys(profile.name for profile in profiles))
    for name in request.profiles:
        if name not in names:
            raise ParameterError.about("profile", f"is {quote_value(name)}; choose {join_names(names)}")
    return [profile for profile in profiles if not request.profiles or profile.name in request.profiles]


def _list_states(
    request: SetupRequest, means: SetupMeans, folders: list[ConfigFolder], changed: set[Path]
) -> list[ProfileKeys]:
    """List the profiles as they are now."""
    if request.slicer == "cura":
        return [_script_state(folder, means, changed) for folder in folders]
    return [
        {
            "name": profile.name,
            "file": str(profile.path),
            "state": _name_state(profile, _write_folder_line(request, means, profile.folder)),
            "scripts": profile.lines,
            "changed": profile.path in changed,
            "backup": str(profile.backup) if profile.backup.is_file() else None,
            "problem": profile.problem,
        }
        for profile in list_profiles(request.slicer, folders)
    ]


def _script_state(folder: ConfigFolder, means: SetupMeans, changed: set[Path]) -> ProfileKeys:
    """Describe Cura's script in a folder."""
    path, data = cura_script.script_path(folder), cura_script.read_script(folder)
    backup = path.with_name(path.name + BACKUP)
    state = "absent" if data is None else "other"
    return {
        "name": cura_script.NAME,
        "file": str(path),
        "state": "present" if data == cura_script.write_script(means.program[0]) else state,
        "scripts": [],
        "changed": path in changed,
        "backup": str(backup) if backup.is_file() else None,
        "problem": "",
    }


def _name_state(profile: PrintProfile, line: str) -> str:
    """Name the state of a profile, as its report does."""
    if profile.problem:
        return "unreadable"
    refills = [text for text in profile.lines if is_refill_line(text)]
    return "present" if refills == [line] else "other" if refills else "absent"


def _write_folder_line(request: SetupRequest, means: SetupMeans, folder: ConfigFolder) -> str:
    """Write the line for the profiles of a folder; of Cura, the path of the program."""
    if request.slicer == "cura":
        return means.program[0]
    outside = OUTSIDE if folder.flatpak else ()
    return write_line([*outside, *means.program, "refill", *request.words], means.desktop.system)


def _list_notes(
    request: SetupRequest, means: SetupMeans, folders: list[ConfigFolder], states: list[ProfileKeys]
) -> Iterator[str]:
    """Yield sentences about further steps."""
    if not folders:
        yield _missing_folder(request)
    elif not states:
        yield _missing_profile(request, folders)
    if request.action == "look" and is_running(request.slicer, list(means.processes)):
        yield f"{request.title} seems to be running; close it before anything is written"
    if is_temporary(means.program[0]):
        yield _temporary_program(means)
    for folder in folders:
        if folder.flatpak and request.slicer == "cura":
            yield f"{folder.path} is of a Flatpak, which may not start programs outside; then refill saved files"
        elif folder.flatpak:
            name = _flatpak_name(folder.path) or "ID"
            yield (
                f"{folder.path} is of a Flatpak; its scripts start programs outside, with full access to your machine, "
                f"after: flatpak override --user --talk-name=org.freedesktop.Flatpak {name}"
            )
    if request.slicer == "cura" and any(state["state"] == "present" for state in states):
        yield ("start Cura again, and add the script at Extensions, Post Processing, Modify G-Code: Refill the infill")


def _flatpak_name(folder: Path) -> str:
    """Return the name of the Flatpak that a folder belongs to; empty for none."""
    parts = folder.parts
    return next(
        (parts[place + 2] for place in range(len(parts) - 2) if parts[place : place + 2] == (".var", "app")), ""
    )


def _missing_folder(request: SetupRequest) -> str:
    """Say that no configuration folder is there."""
    return f"there is no folder of {request.title}'s settings; start {request.title} once, or name it with --folder"


def _missing_profile(request: SetupRequest, folders: list[ConfigFolder]) -> str:
    """Say that no print profile is there."""
    places = join_names(tuple(str(folder.path) for folder in folders))
    return (
        f"there is no print profile of your own in {places}; save one in {request.title}, "
        f"{INSTALLED[request.slicer].save_hint}"
    )


def _temporary_program(means: SetupMeans) -> str:
    """Say that the program will disappear."""
    return f"{means.program[0]} is in a cache that gets emptied; install phasefill with pipx, uv tool or pip"
