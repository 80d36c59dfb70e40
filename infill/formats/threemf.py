"""3MF: zipped XML that states its unit; core specification only."""

from __future__ import annotations

import html
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import BinaryIO
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
TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""
RELATIONS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
HEAD = f"""<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">phasefill-{__version__}</metadata>
 <resources>"""


def read_3mf(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Read the build of a 3MF: objects, components and their transforms; core specification."""
    # The standard parser fetches nothing from outside, and its output is only counted and multiplied.
    with told_broken(path, "is not a 3MF file", AGAIN), zipfile.ZipFile(path) as package:
        models = [name for name in package.namelist() if name.lower().endswith(".model")]
        roots = {f"/{name}": ElementTree.fromstring(package.read(name)) for name in models}  # noqa: S314
        start = _start_part(package)
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

    def place(part: str, number: str | None, outer: NDArray[np.floating], depth: int = 0) -> None:
        each = objects.get((part, number))
        if each is None or depth > 20:
            raise FormatError(f"{path} refers to an object {number} that it does not hold; {AGAIN}")
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


def _start_part(package: zipfile.ZipFile) -> str:
    """Return the part that the package says to start with, or an empty string."""
    if "_rels/.rels" not in package.namelist():
        return ""
    relations = ElementTree.fromstring(package.read("_rels/.rels"))  # noqa: S314 - as the models
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
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=4) as package:
        package.writestr("[Content_Types].xml", TYPES)
        package.writestr("_rels/.rels", RELATIONS)
        with package.open("3D/3dmodel.model", "w", force_zip64=True) as model:
            model.write(HEAD.encode())
            model.write(_materials([(names[k], parts[k]) for k in coloured], len(parts) + 1).encode())
            for number, part in enumerate(parts):
                name = f" name={_quoted(names[number])}" if names[number] else ""
                at = f' pid="{len(parts) + 1}" pindex="{coloured.index(number)}"' if number in coloured else ""
                model.write(f'<object id="{number + 1}" type="model"{name}{at}><mesh><vertices>\n'.encode())
                write_rows(model, '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', part.surface.vertices)
                model.write(b"</vertices><triangles>\n")
                write_rows(model, '<triangle v1="%d" v2="%d" v3="%d"/>\n', part.surface.faces)
                model.write(b"</triangles></mesh></object>")
            items = "".join(f'<item objectid="{number + 1}"/>' for number in range(len(parts)))
            model.write(f"</resources>\n <build>{items}</build>\n</model>\n".encode())


def _materials(coloured: Sequence[tuple[str, Part]], number: int) -> str:
    """Return the resource that holds the colours of named parts; empty if there are none."""
    if not coloured:
        return ""
    bases = "".join(
        f'<base name={_quoted(name or "part")} displaycolor="{hexadecimal(part.colour)}"/>'
        for name, part in coloured
        if part.colour is not None
    )
    return f'<basematerials id="{number}">{bases}</basematerials>\n'


def _quoted(text: str) -> str:
    """Return a text as the value of an attribute, whose line breaks and tabs stay what they are."""
    escaped = html.escape(text)
    for sign in "\n\r\t":
        escaped = escaped.replace(sign, f"&#{ord(sign)};")
    return f'"{escaped}"'
