"""Fill in the studio: one call of `infill.fill`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.lattices.settings import FillOptions
from infill.studio.numbers import fill_numbers
from infill.studio.products import Made, Order

if TYPE_CHECKING:
    from infill.surface import Surface

DECLARATION = FillOptions
LEFT_OUT = ("units", "for", "as")
COARSE_CELLS = 64  # along the longest side of the part
COARSE_TRIANGLES = 60_000


def keywords(options: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    """Return options by key as keywords of `infill.fill`."""
    from infill.options.declaration import by_field, read_options

    values = by_field(FillOptions, read_options("fill", FillOptions, options))
    names = {"form": "as_", "slicer": "for_"}
    renamed = {names.get(name, name): value for name, value in values.items()}
    if "for_" in renamed:
        (renamed["for_"],) = renamed["for_"]
    return {**renamed, **own}


def make(order: Order) -> Made:
    """Fill a part; a coarse one on a coarser grid, and with all triangles."""
    from infill.lattices.job import fill

    content = order.need("part")
    arguments = keywords(dict(order.options), dict(order.own))
    if order.coarse:
        arguments = coarsen(arguments, content.data)
    result = fill(content.data, **arguments, max_memory=order.memory, progress=order.progress)
    return Made(
        result=result,
        report=result.report,
        numbers=list(fill_numbers(result.report)),
        surfaces=shown_surfaces(result),
        volume=result.report["volume"],
    )


def coarsen(arguments: dict[str, Any], part: Surface) -> dict[str, Any]:
    """Return arguments for a quick look: larger voxels, unless they are requested, and no simplification."""
    quick = {"tolerance": 0.0, **{name: value for name, value in arguments.items() if name != "max_triangles"}}
    quick["tolerance"] = 0.0
    if "resolution" not in quick and "voxel" not in quick:
        quick["voxel"] = float(np.ptp(part.bounds, axis=0).max()) / COARSE_CELLS
    return quick


def shown_surfaces(result: Any) -> dict[str, Surface]:  # noqa: ANN401 - a Result
    """Return the surfaces to show: the skin and the walls inside apart, where the skin is that of the part."""
    if "solid" not in result.surfaces:
        return dict(result.surfaces)
    solid, part, voids = result.surface, result.stages.part, result.stages.voids
    if len(solid.faces) != len(part.faces) + len(voids.faces):  # drains or open sides have changed the skin
        return {"solid": solid}
    return {"part": part, "infill": replace(voids, faces=voids.faces[:, ::-1])}


def write(made: Made, path: Path) -> None:
    """Write the file of a result."""
    if path.name.endswith(".3mf") and getattr(made.result.stages, "slicer", None):
        from infill.projects.saving import save_project

        save_project(made.result, path)
        return
    made.result.save(path)
