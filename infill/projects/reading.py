"""The contents of a 3MF, as the rules of slicers need them: objects, items to build, and settings files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from infill.errors import FormatError
from infill.files.broken import require_readable, wrap_reader_errors
from infill.files.excerpts import excerpt
from infill.formats.threemf_extensions import Extension, is_harmless, name_of, required_extensions
from infill.formats.threemf_package import (
    IDENTITY,
    RELATIONS,
    Model,
    entries_by_key,
    open_package,
    parse_xml,
    part_key,
    read_model,
    start_part,
)
from infill.formats.threemf_placing import MODEL
from infill.formats.threemf_roles import is_part_type, is_unprinted, metadata_of, object_key, settings_of
from infill.surface import Surface

__all__ = [
    "RELATIONS",
    "BuildItem",
    "MeshObject",
    "Package",
    "PackageObject",
    "metadata_of",
    "object_key_in",
    "read_package",
]

AGAIN = "write the file again"
MOST_NESTED = 20  # depth of components
MOST_PLACED, MOST_TRIANGLES = 20_000, 20_000_000  # objects and triangles that are built


@dataclass(frozen=True, kw_only=True, eq=False)
class PackageObject:
    """An object of a model.

    Parameters
    ----------
    number : str
        Its id.
    name : str
    kind : str
        Its type: "model" for parts.
    mesh : Surface or None
    components : tuple of str
        The objects that it consists of, by their keys in `Package.bodies`.
    settings : mapping of str to str
        Metadata of its own, by full name: ``{address}key``, or ``prefix:key`` where the prefix is not declared.
    foreign : tuple of str
        Shapes that extensions add.
    """

    number: str
    name: str
    kind: str
    mesh: Surface | None
    components: tuple[str, ...]
    settings: Mapping[str, str]
    foreign: tuple[str, ...] = ()

    @property
    def is_part(self) -> bool:
        """True if its type is that of parts."""
        return is_part_type(self.kind)


@dataclass(frozen=True, kw_only=True)
class BuildItem:
    """An item to build.

    Parameters
    ----------
    key : str
        The key of the object in `Package.bodies`.
    stays : bool
        True if it is built without a move.
    printable : str
        The value in the file; empty if there is none.
    """

    key: str
    stays: bool
    printable: str = ""

    @property
    def prints(self) -> bool:
        """True if it is to be printed."""
        return not is_unprinted(self.printable)


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshObject:
    """An object with a mesh, and the objects around it.

    Parameters
    ----------
    key : str
    body : PackageObject
    above : tuple of PackageObject
        The objects around it, from the one that is built down.
    """

    key: str
    body: PackageObject
    above: tuple[PackageObject, ...]

    @property
    def other(self) -> PackageObject | None:
        """The first object down to it that is not a part; None if all are."""
        return next((body for body in (*self.above, self.body) if not body.is_part), None)

    @property
    def covered(self) -> bool:
        """True if it is in an object with a mesh itself; some readers take that mesh in place of components."""
        return any(body.mesh is not None for body in self.above)


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectTree:
    """The components of an object that is built.

    Parameters
    ----------
    leaves : tuple of MeshObject
    missing : tuple of str
        Objects that are referred to and missing, or that hold themselves.
    deepest : int
        Number of objects above the lowest one.
    whole : bool
        False if there are more objects or triangles than the limits allow.
    visits : int
        Number of objects visited.
    """

    leaves: tuple[MeshObject, ...]
    missing: tuple[str, ...]
    deepest: int
    whole: bool
    visits: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Package:
    """A 3MF.

    Parameters
    ----------
    path : Path
    names : frozenset of str
        Keys of all files in it.
    texts : mapping of str to bytes
        Contents of the settings files, by key.
    unit : str
    extensions : tuple of Extension
        Extensions that a reader must know.
    metadata : mapping of str to str
    prefix : str
        Prefix of the names of the core specification; empty for none, as most programs write them.
    bodies : mapping of str to PackageObject
        Objects by number, or by ``number of /path`` in other files of the package; in their order in the file.
    twice : tuple of str
        Numbers that several objects of one file have.
    items : tuple of BuildItem
        The items to build.
    """

    path: Path
    names: frozenset[str]
    texts: Mapping[str, bytes]
    unit: str
    extensions: tuple[Extension, ...]
    metadata: Mapping[str, str]
    prefix: str
    bodies: Mapping[str, PackageObject]
    twice: tuple[str, ...]
    items: tuple[BuildItem, ...]
    trees: dict[str, ObjectTree] = field(default_factory=dict, repr=False)  # a cache

    def has(self, name: str) -> bool:
        """Tell whether a file has this name, in capitals or small letters."""
        return part_key(name) in self.names

    def xml(self, name: str) -> ElementTree.Element | None:
        """Parse a settings file; return its root, or None without such a file. Raise FormatError if it is broken."""
        if part_key(name) not in self.texts:
            return None
        with wrap_reader_errors(self.path, f"has a broken {name}", AGAIN):
            return parse_xml(self.texts[part_key(name)], self.path)

    def tree(self, key: str) -> ObjectTree:
        """Find the components of an object; all objects together are limited."""
        if key not in self.trees:
            self.trees[key] = self._build_tree(key, sum(tree.visits for tree in self.trees.values()))
        return self.trees[key]

    def _build_tree(self, key: str, before: int) -> ObjectTree:
        """Follow the components of an object to its meshes, within limits; list references that lead nowhere."""
        leaves: list[MeshObject] = []
        missing: dict[str, None] = {}
        visits, triangles, deepest = before, 0, 0

        def visit(key: str, above: tuple[str, ...]) -> None:
            """Follow an object, in those above it, to its meshes."""
            nonlocal visits, triangles, deepest
            visits += 1
            deepest = max(deepest, len(above))
            if visits > MOST_PLACED or triangles > MOST_TRIANGLES:
                return
            body = self.bodies.get(key)
            if body is None or key in above or len(above) > MOST_NESTED:
                missing[key] = None
                return
            if body.mesh is not None:
                triangles += len(body.mesh.faces)
                leaves.append(MeshObject(key=key, body=body, above=tuple(self.bodies[ancestor] for ancestor in above)))
            for component in body.components:
                visit(component, (*above, key))

        visit(key, ())
        is_whole = visits <= MOST_PLACED and triangles <= MOST_TRIANGLES
        return ObjectTree(
            leaves=tuple(leaves), missing=tuple(missing), deepest=deepest, whole=is_whole, visits=visits - before
        )


def read_package(path: Path) -> Package:
    """Read a 3MF, or raise FormatError."""
    source = require_readable(path, [".3mf"], "a project")
    with open_package(source) as package:
        parts = entries_by_key(package)
        main = start_part(package)
        main = main if main in parts else part_key(MODEL)
        if main not in parts:
            raise FormatError(f"{source} has no {MODEL}; {AGAIN}")
        texts = {name: package.read(info) for name, info in parts.items() if name.endswith(".config")}
        others = [name for name in sorted(parts) if name.endswith(".model") and name != main]
        models = {name: read_model(package, parts[name], source) for name in (main, *others)}
    model = models[main]
    if (built := sum(1 for _ in model.items)) > MOST_PLACED:
        raise FormatError(f"{source} builds {built:,} objects, more than {MOST_PLACED:,}; build fewer")
    bodies: dict[str, PackageObject] = {}
    twice = []
    for name, part_model in models.items():
        for element in part_model.objects:
            key = object_key_in("" if name == main else f"/{name}", element.get("id"))
            if key in bodies:
                twice.append(key)
            bodies[key] = _read_body(part_model, element, name, main, source)
    return Package(
        path=source,
        names=frozenset(parts),
        texts=texts,
        unit=model.root.get("unit", "millimeter"),
        extensions=tuple(required_extensions(model)),
        metadata={
            excerpt(row.get("name", "")): excerpt(row.text or "") for row in model.descendants(model.root, "metadata")
        },
        prefix=next((prefix for prefix, uri in model.spaces.items() if prefix and f"{{{uri}}}" == model.core), "")
        if "" not in model.spaces
        else "",
        bodies=bodies,
        twice=tuple(dict.fromkeys(twice)),
        items=tuple(
            BuildItem(
                key=_key_of_reference(item, main, main),
                stays=item.get("transform", IDENTITY).split() == IDENTITY.split(),
                printable=item.get("printable", ""),
            )
            for item in model.items
        ),
    )


def object_key_in(part: str, number: str | None) -> str:
    """Return the key of an object in the package: its number, and its file if that is not the main one."""
    plain = excerpt(object_key(number))
    return f"{plain} of {excerpt(part)}" if part else plain


def _key_of_reference(element: ElementTree.Element, part: str, main: str) -> str:
    """Return the key of the object that a component or an item refers to, perhaps in another file."""
    path = next((value for name, value in element.items() if name.endswith("}path")), None)
    part = part if path is None else part_key(path)
    return object_key_in("" if part == main else f"/{part}", element.get("objectid"))


def _read_body(model: Model, element: ElementTree.Element, part: str, main: str, path: Path) -> PackageObject:
    """Read an object, its mesh or components, and its settings; raise FormatError for a faulty mesh."""
    read_mesh = model.mesh_of(element)
    mesh = None
    foreign = list(model.foreign(element))
    if read_mesh is not None:
        foreign += model.foreign(read_mesh[0])
        if read_mesh[1].fault:
            raise FormatError(f"{path} has {read_mesh[1].fault}; {AGAIN}")
        mesh = Surface(vertices=read_mesh[1].vertices, faces=read_mesh[1].faces)
    return PackageObject(
        number=excerpt(object_key(element.get("id"))),
        name=excerpt(element.get("name", "")),
        kind=excerpt(element.get("type", "")),
        mesh=mesh,
        components=tuple(
            _key_of_reference(component, part, main) for component in model.descendants(element, "components/component")
        ),
        settings={
            excerpt(key, 200): excerpt(value) for key, value in settings_of(element, model.core, model.spaces).items()
        },
        foreign=tuple(dict.fromkeys(name_of(space) for space, _ in foreign if not is_harmless(space))),
    )
