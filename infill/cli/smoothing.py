"""``infill smooth``: a scan, a mesh or points in, a smooth closed mesh out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, Literal, cast

import typer

from infill.cli.completing import unit_names
from infill.cli.components import ByComponent, check_fields, component_summary, component_writer
from infill.cli.console import as_bytes, log_said, print_json, progress_bar, say, table
from infill.cli.labelled import EachLabel, Frame, KeepGoing, Labels, Roi, Written, refuse, smooth_each, wants_each
from infill.cli.labelled import Given as GivenLabels

if TYPE_CHECKING:
    from infill.result import Result
    from infill.smoothing.by_component import ComponentStages
    from infill.smoothing.stages import SmoothStages

GRID, SOLID, SURFACE, FILES, RUN, ADVANCED = "Grid", "What is solid", "Surface", "Files", "Run", "Advanced"


def smooth(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT",
            help="Mesh (.stl .3mf .obj .ply .off .glb), volume (.npy .npz .tif .nrrd .nii .mha .mgz .vtk .vti, a "
            "folder of DICOM or slices) or points (.xyz .csv .txt .npy .ply).",
        ),
    ],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Mesh to write, by suffix: .stl .3mf .obj .ply .glb; or the field: .npz .nrrd. May be given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture of before and after to write, what was lost in red, what was added in blue: a .png.",
            rich_help_panel=FILES,
        ),
    ] = None,
    ascii_stl: Annotated[bool, typer.Option("--ascii", help="Write STL as text.", rich_help_panel=FILES)] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)] = False,
    kind: Annotated[
        Literal["mesh", "points", "volume"] | None,
        typer.Option(
            "--as",
            metavar="mesh|points|volume",
            help="What INPUT is read as. (default: by the file)",
            rich_help_panel=FILES,
        ),
    ] = None,
    units: Annotated[
        Literal["um", "mm", "cm", "m", "in"] | None,
        typer.Option(
            metavar="um|mm|cm|m|in",
            help="Unit of a mesh or of points. (default: as in the file, or mm)",
            autocompletion=unit_names,
            rich_help_panel=FILES,
        ),
    ] = None,
    array: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Name of the array, if a .npz holds several.", rich_help_panel=FILES),
    ] = None,
    series: Annotated[
        str | None,
        typer.Option(metavar="UID", help="UID of the series, if a DICOM folder holds several.", rich_help_panel=FILES),
    ] = None,
    frame: Frame = None,
    each_label: EachLabel = False,
    labels: Labels = None,
    keep_going: KeepGoing = False,
    resolution: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Voxels along the longest side of a mesh or of points. (default: 200)",
            rich_help_panel=GRID,
        ),
    ] = None,
    voxel: Annotated[
        float | None,
        typer.Option(metavar="MM", help="Voxel size instead; of a scan: larger voxels.", rich_help_panel=GRID),
    ] = None,
    spacing: Annotated[
        str | None,
        typer.Option(
            metavar="MM,MM,MM",
            help="Voxel size of a volume: 0.9,0.9,1.5, or 1. (default: as in the file)",
            rich_help_panel=GRID,
        ),
    ] = None,
    roi: Roi = None,
    shell: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Points: a wall of this width along them, instead of the solid inside.",
            rich_help_panel=SOLID,
        ),
    ] = None,
    threshold: Annotated[
        float | None,
        typer.Option(metavar="VALUE", help="Solid is what has at least this value.", rich_help_panel=SOLID),
    ] = None,
    between: Annotated[
        str | None,
        typer.Option(
            "--range", metavar="LOW,HIGH", help="Solid is what lies between these values.", rich_help_panel=SOLID
        ),
    ] = None,
    label: Annotated[
        list[int] | None,
        typer.Option(metavar="N", help="Solid is what has this label. May be given again.", rich_help_panel=SOLID),
    ] = None,
    otsu: Annotated[
        bool, typer.Option("--otsu", help="Find the threshold from the values (Otsu's method).", rich_help_panel=SOLID)
    ] = False,
    grey: Annotated[
        bool, typer.Option("--grey", help="Keep the grey levels around the threshold.", rich_help_panel=SOLID)
    ] = False,
    by_component: ByComponent = False,
    despeckle: Annotated[
        float,
        typer.Option(
            metavar="MM3",
            show_default=False,
            help="First remove components up to this volume. (default: 0)",
            rich_help_panel=SOLID,
        ),
    ] = 0.0,
    steps: Annotated[
        int,
        typer.Option(
            metavar="N",
            show_default=False,
            help="Smoothing steps: more are smoother; 30 suit medical data. (default: 20)",
            rich_help_panel=SURFACE,
        ),
    ] = 20,
    method: Annotated[
        Literal["auto", "plain", "refine", "grey"],
        typer.Option(
            "--smooth",
            metavar="auto|plain|refine|grey",
            show_default=False,
            help="auto: by the data; plain: for noise; refine: keeps edges and thin walls; "
            "grey: keeps the grey levels of a scan, too. (default: auto)",
            rich_help_panel=SURFACE,
        ),
    ] = "auto",
    refine: Annotated[
        bool, typer.Option("--refine", help="The same as --smooth refine.", rich_help_panel=SURFACE)
    ] = False,
    smooth_radius: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Instead of steps: how far smoothing reaches, as the radius of a Gaussian blur.",
            rich_help_panel=SURFACE,
        ),
    ] = None,
    crumbs: Annotated[
        float | None,
        typer.Option(
            metavar="MM3",
            help="Remove pieces up to this volume that smoothing broke off. (default: 8 voxels)",
            rich_help_panel=SURFACE,
        ),
    ] = None,
    fidelity: Annotated[
        float | None,
        typer.Option(
            metavar="NUMBER",
            help="How strongly the data hold, 0 to 1 or more; not with --refine. (default: 0.01)",
            rich_help_panel=ADVANCED,
        ),
    ] = None,
    interface: Annotated[
        float,
        typer.Option(
            metavar="VOXELS",
            show_default=False,
            help="From the surface to phi = 0.9. (default: 2)",
            rich_help_panel=ADVANCED,
        ),
    ] = 2.0,
    level: Annotated[
        str,
        typer.Option(
            metavar="volume|NUMBER",
            show_default=False,
            help="Where the surface lies. volume: each part keeps its volume; 0: at phi = 0, as in the paper, "
            "which shrinks. (default: volume)",
            rich_help_panel=ADVANCED,
        ),
    ] = "volume",
    tolerance: Annotated[
        float | None,
        typer.Option(
            metavar="MM",
            help="Simplify the mesh: move it by at most this; 0 for all triangles. (default: 0.1 voxels)",
            rich_help_panel=SURFACE,
        ),
    ] = None,
    max_triangles: Annotated[
        int | None,
        typer.Option(metavar="N", help="Simplify the mesh to at most this many triangles.", rich_help_panel=SURFACE),
    ] = None,
    allow_broken: Annotated[
        bool,
        typer.Option("--allow-broken", help="Write the mesh even if something is lost.", rich_help_panel=RUN),
    ] = False,
    strict: Annotated[
        bool,
        typer.Option(
            "--strict", help="Try no remedies, and refuse whatever breaks, fuses or vanishes.", rich_help_panel=RUN
        ),
    ] = False,
    threads: Annotated[
        int | None, typer.Option(metavar="N", help="Threads to use. (default: one per core)", rich_help_panel=RUN)
    ] = None,
    max_memory: Annotated[
        str | None,
        typer.Option(
            metavar="SIZE", help="Memory to use at most, such as 2G. (default: what is free)", rich_help_panel=RUN
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the report as one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.", rich_help_panel=RUN)] = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)] = False,
) -> None:
    """Smooth a scan, a mesh or points: no staircase, no shrinkage, a closed mesh."""
    from infill.cli.words import parse_bytes, parse_level, parse_numbers
    from infill.formats.mesh_files import WRITERS, writer
    from infill.formats.volume_files import FIELD_WRITERS, field_writer
    from infill.formats.whole_files import check_targets, deliver

    outputs = output or []
    if refine and method not in ("auto", "refine"):
        raise typer.BadParameter(f"--refine is --smooth refine, and --smooth {method} is given; leave one of them out")
    if fidelity is not None:
        if refine or method in ("refine", "grey"):
            raise typer.BadParameter("--fidelity is not used with --refine; leave one of them out")
        method = "plain"  # the only way that has a fidelity
    if not (outputs or preview or as_json):
        raise typer.BadParameter("nothing to write; give -o FILE, or --json to see the report")
    spaced = None if spacing is None else parse_numbers("spacing", spacing, (1, 3))
    box = None if roi is None else parse_numbers("roi", roi, (6,))
    from infill.phasefield.allen_cahn import Smoothing
    from infill.smoothing.request import AUTO, Options

    options: Options = {
        "smoothing": Smoothing(
            steps=steps, interface=interface, **({} if fidelity is None else {"fidelity": fidelity})
        ),
        "method": "refine" if refine else method,
        "radius": smooth_radius,
        "crumbs": crumbs,
        "strict": strict,
        "level": parse_level(level),
        "despeckle": despeckle,
        "allow_broken": allow_broken,
        "tolerance": AUTO if tolerance is None else tolerance or None,
        "max_triangles": max_triangles,
        "threads": threads,
        "max_memory": None if max_memory is None else parse_bytes(max_memory),
    }
    if wants_each(outputs, each_label=each_label, labels=labels, keep_going=keep_going):
        refuse(
            preview=preview is not None,
            units=units is not None,
            resolution=resolution is not None,
            voxel=voxel is not None,
            shell=shell is not None,
            threshold=threshold is not None,
            range=between is not None,
            otsu=otsu,
            grey=grey or method == "grey",
            by_component=by_component,
        )
        smooth_each(
            GivenLabels(
                source=source,
                kind=kind,
                array=array,
                series=series,
                frame=frame,
                spacing=spaced,
                roi=box,
                labels=labels,
            ),
            Written(
                outputs=outputs, ascii_stl=ascii_stl, force=force, as_json=as_json, quiet=quiet, keep_going=keep_going
            ),
            label=tuple(label) if label else None,
            options=options,
        )
        return
    for path in outputs:
        if path.suffix.lower() not in FIELD_WRITERS:
            writer(path, ascii=ascii_stl, more=tuple(FIELD_WRITERS))
    if by_component:
        check_fields(outputs)
    if preview is not None:
        from infill.pictures.preview import check_preview

        check_preview(preview)
    check_targets(filter(None, (*outputs, preview)), overwrite=force)
    with progress_bar(shown=not quiet) as progress:
        from infill.smoothing.sources import read_source, smooth_source

        if progress is not None:
            progress("read", 0.0)
        with log_said(shown=not quiet):
            given = read_source(
                source,
                kind=kind,
                units=units,
                array=array,
                series=series,
                frame=frame,
                spacing=spaced,
                roi=box,
            )
        from infill.smoothing.placing import field_volume

        with log_said(shown=not quiet):
            result = smooth_source(
                given,
                resolution=resolution,
                voxel=voxel,
                shell=shell,
                threshold=threshold,
                between=None if between is None else parse_numbers("between", between, (2,)),
                label=tuple(label) if label else None,
                otsu=otsu,
                grey=grey,
                by_component=by_component,
                **cast(Options, {**options, "progress": progress}),
            )
        if progress is not None:
            progress("write", 0.9)
        parts: dict[Path, Callable[[BinaryIO], object]] = {}
        for path in outputs:
            if by_component:
                parts[path] = component_writer(path, cast("Result[ComponentStages]", result), ascii_stl=ascii_stl)
            elif path.suffix.lower() in WRITERS:
                parts[path] = partial(writer(path, ascii=ascii_stl), result.surface)
            else:
                parts[path] = partial(field_writer(path), field_volume(cast("Result[SmoothStages]", result)))
        if preview is not None:
            from infill.pictures.preview import write_preview

            parts[preview] = partial(write_preview, result)
        written = [str(path) for path in deliver(parts)]
    if not quiet:
        if by_component:
            say(component_summary(cast("Result[ComponentStages]", result), written, str(source)))
        else:
            say(_summary(cast("Result[SmoothStages]", result), written, str(source), verbose=verbose))
    if as_json:
        print_json({**result.report, "files": written})


def _summary(result: Result[SmoothStages], files: list[str], name: str, *, verbose: bool) -> str:
    """Return the short table for stderr."""
    from infill.sections import Sections

    report: dict[str, Any] = result.report
    request, grid, level = report["request"], report["grid"], report["solid"]["level"]
    now, was = report["topology"]["result"], report["topology"]["data"]
    size = " x ".join(f"{length:.4g}" for length in report["extents"])
    own = f", {level['lowest']:.3f} to {level['highest']:.3f} for its components" if level["components"] > 1 else ""
    how = ", refined" if request["refine"] else ""
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, {size} mm",
        "solid": f"{report['volume']:.6g} mm³, {report['volume_change']:+z.4%} of the data",
        "smoothing": f"{request['steps']} steps{how}, "
        f"{' x '.join(map(str, grid['shape']))} voxels of {' x '.join(f'{h:.4g}' for h in grid['spacing'])} mm",
        "components": f"{now['components']} ({was['components']} in the data), {now['cavities']} cavities "
        f"({was['cavities']}), {now['tunnels']} tunnels ({was['tunnels']})",
    }
    if verbose or not (isinstance(report, Sections) and report.pending("distance")):
        moved = report["distance"]
        rows["distance"] = (
            f"{moved['result']['p95']:.3g} mm (95 %), {moved['result']['max']:.3g} mm at most, "
            f"from the {moved['from']}; back {moved['input']['p95']:.3g} mm, {moved['input']['max']:.3g} mm"
        )
    if cost := report["mesh"].get("simplified"):
        rows["simplified"] = (
            f"from {cost['triangles_before']:,} triangles, {cost['distance']['max']:.3g} mm at most, "
            f"volume {cost['volume_change']:+z.4%} by that, {cost['shells']} shell(s)"
        )
    verdict = report["verdict"]
    rows["verdict"] = "; ".join(
        [verdict["word"].upper() if verdict["word"] == "lost" else verdict["word"], *verdict["changes"]]
    )
    if len(verdict["tried"]) > 1:
        rows["tried"] = f"{', '.join(verdict['tried'])}: taken is {verdict['taken']}"
    if verbose:
        if not request["refine"]:
            rows["fidelity"] = f"{request['fidelity']:g}"
        rows["level"] = f"{level['common']:.3f}{own}"
        thin = report["walls"]["thinnest"]
        rows["thinnest wall"] = " -> ".join("none" if x is None else f"{x:.3g} mm" for x in thin.values())
        rows["Euler number"] = f"{was['euler_number']} -> {now['euler_number']}"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = as_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return table(rows, title=name)
