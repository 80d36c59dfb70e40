"""What a 3MF holds, as the rules of slicers need it: objects, what is built, and the files beside the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from infill.errors import FormatError
from infill.files.broken import readable, told_broken
from infill.files.excerpts import excerpt
from infill.formats.threemf_extensions import Extension, is_harmless, name_of, required
from infill.formats.threemf_package import (
    Model,
    opened,
    parsed_xml,
    part_key,
    parts_of_package,
    read_model,
)
from infill.formats.threemf_reading import IDENTITY, MODEL, RELATIONS, start_part
from infill.formats.threemf_roles import is_part_type, is_unprinted, object_key, rows_of, settings_of
from infill.surface import Surface

__all__ = ["RELATIONS", "Body", "Item", "Leaf", "Package", "key_of", "read_package", "rows_of"]

AGAIN = "write the file again"
MOST_NESTED = 20  # components in one another
MOST_PLACED, MOST_TRIANGLES = 20_000, 20_000_000  # of what is built


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
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
        The objects that it consists of, as `Package.bodies` has them.
    settings : mapping of str to str
        Metadata of its own, by full name: ``{address}key``, or ``prefix:key`` where the prefix is not declared.
    foreign : tuple of str
        What extensions add to its shape.
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
        """Whether it is of the type of parts."""
        return is_part_type(self.kind)


@dataclass(frozen=True, kw_only=True)
class Item:
    """What is built.

    Parameters
    ----------
    key : str
        The object, as `Package.bodies` has it.
    stays : bool
        Whether it is built where it is.
    printable : str
        As the file has it; empty if it does not say.
    """

    key: str
    stays: bool
    printable: str = ""

    @property
    def prints(self) -> bool:
        """Whether it is to be printed."""
        return not is_unprinted(self.printable)


@dataclass(frozen=True, kw_only=True, eq=False)
class Leaf:
    """An object with a mesh, and the objects that it is in.

    Parameters
    ----------
    key : str
    body : Body
    above : tuple of Body
        From what is built down.
    """

    key: str
    body: Body
    above: tuple[Body, ...]

    @property
    def other(self) -> Body | None:
        """The first object down to it that is of another type than a part; None if there is none."""
        return next((each for each in (*self.above, self.body) if not each.is_part), None)

    @property
    def covered(self) -> bool:
        """Whether it is in an object that has a mesh itself, in place of which some read no components."""
        return any(each.mesh is not None for each in self.above)


@dataclass(frozen=True, kw_only=True, eq=False)
class Tree:
    """What an object that is built consists of.

    Parameters
    ----------
    leaves : tuple of Leaf
    missing : tuple of str
        Objects that are referred to and not there, or that hold themselves.
    deepest : int
        How many objects are above the lowest one.
    whole : bool
        False if there was more than anything should be asked to print.
    visits : int
        How many objects were looked at.
    """

    leaves: tuple[Leaf, ...]
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
        Those that are settings, by key.
    unit : str
    extensions : tuple of Extension
        That a reader must know.
    metadata : mapping of str to str
    prefix : str
        Before the names of the core specification; empty for none, as most programs write them.
    bodies : mapping of str to Body
        By number, and by ``number of /path`` for those in other files of the package; in their order in the file.
    twice : tuple of str
        Numbers that several objects of one file have.
    items : tuple of Item
        What is built.
    """

    path: Path
    names: frozenset[str]
    texts: Mapping[str, bytes]
    unit: str
    extensions: tuple[Extension, ...]
    metadata: Mapping[str, str]
    prefix: str
    bodies: Mapping[str, Body]
    twice: tuple[str, ...]
    items: tuple[Item, ...]
    trees: dict[str, Tree] = field(default_factory=dict, repr=False)  # those that were asked for

    def has(self, name: str) -> bool:
        """Return whether there is a file of this name; capitals and small letters are the same."""
        return part_key(name) in self.names

    def xml(self, name: str) -> ElementTree.Element | None:
        """Return the root of a file of settings; None if there is none, or FormatError if it is broken."""
        if part_key(name) not in self.texts:
            return None
        with told_broken(self.path, f"has a broken {name}", AGAIN):
            return parsed_xml(self.texts[part_key(name)], self.path)

    def tree(self, key: str) -> Tree:
        """Return what an object consists of; of all objects together, no more than is allowed."""
        if key not in self.trees:
            self.trees[key] = self._tree(key, sum(each.visits for each in self.trees.values()))
        return self.trees[key]

    def _tree(self, key: str, before: int) -> Tree:
        leaves: list[Leaf] = []
        missing: dict[str, None] = {}
        visits, triangles, deepest = before, 0, 0

        def visit(key: str, above: tuple[str, ...]) -> None:
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
                leaves.append(Leaf(key=key, body=body, above=tuple(self.bodies[each] for each in above)))
            for each in body.components:
                visit(each, (*above, key))

        visit(key, ())
        whole = visits <= MOST_PLACED and triangles <= MOST_TRIANGLES
        return Tree(leaves=tuple(leaves), missing=tuple(missing), deepest=deepest, whole=whole, visits=visits - before)


