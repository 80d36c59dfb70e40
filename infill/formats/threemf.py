"""3MF: zipped XML that states its unit; core specification only."""

from __future__ import annotations

import html
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, BinaryIO
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.broken import told_broken
from infill.formats.parts import Part, hexadecimal, plain
from infill.formats.rows import write_rows
from infill.surface import Surface
from infill.version import __version__

UNITS = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"
AGAIN = "export the mesh again"
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL = "3D/3dmodel.model"
MODEL_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
DECLARED = '<?xml version="1.0" encoding="UTF-8"?>\n'
TYPES = {
    "rels": "application/vnd.openxmlformats-package.relationships+xml",
    "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml",
}
SETTINGS = "Metadata/phasefill.toml"  # what we attach: the options that make it again
MOST_PLACED = 100_000  # objects: components of components may say any number in a few lines
LARGEST_RATIO, SMALL = 200, 1 << 20  # unpacked to packed; below this many bytes a package counts as this large
MOST_BYTES = 4 << 30  # of a package, unpacked: a zip of some megabytes may unpack to terabytes
APPLICATION = f"phasefill-{__version__}"


@dataclass(frozen=True, kw_only=True)
class Attached:
    """A file in a 3MF beside the model.

    Parameters
    ----------
    name : str
        Its path in the package.
    content : bytes
    media : str
        The content type of its suffix.
    relation : str
        What it is to the package, as a relationship has it; empty for none.
    """

    name: str
    content: bytes
    media: str
    relation: str = ""


