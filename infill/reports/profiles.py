"""The report of `infill setup`: the configuration folders of a slicer, and the line in its print profiles."""

from __future__ import annotations

from typing import Annotated, TypedDict

from infill.reports.common import ReportForm


class ConfigFolderKeys(TypedDict):
    """Configuration folders of the slicer; of Cura, the data folders of the newest version."""

    folder: Annotated[str, "Path of the folder"]
    flatpak: Annotated[bool, "Whether a Flatpak uses it, whose scripts run inside a sandbox"]
    line: Annotated[str, "Line for the profiles of this folder"]


class ProfileKeys(TypedDict):
    """A user's own print profiles, folder by folder; of Cura, the script in each folder."""

    name: Annotated[str, "Name in the slicer"]
    file: Annotated[str, "Path of the file"]
    state: Annotated[
        str,
        "State at the end: `present`: it has the line; `other`: it has another line that runs `infill refill`; "
        "`absent`: none; `unreadable`",
    ]
    scripts: Annotated[list[str], "Lines of the field at the end, in their order; of Cura none"]
    changed: Annotated[bool, "Whether this run changed the file"]
    backup: Annotated[str | None, "File with the bytes before the line was written; null without one"]
    problem: Annotated[str, "Reason why the profile cannot be read; empty if it can"]


class SetupReport(ReportForm):
    """The report of ``infill setup``."""

    slicer: Annotated[str, "Name of the slicer"]
    action: Annotated[str, "`look`, `write` or `remove`"]
    line: Annotated[str, "Line for the field of post-processing scripts; of Cura, the path of the program"]
    folders: list[ConfigFolderKeys]
    profiles: list[ProfileKeys]
    notes: Annotated[list[str], "Sentences about what else is needed; empty without any"]
