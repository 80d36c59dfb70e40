"""`read_3mf`: the parts that a 3MF builds, and notes on what is left out of it or taken off."""

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
from infill.files.broken import told_broken
from infill.files.excerpts import excerpt
from infill.formats.threemf_extensions import check_required, is_harmless, name_of
from infill.formats.threemf_package import (
    AGAIN,
    FARTHEST,
    Model,
    opened,
    parsed_xml,
    part_key,
    parts_of_package,
    read_model,
    unpacked,
)
from infill.formats.threemf_roles import (
    BAMBU_CONFIG,
    NEGATIVE,
    PART,
    Volume,
    bambu_parts,
    cura_role,
    is_part_type,
    is_unprinted,
    object_key,
    prusa_volumes,
    settings_of,
    slic3r_volumes,
)
from infill.meshes.merging import closed_or_merged
from infill.meshes.solids import without
from infill.surface import Surface

UNITS = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"
MODEL = "3D/3dmodel.model"
RELATIONS = "_rels/.rels"
MOST_PLACED = 100_000  # objects: components of components may say any number in a few lines
MOST_PLACED_ROWS = 100_000_000  # triangles and vertices
MOST_NESTED = 20  # components in one another
MOST_NOTES = 20
PRUSA_CONFIGS = re.compile(r"metadata/[^/]*_model\.config")  # of PrusaSlicer, and of what was made of it

Key = tuple[str, str]  # a file of the package, and the number of an object in it
Transform = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Placed:
    """A volume where it is built.

    Parameters
    ----------
    surface : Surface
        In the unit of the file.
    role : {"part", "negative"}
    name : str
    scope : int
        Negative volumes are taken off parts of the same scope that come before them.
    """

    surface: Surface
    role: str
    name: str
    scope: int


