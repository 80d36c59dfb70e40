"""The common part of all reports: sections, keys, types and units. docs/report.md lists each key.

A report holds plain numbers, strings, lists and dicts, so that ``--json`` can print it. Lengths are in mm, areas in
mm², volumes in mm³, angles in degrees.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from infill.inspection.changes import ConnectionCounts, TopologyChanges
from infill.surface import Surface
from infill.version import __version__

FORM = 1  # increases when a key is renamed or changes its type or meaning; new keys leave it unchanged


def report_of(
    *,
    product: str,
    surface: Surface,
    request: Mapping[str, Any],
    grid: Mapping[str, Any],
    solid: Mapping[str, Any],
    data: ConnectionCounts,
    result: ConnectionCounts,
    changes: TopologyChanges,
    walls: Mapping[str, Any],
    problems: Sequence[str],
    seconds: Mapping[str, float],
    simplified: Mapping[str, Any] | None = None,
    mesh: Mapping[str, Any] | None = None,
    **more: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the report of one run.

    Parameters
    ----------
    product : {"make", "smooth"}
    surface : Surface
        The final surface.
    request : mapping
        The request.
    grid : mapping
        Its `shape`, `spacing`, `origin` and `space`.
    solid : mapping
        `data`, the volume before smoothing, mm³, `level`, and further facts about the volume.
    data, result : ConnectionCounts
        How the solid is connected before and after smoothing.
    changes : TopologyChanges
    walls : mapping
        How thick the walls are.
    problems : sequence of str
        Problems of the result, a phrase each.
    seconds : mapping
        Seconds spent, by stage.
    simplified : mapping, optional
        Costs of simplification.
    mesh : mapping, optional
        Facts about making the surface.
    **more
        Sections that this product has in addition to the common ones.
    """
    bounds = surface.bounds
    facts = {
        "vertices": len(surface.vertices),
        "triangles": len(surface.faces),
        "closed": surface.closed,
        "area": surface.area,
        "extents": (bounds[1] - bounds[0]).tolist(),
        "bounds": bounds.tolist(),
        "euler_number": surface.euler_number,
        **(mesh or {}),
    }
    if simplified is not None:
        facts["simplified"] = dict(simplified)
    solid_facts = {"volume": surface.volume, "change": surface.volume / solid["data"] - 1, **solid}
    summary = {name: facts[name] for name in ("triangles", "closed", "area", "extents", "bounds")}
    summary |= {
        "volume": solid_facts["volume"],
        "volume_change": solid_facts["change"],
        "components": result.components,
    }
    if "density" in solid_facts:
        summary["density"] = solid_facts["density"]
    if "width" in walls:
        summary["wall_width"] = walls["width"]
    return {
        "form": FORM,
        "version": __version__,
        "product": product,
        **summary,
        "problems": list(problems),
        "request": dict(request),
        "grid": dict(grid),
        **{name: dict(section) for name, section in more.items()},
        "mesh": facts,
        "solid": solid_facts,
        "topology": {"data": asdict(data), "result": asdict(result)},
        "changes": changes.facts(),
        "walls": dict(walls),
        "seconds": {**seconds, "total": sum(seconds.values())},
    }
