"""`save_project`: a filled part as a project for a slicer."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from infill.checks import choose_word
from infill.errors import FormatError, UsageError
from infill.files.whole_files import atomic_file
from infill.options.toml import format_options
from infill.projects import bambustudio, cura, plain, prusaslicer
from infill.projects.project import INFILL, PART, SLICERS, Project, Slicer
from infill.result import Result


def writer_for(slicer: str) -> Callable[[Project, BinaryIO], None]:
    """Look up the function that writes projects for a slicer, or raise UsageError."""
    slicer = choose_word(slicer, SLICERS)
    if slicer not in SLICERS:
        raise UsageError.about("slicer", f"is {slicer!r}; choose from {', '.join(SLICERS)}")
    return WRITERS[slicer]


def make_project(result: Result[Any, Any], *, slicer: str, title: str, units: str | None = None) -> Project:
    """Turn a filled part into a project, with a picture and the options that make it again.

    Raises
    ------
    UsageError
        If it was not filled as a project.
    """
    if set(result.surfaces) != {PART, INFILL}:
        raise UsageError(f"this holds {' and '.join(result.surfaces)}, no part and infill; fill it as a project")
    from infill.pictures.cuts import render_thumbnail

    options = {**result.report["request"], "units": units, "for": slicer}
    return Project(
        part=result.surfaces[PART],
        infill=result.surfaces[INFILL],
        title=title,
        thumbnail=render_thumbnail(result.surfaces[INFILL]),
        settings=format_options(options, "infill fill PART --config THIS_FILE -o OUT.3mf"),
    )


def save_project(
    result: Result[Any, Any], path: str | os.PathLike[str], *, slicer: Slicer | None = None, title: str | None = None
) -> Path:
    """Write a part and its infill as a project for a slicer.

    Parameters
    ----------
    result : Result
        Of `infill.fill` with ``for_`` or ``as_="project"``.
    path : str or Path
        A .3mf; an existing file is replaced once the new one is complete.
    slicer : {"prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"}, optional
        By default, the one that the part was filled for. In "plain", part and infill are two objects without settings.
    title : str, optional
        Of the object, as the slicer lists it; the name of the file by default.

    Returns
    -------
    Path

    Raises
    ------
    FormatError
        For a suffix other than .3mf.
    UsageError
        For no slicer or an unknown one, or a result that was not filled as a project.
    OutputError
        If the file cannot be written.
    """
    slicer = getattr(result.stages, "slicer", None) if slicer is None else slicer
    if slicer is None:
        raise UsageError.about("slicer", f"is missing; choose from {', '.join(SLICERS)}, or fill with for_")
    write, target = writer_for(slicer), Path(path)
    check_suffix(target)
    project = make_project(result, slicer=slicer, title=target.stem if title is None else title)
    with atomic_file(target) as file:
        write(project, file)
    return target


def check_suffix(path: Path) -> None:
    """Raise FormatError unless a path is that of a 3MF."""
    if path.suffix.lower() != ".3mf":
        raise FormatError(f"{path} is to hold a project, and those are .3mf; give a name such as {path.stem}.3mf")


WRITERS: dict[str, Callable[[Project, BinaryIO], None]] = {
    "prusaslicer": prusaslicer.write,
    "orcaslicer": bambustudio.write_orcaslicer,
    "bambustudio": bambustudio.write,
    "cura": cura.write,
    "plain": plain.write,
}
