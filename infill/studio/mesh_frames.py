"""Meshes in frames: the surfaces of an answer as one pack for the page."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from infill.studio.frames import MESH, Frame
from infill.surface import Surface

MAGIC = b"IFM1"
LARGEST = 2**16 - 1


def pack_surfaces(surfaces: Mapping[str, Surface], colours: Mapping[str, Any] | None = None) -> bytes:
    """Return surfaces as one mesh pack: positions of 16 bits, and differences of indices."""
    entries, arrays, offset = [], list[bytes](), 0
    for name, surface in surfaces.items():
        low, high = np.asarray(surface.bounds, dtype=np.float64)
        size = np.maximum(high - low, 1e-9)
        positions = np.round((surface.vertices - low) / size * LARGEST).astype("<u2")
        indices = np.diff(surface.faces.ravel().astype(np.int64), prepend=0).astype(np.uint32).astype("<u4")
        places = []
        for array in (positions, indices):
            data = array.tobytes()
            places.append(offset)
            arrays.append(data + bytes(-len(data) % 4))
            offset += len(arrays[-1])
        entries.append(
            {
                "name": name,
                "vertices": len(surface.vertices),
                "triangles": len(surface.faces),
                "low": low.tolist(),
                "size": size.tolist(),
                "colour": list((colours or {}).get(name, ())) or None,
                "positions": places[0],
                "indices": places[1],
                "values": None,
            }
        )
    header = json.dumps({"surfaces": entries}).encode()
    header += b" " * (-len(header) % 4)
    return b"".join([MAGIC, len(header).to_bytes(4, "little"), header, *arrays])


def mesh_frame(surfaces: Mapping[str, Surface], colours: Mapping[str, Any] | None = None) -> Frame:
    """Return surfaces as a frame."""
    return Frame(kind=MESH, payload=pack_surfaces(surfaces, colours))
