"""``infill smooth`` with ``{label}`` in a name or ``--each-label``: every label of a segmentation in one run."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import typer

from infill.cli.console import format_bytes, format_table, print_json, print_log, progress_bar, say
from infill.cli.foreseeing import format_span
from infill.errors import UsageError
from infill.plain_numbers import list_some, plain_number, plain_size

if TYPE_CHECKING:
    from infill.imaging.label_tables import Segment
    from infill.imaging.segmentations import Segmentation
    from infill.lazy.volume import LazyVolume
    from infill.reports.smoothing import TetrahedraKeys, TogetherLabel
    from infill.result import Result
    from infill.smoothing.label_stages import LabelStages
    from infill.smoothing.request import SmoothOptions
    from infill.smoothing.settings import SmoothSettings
    from infill.surface import Surface

MOST_ROWS = 60  # labels in the summary
MOST_FILES = 12  # that a dry run lists
MOST_PROBLEMS = 12  # in the summary


@dataclass(frozen=True, kw_only=True)
class SmoothOutput:
    """The outputs of a run, and their options."""

    outputs: Sequence[Path]
    preview: Path | None
    saved: Mapping[Path, Callable[[BinaryIO], object]]
    ascii_stl: bool
    force: bool
    dry_run: bool
    as_json: bool
    quiet: bool
    verbose: bool

    def check(self) -> None:
        """Raise an error, before the work, if an output cannot be written."""
        from infill.cli.piping import check_outputs

        check_outputs(
            (*self.outputs, self.preview),
            text=next(iter(self.saved), None),
            overwrite=self.force,
            as_json=self.as_json,
            dry_run=self.dry_run,
        )


def wants_every_label(
    outputs: Sequence[Path], *, each_label: bool, labels: Path | None, keep_going: bool, together: bool
) -> bool:
    """Tell whether all labels are asked for, as --together does too; raise BadParameter for options that need it."""
    from infill.files.file_names import is_template

    if each_label or together or any(is_template(path) for path in outputs):
        return True
    options = {"--labels": labels is not None, "--keep-going": keep_going}
    for name, is_given in options.items():
        if is_given:
            raise typer.BadParameter(f"{name} goes with --each-label, or with {{label}} in the name of an output")
    return False


def refuse_options(settings: SmoothSettings, output: SmoothOutput) -> None:
    """Raise BadParameter for the first option that is given but does not apply to labels."""
    from infill.options.declaration import declared_options
    from infill.smoothing.settings import NOT_FOR_LABELS

    declared = declared_options(type(settings))
    given = ["preview"] * (output.preview is not None)
    given += [key for key in NOT_FOR_LABELS if getattr(settings, declared[key].field) != declared[key].default]
    given += ["grey"] * (settings.method == "grey")
    if given:
        option = given[0].replace("_", "-")
        labels = "--together" if settings.together else "--each-label or {label}"
        raise typer.BadParameter(f"--{option} does not go with {labels}; leave one of them out")


def smooth_every_label(
    source: Path,
    settings: SmoothSettings,
    output: SmoothOutput,
    options: SmoothOptions,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
) -> None:
    """Smooth every label, write the files and print a summary."""
    from infill.chunks.running import check_runner
    from infill.cli.piping import check_outputs, deliver_all
    from infill.files.file_names import is_template
    from infill.formats.mesh_files import TETRAHEDRA, WALL_WRITERS, mesh_writer, parts_writer

    single = [path for path in output.outputs if not is_template(path)]
    more = (*WALL_WRITERS, TETRAHEDRA) if settings.together else ()
    for path in output.outputs:
        if path in single and path.suffix.lower() in more:
            continue
        mesh_writer(path, ascii=output.ascii_stl, more=more if path in single else ())
        if path in single:
            parts_writer(path, more=more)
    check_runner(workers, scheduler)
    tasks = {"workers": workers, "scheduler": scheduler}
    if _is_read_in_parts(source, settings, tasks) and settings.together:
        _refuse_tetrahedra(single)
    text = next(iter(output.saved), None)
    check_outputs(single, text=text, overwrite=output.force, as_json=output.as_json, dry_run=output.dry_run)
    if output.dry_run:
        _show_label_plan(source, settings, output, options, tasks)
        return
    with progress_bar(shown=not output.quiet) as progress, print_log(shown=not output.quiet):
        if progress is not None:
            progress("read", 0.0)
        label_options: SmoothOptions = {**options, "progress": _scaled_progress(progress)}
        result = _smooth_labels(source, settings, label_options, tasks)
        if progress is not None:
            progress("write", 0.9)
        report = {**result.report, **_tetrahedra_section(result, single)}
        parts = _parts(result, output)
        check_outputs(parts, text=text, overwrite=output.force, as_json=output.as_json)
        files = deliver_all(parts | dict(output.saved))
    if not output.quiet:
        say(_summary(report, files, str(source)))
    if output.as_json:
        print_json({**report, "files": files})
    failed = result.report["failed"]
    if failed:
        say(f"error: {len(failed)} of {len(failed) + len(result.surfaces)} labels failed; the others were written")
        raise typer.Exit(1)


def _smooth_labels(
    source: Path, settings: SmoothSettings, options: SmoothOptions, tasks: Mapping[str, Any]
) -> Result[Any, Any]:
    """Smooth the labels of a source: all of it in memory, or each part of it when it is needed."""
    choice: dict[str, Any] = {"label": settings.label, "keep_going": settings.keep_going}
    if _is_read_in_parts(source, settings, tasks):
        from infill.smoothing.lazy_labels import smooth_lazy_labels
        from infill.smoothing.together_chunks import smooth_together_in_chunks

        volume, in_file, table = _open_labels(source, settings)
        if not settings.together:
            return smooth_lazy_labels(volume, segments=in_file, table=table, **choice, **tasks, **options)
        if choice.pop("keep_going"):
            raise UsageError.about("keep_going", "does not go with labels together; leave it out")
        return smooth_together_in_chunks(volume, segments=in_file, table=table, **choice, **tasks, **options)
    from infill.smoothing.labels import smooth_labels

    segmentation, table = _read_labels(source, settings)
    choice["together"] = settings.together
    result: Result[Any, Any] = smooth_labels(segmentation, table=table, **choice, **options)
    return result


def _is_read_in_parts(source: Path, settings: SmoothSettings, tasks: Mapping[str, Any]) -> bool:
    """Tell whether the source is read in parts: if it is asked for, or a Zarr or HDF5 of labels each by itself."""
    from infill.lazy.names import is_lazy

    return any(value is not None for value in tasks.values()) or (is_lazy(source) and not settings.together)


def _refuse_tetrahedra(outputs: Sequence[Path]) -> None:
    """Raise BadParameter for tetrahedra, which are made of a volume in memory."""
    from infill.formats.mesh_files import TETRAHEDRA

    for path in outputs:
        if path.suffix.lower() == TETRAHEDRA:
            raise typer.BadParameter(f"{path} is not made in chunks; leave --workers and --scheduler out")


def _open_labels(source: Path, settings: SmoothSettings) -> tuple[LazyVolume, tuple[Segment, ...], tuple[Segment, ...]]:
    """Open a volume of labels; return the names and colours in it, and those of another file if there is one."""
    from infill.imaging.label_tables import read_labels
    from infill.smoothing.sources import open_label_source

    table = () if settings.labels is None else tuple(read_labels(settings.labels))
    reading = {name: value for name, value in settings.reading.items() if name != "units"}
    return *open_label_source(source, **reading), table


def _read_labels(source: Path, settings: SmoothSettings) -> tuple[Segmentation, tuple[Segment, ...]]:
    """Read a segmentation, and the names and colours of another file if there is one."""
    from infill.imaging.label_tables import read_labels
    from infill.smoothing.sources import read_label_source

    segments = () if settings.labels is None else tuple(read_labels(settings.labels))
    reading = {name: value for name, value in settings.reading.items() if name != "units"}
    return read_label_source(source, **reading), segments


def _show_label_plan(
    source: Path, settings: SmoothSettings, output: SmoothOutput, options: SmoothOptions, tasks: Mapping[str, Any]
) -> None:
    """Print the labels that would be smoothed, and the files that would be written."""
    from infill.formats.mesh_files import TETRAHEDRA
    from infill.smoothing.plan import plan_labels
    from infill.smoothing.together_plan import plan_together

    begin = time.perf_counter()
    with print_log(shown=not output.quiet):
        choice: dict[str, Any] = {"begin": begin, "label": settings.label}
        if _is_read_in_parts(source, settings, tasks):
            from infill.smoothing.lazy_labels import plan_lazy_labels
            from infill.smoothing.together_chunks import plan_together_in_chunks

            volume, in_file, table = _open_labels(source, settings)
            plan_parts = plan_together_in_chunks if settings.together else plan_lazy_labels
            plan = plan_parts(volume, segments=in_file, table=table, **choice, **tasks, **options)
        elif settings.together:
            segmentation, table = _read_labels(source, settings)
            wants_tetrahedra = any(path.suffix.lower() == TETRAHEDRA for path in output.outputs)
            plan = plan_together(segmentation, tetrahedra=wants_tetrahedra, table=table, **choice, **options)
        else:
            segmentation, table = _read_labels(source, settings)
            plan = plan_labels(segmentation, table=table, **choice, **options)
    labels = plan["labels"]
    files = [
        str(path)
        for path in _label_files(output, [label["name"] for label in labels], [label["number"] for label in labels])
    ]
    files += [str(path) for path in output.saved]
    if output.as_json:
        print_json({**plan, "files": files})
        return
    rows = {
        f"{label['number']} {label['name']}": f"{plain_size(label['data'], digits=6, power=3)}, about "
        f"{label['triangles_before']:,} triangles before simplification"
        for label in labels[:MOST_ROWS]
    }
    if len(labels) > MOST_ROWS:
        rows["…"] = f"and {len(labels) - MOST_ROWS} more"
    rows["memory"] = f"about {format_bytes(plan['memory'])}" + ("" if settings.together else " for the largest")
    rows["time"] = f"about {format_span(plan['seconds']['total'])} on this machine, as busy as it is"
    if files:
        rows["would write"] = list_some(files, MOST_FILES)
    typer.echo(format_table(rows, title=f"{source}: nothing is written (--dry-run)"))


def _label_files(output: SmoothOutput, names: Sequence[str], numbers: Sequence[int]) -> list[Path]:
    """Return the files of a run over labels, in the order of the outputs."""
    from infill.files.file_names import fill_template, is_template

    return [
        path
        for named in output.outputs
        for path in (fill_template(named, names, numbers) if is_template(named) else [named])
    ]


def _scaled_progress(progress: Callable[[str, float], None] | None) -> Callable[[str, float], None] | None:
    """Return a progress listener that leaves room for the stages after smoothing."""
    if progress is None:
        return None
    return lambda stage, share: progress(stage, 0.9 * share)


def _parts(result: Result[LabelStages, Any], written: SmoothOutput) -> dict[Path, Callable[[BinaryIO], object]]:
    """Return a function for each file that writes it."""
    from infill.errors import OutputError
    from infill.files.file_names import fill_template, is_template
    from infill.formats.mesh_files import mesh_writer, parts_writer
    from infill.result import parts_of

    # All names, also of labels that failed: the name of a file does not depend on the other labels.
    names = list(result.stages.segments)
    numbers = [segment.value for segment in result.stages.segments.values()]
    parts: dict[Path, Callable[[BinaryIO], object]] = {}
    for output in written.outputs:
        if not is_template(output):
            whole = result.writers.get(output.suffix.lower())
            parts[output] = partial(parts_writer(output), parts_of(result)) if whole is None else whole
            continue
        write = mesh_writer(output, ascii=written.ascii_stl)
        for name, path in zip(names, fill_template(output, names, numbers), strict=True):
            if name not in result.surfaces:
                continue
            if path in parts:
                raise OutputError(f"{path} would be written for several labels; put {{label}} in the name")
            parts[path] = partial(_write_surface, result.surfaces, name, write)
    return parts


def _write_surface(
    surfaces: Mapping[str, Surface], name: str, write: Callable[[Surface, BinaryIO], object], file: BinaryIO
) -> None:
    """Write one of several surfaces, which may be made when it is asked for."""
    write(surfaces[name], file)


def _together_text(label: TogetherLabel) -> str:
    """Return the row of a label that was smoothed together with others; in chunks, without a verdict."""
    text = (
        f"{label['triangles']:,} triangles, {plain_size(label['volume'], digits=6, power=3)}, "
        f"{label['volume_change']:+z.4%} of the data"
    )
    if "verdict" not in label:
        return text
    return "; ".join([text, label["verdict"]["word"], *label["verdict"]["changes"]])


def _tetrahedra_section(result: Result[Any, Any], outputs: Sequence[Path]) -> dict[str, Any]:
    """Return the section of the report on tetrahedra, if they are to be written."""
    from infill.formats.mesh_files import TETRAHEDRA

    is_wanted = any(path.suffix.lower() == TETRAHEDRA for path in outputs)
    return {"tetrahedra": result.stages.tetrahedra_facts} if is_wanted else {}


def _tetrahedra_text(facts: TetrahedraKeys) -> str:
    """Return the row of the tetrahedra."""
    return (
        f"{facts['tetrahedra']:,}, smallest angle {plain_number(facts['smallest_angle'], 2)} degrees, "
        f"{facts['slivers']:.1%} with a radius ratio below 0.1"
    )


def _summary(report: Mapping[str, Any], files: Sequence[str], name: str) -> str:
    """Return the short table for stderr: a row for each label, and failures."""
    rows = {}
    for label in report["labels"][:MOST_ROWS]:
        if "report" not in label:
            rows[f"{label['number']} {label['name']}"] = _together_text(label)
            continue
        part = label["report"]
        if "verdict" in part:
            verdict = "; ".join([part["verdict"]["word"], *part["verdict"]["changes"]])
        else:  # in chunks
            verdict = "; ".join(part["changes"]) or "none counted; distances are not measured"
        rows[f"{label['number']} {label['name']}"] = (
            f"{part['triangles']:,} triangles, {plain_size(part['volume'], digits=6, power=3)}, "
            f"{part['volume_change']:+z.4%} of the data; {verdict}"
        )
    if len(report["labels"]) > MOST_ROWS:
        rows["…"] = f"and {len(report['labels']) - MOST_ROWS} more"
    for failure in report["failed"]:
        rows[f"FAILED {failure['number']} {failure['name']}"] = failure["error"]
    if report["absent"]:
        rows["without a cell"] = ", ".join(report["absent"])
    if "verdict" in report:
        rows["verdict"] = report["verdict"]["summary"]
    if report.get("tetrahedra"):
        rows["tetrahedra"] = _tetrahedra_text(report["tetrahedra"])
    if report["problems"]:
        more = len(report["problems"]) - MOST_PROBLEMS
        rows["PROBLEMS"] = "; ".join(report["problems"][:MOST_PROBLEMS])
        if more > 0:
            rows["PROBLEMS"] += f"; and {more} more, all in the report (--json)"
    sizes = [Path(file).stat().st_size for file in files if Path(file).is_file()]
    if len(files) == 1:
        rows[f"wrote {files[0]}"] = format_bytes(sum(sizes))
    elif files:
        rows["wrote"] = f"{len(files)} files, {files[0]} to {files[-1]}, {format_bytes(sum(sizes))}"
    return format_table(rows, title=name)
