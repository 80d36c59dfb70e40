"""``infill smooth`` with ``{label}`` in a name or ``--each-label``: every label of a segmentation in one run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, BinaryIO

import typer

from infill.cli.console import format_bytes, format_table, print_json, print_log, progress_bar, say

if TYPE_CHECKING:
    from infill.report_keys import LabelsReport
    from infill.result import Result
    from infill.smoothing.labels import LabelStages
    from infill.smoothing.request import SmoothOptions

LABELS = "Every label in one run"
MOST_ROWS = 60  # labels in the summary

EachLabel = Annotated[
    bool,
    typer.Option(
        "--each-label/--no-each-label",
        show_default=False,
        help="A surface for every label, named and coloured, into one .3mf or .glb; {label} or {number} in the name of "
        "an output implies it, and writes a file for each.",
        rich_help_panel=LABELS,
    ),
]
Labels = Annotated[
    Path | None,
    typer.Option(
        "--labels",
        metavar="FILE",
        help="Names and colours of the labels: label descriptions of ITK-SNAP, a lookup table of FreeSurfer, a .ctbl "
        "of 3D Slicer. (default: as in a .seg.nrrd or a DICOM segmentation)",
        rich_help_panel=LABELS,
    ),
]
KeepGoing = Annotated[
    bool,
    typer.Option(
        "--keep-going/--no-keep-going",
        show_default=False,
        help="If a label fails, write the others, list what failed and exit with 1. (default: write nothing)",
        rich_help_panel=LABELS,
    ),
]
Frame = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Which volume of a file with several, counted from 0: a frame of a series, a layer of segments.",
        rich_help_panel="Files",
    ),
]
Roi = Annotated[
    str | None,
    typer.Option(
        metavar="X0,X1,Y0,Y1,Z0,Z1",
        help="Only the part of a volume in this box, mm, where the mesh will lie (LPS for medical images). The surface "
        "is closed where the box cuts it.",
        rich_help_panel="Grid",
    ),
]


@dataclass(frozen=True, kw_only=True)
class LabelInput:
    """The input and its options: see `infill.smoothing.sources.read_label_source`."""

    source: Path
    kind: str | None
    array: str | None
    series: str | None
    frame: int | None
    spacing: tuple[float, ...] | None
    roi: tuple[float, ...] | None
    labels: Path | None


@dataclass(frozen=True, kw_only=True)
class LabelOutput:
    """The outputs of a run, and their options."""

    outputs: Sequence[Path]
    ascii_stl: bool
    force: bool
    as_json: bool
    quiet: bool
    keep_going: bool
    saved: Mapping[Path, Callable[[BinaryIO], object]]


def wants_every_label(outputs: Sequence[Path], *, each_label: bool, labels: Path | None, keep_going: bool) -> bool:
    """Tell whether every label is requested; raise BadParameter for options that make no sense otherwise."""
    from infill.imaging.name_templates import is_template

    if each_label or any(is_template(path) for path in outputs):
        return True
    for name, is_given in (("--labels", labels is not None), ("--keep-going", keep_going)):
        if is_given:
            raise typer.BadParameter(f"{name} goes with --each-label, or with {{label}} in the name of an output")
    return False


def refuse_options(**given: bool) -> None:
    """Raise BadParameter for the first option that is given but does not apply to labels."""
    for name, used in given.items():
        if used:
            option = name.strip("_").replace("_", "-")
            raise typer.BadParameter(f"--{option} does not go with --each-label or {{label}}; leave one of them out")


def smooth_every_label(
    label_input: LabelInput, output: LabelOutput, *, label: tuple[int, ...] | None, options: SmoothOptions
) -> None:
    """Smooth every label, write the files and print a summary."""
    from infill.cli.piping import check_outputs, deliver_all
    from infill.formats.mesh_files import mesh_writer, parts_writer
    from infill.imaging.name_templates import is_template

    single = [path for path in output.outputs if not is_template(path)]
    for path in output.outputs:
        mesh_writer(path, ascii=output.ascii_stl)
        if path in single:
            parts_writer(path)
    text = next(iter(output.saved), None)
    check_outputs(single, text=text, overwrite=output.force, as_json=output.as_json)
    with progress_bar(shown=not output.quiet) as progress, print_log(shown=not output.quiet):
        from infill.imaging.label_tables import read_labels
        from infill.smoothing.labels import smooth_labels
        from infill.smoothing.sources import read_label_source

        if progress is not None:
            progress("read", 0.0)
        segments = () if label_input.labels is None else read_labels(label_input.labels)
        segmentation = read_label_source(
            label_input.source,
            kind=label_input.kind,
            array=label_input.array,
            series=label_input.series,
            frame=label_input.frame,
            spacing=label_input.spacing,
            roi=label_input.roi,
        )
        label_options: SmoothOptions = {**options, "progress": _scaled_progress(progress)}
        result = smooth_labels(
            segmentation,
            label=label,
            table=segments,
            keep_going=output.keep_going,
            **label_options,
        )
        if progress is not None:
            progress("write", 0.9)
        parts = _parts(result, output)
        check_outputs(parts, text=text, overwrite=output.force, as_json=output.as_json)
        files = deliver_all(parts | dict(output.saved))
    if not output.quiet:
        say(_summary(result, files, str(label_input.source)))
    if output.as_json:
        print_json({**result.report, "files": files})
    failed = result.report["failed"]
    if failed:
        say(f"error: {len(failed)} of {len(failed) + len(result.surfaces)} labels failed; the others were written")
        raise typer.Exit(1)


def _scaled_progress(progress: Callable[[str, float], None] | None) -> Callable[[str, float], None] | None:
    """Return a progress listener that leaves room for the stages after smoothing."""
    if progress is None:
        return None
    return lambda stage, share: progress(stage, 0.9 * share)


def _parts(result: Result[LabelStages, LabelsReport], written: LabelOutput) -> dict[Path, Callable[[BinaryIO], object]]:
    """Return a function for each file that writes it."""
    from infill.errors import OutputError
    from infill.formats.mesh_files import mesh_writer, parts_writer
    from infill.imaging.name_templates import fill_template, is_template
    from infill.result import parts_of

    # All names, also of labels that failed: the name of a file does not depend on the other labels.
    names = list(result.stages.segments)
    parts: dict[Path, Callable[[BinaryIO], object]] = {}
    for output in written.outputs:
        if not is_template(output):
            parts[output] = partial(parts_writer(output), parts_of(result))
            continue
        write = mesh_writer(output, ascii=written.ascii_stl)
        for name, path in zip(names, fill_template(output, names, list(result.stages.segments.values())), strict=True):
            if name not in result.surfaces:
                continue
            if path in parts:
                raise OutputError(f"{path} would be written for several labels; put {{label}} in the name")
            parts[path] = partial(write, result.surfaces[name])
    return parts


def _summary(result: Result[LabelStages, LabelsReport], files: Sequence[str], name: str) -> str:
    """Return the short table for stderr: a row for each label, and failures."""
    report = result.report
    rows = {}
    for label in report["labels"][:MOST_ROWS]:
        part = label["report"]
        rows[f"{label['number']} {label['name']}"] = (
            f"{part['triangles']:,} triangles, {part['volume']:.6g} mm³, {part['volume_change']:+.4%} of the data"
        )
    if len(report["labels"]) > MOST_ROWS:
        rows["…"] = f"and {len(report['labels']) - MOST_ROWS} more"
    for failure in report["failed"]:
        rows[f"FAILED {failure['number']} {failure['name']}"] = failure["error"]
    if report["absent"]:
        rows["without a cell"] = ", ".join(report["absent"])
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    sizes = [Path(file).stat().st_size for file in files if Path(file).is_file()]
    if len(files) == 1:
        rows[f"wrote {files[0]}"] = format_bytes(sum(sizes))
    elif files:
        rows["wrote"] = f"{len(files)} files, {files[0]} to {files[-1]}, {format_bytes(sum(sizes))}"
    return format_table(rows, title=name)
