"""The rules by which Cura reads a 3MF."""

from __future__ import annotations

from collections.abc import Iterator

from infill.formats.threemf_roles import CURA_ROLES
from infill.projects.cura import NAMESPACE
from infill.projects.findings import Finding, PrintedVolume, as_problem, as_warning
from infill.projects.reading import Package, PackageObject

INSIDE = f"{{{NAMESPACE}}}"
NONE_OF = ("top_layers", "bottom_layers")
KEYS = {
    *CURA_ROLES,
    *NONE_OF,
    "wall_line_count",
    "extruder_nr",
    "infill_line_distance",
    "infill_line_width",
    "infill_mesh_order",
    "infill_pattern",
    "infill_sparse_density",
    "magic_mesh_surface_mode",
    "print_order",
    "wall_thickness",
    "top_thickness",
    "bottom_thickness",
}


def volumes_for_cura(package: Package) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes that Cura makes of a file, and the problems and warnings."""
    volumes: list[tuple[PackageObject, PrintedVolume]] = []
    for item in package.items:
        for leaf in package.tree(item.key).leaves if item.prints else ():
            member = leaf.body
            if member.mesh is not None and leaf.other is None:
                name = member.name or f"object {leaf.key}"
                settings = {
                    key.removeprefix(INSIDE): value for key, value in member.settings.items() if key.startswith(INSIDE)
                }
                role = next((role for key, role in CURA_ROLES.items() if settings.get(key) == "True"), "part")
                volumes.append((member, PrintedVolume.of(name, member.mesh, role, settings)))
    yield from (volume for _, volume in volumes)
    for body, volume in volumes:
        yield from _check_volume(body, volume)
    parts = [volume for _, volume in volumes if volume.prints]
    modifiers = [volume for _, volume in volumes if volume.role == "modifier"]
    if len(volumes) > 1 and len(package.items) > 1:
        yield as_warning("its objects are not in one group: moving one leaves the others where they are")
    for modifier in modifiers:
        for part in parts:
            if parse_float(part.settings.get("infill_sparse_density", "")) != 0.0:
                yield as_warning(f"{part.name} has infill of its own around {modifier.name}: its density is not 0")


def _check_volume(body: PackageObject, volume: PrintedVolume) -> Iterator[Finding]:
    """Yield findings about the settings of a volume."""
    for key, value in volume.settings.items():
        if key not in KEYS:
            yield as_warning(
                f"{key} of {volume.name} is not a setting that Cura is known to read from a file: it is ignored"
            )
        if key in CURA_ROLES and value not in ("True", "False"):
            yield as_problem(
                f"{key} of {volume.name} is {value!r}; Cura reads True or False, and takes others for False"
            )
    for key in body.settings:
        if not key.startswith(INSIDE):
            yield as_problem(
                f"{key} of {volume.name} is in no namespace of Cura's, xmlns:cura={NAMESPACE!r}: it is lost"
            )
    if volume.role == "modifier":
        if parse_float(volume.settings.get("infill_mesh_order", "")) < 1:
            yield as_problem(f"{volume.name} has no infill_mesh_order of at least 1: it is cut off by the part")
        if parse_float(volume.settings.get("wall_line_count", "")) == 0.0:
            yield as_warning(
                f"{volume.name} has no line along its sides: Cura may extrude half as much again in thin walls"
            )
        for key in NONE_OF:
            if parse_float(volume.settings.get(key, "")) != 0.0:
                yield as_warning(f"{volume.name} does not say {key} 0: skins are made on all of it")


def parse_float(text: str) -> float:
    """Parse a number; return -1 for other texts.

    >>> parse_float("3"), parse_float("three")
    (3.0, -1.0)
    """
    try:
        return float(text)
    except ValueError:
        return -1.0
