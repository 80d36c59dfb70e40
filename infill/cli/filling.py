"""``infill fill``: a part in, the part with its infill as one solid out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, Literal

import typer

from infill.cli.completing import fill_assignments, fill_names, unit_names
from infill.cli.console import is_typed, print_json, print_log, progress_bar, say

if TYPE_CHECKING:
    from infill.lattices.settings import FillSettings
    from infill.pictures.sections import Cut
    from infill.report_keys import FillReport
    from infill.result import Result

FILES, PATTERN, SOLID, RUN = "Files", "Pattern", "Solid", "Run"


def fill(
    context: typer.Context,
    part: Annotated[
        Path,
        typer.Argument(metavar="PART", help="Mesh to fill (.stl .3mf .obj .ply .off .glb .gltf): closed, or nearly."),
    ],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="File to write, by suffix: .stl .3mf .obj .ply .glb, for a project .3mf; - for an STL on stdout, "
            "-.3mf for others. May be given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture to write, cut open where that shows most of the infill: a .png.",
            rich_help_panel=FILES,
        ),
    ] = None,
    cut: Annotated[
        list[str] | None,
        typer.Option(
            metavar="x|y|z=MM",
            help="Where --preview cuts the part open, such as z=10; may be given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="TOML file of options, or a project that this command wrote; what is typed here takes precedence.",
            rich_help_panel=FILES,
        ),
    ] = None,
    save_config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="TOML file to write all options to, for --config; - for stdout.", rich_help_panel=FILES
        ),
    ] = None,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Let the config file name code to run, and files outside of its folder.",
            rich_help_panel=FILES,
        ),
    ] = False,
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
            help="Any that 'infill list' shows: walls in space, such as gyroid; bars, such as octet, voronoi-foam or "
            "gyroid-network; upright walls, such as honeycomb. Or a drawing that is repeated (.svg .dxf .wkt .png .jpg "
            ".bmp), or module.py:name. (default: gyroid)",
            autocompletion=fill_names,
            rich_help_panel=PATTERN,
        ),
    ] = "gyroid",
    density: Annotated[
        str | None,
        typer.Option(
            metavar="SHARE",
            help="Solid share of the space inside the walls: 20%, or 0.2; two, such as 15%:40%, for one that changes. "
            "(default: 20%)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    by: Annotated[
        str | None,
        typer.Option(
            metavar="FIELD",
            help="What the density follows from its first value to its second: x, y, z, skin (from the walls inwards), "
            "a .csv of x, y, z, value, a .npy, a picture from above, or module.py:name. (default: z)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    grade: Annotated[
        Literal["width", "cell"] | None,
        typer.Option(
            metavar="width|cell",
            help="What changes between two densities: the width of walls; or the size of cells, for walls in space "
            "such as gyroid. (default: width)",
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
            help="Width of the walls inside, or diameter of bars. (default: 0.45, in a project 0.9, or for bars, by "
            "density and cell)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    align: Annotated[
        Literal["part", "bed", "body"],
        typer.Option(
            metavar="part|bed|body",
            show_default=False,
            help="Where the pattern begins: in the middle of the part, at x = y = 0 on its bottom, or in the middle of "
            "each body of several. (default: part)",
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
            help="Shifts the pattern in x, y and z. (default: 0 0 0; in a project, to where slicers print it)",
            rich_help_panel=PATTERN,
        ),
    ] = (0.0, 0.0, 0.0),
    seed: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Seed of the random patterns, voronoi and voronoi-foam. (default: 0)",
            rich_help_panel=PATTERN,
        ),
    ] = None,
    assigned: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="Any further parameter of a pattern; may be given again. 'infill list PATTERN' shows them.",
            autocompletion=fill_assignments,
            rich_help_panel=PATTERN,
        ),
    ] = None,
    wall: Annotated[
        float,
        typer.Option(
            metavar="MM",
            show_default=False,
            help="Thickness of the shell; in a project, what the slicer's perimeters take. (default: 1.2, in a project "
            "0.9)",
            rich_help_panel=SOLID,
        ),
    ] = 1.2,
    drain: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Diameter of a hole down from the lowest place of every void, for powder and resin; it keeps the wall "
            "from all sides. (default: none)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    vent: Annotated[
        bool,
        typer.Option(
            "--vent",
            help="With --drain, also a hole up from the highest place of every void, for air.",
            rich_help_panel=SOLID,
        ),
    ] = False,
    drain_at: Annotated[
        list[str] | None,
        typer.Option(
            metavar="X,Y,Z",
            help="With --drain, a place on the skin for a hole straight in, mm; may be given again.",
            rich_help_panel=SOLID,
        ),
    ] = None,
    open_: Annotated[
        Literal["top", "bottom", "both"] | None,
        typer.Option(
            "--open",
            metavar="top|bottom|both",
            help="Leave the shell out at the flat top or bottom of the part, or both: voids are open there. "
            "(default: closed)",
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
        Literal["solid", "infill", "project"],
        typer.Option(
            "--as",
            metavar="solid|infill|project",
            show_default=False,
            help="solid: shell and infill in one; infill: the infill alone; project: part and infill for a slicer. "
            "(default: solid, or project with --for)",
            rich_help_panel=SOLID,
        ),
    ] = "solid",
    slicer: Annotated[
        Literal["prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"] | None,
        typer.Option(
            "--for",
            metavar="prusaslicer|orcaslicer|bambustudio|cura|plain",
            help="Slicer that a project is for; plain: two objects without settings.",
            rich_help_panel=SOLID,
        ),
    ] = None,
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
        typer.Option(metavar="N", help="Most triangles of the mesh. (default: a million)", rich_help_panel=SOLID),
    ] = None,
    resolution: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Cells along the longest side of the part, in which voids are computed. (default: what pattern and "
            "wall need)",
            rich_help_panel=SOLID,
        ),
    ] = None,
    voxel: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Size of these cells instead.",
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
    """Fill a part: shell and infill as one solid with the part's own skin, or as a project for a slicer."""
    from infill.cli.filled_words import show_plan, summary
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes
    from infill.lattices.settings import resolve

    outputs = [with_suffix(path) for path in output or []]
    if not (outputs or preview or as_json or save_config or dry_run):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    flags = {
        "pattern": pattern,
        "density": density,
        "by": by,
        "grade": grade,
        "cell": cell,
        "line_width": line_width,
        "wall": wall,
        "as": kind,
        "for": slicer,
        "units": units,
        "align": align,
        "angle": angle,
        "phase": phase,
        "seed": seed,
        "drain": drain,
        "vent": vent,
        "drain_at": drain_at,
        "open": open_,
        "smooth_radius": smooth_radius,
        "overlap": overlap,
        "tolerance": tolerance,
        "max_triangles": max_triangles,
        "resolution": resolution,
        "voxel": voxel,
    }
    settings = resolve(
        {name: value for name, value in flags.items() if is_typed(context, name)},
        assigned or [],
        config,
        trust=trust,
    )
    writers = {path: _writer(path, settings, ascii_stl=ascii_stl) for path in outputs}
    if preview is not None:
        from infill.pictures.preview import check_preview

        check_preview(preview)
    cuts = _parse_cuts(cut or [], drawn=preview is not None and not dry_run)
    limit = None if max_memory is None else parse_bytes(max_memory)
    saved: dict[Path, Callable[[BinaryIO], object]] = {}
    if save_config is not None:
        text = settings.to_toml().encode()
        saved[save_config] = lambda file: file.write(text)
    check_outputs((*outputs, preview), text=save_config, overwrite=force, as_json=as_json, dry_run=dry_run)
    if not (outputs or preview or as_json or dry_run):
        written = deliver_all(saved)
        if not quiet and written != ["-"]:
            say(f"wrote {', '.join(written)}")
        return
    with progress_bar(shown=not quiet and not dry_run) as progress:
        from infill.lattices.job import fill_request
        from infill.lattices.planning import planned_fill
        from infill.smoothing.sources import read_source

        if progress is not None:
            progress("read", 0.0)
        with print_log(shown=not quiet):
            mesh: Any = read_source(part, kind="mesh", units=settings.units)
            if cuts:
                from infill.pictures.sections import check_cuts

                check_cuts(cuts, mesh.bounds)
            if dry_run:
                show_plan(planned_fill(mesh, settings.request, threads=threads), str(part), as_json=as_json)
                return
            result = fill_request(mesh, settings.request, threads=threads, max_memory=limit, progress=progress)
        if progress is not None:
            progress("write", 0.95)
        parts: dict[Path, Callable[[BinaryIO], object]] = {
            path: partial(write, result, part.stem) for path, write in writers.items()
        }
        if preview is not None:
            pictured = replace(result, stages=replace(result.stages, cuts=cuts))
            parts[preview] = pictured.write_picture
        files = deliver_all({**parts, **saved})
    if not quiet:
        say(summary(result.report, files, str(part), verbose=verbose))
    if as_json:
        print_json({**result.report, "files": files})


def _parse_cuts(texts: list[str], *, drawn: bool) -> tuple[Cut, ...]:
    """Parse the cuts of a preview, or raise UsageError."""
    if not texts:
        return ()
    from infill.pictures.sections import parse_cut

    cuts = tuple(parse_cut(text) for text in texts)
    if not drawn:
        raise typer.BadParameter("--cut says where a preview is cut open; give --preview FILE.png too, or leave it out")
    return cuts


def _writer(
    path: Path, settings: FillSettings, *, ascii_stl: bool
) -> Callable[[Result[Any, FillReport], str, BinaryIO], object]:
    """Return a function that writes a result with a title in the format of a file, or raise FormatError."""
    from infill.formats.mesh_files import mesh_writer

    write = mesh_writer(path, ascii=ascii_stl)
    if settings.slicer is None:
        return lambda result, title, file: write(result.surface, file)  # noqa: ARG005 - as projects are written
    from infill.projects.saving import check_suffix, make_project, writer_for

    slicer, units = settings.slicer, settings.units
    check_suffix(path)
    write_project = writer_for(slicer)
    return lambda result, title, file: write_project(
        make_project(result, slicer=slicer, title=title, units=units), file
    )
