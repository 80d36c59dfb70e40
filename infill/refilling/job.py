"""refill: the sparse infill of a sliced print, smooth, in its G-code.

Step 1. Survey the print: its slicer, its settings, and some of its layers.
Step 2. Choose how far corners may move, so that layers still lie on one another.
Step 3. Read all layers, batch by batch; redraw their strokes; prove that nothing else changed.
Step 4. Update time and filament in the text, and replace the old file by the new one.
"""

from __future__ import annotations

import contextlib
import io
import math
import os
import shutil
import tempfile
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from infill.errors import FormatError, ParameterError, UsageError
from infill.files.broken import missing_file
from infill.files.excerpts import quote_value
from infill.files.whole_files import atomic_file, check_target, copy_mode, scratch_file
from infill.gcode.estimates import EstimateChange, Restatement, StatedAmounts, restate
from infill.gcode.sliced_file import SlicedText, check_output_name, open_sliced
from infill.gcode.stream import edited_text
from infill.pictures.picturable import Picturable
from infill.plain_numbers import plain_clock
from infill.refilling.request import AUTO, ENDLESS, KEEP, Progress, Request, describe_objects
from infill.version import __version__
from infill.viewer.viewable import Viewable

SET_ONCE_CHECKED = ("lines", "gradient")  # fields of a request

if TYPE_CHECKING:
    from PIL import Image

    from infill.gcode.survey import Survey
    from infill.paths.families.family import Family
    from infill.planner.layer_speeds import DrawnSpeeds
    from infill.planner.print_clock import PrintTime
    from infill.refilling.layers import Layers
    from infill.refilling.planning import RefillPlan
    from infill.refilling.rules import RefillRules
    from infill.refilling.stats import PrintAmounts, RefillStats
    from infill.reports.refilling import RefillReport


