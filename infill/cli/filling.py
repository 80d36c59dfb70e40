"""``infill fill``: a part in, the part with its infill as one solid out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO

import typer

from infill.cli.common import (
    FILES,
    RUN,
    AsciiStl,
    Force,
    Json,
    MaxMemory,
    Quiet,
    SaveConfig,
    Threads,
    TrustCode,
    Verbose,
)
from infill.cli.completing import fill_assignments, fill_pattern_names, slicer_names
from infill.cli.console import print_json, print_log, progress_bar, say
from infill.cli.declared import takes_options
from infill.errors import UsageError
from infill.lattices.settings import FillOptions, resolve

if TYPE_CHECKING:
    from infill.formats.parts import Part
    from infill.formats.threemf_reading import FileObject
    from infill.lattices.settings import FillSettings
    from infill.pictures.sections import Cut
    from infill.reports.filling import FillReport
    from infill.result import Result
    from infill.surface import Surface

PATTERN = "Pattern"
SLICER = "{slicer}"  # the placeholder in names of files


@takes_options(FillOptions, pattern=fill_pattern_names, slicer=slicer_names)
def fill(
    part: Annotated[
        Path,
        typer.Argument(
            metavar="PART...", help="Mesh to fill (.stl .3mf .obj .ply .off .glb .gltf): closed, or nearly."
        ),
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
            help="Picture to write, cut open where that shows most of the infill: a .png; or a page to turn and cut it "
            "open in a browser: a .html.",
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
    save_config: SaveConfig = None,
    trust: TrustCode = False,
    ascii_stl: AsciiStl = False,
    force: Force = False,
    *,
    typed: dict[str, Any],
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
    threads: Threads = None,
    max_memory: MaxMemory = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only show cell, line width, grid and memory.", rich_help_panel=RUN)
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Fill a part: a shell and infill as one solid, the skin as it was; or part and infill as a slicer's project."""
    from infill.cli.filled_words import show_plan, summary
    from infill.cli.piping import check_outputs, deliver_all, with_suffix
    from infill.cli.words import parse_bytes

    outputs = [with_suffix(path) for path in output or []]
    if not (outputs or preview or as_json or save_config or dry_run):
        raise typer.BadParameter("nothing to write; give -o FILE, --json to see the report, or --dry-run")
    settings = resolve(typed, assigned or [], config, trust=trust)
    files = _name_for_slicers(outputs, settings.slicers)
    writers = {path: _writer(path, settings, slicer, ascii_stl=ascii_stl) for path, slicer in files}
    outputs = [path for path, _ in files]
    if preview is not None:
        from infill.pictures.picture_files import check_preview, is_page

        check_preview(preview, pages=True)
        if cut and is_page(preview):
            raise typer.BadParameter("a page is cut open in the browser; leave --cut out")
    cuts = _parse_cuts(cut or [], drawn=preview is not None, dry_run=dry_run)
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
        from infill.formats.mesh_files import PART_WRITERS
        from infill.lattices.forecast import plan_fill
        from infill.lattices.job import fill_request
        from infill.smoothing.sources import read_source

        if progress is not None:
            progress("read", 0.0)
        with print_log(shown=not quiet):
            mesh: Any = read_source(part, kind="mesh", units=settings.units)
            if cuts:
                from infill.pictures.sections import check_cuts

                check_cuts(cuts, mesh.bounds)
            if dry_run:
                show_plan(plan_fill(mesh, settings.request, threads=threads), str(part), as_json=as_json)
                return
            result = fill_request(mesh, settings.request, threads=threads, max_memory=limit, progress=progress)
        objects = _file_objects(part, outputs, settings)
        divided = _divide(result, mesh, objects, threads=threads) if objects else []
        if progress is not None:
            progress("write", 0.95)
        parts: dict[Path, Callable[[BinaryIO], object]] = {
            path: partial(write, result, part.stem) for path, write in writers.items()
        }
        for path in outputs if divided else ():
            if path.suffix.lower() in PART_WRITERS:
                parts[path] = partial(PART_WRITERS[path.suffix.lower()], divided)
        if preview is not None:
            pictured = replace(result, stages=replace(result.stages, cuts=cuts))
            parts[preview] = pictured.preview_writer(preview, part.name)
        written = deliver_all({**parts, **saved})
    if not quiet:
        kept = (len(divided), len(objects)) if divided else None
        say(summary(result.report, written, str(part), verbose=verbose, objects=kept))
    if as_json:
        print_json({**result.report, "files": written})


def _file_objects(part: Path, outputs: list[Path], settings: FillSettings) -> tuple[FileObject, ...]:
    """Return the objects of a 3MF whose solid goes into a file of objects; none for other files."""
    from infill.formats.mesh_files import PART_WRITERS

    solid = not settings.slicers and settings.request.form == "solid"
    if not solid or part.suffix.lower() != ".3mf" or not any(path.suffix.lower() in PART_WRITERS for path in outputs):
        return ()
    from infill.formats.threemf_reading import read_objects

    return read_objects(part)


def _divide(
    result: Result[Any, FillReport], mesh: Surface, objects: tuple[FileObject, ...], *, threads: int | None
) -> list[Part]:
    """Divide a filled part into the objects of its file."""
    from infill.lattices.objects import divide_by_objects

    return divide_by_objects(result.surface, mesh, objects, threads=threads)


def _parse_cuts(texts: list[str], *, drawn: bool, dry_run: bool) -> tuple[Cut, ...]:
    """Parse the cuts of a preview, or raise UsageError."""
    if not texts:
        return ()
    from infill.pictures.sections import parse_cut

    cuts = tuple(parse_cut(text) for text in texts)
    if dry_run:
        raise typer.BadParameter("a dry run draws nothing; leave --cut out")
    if not drawn:
        raise typer.BadParameter("--cut says where a preview is cut open; give --preview FILE.png too, or leave it out")
    return cuts


def _name_for_slicers(outputs: list[Path], slicers: Sequence[str]) -> list[tuple[Path, str | None]]:
    """Return each file, with the slicer in place of {slicer} in its name; raise UsageError where names would clash."""
    from infill.cli.piping import is_piped

    if not slicers:
        return [(path, None) for path in outputs]
    for path in outputs:
        if len(slicers) > 1 and SLICER not in str(path):
            named = Path("part.3mf") if is_piped(path) else path
            example = named.with_name(f"{named.stem}-{SLICER}{named.suffix}")
            raise UsageError.about(
                "for", f"is given for {len(slicers)} slicers, and {path} is one file; give -o {example}"
            )
    return [(Path(str(path).replace(SLICER, slicer)), slicer) for path in outputs for slicer in slicers]


def _writer(
    path: Path, settings: FillSettings, slicer: str | None, *, ascii_stl: bool
) -> Callable[[Result[Any, FillReport], str, BinaryIO], object]:
    """Return a function that writes a result with a title, as a mesh or the slicer's project, or raise FormatError."""
    from infill.formats.mesh_files import mesh_writer

    write = mesh_writer(path, ascii=ascii_stl)
    if slicer is None:
        return lambda result, title, file: write(result.surface, file)  # noqa: ARG005 - as projects are written
    from infill.projects.saving import check_suffix, make_project, writer_for

    units = settings.units
    check_suffix(path)
    write_project = writer_for(slicer)
    return lambda result, title, file: write_project(
        make_project(result, slicer=slicer, title=title, units=units), file
    )
