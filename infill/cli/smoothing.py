"""``infill smooth``: a scan, a mesh or points in, a smooth closed mesh out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, cast

import typer

from infill.cli.chunked import can_take_chunks, smooth_chunks, wants_chunks
from infill.cli.common import (
    FILES,
    RUN,
    AsciiStl,
    Config,
    Force,
    Json,
    MaxMemory,
    Quiet,
    SaveConfig,
    Threads,
    TrustFiles,
    Verbose,
)
from infill.cli.components import check_fields, component_summary, component_writer
from infill.cli.console import format_bytes, format_table, print_json, print_log, progress_bar, say
from infill.cli.declared import takes_options
from infill.cli.foreseeing import format_replaced, format_steps, show_smooth_plan
from infill.cli.labelled import SmoothOutput, refuse_options, smooth_every_label, wants_every_label
from infill.errors import MemoryLimitError
from infill.machine import available_memory
from infill.plain_numbers import choose_unit, count_noun, plain_argument, plain_number, plain_size
from infill.smoothing.settings import SmoothSettings, resolve

if TYPE_CHECKING:
    from infill.reports.smoothing import FacetKeys, SmoothReport
    from infill.smoothing.request import SmoothOptions


@takes_options(SmoothSettings)
def smooth(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT...",
            help="Mesh (.stl .3mf .obj .ply .off .glb .gltf), volume (.npy .npz .tif .nrrd .nii .mha .mgz .vtk .vti "
            ".zarr .h5:/PATH, a URL, a folder of DICOM or slices) or points (.xyz .csv .txt .npy .ply).",
        ),
    ],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Mesh to write, by suffix: .stl .3mf .obj .ply .glb; of labels together also .vtp and, as tetrahedra, "
            ".vtu; or the field: .npz .nrrd; of a volume in chunks .precomputed or .zarr; - for an STL on stdout, "
            "-.3mf for others. May be given again.",
            rich_help_panel=FILES,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture of before and after to write, what was lost in red, what was added in blue: a .png; or a "
            "page to turn the result in a browser: a .html.",
            rich_help_panel=FILES,
        ),
    ] = None,
    config: Config = None,
    trust: TrustFiles = False,
    save_config: SaveConfig = None,
    ascii_stl: AsciiStl = False,
    force: Force = False,
    *,
    typed: dict[str, Any],
    threads: Threads = None,
    max_memory: MaxMemory = None,
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run", help="Only show grid, method, memory and time, and possible remedies.", rich_help_panel=RUN
        ),
    ] = False,
    workers: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Smooth a volume in chunks, N at once, without having all of it in memory; or its labels. "
            "(default: for Zarr and HDF5 that do not fit into memory, one per core)",
            rich_help_panel=RUN,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Run the chunks on a cluster of Dask, such as tcp://host:8786; or on threads or processes of this "
            "machine. (default: threads)",
            rich_help_panel=RUN,
        ),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Keep the finished work on a volume in chunks in a folder, and go on from there; the folder is "
            "removed once the output stands.",
            rich_help_panel=RUN,
        ),
    ] = None,
    show_hash: Annotated[
        bool,
        typer.Option(
            "--hash",
            help="Print the hash of the set of triangles: the same for any chunks, workers and order. In chunks, of "
            "the triangles before they are simplified.",
            rich_help_panel=RUN,
        ),
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Smooth a scan, a mesh or points: no staircase, no shrinkage, a closed mesh."""
    from infill.cli.piping import with_suffix
    from infill.cli.words import parse_bytes

    if not (output or preview or as_json or save_config or dry_run or show_hash):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    settings = resolve(typed, config, trust=trust)
    settings.check()
    options: SmoothOptions = {
        **settings.options,
        "threads": threads,
        "max_memory": None if max_memory is None else parse_bytes(max_memory),
    }
    text = settings.to_toml().encode()
    outputs = SmoothOutput(
        outputs=[with_suffix(path) for path in output or []],
        preview=preview,
        saved={} if save_config is None else {save_config: lambda file: file.write(text)},
        ascii_stl=ascii_stl,
        force=force,
        dry_run=dry_run,
        as_json=as_json,
        quiet=quiet,
        verbose=verbose,
    )
    in_chunks = partial(smooth_chunks, source, settings, outputs, options, show_hash=show_hash)
    if not (output or preview or as_json or dry_run or show_hash):
        _save_config(outputs)
    elif wants_every_label(
        outputs.outputs,
        each_label=settings.each_label,
        labels=settings.labels,
        keep_going=settings.keep_going,
        together=settings.together,
    ):
        refuse_options(settings, outputs)
        if resume is not None or show_hash:
            option = "--hash" if show_hash else "--resume"
            raise typer.BadParameter(f"{option} is for one surface; leave it out, or choose one label by --label")
        smooth_every_label(source, settings, outputs, options, workers=workers, scheduler=scheduler)
    elif resume is not None or wants_chunks(source, settings, options, outputs, workers=workers, scheduler=scheduler):
        in_chunks(workers=workers, scheduler=scheduler, resume=resume)
    else:
        _check_formats(outputs, settings)
        outputs.check()
        try:
            _smooth_or_plan(source, settings, options, outputs, show_hash=show_hash)
        except MemoryLimitError:
            if not can_take_chunks(source, settings, options, outputs):
                raise
        else:
            return
        in_chunks(workers=None, scheduler=None, resume=None)


