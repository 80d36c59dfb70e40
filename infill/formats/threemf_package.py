"""The package of a 3MF: a zip of XML, opened and parsed within limits, since anyone may have written it."""

from __future__ import annotations

import contextlib
import re
import zipfile
from array import array
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, InfillError
from infill.files.broken import wrap_reader_errors
from infill.files.excerpts import excerpt
from infill.machine import require_memory
from infill.plain_numbers import plain_number

EXPORT_ADVICE = "export the mesh again"
LARGEST_RATIO, SMALL = 200, 1 << 20  # unpacked to packed; below this many bytes a package counts as this large
MOST_BYTES = 4 << 30  # of a package, unpacked: a zip of some megabytes may unpack to terabytes
LARGEST_TEXT = 100 << 20  # of a file, except models, which are read in pieces, and files that are not read
PIECEWISE = (".model", ".gcode", ".png", ".jpg", ".jpeg", ".md5", ".stl", ".step", ".stp")
HEADER = 30  # bytes of a zip before the name of a file in it
ENCRYPTED = 0x1  # among the flags of a file in a zip
PIECE_BYTES = 1 << 24  # bytes that are parsed at a time
MEMORY_PER_BYTE = 4  # bytes for each byte of XML: <vertex/> is the shortest of what becomes three numbers
MOST_ELEMENTS, DEEPEST = 2_000_000, 100  # besides vertices and triangles
FARTHEST = 1e15  # in the unit of the file: products of such numbers are finite
KEYSTORE = "secure/keystore.xml"
RELATIONS = "_rels/.rels"
IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"
# Encodings of text: Python has others, which decompress or translate.
ENCODINGS = re.compile(
    r"utf-?(8|16|16le|16be|16-le|16-be)|(us-)?ascii|iso-?8859-\d+|latin-?1|windows-125\d|cp125\d|koi8-r"
)
DECLARED_ENCODING = re.compile(rb"<\?xml[^>]*?encoding\s*=\s*[\"']([^\"'>]*)")
# Namespaces whose elements are stored with their content; of others, only the element.
KEPT_NAMESPACES = ("http://schemas.slic3r.org/", "http://software.ultimaker.com/")

Transform = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Mesh:
    """The mesh of an object, as in its file.

    Parameters
    ----------
    vertices : (V, 3) float64
        In the unit of the file.
    faces : (F, 3) int64
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]

    @cached_property
    def fault(self) -> str:
        """Defect of the mesh, or an empty string."""
        if not (np.abs(self.vertices) <= FARTHEST).all():  # NaN is neither
            return f"coordinates that are not numbers up to {plain_number(FARTHEST, 6)}"
        if len(self.faces) and (self.faces.min() < 0 or self.faces.max() >= len(self.vertices)):
            return "triangles with corners that do not exist"
        return ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Model:
    """A parsed model file of a package.

    Parameters
    ----------
    root : Element
        Without vertices and triangles.
    core : str
        The namespace of the root, in braces; empty for none.
    spaces : mapping of str to str
        Namespaces that the root declares, by prefix.
    meshes : mapping of Element to Mesh
    """

    root: ElementTree.Element
    core: str
    spaces: Mapping[str, str]
    meshes: Mapping[ElementTree.Element, Mesh]

    def descendants(self, element: ElementTree.Element, path: str) -> Iterator[ElementTree.Element]:
        """Yield the descendants of an element along a path of names of the core specification."""
        return element.iterfind("/".join(self.core + name for name in path.split("/")))

    @property
    def objects(self) -> Iterator[ElementTree.Element]:
        """The objects among its resources."""
        return self.descendants(self.root, "resources/object")

    @property
    def items(self) -> Iterator[ElementTree.Element]:
        """Items of the build."""
        return self.descendants(self.root, "build/item")

    def mesh_of(self, each: ElementTree.Element) -> tuple[ElementTree.Element, Mesh] | None:
        """Return the element of the mesh of an object, and the mesh; None without a mesh."""
        element = each.find(f"{self.core}mesh")
        return None if element is None else (element, self.meshes[element])

    def foreign(self, element: ElementTree.Element) -> Iterator[tuple[str, str]]:
        """Yield namespace and name of the child elements of extensions."""
        for child in element:
            space, _, name = child.tag[1:].rpartition("}")
            if child.tag[:1] == "{" and f"{{{space}}}" != self.core:
                yield space, name


@contextlib.contextmanager
def open_package(path: Path) -> Iterator[zipfile.ZipFile]:
    """Open a package; raise FormatError for errors, also those that occur while it is read."""
    try:
        file = path.open("rb")
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    with file, wrap_reader_errors(path, "is not a 3MF file", EXPORT_ADVICE):
        try:
            with zipfile.ZipFile(file) as package:
                _check_entries(package, path)
                yield package
        except InfillError:
            raise
        except OSError as error:  # a place before the beginning of the file
            raise FormatError(f"{path} is not a 3MF file ({error.strerror or error}); {EXPORT_ADVICE}") from error


def _check_entries(package: zipfile.ZipFile, path: Path) -> None:
    """Raise FormatError unless a zip has the entries of a 3MF, within the limits of size."""
    entries = sorted(package.infolist(), key=lambda entry: entry.header_offset)
    packed_size, unpacked_size = path.stat().st_size, sum(entry.file_size for entry in entries)
    if unpacked_size > min(MOST_BYTES, LARGEST_RATIO * max(packed_size, SMALL)):
        raise FormatError(
            f"{path} would unpack to {unpacked_size / 1e6:,.0f} MB, and it has {packed_size / 1e6:,.1f} MB; "
            f"{EXPORT_ADVICE}"
        )
    keys: set[str] = set()
    end = 0
    for entry in entries:
        name = excerpt(entry.filename)
        if (key := part_key(entry.filename)) in keys:  # readers disagree on which of them counts
            raise FormatError(f"{path} holds {name} twice; {EXPORT_ADVICE}")
        keys.add(key)
        if entry.flag_bits & ENCRYPTED:
            raise FormatError(f"{path} is encrypted; unpack it with its password and zip it without one")
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise FormatError(
                f"{path} is compressed by method {entry.compress_type}, and 3MF knows only deflate; {EXPORT_ADVICE}"
            )
        if entry.file_size > LARGEST_TEXT and not name.lower().endswith(PIECEWISE):
            raise FormatError(
                f"{path} holds {name} of {entry.file_size / 1e6:,.0f} MB, too much for settings; {EXPORT_ADVICE}"
            )
        if entry.header_offset < end:
            raise FormatError(f"{path} holds files that overlap, {name} among them; {EXPORT_ADVICE}")
        end = entry.header_offset + HEADER + len(entry.orig_filename) + entry.compress_size


def part_key(name: str) -> str:
    """Return the key of a file in a package, without regard to the case of letters.

    >>> part_key("/3D/My%20Part.model")
    '3d/my part.model'
    """
    return unquote(name).replace("\\", "/").lstrip("/").casefold()


def entries_by_key(package: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Return the files of a package by their keys."""
    return {part_key(entry.filename): entry for entry in package.infolist()}


