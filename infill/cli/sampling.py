"""``infill sample``: small files to try the other commands with."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from infill.cli.completing import sample_names
from infill.cli.console import format_bytes, format_table, say


def sample(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME...]",
            help="Samples to make: part, scan, print. Without a name, they are listed.",
            autocompletion=sample_names,
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="File to write, for a single sample. (default: part.stl, scan.nrrd, print.gcode)",
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.")] = False,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.")] = False,
) -> None:
    """Make a small part, scan or sliced print to try the other commands with."""
    from infill.files.whole_files import check_targets, write_all_files
    from infill.samples.catalogue import SAMPLES, find_sample

    if not names:
        if output is not None:
            raise typer.BadParameter("-o is the file of a sample; name one: infill sample part")
        typer.echo(format_table({name: each.summary for name, each in SAMPLES.items()}))
        typer.echo("'infill sample NAME' makes one.")
        return
    if output is not None and len(names) > 1:
        raise typer.BadParameter("-o names one file; make one sample at a time, or leave -o out")
    samples = [find_sample(name) for name in names]
    targets = [Path(each.file) if output is None else output for each in samples]
    writers = [each.writer(target) for each, target in zip(samples, targets, strict=True)]
    check_targets(targets, overwrite=force)
    for path in write_all_files(dict(zip(targets, writers, strict=True))):
        if not quiet:
            say(f"wrote {path}  {format_bytes(path.stat().st_size)}")
