"""``infill motion``: how long a printer takes for a file of G-code, or for two, side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from infill.cli.console import format_table, print_json, say
from infill.cli.declared import takes_options
from infill.cli.piping import is_piped
from infill.errors import FormatError
from infill.gcode.ending import describe_missing_end
from infill.options.declaration import by_field, read_options
from infill.plain_numbers import count_noun, plain_argument, plain_clock, plain_number, plain_size
from infill.timing.request import FILES, MotionOptions

if TYPE_CHECKING:
    from infill.reports.timing import MotionReports
    from infill.timing.printing_time import FeatureMotion, Motion, WrittenTimes

EVERY_LAYER = "layers="  # begins the name of a picture of every layer
UNITS = {"feedrate": "mm/s", "axis_acceleration": "mm/s²", "acceleration": "mm/s²", "jerk": "mm/s"}
UNITS |= {"junction_deviation": "mm", "square_corner_velocity": "mm/s", "travel_acceleration": "mm/s²"}
UNITS |= {"corner_extrusion_velocity": "mm/s"}
# Columns of a single file: heading, and the text of a feature below it.
COLUMNS: dict[str, Callable[[FeatureMotion], str]] = {
    "laid m": lambda each: f"{each.length / 1000:.2f}",
    "travel m": lambda each: f"{each.travel / 1000:.2f}",
    "paths": lambda each: f"{each.paths}",
    "retractions": lambda each: f"{each.retractions}",
    "turns >30°": lambda each: f"{each.turns}",
    "°/mm": lambda each: f"{each.turning:.1f}",
    "segment mm": lambda each: "-" if each.median_segment is None else plain_number(each.median_segment, 2),
    "<0.1 mm": lambda each: "-" if each.short_segments is None else f"{each.short_segments:.1%}",
    "mm³/s": lambda each: f"{each.peak_flow:.1f}",
}


@takes_options(MotionOptions)
def motion(
    file: Annotated[
        Path, typer.Argument(metavar="A.gcode", help="G-code from a slicer: .gcode, .bgcode or .gcode.3mf.")
    ],
    other: Annotated[
        Path | None, typer.Argument(metavar="[B.gcode]", help="A second print, to compare with the first.")
    ] = None,
    *,
    typed: dict[str, Any],
    write: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="G-code to write: the print with its estimate of time as planned, and nothing else changed.",
            rich_help_panel=FILES,
        ),
    ] = None,
    in_place: Annotated[
        bool,
        typer.Option("--in-place", help="Write the estimate into the print itself.", rich_help_panel=FILES),
    ] = False,
    plot: Annotated[
        str | None,
        typer.Option(
            metavar="FILE",
            help="Picture to write, a .png: of a layer, coloured by speed; layers=FILE: of the seconds of all layers.",
            rich_help_panel=FILES,
        ),
    ] = None,
    layer: Annotated[
        int | None,
        typer.Option(
            metavar="N", help="Which layer to plot, counted from 1. (default: the middle one)", rich_help_panel=FILES
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """Plan every move of a print as firmware does, and say how long each feature takes and why."""
    from infill.timing.printing_time import motion as planned

    options = by_field(MotionOptions, read_options("motion", MotionOptions, typed))
    if plot is None and layer is not None:
        raise typer.BadParameter("a layer is for a picture; name one with --plot")
    picture = None if plot is None else Path(plot.removeprefix(EVERY_LAYER))
    shows_every_layer = plot is not None and plot.startswith(EVERY_LAYER)
    if shows_every_layer and layer is not None:
        raise typer.BadParameter(f"{EVERY_LAYER} shows every layer; leave --layer out, or give --plot {picture}")
    target = _check_write(file, other, write, in_place=in_place)
    if picture is not None:
        _check_plot(picture, overwrite=force)
    paths = [file] if other is None else [file, other]
    motions = [planned(path, **options, write=target, overwrite=force or in_place) for path in paths]
    if target is not None:
        say(f"wrote {target}")
    if picture is not None and shows_every_layer:
        _write_layer_times(paths, motions, picture)
    elif picture is not None:
        chosen = layer if layer is not None else max(motions[0].layers // 2, 1)
        _write_plot(paths, chosen, options, picture)
    if as_json:
        reports: MotionReports = {
            "files": [{"file": str(path), **plan.to_dict()} for path, plan in zip(paths, motions, strict=True)]
        }
        print_json(reports["files"][0] if other is None else reports)
        return
    for path, plan in zip(paths, motions, strict=True):
        typer.echo(_summary(path, plan))
    typer.echo(_feature_table(motions[0]) if other is None else _comparison_table(motions))


def _check_write(file: Path, other: Path | None, write: Path | None, *, in_place: bool) -> Path | None:
    """Return the file to write the estimate to, None without one; raise BadParameter if there is not one choice."""
    if (write is not None or in_place) and other is not None:
        raise typer.BadParameter("an estimate is written for one print; give one file")
    if write is not None and in_place:
        raise typer.BadParameter("--write and --in-place name two files; leave one out")
    if write is not None and is_piped(write):
        raise typer.BadParameter("'-' is stdout, where the report goes; give a file name")
    return file if in_place else write


def _check_plot(path: Path, *, overwrite: bool) -> None:
    """Raise if the file of the plot is not a picture, or exists and may not be overwritten."""
    from infill.files.whole_files import check_targets
    from infill.pictures.picture_files import check_preview

    check_targets([check_preview(path)], overwrite=overwrite)


def _write_plot(paths: Sequence[Path], layer: int, options: dict[str, Any], plot: Path) -> None:
    """Draw the planned speeds of one layer of every file into a picture file."""
    from infill.files.whole_files import write_all_files
    from infill.pictures.speeds import write_speeds
    from infill.planner.layer_speeds import layer_speeds

    layers = {
        f"{number}: {path.name}, layer {layer}": layer_speeds(path, layer, **options)
        for number, path in enumerate(paths, 1)
    }
    write_all_files({plot: partial(write_speeds, layers)})
    say(f"wrote {plot}")


def _write_layer_times(paths: Sequence[Path], motions: Sequence[Motion], plot: Path) -> None:
    """Draw the seconds of every layer of every file as curves into a picture file."""
    from infill.files.whole_files import write_all_files
    from infill.pictures.layer_times import write_layer_times

    if not all(plan.by_layer.seconds for plan in motions):
        raise FormatError("the file has no marked layers; give the G-code of a slicer, with its comments")
    curves = {
        f"{number}: {path.name}, spread {plain_number(plan.by_layer.seconds_spread, 3)} s": plan.by_layer.seconds
        for number, (path, plan) in enumerate(zip(paths, motions, strict=True), 1)
    }
    write_all_files({plot: partial(write_layer_times, curves)})
    say(f"wrote {plot}")


def _summary(path: Path, plan: Motion) -> str:
    """Format the facts about a file as a table."""
    limits = "; ".join(
        f"{name.replace('_', ' ')} {_plain_value(plan.limits[name])} {UNITS.get(name, '')}".rstrip() + f" ({source})"
        for name, source in plan.sources.items()
    )
    rows = {} if plan.plate is None else {"plate": _plate_text(plan)}
    rows |= {
        "time": plain_clock(plan.seconds),
        "slicer": plan.slicer or "unknown",
        "its estimate": "none" if plan.estimate is None else plain_clock(plan.estimate),
        "layers": _layers_text(plan),
        "filament": f"{format_length(plan.filament, 2)}, "
        f"{count_noun(plan.retractions, 'retraction')}{_volumetric_note(plan)}",
        "laid, travelled": f"{format_length(plan.length, 1)}, {format_length(plan.travel, 1)}",
        **({"printer": plan.printer} if plan.printer else {}),
        "model": "junction-deviation" if plan.limits["model"] == "junction" else plan.limits["model"],
        "limits": limits,
    }
    if plan.missing_end:
        rows["CUT OFF"] = describe_missing_end(plan.missing_end)
    if plan.unread_lines:
        rows["NOT READ"] = (
            f"left out {count_noun(plan.unread_lines, 'line')} that may move or extrude, first at line "
            f"{plan.first_unread_line}: {plan.first_unread_text}"
        )
    if plan.macro_seconds:
        given = ", ".join(f"{name} {plain_clock(seconds)}" for name, seconds in plan.macro_seconds.items())
        rows["given times"] = given
    if plan.macros:
        rows["macros"] = (
            f"{', '.join(plan.macros)}: what the printer does there is not known and left out; --macro "
            f"{plan.macros[0]}=45s counts it"
        )
    if plan.written is not None:
        rows["written"] = _written_text(plan.written)
    notes = [f"  note: {note.name} {note.note}" for note in plan.notes]
    return "\n".join([format_table(rows, title=str(path)), *notes])


def _layers_text(plan: Motion) -> str:
    """Describe the number of layers and how much the times of neighbours differ."""
    if plan.layers < 2:
        return f"{plan.layers}"
    return f"{plan.layers}, spread of {plain_number(plan.by_layer.seconds_spread, 3)} s from one to the next"


def _written_text(written: WrittenTimes) -> str:
    """Describe the file that was written."""
    if not written.statements:
        return f"{written.file}, unchanged: the print states no time"
    return f"{written.file}, with {count_noun(written.statements, 'statement')} of time"


def format_length(mm: float, decimals: int) -> str:
    """Format a length in m with a number of decimals, or in mm if it is too short for them.

    >>> format_length(12345, 2), format_length(2.5, 2), format_length(99.7, 1), format_length(0, 2)
    ('12.35 m', '2.5 mm', '99.7 mm', '0 mm')
    """
    if mm < 10 ** (4 - decimals):
        return f"{mm:.1f}".removesuffix(".0") + " mm"
    return f"{mm / 1000:.{decimals}f} m"


def _volumetric_note(plan: Motion) -> str:
    """Note that a file counts filament in mm³, else return an empty string."""
    return f"; E in mm³, of filament {plain_size(plan.filament_diameter, digits=6)} thick" if plan.volumetric else ""


def _plate_text(plan: Motion) -> str:
    """Describe the plate that was timed, among those of the archive, and how to choose another."""
    if len(plan.plates) == 1:
        return f"{plan.plate}, the only one"
    return f"{plan.plate} of {', '.join(map(str, plan.plates))}; --plate chooses"


def _plain_value(value: float | Sequence[float]) -> str:
    """Return a number, or numbers with spaces between them, without trailing zeros."""
    return plain_argument(value) if isinstance(value, float | int) else " ".join(map(plain_argument, value))


def _feature_table(plan: Motion) -> str:
    """Return time, share and motion of every feature as a table, the longest time first."""
    rows = [["feature", "time", "share", *COLUMNS]]
    for feature in sorted(plan.features, key=lambda feature: -feature.seconds):
        share = f"{feature.seconds / plan.seconds:.1%}"
        name = feature.name or feature.role
        rows.append([name, plain_clock(feature.seconds), share, *(show(feature) for show in COLUMNS.values())])
    return _align_columns(rows)


def _comparison_table(motions: Sequence[Motion]) -> str:
    """Format the times of two files by role, beside lengths, turns and flow, as a table."""
    roles = list(dict.fromkeys(feature.role for motion in motions for feature in motion.features))
    roles.sort(key=lambda role: -motions[0].of_role(role))
    rows = [
        ["feature", "time A", "time B", "change", "laid m A", "laid m B", "turns A", "turns B", "mm³/s A", "mm³/s B"]
    ]
    for role in [*roles, "everything"]:
        features_of_role = [
            [feature for feature in motion.features if role in (feature.role, "everything")] for motion in motions
        ]
        times = [sum(feature.seconds for feature in features) for features in features_of_role]
        rows.append(
            [
                role,
                *map(plain_clock, times),
                f"{times[1] / times[0] - 1:+z.1%}" if times[0] else "-",
                *(f"{sum(feature.length for feature in features) / 1000:.2f}" for features in features_of_role),
                *(f"{sum(feature.turns for feature in features)}" for features in features_of_role),
                *(
                    f"{max((feature.peak_flow for feature in features), default=0):.1f}"
                    for features in features_of_role
                ),
            ]
        )
    return _align_columns(rows)


def _align_columns(rows: Sequence[Sequence[str]]) -> str:
    """Return rows as lines of text: the first column aligned left, the others right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for first, *rest in rows:
        cells = [f"{first:<{widths[0]}}", *(f"{cell:>{width}}" for cell, width in zip(rest, widths[1:], strict=True))]
        lines.append("  " + "  ".join(cells))
    return "\n".join(lines)
