"""refill: the sparse infill of a sliced print, smooth, in its G-code.

Step 1. Look at the print: what sliced it, its settings, and some of its layers.
Step 2. Choose how far corners may move, so that layers still lie on one another.
Step 3. Read it through, layers at a time; draw its strokes anew; prove that nothing else changed.
Step 4. Tell time and filament anew, and put the new file in the place of the old one.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from infill.errors import FormatError, GeometryError
from infill.filling.families.catalogue import FAMILIES
from infill.filling.keeping import Rounding
from infill.filling.layers import Rules, Tally, refilled_batch
from infill.filling.replacing import planned
from infill.filling.request import KEEP, SAME, Request
from infill.filling.support import largest_deviation, samples
from infill.filling.telling import report_of_refill
from infill.formats.whole_files import check_target, told, whole_file
from infill.gcode.estimates import Change, estimates, said_seconds, told_anew
from infill.gcode.sections import Tags, marked
from infill.gcode.stream import batches
from infill.gcode.survey import STAMP, Survey, survey
from infill.gcode.table import read
from infill.version import __version__

Progress = Callable[[str, float], None]
CORNER = 9.0  # mm/s × rad: of a square corner velocity of 5 mm/s
COPIED = 1 << 20  # bytes at a time
SHOWN = 1 << 22  # bytes between two reports of progress


@dataclass(frozen=True, kw_only=True)
class RefillResult:
    """What a refill did.

    Parameters
    ----------
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    path : Path or None
        The file written; None if nothing was to change, or for a dry run.
    """

    report: dict[str, Any]
    path: Path | None


def refill(
    gcode: str | os.PathLike[str],
    *,
    output: str | os.PathLike[str] | None = None,
    pattern: str = "keep",
    density: str | float | None = None,
    smooth_radius: str | float = "auto",
    max_deviation: float | None = None,
    layers: tuple[int, int] | None = None,
    part: str | None = None,
    dry_run: bool = False,
    overwrite: bool = True,
    progress: Progress | None = None,
) -> RefillResult:
    """Give the sparse infill of a sliced print round corners, in its G-code.

    Everything else in the file stays as it is, byte for byte, but for what it says of its own time and filament.

    Parameters
    ----------
    gcode : path
        What a slicer wrote: PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura.
    output : path, optional
        Where to write; without it, the file itself is replaced.
    pattern : str
        "keep": the slicer's own paths.
    density : "same", optional
        With "keep", beads up to 8 % wider make up for shorter paths.
    smooth_radius : "auto" or float
        Largest radius of a corner, mm. "auto": as large as support and contact allow. 0 leaves corners.
    max_deviation : float, optional
        How far an arc may lie from its corner, mm.
    layers : tuple of int, optional
        The first and the last layer to refill, counted from 1.
    part : str, optional
        Refill only objects with this in their name.
    dry_run : bool
        Write nothing.
    overwrite : bool
        Replace `output` if it exists.
    progress : callable, optional
        Told what is being done, and how much of it is done, 0 to 1.

    Returns
    -------
    RefillResult

    Raises
    ------
    ParameterError
        If an option is out of range.
    FormatError
        If the file is no text of G-code, or has no marked layers.
    GeometryError
        If a check of the whole file fails; it is left as it was.
    OutputError
        If the file cannot be written.
    """
    request = Request(
        pattern=pattern,
        density=density,
        smooth_radius=smooth_radius,
        max_deviation=max_deviation,
        layers=layers,
        part=part,
    )
    source = Path(gcode)
    target = Path(os.path.realpath(source)) if output is None else Path(output)
    if not dry_run:
        check_target(target, overwrite=overwrite or output is None)
    with _opened(source) as file:
        found = survey(file)
        if found.stamped:
            return RefillResult(report=report_of_refill(request, found, None, already=True), path=None)
        rules = _rules(request, found, progress)
        folder = None if dry_run else target.parent
        with _scratch(folder) as draft:
            tally = _drafted(file, draft, found, rules, progress)
            report = report_of_refill(request, found, tally, already=False, rules=rules)
            if dry_run or (not tally.replaced and output is None):
                return RefillResult(report=report, path=None)
            _deliver(draft, target, source, tally, progress)
    return RefillResult(report=report, path=target)


@contextlib.contextmanager
def _opened(source: Path) -> Iterator[BinaryIO]:
    try:
        file = source.open("rb")
    except OSError as error:
        said = error.strerror or str(error)
        raise FormatError(f"cannot read {source}: {said[:1].lower()}{said[1:]}") from error
    with file:
        try:
            yield file
        except FormatError as error:
            raise FormatError(f"{source}: {error}") from error


@contextlib.contextmanager
def _scratch(folder: Path | None) -> Iterator[BinaryIO]:
    """Yield a file without a name, in the folder where the result will be, so that the same disk holds both."""
    with told(folder or Path("a temporary file")), tempfile.TemporaryFile(dir=folder) as file:
        yield file


def _rules(request: Request, found: Survey, progress: Progress | None) -> Rules:
    """Decide how corners are rounded."""
    if progress is not None:
        progress("looking at layers", 0.0)
    acceleration = found.number("infill_acceleration", "sparse_infill_acceleration", "default_acceleration") or 1000.0
    corner = (
        (found.number("machine_max_jerk_x") or 9.0) if found.number("machine_max_junction_deviation") is None else 9.0
    )
    rounding = Rounding(
        deviation=request.deviation,
        radius=request.radius,
        corner=max(corner, 1.0),
        same_filament=request.density == SAME,
    )
    some = samples(found)
    rules = Rules(rounding=rounding, acceleration=acceleration, request=request)
    rules = rules.with_survey(found, some)
    if request.pattern != KEEP:
        family = FAMILIES[request.pattern]
        density = request.density if isinstance(request.density, float) else None
        plan = planned(family, some, rounding, density=density, acceleration=acceleration)
        return rules.with_plan(plan)
    if request.smooth_radius == "auto" and some:
        deviation, before, after = largest_deviation(some, rounding, acceleration)
        rules = rules.with_deviation(deviation, before, after)
    return rules


def _drafted(file: BinaryIO, draft: BinaryIO, found: Survey, rules: Rules, progress: Progress | None) -> Tally:
    """Write the new text to a draft."""
    file.seek(0)
    state, tags = rules.begin, Tags()
    tally = Tally()
    done = shown = 0
    with told(Path("a temporary file")):
        for text in batches(file):
            table = read(text, state)
            marks = marked(table, tags)
            new, tally = refilled_batch(table, marks, rules, tally)
            for first, last in estimates(new):
                tally.lines.append((draft.tell() + first, new[first:last], tally.saved))
            draft.write(new)
            state, tags = table.after, marks.after
            done += len(text)
            if progress is not None and done >= shown:
                progress("drawing infill", done / max(found.size, 1))
                shown = done + SHOWN
        draft.flush()
    if not tags.layer:
        raise FormatError(
            "the file has no marked layers; give the G-code of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio "
            "or Cura, with its comments"
        )
    return tally


def _deliver(draft: BinaryIO, target: Path, source: Path, tally: Tally, progress: Progress | None) -> None:
    """Copy the draft to its place, with a stamp and with time and filament told anew."""
    if progress is not None:
        progress("writing", 0.95)
    said = max((said_seconds(line) for _, line, _ in tally.lines), default=0.0)
    change = Change(seconds=tally.saved, filament=tally.filament_ratio, tools=tally.tool_ratios)
    changed = [(place, len(line), told_anew(line, saved, change, said)) for place, line, saved in tally.lines]
    draft.seek(0)
    head = draft.read(1 << 16)
    place = _stamp_place(head)
    ends = b"\r\n" if b"\r\n" in head[:4096] else b"\n"
    stamp = STAMP + b" %s: %d of %d sections%s" % (
        __version__.encode(),
        tally.replaced,
        tally.sections,
        ends,
    )
    edits = sorted([*changed, (place, 0, stamp)]) if tally.replaced else []
    with whole_file(target) as file:
        _copy_mode(source, file)
        done = 0
        for where, length, text in edits:
            _copied(draft, file, done, where)
            file.write(text)
            done = where + length
        _copied(draft, file, done, draft.seek(0, os.SEEK_END))


def _copied(draft: BinaryIO, file: BinaryIO, first: int, last: int) -> None:
    draft.seek(first)
    while first < last:
        text = draft.read(min(COPIED, last - first))
        if not text:
            raise GeometryError("a temporary file ended early; free some space on the disk and try again")
        file.write(text)
        first += len(text)


def _copy_mode(source: Path, file: BinaryIO) -> None:
    """Give a new file the permissions of the old one, where the system has them."""
    if hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):
            os.fchmod(file.fileno(), source.stat().st_mode & 0o7777)


def _stamp_place(head: bytes) -> int:
    """Return where the stamp goes: after the header block, or after the first line if that is a comment."""
    for last in (b"; HEADER_BLOCK_END", b";END_OF_HEADER"):
        place = head.find(last)
        if place >= 0 and (end := head.find(b"\n", place)) >= 0:
            return end + 1
    if head.startswith(b";") and b"\n" in head:
        return head.index(b"\n") + 1
    return 0
