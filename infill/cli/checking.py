"""``infill check``: whether meshes are printable."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from infill.cli.console import print_json, say, table
from infill.errors import InfillError

if TYPE_CHECKING:
    from infill.inspection.printability import Inspection
    from infill.projects.doctor import Diagnosis
    from infill.projects.project import Slicer


def check(
    meshes: Annotated[
        list[Path], typer.Argument(metavar="MESH...", help="Meshes to look at: .stl .3mf .obj .ply .off .glb .gltf.")
    ],
    slicer: Annotated[
        Literal["prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"] | None,
        typer.Option(
            "--for",
            metavar="prusaslicer|orcaslicer|bambustudio|cura|plain",
            help="Say what this slicer will do with a .3mf instead: its volumes and settings, and what would be lost.",
        ),
    ] = None,
    strict: Annotated[bool, typer.Option("--strict", help="Exit 1 for warnings too.")] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object to stdout; of several meshes, a list of them.")
    ] = False,
) -> None:
    """Say whether meshes are printable, and if not, why; exit 1 when one is not."""
    if slicer is not None:
        _check_projects(meshes, slicer, strict=strict, as_json=as_json)
        return
    from infill.inspection.printability import check as inspect

    if len(meshes) == 1:
        found = inspect(meshes[0])
        if as_json:
            print_json(found.to_dict())
        else:
            typer.echo(_described(found, str(meshes[0])))
        if not _passes(found, strict=strict):
            raise typer.Exit(1)
        return
    passed, told = True, []
    width = max(len(str(path)) for path in meshes)
    for path in meshes:
        each: dict[str, Any] = {"file": str(path)}
        try:
            found = inspect(path)
        except InfillError as error:
            say(f"error: {error}")
            passed = False
            told.append(each | {"error": str(error)})
            continue
        passed &= _passes(found, strict=strict)
        told.append(each | found.to_dict())
        if not as_json:  # each as soon as it is known
            typer.echo(f"{path!s:<{width}}  {_in_a_line(found)}")
    if as_json:
        print_json(told)
    if not passed:
        raise typer.Exit(1)


def _check_projects(paths: list[Path], slicer: Slicer, *, strict: bool, as_json: bool) -> None:
    """Say what a slicer will do with projects, and exit 1 if one of them is not as it should be."""
    from infill.projects.doctor import check_project

    passed, told = True, []
    for path in paths:
        try:
            found = check_project(path, slicer)
        except InfillError as error:
            if len(paths) == 1:
                raise
            say(f"error: {error}")
            passed = False
            told.append({"file": str(path), "error": str(error)})
            continue
        passed &= found.fine and not (strict and found.warnings)
        told.append({"file": str(path), **found.to_dict()})
        if not as_json:
            typer.echo(_diagnosed(found, str(path)))
    if as_json:
        print_json(told if len(paths) > 1 else told[0])
    if not passed:
        raise typer.Exit(1)


def _diagnosed(found: Diagnosis, name: str) -> str:
    """Return what a slicer will do with a project, as a table."""
    rows = {"fine": "yes" if found.fine else "NO"}
    rows |= {f"problem {i}": text for i, text in enumerate(found.problems, 1)}
    rows |= {f"warning {i}": text for i, text in enumerate(found.warnings, 1)}
    for number, volume in enumerate(found.volumes, 1):
        settings = ", ".join(f"{key} {value}" for key, value in volume.settings.items())
        closed = "closed" if volume.closed else "NOT CLOSED"
        rows[f"volume {number}"] = f"{volume.name}: {volume.role}, {volume.triangles:,} triangles, {closed}"
        if settings:
            rows[f"settings {number}"] = settings
    rows["written by"] = found.application or "nobody, as it says"
    return table(rows, title=f"{name}, for {found.slicer}")


def _passes(found: Inspection, *, strict: bool) -> bool:
    return found.printable and not (strict and found.warnings)


def _in_a_line(found: Inspection) -> str:
    """Return the verdict on one of several meshes, and what it rests on."""
    if not found.printable:
        return f"NO   {'; '.join(found.problems)}"
    size = " x ".join(f"{length:.4g}" for length in found.extents)
    text = f"yes  {found.triangles:,} triangles, {found.components} component(s), {size}"
    return "; ".join([text, *(f"warning: {each}" for each in found.warnings)])


def _described(found: Inspection, name: str) -> str:
    """Return all that there is to say of a mesh, as a table."""
    rows = {
        "printable": "yes" if found.printable else "NO",
        **{f"problem {i}": text for i, text in enumerate(found.problems, 1)},
        **{f"warning {i}": text for i, text in enumerate(found.warnings, 1)},
        "closed": f"{_yes(found.closed)}, {found.open_edges} open edge(s)",
        "outward": _yes(found.outward),
        "manifold3d": found.manifold,
        "self-intersections": str(found.self_intersections),
        "components": str(found.components),
        "sealed voids": _sealed(found.sealed_voids),
        "triangles": f"{found.triangles:,}, {found.degenerate} degenerate, {found.duplicate} duplicate",
        "volume, area": f"{found.volume:.6g}, {found.area:.6g}",
        "extents": " x ".join(f"{length:.4g}" for length in found.extents),
    }
    return table(rows, title=name)


def _sealed(voids: int | None) -> str:
    if voids is None:
        return "unknown: the mesh is not closed"
    return f"{voids}, in which resin and powder stay" if voids else "none"


def _yes(holds: bool) -> str:
    return "yes" if holds else "no"