def read_package(path: Path) -> Package:
    """Return what a 3MF holds, or raise FormatError."""
    source = readable(path, [".3mf"], "a project")
    with opened(source) as package:
        parts = parts_of_package(package)
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
    bodies: dict[str, Body] = {}
    twice = []
    for name, each_model in models.items():
        for each in each_model.objects:
            key = key_of("" if name == main else f"/{name}", each.get("id"))
            if key in bodies:
                twice.append(key)
            bodies[key] = _body(each_model, each, name, main, source)
    return Package(
        path=source,
        names=frozenset(parts),
        texts=texts,
        unit=model.root.get("unit", "millimeter"),
        extensions=tuple(required(model)),
        metadata={
            excerpt(each.get("name", "")): excerpt(each.text or "") for each in model.below(model.root, "metadata")
        },
        prefix=next((prefix for prefix, uri in model.spaces.items() if prefix and f"{{{uri}}}" == model.core), "")
        if "" not in model.spaces
        else "",
        bodies=bodies,
        twice=tuple(dict.fromkeys(twice)),
        items=tuple(
            Item(
                key=_key(item, main, main),
                stays=item.get("transform", IDENTITY).split() == IDENTITY.split(),
                printable=item.get("printable", ""),
            )
            for item in model.items
        ),
    )


def key_of(part: str, number: str | None) -> str:
    """Return how an object is known in the package: by its number, and by its file, if that is another one."""
    plain = excerpt(object_key(number))
    return f"{plain} of {excerpt(part)}" if part else plain


def _key(element: ElementTree.Element, part: str, main: str) -> str:
    """Return the object that a component or an item refers to; the production extension lets it be in another file."""
    path = next((value for name, value in element.items() if name.endswith("}path")), None)
    part = part if path is None else part_key(path)
    return key_of("" if part == main else f"/{part}", element.get("objectid"))


def _body(model: Model, element: ElementTree.Element, part: str, main: str, path: Path) -> Body:
    found = model.mesh_of(element)
    mesh = None
    foreign = list(model.foreign(element))
    if found is not None:
        foreign += model.foreign(found[0])
        if found[1].fault:
            raise FormatError(f"{path} has {found[1].fault}; {AGAIN}")
        mesh = Surface(vertices=found[1].vertices, faces=found[1].faces)
    return Body(
        number=excerpt(object_key(element.get("id"))),
        name=excerpt(element.get("name", "")),
        kind=excerpt(element.get("type", "")),
        mesh=mesh,
        components=tuple(_key(each, part, main) for each in model.below(element, "components/component")),
        settings={
            excerpt(key, 200): excerpt(value) for key, value in settings_of(element, model.core, model.spaces).items()
        },
        foreign=tuple(dict.fromkeys(name_of(space) for space, _ in foreign if not is_harmless(space))),
    )
