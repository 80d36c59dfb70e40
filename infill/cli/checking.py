"""``infill check``: whether meshes are printable, and prints whole."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from infill.cli.console import format_table, print_json, say
from infill.errors import InfillError
from infill.plain_numbers import count_noun, plain_clock, plain_size

if TYPE_CHECKING:
    from infill.inspection.printability import Inspection
    from infill.projects.doctor import Diagnosis
    from infill.projects.project import Slicer
    from infill.reports.checking import CheckReport, FailedCheck, PrintCheckReport, ProjectReport
    from infill.timing.print_check import PrintCheck


def check(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            help="Meshes to check: .stl .3mf .obj .ply .off .glb .gltf; and sliced prints: .gcode .bgcode .gcode.3mf.",
        ),
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
        bool, typer.Option("--json", help="Print one JSON object to stdout; of several files, a list of them.")
    ] = False,
) -> None:
    """Check whether meshes are printable and prints whole, and say why not; exit 1 if one is not."""
    if slicer is not None:
        _check_projects(files, slicer, strict=strict, as_json=as_json)
        return
    if len(files) == 1:
        inspection = _inspect(files[0])
        if as_json:
            print_json(inspection.to_dict())
        else:
            typer.echo(_inspection_table(inspection, str(files[0])))
        if not _passes(inspection, strict=strict):
            raise typer.Exit(1)
        return
    passed = True
    results: list[CheckReport | PrintCheckReport | FailedCheck] = []
    width = max(len(str(path)) for path in files)
    for path in files:
        try:
            inspection = _inspect(path)
        except InfillError as error:
            say(f"error: {error}")
            passed = False
            results.append({"file": str(path), "error": str(error)})
            continue
        passed &= _passes(inspection, strict=strict)
        result: Any = {"file": str(path), **inspection.to_dict()}
        results.append(result)
        if not as_json:  # each as soon as it is known
            typer.echo(f"{path!s:<{width}}  {_verdict_line(inspection)}")
    if as_json:
        print_json(results)
    if not passed:
        raise typer.Exit(1)


def _inspect(path: Path) -> Inspection | PrintCheck:
    """Check a mesh or a print, as its name says."""
    from infill.files.suffixes import PRINTS

    if path.name.lower().endswith((*PRINTS, ".gcode.3mf")):
        from infill.timing.print_check import check_print

        return check_print(path)
    from infill.inspection.printability import check

    return check(path)


def _check_projects(paths: list[Path], slicer: Slicer, *, strict: bool, as_json: bool) -> None:
    """Check projects for a slicer and print the diagnoses; exit 1 if one of them fails."""
    from infill.projects.doctor import check_project

    passed = True
    results: list[ProjectReport | FailedCheck] = []
    for path in paths:
        try:
            diagnosis = check_project(path, slicer)
        except InfillError as error:
            if len(paths) == 1:
                raise
            say(f"error: {error}")
            passed = False
            results.append({"file": str(path), "error": str(error)})
            continue
        passed &= diagnosis.fine and not (strict and diagnosis.warnings)
        results.append({"file": str(path), **diagnosis.to_dict()})
        if not as_json:
            typer.echo(_diagnosis_table(diagnosis, str(path)))
    if as_json:
        print_json(results if len(paths) > 1 else results[0])
    if not passed:
        raise typer.Exit(1)


def _diagnosis_table(diagnosis: Diagnosis, name: str) -> str:
    """Format the diagnosis of a project for a slicer as a table."""
    rows = {"fine": "yes" if diagnosis.fine else "NO"}
    rows |= {f"problem {i}": text for i, text in enumerate(diagnosis.problems, 1)}
    rows |= {f"warning {i}": text for i, text in enumerate(diagnosis.warnings, 1)}
    for number, volume in enumerate(diagnosis.volumes, 1):
        settings = ", ".join(f"{key} {value}" for key, value in volume.settings.items())
        closed = "closed" if volume.closed else "NOT CLOSED"
        rows[f"volume {number}"] = f"{volume.name}: {volume.role}, {volume.triangles:,} triangles, {closed}"
        if settings:
            rows[f"settings {number}"] = settings
    rows["written by"] = diagnosis.application or "not stated"
    return format_table(rows, title=f"{name}, for {diagnosis.slicer}")


def _passes(inspection: Inspection | PrintCheck, *, strict: bool) -> bool:
    """Tell whether a file passes: printable, and with `--strict` without a warning."""
    return inspection.printable and not (strict and inspection.warnings)


def _verdict_line(inspection: Inspection | PrintCheck) -> str:
    """Format the verdict on one of several files as a line, with its reasons."""
    if not inspection.printable:
        return f"NO   {'; '.join(inspection.problems)}"
    return "; ".join([f"yes  {_size_text(inspection)}", *(f"warning: {warning}" for warning in inspection.warnings)])


def _size_text(inspection: Inspection | PrintCheck) -> str:
    """Describe how large a mesh or a print is, on one line."""
    from infill.timing.print_check import PrintCheck

    if isinstance(inspection, PrintCheck):
        layers, time = count_noun(inspection.layers, "layer"), plain_clock(inspection.seconds)
        return f"{layers}, {inspection.filament / 1000:.2f} m of filament, {time}"
    size = plain_size(*inspection.extents, digits=4)
    return f"{inspection.triangles:,} triangles, {_count_parts(inspection)}, {size}"


def _inspection_table(inspection: Inspection | PrintCheck, name: str) -> str:
    """Format the inspection of a mesh or a print as a table."""
    from infill.timing.print_check import PrintCheck

    rows = {
        "printable": "yes" if inspection.printable else "NO",
        **{f"problem {i}": text for i, text in enumerate(inspection.problems, 1)},
        **{f"warning {i}": text for i, text in enumerate(inspection.warnings, 1)},
    }
    rows |= _print_rows(inspection) if isinstance(inspection, PrintCheck) else _mesh_rows(inspection)
    return format_table(rows, title=name)


def _print_rows(inspection: PrintCheck) -> dict[str, str]:
    """Return the rows of a print."""
    return {"slicer": inspection.slicer or "not stated", "print": _size_text(inspection)}


def _mesh_rows(inspection: Inspection) -> dict[str, str]:
    """Return the rows of a mesh."""
    return {
        "watertight": _watertight_text(inspection),
        "parts": _parts_text(inspection),
        "faces outwards": "yes" if inspection.outward else "no",
        "triangles": f"{inspection.triangles:,}, {inspection.degenerate:,} without an area, {inspection.duplicate:,} "
        f"duplicate, {count_noun(inspection.self_intersections, 'pair')} that cross",
        "volume, area": f"{plain_size(inspection.volume, digits=6, power=3)}, "
        f"{plain_size(inspection.area, digits=6, power=2)}",
        "size": plain_size(*inspection.extents, digits=4),
    }


def _watertight_text(inspection: Inspection) -> str:
    """Tell whether a mesh is watertight, and if not, why."""
    if inspection.closed:
        return "yes"
    if inspection.open_edges:
        return f"no, {count_noun(inspection.open_edges, 'open edge')}"
    return "no, neighbouring faces disagree about which side is out"


def _parts_text(inspection: Inspection) -> str:
    """Format the numbers of parts and of cavities sealed inside of them, which are unknown for an open mesh."""
    if inspection.sealed_voids is None:
        return f"{_count_parts(inspection)}, sealed cavities unknown: the mesh is not watertight"
    cavities = count_noun(inspection.sealed_voids, "sealed cavity", "sealed cavities")
    return f"{_count_parts(inspection)} with {cavities}" if inspection.sealed_voids else _count_parts(inspection)


def _count_parts(inspection: Inspection) -> str:
    """Count the parts; of an open mesh, whose surfaces may bound solid or cavities, the components."""
    if inspection.sealed_voids is None:
        return count_noun(inspection.components, "component")
    # Cavities that touch in a vertex are one component.
    return count_noun(max(inspection.components - inspection.sealed_voids, 1), "part")