def read_3mf(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Read the build of a 3MF: objects, components and their transforms; core specification."""
    with told_broken(path, "is not a 3MF file", AGAIN), zipfile.ZipFile(path) as package:
        models = [name for name in package.namelist() if name.lower().endswith(".model")]
        roots = {f"/{name}": parsed_xml(unpacked(package, name, path)) for name in models}
        start = _start_part(package, path)
    built = [part for part, each in roots.items() if each.find("{*}build/{*}item") is not None]
    main = start if start in roots else next(iter(built), "")
    root = roots.get(main)
    if root is None or root.find("{*}build") is None:
        raise FormatError(f"{path} has nothing to build in it; {AGAIN}")
    objects = {
        (part, each.get("id")): each
        for part, model in roots.items()
        for each in model.findall("{*}resources/{*}object")
    }
    vertices: list[NDArray[np.floating]] = []
    faces: list[NDArray[np.integer]] = []

    left = MOST_PLACED

    def place(part: str, number: str | None, outer: NDArray[np.floating], depth: int = 0) -> None:
        nonlocal left
        left -= 1
        each = objects.get((part, number))
        if each is None or depth > 20:
            raise FormatError(f"{path} refers to an object {number} that it does not hold; {AGAIN}")
        if left < 0:
            raise FormatError(f"{path} places its objects more than {MOST_PLACED:,} times; {AGAIN}")
        corners = [
            [float(v.get(axis, "nan")) for axis in "xyz"] for v in each.iterfind("{*}mesh/{*}vertices/{*}vertex")
        ]
        triangles = [
            [int(t.get(corner, -1)) for corner in ("v1", "v2", "v3")]
            for t in each.iterfind("{*}mesh/{*}triangles/{*}triangle")
        ]
        if triangles:
            if max(map(max, triangles)) >= len(corners) or min(map(min, triangles)) < 0:
                raise FormatError(f"{path} has triangles with corners that do not exist; {AGAIN}")
            # A mirrored part would face inwards: its corners are taken in reverse order.
            ordered = np.array(triangles)[:, :: -1 if np.linalg.det(outer[:3]) < 0 else 1]
            faces.append(ordered + sum(len(some) for some in vertices))
            vertices.append(np.array(corners) @ outer[:3] + outer[3])
        for component in each.iterfind("{*}components/{*}component"):
            inner = _transform(component.get("transform", IDENTITY))
            joined = np.concatenate([inner[:3] @ outer[:3], inner[3:] @ outer[:3] + outer[3]])
            place(_path(component, part), component.get("objectid"), joined, depth + 1)

    with told_broken(path, "holds a number that is not one", AGAIN):
        for item in root.iterfind("{*}build/{*}item"):
            if item.get("printable") == "0":
                continue
            place(_path(item, main), item.get("objectid"), _transform(item.get("transform", IDENTITY)))
    if not faces:
        return np.empty((0, 3)), np.empty((0, 3), dtype=int)
    return np.concatenate(vertices) * UNITS.get(root.get("unit", "millimeter"), 1.0), np.concatenate(faces)


def unpacked(package: zipfile.ZipFile, name: str, path: Path) -> bytes:
    """Return a file in a package, or raise FormatError if all of it unpacks to more than memory should be asked for."""
    packed, whole = path.stat().st_size, sum(each.file_size for each in package.infolist())
    if whole > min(MOST_BYTES, LARGEST_RATIO * max(packed, SMALL)):
        raise FormatError(f"{path} would unpack to {whole / 1e6:,.0f} MB, and it has {packed / 1e6:,.1f} MB; {AGAIN}")
    return package.read(name)  # which reads no more than the sizes above say


def parsed_xml(text: bytes) -> ElementTree.Element:
    """Return the root of a document, or raise ValueError: the specification allows no document type definitions.

    The standard parser fetches nothing from outside; what it returns is only counted and multiplied.
    """
    parser = ElementTree.XMLParser(target=_NoEntities())  # noqa: S314
    try:
        parser.feed(text)
        root: ElementTree.Element = parser.close()
    except ElementTree.ParseError as error:
        raise ValueError(str(error)) from error
    return root


class _NoEntities(ElementTree.TreeBuilder):
    """Builds a tree, but not from a text with definitions of its own, which may stand for any length."""

    def doctype(self, name: str, public: str | None, system: str | None) -> None:  # noqa: ARG002 - of the parser
        """Refuse it."""
        raise ValueError(f"it defines a document type, {name}")


def attached_settings(path: Path) -> str:
    """Return the options that made what is in a 3MF, or raise FormatError if it has none of ours."""
    with told_broken(path, "is not a 3MF file", AGAIN), zipfile.ZipFile(path) as package:
        if SETTINGS in package.namelist():
            return unpacked(package, SETTINGS, path).decode()
    raise FormatError(f"{path} holds no options of ours; give a project that 'infill fill' wrote, or a TOML file")


def _start_part(package: zipfile.ZipFile, path: Path) -> str:
    """Return the part that the package says to start with, or an empty string."""
    if "_rels/.rels" not in package.namelist():
        return ""
    relations = parsed_xml(unpacked(package, "_rels/.rels", path))
    targets = [each.get("Target", "") for each in relations if each.get("Type", "").endswith("/3dmodel")]
    return "/" + targets[0].lstrip("/") if targets else ""


def _path(element: ElementTree.Element, part: str) -> str:
    """Return the part that contains the object of a component or an item."""
    return next((value for key, value in element.items() if key.endswith("}path")), part)


def _transform(text: str) -> NDArray[np.float64]:
    """Return the 4 x 3 matrix of a 3MF transform: points are rows, multiplied from the left."""
    return np.array([float(number) for number in text.split()]).reshape(4, 3)


def write_3mf(surface: Surface, file: BinaryIO) -> None:
    """Write 3MF, core specification only: one object, in millimetres."""
    write_3mf_parts([Part(surface=surface)], file)


def write_3mf_parts(parts: Sequence[Part], file: BinaryIO) -> None:
    """Write 3MF, core specification only: an object for each part, with its name and its colour, in millimetres."""
    names = [plain(part.name) for part in parts]
    coloured = [number for number, part in enumerate(parts) if part.colour is not None]

    def model(into: IO[bytes]) -> None:
        into.write(model_head({"Application": APPLICATION}).encode())
        into.write(_materials([(names[k], parts[k]) for k in coloured], len(parts) + 1).encode())
        for number, part in enumerate(parts):
            name = f" name={quoted(names[number])}" if names[number] else ""
            at = f' pid="{len(parts) + 1}" pindex="{coloured.index(number)}"' if number in coloured else ""
            into.write(f'<object id="{number + 1}" type="model"{name}{at}>'.encode())
            write_mesh(into, part.surface.vertices, part.surface.faces)
            into.write(b"</object>")
        into.write(model_end(range(1, len(parts) + 1)).encode())

    write_package(file, model)


def write_package(file: BinaryIO, model: Callable[[IO[bytes]], None], attached: Sequence[Attached] = ()) -> None:
    """Write a 3MF whose model a function writes, with other files beside it."""
    media = {**TYPES, **{each.name.rpartition(".")[2]: each.media for each in attached}}
    types = "".join(f' <Default Extension="{suffix}" ContentType="{kind}"/>\n' for suffix, kind in media.items())
    related = [(MODEL, MODEL_RELATION), *((each.name, each.relation) for each in attached if each.relation)]
    relations = "".join(
        f' <Relationship Target="/{name}" Id="rel{number}" Type="{kind}"/>\n'
        for number, (name, kind) in enumerate(related)
    )
    packaging = "http://schemas.openxmlformats.org/package/2006"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=4) as package:
        package.writestr(
            _dated("[Content_Types].xml"), f'{DECLARED}<Types xmlns="{packaging}/content-types">\n{types}</Types>\n'
        )
        package.writestr(
            _dated("_rels/.rels"),
            f'{DECLARED}<Relationships xmlns="{packaging}/relationships">\n{relations}</Relationships>\n',
        )
        with package.open(MODEL, "w", force_zip64=True) as into:
            model(into)
        for each in attached:
            package.writestr(_dated(each.name), each.content)


def _dated(name: str) -> zipfile.ZipInfo:
    """Return an entry of a package, the same whenever it is written."""
    entry = zipfile.ZipInfo(name)
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


def model_head(metadata: Mapping[str, str], namespaces: Mapping[str, str] | None = None) -> str:
    """Return how a model in millimetres begins, up to its resources."""
    spaces = "".join(f' xmlns:{prefix}="{address}"' for prefix, address in (namespaces or {}).items())
    told = "".join(
        f' <metadata name="{name}">{html.escape(plain(text))}</metadata>\n' for name, text in metadata.items()
    )
    return f'{DECLARED}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}"{spaces}>\n{told} <resources>'


def model_end(built: Iterable[int]) -> str:
    """Return how a model ends that builds objects of these numbers."""
    items = "".join(f'<item objectid="{number}"/>' for number in built)
    return f"</resources>\n <build>{items}</build>\n</model>\n"


def write_mesh(into: IO[bytes], vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> None:
    """Write vertices and triangles as a mesh of a model."""
    into.write(b"<mesh><vertices>\n")
    write_rows(into, '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', vertices)
    into.write(b"</vertices><triangles>\n")
    write_rows(into, '<triangle v1="%d" v2="%d" v3="%d"/>\n', faces)
    into.write(b"</triangles></mesh>")


def _materials(coloured: Sequence[tuple[str, Part]], number: int) -> str:
    """Return the resource that holds the colours of named parts; empty if there are none."""
    if not coloured:
        return ""
    bases = "".join(
        f'<base name={quoted(name or "part")} displaycolor="{hexadecimal(part.colour)}"/>'
        for name, part in coloured
        if part.colour is not None
    )
    return f'<basematerials id="{number}">{bases}</basematerials>\n'


def quoted(text: str) -> str:
    """Return a text as the value of an attribute, whose line breaks and tabs stay what they are."""
    escaped = html.escape(text)
    for sign in "\n\r\t":
        escaped = escaped.replace(sign, f"&#{ord(sign)};")
    return f'"{escaped}"'
