"""Fill in the studio: one call of `infill.fill`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.lattices.settings import FillOptions, resolve
from infill.options.command_words import assignments
from infill.studio.equivalents import Call, join_words, plain_parameters, write_command, write_value
from infill.studio.numbers import draft_numbers, fill_numbers
from infill.studio.products import Made, Order

if TYPE_CHECKING:
    from infill.lattices.density_map import DensityMap
    from infill.studio.reading import Content
    from infill.surface import Surface

DECLARATION = FillOptions
LEFT_OUT: tuple[str, ...] = ("units", "for", "as")


def keywords(options: dict[str, Any], parameters: dict[str, Any]) -> dict[str, Any]:
    """Return options by key as keywords of `infill.fill`."""
    from infill.options.declaration import by_field, read_options

    values = by_field(FillOptions, read_options("fill", FillOptions, options))
    names = {"form": "as_", "slicer": "for_"}
    renamed = {names.get(name, name): value for name, value in values.items()}
    if "for_" in renamed:
        (renamed["for_"],) = renamed["for_"]
    return {**renamed, **plain_parameters(parameters)}


def make(order: Order) -> Made:
    """Fill a part; coarsely, draft it."""
    from infill.lattices.job import fill

    content = order.need("part")
    arguments = keywords(dict(order.options), dict(order.parameters))
    if order.coarse and (draft := _draft(order, content, arguments)) is not None:
        return draft
    result = fill(content.data, **arguments, max_memory=order.memory, progress=order.progress)
    surfaces, density = shown_surfaces(result), result.stages.density
    return Made(
        result=result,
        report=result.report,
        numbers=list(fill_numbers(result.report)),
        surfaces=surfaces,
        values=paint_density(surfaces, density),
        volume=result.report["volume"],
        more={"painted": density_range(density)},
    )


def _draft(order: Order, content: Content, arguments: dict[str, Any]) -> Made | None:
    """Draft a fill; return None for options that only the whole fill has."""
    from infill.lattices.density_map import DensityMap
    from infill.lattices.draft import DraftMemory, draft_fill
    from infill.lattices.request import check_request

    names = ("as_", "for_")
    values = {name: value for name, value in arguments.items() if name not in names}
    declared = set(FillOptions.__dataclass_fields__) - {"seed"}
    parameters = {name: values.pop(name) for name in list(values) if name not in declared}
    request = check_request(
        pattern=values.pop("pattern", "gyroid"), own=parameters, **{**values, "max_triangles": None}
    )
    if request.wall == 0 or any(region.kind is not None for region in request.regions):
        return None
    draft = draft_fill(
        content.data,
        request,
        memory=content.kept.setdefault("drafts", DraftMemory()),
        max_memory=order.memory,
        progress=order.progress,
    )
    surfaces, density = {"part": draft.part, "infill": draft.walls_inside}, DensityMap.of(draft.hollow.layout)
    return Made(
        result=None,
        report={},
        numbers=list(draft_numbers(draft)),
        surfaces=surfaces,
        values=paint_density(surfaces, density),
        volume=draft.volume,
        more={"painted": density_range(density)},
    )


def paint_density(surfaces: Mapping[str, Surface], density: DensityMap | None) -> dict[str, NDArray[np.uint8]]:
    """Return the requested density at the vertices of the walls inside: 0 where it is lowest, 255 where highest."""
    if density is None:
        return {}
    extent = max(density.highest - density.lowest, 1e-9)
    return {
        name: np.rint(255 * (density.at(surface.vertices) - density.lowest) / extent).astype(np.uint8)
        for name, surface in surfaces.items()
        if name != "part"  # whose faces may be large, with colours at their corners alone
    }


def density_range(density: DensityMap | None) -> dict[str, float] | None:
    """Return the lowest and the highest density of a part, for the legend; None where it is the same everywhere."""
    return None if density is None else {"lowest": density.lowest, "highest": density.highest}


def shown_surfaces(result: Any) -> dict[str, Surface]:  # noqa: ANN401 - a Result
    """Return the surfaces to show: the skin and the walls inside apart, where the skin is that of the part."""
    if "solid" not in result.surfaces:
        return dict(result.surfaces)
    solid, part, voids = result.surface, result.stages.part, result.stages.voids
    if len(solid.faces) != len(part.faces) + len(voids.faces):  # drains or open sides have changed the skin
        return {"solid": solid}
    return {"part": part, "infill": replace(voids, faces=voids.faces[:, ::-1])}


def for_slicer(made: Made, order: Order) -> Made:
    """Return a project for the slicer of a request: the same part and infill, whatever the slicer."""
    slicer = keywords(dict(order.options), {})["for_"]
    return replace(made, result=replace(made.result, stages=replace(made.result.stages, slicer=slicer)))


def write(made: Made, path: Path) -> None:
    """Write the file of a result."""
    if path.name.endswith(".3mf") and getattr(made.result.stages, "slicer", None):
        from infill.projects.saving import save_project

        save_project(made.result, path)
        return
    made.result.save(path)


def again(order: Order, file: str) -> dict[str, str]:
    """Return the command, the Python and the TOML that make the file of a fill again."""
    content, options = order.need("part"), dict(order.options)
    arguments = keywords(options, {})
    arguments["regions"] = tuple(region.text for region in arguments.get("regions", ()))
    named = {name: value for name, value in arguments.items() if name != "pattern" and value != ()}
    is_project = "for_" in arguments
    call = Call(
        function="fill",
        positional=(content.path, arguments.get("pattern", "gyroid")),
        keywords={**named, **plain_parameters(order.parameters)},
        imports=("save_project",) if is_project else (),
        save=f"save_project(result, {write_value(file)})" if is_project else f"result.save({write_value(file)})",
    )
    words = write_command("fill", [content.path], FillOptions, options, order.parameters)
    settings = resolve(options, list(assignments(order.parameters)))
    return {"command": join_words([*words, "-o", file]), "python": call.to_python(), "toml": settings.to_toml()}
