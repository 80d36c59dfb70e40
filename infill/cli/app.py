"""The app: its commands live in modules of their own.

Pattern parameters are given as ``--set name=value``, so a new pattern needs no line here and no entry in a help text.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Annotated, Any

import typer

from infill.cli.commands import Command, Group
from infill.cli.several import FileCommand
from infill.version import __version__

# By name: module and function, which are loaded when the command is built, and an example. Those not in
# `LISTING` show their help when nothing is given.
COMMANDS: dict[str, tuple[str, str, str]] = {
    "make": ("making", "make", "infill make zigzag --size 60x40 --cell 5 -o zigzag.3mf"),
    "smooth": ("smoothing", "smooth", "infill smooth scan.nrrd --threshold 226 -o bone.stl"),
    "fill": ("filling", "fill", "infill fill part.stl --density 20% -o filled.stl"),
    "refill": ("refilling", "refill", "infill refill print.gcode -o smooth.gcode"),
    "list": ("listing", "list_patterns", "infill list honeycomb --preview honeycomb.png"),
    "check": ("checking", "check", "infill check part.stl smooth.stl --json"),
    "motion": ("timing", "motion", "infill motion part.gcode smooth.gcode --plot speeds.png"),
    "verify": ("verifying", "verify", "infill verify before.gcode after.gcode"),
    "view": ("viewing", "view", "infill view part.stl"),
    "sample": ("sampling", "sample", "infill sample part scan print"),
    "studio": ("studio", "studio", "infill studio part.stl"),
    "setup": ("setting_up", "setup", "infill setup prusaslicer --write"),
    "mcp": ("serving_tools", "mcp", "infill mcp --folder prints"),
}

FILE_COMMANDS = ("smooth", "fill", "refill")  # which take several files
LISTING = ("list", "sample", "studio", "mcp")  # commands that do something when nothing is given


def build_app(command_name: str = "") -> typer.Typer:
    """Build the app; given the name of a command, only with that command, which starts sooner."""
    app = typer.Typer(
        name="infill",
        cls=Group,
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

    for name in [command_name] if command_name in COMMANDS else COMMANDS:
        module, attribute, example = COMMANDS[name]
        function: Callable[..., Any] = getattr(importlib.import_module(f"infill.cli.{module}"), attribute)
        app.command(
            name,
            cls=FileCommand if name in FILE_COMMANDS else Command,
            no_args_is_help=name not in LISTING,
            epilog=f"Example: {example}",
        )(function)
    return app


def _version(requested: bool) -> None:
    """Print the version and stop, if `--version` was given."""
    if requested:
        typer.echo(f"infill {__version__} (phasefill)")
        raise typer.Exit
