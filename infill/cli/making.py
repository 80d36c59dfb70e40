"""``infill make``: a block of infill, from a pattern to a file."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any, BinaryIO

import typer

from infill.cli.console import as_bytes, print_json, progress_bar, reports_errors, say, table
from patterns import PATTERNS, Parameter, Pattern, parameters

BLOCK, FILES, RUN = "Block", "Files", "Run"


def make_command(patterns: Sequence[type[Pattern]]) -> Callable[..., None]:
    """Return the command, its options those of `make` and of all `patterns`."""
    own = _pattern_options(patterns)

    def command(**options: Any) -> None:  # noqa: ANN401 - the signature below
        own_options = {name: options.pop(name) for name in own}
        make(own_options=own_options, **options)

    signature = inspect.signature(make, eval_str=True)
    common = [each for name, each in signature.parameters.items() if name != "own_options"]
    merged = [*common, *own.values()]
    command.__doc__ = make.__doc__
    command.__signature__ = signature.replace(parameters=merged)  # type: ignore[attr-defined]
    command.__annotations__ = {each.name: each.annotation for each in merged}
    return reports_errors(command)


def _names(incomplete: str) -> list[str]:
    return [name for name in PATTERNS if name.startswith(incomplete)]


def make(
    *,
    pattern: Annotated[
        str | None,
        typer.Argument(help="Name of the pattern: 'infill list' shows all.", autocompletion=_names),
    ] = None,
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            help="Mesh to write, by suffix: .stl .3mf .obj .ply .glb. May be given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(help="Picture of the four stages to write: FILE.png.", rich_help_panel=FILES),
    ] = None,
    ascii_stl: Annotated[bool, typer.Option("--ascii", help="Write STL as text.", rich_help_panel=FILES)] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)] = False,
    config: Annotated[
        Path | None,
        typer.Option(help="TOML file of options; flags win over it.", rich_help_panel=FILES),
    ] = None,
    save_config: Annotated[
        Path | None,
        typer.Option(help="TOML file to write all options to, as resolved.", rich_help_panel=FILES),
    ] = None,
    size: Annotated[
        str | None,
        typer.Option(help="Block in x and y, mm: 60x40, or 60 for a square. (default: 60x60)", rich_help_panel=BLOCK),
    ] = None,
    height: Annotated[
        float | None,
        typer.Option(help="Height of the block, mm. (default: 6)", rich_help_panel=BLOCK),
    ] = None,
    line_width: Annotated[
        float | None,
        typer.Option(help="Width of the walls, mm. (default: 0.45)", rich_help_panel=BLOCK),
    ] = None,
    stamp: Annotated[
        str | None,
        typer.Option(
            help="block: the paper's stamps, walls up to 41 % wider on diagonals; "
            "exact: the same width in every direction. (default: block)",
            rich_help_panel=BLOCK,
        ),
    ] = None,
    cells: Annotated[
        int | None,
        typer.Option(help="Grid cells across a line. (default: 3 for block, 5 for exact)", rich_help_panel=BLOCK),
    ] = None,
    steps: Annotated[
        int | None,
        typer.Option(help="Smoothing steps. (default: 10)", rich_help_panel=BLOCK),
    ] = None,
    fidelity: Annotated[
        float | None,
        typer.Option(help="How strongly the stamp holds, 0 to 1 or more. (default: 0.01)", rich_help_panel=BLOCK),
    ] = None,
    interface: Annotated[
        float | None,
        typer.Option(help="Cells from the surface to phi = 0.9. (default: 2)", rich_help_panel=BLOCK),
    ] = None,
    alpha: Annotated[
        float | None,
        typer.Option(help="Time step over the cell size squared, up to 0.25. (default: 1/7)", rich_help_panel=BLOCK),
    ] = None,
    allow_broken: Annotated[
        bool, typer.Option("--allow-broken", help="Write the mesh even if smoothing broke walls.", rich_help_panel=RUN)
    ] = False,
    max_memory: Annotated[
        str | None,
        typer.Option(help="Memory to use at most, such as 2G. (default: what is free)", rich_help_panel=RUN),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only show grid, memory, triangles and file size.", rich_help_panel=RUN)
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the report as one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Say nothing but errors.", rich_help_panel=RUN)] = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)] = False,
    own_options: dict[str, Any],
) -> None:
    """Make a block of infill: points, stamps on a grid, smoothing, a closed mesh."""
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import writer
    from infill.formats.whole_files import check_targets, deliver
    from infill.making.settings import resolve

    common = {
        "pattern": pattern, "size": size, "height": height, "line_width": line_width, "stamp": stamp, "cells": cells,
        "steps": steps, "fidelity": fidelity, "interface": interface, "alpha": alpha,
    }  # fmt: skip
    outputs = output or []
    if not (outputs or preview or save_config or dry_run or as_json):
        raise typer.BadParameter("nothing to write; give -o FILE, or --dry-run to see what it would be")
    settings = resolve({**common, **own_options}, config)
    limit = None if max_memory is None else parse_bytes(max_memory)
    for path in outputs:
        writer(path, ascii=ascii_stl)
    if preview is not None:
        from infill.pictures.preview import check_preview, write_preview

        check_preview(preview)
    check_targets(filter(None, (*outputs, preview, save_config)), overwrite=force)
    if dry_run:
        _show_plan(settings.plan(), limit, as_json=as_json)
        return
    result = None
    with progress_bar(shown=not quiet) as progress:
        if outputs or preview or as_json:
            result = settings.make(allow_broken=allow_broken, max_memory=limit, progress=progress)
        else:
            settings.plan()  # what is saved shall be right
        if progress is not None:
            progress("write", 0.8)
        parts: dict[Path, Callable[[BinaryIO], object]] = {}
        if result is not None:
            parts |= {path: partial(writer(path, ascii=ascii_stl), result.surface) for path in outputs}
            if preview is not None:
                parts[preview] = partial(write_preview, result)
        if save_config is not None:
            parts[save_config] = lambda file: file.write(settings.to_toml().encode())
        written = deliver(parts)
    files = [str(path) for path in written]
    if not quiet:
        say(f"wrote {', '.join(files)}" if result is None else _summary(result.report, files, verbose=verbose))
    if as_json and result is not None:
        print_json({**result.report, "files": files})


def _show_plan(block: Any, limit: int | None, *, as_json: bool) -> None:  # noqa: ANN401 - Block, not imported for --help
    block.require_grid_memory(limit)  # else the lines alone might fill it
    if limit is not None:
        block.require_memory(limit)
    facts = block.facts()
    if as_json:
        print_json(facts)
        return
    rows = {
        "grid": f"{' x '.join(map(str, facts['grid']))} cells of {facts['spacing']:.4g} mm",
        "memory": f"about {as_bytes(block.memory)}",
        "triangles": f"about {block.triangles:,}",
        "binary STL": f"about {as_bytes(block.stl_bytes)}",
    }
    typer.echo(table(rows, title=f"{block.pattern.name}: nothing is written (--dry-run)"))


def _summary(report: dict[str, Any], files: list[str], *, verbose: bool) -> str:
    """Return the short table on stderr."""
    request, grid, topology = report["request"], report["grid"], report["topology"]
    width, change = report["wall_width"], report["changes"]
    size = " x ".join(f"{length:g}" for length in (*request["size"], request["height"]))
    measured = (
        "not measured: no wall stands clear of others"
        if width["mean"] is None
        else f"{width['mean']:.3f} mm mean, {width['p5']:.3f} to {width['p95']:.3f} (5 to 95 %), "
        f"{width['requested']:g} asked for"
    )
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, "
        f"{report['components']} component(s), Euler number {report['mesh']['euler_number']}",
        "solid": f"{report['volume']:.1f} mm³, {report['density']:.1%} of the block",
        "walls": measured,
        "smoothing": f"{request['steps']} steps, fidelity {request['fidelity']:g}, "
        f"volume {report['volume_change']:+.2%} (rims apart)",
    }
    if change["pinholes"]:
        share = f"{change['pinhole_share']:.2%} of the void"
        rows["pinholes"] = f"{change['pinholes']} hole(s) or neck(s) narrower than a line closed, {share}"
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        rows["grid"] = f"{' x '.join(map(str, grid['shape'][:2]))} cells of {grid['spacing'][0]:.4g} mm"
        for name, counts in (("stamp", topology["data"]), ("result", topology["result"])):
            rows[name] = f"{counts['components']} component(s), {counts['tunnels']} holes"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = as_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return table(rows, title=f"{request['pattern']}, {size} mm")


def _pattern_options(patterns: Sequence[type[Pattern]]) -> dict[str, inspect.Parameter]:
    """Return one keyword per parameter of any pattern; patterns that share a name share the option."""
    found: dict[str, list[tuple[str, Any, Parameter]]] = {}
    for kind in patterns:
        for name, (field, described) in parameters(kind).items():
            found.setdefault(name, []).append((kind.name, field, described))
    return {name: _option(name, uses, everyone=len(uses) == len(patterns)) for name, uses in found.items()}


def _option(name: str, uses: list[tuple[str, Any, Parameter]], *, everyone: bool) -> inspect.Parameter:
    field = uses[0][1]
    texts: dict[str, list[str]] = {}
    for pattern, each_field, each in uses:
        texts.setdefault(f"{each.help} {_range(each, each_field.default)}", []).append(pattern)
    shared = everyone and len(texts) == 1
    text = " ".join(f"{what}." if shared else f"{', '.join(names)}: {what}." for what, names in texts.items())
    word = name.replace("_", "-")
    flag = f"--{word}/--no-{word}" if isinstance(field.default, bool) else f"--{word}"
    kinds: dict[type, Any] = {bool: bool, tuple: tuple}
    kind = kinds.get(type(field.default), int if uses[0][2].whole else float)
    if kind is tuple:
        kind = tuple.__class_getitem__((float,) * len(field.default))
    option = typer.Option(flag, help=text, rich_help_panel="Pattern", show_default=False)
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, option]
    )


def _range(described: Parameter, default: object) -> str:
    """Return range, unit and default for ``--help``."""
    degrees = described.unit == "rad"
    low, high = (math.degrees(end) if degrees else end for end in (described.low, described.high))
    unit = {"rad": "degrees", "mm": "mm", "": ""}[described.unit]
    parts = []
    if math.isfinite(low) and math.isfinite(high):
        parts.append(f"{low:g} to {high:g} {unit}".rstrip())
    if isinstance(default, bool):
        parts.append(f"default: {'on' if default else 'off'}")
    elif isinstance(default, tuple):
        parts.append(f"default: {' '.join(f'{each:g}' for each in default)}")
    elif default is not None:
        parts.append(f"default: {math.degrees(default) if degrees else default:g}")  # type: ignore[arg-type]
    return f"({'; '.join(parts)})"
