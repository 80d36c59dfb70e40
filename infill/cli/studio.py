"""``infill studio``: a page in the browser that shows what the other commands make."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from infill.cli.console import say
from infill.errors import UsageError

MISSING = "the studio needs two more packages: pip install 'phasefill[studio]'"


def studio(
    file: Annotated[Path | None, typer.Argument(metavar="[FILE]", help="Part, scan or print to open at once.")] = None,
    port: Annotated[
        int, typer.Option(metavar="N", help="Port to listen at. (default: any that is free)", show_default=False)
    ] = 0,
    host: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Network to listen at; any but this machine lets others in. (default: 127.0.0.1)",
            show_default=False,
        ),
    ] = "127.0.0.1",
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Only print the address.")] = False,
) -> None:
    """Open a page in the browser to look at parts, prints and scans, and to change them by sliders."""
    try:
        from infill.studio.server import serve
    except ModuleNotFoundError as error:
        if error.name not in ("starlette", "uvicorn"):
            raise
        raise UsageError(MISSING) from None

    def announce(address: str) -> None:
        """Print the address of the page."""
        typer.echo(address)
        say("Ctrl-C ends it.")

    serve(file, host=host, port=port, browser=not no_browser, announce=announce)
