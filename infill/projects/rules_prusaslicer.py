"""The rules by which PrusaSlicer reads a 3MF."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from xml.etree import ElementTree

from infill.formats.threemf_roles import PRUSA_ROLES, object_key, prusa_role, whole_number
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
from infill.projects.prusaslicer import CONFIG
from infill.projects.reading import Package, PackageObject, metadata_of
from infill.surface import Surface

VERSION = "slic3rpe:Version3mf"
PROFILE = "Metadata/Slic3r_PE.config"
MOST_NESTED = 10  # objects in one another
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
    """Yield the volumes that PrusaSlicer makes of a file, and the problems and warnings."""
    if package.has(PROFILE):
        yield as_warning(f"it holds a print profile, {PROFILE}, which takes the place of the user's own")
    config = package.xml(CONFIG)
    configured: dict[str, ElementTree.Element] = {}
    for element in [] if config is None else config.findall("object"):
        if (number := object_key(element.get("id"))) in configured:
            yield as_problem(f"{CONFIG} describes object {number} twice: the file is not opened")
        configured[number] = element
        if number not in package.bodies:
            yield as_problem(
                f"{CONFIG} is about an object {number} that the model does not hold: its settings are lost"
            )
        elif package.bodies[number].mesh is None:
            yield as_problem(
                f"{CONFIG} is about object {number}, which has components and no mesh: its settings are lost, and "
                "an intended modifier is printed as a part"
            )
    yield from _check_opening(package)
    if config is None and len(package.items) + sum(len(body.components) for body in package.bodies.values()) > 1:
        yield as_warning(f"it has no {CONFIG}: each object is printed for itself, with the settings of the profile")
    versioned = VERSION in package.metadata
    listed: set[str] = set()
    for item in package.items:
        if item.printable and not item.prints:
            continue
        if item.printable and whole_number(item.printable.removeprefix("-")) < 1:
            yield as_problem(
                f"object {item.key} says printable={item.printable!r}; PrusaSlicer reads a number, and takes it for 0: "
                "it is not printed"
            )
            continue
        leaves = [leaf for leaf in package.tree(item.key).leaves if leaf.other is None and not leaf.covered]
        if len(leaves) > 1:
            yield as_problem(
                f"object {item.key} has components, and PrusaSlicer makes separate objects of them: they share no "
                "settings of volumes, and overlaps are printed twice"
            )
        for leaf in leaves:
            if leaf.body.mesh is None or leaf.key in listed:
                continue  # another instance
            listed.add(leaf.key)
            results = list(_read_object(leaf.body, leaf.body.mesh, configured.get(leaf.key)))
            yield from results
            moved = not item.stays or leaf.above
            if not versioned and moved and sum(isinstance(result, PrintedVolume) for result in results) > 1:
                yield as_problem(
                    f"it states no {VERSION}, and moves object {leaf.key}: only the first volume is moved; state it"
                )


def is_read(body: PackageObject) -> bool:
    """Tell whether PrusaSlicer reads an object of this type; it ignores others."""
    return body.kind in ("", "model")


def _check_opening(package: Package) -> Iterator[Finding]:
    """Yield the reasons for which PrusaSlicer does not open a file; add its message where that is misleading."""
    closed = "the file is not opened"
    if package.prefix:
        yield as_problem(
            f"its elements are called {package.prefix}:model and so on, and PrusaSlicer reads only names without a "
            f"prefix: {closed}"
        )
    for number in package.twice:
        yield as_problem(f"there are two objects {number}: {closed}")
    reached: set[str] = set()
    for item in {item.key: item for item in package.items}.values():
        tree = package.tree(item.key)
        reached.update(leaf.key for leaf in tree.leaves if not leaf.covered)
        body = package.bodies.get(item.key)
        if tree.missing and body is not None:
            yield as_problem(f"object {item.key} consists of {tree.missing[0]}, which is not there: {closed}")
        if tree.deepest > MOST_NESTED or not tree.whole:
            yield as_problem(f"object {item.key} has objects in objects, more than {MOST_NESTED} deep: {closed}")
        ignored = [member for leaf in tree.leaves for member in (*leaf.above, leaf.body) if not is_read(member)]
        for stray in dict.fromkeys(ignored):
            yield as_problem(
                f"object {stray.number} is of type {stray.kind!r}, and PrusaSlicer knows only parts, of type 'model': "
                f"{closed} (it calls that an invalid object id)"
            )
        if body is not None and body.mesh is None and not body.components:
            yield as_problem(f"object {item.key} has no triangles, and is built: {closed}")
    if not package.items:
        yield as_problem(f"it builds nothing: {closed}")
    numbers = list(package.bodies)
    for place, (key, body) in enumerate(package.bodies.items()):
        later = set(numbers[place + 1 :]).intersection(body.components)
        if later and " of /" not in "".join(later):
            yield as_problem(f"object {key} consists of {', '.join(sorted(later))}, which comes after it: {closed}")
        if body.mesh is not None and body.components:
            yield as_problem(
                f"object {key} has triangles and components, of which PrusaSlicer reads the triangles alone"
            )
        if body.mesh is not None and len(body.mesh.faces) and is_read(body) and key not in reached:
            yield as_problem(f"object {key} is not built and is not part of a built object: {closed}")
    if any(" of /" in key for key in reached):
        yield as_problem("it has objects in files of their own, which PrusaSlicer reads from 2.9 on and 2.5 does not")


def _read_object(
    body: PackageObject, mesh: Surface, configured: ElementTree.Element | None
) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes of an object."""
    object_name = body.name or f"object {body.number}"
    if configured is None:
        yield PrintedVolume.of(object_name, mesh, "part", {})
        return
    volumes: list[PrintedVolume] = []
    covered = 0
    yield from _check_rows(configured, "object")
    common = {key: value for key, value in metadata_of(configured).items() if key not in RESERVED}
    for element in configured.findall("volume"):
        low, high = (whole_number(element.get(name)) for name in ("firstid", "lastid"))
        rows = metadata_of(element)
        name = rows.get("name", "") or f"volume {len(volumes) + 1}"
        yield from _check_rows(element, "volume")
        if not 0 <= low <= high < len(mesh.faces):
            yield as_problem(
                f"{name} has the triangles {element.get('firstid')} to {element.get('lastid')}, and the object "
                f"{len(mesh.faces):,} from 0 on: the file is not opened"
            )
            continue
        covered += high - low + 1
        kind = rows.get("volume_type", "ModelPart")
        if kind not in PRUSA_ROLES and kind != "1":
            yield as_problem(
                f"{name} is a {kind!r}, which PrusaSlicer takes for a part; it knows {', '.join(PRUSA_ROLES)}"
            )
        settings = {key: value for key, value in rows.items() if key not in RESERVED}
        part = replace(mesh, faces=mesh.faces[low : high + 1])
        volumes.append(PrintedVolume.of(name, part, prusa_role(element), settings))
        yield from check_fill_settings(name, settings, "fill_density", KEYS, "PrusaSlicer")
        yield from _check_full_density(name, {**common, **settings})
    yield from volumes
    if covered < len(mesh.faces):
        yield as_problem(
            f"{len(mesh.faces) - covered:,} triangles of {object_name} are in no volume: they are left out"
        )
    yield from check_order(volumes)
    shell_keys = ("fill_density", "solid_infill_below_area")
    yield from check_shells(volumes, common, shell_keys, "PrusaSlicer", "prusaslicer")
    yield from check_modifier_walls(volumes, WALL_KEYS["PrusaSlicer"])


def _check_full_density(name: str, settings: Mapping[str, str]) -> Iterator[Finding]:
    """Yield a problem if a pattern cannot have a density of 100 %."""
    pattern = settings.get("fill_pattern")
    if settings.get("fill_density") == "100%" and pattern is not None and pattern not in FULL_PATTERNS:
        yield as_problem(
            f"fill_pattern of {name} is {pattern}, which PrusaSlicer refuses at 100%; use one of "
            f"{', '.join(sorted(FULL_PATTERNS))}"
        )


def _check_rows(element: ElementTree.Element, kind: str) -> Iterator[Finding]:
    """Yield the rows without a type; they end the reading of the file."""
    for row in element.findall("metadata"):
        if row.get("type") != kind:
            yield as_problem(f'{CONFIG} has a row {row.get("key")!r} without type="{kind}": the file is not opened')
