"""``infill smooth --by-component``: every component of a mesh as a surface of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import typer

from infill.cli.console import format_bytes, format_table
from infill.plain_numbers import plain_size

if TYPE_CHECKING:
    from infill.reports.smoothing import ComponentsReport
    from infill.result import Result
    from infill.smoothing.by_component import ComponentStages

MOST_ROWS = 60  # components in the summary


def check_fields(outputs: Sequence[Path]) -> None:
    """Raise BadParameter for an output that is a field: components do not share a field."""
    from infill.imaging.volume_files import FIELD_WRITERS

    for path in outputs:
        if path.suffix.lower() in FIELD_WRITERS:
            raise typer.BadParameter(f"--by-component makes meshes, and {path} is a field; leave one of them out")


def component_writer(
    path: Path, result: Result[ComponentStages, ComponentsReport], *, ascii_stl: bool
) -> Callable[[BinaryIO], object]:
    """Return a function that writes all components to one file: by name if its format has names, else in a row."""
    from infill.formats.mesh_files import PART_WRITERS, mesh_writer
    from infill.result import parts_of

    if path.suffix.lower() in PART_WRITERS:
        return partial(PART_WRITERS[path.suffix.lower()], parts_of(result))
    return partial(mesh_writer(path, ascii=ascii_stl), result.whole)


def component_summary(result: Result[ComponentStages, ComponentsReport], files: Sequence[str], name: str) -> str:
    """Return the short table for stderr: a row for each component, and failures."""
    report = result.report
    rows = {}
    for component in report["components"][:MOST_ROWS]:
        part = component["report"]
        changes = "; ".join([part["verdict"]["word"], *part["verdict"]["changes"]])
        rows[component["name"]] = (
            f"{part['triangles']:,} triangles, {plain_size(part['volume'], digits=6, power=3)}, "
            f"{part['volume_change']:+z.4%}; {changes}"
        )
    if len(report["components"]) > MOST_ROWS:
        rows["…"] = f"and {len(report['components']) - MOST_ROWS} more"
    for failure in report["failed"]:
        rows[f"FAILED {failure['name']}"] = failure["error"]
    if report["sheets"]:
        rows["left out"] = f"{report['sheets']} components that enclose nothing"
    rows["verdict"] = _verdict_text(report)
    for file in files:
        rows[f"wrote {file}"] = format_bytes(Path(file).stat().st_size) if Path(file).is_file() else ""
    return format_table(rows, title=name)


def _verdict_text(report: ComponentsReport) -> str:
    """Return the verdict and the components it is due to, with the reason if the row of the first is not shown."""
    word, components = report["verdict"]["word"], report["components"]
    such = [n for n, component in enumerate(components) if component["report"]["verdict"]["word"] == word]
    if word == "kept" or not such:
        return str(word)
    first = components[such[0]]
    reason = "" if such[0] < MOST_ROWS else f" ({'; '.join(first['report']['verdict']['changes'])})"
    more = "" if len(such) == 1 else f" and {len(such) - 1:,} more of {len(components):,}"
    return f"{word}: {first['name']}{reason}{more}"
