"""Write 3MF, zipped XML that states its unit: core specification only. `threemf_reading` reads it."""

from __future__ import annotations

import html
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.parts import Part, hex_colour, printable_name
from infill.formats.rows import write_rows
from infill.formats.threemf_package import entries_by_key, open_package, part_key, read_entry
from infill.surface import Surface
from infill.version import __version__

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL_PATH = "3D/3dmodel.model"
MODEL_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
XML_DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>\n'
TYPES = {
    "rels": "application/vnd.openxmlformats-package.relationships+xml",
    "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml",
}
SETTINGS_PATH = "Metadata/phasefill.toml"  # the attached options, which make the model again
APPLICATION = f"phasefill-{__version__}"


@dataclass(frozen=True, kw_only=True)
class Attachment:
    """A file in a 3MF beside the model.

    Parameters
    ----------
    name : str
        Its path in the package.
    content : bytes
    media : str
        The content type of its suffix.
    relation : str
        Type of its relationship to the package; empty for none.
    """

    name: str
    content: bytes
    media: str
    relation: str = ""


def read_attached_settings(path: Path) -> str:
    """Return the options in a 3MF that made its content, or raise FormatError if it has none."""
    with open_package(path) as package:
        if part_key(SETTINGS_PATH) in entries_by_key(package):
            return read_entry(package, SETTINGS_PATH).decode()
    raise FormatError(f"{path} holds no options of phasefill; give a project that 'infill fill' wrote, or a TOML file")


def write_3mf(surface: Surface, file: BinaryIO) -> None:
    """Write one object in millimetres, by the core specification of 3MF only."""
    write_3mf_parts([Part(surface=surface)], file)


def write_3mf_parts(parts: Sequence[Part], file: BinaryIO) -> None:
    """Write an object for each part, with name and colour, in millimetres, by the core specification only."""
    names = [printable_name(part.name) for part in parts]
    coloured = [number for number, part in enumerate(parts) if part.colour is not None]

    def write_model(into: IO[bytes]) -> None:
        """Write the model: materials, meshes and build."""
        into.write(model_head({"Application": APPLICATION}).encode())
        into.write(_format_materials([(names[k], parts[k]) for k in coloured], len(parts) + 1).encode())
        for number, part in enumerate(parts):
            name = f" name={quote_attribute(names[number])}" if names[number] else ""
            material = f' pid="{len(parts) + 1}" pindex="{coloured.index(number)}"' if number in coloured else ""
            into.write(f'<object id="{number + 1}" type="model"{name}{material}>'.encode())
            write_mesh(into, part.surface.vertices, part.surface.faces)
            into.write(b"</object>")
        into.write(model_end(range(1, len(parts) + 1)).encode())

    write_package(file, write_model)


def write_package(file: BinaryIO, model: Callable[[IO[bytes]], None], attached: Sequence[Attachment] = ()) -> None:
    """Write a 3MF with a model by a function, and with attached files."""
    media = {**TYPES, **{attachment.name.rpartition(".")[2]: attachment.media for attachment in attached}}
    types = "".join(f' <Default Extension="{suffix}" ContentType="{kind}"/>\n' for suffix, kind in media.items())
    related = [
        (MODEL_PATH, MODEL_RELATION),
        *((attachment.name, attachment.relation) for attachment in attached if attachment.relation),
    ]
    relations = "".join(
        f' <Relationship Target="/{name}" Id="rel{number}" Type="{kind}"/>\n'
        for number, (name, kind) in enumerate(related)
    )
    packaging = "http://schemas.openxmlformats.org/package/2006"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=4) as package:
        package.writestr(
            _package_entry("[Content_Types].xml"),
            f'{XML_DECLARATION}<Types xmlns="{packaging}/content-types">\n{types}</Types>\n',
        )
        package.writestr(
            _package_entry("_rels/.rels"),
            f'{XML_DECLARATION}<Relationships xmlns="{packaging}/relationships">\n{relations}</Relationships>\n',
        )
        with package.open(MODEL_PATH, "w", force_zip64=True) as into:
            model(into)
        for attachment in attached:
            package.writestr(_package_entry(attachment.name), attachment.content)


def _package_entry(name: str) -> zipfile.ZipInfo:
    """Return an entry of a package with a constant date, so that files are reproducible."""
    entry = zipfile.ZipInfo(name)
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


def model_head(metadata: Mapping[str, str], namespaces: Mapping[str, str] | None = None) -> str:
    """Return the beginning of a model in millimetres, up to its resources."""
    spaces = "".join(f' xmlns:{prefix}="{address}"' for prefix, address in (namespaces or {}).items())
    entries = "".join(
        f' <metadata name="{name}">{html.escape(printable_name(text))}</metadata>\n' for name, text in metadata.items()
    )
    return f'{XML_DECLARATION}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}"{spaces}>\n{entries} <resources>'


def model_end(built: Iterable[int]) -> str:
    """Return the end of a model that builds the objects with the given numbers."""
    items = "".join(f'<item objectid="{number}"/>' for number in built)
    return f"</resources>\n <build>{items}</build>\n</model>\n"


def write_mesh(into: IO[bytes], vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> None:
    """Write vertices and triangles as a mesh of a model."""
    into.write(b"<mesh><vertices>\n")
    write_rows(into, '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', vertices)
    into.write(b"</vertices><triangles>\n")
    write_rows(into, '<triangle v1="%d" v2="%d" v3="%d"/>\n', faces)
    into.write(b"</triangles></mesh>")


def _format_materials(coloured: Sequence[tuple[str, Part]], number: int) -> str:
    """Return the resource with the colours of named parts; empty if there are none."""
    if not coloured:
        return ""
    bases = "".join(
        f'<base name={quote_attribute(name or "part")} displaycolor="{hex_colour(part.colour)}"/>'
        for name, part in coloured
        if part.colour is not None
    )
    return f'<basematerials id="{number}">{bases}</basematerials>\n'


def quote_attribute(text: str) -> str:
    """Return a text as the value of an attribute, which preserves line breaks and tabs."""
    escaped = html.escape(text)
    for character in "\n\r\t":
        escaped = escaped.replace(character, f"&#{ord(character)};")
    return f'"{escaped}"'