@dataclass(kw_only=True, eq=False)
class _Reading:
    """A package that is read: its models, each parsed once it is needed, and what there is to note."""

    path: Path
    package: zipfile.ZipFile
    notes: dict[str, None] = field(default_factory=dict)
    models: dict[str, Model] = field(default_factory=dict)
    objects: dict[str, dict[str, ElementTree.Element]] = field(default_factory=dict)
    placements: int = 0
    rows: int = 0

    @cached_property
    def parts(self) -> dict[str, zipfile.ZipInfo]:
        return parts_of_package(self.package)

    @cached_property
    def main(self) -> str:
        """The model that is built."""
        start = start_part(self.package)
        if start in self.parts:
            return start
        names = [name for name in self.parts if name.endswith(".model")]
        return next((name for name in names if next(self.model(name).items, None) is not None), "")

    def model(self, part: str) -> Model:
        if part not in self.models:
            with told_broken(self.path, "is not a 3MF file", AGAIN):
                model = read_model(self.package, self.parts[part], self.path)
            check_required(model, str(self.path))
            self.models[part] = model
        return self.models[part]

    def find(self, part: str, number: str) -> ElementTree.Element | None:
        """Return an object by its file and number, or None."""
        if part not in self.parts:
            return None
        if part not in self.objects:
            found: dict[str, ElementTree.Element] = {}
            for each in self.model(part).objects:
                key = object_key(each.get("id"))
                if key in found:
                    raise FormatError(f"{self.path} holds two objects {excerpt(key)}; {AGAIN}")
                found[key] = each
            self.objects[part] = found
        return self.objects[part].get(number)

    @cached_property
    def prusa(self) -> dict[str, list[Volume]]:
        """Volumes by object, as PrusaSlicer and its relatives say."""
        found: dict[str, list[Volume]] = {}
        for name in sorted(self.parts):
            if PRUSA_CONFIGS.fullmatch(name):
                with told_broken(self.path, f"has a broken {excerpt(name)}", AGAIN):
                    found = {**prusa_volumes(parsed_xml(self.package.read(self.parts[name]), self.path)), **found}
        return found

    @cached_property
    def bambu(self) -> dict[str, dict[str, tuple[str, str]]]:
        """Roles of parts by object, as Bambu Studio and OrcaSlicer say."""
        if part_key(BAMBU_CONFIG) not in self.parts:
            return {}
        with told_broken(self.path, f"has a broken {BAMBU_CONFIG}", AGAIN):
            return bambu_parts(parsed_xml(unpacked(self.package, BAMBU_CONFIG), self.path))

    def told_role(self, chain: tuple[Key, ...]) -> tuple[str, str]:
        """Return role and name of an object within what is built, as Bambu Studio and OrcaSlicer say.

        They write every object that is no part with the type "other", so of a negative volume the role counts.
        """
        (top_part, top), (_, number) = chain[0], chain[-1]
        return self.bambu.get(top, {}).get(number, (PART, "")) if top_part == self.main else (PART, "")

    def note(self, text: str) -> None:
        self.notes[text] = None

    def reference(self, element: ElementTree.Element, part: str) -> Key:
        """Return the object that an item or a component refers to; the production extension has other files."""
        path = next((value for key, value in element.items() if key.endswith("}path")), None)
        return (part if path is None else part_key(path)), object_key(element.get("objectid"))

    def placed(self, key: Key, outer: Transform, above: tuple[Key, ...] = ()) -> Iterator[Placed]:
        """Yield the volumes of an object and of its components, by depth."""
        part, number = key
        self.placements += 1
        each, name = self.find(part, number), f"object {excerpt(number)}"
        if each is None:
            raise FormatError(f"{self.path} refers to an {name} that it does not hold; {AGAIN}")
        if key in above:
            raise FormatError(f"{self.path} refers to an {name} that holds itself; {AGAIN}")
        if len(above) > MOST_NESTED:
            raise FormatError(f"{self.path} has objects in objects, more than {MOST_NESTED} deep; {AGAIN}")
        if self.placements > MOST_PLACED:
            raise FormatError(f"{self.path} places its objects more than {MOST_PLACED:,} times; {AGAIN}")
        model, chain = self.model(part), (*above, key)
        own, unit = model.root.get("unit"), self.model(self.main).root.get("unit", "millimeter")
        if own is not None and own != unit:  # programs differ in which of them counts
            self.note(f"{excerpt(part)} is in {excerpt(own)}, and read in {unit}, as what is built says")
        if (said := each.get("name")) and excerpt(said):
            name = f"{name} '{excerpt(said)}'"
        if not is_part_type(each.get("type")) and self.told_role(chain)[0] != NEGATIVE:
            self.note(f"{name} is of type '{excerpt(each.get('type', ''))}', no part: it is left out")
            return
        if (role := cura_role(settings_of(each, model.core, model.spaces))) != PART:
            self.note(f"{name} is a {role}, no part: it is left out")
            return
        self._note_extensions(model, each, name)
        if model.mesh_of(each) is not None:
            yield from self._volumes(model, each, name, chain, outer)
        for component in model.below(each, "components/component"):
            inner = _transform(component.get("transform", IDENTITY))
            yield from self.placed(self.reference(component, part), _joined(inner, outer), chain)

    def _volumes(
        self, model: Model, each: ElementTree.Element, name: str, chain: tuple[Key, ...], outer: Transform
    ) -> Iterator[Placed]:
        """Yield the volumes of the mesh of an object."""
        part, number = chain[-1]
        element, mesh = model.mesh_of(each) or (each, None)
        assert mesh is not None
        if mesh.fault:
            raise FormatError(f"{self.path} has {mesh.fault}; {AGAIN}")
        self._count(len(mesh.faces) + len(mesh.vertices))
        role, said = self.told_role(chain)
        if said and excerpt(said):
            name = f"object {excerpt(number)} '{excerpt(said)}'"
        if role not in (PART, NEGATIVE):
            self.note(f"{name} is a {role}, no part: it is left out")
            return
        vertices = mesh.vertices @ outer[:3] + outer[3]
        # A mirrored part would face inwards: its corners are taken in reverse order.
        faces = mesh.faces[:, :: -1 if np.linalg.det(outer[:3]) < 0 else 1]
        ranges = [] if part != self.main and self.find(self.main, number) is not None else self.prusa.get(number, [])
        ranges = ranges or slic3r_volumes(element)
        scope = 0 if role == NEGATIVE or not ranges else self.placements
        if role == NEGATIVE or not ranges:
            if len(faces):
                yield Placed(surface=Surface(vertices=vertices, faces=faces), role=role, name=name, scope=scope)
            return
        covered = np.zeros(len(faces), dtype=bool)
        for volume in ranges:
            span = volume.span(len(faces))
            if span is None:
                raise FormatError(
                    f"{self.path} has a volume of triangles {excerpt(volume.first)} to {excerpt(volume.last)} of "
                    f"{name}, which has {len(faces):,} from 0 on; {AGAIN}"
                )
            covered[slice(*span)] = True
            self._count(span[1] - span[0])
            called = f"volume '{excerpt(volume.name)}'" if excerpt(volume.name) else "a volume"
            called = f"{called} of {name}"
            if volume.role in (PART, NEGATIVE):
                used, corners = np.unique(faces[slice(*span)], return_inverse=True)
                surface = Surface(vertices=vertices[used], faces=corners.reshape(-1, 3))
                yield Placed(surface=surface, role=volume.role, name=called, scope=scope)
            else:
                self.note(f"{called} is a {volume.role}, no part: it is left out")
        if not covered.all():
            self.note(f"{int((~covered).sum()):,} triangle(s) of {name} are in none of its volumes: they are left out")

    def _count(self, rows: int) -> None:
        """Count triangles and vertices that are placed, or raise FormatError."""
        self.rows += rows
        if self.rows > MOST_PLACED_ROWS:
            raise FormatError(f"{self.path} places more than {MOST_PLACED_ROWS:,} triangles and vertices; {AGAIN}")

    def _note_extensions(self, model: Model, each: ElementTree.Element, name: str) -> None:
        """Note what describes the shape of an object in a way that is not read."""
        found = model.mesh_of(each)
        for element in (each, *(() if found is None else (found[0],))):
            for namespace, _ in model.foreign(element):
                if not is_harmless(namespace):
                    self.note(f"{name} has {name_of(namespace)}, which are not read: they are left out")
        if any(key.endswith("}meshresolution") and value == "lowres" for key, value in each.items()):
            self.note(f"{name} has a mesh of low resolution beside its slices, which are left out")

    def without_negatives(self, volumes: Sequence[Placed]) -> Iterator[Surface]:
        """Yield the parts of what is built, without the negative volumes that come after them."""
        negatives = [number for number, each in enumerate(volumes) if each.role == NEGATIVE]
        if not negatives:
            yield from (each.surface for each in volumes)
            return
        low, high = zip(*(each.surface.bounds for each in volumes), strict=True)
        used = set()
        for number, part in enumerate(volumes):
            if part.role != PART:
                continue
            cutters = [
                other
                for other in negatives
                if other > number
                and volumes[other].scope in (0, part.scope)
                and (low[other] < high[number]).all()
                and (low[number] < high[other]).all()
            ]
            used.update(cutters)
            if not cutters:
                yield part.surface
                continue
            done = without(_outward(part.surface), [_outward(volumes[other].surface) for other in cutters])
            if done is None:
                raise FormatError(
                    f"{self.path} takes the negative {volumes[cutters[0]].name} off {part.name}, and one of them is "
                    "not closed; mend them in the slicer, or export the part as an STL without it"
                )
            if len(done.faces):
                yield done
        for number, each in enumerate(volumes):
            if each.role == NEGATIVE:
                what = "it is taken off" if number in used else "it meets no part before it"
                self.note(f"{each.name} is a negative volume: {what}")