@dataclass(frozen=True, kw_only=True, repr=False)
class RefillResult(Picturable, Viewable):
    """Report and output of a refill.

    Parameters
    ----------
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    path : Path or None
        The file written; None if nothing changes, for a dry run, or for lines.
    lines : tuple of str, optional
        The new lines with their line ends, if the input was lines.
    source : Path, optional
        The print that was refilled, if it was a file.
    """

    report: RefillReport
    path: Path | None
    lines: tuple[str, ...] | None = None
    source: Path | None = None

    def __repr__(self) -> str:
        """Return the file, the sections that changed, and the time of the infill."""
        sections, time = self.report.get("sections"), self.report.get("time")
        if sections is None or time is None:
            return f"RefillResult({self.path or 'no file'}: refilled before, unchanged)"
        before, after = time["infill_before_s"], time["infill_after_s"]
        change = f", infill {after / before - 1:+z.1%} of its time" if before else ""
        return f"RefillResult({self.path or 'no file'}: {sections['replaced']} of {sections['all']} sections{change})"

    def picture(self) -> Image.Image:
        """Return the layer in the middle before and after, coloured by speed; raise FormatError without a file."""
        from infill.pictures.speeds import draw_speeds
        from infill.planner.layer_speeds import layer_speeds

        files, plate = self._files()
        layer = max(self.report["print"].get("layers", 2) // 2, 1)
        return draw_speeds({f"layer {layer}, {name}": layer_speeds(path, layer, plate) for name, path in files.items()})

    def page(self, title: str | None = None) -> str:
        """Return an HTML page that shows the layers before and after, coloured by speed, and needs no network.

        Parameters
        ----------
        title : str, optional
            By default, the name of the print.

        Raises
        ------
        FormatError
            If lines were refilled, not a file, or if no file is left.
        """
        from infill.planner.layer_speeds import drawn_speeds

        files, plate = self._files()
        named = title or next(iter(files.values())).name
        return refill_page({name: drawn_speeds(path, plate) for name, path in files.items()}, self.report, named)

    def _files(self) -> tuple[dict[str, Path], int | None]:
        """Return the files before and after that are still there, and the plate that is shown; or raise FormatError."""
        old = self.source
        if old is not None and self.path == Path(os.path.realpath(old)):
            old = None  # the new print took its place
        named = {"before": old, "refilled": self.path}
        files = {name: path for name, path in named.items() if path is not None and path.is_file()}
        if not files:
            raise FormatError("a picture needs the files of the print; refill a file")
        plates = self.report["print"]["plates"]
        return files, plates[0] if plates else None


def refill_page(prints: Mapping[str, DrawnSpeeds], report: RefillReport, title: str) -> str:
    """Return a page that shows prints before and after a refill, with the numbers of its report.

    Parameters
    ----------
    prints : mapping of str to DrawnSpeeds
        By caption.
    report : dict
    title : str
    """
    from infill.viewer.print_page import print_page

    numbers = {"pattern": report["request"]["pattern"]}
    sections, seconds, filament = report.get("sections"), report.get("time"), report.get("filament")
    if sections is not None and seconds is not None and filament is not None:
        numbers |= {
            "sections refilled": f"{sections['replaced']:,} of {sections['all']:,}",
            "time before": plain_clock(seconds["print_before_s"]),
            "time after": plain_clock(seconds["print_after_s"]),
            "infill before": plain_clock(seconds["infill_before_s"]),
            "infill after": plain_clock(seconds["infill_after_s"]),
            "filament before": f"{filament['print_before_mm'] / 1000:.2f} m",
            "filament after": f"{filament['print_after_mm'] / 1000:.2f} m",
        }
    if report["problems"]:
        numbers["problems"] = "; ".join(report["problems"])
    return print_page(prints, title=title, numbers=list(numbers.items()))


def refill(
    gcode: str | os.PathLike[str] | Iterable[str],
    *,
    output: str | os.PathLike[str] | None = None,
    pattern: object = KEEP,
    density: str | float | tuple[float, float] | None = None,
    by: object = None,
    smooth_radius: str | float = AUTO,
    max_deviation: float | None = None,
    max_segments: str | float = AUTO,
    arcs: str = AUTO,
    even: str | None = None,
    leeway: str | float | None = None,
    layers: tuple[int, int] | None = None,
    part: str | None = None,
    dry_run: bool = False,
    overwrite: bool = True,
    progress: Progress | None = None,
    **parameters: Any,  # noqa: ANN401 - of the kind that each has
) -> RefillResult:
    """Refill a sliced print, in its G-code: with its own infill and round corners, or with another pattern.

    Everything else in the file stays as it is, byte for byte, except its statements of time and filament.

    Parameters
    ----------
    gcode : path, or iterable of str
        A file by PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura: text, binary G-code, or an archive
        (.gcode.3mf), of which every plate is refilled; or its lines, with or without line ends.
    output : path, optional
        File to write; without it, the input is replaced.
    pattern : str, Path, Pattern or Cells
        "keep": the slicer's own paths with round corners. "auto": a honeycomb if it prints faster with the same
        filament, else "keep". Or the name of a pattern that offers paths, lines or a level
        set, see `patterns.offers`; the path of a drawing: .svg .dxf .wkt .png; "module.py:name"; or a pattern itself,
        such as `patterns.Gyroid(cell=6)`.
    density : "same", float or two floats, optional
        With "keep", "same" widens beads by up to 8 % to make up for shorter paths; without it, the filament per mm
        stays. With a pattern, a number above 0 and up to 1 is the share of the volume, and two such numbers one that
        changes from place to place; else every section keeps its amount of filament.
    by : str, Path, array or callable, optional
        What a density of two numbers follows, from the first where it is lowest to the second where it is highest: "x",
        "y" or "z", along the infill; "skin", the distance from walls, roofs and floors; "roofs", that from the roof
        above; a file: a .csv of x, y, z on the bed and a value, results of a simulation (.vtu or .frd, and one of their
        arrays as in "part.frd:SXX"), a .npy of three axes over the box around the infill, or a picture of it seen from
        above; "module.py:name"; such an array; or a function of points (N, 3), mm on the bed.
    smooth_radius : "auto" or float
        Largest radius of a corner, mm. "auto": as large as support and contact allow. 0 leaves corners.
    max_deviation : float, optional
        Largest move of a path, mm.
    max_segments : "auto", "none" or float
        Segments per second that the controller of the printer can take at the speed of the infill. "auto": 200 where
        the file is for Marlin (legacy), else no limit.
    arcs : "auto", "on" or "off"
        Write curves as arcs (G2, G3), at most 0.0125 mm from the points of the path. "auto": if the file has arcs.
    even : "time" or "volume", optional
        An experiment: slow down the infill of single layers, or change the width of its beads, so that neighbouring
        layers take alike time or filament. For a new pattern.
    leeway : float, optional
        Largest share by which the infill of a layer may take more time, or more or less filament, for that;
        by default 0.1.
    layers : tuple of int, optional
        The first and the last layer to refill, counted from 1.
    part : str, optional
        Refill only objects with this in their name.
    dry_run : bool
        Write nothing.
    overwrite : bool
        Replace `output` if it exists.
    progress : callable, optional
        Called with the current stage and the share done, 0 to 1.
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
        If the file is not G-code, or has no marked layers.
    GeometryError
        If a check of the whole file fails; it is left as it was.
    OutputError
        If the file cannot be written.
    """
    if not isinstance(gcode, str | os.PathLike):
        gcode = list(gcode)
    options: dict[str, Any] = {
        "density": density,
        "by": by,
        "smooth_radius": smooth_radius,
        "max_deviation": max_deviation,
        "max_segments": max_segments,
        "arcs": arcs,
        "even": even,
        "leeway": leeway,
        "layers": layers,
        "part": part,
    }
    if pattern == AUTO:
        options |= parameters
        return _refill_by_choice(gcode, options, output, dry_run=dry_run, overwrite=overwrite, progress=progress)
    request = Request(
        pattern=pattern,  # type: ignore[arg-type]  # whose name takes its place
        parameters=parameters,
        **options,
    )
    if not isinstance(gcode, str | os.PathLike):
        return _refill_lines(gcode, request, progress)
    source = Path(gcode)
    target = Path(os.path.realpath(source)) if output is None else Path(output)
    if not source.exists():
        raise FormatError(missing_file(source))
    if not dry_run:
        check_target(target, overwrite=overwrite or output is None)
    folder = None if dry_run else target.parent
    with open_sliced(source) as sliced, contextlib.ExitStack() as drafts:
        check_output_name(None if output is None else target, sliced)
        drafted: dict[int | None, _Draft] = {}
        for number, plate in enumerate(sliced.parts):
            scratch = drafts.enter_context(scratch_file(folder))
            plate_progress = _scale_progress(progress, number, len(sliced.parts))
            with sliced.text(plate, folder) as text:
                drafted[plate] = _refill_text(text, scratch, request, plate_progress)
        _check_choice(request, [draft.tally for draft in drafted.values() if draft.tally is not None])
        _check_paths_remain(request, list(drafted.values()))
        report = _joint_report(request, list(drafted.values()), sliced.plates)
        changed = {plate: draft for plate, draft in drafted.items() if draft.tally is not None and draft.tally.replaced}
        if dry_run or (not changed and output is None):
            return RefillResult(report=report, path=None, source=source)
        if not changed and target.exists() and target.samefile(source):
            return RefillResult(report=report, path=target, source=source)
        if changed and progress is not None:
            progress("writing", 0.95)
        with atomic_file(target) as file:
            copy_mode(source, file)
            if changed:
                texts = {plate: edited_text(draft.draft, draft.edits) for plate, draft in changed.items()}
                sliced.rewrite(
                    file, texts, {name: v for draft in changed.values() for name, v in draft.metadata.items()}
                )
            else:  # a copy
                sliced.file.seek(0)
                shutil.copyfileobj(sliced.file, file)
    return RefillResult(report=report, path=target, source=source)


def _refill_by_choice(
    gcode: str | os.PathLike[str] | list[str],
    options: dict[str, Any],
    output: str | os.PathLike[str] | None,
    *,
    dry_run: bool,
    overwrite: bool,
    progress: Progress | None,
) -> RefillResult:
    """Refill a print with the pattern that suits it better: two dry runs choose it."""
    from infill.refilling.choosing import PATTERNS, choose_pattern

    runs = len(PATTERNS) + 1

    def try_pattern(pattern: str) -> RefillReport:
        shown = _scale_progress(progress, PATTERNS.index(pattern), runs)
        return refill(gcode, pattern=pattern, dry_run=True, progress=shown, **options).report

    if not dry_run and isinstance(gcode, str | os.PathLike) and output is not None and Path(gcode).exists():
        check_target(Path(output), overwrite=overwrite)
    pattern, choice = choose_pattern(try_pattern)
    shown = _scale_progress(progress, runs - 1, runs)
    result = refill(
        gcode, output=output, pattern=pattern, dry_run=dry_run, overwrite=overwrite, progress=shown, **options
    )
    if choice is not None:
        result.report["choice"] = choice
    return result


def _check_choice(request: Request, prints: Sequence[RefillStats]) -> None:
    """Raise ParameterError if the layers or the object asked for are in none of the prints."""
    most = max((stats.layers for stats in prints), default=0)
    if request.layers is not None and most and request.layers[0] > most:
        low, high = request.layers
        asked = f"{low}" if low == high else f"{low} and more" if high == ENDLESS else f"{low} to {high}"
        raise ParameterError.about("layers", f"is {asked}, and the print has {most:,}; give some from 1 to {most}")
    names = [name for stats in prints for name in stats.objects]
    if request.part is not None and prints and not any(request.part in name for name in names):
        raise ParameterError.about(
            "part", f"is {quote_value(request.part)}, which is in no name of an object; {describe_objects(names)}"
        )


def _check_paths_remain(request: Request, parts: Sequence[_Draft]) -> None:
    """Raise UsageError for options of the slicer's own paths, if an earlier refill replaced these in all prints."""
    if any(part.tally is not None or part.is_same for part in parts):
        return
    plain = Request(pattern=KEEP)
    options = ("density", "by", "smooth_radius", "max_deviation", "max_segments", "arcs", "layers", "part")
    changed = tuple(name for name in options if getattr(request, name) != getattr(plain, name))
    if changed:
        raise UsageError.about(
            changed,
            "would change the slicer's own paths, and this print was refilled before; refill the print that the slicer "
            "wrote, or give pattern",
        )


def _scale_progress(progress: Progress | None, number: int, count: int) -> Progress | None:
    """Scale the progress of one of several prints to that of all."""
    if progress is None or count == 1:
        return progress
    return lambda stage, share: progress(stage, (number + share) / count)


def _refill_lines(lines: Iterable[str], request: Request, progress: Progress | None) -> RefillResult:
    """Refill lines of text."""
    text = "".join(line if line.endswith("\n") else f"{line}\n" for line in lines)
    sliced = SlicedText(text=io.BytesIO(text.encode("utf-8", "surrogateescape")))
    drafted = _refill_text(sliced, io.BytesIO(), request, progress)
    _check_choice(request, [] if drafted.tally is None else [drafted.tally])
    _check_paths_remain(request, [drafted])
    if drafted.tally is not None and drafted.tally.replaced:
        text = b"".join(edited_text(drafted.draft, drafted.edits)).decode("utf-8", "surrogateescape")
    # Not splitlines: comments may hold characters that it treats as line ends.
    report = _joint_report(request, [drafted])
    return RefillResult(report=report, path=None, lines=tuple(f"{line}\n" for line in text.split("\n")[:-1]))


@dataclass(frozen=True, kw_only=True)
class _Draft:
    """A draft, and the edits that it still needs.

    Parameters
    ----------
    found : Survey
    draft : binary file
    tally, rules : RefillStats and RefillRules, optional
        None if the print was refilled before, and is to keep its paths.
    is_same : bool
        True if it was refilled before with the same options.
    remedy : RefillStats, optional
        Of the remedy for infill that lost too much filament: a trial drawing that is discarded.
    edits : tuple of (place, length, text)
        Replacements in the draft, in order.
    metadata : dict
        New values outside the text.
    """

    found: Survey
    draft: BinaryIO
    tally: RefillStats | None = None
    rules: RefillRules | None = None
    is_same: bool = False
    remedy: RefillStats | None = None
    edits: tuple[tuple[int, int, bytes], ...] = ()
    metadata: dict[str, str] = field(default_factory=dict)


def _joint_report(request: Request, parts: Sequence[_Draft], plates: Sequence[int] = ()) -> RefillReport:
    """Report on all prints of a file; those that were refilled before count only if all of them were."""
    from infill.gcode.survey import merge_surveys
    from infill.refilling.report import refill_report
    from infill.refilling.stats import RefillStats

    joint_survey = merge_surveys([part.found for part in parts])
    drawn = [part for part in parts if part.tally is not None]
    rules = max((part.rules for part in drawn if part.rules), key=lambda rules: rules.rounding.deviation, default=None)
    total, remedied = RefillStats(), RefillStats()
    for part in drawn:
        assert part.tally is not None
        total.add(part.tally)
        remedied.add(part.remedy or part.tally)
    return refill_report(
        request,
        joint_survey,
        total if drawn else None,
        already=not drawn,
        rules=rules,
        plates=plates,
        remedy=remedied if any(part.remedy is not None for part in parts) else None,
    )


def _refill_text(sliced: SlicedText, draft: BinaryIO, request: Request, progress: Progress | None) -> _Draft:
    """Write the new text to a draft."""
    import infill.kernels.gcode_lines  # noqa: F401 - a refill needs compiled searches: lines may be read by such code, too
    from infill.gcode.survey import survey_print
    from infill.planner.print_clock import PrintClock
    from infill.refilling.drafting import Drafting
    from infill.refilling.layers import sample_layers
    from infill.refilling.placement import family_of
    from infill.refilling.report import loses_filament
    from infill.refilling.rules import derive_rules
    from infill.refilling.support import largest_deviation

    family = None if request.pattern == KEEP else family_of(request.pattern, request.parameters, request.lines)
    print_survey = survey_print(sliced.text, more=family is not None and not family.prismatic, settings=sliced.settings)
    print_survey = replace(print_survey, slicer=print_survey.slicer or sliced.slicer)
    is_same = _options_mark(request) in print_survey.stamp
    if is_same or (print_survey.stamp and request.pattern == KEEP):
        return _Draft(found=print_survey, draft=draft, is_same=is_same)
    if progress is not None:
        progress("looking at layers", 0.0)
    samples = sample_layers(print_survey, sliced.text)
    rules = derive_rules(request, print_survey, samples)
    plan = None
    if family is not None:
        plan = _plan_pattern(request, family, samples, rules, sliced, print_survey)
        rules = rules if plan is not None else rules.rounded_by(0.0)
    elif request.smooth_radius == AUTO and samples:
        rules = rules.rounded_by(largest_deviation(samples, rules.rounding, rules.acceleration))
    clock = PrintClock(sliced)
    drafting = Drafting(file=sliced.text, begin=clock.begin, draft=draft, print_survey=print_survey, progress=progress)
    tally, rules, final_plan = drafting.meet_targets(rules, plan, clock)
    if final_plan is not None and tally.replaced:
        tally = drafting.even_out(tally, rules, final_plan, clock, sliced)
    remedy = None
    if request.pattern == KEEP and loses_filament(tally) and request.smooth_radius != AUTO:
        by_itself = replace(rules, request=replace(request, smooth_radius=AUTO)).with_radius(math.inf)
        by_itself = by_itself.rounded_by(largest_deviation(samples, by_itself.rounding, rules.acceleration))
        with tempfile.TemporaryFile() as trial:
            remedy, _, _ = replace(drafting, draft=trial).meet_targets(by_itself, None)
    if print_survey.begin.volumetric:
        for stats in [tally] if remedy is None else [tally, remedy]:
            stats.count_millimetres([math.pi / 4 * diameter**2 for diameter in print_survey.begin.diameters])
    before = clock.finish()
    places = [place for place, _ in tally.lines]
    after = PrintClock(sliced, draft, places, found=clock.found).read() if tally.replaced else before
    new = _restate(sliced, print_survey, tally, before, after)
    edits = [(place, len(old), line) for (place, old), line in zip(tally.lines, new.lines, strict=True)]
    if tally.replaced:
        edits.append(_stamp_edit(draft, tally, request))
    return _Draft(
        found=print_survey,
        draft=draft,
        tally=tally,
        rules=rules,
        remedy=remedy,
        edits=tuple(sorted(edits)),
        metadata=new.metadata,
    )


def _plan_pattern(
    request: Request,
    family: Family,
    samples: Sequence[Layers],
    rules: RefillRules,
    sliced: SlicedText,
    print_survey: Survey,
) -> RefillPlan | None:
    """Plan a refill with a pattern; None without infill.

    A density that changes takes a pass over the print, and so does a pattern that follows it.
    """
    from infill.paths.families.infill_space import follows_print
    from infill.refilling.gradients import measure_gradient
    from infill.refilling.planning import plan_refill
    from infill.refilling.print_place import look_at_infill

    graded, density, follows = None, request.density, follows_print(family)
    place = None
    if samples and (request.gradient is not None or follows):
        place = look_at_infill(sliced.text, print_survey.begin, print_survey.layers)
    if request.gradient is not None and samples:
        graded = None if place is None else measure_gradient(request.gradient, place)
        density = request.gradient.middle
    return plan_refill(
        family,
        samples,
        rules.rounding,
        density=float(density) if isinstance(density, float | int) else None,
        acceleration=rules.acceleration,
        cell=request.cell,
        graded=graded,
        place=place if follows else None,
    )


def _restate(
    sliced: SlicedText, print_survey: Survey, tally: RefillStats, before: PrintTime, after: PrintTime
) -> Restatement:
    """Update the statements of a print, and add its totals to the tally."""
    change = EstimateChange(
        seconds=after.seconds,
        first_layer=after.first_layer,
        ratio=after.seconds / before.seconds if before.seconds else 1.0,
        first_ratio=after.first_layer / before.first_layer if before.first_layer else 1.0,
        filament=tally.filament_ratio,
        tools=tally.tool_ratios,
    )
    lines = [line for _, line in tally.lines]
    elapsed = after.elapsed.tolist() if tally.replaced else None
    new = restate(lines, sliced.metadata, change, tally.change, elapsed)
    used = sum(tally.filament.values())
    tally.print_before = _print_amounts(before, new.before, used, print_survey)
    tally.print_after = _print_amounts(after, new.after, used + sum(tally.change.values()), print_survey)
    tally.slicer_seconds = new.seconds
    tally.unread, tally.first_unread = before.unread, before.first_unread
    return new


def _print_amounts(time: PrintTime, stated: StatedAmounts, used: float, print_survey: Survey) -> PrintAmounts:
    """Sum up a print: the filament that it states, or else the counted amount."""
    from infill.refilling.stats import PrintAmounts

    filament = used if stated.millimetres is None else stated.millimetres
    grams, density = stated.grams, print_survey.number("filament_density")
    if grams is None and density:
        grams = filament * math.pi / 4 * print_survey.begin.diameter**2 / 1000 * density
    return PrintAmounts(seconds=time.seconds, infill_seconds=time.infill, filament=filament, grams=grams)


def _options_mark(request: Request) -> bytes:
    """Return the pattern of a request, and a checksum of all its options, which the stamp holds."""
    chosen = {item.name: getattr(request, item.name) for item in fields(request) if item.name not in SET_ONCE_CHECKED}
    if request.gradient is None:
        del chosen["by"]  # as before there were gradients
    else:
        chosen["by"] = request.by, request.gradient.checksum
    numbers = {name: value + 0.0 if isinstance(value, int) else value for name, value in request.parameters.items()}
    chosen["parameters"] = sorted(numbers.items())
    return f"{request.pattern} {zlib.crc32(repr(sorted(chosen.items())).encode()):08x}".encode()


def _stamp_edit(draft: BinaryIO, tally: RefillStats, request: Request) -> tuple[int, int, bytes]:
    """Return the edit that inserts the stamp: in place of that of an earlier refill, or below the header.

    The header is a block of comments, or a first line that is a comment.
    """
    from infill.gcode.survey import HEAD, STAMP

    draft.seek(0)
    head = draft.read(HEAD)
    earlier = head.find(STAMP)
    place = 0
    for marker in (b"; HEADER_BLOCK_END", b";END_OF_HEADER"):
        marker_place = head.find(marker)
        if marker_place >= 0 and (end := head.find(b"\n", marker_place)) >= 0:
            place = end + 1
    if not place and head.startswith(b";") and b"\n" in head:
        place = head.index(b"\n") + 1
    line = head[:place] or head[: head.find(b"\n") + 1]
    line_end = b"\r\n" if line.endswith(b"\r\n") else b"\n"
    counts = b"%d of %d sections" % (tally.replaced, tally.sections)
    text = b"%s %s: %s, %s%s" % (STAMP, __version__.encode(), counts, _options_mark(request), line_end)
    if earlier >= 0:
        return earlier, head.find(b"\n", earlier) + 1 - earlier, text
    return place, 0, text
