"""``infill fill``: a part in, the part with its infill as one solid out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, Literal

import typer

from infill.cli.completing import fill_assignments, fill_names, unit_names
from infill.cli.console import as_bytes, log_said, print_json, progress_bar, say, table

if TYPE_CHECKING:
    from infill.report_keys import FillReport

FILES, PATTERN, SOLID, RUN = "Files", "Pattern", "Solid", "Run"
DONE = {
    "turned": "faces turned outwards",
    "closed": "holes closed",
    "parted": "components that touch taken apart",
    "united": "components that overlap united",
}


def fill(
    part: Annotated[
        Path, typer.Argument(metavar="PART", help="Mesh to fill (.stl .3mf .obj .ply .off .glb): closed, or nearly.")
    ],
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
            metavar="FILE", help="Picture to write, cut open through the middle: a .png.", rich_help_panel=FILES
        ),
    ] = None,
    ascii_stl: Annotated[bool, typer.Option("--ascii", help="Write STL as text.", rich_help_panel=FILES)] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)] = False,
    units: Annotated[
        Literal["um", "mm", "cm", "m", "in"] | None,
        typer.Option(
            metavar="um|mm|cm|m|in",
            help="Unit of the mesh. (default: as in the file, or mm)",
            autocompletion=unit_names,
            rich_help_panel=FILES,
        ),
    ] = None,
    pattern: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            show_default=False,
            help="In space: gyroid, schwarz-p, schwarz-d, fischer-koch-s, lidinoid, neovius, i-wp; bars: cubic-bars, "
            "octet, bcc, fcc, diamond, kelvin; upright walls: whatever 'infill list' shows. (default: gyroid)",
            autocompletion=fill_names,
            rich_help_panel=PATTERN,
        ),
    ] = "gyroid",
    density: Annotated[
        str | None,
        typer.Option(
            metavar="SHARE",
            help="Solid share of what lies inside the walls: 20%, or 0.2. (default: 20%)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    cell: Annotated[
        float | None,
        typer.Option(
            metavar="MM", help="Period of the pattern. (default: by density and line width)", rich_help_panel=PATTERN
        ),
    ] = None,
    line_width: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Width of the walls inside, or diameter of bars. (default: 0.45, or for bars, by density and cell)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    align: Annotated[
        Literal["part", "bed"],
        typer.Option(
            metavar="part|bed",
            show_default=False,
            help="Where the pattern begins: in the middle of the part, or at x = y = 0 on its bottom. (default: part)",
            rich_help_panel=PATTERN,
        ),
    ] = "part",
    angle: Annotated[
        float,
        typer.Option(
            metavar="DEG",
            show_default=False,
            help="Turns the pattern counter-clockwise about z. (default: 0)",
            rich_help_panel=PATTERN,
        ),
    ] = 0.0,
    phase: Annotated[
        tuple[float, float, float],
        typer.Option(
            metavar="MM MM MM",
            show_default=False,
            help="Shifts the pattern in x, y and z. (default: 0 0 0)",
            rich_help_panel=PATTERN,
        ),
    ] = (0.0, 0.0, 0.0),
    assigned: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="Any further parameter of a pattern of upright walls; may be given again. 'infill list PATTERN' shows "
            "them.",
            autocompletion=fill_assignments,
            rich_help_panel=PATTERN,
        ),
    ] = None,
    wall: Annotated[
        float,
        typer.Option(
            metavar="MM", show_default=False, help="Thickness of the shell. (default: 1.2)", rich_help_panel=SOLID
        ),
    ] = 1.2,
    drain: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Diameter of a hole down from the lowest place of every void, for powder and resin. (default: none)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    smooth_radius: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Radius of the fillets where walls meet at right angles; 0 for none. (default: 0.25, less in small "
            "parts)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    kind: Annotated[
        Literal["solid", "infill"],
        typer.Option(
            "--as",
            metavar="solid|infill",
            show_default=False,
            help="solid: shell and infill in one; infill: the infill alone. (default: solid)",
            rich_help_panel=SOLID,
        ),
    ] = "solid",
    overlap: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="How far the infill alone reaches into the shell. (default: 0.15)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    tolerance: Annotated[
        float,
        typer.Option(
            metavar="MM",
            show_default=False,
            help="Simplify the voids: move their surface by at most this; 0 for all triangles. (default: 0.03)",
            rich_help_panel=SOLID,
        ),
    ] = 0.03,
    max_triangles: Annotated[
        int | None,
        typer.Option(metavar="N", help="Triangles of the mesh at most. (default: a million)", rich_help_panel=SOLID),
    ] = None,
    voxel: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Size of the cells in which voids are computed. (default: what pattern and wall need)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    threads: Annotated[
        int | None, typer.Option(metavar="N", help="Threads to use. (default: one per core)", rich_help_panel=RUN)
    ] = None,
    max_memory: Annotated[
        str | None,
        typer.Option(
            metavar="SIZE", help="Memory to use at most, such as 2G. (default: what is free)", rich_help_panel=RUN
        ),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only show cell, line width, grid and memory.", rich_help_panel=RUN)
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the report as one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.", rich_help_panel=RUN)] = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)] = False,
) -> None:
    """Fill a part: a shell and infill as one solid, the skin as it was, in a closed mesh."""
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import writer
    from infill.formats.options import parse_share

    outputs = [with_suffix(path) for path in output or []]
    if not (outputs or preview or as_json or dry_run):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    for path in outputs:
        writer(path, ascii=ascii_stl)
    if preview is not None:
        from infill.pictures.preview import check_preview

        check_preview(preview)
    check_outputs((*outputs, preview), text=None, overwrite=force, as_json=as_json, dry_run=dry_run)
    limit = None if max_memory is None else parse_bytes(max_memory)
    with progress_bar(shown=not quiet and not dry_run) as progress:
        from infill.filling.solids.filled import filled
        from infill.filling.solids.planning import planned_fill
        from infill.filling.solids.request import checked
        from infill.smoothing.sources import read_source

        request = checked(
            pattern=pattern,
            own=_own(pattern, assigned or []),
            density=None if density is None else parse_share("density", density),
            cell=cell,
            line_width=line_width,
            wall=wall,
            form=kind,
            align=align,
            angle=angle,
            phase=phase,
            drain=drain,
            smooth_radius=smooth_radius,
            overlap=overlap,
            tolerance=tolerance,
            max_triangles=max_triangles,
            voxel=voxel,
        )
        if progress is not None:
            progress("read", 0.0)
        with log_said(shown=not quiet):
            given: Any = read_source(part, kind="mesh", units=units)
            if dry_run:
                _show_plan(planned_fill(given, request, threads=threads), str(part), as_json=as_json)
                return
            result = filled(given, request, threads=threads, max_memory=limit, progress=progress)
        if progress is not None:
            progress("write", 0.95)
        parts: dict[Path, Callable[[BinaryIO], object]] = {
            path: partial(writer(path, ascii=ascii_stl), result.surface) for path in outputs
        }
        if preview is not None:
            parts[preview] = result.write_picture
        files = deliver_all(parts)
    if not quiet:
        say(_summary(result.report, files, str(part), verbose=verbose))
    if as_json:
        print_json({**result.report, "files": files})


def _drained(report: FillReport) -> str:
    closed, drains = len(report["voids"]["closed"]), report["drains"]["count"]
    if not drains:
        return "closed: nothing drains from them"
    left = f"; {closed:,} still closed" if closed else ""
    return f"{drains:,} drain(s) of {report['request']['drain']:g} mm{left}"


def _own(pattern: str, assigned: list[str]) -> dict[str, Any]:
    """Return the pattern's own parameters by name."""
    if not assigned:
        return {}
    from infill.filling.solids.request import own_parameters

    return own_parameters(pattern, assigned)


