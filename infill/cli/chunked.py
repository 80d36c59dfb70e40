"""``infill smooth`` for a volume in chunks: its files, its plan and its summary."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

import typer

from infill.cli.console import format_bytes, format_table, print_json, print_log, progress_bar, say
from infill.cli.foreseeing import format_replaced, format_span, format_steps
from infill.errors import MemoryLimitError, OutputError, ParameterError, UsageError
from infill.plain_numbers import count_noun, plain_size

if TYPE_CHECKING:
    from infill.cli.labelled import SmoothOutput
    from infill.lazy.volume import LazyVolume
    from infill.reports.smoothing import ChunksReport, ChunksSimplified
    from infill.smoothing.chunked_surface import ChunkedSurface
    from infill.smoothing.request import SmoothOptions, SmoothRequest
    from infill.smoothing.scans import Threshold
    from infill.smoothing.settings import SmoothSettings

ZARR = ".zarr"


def wants_chunks(
    source: Path,
    settings: SmoothSettings,
    options: SmoothOptions,
    output: SmoothOutput,
    *,
    workers: int | None,
    scheduler: str | None,
) -> bool:
    """Tell whether a run works in chunks: it is asked to, or the source is read in parts and is too large otherwise."""
    from infill.lazy.names import is_lazy

    if workers is not None or scheduler is not None:
        return True
    if not is_lazy(source):
        return False
    if settings.chosen_method == "plain":
        return True
    if not can_take_chunks(source, settings, options, output):
        return False
    try:
        _open(source, settings).require_room(options.get("max_memory"))
    except MemoryLimitError:
        return True
    return False


def can_take_chunks(source: Path, settings: SmoothSettings, options: SmoothOptions, output: SmoothOutput) -> bool:
    """Tell whether a source that does not fit into memory can be smoothed in chunks with the same options."""
    from infill.lazy.names import is_lazy
    from infill.smoothing.chunk_plans import check_chunked
    from infill.smoothing.request import SmoothRequest

    if not is_lazy(source):
        return False
    try:
        check_chunked(SmoothRequest(**options), **_unfit(settings), preview=output.preview)
        _check_outputs(output)
    except ParameterError:
        return False
    return True


def _open(source: Path, settings: SmoothSettings) -> LazyVolume:
    """Open the volume, or the part of it that is requested."""
    from infill.lazy.opening import open_volume

    volume = open_volume(source, array=settings.array, spacing=settings.spacing)
    return volume if settings.roi is None else volume.crop(settings.roi)


def smooth_chunks(
    source: Path,
    settings: SmoothSettings,
    output: SmoothOutput,
    options: SmoothOptions,
    *,
    workers: int | None,
    scheduler: str | None,
    resume: Path | None,
    show_hash: bool,
) -> None:
    """Smooth a volume in chunks, write the files piece by piece, and print a summary; or only the plan."""
    from infill.chunks.running import check_runner
    from infill.smoothing.chunk_plans import check_chunked
    from infill.smoothing.chunked import smooth_in_chunks
    from infill.smoothing.request import SmoothRequest

    check_runner(workers, scheduler)
    with progress_bar(shown=not output.quiet and not output.dry_run) as progress:
        request = SmoothRequest(**cast("SmoothOptions", {**options, "progress": progress}))
        check_chunked(request, **_unfit(settings), preview=output.preview)
        _check_outputs(output)
        if not output.as_json and all(path.suffix.lower() == ZARR for path in output.outputs):
            request = replace(request, tolerance=None)  # no triangles are written
        with print_log(shown=not output.quiet):
            volume = _open(source, settings)
        choices = {"threshold": settings.threshold, "between": settings.between, "otsu": settings.otsu or None}
        chosen = [name for name, value in choices.items() if value is not None]
        if len(chosen) > 1:
            raise UsageError.about(tuple(chosen), "exclude each other; give one of them")
        threshold = cast("Threshold", "otsu" if settings.otsu else choices[chosen[0]] if chosen else None)
        if output.dry_run:
            _show_plan(volume, request, threshold, settings, output, workers=workers, scheduler=scheduler)
            return
        with (
            print_log(shown=not output.quiet),
            smooth_in_chunks(
                volume,
                request,
                threshold=threshold,
                label=settings.label,
                grey=settings.grey,
                workers=workers,
                scheduler=scheduler,
                resume=resume,
            ) as surface,
        ):
            _write(surface, volume, output, segment=_segment(settings))
            report = surface.report()
    written = [str(path) for path in (*output.outputs, *output.saved)]
    if not output.quiet:
        say(_summary(report, written, str(source)))
    if output.as_json:
        print_json({**report, "files": written})
    elif show_hash:
        typer.echo(report["hash"])


def _unfit(settings: SmoothSettings) -> dict[str, object]:
    """Return the options that a volume in chunks does not have, by name."""
    names = ("voxel", "resolution", "shell", "keep_components", "by_component", "units", "series", "frame")
    kind = None if settings.kind in (None, "volume") else settings.kind
    return {**{name: getattr(settings, name) for name in names}, "kind": kind}


def _segment(settings: SmoothSettings) -> int:
    """Return the number of the segment in tiles: the label, if there is one alone, else 1."""
    labels = settings.label or ()
    return labels[0] if len(labels) == 1 and labels[0] > 0 else 1


def _check_outputs(output: SmoothOutput) -> None:
    """Raise an error for outputs that cannot be written piece by piece, or exist."""
    from infill.cli.piping import is_piped
    from infill.files.whole_files import check_targets
    from infill.files.whole_folders import check_folder_target
    from infill.formats.mesh_pieces import TILES, TILES_INFO, check_piece_format

    folders: set[Path] = set()
    for path in (*output.outputs, *output.saved):
        if is_piped(path):
            raise ParameterError("'-' is stdout, and a volume in chunks is written piece by piece; name a file")
    if output.ascii_stl:
        raise ParameterError.about("ascii_stl", "is not for a volume in chunks; leave it out")
    for path in output.outputs:
        if path.suffix.lower() in (ZARR, TILES):
            if path.resolve() in folders:
                raise OutputError(f"{path} is named twice; give every output a name of its own")
            folders.add(path.resolve())
            if not output.dry_run:
                mark = "" if path.suffix.lower() == ZARR else TILES_INFO
                check_folder_target(path, overwrite=output.force, mark=mark)
        else:
            check_piece_format(path)
    files = [path for path in output.outputs if path.suffix.lower() not in (ZARR, TILES)]
    check_targets((*files, *output.saved), overwrite=output.force)


def _write(surface: ChunkedSurface, volume: LazyVolume, output: SmoothOutput, *, segment: int) -> None:
    """Write all files of a run; each is complete or not there."""
    from infill.files.whole_files import atomic_files, scratch_file, wrap_os_errors
    from infill.files.whole_folders import whole_folder
    from infill.formats.mesh_pieces import PIECE_WRITERS, TILES, PieceWriter, PrecomputedPieces, check_piece_size
    from infill.lazy.zarr_fields import write_zarr_field

    tiles = [path for path in output.outputs if path.suffix.lower() == TILES]
    meshes = [path for path in output.outputs if path.suffix.lower() not in (ZARR, TILES)]
    for path in meshes:
        check_piece_size(path, surface.vertices, surface.triangles)
    targets = [*meshes, *output.saved]
    with contextlib.ExitStack() as stack:
        files = stack.enter_context(atomic_files(targets)) if targets else []
        writers: list[PieceWriter] = [
            PIECE_WRITERS[path.suffix.lower()](
                file,
                stack.enter_context(scratch_file(path.absolute().parent)),
                surface.vertices,
                surface.triangles,
                volume.space,
            )
            for path, file in zip(meshes, files, strict=False)
        ]
        folders = [stack.enter_context(whole_folder(path)) for path in tiles]
        for path, folder in zip(tiles, folders, strict=True):
            with wrap_os_errors(path):
                writers.append(PrecomputedPieces(folder, segment))
        for piece in surface.pieces() if writers else ():
            for path, writer in zip((*meshes, *tiles), writers, strict=True):
                with wrap_os_errors(path):
                    writer.add(piece)
        for path, writer in zip((*meshes, *tiles), writers, strict=True):
            with wrap_os_errors(path):
                writer.finish()
        for save, file in zip(output.saved.values(), files[len(meshes) :], strict=True):
            save(file)
        for path in output.outputs:
            if path.suffix.lower() == ZARR:
                write_zarr_field(path, volume, surface.field_boxes())


def _show_plan(
    volume: LazyVolume,
    request: SmoothRequest,
    threshold: Threshold,
    settings: SmoothSettings,
    output: SmoothOutput,
    *,
    workers: int | None,
    scheduler: str | None,
) -> None:
    """Print the cost of a run."""
    from infill.smoothing.chunked_plan import plan_chunked

    with print_log(shown=not output.quiet):
        forecast = plan_chunked(
            volume,
            request,
            threshold=threshold,
            label=settings.label,
            grey=settings.grey,
            workers=workers,
            scheduler=scheduler,
        )
    names = [str(path) for path in (*output.outputs, *output.saved)]
    if output.as_json:
        print_json({**forecast, "files": names})
        return
    grid = forecast["grid"]
    rows = {
        "grid": f"{' x '.join(map(str, grid['shape']))} voxels of {plain_size(*grid['spacing'], digits=4)}",
        "method": f"{forecast['request']['method']}: {format_steps(forecast['request'])}",
        "chunks": f"{forecast['chunks']:,}, of which about {forecast['crossed']:.0%} have surface",
        "read": f"{format_bytes(forecast['read'])} of voxels in one pass, margins included",
        "tasks": f"about {forecast['tasks']:,}, which send back {format_bytes(forecast['sent'])} besides triangles",
        "triangles": f"about {forecast['triangles']:,}, before they are simplified",
        "memory": f"at most about {format_bytes(forecast['memory'])}, "
        f"{format_bytes(forecast['memory_per_worker'])} for each worker",
        "time": f"about {format_span(forecast['seconds']['total'])} on this machine, as busy as it is",
        "elsewhere": "; ".join(
            f"{count_noun(fleet['workers'], 'core')} like these: {format_span(3600 * fleet['hours'])}"
            for fleet in forecast["hours"]
        ),
    }
    if names:
        rows["would write"] = ", ".join(names)
    typer.echo(format_table(rows, title=f"{volume.name}: nothing is written (--dry-run)"))


def _simplified_row(simplified: ChunksSimplified | None) -> dict[str, str]:
    """Return the row about simplification, if there was any."""
    if simplified is None:
        return {}
    return {
        "simplified": f"from {simplified['triangles_before']:,} triangles, by {plain_size(simplified['tolerance'])} at "
        f"most, volume {simplified['volume_change']:+z.4%} by that"
    }


def _summary(report: ChunksReport, files: Iterable[str], name: str) -> str:
    """Return the short table for stderr."""
    request, grid, chunks = report["request"], report["grid"], report["chunks"]
    result, data = report["topology"]["result"], report["topology"]["data"]
    size = plain_size(*report["extents"], digits=4)
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, {size}",
        **_simplified_row(report["simplified"]),
        "solid": f"{plain_size(report['volume'], digits=6, power=3)}, {report['volume_change']:+z.4%} of the data",
        "smoothing": f"{format_steps(request)}{format_replaced(report['verdict']['instead_of'])}, "
        f"{' x '.join(map(str, grid['shape']))} voxels of "
        f"{plain_size(*grid['spacing'], digits=4)}",
        "chunks": f"{chunks['crossed']:,} of {chunks['count']:,} with surface, of "
        f"{' x '.join(map(str, chunks['cells']))} voxels, {count_noun(chunks['workers'], 'worker')}",
        "components": f"{result['components']:,} ({data['components']:,} in the data), "
        f"{count_noun(result['cavities'], 'cavity', 'cavities')} ({data['cavities']:,}), "
        f"{count_noun(result['tunnels'], 'tunnel')} ({data['tunnels']:,})",
        "verdict": "; ".join([report["verdict"]["word"], *report["verdict"]["changes"]]),
        "hash": report["hash"],
    }
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=name)
