"""Write binary glTF 2.0: a JSON chunk that describes meshes, and a chunk of their numbers.

glTF is in metres. Vertices are written in millimetres, which 32 bits preserve as in all other formats, and a node
scaled by 1/1000 converts them to metres.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from typing import Any, BinaryIO

from infill.errors import FormatError
from infill.formats.parts import Part, printable_name
from infill.imaging.label_tables import Colour
from infill.surface import Surface
from infill.version import __version__

FLOAT, UNSIGNED, VERTICES, INDICES = 5126, 5125, 34962, 34963
MILLIMETRE = 0.001  # of a metre
LARGEST_FILE = 2**32 - 1  # bytes, the largest size that the format can state


def write_glb(surface: Surface, file: BinaryIO) -> None:
    """Write one mesh as binary glTF 2.0: a JSON chunk and a chunk of its numbers."""
    write_glb_parts([Part(surface=surface)], file)


def write_glb_parts(parts: Sequence[Part], file: BinaryIO) -> None:
    """Write meshes as binary glTF 2.0: a node for each part, with its name and its colour.

    Raises
    ------
    FormatError
        If the file would exceed 4 GiB.
    """
    surfaces = (part.surface for part in parts)  # each may be made when it is asked for
    sizes = [size for surface in surfaces for size in (12 * len(surface.vertices), 12 * len(surface.faces))]
    description = _describe(parts, sizes)
    text = json.dumps(description, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file_size = 12 + 8 + len(text) + 8 + sum(sizes)
    if file_size > LARGEST_FILE:
        raise FormatError(
            f"a .glb holds at most 4 GiB and this has {file_size / 2**30:.1f}; write .3mf, or simplify it"
        )
    file.write(struct.pack("<4sII", b"glTF", 2, file_size))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", sum(sizes), b"BIN\0"))
    for part in parts:
        surface = part.surface
        file.write(surface.vertices.astype("<f4").tobytes() + surface.faces.astype("<u4").tobytes())


def _describe(parts: Sequence[Part], sizes: Sequence[int]) -> dict[str, Any]:
    """Return the JSON chunk: two accessors and two buffer views for each part."""
    coloured = [(number, part.colour) for number, part in enumerate(parts) if part.colour is not None]
    material = {number: index for index, (number, _) in enumerate(coloured)}
    names = [{"name": name} if (name := printable_name(part.name)) else {} for part in parts]
    nodes, meshes, accessors = [], [], []
    for number, part in enumerate(parts):
        vertices = part.surface.vertices.astype("<f4")
        appearance = {"material": material[number]} if number in material else {}
        primitive = {"attributes": {"POSITION": 2 * number}, "indices": 2 * number + 1, **appearance}
        nodes.append({"mesh": number, "scale": [MILLIMETRE] * 3, **names[number]})
        meshes.append({"primitives": [primitive], **names[number]})
        accessors += [
            {
                "bufferView": 2 * number,
                "componentType": FLOAT,
                "count": len(vertices),
                "type": "VEC3",
                "min": vertices.min(axis=0).tolist(),
                "max": vertices.max(axis=0).tolist(),
            },
            {
                "bufferView": 2 * number + 1,
                "componentType": UNSIGNED,
                "count": part.surface.faces.size,
                "type": "SCALAR",
            },
        ]
    views = [
        {
            "buffer": 0,
            "byteOffset": sum(sizes[:number]),
            "byteLength": size,
            "target": INDICES if number % 2 else VERTICES,
        }
        for number, size in enumerate(sizes)
    ]
    looks = {"materials": [_material(names[number], colour) for number, colour in coloured]} if coloured else {}
    return {
        "asset": {"version": "2.0", "generator": f"phasefill {__version__}"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(parts)))}],
        "nodes": nodes,
        "meshes": meshes,
        **looks,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": sum(sizes)}],
    }


def _material(name: dict[str, str], colour: Colour) -> dict[str, Any]:
    """Return a material of one colour in linear light, as glTF stores it: IEC 61966-2-1."""
    linear = [channel / 12.92 if channel <= 0.04045 else ((channel + 0.055) / 1.055) ** 2.4 for channel in colour]
    return {**name, "pbrMetallicRoughness": {"baseColorFactor": [*linear, 1.0], "metallicFactor": 0.0}}