def read_entry(package: zipfile.ZipFile, name: str) -> bytes:
    """Read a file of a package; `open_package` has checked its size."""
    return package.read(entries_by_key(package)[part_key(name)])


def read_model(package: zipfile.ZipFile, info: zipfile.ZipInfo, path: Path) -> Model:
    """Parse a model of a package; raise FormatError for invalid numbers, ValueError for other text than XML."""
    require_memory(MEMORY_PER_BYTE * info.file_size, None, f"{path} is large: simplify the mesh, or split it")
    with package.open(info) as file:
        pieces = iter(lambda: file.read(PIECE_BYTES), b"")
        try:
            return _parse(pieces, path)
        except ValueError as error:
            if not isinstance(error, InfillError) and KEYSTORE in entries_by_key(package):
                raise FormatError(
                    f"{path} has encrypted parts (3MF secure content), which are not read; export it without them"
                ) from error
            raise


def parse_xml(text: bytes, path: Path | None = None) -> ElementTree.Element:
    """Parse a document and return its root, or raise ValueError; document type definitions are forbidden.

    The standard parser fetches nothing from outside, and its output is only counted and multiplied.
    """
    return _parse([text], Path() if path is None else path).root


def _parse(pieces: Iterable[bytes], path: Path) -> Model:
    """Parse the pieces of a document as a model."""
    target = _ModelBuilder(path)
    parser = ElementTree.XMLParser(target=target)  # noqa: S314 - see `parsed_xml`
    begun = False
    try:
        for piece in pieces:
            if not begun:
                _check_encoding(piece)
                begun = True
            parser.feed(piece)
        root: ElementTree.Element = parser.close()
    except (ElementTree.ParseError, LookupError) as error:
        if isinstance(error, LookupError) and not str(error).startswith("unknown encoding"):
            raise
        raise ValueError(str(error)) from error
    core = root.tag.rpartition("}")[0]
    return Model(root=root, core=f"{core}}}" if core else "", spaces=target.spaces, meshes=target.meshes)


def _check_encoding(text: bytes) -> None:
    """Raise ValueError if a document declares an encoding other than those of texts."""
    declaration = DECLARED_ENCODING.search(text[: max(0, text.find(b">"))].replace(b"\0", b""))
    if declaration is None:
        return
    name = declaration[1].decode("ascii", "replace")
    if not ENCODINGS.fullmatch(name.strip().lower()):
        raise ValueError(f"its encoding is {excerpt(name)}, and 3MF knows UTF-8 and UTF-16")


