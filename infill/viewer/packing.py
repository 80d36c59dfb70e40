"""Surfaces as bytes for a browser: `page/src/viewer/mesh.js` reads them.

Little endian: b"IFM1", the length of the header as uint32, the header as JSON, padded with spaces, and arrays, each
padded to 4 bytes. The header lists the surfaces; offsets of their arrays count from the end of the header:

positions : (V, 3) uint16, of which `low + size * position / 65535` is the vertex, mm
indices : (F, 3) uint32, each minus the one before it, modulo 2³²
values : (V,) uint8, or nothing
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.imaging.label_tables import Colour
from infill.surface import Surface

MAGIC: Final = b"IFM1"
STEPS: Final = 65535  # of a position, from one end of the bounds to the other
ALIGNMENT: Final = 4  # bytes


def pack_surfaces(
    surfaces: Mapping[str, Surface],
    *,
    colours: Mapping[str, Colour] | None = None,
    values: Mapping[str, NDArray[np.uint8]] | None = None,
) -> bytes:
    """Pack named surfaces for a browser.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        mm. Vertices move by half a step of 1/65535 of the bounds at most, along each axis.
    colours : mapping of str to (red, green, blue), optional
        Of surfaces that have one, from 0 to 1, sRGB.
    values : mapping of str to (V,) uint8, optional
        A number for every vertex of a surface, such as a distance, which the page shows as a colour.

    Returns
    -------
    bytes

    Raises
    ------
    ParameterError
        If the values of a surface are not as many as its vertices.
    """
    arrays: list[bytes] = []
    entries = []
    end = 0

    def place(array: NDArray[Any]) -> int:
        """Append an array; return its offset."""
        nonlocal end
        data = _pad(array.tobytes(), b"\0")
        arrays.append(data)
        end += len(data)
        return end - len(data)

    for name, surface in surfaces.items():
        low, size, positions = quantise(surface.vertices)
        value = None if values is None else values.get(name)
        if value is not None and value.shape != (len(surface.vertices),):
            raise ParameterError.about("values", f"are {value.shape}, and {name} has {len(surface.vertices)} vertices")
        entries.append(
            {
                "name": name,
                "vertices": len(surface.vertices),
                "triangles": len(surface.faces),
                "low": low.tolist(),
                "size": size.tolist(),
                "closed": bool(surface.closed),
                "colour": None if colours is None or name not in colours else list(colours[name]),
                "positions": place(positions),
                "indices": place(subtract_previous(surface.faces)),
                "values": None if value is None else place(value.astype("<u1")),
            }
        )
    header = _pad(json.dumps({"surfaces": entries}, separators=(",", ":")).encode(), b" ")
    return b"".join([MAGIC, len(header).to_bytes(4, "little"), header, *arrays])


def quantise(
    vertices: NDArray[np.floating],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint16]]:
    """Return the lower corner and the size of the bounds, mm, and the vertices in steps of them, (V, 3) uint16.

    >>> low, size, steps = quantise(np.array([[0.0, 1, 2], [10, 1, 4], [5, 1, 3]]))
    >>> low.tolist(), size.tolist(), steps.tolist()
    ([0.0, 1.0, 2.0], [10.0, 0.0, 2.0], [[0, 0, 0], [65535, 0, 65535], [32768, 0, 32768]])
    """
    if not len(vertices):
        return np.zeros(3), np.zeros(3), np.zeros((0, 3), dtype="<u2")
    low = np.array([column.min() for column in vertices.T], dtype=np.float64)
    size = np.array([column.max() for column in vertices.T], dtype=np.float64) - low
    scale = np.divide(STEPS, size, out=np.zeros(3), where=size > 0)
    return low, size, np.rint((vertices - low) * scale).astype("<u2")


def subtract_previous(faces: NDArray[np.integer]) -> NDArray[np.uint32]:
    """Return the indices of faces (F, 3) in one row, each minus the one before it, modulo 2³².

    >>> subtract_previous(np.array([[0, 1, 2], [2, 1, 3]])).tolist()
    [0, 1, 1, 0, 4294967295, 2]
    """
    indices = np.ascontiguousarray(faces, dtype=np.uint32).ravel()
    return np.diff(indices, prepend=np.uint32(0)).astype("<u4")


def _pad(data: bytes, filler: bytes) -> bytes:
    """Fill up bytes to a multiple of `ALIGNMENT`."""
    return data + filler * (-len(data) % ALIGNMENT)
