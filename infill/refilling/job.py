"""refill: the sparse infill of a sliced print, smooth, in its G-code.

Step 1. Look at the print: what sliced it, its settings, and some of its layers.
Step 2. Choose how far corners may move, so that layers still lie on one another.
Step 3. Read it through, layers at a time; draw its strokes anew; prove that nothing else changed.
Step 4. Tell time and filament anew, and put the new file in the place of the old one.
"""

from __future__ import annotations

import contextlib
import io
import math
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from infill.files.whole_files import check_target, scratch, whole_file
from infill.gcode.estimates import Change, finished, said_grams, said_millimetres, said_seconds, told_anew
from infill.gcode.sliced_file import SlicedText, opened
from infill.refilling.prints import copy_mode, pieces, retold, write_print
from infill.refilling.request import AUTO, KEEP, Progress, Request
from infill.version import __version__

if TYPE_CHECKING:
    from infill.gcode.survey import Survey
    from infill.refilling.rules import Rules
    from infill.refilling.stats import Tally, Whole
    from infill.refilling.timing import PrintTime

HEAD = 1 << 16  # bytes in which the header ends


@dataclass(frozen=True, kw_only=True)
class RefillResult:
    """What a refill did.

    Parameters
    ----------
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    path : Path or None
        The file written; None if nothing was to change, for a dry run, or for lines.
    lines : tuple of str, optional
        The new lines with their line ends, if lines were given.
    """

    report: dict[str, Any]
    path: Path | None
    lines: tuple[str, ...] | None = field(default=None, repr=False)


