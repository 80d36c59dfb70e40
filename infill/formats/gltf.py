"""Binary glTF 2.0: a JSON chunk that describes one mesh, and a chunk of its numbers."""

from __future__ import annotations

import json
import struct
from typing import BinaryIO

from infill.formats.foreign import read_by_trimesh
from infill.surface import Surface
from infill.version import __version__

FLOAT, UNSIGNED, VERTICES, INDICES = 5126, 5125, 34962, 34963
read_glb = read_by_trimesh


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
            {"bufferView": 0, "componentType": FLOAT, "count": len(vertices), "type": "VEC3",
             "min": vertices.min(axis=0).tolist(), "max": vertices.max(axis=0).tolist()},
            {"bufferView": 1, "componentType": UNSIGNED, "count": faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": parts[0], "target": VERTICES},
            {"buffer": 0, "byteOffset": parts[0], "byteLength": parts[1], "target": INDICES},
        ],
        "buffers": [{"byteLength": sum(parts)}],
    }  # fmt: skip
    text = json.dumps(described, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + sum(parts)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", sum(parts), b"BIN\0") + vertices.tobytes() + faces.tobytes())