def _smooth_or_plan(
    source: Path, settings: SmoothSettings, options: SmoothOptions, output: SmoothOutput, *, show_hash: bool
) -> None:
    """Smooth a file or folder in memory, or print the plan of that."""
    if not output.dry_run:
        _smooth_source(source, settings, options, output, show_hash=show_hash)
        return
    if can_take_chunks(source, settings, options, output):  # the plan ends where the run would
        options = {**options, "max_memory": options.get("max_memory") or available_memory()}
    files = filter(None, (*output.outputs, output.preview, *output.saved))
    show_smooth_plan(source, settings, options, files, as_json=output.as_json, quiet=output.quiet)


def _save_config(output: SmoothOutput) -> None:
    """Write the config file alone."""
    from infill.cli.piping import deliver_all

    output.check()
    written = deliver_all(output.saved)
    if not output.quiet and written != ["-"]:
        say(f"wrote {', '.join(written)}")


def _check_formats(output: SmoothOutput, settings: SmoothSettings) -> None:
    """Raise an error for an output whose format is unknown, or cannot hold the result."""
    from infill.formats.mesh_files import mesh_writer
    from infill.imaging.volume_files import FIELD_WRITERS

    for path in output.outputs:
        if path.suffix.lower() not in FIELD_WRITERS:
            mesh_writer(path, ascii=output.ascii_stl, more=tuple(FIELD_WRITERS))
    if settings.by_component:
        check_fields(output.outputs)
    if output.preview is not None:
        from infill.pictures.picture_files import check_preview

        check_preview(output.preview, pages=True)


def _smooth_source(
    source: Path, settings: SmoothSettings, options: SmoothOptions, output: SmoothOutput, *, show_hash: bool
) -> None:
    """Smooth a file or folder, write the files and print a summary."""
    from infill.cli.piping import deliver_all
    from infill.formats.mesh_files import WRITERS, mesh_writer
    from infill.imaging.volume_files import field_writer
    from infill.kernels.second_compiler import compile_beside

    compile_beside("infill.smoothing.compile_ahead")
    with progress_bar(shown=not output.quiet) as progress:
        from infill.smoothing.sources import name_labels, read_source, smooth_source

        if progress is not None:
            progress("read", 0.0)
        with print_log(shown=not output.quiet), name_labels(source, **settings.reading):
            data = read_source(source, **settings.reading)
            smoothing_options = cast("SmoothOptions", {**options, "progress": progress})
            result: Any = smooth_source(data, **settings.choice, **smoothing_options)
        if progress is not None:
            progress("write", 0.9)
        parts: dict[Path, Callable[[BinaryIO], object]] = {}
        for path in output.outputs:
            if settings.by_component:
                parts[path] = component_writer(path, result, ascii_stl=output.ascii_stl)
            elif path.suffix.lower() in WRITERS:
                parts[path] = partial(mesh_writer(path, ascii=output.ascii_stl), result.surface)
            else:
                parts[path] = partial(field_writer(path), result.stages.field())
        if output.preview is not None:
            parts[output.preview] = result.preview_writer(output.preview, source.name)
        written = deliver_all(parts | dict(output.saved))
    if not output.quiet:
        if settings.by_component:
            say(component_summary(result, written, str(source)))
        else:
            say(_summary(result.report, written, str(source), verbose=output.verbose))
    number = {}
    if show_hash:
        from infill.chunks.hashing import hash_surface

        number = {"hash": hash_surface(result.whole.vertices, result.whole.faces)}
    if output.as_json:
        print_json({**result.report, **number, "files": written})
    elif show_hash:
        typer.echo(number["hash"])