class _ModelBuilder:
    """Builder of a tree without vertices and triangles, which it stores as numbers; it refuses document types.

    Parameters
    ----------
    path : Path
        For messages.
    """

    def __init__(self, path: Path) -> None:
        self.spaces: dict[str, str] = {}
        self.meshes: dict[ElementTree.Element, Mesh] = {}
        self._path = path
        self._tree = ElementTree.TreeBuilder()
        self._core: str | None = None
        self._mesh: ElementTree.Element | None = None
        self._vertex = self._triangle = self._name_of_mesh = ""
        self._points, self._corners = array("d"), array("q")
        self._count = self._depth = 0
        self._skipped = 0  # depth within an element that is stored without its content

    def doctype(self, name: str, public: str | None, system: str | None) -> None:  # noqa: ARG002 - of the parser
        """Raise ValueError: document types are refused."""
        raise ValueError(f"it defines a document type, {excerpt(name)}")

    def start_ns(self, prefix: str, uri: str) -> None:
        """Note the namespaces of the root."""
        if self._core is None:
            self.spaces[prefix or ""] = uri

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        """Store an element, or its numbers."""
        if self._mesh is not None and not self._skipped:
            if tag == self._vertex:
                self._row(self._points, ("x", "y", "z"), attributes, float)
                return
            if tag == self._triangle:
                self._row(self._corners, ("v1", "v2", "v3"), attributes, int)
                return
        self._count += 1
        self._depth += 1
        if self._count > MOST_ELEMENTS or self._depth > DEEPEST:
            raise ValueError(f"it has more than {MOST_ELEMENTS:,} elements, or {DEEPEST} in one another")
        if self._core is None:
            self._core = tag[: tag.rfind("}") + 1]
            self._vertex, self._triangle, self._name_of_mesh = (
                self._core + name for name in ("vertex", "triangle", "mesh")
            )
        if self._skipped:
            self._skipped += 1
            return
        element = self._tree.start(tag, attributes)
        if tag == self._name_of_mesh and self._mesh is None:
            self._mesh, self._points, self._corners = element, array("d"), array("q")
        elif not tag.startswith(self._core) and not tag[1:].startswith(KEPT_NAMESPACES):
            self._skipped = 1

    def _row(
        self,
        numbers: array[Any],
        names: tuple[str, str, str],
        attributes: dict[str, str],
        kind: type[float] | type[int],
    ) -> None:
        """Append the three numbers of a vertex or a triangle."""
        key1, key2, key3 = names
        try:
            numbers.extend((kind(attributes[key1]), kind(attributes[key2]), kind(attributes[key3])))
        except (KeyError, ValueError, OverflowError):
            row_text = ", ".join(excerpt(attributes.get(name, "")) or "nothing" for name in names)
            raise FormatError(
                f"{self._path} holds a number that is not one, among {row_text}; {EXPORT_ADVICE}"
            ) from None

    def end(self, tag: str) -> None:
        """Close an element."""
        if self._mesh is not None and not self._skipped and tag in (self._vertex, self._triangle):
            return
        self._depth -= 1
        if self._skipped > 1:
            self._skipped -= 1
            return
        self._skipped = 0
        element = self._tree.end(tag)
        if element is self._mesh:
            self.meshes[element] = Mesh(
                vertices=np.frombuffer(self._points, dtype=np.float64).reshape(-1, 3),
                faces=np.frombuffer(self._corners, dtype=np.int64).reshape(-1, 3),
            )
            self._mesh = None

    def data(self, text: str) -> None:
        """Store a text, except between vertices."""
        if self._mesh is None and not self._skipped:
            self._tree.data(text)

    def close(self) -> ElementTree.Element:
        """Return the root."""
        return self._tree.close()


def start_part(package: zipfile.ZipFile) -> str:
    """Return the `part_key` of the model that the package declares as its start, or an empty string."""
    if part_key(RELATIONS) not in entries_by_key(package):
        return ""
    relations = parse_xml(read_entry(package, RELATIONS))
    targets = [relation.get("Target", "") for relation in relations if relation.get("Type", "").endswith("/3dmodel")]
    return part_key(targets[0]) if targets else ""


def parse_transform(text: str) -> Transform:
    """Parse the 4 x 3 matrix of a transform for points as rows: point @ matrix."""
    return _require_finite(np.array([float(number) for number in text.split()]).reshape(4, 3))


def compose_transforms(inner: Transform, outer: Transform) -> Transform:
    """Return the transform that applies an inner one and then an outer one."""
    return _require_finite(np.concatenate([inner[:3] @ outer[:3], inner[3:] @ outer[:3] + outer[3]]))


def _require_finite(transform: Transform) -> Transform:
    """Return a transform, or raise ValueError if its numbers are not finite or so large that products overflow."""
    if not (np.abs(transform) <= FARTHEST).all():  # NaN is neither
        raise ValueError(f"a transform has numbers beyond {plain_number(FARTHEST, 6)}")
    return transform
