"""Binary glTF 2.0: a JSON chunk that describes one mesh, and a chunk of its numbers.

glTF is in metres. Vertices are written in millimetres, which 32 bits preserve as in all other formats, and a node
scaled by 1/1000 converts them to metres.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.formats.broken import told_broken
from infill.surface import Surface
from infill.version import __version__

FLOAT, UNSIGNED, VERTICES, INDICES = 5126, 5125, 34962, 34963
MILLIMETRE = 0.001  # of a metre


def read_glb(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Return vertices in mm and faces, with every mesh in each of its places in the scene."""
    import trimesh

    with told_broken(path, "is broken", "export the mesh again"):
        scene = trimesh.load_scene(path, process=False)
        parts = [(scene.geometry[name], place) for place, name in map(scene.graph.get, scene.graph.nodes_geometry)]
    vertices, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
    count = 0
    for mesh, place in parts:
        if not isinstance(mesh, trimesh.Trimesh):  # points or lines
            continue
        matrix = np.asarray(place, dtype=np.float64)[:3] / MILLIMETRE
        vertices.append(np.asarray(mesh.vertices, dtype=np.float64) @ matrix[:, :3].T + matrix[:, 3])
        # A mirrored part would face inwards: its corners are taken in reverse order.
        faces.append(np.asarray(mesh.faces)[:, :: -1 if np.linalg.det(matrix[:, :3]) < 0 else 1] + count)
        count += len(mesh.vertices)
    return np.concatenate(vertices), np.concatenate(faces)


def write_glb(surface: Surface, file: BinaryIO) -> None:
    """Write binary glTF 2.0: a JSON chunk that describes one mesh, and a chunk of its numbers."""
    vertices, faces = surface.vertices.astype("<f4"), surface.faces.astype("<u4")
    parts = (vertices.nbytes, faces.nbytes)
    described = {
        "asset": {"version": "2.0", "generator": f"phasefill {__version__}"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [MILLIMETRE] * 3}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": FLOAT,
                "count": len(vertices),
                "type": "VEC3",
                "min": vertices.min(axis=0).tolist(),
                "max": vertices.max(axis=0).tolist(),
            },
            {"bufferView": 1, "componentType": UNSIGNED, "count": faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": parts[0], "target": VERTICES},
            {"buffer": 0, "byteOffset": parts[0], "byteLength": parts[1], "target": INDICES},
        ],
        "buffers": [{"byteLength": sum(parts)}],
    }
    text = json.dumps(described, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + sum(parts)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", sum(parts), b"BIN\0") + vertices.tobytes() + faces.tobytes())
