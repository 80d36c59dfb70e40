"""``infill make``: a block of infill, from a pattern to a file."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO

import typer

from infill.cli.common import AsciiStl, Config, Force, Json, MaxMemory, Quiet, SaveConfig, TrustCode, Verbose
from infill.cli.completing import block_pattern_names, pattern_assignments
from infill.cli.console import format_bytes, format_table, print_json, progress_bar, say
from infill.cli.declared import takes_options
from infill.making.settings import MakeSettings, resolve
from infill.plain_numbers import count_noun, plain_number, plain_size

if TYPE_CHECKING:
    from infill.making.request import Block
    from infill.reports.making import MakeReport

STDOUT = Path("-")
BLOCK, FILES, PATTERN, RUN, ADVANCED = "Block", "Files", "Pattern", "Run", "Advanced"


@takes_options(MakeSettings)
def make(
    *,
    pattern: Annotated[
        str | None,
        typer.Argument(
            metavar="PATTERN",
            help="Name ('infill list' shows all), drawing, or module.py:name.",
            autocompletion=block_pattern_names,
        ),
    ] = None,
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Mesh to write, by suffix: .stl .3mf .obj .ply .glb; - for an STL on stdout, -.3mf for others. May be "
            "given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture to write, from lines to mesh: a .png; or a page to turn it in a browser: a .html.",
            rich_help_panel=FILES,
        ),
    ] = None,
    ascii_stl: AsciiStl = False,
    force: Force = False,
    config: Config = None,
    trust: TrustCode = False,
    save_config: SaveConfig = None,
    cell: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Distance between neighbouring lines. (default: the pattern's own, mostly 6)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    angle: Annotated[
        float | None,
        typer.Option(metavar="DEG", help="Turns the pattern counter-clockwise. (default: 0)", rich_help_panel=PATTERN),
    ] = None,
    phase: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="MM MM", help="Shifts the pattern in x and y. (default: 0 0)", rich_help_panel=PATTERN),
    ] = None,
    frame: Annotated[
        bool | None,
        typer.Option(
            "--frame/--no-frame",
            help="A wall around the block. (default: the pattern's own)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    assigned: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="A parameter of the pattern; may be given again. 'infill list PATTERN' shows all.",
            autocompletion=pattern_assignments,
            rich_help_panel=PATTERN,
        ),
    ] = None,
    waves: Annotated[float | None, typer.Option(metavar="NUMBER", hidden=True)] = None,
    hearts: Annotated[int | None, typer.Option(metavar="N", hidden=True)] = None,
    typed: dict[str, Any],
    allow_broken: Annotated[
        bool, typer.Option("--allow-broken", help="Write the mesh even if smoothing broke walls.", rich_help_panel=RUN)
    ] = False,
    max_memory: MaxMemory = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only show grid, memory, triangles and file size.", rich_help_panel=RUN)
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Make a block of infill from any pattern: smooth walls, a closed mesh for a slicer."""
    from infill.cli.block_words import lattice_summary, show_lattice_plan
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import mesh_writer
    from infill.making.duration import duration_warning
    from infill.making.request import Block

    flags = {
        **typed,
        "pattern": pattern,
        "cell": cell,
        "angle": angle,
        "phase": phase,
        "frame": frame,
        "waves": waves,
        "hearts": hearts,
    }
    outputs = [with_suffix(path) for path in output or []]
    if not (outputs or preview or save_config or dry_run or as_json):
        raise typer.BadParameter("nothing to write; give -o FILE, or --dry-run to see what it would be")
    if save_config == STDOUT and (as_json or dry_run):
        raise typer.BadParameter("--save-config - has stdout for itself; leave --json and --dry-run out")
    settings = resolve(flags, config, assigned or [], trust=trust)
    limit = None if max_memory is None else parse_bytes(max_memory)
    for path in outputs:
        mesh_writer(path, ascii=ascii_stl)
    if preview is not None:
        from infill.pictures.picture_files import check_preview

        check_preview(preview, pages=True)
    check_outputs((*outputs, preview), text=save_config, overwrite=force, as_json=as_json, dry_run=dry_run)
    block = settings.plan()
    if not isinstance(block, Block):
        if dry_run:
            show_lattice_plan(block.facts(), as_json=as_json)
    elif dry_run:
        _show_plan(block, limit, as_json=as_json)
    else:
        block.require_grid_memory(limit)  # no warning of a long run for a block that does not fit
    if isinstance(block, Block) and not quiet and (slow := duration_warning(block)):
        say(f"warning: {slow}")
    if dry_run:
        return
    result = None
    with progress_bar(shown=not quiet) as progress:
        if outputs or preview or as_json:
            result = settings.make(allow_broken=allow_broken, max_memory=limit, progress=progress)
        if progress is not None:
            progress("write", 0.8)
        parts: dict[Path, Callable[[BinaryIO], object]] = {}
        if result is not None:
            parts |= {path: partial(mesh_writer(path, ascii=ascii_stl), result.surface) for path in outputs}
            if preview is not None:
                parts[preview] = result.preview_writer(preview)
        if save_config is not None:
            parts[save_config] = lambda file: file.write(settings.to_toml().encode())
        files = deliver_all(parts)
    if not quiet and result is not None:
        summary = _summary if isinstance(block, Block) else lattice_summary
        say(summary(result.report, files, verbose=verbose))
    elif not quiet and files != [str(STDOUT)]:
        say(f"wrote {', '.join(files)}")
    if as_json and result is not None:
        print_json({**result.report, "files": files})