def read_3mf(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer], tuple[str, ...]]:
    """Read the parts that a 3MF builds, where their components and transforms place them.

    Modifiers, blockers and enforcers of supports, objects of types other than "model", and items that are not to be
    printed are left out; negative volumes are taken off.

    Parameters
    ----------
    path : Path

    Returns
    -------
    vertices : (V, 3) float, mm
    faces : (F, 3) int
    notes : tuple of str
        What is left out, or taken off.

    Raises
    ------
    FormatError
        If it is broken, builds nothing, or requires an extension that is not read.
    """
    with opened(path) as package:
        reading = _Reading(path=path, package=package)
        main = reading.model(reading.main) if reading.main else None
        if main is None or main.root.find(f"{main.core}build") is None:
            raise FormatError(f"{path} has nothing to build in it; {AGAIN}")
        unit = main.root.get("unit", "millimeter").strip().lower()
        if unit not in UNITS:
            raise FormatError(f"{path} is in '{excerpt(unit)}', and 3MF knows {', '.join(UNITS)}; {AGAIN}")
        surfaces: list[Surface] = []
        with told_broken(path, "holds a number that is not one", AGAIN):
            for item in main.items:
                key = reading.reference(item, reading.main)
                if is_unprinted(item.get("printable")):
                    reading.note(f"object {excerpt(key[1])} is not to be printed: it is left out")
                    continue
                volumes = list(reading.placed(key, _transform(item.get("transform", IDENTITY))))
                surfaces.extend(reading.without_negatives(volumes))
        notes = tuple(reading.notes)
        if len(notes) > MOST_NOTES:
            notes = (*notes[:MOST_NOTES], f"and {len(notes) - MOST_NOTES:,} more")
        if not surfaces:
            if notes:
                raise FormatError(
                    f"{path} holds no part: {'; '.join(notes[:3])}; make it a part in the slicer, or export an STL"
                )
            return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64), ()
        starts = np.cumsum([0, *(len(each.vertices) for each in surfaces[:-1])])
        vertices = np.concatenate([each.vertices for each in surfaces]) * UNITS[unit]
        faces = np.concatenate([each.faces + start for each, start in zip(surfaces, starts, strict=True)])
    return vertices, faces, notes


def _outward(surface: Surface) -> Surface:
    """Return a volume that faces outwards, as slicers turn those that do not."""
    found = closed_or_merged(surface.vertices, surface.faces)
    return found if found.volume >= 0 else replace(found, faces=found.faces[:, ::-1])


def start_part(package: zipfile.ZipFile) -> str:
    """Return the part that the package says to start with, or an empty string."""
    if part_key(RELATIONS) not in parts_of_package(package):
        return ""
    relations = parsed_xml(unpacked(package, RELATIONS))
    targets = [each.get("Target", "") for each in relations if each.get("Type", "").endswith("/3dmodel")]
    return part_key(targets[0]) if targets else ""


def _transform(text: str) -> Transform:
    """Return the 4 x 3 matrix of a 3MF transform: points are rows, multiplied from the left."""
    return _within(np.array([float(number) for number in text.split()]).reshape(4, 3))


def _joined(inner: Transform, outer: Transform) -> Transform:
    """Return the transform that places by an inner one and then by an outer one."""
    return _within(np.concatenate([inner[:3] @ outer[:3], inner[3:] @ outer[:3] + outer[3]]))


def _within(transform: Transform) -> Transform:
    """Return a transform, or raise ValueError unless its numbers are finite and of a size that products stay so."""
    if not (np.abs(transform) <= FARTHEST).all():  # NaN is neither
        raise ValueError(f"a transform has numbers beyond {FARTHEST:g}")
    return transform
