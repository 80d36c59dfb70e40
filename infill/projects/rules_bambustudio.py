"""The rules by which Bambu Studio and OrcaSlicer read a 3MF."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree

from infill.formats.threemf_roles import BAMBU_ROLES, object_key
from infill.projects.bambustudio import CONFIG
from infill.projects.findings import (
    WALL_KEYS,
    Finding,
    PrintedVolume,
    as_problem,
    as_warning,
    check_fill_settings,
    check_modifier_walls,
    check_order,
    check_shells,
)
from infill.projects.project import NAMES
from infill.projects.reading import ObjectTree, Package, PackageObject, metadata_of

READ_TYPES = ("model", "other")  # of objects: the second is how modifiers are marked for other programs
RESERVED = {
    "name",
    "matrix",
    "extruder",
    "source_file",
    "source_object_id",
    "source_volume_id",
    "source_offset_x",
    "source_offset_y",
    "source_offset_z",
    "source_in_inches",
    "source_in_meters",
}
# Applications that a file must name for the settings of its objects to be kept.
KEPT_FROM = {"bambustudio": ("BambuStudio-",), "orcaslicer": ("BambuStudio-", "OrcaSlicer-")}
KEYS = WALL_KEYS["Bambu"] | {
    "bottom_shell_layers",
    "bottom_shell_thickness",
    "bottom_surface_pattern",
    "bridge_flow",
    "enable_support",
    "ensure_vertical_shell_thickness",
    "infill_combination",
    "infill_direction",
    "internal_solid_infill_line_width",
    "internal_solid_infill_pattern",
    "internal_solid_infill_speed",
    "ironing_type",
    "minimum_sparse_infill_area",
    "sparse_infill_anchor",
    "sparse_infill_anchor_max",
    "sparse_infill_density",
    "sparse_infill_filament",
    "sparse_infill_line_width",
    "sparse_infill_pattern",
    "sparse_infill_speed",
    "top_shell_layers",
    "top_shell_thickness",
    "top_surface_pattern",
}


def volumes_for_bambustudio(package: Package, slicer: str) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes that one of the two slicers makes of a file, and the problems and warnings."""
    who, application = NAMES[slicer], package.metadata.get("Application", "")
    config = package.xml(CONFIG)
    configured = {} if config is None else {object_key(row.get("id")): row for row in config.findall("object")}
    built = {item.key for item in package.items}
    if "PrusaSlicer" in application:
        yield as_problem(f"it says that PrusaSlicer wrote it: {who} reads it as such, and drops every setting")
    elif config is not None and not application.startswith(KEPT_FROM[slicer]):
        only = " or ".join(prefix.rstrip("-") for prefix in KEPT_FROM[slicer])
        yield as_problem(
            f"it says that {application or 'nobody'} wrote it, and {who} keeps the settings of objects only from files "
            f"of {only}; make it again with --for {slicer}"
        )
    if config is None and len(package.bodies) > 1:
        yield as_warning(f"it has no {CONFIG}: every part is filled as the profile says")
    for number in configured:
        if number not in built:
            yield as_problem(f"{CONFIG} is about an object {number} that is not built: its settings are lost")
    for item in package.items:
        body = package.bodies.get(item.key)
        if body is not None and item.prints:
            yield from _read_object(package.tree(item.key), body, configured.get(item.key), slicer)


def _read_object(
    tree: ObjectTree, body: PackageObject, configured: ElementTree.Element | None, slicer: str
) -> Iterator[PrintedVolume | Finding]:
    """Yield the parts of an object."""
    who = NAMES[slicer]
    rows = {} if configured is None else metadata_of(configured)
    common = {key: value for key, value in rows.items() if key not in RESERVED}
    parts = {} if configured is None else {object_key(row.get("id")): row for row in configured.findall("part")}
    ids = {leaf.body.number for leaf in tree.leaves}
    for number in parts:
        if number not in ids:
            yield as_problem(
                f"{CONFIG} is about a part {number}, and object {body.number} consists of {', '.join(sorted(ids))}: "
                "the settings are lost, and an intended modifier is printed as a part"
            )
    volumes: list[PrintedVolume] = []
    for leaf in tree.leaves:
        member, not_a_part = leaf.body, leaf.other
        if member.mesh is None or (not_a_part is not None and not_a_part.kind not in READ_TYPES):
            continue
        number = member.number
        part = parts.get(number)
        rows = {} if part is None else metadata_of(part)
        name = rows.get("name", "") or member.name or f"part {number}"
        kind = "normal_part" if part is None else part.get("subtype", "normal_part")
        if kind not in BAMBU_ROLES:
            yield as_problem(f"{name} is a {kind!r}; {who} knows {', '.join(BAMBU_ROLES)}")
        settings = {key: value for key, value in rows.items() if key not in RESERVED}
        volumes.append(PrintedVolume.of(name, member.mesh, BAMBU_ROLES.get(kind, kind), settings))
        yield from check_fill_settings(name, settings, "sparse_infill_density", KEYS, who)
    yield from volumes
    yield from check_order(volumes)
    shell_keys = ("sparse_infill_density", "minimum_sparse_infill_area")
    yield from check_shells(volumes, common, shell_keys, who, slicer)
    yield from check_modifier_walls(volumes, WALL_KEYS["Bambu"])
