"""The volumes of a 3MF where components and transforms place them, each with its role."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import wrap_reader_errors
from infill.files.excerpts import excerpt
from infill.formats.threemf_extensions import check_required, is_harmless, name_of
from infill.formats.threemf_package import (
    EXPORT_ADVICE,
    IDENTITY,
    Model,
    Transform,
    compose_transforms,
    entries_by_key,
    parse_transform,
    parse_xml,
    part_key,
    read_entry,
    read_model,
    start_part,
)
from infill.formats.threemf_roles import (
    BAMBU_CONFIG,
    MODIFIER,
    NEGATIVE,
    NONE,
    PART,
    TriangleRange,
    bambu_parts,
    cura_role,
    cura_settings,
    is_part_type,
    object_key,
    prusa_volumes,
    settings_of,
    slic3r_volumes,
    whole_number,
)
from infill.formats.volume_settings import VolumeSettings, find_pattern, parse_project_settings, read_settings
from infill.imaging.label_tables import Colour
from infill.meshes.merging import merge_unless_closed
from infill.meshes.solids import subtract
from infill.plain_numbers import count_noun
from infill.surface import Modifier, Surface

MODEL = "3D/3dmodel.model"
MOST_PLACED = 100_000  # objects: nested components can request any number in a few lines
MOST_PLACED_ROWS = 100_000_000  # triangles and vertices
MOST_NESTED = 20  # components in one another
COLOUR = re.compile("#([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})(?:[0-9a-fA-F]{2})?")
PROJECT_CONFIGS = re.compile(r"metadata/(slic3r_pe|superslicer|project_settings)\.config")  # of whole projects
PRUSA_CONFIGS = re.compile(r"metadata/[^/]*_model\.config")  # of PrusaSlicer and its forks

Key = tuple[str, str]  # a file of the package, and the number of an object in it


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedVolume:
    """A volume in its place in the build.

    Parameters
    ----------
    surface : Surface
        In the unit of the file.
    role : {"part", "negative"}
    name : str
    scope : int
        Negative volumes are subtracted from earlier parts of the same scope.
    title : str
        Its own name in the file; empty for none.
    colour : (red, green, blue), optional
        Of its base material, from 0 to 1, sRGB.
    """

    surface: Surface
    role: str
    name: str
    scope: int
    title: str = ""
    colour: Colour | None = None


@dataclass(kw_only=True, eq=False)
class PackageReading:
    """A package that is read: its models, each parsed when first needed, the notes, and the modifiers it places."""

    path: Path
    package: zipfile.ZipFile
    notes: dict[str, None] = field(default_factory=dict)
    modifiers: list[Modifier] = field(default_factory=list)
    models: dict[str, Model] = field(default_factory=dict)
    objects: dict[str, dict[str, ElementTree.Element]] = field(default_factory=dict)
    placements: int = 0
    rows: int = 0

    @cached_property
    def parts(self) -> dict[str, zipfile.ZipInfo]:
        """The members of the archive by their case-insensitive names."""
        return entries_by_key(self.package)

    @cached_property
    def main(self) -> str:
        """File name of the model that is built."""
        start = start_part(self.package)
        if start in self.parts:
            return start
        names = [name for name in self.parts if name.endswith(".model")]
        return next((name for name in names if next(self.model(name).items, None) is not None), "")

    def model(self, part: str) -> Model:
        """Return a model, parsed and checked."""
        if part not in self.models:
            with wrap_reader_errors(self.path, "is not a 3MF file", EXPORT_ADVICE):
                model = read_model(self.package, self.parts[part], self.path)
            check_required(model, str(self.path))
            self.models[part] = model
        return self.models[part]

    def find(self, part: str, number: str) -> ElementTree.Element | None:
        """Return an object by its file and number, or None."""
        if part not in self.parts:
            return None
        if part not in self.objects:
            objects_of_part: dict[str, ElementTree.Element] = {}
            for element in self.model(part).objects:
                key = object_key(element.get("id"))
                if key in objects_of_part:
                    raise FormatError(f"{self.path} holds two objects {excerpt(key)}; {EXPORT_ADVICE}")
                objects_of_part[key] = element
            self.objects[part] = objects_of_part
        return self.objects[part].get(number)

    @cached_property
    def project(self) -> dict[str, str]:
        """The settings of the whole project by key."""
        texts = (self.package.read(self.parts[name]) for name in sorted(self.parts) if PROJECT_CONFIGS.fullmatch(name))
        settings: dict[str, str] = {}
        for text in texts:
            settings = {**parse_project_settings(text.decode("utf-8", "replace")), **settings}
        return settings

    @cached_property
    def prusa(self) -> dict[str, list[TriangleRange]]:
        """Volumes by object in the settings of PrusaSlicer and its relatives."""
        volumes: dict[str, list[TriangleRange]] = {}
        for name in sorted(self.parts):
            if PRUSA_CONFIGS.fullmatch(name):
                with wrap_reader_errors(self.path, f"has a broken {excerpt(name)}", EXPORT_ADVICE):
                    config = parse_xml(self.package.read(self.parts[name]), self.path)
                    volumes = {**prusa_volumes(config, self.project), **volumes}
        return volumes

    @cached_property
    def bambu(self) -> dict[str, dict[str, tuple[str, str, VolumeSettings]]]:
        """Roles of parts by object in the settings of Bambu Studio and OrcaSlicer."""
        if part_key(BAMBU_CONFIG) not in self.parts:
            return {}
        with wrap_reader_errors(self.path, f"has a broken {BAMBU_CONFIG}", EXPORT_ADVICE):
            return bambu_parts(parse_xml(read_entry(self.package, BAMBU_CONFIG), self.path), self.project)

    def stated_role(self, chain: tuple[Key, ...]) -> tuple[str, str, VolumeSettings]:
        """Return role, name and settings of an object in the build by Bambu Studio and OrcaSlicer.

        They write every object except parts with the type "other", so for a negative volume the role counts.
        """
        (top_part, top), (_, number) = chain[0], chain[-1]
        is_part = PART, "", NONE
        return self.bambu.get(top, {}).get(number, is_part) if top_part == self.main else is_part

    def note(self, text: str) -> None:
        """Add a note, once."""
        self.notes[text] = None

    def reference(self, element: ElementTree.Element, part: str) -> Key:
        """Return the object that an item or a component refers to; the production extension allows other files."""
        path = next((value for key, value in element.items() if key.endswith("}path")), None)
        return (part if path is None else part_key(path)), object_key(element.get("objectid"))

    def placed(self, key: Key, outer: Transform, above: tuple[Key, ...] = ()) -> Iterator[PlacedVolume]:
        """Yield the volumes of an object and of its components, depth first."""
        part, number = key
        self.placements += 1
        element, name = self.find(part, number), f"object {excerpt(number)}"
        if element is None:
            raise FormatError(f"{self.path} refers to an {name} that it does not hold; {EXPORT_ADVICE}")
        if key in above:
            raise FormatError(f"{self.path} refers to an {name} that holds itself; {EXPORT_ADVICE}")
        if len(above) > MOST_NESTED:
            raise FormatError(f"{self.path} has objects in objects, more than {MOST_NESTED} deep; {EXPORT_ADVICE}")
        if self.placements > MOST_PLACED:
            raise FormatError(f"{self.path} places its objects more than {MOST_PLACED:,} times; {EXPORT_ADVICE}")
        model, chain = self.model(part), (*above, key)
        model_unit, build_unit = model.root.get("unit"), self.model(self.main).root.get("unit", "millimeter")
        if model_unit is not None and model_unit != build_unit:  # programs disagree on which of them counts
            self.note(f"{excerpt(part)} is in {excerpt(model_unit)}, and read in {build_unit}, as what is built says")
        if (element_name := element.get("name")) and excerpt(element_name):
            name = f"{name} '{excerpt(element_name)}'"
        told, _, told_settings = self.stated_role(chain)
        is_modifier = told == MODIFIER and told_settings.is_any
        if not is_part_type(element.get("type")) and told != NEGATIVE and not is_modifier:
            self.note(f"{name} is of type '{excerpt(element.get('type', ''))}', not a part: it is left out")
            return
        settings = settings_of(element, model.core, model.spaces)
        if (role := cura_role(settings)) != PART:
            mesh = (model.mesh_of(element) or (None, None))[1]
            surface = None if mesh is None or mesh.fault else self._place(mesh.vertices, mesh.faces, outer)
            self._leave_out(name, role, read_settings(cura_settings(settings)), surface)
            return
        self._note_extensions(model, element, name)
        if model.mesh_of(element) is not None:
            yield from self._volumes(model, element, name, chain, outer)
        for component in model.descendants(element, "components/component"):
            inner = parse_transform(component.get("transform", IDENTITY))
            yield from self.placed(self.reference(component, part), compose_transforms(inner, outer), chain)

    def _volumes(
        self, model: Model, item: ElementTree.Element, name: str, chain: tuple[Key, ...], outer: Transform
    ) -> Iterator[PlacedVolume]:
        """Yield the volumes of the mesh of an object."""
        part, number = chain[-1]
        element, mesh = model.mesh_of(item) or (item, None)
        assert mesh is not None
        if mesh.fault:
            raise FormatError(f"{self.path} has {mesh.fault}; {EXPORT_ADVICE}")
        self._count_rows(len(mesh.faces) + len(mesh.vertices))
        role, role_name, settings = self.stated_role(chain)
        if role_name and excerpt(role_name):
            name = f"object {excerpt(number)} '{excerpt(role_name)}'"
        placed = self._place(mesh.vertices, mesh.faces, outer)
        if role not in (PART, NEGATIVE):
            self._leave_out(name, role, settings, placed)
            return
        vertices, faces = placed.vertices, placed.faces
        ranges = [] if part != self.main and self.find(self.main, number) is not None else self.prusa.get(number, [])
        ranges = ranges or slic3r_volumes(element)
        scope = 0 if role == NEGATIVE or not ranges else self.placements
        title, colour = role_name or item.get("name", ""), base_colour(model, item)
        if role == NEGATIVE or not ranges:
            if len(faces):
                yield PlacedVolume(
                    surface=placed,
                    role=role,
                    name=name,
                    scope=scope,
                    title=title,
                    colour=colour,
                )
            return
        covered = np.zeros(len(faces), dtype=bool)
        for volume in ranges:
            triangle_range = volume.span(len(faces))
            if triangle_range is None:
                raise FormatError(
                    f"{self.path} has a volume of triangles {excerpt(volume.first)} to {excerpt(volume.last)} of "
                    f"{name}, which has {len(faces):,} from 0 on; {EXPORT_ADVICE}"
                )
            covered[slice(*triangle_range)] = True
            self._count_rows(triangle_range[1] - triangle_range[0])
            label = f"volume '{excerpt(volume.name)}'" if excerpt(volume.name) else "a volume"
            label = f"{label} of {name}"
            vertex_indices, corners = np.unique(faces[slice(*triangle_range)], return_inverse=True)
            surface = Surface(vertices=vertices[vertex_indices], faces=corners.reshape(-1, 3))
            if volume.role in (PART, NEGATIVE):
                yield PlacedVolume(
                    surface=surface,
                    role=volume.role,
                    name=label,
                    scope=scope,
                    title=volume.name or title,
                    colour=colour,
                )
            else:
                self._leave_out(label, volume.role, volume.settings, surface)
        if not covered.all():
            self.note(f"left out {count_noun(int((~covered).sum()), 'triangle')} of {name} that no volume of it covers")

    def _place(self, vertices: NDArray[np.floating], faces: NDArray[np.integer], outer: Transform) -> Surface:
        """Return a mesh where a transform places it."""
        # A mirrored part would face inwards: its corners are taken in reverse order.
        outwards = faces[:, :: -1 if np.linalg.det(outer[:3]) < 0 else 1]
        return Surface(vertices=vertices @ outer[:3] + outer[3], faces=outwards)

    def _leave_out(self, name: str, role: str, settings: VolumeSettings, surface: Surface | None) -> None:
        """Note a volume that is not a part; keep a modifier with settings of infill or walls."""
        if role != MODIFIER or not settings.is_any or surface is None or not len(surface.faces):
            self.note(f"{name} is a {role}, not a part: it is left out")
            return
        self.note(f"{name} is a modifier with {settings.text}, not a part: only 'infill fill' uses it")
        pattern = None if settings.pattern is None else find_pattern(settings.pattern)
        self.modifiers.append(
            Modifier(
                name=name,
                surface=surface,
                density=settings.density,
                pattern=pattern,
                slicer_pattern=settings.pattern,
                wall=settings.wall,
            )
        )

    def _count_rows(self, rows: int) -> None:
        """Count triangles and vertices that are placed, or raise FormatError."""
        self.rows += rows
        if self.rows > MOST_PLACED_ROWS:
            raise FormatError(
                f"{self.path} places more than {MOST_PLACED_ROWS:,} triangles and vertices; {EXPORT_ADVICE}"
            )

    def _note_extensions(self, model: Model, item: ElementTree.Element, name: str) -> None:
        """Add a note on each extension that describes the shape of an object and is not read."""
        mesh_element = model.mesh_of(item)
        for element in (item, *(() if mesh_element is None else (mesh_element[0],))):
            for namespace, _ in model.foreign(element):
                if not is_harmless(namespace):
                    self.note(f"{name} has {name_of(namespace)}, which are not read: they are left out")
        if any(key.endswith("}meshresolution") and value == "lowres" for key, value in item.items()):
            self.note(f"{name} has a mesh of low resolution beside its slices, which are left out")

    def without_negatives(self, volumes: Sequence[PlacedVolume]) -> Iterator[PlacedVolume]:
        """Yield the parts of the build, minus the negative volumes that follow them."""
        negatives = [number for number, volume in enumerate(volumes) if volume.role == NEGATIVE]
        if not negatives:
            yield from volumes
            return
        low, high = zip(*(volume.surface.bounds for volume in volumes), strict=True)
        used_cutters = set()
        for number, part in enumerate(volumes):
            if part.role != PART:
                continue
            cutters = [
                cutter
                for cutter in negatives
                if cutter > number
                and volumes[cutter].scope in (0, part.scope)
                and (low[cutter] < high[number]).all()
                and (low[number] < high[cutter]).all()
            ]
            used_cutters.update(cutters)
            if not cutters:
                yield part
                continue
            remainder = subtract(_outward(part.surface), [_outward(volumes[cutter].surface) for cutter in cutters])
            if remainder is None:
                raise FormatError(
                    f"{self.path} takes the negative {volumes[cutters[0]].name} off {part.name}, and one of them is "
                    "not closed; repair them in the slicer, or export the part as an STL without it"
                )
            if len(remainder.faces):
                yield replace(part, surface=remainder)
        for number, volume in enumerate(volumes):
            if volume.role == NEGATIVE:
                outcome = "it is taken off" if number in used_cutters else "it meets no part before it"
                self.note(f"{volume.name} is a negative volume: {outcome}")


def base_colour(model: Model, element: ElementTree.Element) -> Colour | None:
    """Return the colour of the base material of an object; None without one, or if it is not #RRGGBB."""
    group, number = element.get("pid"), whole_number(element.get("pindex", "0"))
    for materials in model.descendants(model.root, "resources/basematerials"):
        if group is not None and materials.get("id") == group:
            bases = list(model.descendants(materials, "base"))
            text = bases[number].get("displaycolor", "") if 0 <= number < len(bases) else ""
            found = COLOUR.fullmatch(text.strip())
            if found is not None:
                red, green, blue = (int(channel, 16) / 255 for channel in found.groups())
                return red, green, blue
    return None


def _outward(surface: Surface) -> Surface:
    """Return a volume that faces outwards; slicers reverse inverted volumes in the same way."""
    closed = merge_unless_closed(surface.vertices, surface.faces)
    return closed if closed.volume >= 0 else replace(closed, faces=closed.faces[:, ::-1])