def refill(
    gcode: str | os.PathLike[str] | Iterable[str],
    *,
    output: str | os.PathLike[str] | None = None,
    pattern: str = KEEP,
    density: str | float | None = None,
    smooth_radius: str | float = AUTO,
    max_deviation: float | None = None,
    layers: tuple[int, int] | None = None,
    part: str | None = None,
    dry_run: bool = False,
    overwrite: bool = True,
    progress: Progress | None = None,
    **parameters: Any,  # noqa: ANN401 - of the kind that each has
) -> RefillResult:
    """Fill a sliced print anew, in its G-code: its own infill with round corners, or a pattern of ours in its place.

    Everything else in the file stays as it is, byte for byte, but for what it says of its own time and filament.

    Parameters
    ----------
    gcode : path, or iterable of str
        What PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura wrote: text, binary G-code, or an archive
        (.gcode.3mf), of which every plate is refilled; or its lines, with or without line ends.
    output : path, optional
        Where to write; without it, the file itself is replaced.
    pattern : str
        "keep": the slicer's own paths with round corners. Or the name of a pattern, see
        `infill.paths.families.catalogue`, or the path of a drawing: .svg .dxf .wkt .png.
    density : "same" or float, optional
        With "keep", "same" widens beads by up to 8 % to make up for shorter paths; without it, the filament per mm is
        kept. With a pattern, a number above 0 and up to 1 is the share of the volume; else every section takes the
        filament that it took.
    smooth_radius : "auto" or float
        Largest radius of a corner, mm. "auto": as large as support and contact allow. 0 leaves corners.
    max_deviation : float, optional
        How far a path may move, mm.
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
    **parameters
        Parameters of the pattern: angle=30 (degrees), phase=(1, 2) … docs/refill.md lists them.

    Returns
    -------
    RefillResult

    Raises
    ------
    ParameterError
        If an option is out of range.
    FormatError
        If the file is no G-code, or has no marked layers.
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
        parameters=parameters,
    )
    if not isinstance(gcode, str | os.PathLike):
        return _refilled_lines(gcode, request, progress)
    source = Path(gcode)
    target = Path(os.path.realpath(source)) if output is None else Path(output)
    if not dry_run:
        check_target(target, overwrite=overwrite or output is None)
    folder = None if dry_run else target.parent
    with opened(source) as given, contextlib.ExitStack() as drafts:
        done: dict[int | None, _Done] = {}
        for number, plate in enumerate(given.parts):
            draft = drafts.enter_context(scratch(folder))
            shown = _shared(progress, number, len(given.parts))
            with given.text(plate, folder) as text:
                done[plate] = _refilled(text, draft, request, shown)
        report = _report(request, list(done.values()), given.plates)
        new = {name: each for name, each in done.items() if each.tally is not None and each.tally.replaced}
        if dry_run or (not new and output is None):
            return RefillResult(report=report, path=None)
        if not new:  # a copy
            if not _same(source, target):
                with whole_file(target) as file, source.open("rb") as old:
                    copy_mode(source, file)
                    shutil.copyfileobj(old, file)
            return RefillResult(report=report, path=target)
        if progress is not None:
            progress("writing", 0.95)
        with whole_file(target) as file:
            copy_mode(source, file)
            metadata = {name: value for each in new.values() for name, value in each.metadata.items()}
            write_print(given, file, {name: each.text() for name, each in new.items()}, metadata)
    return RefillResult(report=report, path=target)


def _shared(progress: Progress | None, number: int, count: int) -> Progress | None:
    """Return what to tell of the progress of one of several prints."""
    if progress is None or count == 1:
        return progress
    return lambda stage, share: progress(stage, (number + share) / count)


def _same(source: Path, target: Path) -> bool:
    return target.exists() and target.samefile(source)


def _refilled_lines(lines: Iterable[str], request: Request, progress: Progress | None) -> RefillResult:
    """Refill lines of text."""
    text = "".join(line if line.endswith("\n") else f"{line}\n" for line in lines)
    given = SlicedText(text=io.BytesIO(text.encode("utf-8", "surrogateescape")))
    done = _refilled(given, io.BytesIO(), request, progress)
    if done.tally is not None and done.tally.replaced:
        text = b"".join(done.text()).decode("utf-8", "surrogateescape")
    # Not splitlines: comments may hold what it takes for the end of a line.
    report = _report(request, [done])
    return RefillResult(report=report, path=None, lines=tuple(f"{line}\n" for line in text.split("\n")[:-1]))


@dataclass(frozen=True, kw_only=True)
class _Done:
    """A draft, and what is still to be changed in it.

    Parameters
    ----------
    found : Survey
    draft : binary file
    tally, rules : Tally and Rules, optional
        None if nothing was done.
    remedy : Tally, optional
        Of the remedy for infill that lost too much filament: drawn, and thrown away.
    edits : tuple of (place, length, text)
        What to exchange in the draft, in order.
    metadata : dict
        New values of what stands outside the text.
    """

    found: Survey
    draft: BinaryIO
    tally: Tally | None = None
    rules: Rules | None = None
    remedy: Tally | None = None
    edits: tuple[tuple[int, int, bytes], ...] = ()
    metadata: dict[str, str] = field(default_factory=dict)

    def text(self) -> Iterator[bytes]:
        """Yield the draft with its edits, in pieces."""
        done = 0
        for where, length, text in self.edits:
            yield from pieces(self.draft, done, where)
            yield text
            done = where + length
        yield from pieces(self.draft, done, self.draft.seek(0, os.SEEK_END))


def _report(request: Request, parts: Sequence[_Done], plates: Sequence[int] = ()) -> dict[str, Any]:
    """Return one report of all prints of a file; those that were refilled before count only where all of them were."""
    from infill.gcode.survey import joined
    from infill.refilling.report import report_of_refill
    from infill.refilling.stats import Tally

    found = joined([each.found for each in parts])
    tallies = [each.tally for each in parts if each.tally is not None]
    rules = max((each.rules for each in parts if each.rules), key=lambda rules: rules.rounding.deviation, default=None)
    whole = Tally()
    for tally in tallies:
        whole.add(tally)
    done = whole if tallies else None
    remedied = Tally()
    for each in parts:
        if each.tally is not None:
            remedied.add(each.remedy or each.tally)
    remedy = remedied if any(each.remedy is not None for each in parts) else None
    return report_of_refill(request, found, done, already=found.stamped, rules=rules, plates=plates, remedy=remedy)


def _refilled(given: SlicedText, draft: BinaryIO, request: Request, progress: Progress | None) -> _Done:
    """Write the new text to a draft."""
    from infill.gcode.survey import survey
    from infill.refilling.drafting import drafted
    from infill.refilling.placement import family_of
    from infill.refilling.planning import planned
    from infill.refilling.report import loses_filament
    from infill.refilling.rules import rules_of
    from infill.refilling.support import largest_deviation, samples
    from infill.refilling.timing import PrintClock

    family = None if request.pattern == KEEP else family_of(request.pattern, request.parameters)
    found = survey(given.text, more=family is not None and not family.prismatic, settings=given.settings)
    found = replace(found, slicer=found.slicer or given.slicer)
    if found.stamped:
        return _Done(found=found, draft=draft)
    if progress is not None:
        progress("looking at layers", 0.0)
    some = samples(found)
    rules = rules_of(request, found, some)
    plan = None
    if family is not None:
        share = None if isinstance(request.density, str | None) else float(request.density)
        plan = planned(family, some, rules.rounding, density=share, acceleration=rules.acceleration, cell=request.cell)
        rules = rules if plan is not None else rules.rounded_by(0.0)
    elif request.smooth_radius == AUTO and some:
        rules = rules.rounded_by(largest_deviation(some, rules.rounding, rules.acceleration))
    clock = PrintClock(given)
    tally, rules = drafted(given.text, draft, found, rules, plan, progress, clock)
    remedy = None
    if request.pattern == KEEP and loses_filament(tally) and request.smooth_radius != AUTO:
        by_itself = replace(rules, request=replace(request, smooth_radius=AUTO)).with_radius(math.inf)
        by_itself = by_itself.rounded_by(largest_deviation(some, by_itself.rounding, rules.acceleration))
        with tempfile.TemporaryFile() as trial:
            remedy, _ = drafted(given.text, trial, found, by_itself, None, progress)
    if found.begin.volumetric:
        for each in [tally] if remedy is None else [tally, remedy]:
            each.count_millimetres([math.pi / 4 * diameter**2 for diameter in found.begin.diameters])
    before = clock.finish()
    places = [place for place, _ in tally.lines]
    after = PrintClock(given, draft, places, like=clock).read() if tally.replaced else before
    change, edits = _told(given, found, tally, before, after)
    edits = [*edits, _stamp(draft, tally)] if tally.replaced else []
    metadata = retold(given.metadata, change)
    return _Done(
        found=found, draft=draft, tally=tally, rules=rules, remedy=remedy, edits=tuple(sorted(edits)), metadata=metadata
    )


def _told(
    given: SlicedText, found: Survey, tally: Tally, before: PrintTime, after: PrintTime
) -> tuple[Change, list[tuple[int, int, bytes]]]:
    """Put what the print takes into the tally, and return by how much that changed, and the lines that tell of it."""
    lines = [line for _, line in tally.lines]
    outside = [b"; %s = %s" % item for item in given.metadata]
    change = Change(
        seconds=after.seconds,
        first_layer=after.first_layer,
        ratio=after.seconds / before.seconds if before.seconds else 1.0,
        first_ratio=after.first_layer / before.first_layer if before.first_layer else 1.0,
        filament=tally.filament_ratio,
        tools=tally.tool_ratios,
    )
    change = change.told_by([*lines, *outside]).as_told(lines, tally.change)
    new = lines
    if tally.replaced:
        times = zip(lines, after.elapsed.tolist(), finished(lines), strict=True)
        new = [told_anew(line, elapsed, change, done) for line, elapsed, done in times]
    told = [told_anew(line, 0.0, change) for line in outside] if tally.replaced else outside
    used = sum(tally.filament.values())
    tally.print_before = _whole(before, [*lines, *outside], used, found)
    tally.print_after = _whole(after, [*new, *told], used + sum(tally.change.values()), found)
    tally.slicer_seconds = max(
        (said_seconds(line) for line in (*lines, *outside) if b"silent" not in line), default=0.0
    )
    tally.unread, tally.first_unread = before.unread, before.first_unread
    edits = [(place, len(line), text) for (place, line), text in zip(tally.lines, new, strict=True)]
    return change, edits


def _whole(time: PrintTime, lines: Sequence[bytes], used: float, found: Survey) -> Whole:
    """Return what a print takes: filament as its lines tell it, or else as it was counted."""
    from infill.refilling.stats import Whole

    filament = said_millimetres(lines)
    filament = used if filament is None else filament
    grams, density = said_grams(lines), found.number("filament_density")
    if grams is None and density:
        grams = filament * math.pi / 4 * found.begin.diameter**2 / 1000 * density
    return Whole(seconds=time.seconds, infill_seconds=time.infill, filament=filament, grams=grams)


def _stamp(draft: BinaryIO, tally: Tally) -> tuple[int, int, bytes]:
    """Return the edit that puts the stamp in: after the header block, or after a first line that is a comment."""
    from infill.gcode.survey import STAMP

    draft.seek(0)
    head = draft.read(HEAD)
    place = 0
    for last in (b"; HEADER_BLOCK_END", b";END_OF_HEADER"):
        found = head.find(last)
        if found >= 0 and (end := head.find(b"\n", found)) >= 0:
            place = end + 1
    if not place and head.startswith(b";") and b"\n" in head:
        place = head.index(b"\n") + 1
    line = head[:place] or head[: head.find(b"\n") + 1]
    ends = b"\r\n" if line.endswith(b"\r\n") else b"\n"
    text = b"%s %s: %d of %d sections%s" % (STAMP, __version__.encode(), tally.replaced, tally.sections, ends)
    return place, 0, text
