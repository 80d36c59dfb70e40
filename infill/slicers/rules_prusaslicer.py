"""How PrusaSlicer reads a 3MF."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from xml.etree import ElementTree

from infill.slicers.findings import (
    WALL_KEYS,
    Finding,
    PrintedVolume,
    as_problem,
    as_warning,
    check_shells,
    in_order,
    of_filling,
    with_walls,
)
from infill.slicers.prusaslicer import CONFIG
from infill.slicers.reading import Body, Package, rows_of
from infill.surface import Surface

VERSION = "slic3rpe:Version3mf"
PROFILE = "Metadata/Slic3r_PE.config"
ROLES = {
    "ModelPart": "part",
    "ParameterModifier": "modifier",
    "NegativeVolume": "negative",
    "SupportEnforcer": "support enforcer",
    "SupportBlocker": "support blocker",
}
RESERVED = {
    "name",
    "modifier",
    "volume_type",
    "matrix",
    "source_file",
    "source_object_id",
    "source_volume_id",
    "source_offset_x",
    "source_offset_y",
    "source_offset_z",
    "source_in_inches",
    "source_in_meters",
    "source_is_builtin_volume",
}
FULL_PATTERNS = {  # that may have a density of 100 %
    "rectilinear",
    "monotonic",
    "monotoniclines",
    "alignedrectilinear",
    "concentric",
    "hilbertcurve",
    "archimedeanchords",
    "octagramspiral",
}
KEYS = WALL_KEYS["PrusaSlicer"] | {
    "bottom_fill_pattern",
    "bottom_solid_layers",
    "bottom_solid_min_thickness",
    "bridge_angle",
    "bridge_flow_ratio",
    "bridge_speed",
    "ensure_vertical_shell_thickness",
    "extruder",
    "fill_angle",
    "fill_density",
    "fill_pattern",
    "fuzzy_skin",
    "fuzzy_skin_point_dist",
    "fuzzy_skin_thickness",
    "infill_anchor",
    "infill_anchor_max",
    "infill_every_layers",
    "infill_extruder",
    "infill_extrusion_width",
    "infill_speed",
    "ironing",
    "ironing_flowrate",
    "ironing_spacing",
    "ironing_speed",
    "ironing_type",
    "small_perimeter_speed",
    "solid_infill_below_area",
    "solid_infill_every_layers",
    "solid_infill_extruder",
    "solid_infill_extrusion_width",
    "solid_infill_speed",
    "top_fill_pattern",
    "top_infill_extrusion_width",
    "top_solid_infill_speed",
    "top_solid_layers",
    "top_solid_min_thickness",
    "wipe_into_infill",
}


def volumes_for_prusaslicer(package: Package) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes that PrusaSlicer makes of a file, and what it loses."""
    if PROFILE in package.names:
        yield as_warning(f"it holds a print profile, {PROFILE}, which takes the place of the user's own")
    config = package.xml(CONFIG)
    told = {} if config is None else {each.get("id", ""): each for each in config.findall("object")}
    for number in told:
        if number not in package.bodies:
            yield as_problem(
                f"{CONFIG} is about an object {number} that the model does not hold: its settings are lost"
            )
    if config is None and len(package.built) + sum(len(body.components) for body in package.bodies.values()) > 1:
        yield as_warning(f"it has no {CONFIG}: each object is printed for itself, with the settings of the profile")
    versioned = VERSION in package.metadata
    for number, stays in package.built:
        body = package.bodies.get(number)
        if body is None:
            continue
        if body.components:
            yield as_problem(
                f"object {number} has components, of which PrusaSlicer makes objects of their own: no settings of "
                "volumes, and what they have in common is printed twice"
            )
            for each in body.components:
                if (part := package.bodies.get(each)) is not None and part.mesh is not None:
                    yield PrintedVolume.of(part.name or f"object {each}", part.mesh, "part", {})
        elif body.mesh is not None:
            found = list(_of_object(body, body.mesh, told.get(number)))
            yield from found
            if not versioned and not stays and sum(isinstance(each, PrintedVolume) for each in found) > 1:
                yield as_problem(
                    f"it says no {VERSION}, and moves object {number}: only the first volume is moved; say it"
                )


def _of_object(body: Body, mesh: Surface, told: ElementTree.Element | None) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes of an object."""
    whole = body.name or f"object {body.number}"
    if told is None or told.find("volume") is None:
        yield PrintedVolume.of(whole, mesh, "part", {})
        return
    volumes: list[PrintedVolume] = []
    covered = 0
    yield from _metadata(told, "object")
    common = {key: value for key, value in rows_of(told).items() if key not in RESERVED}
    for each in told.findall("volume"):
        first, last = (_whole(each.get(name)) for name in ("firstid", "lastid"))
        rows = rows_of(each)
        name = rows.get("name", "") or f"volume {len(volumes) + 1}"
        yield from _metadata(each, "volume")
        if not 0 <= first <= last < len(mesh.faces):
            yield as_problem(
                f"{name} has the triangles {each.get('firstid')} to {each.get('lastid')}, and the object "
                f"{len(mesh.faces):,} from 0 on: the file is not opened"
            )
            continue
        covered += last - first + 1
        kind = rows.get("volume_type", "ParameterModifier" if rows.get("modifier") == "1" else "ModelPart")
        if kind not in ROLES:
            yield as_problem(f"{name} is a {kind!r}; PrusaSlicer knows {', '.join(ROLES)}")
        own = {key: value for key, value in rows.items() if key not in RESERVED}
        part = replace(mesh, faces=mesh.faces[first : last + 1])
        volumes.append(PrintedVolume.of(name, part, ROLES.get(kind, kind), own))
        yield from of_filling(name, own, "fill_density", KEYS, "PrusaSlicer")
        yield from _at_full_density(name, {**common, **own})
    yield from volumes
    if covered < len(mesh.faces):
        yield as_problem(f"{len(mesh.faces) - covered:,} triangles of {whole} are in no volume: they are left out")
    yield from in_order(volumes)
    shell_keys = ("fill_density", "solid_infill_below_area")
    yield from check_shells(volumes, common, shell_keys, "PrusaSlicer", "prusaslicer")
    yield from with_walls(volumes, WALL_KEYS["PrusaSlicer"])


def _at_full_density(name: str, settings: Mapping[str, str]) -> Iterator[Finding]:
    """Say which pattern cannot be as dense as that."""
    pattern = settings.get("fill_pattern")
    if settings.get("fill_density") == "100%" and pattern is not None and pattern not in FULL_PATTERNS:
        yield as_problem(
            f"fill_pattern of {name} is {pattern}, which PrusaSlicer refuses at 100%; use one of "
            f"{', '.join(sorted(FULL_PATTERNS))}"
        )


def _metadata(element: ElementTree.Element, kind: str) -> Iterator[Finding]:
    """Say which rows have no type, which ends the reading of the file."""
    for each in element.findall("metadata"):
        if each.get("type") != kind:
            yield as_problem(f'{CONFIG} has a row {each.get("key")!r} without type="{kind}": the file is not opened')


def _whole(text: str | None) -> int:
    return int(text) if text is not None and text.isascii() and text.isdigit() else -1
