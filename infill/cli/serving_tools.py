"""``infill mcp``: the commands as tools for an assistant."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from infill.cli.console import say
from infill.errors import UsageError

MISSING = "the tools for assistants need one more package: pip install 'phasefill[mcp]'"


def mcp(
    folder: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FOLDER",
            help="Folder whose files the assistant may read and write; may be given again. (default: the current one)",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Serve the other commands to an assistant, such as Claude, as tools of the Model Context Protocol."""
    try:
        from infill.tool_server.server import serve_tools
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] not in ("mcp", "mcp_types", "anyio"):
            raise
        raise UsageError(MISSING) from None
    from infill.tool_server.folders import AllowedFolders

    folders = AllowedFolders.of(folder or [Path()])
    os.chdir(folders.roots[0])
    if sys.stdin.isatty():
        say("This program is started by an assistant, and speaks with it here; docs/mcp.md says how. Ctrl-C ends it.")
    serve_tools(folders)
