"""``infill motion``: how long a printer takes for a file of G-code, or for two, side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from infill.cli.console import print_json, say, table

if TYPE_CHECKING:
    from infill.planner.printing_time import FeatureMotion, Motion

MACHINE, FILES = "The machine, instead of what the file says", "Files"
UNITS = {"feedrate": "mm/s", "axis_acceleration": "mm/s²", "acceleration": "mm/s²", "jerk": "mm/s"}
UNITS |= {"junction_deviation": "mm", "square_corner_velocity": "mm/s", "travel_acceleration": "mm/s²"}
# Of a single file: heading, and what stands below it.
COLUMNS: dict[str, Callable[[FeatureMotion], str]] = {
    "laid m": lambda each: f"{each.length / 1000:.2f}",
    "travel m": lambda each: f"{each.travel / 1000:.2f}",
    "paths": lambda each: f"{each.paths}",
    "retractions": lambda each: f"{each.retractions}",
    "turns >30°": lambda each: f"{each.turns}",
    "°/mm": lambda each: f"{each.turning:.1f}",
    "segment mm": lambda each: "-" if each.median_segment is None else f"{each.median_segment:.2g}",
    "<0.1 mm": lambda each: "-" if each.short_segments is None else f"{each.short_segments:.1%}",
    "mm³/s": lambda each: f"{each.peak_flow:.1f}",
}


def motion(
    file: Annotated[
        Path, typer.Argument(metavar="A.gcode", help="What a slicer wrote: .gcode, .bgcode or .gcode.3mf.")
    ],
    other: Annotated[
        Path | None, typer.Argument(metavar="[B.gcode]", help="A second one, to compare with the first.")
    ] = None,
    model: Annotated[
        Literal["jerk", "vector-jerk", "junction", "klipper"] | None,
        typer.Option(
            metavar="jerk|vector-jerk|junction|klipper",
            help="What bounds the speed at corners: jerk as PrusaSlicer estimates, vector-jerk as CuraEngine does, "
            "Marlin's junction deviation, or Klipper. (default: as in the file)",
            rich_help_panel=MACHINE,
        ),
    ] = None,
    acceleration: Annotated[
        float | None,
        typer.Option(
            metavar="MM/S2", help="Of printing and travel. (default: as in the file)", rich_help_panel=MACHINE
        ),
    ] = None,
    jerk: Annotated[
        float | None,
        typer.Option(metavar="MM/S", help="Of x and y. (default: as in the file)", rich_help_panel=MACHINE),
    ] = None,
    junction_deviation: Annotated[
        float | None, typer.Option(metavar="MM", help="Marlin's. (default: as in the file)", rich_help_panel=MACHINE)
    ] = None,
    square_corner_velocity: Annotated[
        float | None,
        typer.Option(metavar="MM/S", help="Klipper's. (default: as in the file)", rich_help_panel=MACHINE),
    ] = None,
    minimum_cruise_ratio: Annotated[
        float | None,
        typer.Option(
            metavar="NUMBER",
            help="Klipper's, from 0 to less than 1. (default: as in the file)",
            rich_help_panel=MACHINE,
        ),
    ] = None,
    plate: Annotated[
        int | None,
        typer.Option(
            metavar="N", help="Which plate of an archive, .gcode.3mf. (default: the first)", rich_help_panel=FILES
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Picture to write of a layer, coloured by speed: a .png.", rich_help_panel=FILES
        ),
    ] = None,
    layer: Annotated[
        int | None,
        typer.Option(metavar="N", help="Which layer, from 1. (default: the middle one)", rich_help_panel=FILES),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.", rich_help_panel=FILES)] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """Plan every move of a print as firmware does, and say how long each feature takes, and why."""
    from infill.planner.printing_time import motion as planned

    given: dict[str, Any] = {
        "model": model,
        "acceleration": acceleration,
        "jerk": jerk,
        "junction_deviation": junction_deviation,
        "square_corner_velocity": square_corner_velocity,
        "minimum_cruise_ratio": minimum_cruise_ratio,
        "plate": plate,
    }
    if plot is None and layer is not None:
        raise typer.BadParameter("a layer is for a picture; name one with --plot")
    if plot is not None:
        _check_plot(plot, overwrite=force)
    paths = [file] if other is None else [file, other]
    found = [planned(path, **given) for path in paths]
    if plot is not None:
        chosen = layer if layer is not None else max(found[0].layers // 2, 1)
        _write_plot(paths, chosen, given, plot)
    if as_json:
        told = [{"file": str(path), **each.to_dict()} for path, each in zip(paths, found, strict=True)]
        print_json(told[0] if other is None else {"files": told})
        return
    for path, each in zip(paths, found, strict=True):
        typer.echo(_summary(path, each))
    typer.echo(_features(found[0]) if other is None else _compared(found))


def _check_plot(path: Path, *, overwrite: bool) -> None:
    from infill.files.whole_files import check_targets
    from infill.pictures.preview import check_preview

    check_targets([check_preview(path)], overwrite=overwrite)


def _write_plot(paths: Sequence[Path], layer: int, given: dict[str, Any], plot: Path) -> None:
    from infill.files.whole_files import deliver
    from infill.pictures.speeds import write_speeds
    from infill.planner.layer_speeds import layer_speeds

    layers = {
        f"{number}: {path.name}, layer {layer}": layer_speeds(path, layer, **given)
        for number, path in enumerate(paths, 1)
    }
    deliver({plot: partial(write_speeds, layers)})
    say(f"wrote {plot}")


def _summary(path: Path, found: Motion) -> str:
    """Return what is true of the whole file."""
    limits = "; ".join(
        f"{name.replace('_', ' ')} {_plain(found.limits[name])} {UNITS.get(name, '')}".rstrip() + f" ({source})"
        for name, source in found.sources.items()
    )
    rows = {} if found.plate is None else {"plate": _plate(found)}
    rows |= {
        "time": _clock(found.seconds),
        "slicer": found.slicer or "unknown",
        "its estimate": "none" if found.estimate is None else _clock(found.estimate),
        "layers": f"{found.layers}",
        "filament": f"{format_length(found.filament, 2)}, {found.retractions} retraction(s){_counted(found)}",
        "laid, travelled": f"{format_length(found.length, 1)}, {format_length(found.travel, 1)}",
        "model": found.limits["model"],
        "limits": limits,
    }
    if found.unread_lines:
        rows["NOT READ"] = (
            f"{found.unread_lines} line(s) that may move or extrude are left out; the first is line "
            f"{found.first_unread_line}: {found.first_unread_text}"
        )
    if found.macros:
        rows["macros"] = f"{', '.join(found.macros)}: what the printer does there is not known and left out"
    return table(rows, title=str(path))


def format_length(mm: float, decimals: int) -> str:
    """Return a length in m with so many decimals, or in mm where these would say next to nothing.

    >>> format_length(12345, 2), format_length(2.5, 2), format_length(99.7, 1), format_length(0, 2)
    ('12.35 m', '2.5 mm', '99.7 mm', '0 mm')
    """
    if mm < 10 ** (4 - decimals):
        return f"{mm:.1f}".removesuffix(".0") + " mm"
    return f"{mm / 1000:.{decimals}f} m"


def _counted(found: Motion) -> str:
    """Say how a file counts filament, if it is in mm³."""
    return f"; E in mm³, of filament {found.filament_diameter:g} mm thick" if found.volumetric else ""


def _plate(found: Motion) -> str:
    if len(found.plates) == 1:
        return f"{found.plate}, the only one"
    return f"{found.plate} of {', '.join(map(str, found.plates))}; --plate chooses"


def _plain(value: float | Sequence[float]) -> str:
    return f"{value:g}" if isinstance(value, float | int) else " ".join(f"{each:g}" for each in value)


def _features(found: Motion) -> str:
    rows = [["feature", "time", "share", *COLUMNS]]
    for each in sorted(found.features, key=lambda each: -each.seconds):
        share = f"{each.seconds / found.seconds:.1%}"
        name = each.name or each.role
        rows.append([name, _clock(each.seconds), share, *(show(each) for show in COLUMNS.values())])
    return _aligned(rows)


def _compared(found: Sequence[Motion]) -> str:
    """Return times of both files by role, and what explains them."""
    roles = list(dict.fromkeys(each.role for one in found for each in one.features))
    roles.sort(key=lambda role: -found[0].of_role(role))
    rows = [
        ["feature", "time A", "time B", "change", "laid m A", "laid m B", "turns A", "turns B", "mm³/s A", "mm³/s B"]
    ]
    for role in [*roles, "everything"]:
        both = [[each for each in one.features if role in (each.role, "everything")] for one in found]
        times = [sum(each.seconds for each in some) for some in both]
        rows.append(
            [
                role,
                *map(_clock, times),
                f"{times[1] / times[0] - 1:+.1%}" if times[0] else "-",
                *(f"{sum(each.length for each in some) / 1000:.2f}" for some in both),
                *(f"{sum(each.turns for each in some)}" for some in both),
                *(f"{max((each.peak_flow for each in some), default=0):.1f}" for some in both),
            ]
        )
    return _aligned(rows)


def _aligned(rows: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for first, *rest in rows:
        cells = [f"{first:<{widths[0]}}", *(f"{cell:>{width}}" for cell, width in zip(rest, widths[1:], strict=True))]
        lines.append("  " + "  ".join(cells))
    return "\n".join(lines)


def _clock(seconds: float) -> str:
    """Return a time as people read it.

    >>> _clock(8287.2), _clock(59.94)
    ('2:18:07', '0:01:00')
    """
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"