def _summary(report: SmoothReport, files: list[str], name: str, *, verbose: bool) -> str:
    """Return the short table for stderr."""
    from infill.reports.sections import Sections

    request, grid, level = report["request"], report["grid"], report["solid"]["level"]
    result, data = report["topology"]["result"], report["topology"]["data"]
    size = plain_size(*report["extents"], digits=4)
    level_range = (
        f", {level['lowest']:.3f} to {level['highest']:.3f} for its components" if level["components"] > 1 else ""
    )
    voxels = "voxels of the mesh" if report["input"]["source"] == "mesh" else "data"
    steps = f"{format_steps(request)}{format_replaced(report['verdict']['instead_of'])}"
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, {size}",
        "solid": f"{plain_size(report['volume'], digits=6, power=3)}, {report['volume_change']:+z.4%} of the data",
        "smoothing": f"{steps}, {' x '.join(map(str, grid['shape']))} voxels of "
        f"{plain_size(*grid['spacing'], digits=4)}",
        "components": f"{result['components']:,} ({data['components']:,} in the {voxels}), "
        f"{count_noun(result['cavities'], 'cavity', 'cavities')} ({data['cavities']:,}), "
        f"{count_noun(result['tunnels'], 'tunnel')} ({data['tunnels']:,})",
    }
    if threshold := _threshold_text(report):
        rows["threshold"] = threshold
    if (isosurface := report.get("isosurface")) is not None and isosurface["change"] is not None:
        rows["solid"] += f", {isosurface['change']:+z.2%} of the isosurface of the grey values"
    if result["cavities"]:
        rows["sealed voids"] = f"{result['cavities']}, in which resin and powder stay"
    if verbose or not (isinstance(report, Sections) and report.pending("distance")):
        distance = report["distance"]
        distances = [distance[side][key] for side in ("result", "input") for key in ("p95", "max")]
        unit = choose_unit(*distances)
        near, far, back, far_back = (plain_size(value, unit=unit) for value in distances)
        rows["distance"] = f"{near} (95 %), {far} at most, from the {distance['from']}; back {back}, {far_back}"
    if simplified := report["mesh"].get("simplified"):
        shells = count_noun(simplified["shells"], "shell")
        rows["simplified"] = (
            f"from {simplified['triangles_before']:,} triangles, {plain_size(simplified['distance']['max'])} at "
            f"most, volume {simplified['volume_change']:+z.4%} by that, {shells}"
        )
    verdict = report["verdict"]
    rows["verdict"] = "; ".join(
        [verdict["word"].upper() if verdict["word"] == "lost" else verdict["word"], *verdict["changes"]]
    )
    if facets := report["facets"]:
        wall = report["walls"]["thinnest"]["data"]
        rows["facets"] = _facet_text(facets, max(grid["spacing"]), wall)
    if len(verdict["tried"]) > 1:
        rows["tried"] = f"{'; '.join(verdict['tried'])}: taken is {verdict['taken']}"
    if verbose:
        if not request["refine"]:
            rows["fidelity"] = f"{plain_number(request['fidelity'], 6)}"
        rows["level"] = f"{level['common']:.3f}{level_range}"
        thin = report["walls"]["thinnest"]
        thinnest = (thin["data"], thin["result"])
        rows["thinnest wall"] = " -> ".join("none" if x is None else plain_size(x) for x in thinnest)
        rows["Euler number"] = f"{data['euler_number']} -> {result['euler_number']}"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=name)


def _threshold_text(report: SmoothReport) -> str:
    """Return the threshold that Otsu's method found in a CT, and that of bone; empty for other input."""
    from infill.imaging.hounsfield import describe_bone

    rule = report["input"].get("segmentation")
    if rule is None or rule["method"] != "otsu":
        return ""
    bone, low = describe_bone(*rule["values"]), rule["low"]
    return f"{plain_argument(low)}, found by Otsu's method{bone}" if bone and low is not None else ""


def _facet_text(facets: FacetKeys, voxel: float, wall: float | None) -> str:
    """Describe the flat facets that are left, and the options that round them, if the thinnest wall bears these."""
    larger = f"--voxel {plain_argument(facets['voxel'], 2)} " if facets["voxel"] > voxel else ""
    radius = plain_argument(facets["radius"], 2)  # as it is typed
    unit = choose_unit(facets["width"], facets["radius"])
    advice = f"{larger}--smooth-radius {radius} rounds them, and details of their size"
    if not facets["fits"]:
        thickness = (
            "as thin as the walls here are" if wall is None else f"of {plain_size(wall, digits=2, unit=unit)}, as here"
        )
        round_radius = plain_size(facets["radius"], digits=2, unit=unit)
        advice = (
            f"they stay, because a smooth radius of {round_radius}, which would round them, loses walls {thickness}"
        )
    return (
        f"{facets['share']:.0%} of the surface still has the flat facets of the mesh, about "
        f"{plain_size(facets['width'], digits=2, unit=unit)} wide; {advice}"
    )