def _show_plan(block: Block, limit: int | None, *, as_json: bool) -> None:
    """Print the size of a block, its memory and its triangles, after checking the memory limit."""
    block.require_grid_memory(limit)  # else the lines alone might fill the memory
    if limit is not None:
        block.require_memory(limit)
    facts = block.facts()
    if as_json:
        print_json(facts)
        return
    rows = {
        "grid": f"{' x '.join(map(str, block.grid.shape))} cells of "
        f"{plain_size(facts['grid']['spacing'][0], digits=4)}",
        "memory": f"about {format_bytes(block.memory)}",
        "triangles": f"about {block.triangles:,}",
        "binary STL": f"about {format_bytes(block.stl_bytes)}",
    }
    typer.echo(format_table(rows, title=f"{block.pattern.name}: nothing is written (--dry-run)"))


def _summary(report: MakeReport, files: list[str], *, verbose: bool) -> str:
    """Return the short table for stderr."""
    request, grid, topology = report["request"], report["grid"], report["topology"]
    width, change = report["wall_width"], report["changes"]
    size = plain_size(*request["size"], request["height"], digits=6)
    measured = (
        "not measured: every wall is too close to another"
        if width["mean"] is None
        else f"{width['mean']:.3f} mm mean, {width['p5']:.3f} to {width['p95']:.3f} (5 to 95 %), "
        f"{plain_number(width['requested'], 6)} asked for"
    )
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, "
        f"{count_noun(report['components'], 'component')}",
        "surface": f"{request['surface']}, within {plain_size(request['tolerance'], digits=6)} of the isosurface at "
        "mid height"
        if request["tolerance"]
        else f"{request['surface']}, the isosurface as it is"
        if request["surface"] == "grid"
        else "prism, the whole contour of the isosurface",
        "solid": f"{report['volume']:.1f} mm³, {report['density']:.1%} of the block",
        "walls": measured,
        "smoothing": f"{request['steps']} steps, "
        f"volume {report['volume_change']:+z.2%}{' (excluding rims)' if request['surface'] == 'grid' else ''}",
    }
    if (exact := report["walls"]["exact"]) is not None:
        rows["advice"] = f"--stamp exact makes the walls {exact:.3f} mm wide (measured in the middle of the block)"
    if report["components"] > 1:
        from infill.cli.block_words import describe_loose

        rows["loose"] = describe_loose(report["components"], "component")
    if change["pinholes"]:
        share = f"{change['pinhole_share']:.2%} of the void"
        rows["closed up"] = f"{count_noun(change['pinholes'], 'gap')} narrower than a line, {share}"
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        rows["fidelity"] = f"{plain_number(request['fidelity'], 6)}"
        rows["Euler number"] = f"{report['mesh']['euler_number']}"
        rows["grid"] = f"{' x '.join(map(str, grid['shape'][:2]))} cells of {plain_size(grid['spacing'][0], digits=4)}"
        for name, counts in (("stamp", topology["data"]), ("result", topology["result"])):
            rows[name] = f"{count_noun(counts['components'], 'component')}, {count_noun(counts['tunnels'], 'hole')}"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=f"{request['pattern']}, {size}")
