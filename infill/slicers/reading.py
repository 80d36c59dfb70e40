"""What a 3MF holds, as the rules of slicers need it: objects, what is built, and the files beside the model."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.broken import readable, told_broken
from infill.formats.threemf import IDENTITY, MODEL, parsed_xml, unpacked
from infill.surface import Surface

AGAIN = "write the file again"
RELATIONS = "_rels/.rels"


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """An object of a model.

    Parameters
    ----------
    number : str
        Its id.
    name : str
    mesh : Surface or None
    components : tuple of str
        The objects that it consists of, as `Package.bodies` has them.
    settings : mapping of str to str
        Metadata of its own, by full name: ``{address}key``, or ``prefix:key`` where the prefix is not declared.
    """

    number: str
    name: str
    mesh: Surface | None
    components: tuple[str, ...]
    settings: Mapping[str, str]


@dataclass(frozen=True, kw_only=True, eq=False)
class Package:
    """A 3MF.

    Parameters
    ----------
    path : Path
    names : frozenset of str
        Of all files in it.
    texts : mapping of str to bytes
        Those that are settings.
    unit : str
    extensions : tuple of str
        Prefixes of the extensions that a reader must know.
    metadata : mapping of str to str
    spaces : mapping of str to str
        Addresses of namespaces by prefix.
    bodies : mapping of str to Body
        By number, and by ``number of /path`` for those in other files of the package.
    built : tuple of (str, bool)
        Objects to print, and whether each stays where it is.
    """

    path: Path
    names: frozenset[str]
    texts: Mapping[str, bytes]
    unit: str
    extensions: tuple[str, ...]
    metadata: Mapping[str, str]
    spaces: Mapping[str, str]
    bodies: Mapping[str, Body]
    built: tuple[tuple[str, bool], ...]

    def xml(self, name: str) -> ElementTree.Element | None:
        """Return the root of a file of settings; None if there is none, or FormatError if it is broken."""
        if name not in self.texts:
            return None
        with told_broken(self.path, f"has a broken {name}", AGAIN):
            return parsed_xml(self.texts[name])


def read_package(path: Path) -> Package:
    """Return what a 3MF holds, or raise FormatError."""
    source = readable(path, [".3mf"], "a project")
    with told_broken(source, "is not a 3MF file", AGAIN), zipfile.ZipFile(source) as package:
        names = frozenset(package.namelist())
        if MODEL not in names:
            raise FormatError(f"{source} has no {MODEL}; {AGAIN}")
        texts = {name: unpacked(package, name, source) for name in names if name.endswith(".config")}
        model = unpacked(package, MODEL, source)
        root = parsed_xml(model)
        others = {
            f"/{name}": parsed_xml(unpacked(package, name, source))
            for name in sorted(names - {MODEL})
            if name.endswith(".model")
        }
    # The parser keeps no prefixes: those of the root are as it was written.
    start = re.search(rb"<model\b[^>]*>", model)
    spaces = dict(re.findall(r'xmlns:(\w+)="([^"]*)"', start[0].decode(errors="replace") if start else ""))
    with told_broken(source, "holds a number that is not one", AGAIN):
        bodies = {
            key_of(part, each.get("id", "")): _body(each, spaces)
            for part, model_root in {"": root, **others}.items()
            for each in model_root.findall("{*}resources/{*}object")
        }
    return Package(
        path=source,
        names=names,
        texts=texts,
        unit=root.get("unit", "millimeter"),
        extensions=tuple(root.get("requiredextensions", "").split()),
        metadata={each.get("name", ""): each.text or "" for each in root.findall("{*}metadata")},
        spaces=spaces,
        bodies=bodies,
        built=tuple(
            (_key(item), item.get("transform", IDENTITY).split() == IDENTITY.split())
            for item in root.findall("{*}build/{*}item")
        ),
    )


def rows_of(element: ElementTree.Element) -> dict[str, str]:
    """Return the rows of a file of settings, by key."""
    return {each.get("key", ""): each.get("value", "") for each in element.findall("metadata")}


def key_of(part: str, number: str) -> str:
    """Return how an object is known in the package: by its number, and by its file, if that is another one."""
    return f"{number} of {part}" if part else number


def _key(element: ElementTree.Element) -> str:
    """Return the object that a component or an item refers to; the production extension lets it be in another file."""
    part = next((value for name, value in element.items() if name.endswith("}path")), "")
    return key_of("" if part == f"/{MODEL}" else part, element.get("objectid", ""))


def _body(element: ElementTree.Element, spaces: Mapping[str, str]) -> Body:
    settings = {}
    for each in element.findall("{*}metadatagroup/{*}metadata"):
        prefix, _, key = each.get("name", "").rpartition(":")
        settings[f"{{{spaces[prefix]}}}{key}" if prefix in spaces else each.get("name", "")] = each.text or ""
    mesh = element.find("{*}mesh")
    return Body(
        number=element.get("id", ""),
        name=element.get("name", ""),
        mesh=None if mesh is None else _mesh(mesh),
        components=tuple(_key(each) for each in element.findall("{*}components/{*}component")),
        settings=settings,
    )


def _mesh(element: ElementTree.Element) -> Surface:
    vertices = _numbers(element, "{*}vertices/{*}vertex", ("x", "y", "z"), float)
    faces = _numbers(element, "{*}triangles/{*}triangle", ("v1", "v2", "v3"), int)
    if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
        raise ValueError("a triangle has a corner that does not exist")
    return Surface(vertices=vertices.astype(np.float64), faces=faces.astype(np.int64))


def _numbers(
    element: ElementTree.Element, path: str, names: tuple[str, ...], kind: type[float] | type[int]
) -> NDArray[np.generic]:
    rows = [[kind(each.get(name, "")) for name in names] for each in element.iterfind(path)]
    return np.array(rows, dtype=kind).reshape(-1, len(names))
