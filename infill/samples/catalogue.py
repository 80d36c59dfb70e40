"""The samples by name, and `write_sample`, which writes one to a file."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

from infill.errors import FormatError, ParameterError
from infill.files.whole_files import check_target, write_all_files


@dataclass(frozen=True, kw_only=True)
class Sample:
    """A file to try a command with.

    Parameters
    ----------
    file : str
        Its default name.
    summary : str
        What it is, in a line, and which command takes it.
    writer : callable
        Returns the function that writes it in the format of a path, or raises FormatError.
    """

    file: str
    summary: str
    writer: Callable[[Path], Callable[[BinaryIO], object]]


def _part_writer(path: Path) -> Callable[[BinaryIO], object]:
    """Return the function that writes the bracket in the format of a path."""
    from infill.formats.mesh_files import mesh_writer
    from infill.samples.bracket import bracket

    write = mesh_writer(path)
    return lambda file: write(bracket(), file)


def _scan_writer(path: Path) -> Callable[[BinaryIO], object]:
    """Return the function that writes the scan, as NRRD only."""
    _require_suffix(path, ".nrrd", "scan")
    from infill.imaging.nrrd import write_nrrd
    from infill.samples.bone import bone_scan

    return lambda file: write_nrrd(bone_scan(), file)


def _print_writer(path: Path) -> Callable[[BinaryIO], object]:
    """Return the function that writes the print, as text only."""
    _require_suffix(path, ".gcode", "print")
    from infill.samples.plate_print import plate_print

    return lambda file: file.write(plate_print())


def _require_suffix(path: Path, suffix: str, name: str) -> None:
    """Raise FormatError unless a path ends in the only suffix of a sample."""
    if path.suffix.lower() != suffix:
        raise FormatError(f"{path} does not end in {suffix}; the sample {name!r} is written in that format only")


SAMPLES: Final[dict[str, Sample]] = {
    "part": Sample(
        file="part.stl", summary="a bracket of 60 x 40 x 40 mm with three holes, for 'infill fill'", writer=_part_writer
    ),
    "scan": Sample(
        file="scan.nrrd",
        summary="a finger bone in grey values (HU), for 'infill smooth --threshold 226'",
        writer=_scan_writer,
    ),
    "print": Sample(
        file="print.gcode",
        summary="a sliced plate of 50 x 30 x 6 mm with honeycomb, for 'infill refill' and 'infill motion'",
        writer=_print_writer,
    ),
}


def find_sample(name: str) -> Sample:
    """Return the sample of a name.

    Raises
    ------
    ParameterError
        If there is none; the message lists them.

    >>> find_sample("scan").file
    'scan.nrrd'
    """
    if name not in SAMPLES:
        *most, last = SAMPLES
        raise ParameterError(f"there is no sample {name!r}; choose {', '.join(most)} or {last}")
    return SAMPLES[name]


def write_sample(name: str, path: str | os.PathLike[str] | None = None, *, overwrite: bool = False) -> Path:
    """Make a small file to try a function with, and return its path. The same name makes the same file.

    Parameters
    ----------
    name : {"part", "scan", "print"}
        A bracket of 60 x 40 x 40 mm with three holes; a scan of a finger bone, (56, 50, 96) int16 in Hounsfield units,
        in which bone is 226 and more; or a sliced plate of 50 x 30 x 6 mm with honeycomb infill.
    path : path, optional
        By default part.stl, scan.nrrd or print.gcode, in the current folder. The suffix of a part may be that of any
        mesh that `save` writes.
    overwrite : bool
        Whether an existing file is replaced.

    Raises
    ------
    ParameterError
        If there is no sample of that name.
    FormatError
        For a suffix in which the sample is not written.
    OutputError
        If the file cannot be written, or exists and may not be overwritten.
    """
    sample = find_sample(name)
    target = Path(sample.file if path is None else path)
    write = sample.writer(target)
    check_target(target, overwrite=overwrite)
    return write_all_files({target: write})[0]
