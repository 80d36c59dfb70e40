"""The app: its commands live in modules of their own.

Pattern parameters are given as ``--set name=value``, so a new pattern needs no line here and no entry in a help text.
"""

from __future__ import annotations

from typing import Annotated

import typer

from infill.cli.checking import check
from infill.cli.listing import list_patterns
from infill.cli.making import make
from infill.cli.refilling import refill
from infill.cli.smoothing import smooth
from infill.cli.timing import motion
from infill.version import __version__


def build() -> typer.Typer:
    """Return the app."""
    app = typer.Typer(
        name="infill",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
        help="Infill patterns as smooth, watertight, printable meshes.",
        epilog="Example: infill make honeycomb -o honeycomb.stl",
    )

    @app.callback()
    def common(
        version: Annotated[
            bool, typer.Option("--version", help="Show the version and exit.", callback=_version, is_eager=True)
        ] = False,
    ) -> None: ...

    app.command("make", no_args_is_help=True, epilog="Example: infill make zigzag --size 60x40 --cell 5 -o zigzag.3mf")(
        make
    )
    app.command("smooth", no_args_is_help=True, epilog="Example: infill smooth scan.nrrd --threshold 226 -o bone.stl")(
        smooth
    )
    app.command("refill", no_args_is_help=True, epilog="Example: infill refill print.gcode -o smooth.gcode")(refill)
    app.command("list", epilog="Example: infill list honeycomb --preview honeycomb.png")(list_patterns)
    app.command("check", no_args_is_help=True, epilog="Example: infill check part.stl --json")(check)
    app.command(
        "motion", no_args_is_help=True, epilog="Example: infill motion part.gcode smooth.gcode --plot speeds.png"
    )(motion)
    return app


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"infill {__version__} (phasefill)")
        raise typer.Exit
