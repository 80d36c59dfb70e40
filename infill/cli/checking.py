"""``infill check``: whether a mesh is printable."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from infill.cli.console import print_json, table


def check(
    mesh: Annotated[Path, typer.Argument(help="Mesh to look at: .stl .3mf .obj .ply .off .glb.")],
    strict: Annotated[bool, typer.Option("--strict", help="Exit 1 for warnings too.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """Say whether a mesh is printable, and if not, why; exit 1 when it is not."""
    from infill.inspection.printability import check as inspect

    found = inspect(mesh)
    if as_json:
        print_json(found.to_dict())
    else:
        extents = " x ".join(f"{length:.4g}" for length in found.extents)
        rows = {
            "printable": "yes" if found.printable else "NO",
            **{f"problem {i}": text for i, text in enumerate(found.problems, 1)},
            **{f"warning {i}": text for i, text in enumerate(found.warnings, 1)},
            "closed": f"{_yes(found.closed)}, {found.open_edges} open edge(s)",
            "outward": _yes(found.outward),
            "manifold3d": found.manifold,
            "self-intersections": str(found.self_intersections),
            "components": str(found.components),
            "triangles": f"{found.triangles:,}, {found.degenerate} degenerate, {found.duplicate} duplicate",
            "volume, area": f"{found.volume:.6g}, {found.area:.6g}",
            "extents": extents,
        }
        typer.echo(table(rows, title=str(mesh)))
    if not found.printable or (strict and found.warnings):
        raise typer.Exit(1)


def _yes(holds: bool) -> str:
    return "yes" if holds else "no"
