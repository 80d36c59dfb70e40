"""``infill make``: a block of infill, from a pattern to a file."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Any, BinaryIO

import typer

from infill.cli.completing import pattern_assignments, pattern_names, stamp_names, surface_names
from infill.cli.console import as_bytes, print_json, progress_bar, reports_errors, say, table

SHOWN = 1e-3  # mm: a block that differs by less from what was asked for is that
BLOCK, FILES, PATTERN, RUN = "Block", "Files", "Pattern", "Run"


@reports_errors
def make(
    *,
    pattern: Annotated[
        str | None,
        typer.Argument(help="Name of the pattern: 'infill list' shows all.", autocompletion=pattern_names),
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
        typer.Option(help="TOML file of options; flags override it.", rich_help_panel=FILES),
    ] = None,
    save_config: Annotated[
        Path | None,
        typer.Option(help="TOML file to write all options to, as resolved.", rich_help_panel=FILES),
    ] = None,
    cell: Annotated[
        float | None,
        typer.Option(help="Distance between neighbouring lines, mm.", rich_help_panel=PATTERN),
    ] = None,
    angle: Annotated[
        float | None,
        typer.Option(help="Turns the pattern counter-clockwise, degrees.", rich_help_panel=PATTERN),
    ] = None,
    phase: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="X Y", help="Shifts the pattern in x and y, mm.", rich_help_panel=PATTERN),
    ] = None,
    frame: Annotated[
        bool | None,
        typer.Option("--frame/--no-frame", help="A wall around the block.", rich_help_panel=PATTERN),
    ] = None,
    assigned: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="Any parameter of the pattern; may be given again. 'infill list PATTERN' shows them all, with their "
            "ranges and defaults.",
            autocompletion=pattern_assignments,
            rich_help_panel=PATTERN,
        ),
    ] = None,
    waves: Annotated[float | None, typer.Option(hidden=True)] = None,
    hearts: Annotated[int | None, typer.Option(hidden=True)] = None,
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
            autocompletion=stamp_names,
            rich_help_panel=BLOCK,
        ),
    ] = None,
    cells: Annotated[
        int | None,
        typer.Option(help="Grid cells across a line. (default: 3 for block, 5 for exact)", rich_help_panel=BLOCK),
    ] = None,
    surface: Annotated[
        str | None,
        typer.Option(
            help="prism: vertical walls along the contour, between flat caps; grid: the paper's isosurface as it is. "
            "(default: prism; grid for a tolerance of 0)",
            autocompletion=surface_names,
            rich_help_panel=BLOCK,
        ),
    ] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            help="How far the contour may lie from the isosurface's, mm; its area stays. 0 keeps the raw isosurface. "
            "(default: 0.002)",
            rich_help_panel=BLOCK,
        ),
    ] = None,
    steps: Annotated[
        int | None,
        typer.Option(help="Smoothing steps. (default: 10)", rich_help_panel=BLOCK),
    ] = None,
    fidelity: Annotated[
        float | None,
        typer.Option(
            help="How strongly the stamp constrains the result, 0 to 1 or more. (default: 0.01)", rich_help_panel=BLOCK
        ),
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
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.", rich_help_panel=RUN)] = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)] = False,
) -> None:
    """Make a block of infill: points, stamps on a grid, smoothing, a closed mesh."""
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import writer
    from infill.formats.whole_files import check_targets, deliver
    from infill.making.settings import resolve

    flags = {
        "pattern": pattern,
        "size": size,
        "height": height,
        "line_width": line_width,
        "stamp": stamp,
        "cells": cells,
        "surface": surface,
        "tolerance": tolerance,
        "steps": steps,
        "fidelity": fidelity,
        "interface": interface,
        "alpha": alpha,
        "cell": cell,
        "angle": angle,
        "phase": phase,
        "frame": frame,
        "waves": waves,
        "hearts": hearts,
    }
    outputs = output or []
    if not (outputs or preview or save_config or dry_run or as_json):
        raise typer.BadParameter("nothing to write; give -o FILE, or --dry-run to see what it would be")
    settings = resolve(flags, config, assigned or [])
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
            settings.plan()  # what is saved must be valid
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
        say(
            f"wrote {', '.join(files)}"
            if result is None
            else _summary(result.report, files, settings.size, verbose=verbose)
        )
    if as_json and result is not None:
        print_json({**result.report, "files": files})


def _show_plan(block: Any, limit: int | None, *, as_json: bool) -> None:  # noqa: ANN401 - Block, not imported for --help
    block.require_grid_memory(limit)  # else the lines alone might fill the memory
    if limit is not None:
        block.require_memory(limit)
    facts = block.facts()
    if as_json:
        print_json(facts)
        return
    rows = {
        "grid": f"{' x '.join(map(str, block.grid.shape))} cells of {facts['grid']['spacing'][0]:.4g} mm",
        "memory": f"about {as_bytes(block.memory)}",
        "triangles": f"about {block.triangles:,}",
        "binary STL": f"about {as_bytes(block.stl_bytes)}",
    }
    typer.echo(table(rows, title=f"{block.pattern.name}: nothing is written (--dry-run)"))


def _summary(report: dict[str, Any], files: list[str], asked: tuple[float, float], *, verbose: bool) -> str:
    """Return the short table for stderr."""
    request, grid, topology = report["request"], report["grid"], report["topology"]
    width, change = report["wall_width"], report["changes"]
    size = " x ".join(f"{length:g}" for length in (*request["size"], request["height"]))
    measured = (
        "not measured: every wall is too close to another"
        if width["mean"] is None
        else f"{width['mean']:.3f} mm mean, {width['p5']:.3f} to {width['p95']:.3f} (5 to 95 %), "
        f"{width['requested']:g} asked for"
    )
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, "
        f"{report['components']} component(s), Euler number {report['mesh']['euler_number']}",
        "surface": f"{request['surface']}, within {request['tolerance']:g} mm of the isosurface at mid height"
        if request["tolerance"]
        else f"{request['surface']}, the isosurface as it is"
        if request["surface"] == "grid"
        else "prism, the whole contour of the isosurface",
        "solid": f"{report['volume']:.1f} mm³, {report['density']:.1%} of the block",
        "walls": measured,
        "smoothing": f"{request['steps']} steps, fidelity {request['fidelity']:g}, "
        f"volume {report['volume_change']:+.2%}{' (excluding rims)' if request['surface'] == 'grid' else ''}",
    }
    if (exact := report["walls"]["exact"]) is not None:
        rows["advice"] = f"--stamp exact makes the walls {exact:.3f} mm wide (measured in the middle of the block)"
    if any(abs(one - other) > SHOWN for one, other in zip(request["size"], asked, strict=True)):
        rows["size"] = f"whole cells of the grid; {' x '.join(f'{side:g}' for side in asked)} mm asked for"
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
