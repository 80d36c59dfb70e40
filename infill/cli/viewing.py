"""``infill view``: a mesh or a sliced print as a page, in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from infill.cli.common import FILES, Force, Quiet
from infill.cli.console import format_bytes, say
from infill.errors import UsageError


def view(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Mesh (.stl .3mf .obj .ply .off .glb .gltf) or sliced print (.gcode .bgcode .gcode.3mf).",
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Page to write: a .html, which any browser shows, without a network. (default: a temporary one, "
            "which is opened)",
            rich_help_panel=FILES,
        ),
    ] = None,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Do not open the browser.")] = False,
    force: Force = False,
    quiet: Quiet = False,
) -> None:
    """Show a mesh or a sliced print in the browser: turn it, cut it open, look at its layers."""
    from infill.viewer.viewable import open_in_browser

    if output is not None:
        from infill.files.whole_files import check_targets
        from infill.pictures.picture_files import PAGES

        if output.suffix.lower() not in PAGES:
            raise UsageError.about("output", f"is {output.name!r}, and a page is written; use a name ending in .html")
        check_targets([output], overwrite=force)
    page = _page_of(file)
    if output is not None:
        from infill.files.whole_files import write_all_files

        write_all_files({output: lambda target: target.write(page.encode())})
    else:
        output = open_in_browser(page, opens=not no_browser)
    if not quiet:
        say(f"wrote {output} ({format_bytes(output.stat().st_size)})")


def _page_of(file: Path) -> str:
    """Return the page that shows a file."""
    from infill.files.suffixes import PRINTS

    if file.name.lower().endswith((*PRINTS, ".gcode.3mf")):
        from infill.planner.layer_speeds import drawn_speeds
        from infill.viewer.print_page import print_page

        return print_page({"print": drawn_speeds(file)}, title=file.name)
    from infill.formats.file_objects import split_objects
    from infill.formats.mesh_files import read_mesh
    from infill.viewer.page import measure_surface, surface_page

    surface = read_mesh(file)
    parts = split_objects(surface, file)
    return surface_page(
        {part.name: part.surface for part in parts},
        title=file.name,
        report=measure_surface(surface),
        colours={part.name: part.colour for part in parts if part.colour is not None},
    )
