"""`save`: a mesh to a file, the format by its suffix."""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.output import whole_file
from infill.surface import Surface
from infill.surfaces.merging import surface_of
from infill.version import __version__

if TYPE_CHECKING:
    import trimesh

AT_ONCE = 100_000  # triangles or vertices formatted at a time: a few tens of MB of text

STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
STL_ASCII = ("facet normal {0} {0} {0}\n outer loop\n" + 3 * "  vertex {0} {0} {0}\n" + " endloop\nendfacet\n").format(
    "%.9g"
)
PLY_FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])

GLTF_FLOAT, GLTF_UNSIGNED, GLTF_VERTICES, GLTF_INDICES = 5126, 5125, 34962, 34963

THREEMF_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""
THREEMF_RELATIONS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
THREEMF_HEAD = f"""<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">phasefill-{__version__}</metadata>
 <resources><object id="1" type="model"><mesh><vertices>
"""
THREEMF_TAIL = """</triangles></mesh></object></resources>
 <build><item objectid="1"/></build>
</model>
"""


def save(mesh: trimesh.Trimesh | Surface, path: str | os.PathLike[str], *, ascii: bool = False) -> Path:  # noqa: A002
    """Write a mesh; an existing file is replaced once the new one is complete.

    Parameters
    ----------
    mesh : trimesh.Trimesh or Surface, mm
    path : str or Path
        .stl, .3mf, .obj, .ply or .glb. A .glb holds millimetres too, as slicers and CAD write it,
        though glTF means metres.
    ascii : bool
        Text instead of binary; STL only.

    Returns
    -------
    Path

    Raises
    ------
    FormatError
        For an unknown suffix, or ascii in another format than STL.
    GeometryError
        For a mesh without faces, or with corners that are not finite.
    OutputError
        If the file cannot be written.
    """
    target = Path(path)
    write = writer(target, ascii=ascii)
    surface = surface_of(mesh)
    with whole_file(target) as file:
        write(surface, file)
    return target


def writer(path: Path, *, ascii: bool = False, more: tuple[str, ...] = ()) -> Callable[[Surface, BinaryIO], None]:  # noqa: A002
    """Return the function that writes the format of `path`, or raise FormatError, which names `more` suffixes too."""
    suffix = path.suffix.lower()
    if suffix not in WRITERS:
        given = f"the suffix {path.suffix!r}" if suffix else f"{path.name!r}, which has no suffix"
        raise FormatError(f"cannot tell a mesh format from {given}; use one of {', '.join((*WRITERS, *more))}")
    if ascii and suffix != ".stl":
        raise FormatError(f"only .stl can be written as text by choice, not {suffix}; leave ascii out")
    return write_stl_ascii if ascii else WRITERS[suffix]


def write_stl(surface: Surface, file: BinaryIO) -> None:
    """Write binary STL: 50 bytes a triangle, 32-bit coordinates."""
    space = f" SPACE={surface.space}" if surface.space else ""  # as 3D Slicer writes and reads it
    file.write(f"phasefill {__version__} UNITS=mm{space}".encode().ljust(80))
    file.write(np.uint32(len(surface.faces)).astype("<u4").tobytes())
    for corners in _corners(surface):
        record = np.zeros(len(corners), dtype=STL_RECORD)
        record["corners"] = corners
        record["normal"] = _normals(corners)
        file.write(record.tobytes())


def write_stl_ascii(surface: Surface, file: BinaryIO) -> None:
    """Write STL as text."""
    file.write(b"solid phasefill\n")
    for corners in _corners(surface):
        numbers = np.concatenate([_normals(corners)[:, None], corners], axis=1)
        file.write((STL_ASCII * len(corners) % tuple(numbers.ravel().tolist())).encode())
    file.write(b"endsolid phasefill\n")


def write_obj(surface: Surface, file: BinaryIO) -> None:
    """Write Wavefront OBJ."""
    file.write(f"# phasefill {__version__}, millimetres\no infill\n".encode())
    _write_rows(file, "v %.9g %.9g %.9g\n", surface.vertices)
    _write_rows(file, "f %d %d %d\n", surface.faces, add=1)


def write_ply(surface: Surface, file: BinaryIO) -> None:
    """Write binary PLY."""
    file.write(
        "ply\nformat binary_little_endian 1.0\n"
        f"comment phasefill {__version__}, millimetres\n"
        f"element vertex {len(surface.vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(surface.faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
    )
    file.write(surface.vertices.astype("<f4").tobytes())
    faces = np.empty(len(surface.faces), dtype=PLY_FACE)
    faces["count"] = 3
    faces["corners"] = surface.faces
    file.write(faces.tobytes())


def write_3mf(surface: Surface, file: BinaryIO) -> None:
    """Write 3MF, core specification only: one object, in millimetres."""
    import zipfile

    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=4) as package:
        package.writestr("[Content_Types].xml", THREEMF_TYPES)
        package.writestr("_rels/.rels", THREEMF_RELATIONS)
        with package.open("3D/3dmodel.model", "w", force_zip64=True) as model:
            model.write(THREEMF_HEAD.encode())
            _write_rows(model, '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', surface.vertices)
            model.write(b"</vertices><triangles>\n")
            _write_rows(model, '<triangle v1="%d" v2="%d" v3="%d"/>\n', surface.faces)
            model.write(THREEMF_TAIL.encode())


def write_glb(surface: Surface, file: BinaryIO) -> None:
    """Write binary glTF 2.0: a JSON chunk that describes one mesh, and a chunk of its numbers."""
    vertices, faces = surface.vertices.astype("<f4"), surface.faces.astype("<u4")
    parts = (vertices.nbytes, faces.nbytes)
    described = {
        "asset": {"version": "2.0", "generator": f"phasefill {__version__}"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": GLTF_FLOAT, "count": len(vertices), "type": "VEC3",
             "min": vertices.min(axis=0).tolist(), "max": vertices.max(axis=0).tolist()},
            {"bufferView": 1, "componentType": GLTF_UNSIGNED, "count": faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": parts[0], "target": GLTF_VERTICES},
            {"buffer": 0, "byteOffset": parts[0], "byteLength": parts[1], "target": GLTF_INDICES},
        ],
        "buffers": [{"byteLength": sum(parts)}],
    }  # fmt: skip
    text = json.dumps(described, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + sum(parts)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", sum(parts), b"BIN\0") + vertices.tobytes() + faces.tobytes())


WRITERS: dict[str, Callable[[Surface, BinaryIO], None]] = {
    ".stl": write_stl,
    ".3mf": write_3mf,
    ".obj": write_obj,
    ".ply": write_ply,
    ".glb": write_glb,
}


def _corners(surface: Surface) -> Iterator[NDArray[np.float32]]:
    """Yield the corners of the triangles, (n, 3, 3) float32, some at a time."""
    vertices = surface.vertices.astype(np.float32)
    for low in range(0, len(surface.faces), AT_ONCE):
        yield vertices[surface.faces[low : low + AT_ONCE]]


def _normals(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    unit: NDArray[np.float32] = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    return unit


def _write_rows(file: IO[bytes], row: str, values: NDArray[np.generic], add: int = 0) -> None:
    """Write one formatted row of text per row of `values`."""
    for low in range(0, len(values), AT_ONCE):
        some = values[low : low + AT_ONCE] + add if add else values[low : low + AT_ONCE]
        file.write((row * len(some) % tuple(some.ravel().tolist())).encode())
