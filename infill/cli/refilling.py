"""``infill refill``: a sliced print's infill, smooth, in its G-code."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from infill.cli.commands import use_typed_options
from infill.cli.common import FILES, RUN, Quiet, TrustCode
from infill.cli.completing import placement_assignments
from infill.cli.console import format_table, print_json, progress_bar, say
from infill.cli.declared import takes_options
from infill.cli.piping import STDOUT, check_outputs, is_piped, send_file
from infill.errors import InfillError
from infill.plain_numbers import plain_clock, plain_number
from infill.refilling.request import PATHS, Request
from infill.refilling.settings import resolve
from patterns.errors import PatternError

if TYPE_CHECKING:
    from infill.planner.layer_speeds import DrawnSpeeds, LayerSpeeds
    from infill.refilling.job import RefillResult
    from infill.reports.refilling import EvenKeys, FilamentKeys, RefillReport, TimeKeys

LEAST_SHOWN = 0.005  # of the infill: less, rounded to 0 %, has no row
ALIKE = 0.995  # of the filament of the infill: no less is the old amount


@takes_options(Request)
def refill(
    context: typer.Context,
    gcode: Annotated[
        Path,
        typer.Argument(
            metavar="PRINT.gcode...",
            help="G-code from a slicer: .gcode, .bgcode or .gcode.3mf; replaced in place without -o.",
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="G-code to write; - for stdout. (default: in place)",
            rich_help_panel=FILES,
        ),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Overwrite an existing -o file.", rich_help_panel=FILES)
    ] = False,
    *,
    typed: dict[str, Any],
    assigned: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="A parameter of the pattern, such as angle=30 (degrees) or cell=5 (mm); may be given again. "
            "docs/refill.md lists them all.",
            autocompletion=placement_assignments,
            rich_help_panel=PATHS,
        ),
    ] = None,
    config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="TOML file of these options, and of the pattern's parameters; the command line overrides it.",
            rich_help_panel=FILES,
        ),
    ] = None,
    trust: TrustCode = False,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture to write of the middle layer, before and after, coloured by speed: a .png; or a page with "
            "all layers for a browser: a .html.",
            rich_help_panel=FILES,
        ),
    ] = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would be done.", rich_help_panel=RUN)] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Give the infill of a sliced print round corners, in its G-code; nothing else changes."""
    if preview is not None and dry_run:
        raise typer.BadParameter("a dry run draws nothing; leave --preview out")
    piped = output is not None and is_piped(output)
    with contextlib.ExitStack() as stack:
        if piped:
            check_outputs([output], overwrite=force, as_json=as_json, dry_run=dry_run)
            output = Path(stack.enter_context(tempfile.TemporaryDirectory())) / (gcode.name or "print")
        with (
            _log_errors(gcode, context, in_place=output is None and not dry_run),
            progress_bar(shown=not quiet) as progress,
        ):
            from infill.refilling.job import refill as refilled

            settings = resolve(typed, config, assigned or [], trust=trust)
            write_preview = None
            if preview is not None:
                write_preview = _begin_preview(gcode, preview, settings.get("layers"), overwrite=force)
            result = refilled(
                gcode,
                output=output,
                **settings,
                dry_run=dry_run,
                overwrite=force,
                progress=progress,
            )
        if write_preview is not None:
            write_preview(result)
        if piped and result.path is not None:
            send_file(result.path)
    path = None if result.path is None else STDOUT if piped else result.path
    files = [str(file) for file in (path, preview) if file is not None]
    if not quiet:
        say(_summary(result.report, str(gcode), files))
    if as_json:
        print_json({**result.report, "files": files})