def _show_plan(plan: dict[str, Any], name: str, *, as_json: bool) -> None:
    if as_json:
        print_json(plan)
        return
    grid, infill = plan["grid"], plan["infill"]
    rows = {
        "infill": f"cell about {infill['cell']:.4g} mm, line width about {infill['line_width']:.4g} mm",
        "grid": f"{' x '.join(map(str, grid['shape']))} cells of {grid['spacing'][0]:.4g} mm",
        "memory": f"about {as_bytes(plan['memory'])}",
    }
    typer.echo(table(rows, title=f"{name}, {plan['request']['pattern']}: nothing is written (--dry-run)"))


def _summary(report: FillReport, files: list[str], name: str, *, verbose: bool) -> str:
    """Return the short table for stderr."""
    request, mesh, voids, walls, infill = (
        report["request"],
        report["mesh"],
        report["voids"],
        report["walls"],
        report["infill"],
    )
    skin = "as it was" if mesh["skin"] == "as given" else DONE[mesh["skin"]]
    if report["drains"]["count"]:
        skin += ", but for the drains"
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}; skin {skin}",
        "solid": f"{report['volume']:.6g} mm³, {report['volume'] / report['part']['volume']:.1%} of the part",
        "density": f"{report['density']:.1%} inside the walls: cells of {infill['cell']:.4g} mm, lines of "
        f"{infill['line_width']:.3g} mm",
        "walls": f"{walls['least']:.3g} mm at least, {walls['requested']:g} asked for",
        "voids": f"{voids['count']:,}, {_drained(report)}",
    }
    if request["form"] == "infill":
        rows["mesh"] = f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}"
        rows["solid"] = f"{report['volume']:.6g} mm³ of infill"
        del rows["walls"], rows["voids"]
    if voids["islands"]:
        rows["left out"] = f"{voids['islands']:,} piece(s) of infill that would have hung free"
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        grid = report["grid"]
        rows["grid"] = f"{' x '.join(map(str, grid['shape']))} cells of {grid['spacing'][0]:.4g} mm"
        rows["fillets"] = f"{infill['radius']:.3g} mm"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = as_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return table(rows, title=f"{name}, {request['pattern']}")
