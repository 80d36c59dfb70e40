"""``infill smooth``: a scan, a mesh or points in, a smooth closed mesh out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO, cast

import typer

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
from infill.cli.foreseeing import show_smooth_plan
from infill.cli.labelled import LabelOutput, refuse_options, smooth_every_label, wants_every_label
from infill.smoothing.settings import SmoothSettings, resolve

if TYPE_CHECKING:
    from infill.report_keys import SmoothReport
    from infill.smoothing.request import SmoothOptions


@takes_options(SmoothSettings)
def smooth(
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
            "--dry-run", help="Only show grid, method, memory and time, and what would be tried.", rich_help_panel=RUN
        ),
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Smooth a scan, a mesh or points: no staircase, no shrinkage, a closed mesh."""
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes
    from infill.formats.mesh_files import WRITERS, mesh_writer
    from infill.imaging.volume_files import FIELD_WRITERS, field_writer

    outputs = [with_suffix(path) for path in output or []]
    if not (outputs or preview or as_json or save_config or dry_run):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    settings = resolve(typed, config, trust=trust)
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
            source,
            settings,
            LabelOutput(
                outputs=outputs,
                ascii_stl=ascii_stl,
                force=force,
                as_json=as_json,
                quiet=quiet,
                saved=saved,
            ),
            options,
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