def _begin_preview(
    gcode: Path, preview: Path, layers: tuple[int, int] | None, *, overwrite: bool
) -> Callable[[RefillResult], None]:
    """Check the preview's path and read the print as it is; return the function that draws it beside the result."""
    from infill.files.whole_files import check_targets
    from infill.pictures.picture_files import check_preview, is_page

    check_targets([check_preview(preview, pages=True)], overwrite=overwrite)
    if is_page(preview):
        from infill.planner.layer_speeds import drawn_speeds

        drawn = {"before": drawn_speeds(gcode)} if gcode.is_file() else {}
        return lambda result: _write_page(drawn, result, gcode, preview)
    number, sliced_layers = _read_sliced_layer(gcode, layers)
    return lambda result: _write_picture(number, sliced_layers, result.path or gcode, preview)


def _read_sliced_layer(gcode: Path, layers: tuple[int, int] | None) -> tuple[int, dict[str, LayerSpeeds]]:
    """Return the number of the layer to draw, the middle one by default, and its speeds."""
    from infill.planner.layer_speeds import layer_speeds, middle_layer

    if not gcode.is_file():
        return 0, {}
    number = middle_layer(gcode)
    if layers is not None and not layers[0] <= number <= layers[1]:
        number = layers[0] if layers[0] > number else layers[1]
    return number, {f"layer {number}, before": layer_speeds(gcode, number)}


def _write_picture(number: int, sliced_layers: dict[str, LayerSpeeds], refilled: Path, picture: Path) -> None:
    """Draw the speeds of a layer before and after refilling into a picture file."""
    from functools import partial

    from infill.files.whole_files import write_all_files
    from infill.pictures.speeds import write_speeds
    from infill.planner.layer_speeds import layer_speeds

    write_all_files(
        {picture: partial(write_speeds, {**sliced_layers, f"layer {number}, refilled": layer_speeds(refilled, number)})}
    )


def _write_page(drawn: dict[str, DrawnSpeeds], result: RefillResult, gcode: Path, page: Path) -> None:
    """Write a page of all layers before and after refilling."""
    from infill.files.whole_files import write_all_files
    from infill.planner.layer_speeds import drawn_speeds
    from infill.refilling.job import refill_page

    text = refill_page({**drawn, "refilled": drawn_speeds(result.path or gcode)}, result.report, gcode.name)
    write_all_files({page: lambda file: file.write(text.encode())})


@contextlib.contextmanager
def _log_errors(gcode: Path, context: typer.Context, *, in_place: bool) -> Iterator[None]:
    """Write an error to a log too, and name the log in it: some slicers do not show the output of a script."""
    logs = _log_paths(gcode) if in_place else []
    try:
        yield
    except (InfillError, PatternError) as error:
        message = use_typed_options(error, context)
        for log in logs if gcode.is_file() else []:
            try:
                log.write_text(f"error: {message}\n", encoding="utf-8")
            except OSError:
                continue
            raise type(error)(f"{message} (log: {log})") from error
        raise
    for log in logs:
        with contextlib.suppress(OSError):
            log.unlink(missing_ok=True)


def _log_paths(gcode: Path) -> list[Path]:
    """Return possible paths of a log: beside the output of the slicer, if that is known, and beside the file."""
    slicer_output = Path(os.environ.get("SLIC3R_PP_OUTPUT_NAME", ""))
    # For an upload it is a name on the printer; without a folder it would lie wherever the slicer was started.
    places = [slicer_output, gcode] if slicer_output.is_absolute() and slicer_output.parent.is_dir() else [gcode]
    return [place.with_name(f"{place.name}.refill.log") for place in places if place.name]


