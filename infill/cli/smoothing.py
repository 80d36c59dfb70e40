"""``infill smooth``: a scan, a mesh or points in, a smooth closed mesh out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, Literal, cast

import typer

from infill.cli.completing import unit_names
from infill.cli.components import ByComponent, check_fields, component_summary, component_writer
from infill.cli.console import format_bytes, format_table, is_typed, print_json, print_log, progress_bar, say
from infill.cli.foreseeing import show_smooth_plan
from infill.cli.labelled import (
    EachLabel,
    Frame,
    KeepGoing,
    LabelOutput,
    Labels,
    Roi,
    refuse_options,
    smooth_every_label,
    wants_every_label,
)
from infill.cli.labelled import LabelInput as GivenLabels

if TYPE_CHECKING:
    from infill.report_keys import SmoothReport
    from infill.smoothing.request import SmoothOptions

GRID, SOLID, SURFACE, FILES, RUN, ADVANCED = "Grid", "What is solid", "Surface", "Files", "Run", "Advanced"


def smooth(
    context: typer.Context,
    source: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT",
            help="Mesh (.stl .3mf .obj .ply .off .glb .gltf), volume (.npy .npz .tif .nrrd .nii .mha .mgz .vtk .vti, a "
            "folder of DICOM or slices) or points (.xyz .csv .txt .npy .ply).",
        ),
    ],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Mesh to write, by suffix: .stl .3mf .obj .ply .glb; or the field: .npz .nrrd; - for an STL on "
            "stdout, -.3mf for others. May be given again.",
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
    config: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="TOML file of options; flags override it.", rich_help_panel=FILES),
    ] = None,
    trust: Annotated[
        bool,
        typer.Option("--trust", help="Let the config file name files outside of its folder.", rich_help_panel=FILES),
    ] = False,
    save_config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="TOML file to write all options to, for --config; - for stdout.", rich_help_panel=FILES
        ),
    ] = None,
    ascii_stl: Annotated[bool, typer.Option("--ascii", help="Write STL as text.", rich_help_panel=FILES)] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)] = False,
    kind: Annotated[
        Literal["mesh", "points", "volume"] | None,
        typer.Option(
            "--as",
            metavar="mesh|points|volume",
            help="How to read INPUT. (default: by the file)",
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
        typer.Option(metavar="VALUE", help="Values from this one upwards are solid.", rich_help_panel=SOLID),
    ] = None,
    between: Annotated[
        str | None,
        typer.Option("--range", metavar="LOW,HIGH", help="Values between these two are solid.", rich_help_panel=SOLID),
    ] = None,
    label: Annotated[
        list[int] | None,
        typer.Option(metavar="N", help="Cells with this label are solid. May be given again.", rich_help_panel=SOLID),
    ] = None,
    otsu: Annotated[
        bool,
        typer.Option(
            "--otsu/--no-otsu",
            show_default=False,
            help="Find the threshold from the values (Otsu's method).",
            rich_help_panel=SOLID,
        ),
    ] = False,
    grey: Annotated[
        bool,
        typer.Option(
            "--grey/--no-grey",
            show_default=False,
            help="Keep the grey levels around the threshold.",
            rich_help_panel=SOLID,
        ),
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
        bool,
        typer.Option(
            "--refine/--no-refine", show_default=False, help="The same as --smooth refine.", rich_help_panel=SURFACE
        ),
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
            help="Distance from the surface to phi = 0.9. (default: 2)",
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
        typer.Option(
            "--allow-broken/--no-allow-broken",
            show_default=False,
            help="Write the mesh even if something is lost.",
            rich_help_panel=RUN,
        ),
    ] = False,
    strict: Annotated[
        bool,
        typer.Option(
            "--strict/--no-strict",
            show_default=False,
            help="Try no remedies, and refuse whatever breaks, fuses or vanishes.",
            rich_help_panel=RUN,
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
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run", help="Only show grid, method, memory and time, and possible remedies.", rich_help_panel=RUN
        ),
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the report as one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.", rich_help_panel=RUN)] = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)] = False,
) -> None:
    """Smooth a scan, a mesh or points: no staircase, no shrinkage, a closed mesh."""
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import WRITERS, mesh_writer
    from infill.imaging.volume_files import FIELD_WRITERS, field_writer
    from infill.smoothing.settings import resolve

    outputs = [with_suffix(path) for path in output or []]
    if refine and method not in ("auto", "refine"):
        raise typer.BadParameter(f"--refine is --smooth refine, and --smooth {method} is given; leave one of them out")
    if fidelity is not None and (refine or method in ("refine", "grey")):
        raise typer.BadParameter("--fidelity is not used with --refine; leave one of them out")
    if not (outputs or preview or as_json or save_config or dry_run):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    flags = {
        "as": kind,
        "units": units,
        "array": array,
        "series": series,
        "frame": frame,
        "spacing": spacing,
        "roi": roi,
        "resolution": resolution,
        "voxel": voxel,
        "shell": shell,
        "threshold": threshold,
        "range": between,
        "label": label,
        "otsu": otsu,
        "grey": grey,
        "by_component": by_component,
        "each_label": each_label,
        "labels": labels,
        "keep_going": keep_going,
        "despeckle": despeckle,
        "steps": steps,
        "smooth": method,
        "refine": refine,
        "smooth_radius": smooth_radius,
        "crumbs": crumbs,
        "fidelity": fidelity,
        "interface": interface,
        "level": level,
        "tolerance": tolerance,
        "max_triangles": max_triangles,
        "allow_broken": allow_broken,
        "strict": strict,
    }
    settings = resolve({name: value for name, value in flags.items() if is_typed(context, name)}, config, trust=trust)
    settings.check()
    options: SmoothOptions = {
        **settings.options,
        "threads": threads,
        "max_memory": None if max_memory is None else parse_bytes(max_memory),
    }
    saved: dict[Path, Callable[[BinaryIO], object]] = {}
    if save_config is not None:
        text = settings.to_toml().encode()
        saved[save_config] = lambda file: file.write(text)
    if not (outputs or preview or as_json or dry_run):
        check_outputs((), text=save_config, overwrite=force, as_json=as_json)
        written = deliver_all(saved)
        if not quiet and written != ["-"]:
            say(f"wrote {', '.join(written)}")
        return
    if wants_every_label(
        outputs, each_label=settings.each_label, labels=settings.labels, keep_going=settings.keep_going
    ):
        refuse_options(
            preview=preview is not None,
            units=settings.units is not None,
            resolution=settings.resolution is not None,
            voxel=settings.voxel is not None,
            shell=settings.shell is not None,
            threshold=settings.threshold is not None,
            range=settings.between is not None,
            otsu=settings.otsu,
            grey=settings.grey or settings.method == "grey",
            by_component=settings.by_component,
            dry_run=dry_run,
        )
        smooth_every_label(
            GivenLabels(
                source=source,
                kind=settings.kind,
                array=settings.array,
                series=settings.series,
                frame=settings.frame,
                spacing=settings.spacing,
                roi=settings.roi,
                labels=settings.labels,
            ),
            LabelOutput(
                outputs=outputs,
                ascii_stl=ascii_stl,
                force=force,
                as_json=as_json,
                quiet=quiet,
                keep_going=settings.keep_going,
                saved=saved,
            ),
            label=settings.label,
            options=options,
        )
        return
    for path in outputs:
        if path.suffix.lower() not in FIELD_WRITERS:
            mesh_writer(path, ascii=ascii_stl, more=tuple(FIELD_WRITERS))
    if settings.by_component:
        check_fields(outputs)
    if preview is not None:
        from infill.pictures.preview import check_preview

        check_preview(preview)
    check_outputs((*outputs, preview), text=save_config, overwrite=force, as_json=as_json, dry_run=dry_run)
    if dry_run:
        files = filter(None, (*outputs, preview, save_config))
        show_smooth_plan(source, settings, options, files, as_json=as_json, quiet=quiet)
        return
    with progress_bar(shown=not quiet) as progress:
        from infill.smoothing.sources import read_source, smooth_source

        if progress is not None:
            progress("read", 0.0)
        with print_log(shown=not quiet):
            data = read_source(source, **settings.reading)
            smoothing_options = cast("SmoothOptions", {**options, "progress": progress})
            result: Any = smooth_source(data, **settings.choice, **smoothing_options)
        if progress is not None:
            progress("write", 0.9)
        parts: dict[Path, Callable[[BinaryIO], object]] = {}
        for path in outputs:
            if settings.by_component:
                parts[path] = component_writer(path, result, ascii_stl=ascii_stl)
            elif path.suffix.lower() in WRITERS:
                parts[path] = partial(mesh_writer(path, ascii=ascii_stl), result.surface)
            else:
                parts[path] = partial(field_writer(path), result.stages.field())
        if preview is not None:
            parts[preview] = result.write_picture
        written = deliver_all(parts | saved)
    if not quiet:
        if settings.by_component:
            say(component_summary(result, written, str(source)))
        else:
            say(_summary(result.report, written, str(source), verbose=verbose))
    if as_json:
        print_json({**result.report, "files": written})


def _summary(report: SmoothReport, files: list[str], name: str, *, verbose: bool) -> str:
    """Return the short table for stderr."""
    from infill.sections import Sections

    request, grid, level = report["request"], report["grid"], report["solid"]["level"]
    result, data = report["topology"]["result"], report["topology"]["data"]
    size = " x ".join(f"{length:.4g}" for length in report["extents"])
    level_range = (
        f", {level['lowest']:.3f} to {level['highest']:.3f} for its components" if level["components"] > 1 else ""
    )
    refined_text = ", refined" if request["refine"] else ""
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, {size} mm",
        "solid": f"{report['volume']:.6g} mm³, {report['volume_change']:+z.4%} of the data",
        "smoothing": f"{request['steps']} steps{refined_text}, "
        f"{' x '.join(map(str, grid['shape']))} voxels of {' x '.join(f'{h:.4g}' for h in grid['spacing'])} mm",
        "components": f"{result['components']} ({data['components']} in the data), {result['cavities']} cavities "
        f"({data['cavities']}), {result['tunnels']} tunnels ({data['tunnels']})",
    }
    if result["cavities"]:
        rows["sealed voids"] = f"{result['cavities']}, in which resin and powder stay"
    if verbose or not (isinstance(report, Sections) and report.pending("distance")):
        distance = report["distance"]
        rows["distance"] = (
            f"{distance['result']['p95']:.3g} mm (95 %), {distance['result']['max']:.3g} mm at most, "
            f"from the {distance['from']}; back {distance['input']['p95']:.3g} mm, {distance['input']['max']:.3g} mm"
        )
    if simplified := report["mesh"].get("simplified"):
        rows["simplified"] = (
            f"from {simplified['triangles_before']:,} triangles, {simplified['distance']['max']:.3g} mm at most, "
            f"volume {simplified['volume_change']:+z.4%} by that, {simplified['shells']} shell(s)"
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
        rows["level"] = f"{level['common']:.3f}{level_range}"
        thin = report["walls"]["thinnest"]
        rows["thinnest wall"] = " -> ".join("none" if x is None else f"{x:.3g} mm" for x in thin.values())
        rows["Euler number"] = f"{data['euler_number']} -> {result['euler_number']}"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=name)