def _summary(report: RefillReport, name: str, files: list[str]) -> str:
    """Return the short table for stderr."""
    if report["print"]["already_refilled"]:
        is_kept = report["request"]["pattern"] == "keep"
        how = "and its corners are round; --pattern draws another infill" if is_kept else "with this pattern"
        reason = f"it was refilled before, {how}"
        copies = {"wrote": f"{', '.join(files)}, the same bytes"} if files else {}
        return format_table({"nothing to do": reason, **copies}, title=name)
    sections, filament, seconds = report["sections"], report["filament"], report["time"]
    rows = {"infill": f"{sections['replaced']} of {sections['all']} sections in {report['print']['layers']} layers"}
    if plates := report["print"]["plates"]:
        rows["plates"] = ", ".join(map(str, plates))
    if "choice" in report:
        times = ", ".join(f"{pattern} {plain_clock(time)}" for pattern, time in report["choice"]["seconds"].items())
        rows["pattern"] = f"{report['request']['pattern']}, since {report['choice']['reason']} ({times} for the print)"
    if sections["kept"]:
        rows["kept"] = ", ".join(f"{number} ({reason})" for reason, number in sections["kept"].items())
    if sections["replaced"]:
        source = "the last refill" if report["print"]["refilled_before"] else "the slicer"
        rows["print"] = _print_text(filament, seconds, source)
        before, after = filament["infill_before_mm"], filament["infill_after_mm"]
        rows["filament"] = f"{after / 1000:.3f} m of infill, {after / before - 1:+z.1%}"
        density = filament["density_for_the_same_percent"]
        if densities := report["request"]["densities"]:
            shares = " to ".join(f"{plain_number(100 * share)}%" for share in densities)
            rows["density"] = f"{shares}, by {report['request']['by']}"
        if density and after < before * 0.999:
            rows["filament"] += f"; for the old amount, set {plain_number(density, 6)} % in the slicer"
            if (filament["ratio_with_density_same"] or 0.0) > ALIKE:
                rows["filament"] += ", or give --density same"
        before, after = seconds["infill_before_s"], seconds["infill_after_s"]
        if before:
            rows["time"] = f"{_format_span(after)} of infill, {after / before - 1:+z.1%} ({_format_span(before)})"
        if "even" in report:
            rows["even"] = _even_text(report["even"])
        contact = report["contact"]
        if contact["measured_mm"]:
            rows["support"] = (
                f"{contact['supported_after']:.0%} on the layer below ({contact['supported_before']:.0%}), "
                f"{contact['bonded_after']:.0%} beside another line ({contact['bonded_before']:.0%})"
            )
            if max(contact["free_after"], contact["free_before"]) >= LEAST_SHOWN:
                rows["free"] = (
                    f"{contact['free_after']:.0%} touches no wall, not even through other lines "
                    f"({contact['free_before']:.0%})"
                )
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if files:
        rows["wrote"] = ", ".join(files)
    return format_table(rows, title=name)


def _print_text(filament: FilamentKeys, seconds: TimeKeys, source: str) -> str:
    """Format time and filament of the entire print, and the old ones in brackets, by the same planner.

    `source` wrote the estimate that the print stated.
    """
    new_s, old_s = seconds["print_after_s"], seconds["print_before_s"]
    grams, old_g = filament["print_after_g"], filament["print_before_g"]
    if grams is None or old_g is None:
        grams, old_g, unit = filament["print_after_mm"] / 1000, filament["print_before_mm"] / 1000, "m"
    else:
        unit = "g"
    change = f", {new_s / old_s - 1:+z.1%}" if old_s else ""
    slicer = f"; {source} said {plain_clock(seconds['slicer_s'])}" if seconds["slicer_s"] else ""
    return f"{plain_clock(new_s)} and {grams:.2f} {unit}{change} ({plain_clock(old_s)} and {old_g:.2f} {unit}{slicer})"


def _even_text(even: EvenKeys) -> str:
    """Format the spread of the steps between layers, and the old ones in brackets."""
    if not even["steps"]:
        return "no neighbouring layers have new infill"
    unit = even["unit"]
    return (
        f"{plain_number(even['spread_after'])} {unit} of spread from one layer to the next, half of the steps under "
        f"{plain_number(even['median_step_after'])} {unit} (without --even {plain_number(even['spread_before'])} and "
        f"{plain_number(even['median_step_before'])} {unit}; as sliced {plain_number(even['spread_sliced'])} and "
        f"{plain_number(even['median_step_sliced'])} {unit})"
    )


def _format_span(seconds: float) -> str:
    """Return seconds as "2h 5m" or "5m 10s"."""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}h {minutes}m" if hours else f"{minutes}m {seconds}s"
