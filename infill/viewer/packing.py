"""Surfaces as bytes for a browser: `page/src/viewer/mesh.js` reads them.

Little endian: b"IFM1", the length of the header as uint32, the header as JSON, padded with spaces, and arrays, each
padded to 4 bytes. The header lists the surfaces; offsets of their arrays count from the end of the header:

positions : (V, 3) uint16, of which `low + size * position / 65535` is the vertex, mm
indices : (F, 3) uint32, each minus the one before it, modulo 2³²
values : (V,) uint8, or nothing

A compact surface has `symbols`, `named` and `places` instead of positions and indices, each as an offset and a number
of bytes: see `infill.viewer.compact`.
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
COMPACT_FROM: Final = 20_000  # triangles: fewer are small enough, and need no compiler


def pack_surfaces(
    surfaces: Mapping[str, Surface],
    *,
    colours: Mapping[str, Colour] | None = None,
    values: Mapping[str, NDArray[np.uint8]] | None = None,
    compact: bool = False,
) -> bytes:
    """Pack named surfaces for a browser.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        mm. Vertices move by half a step of 1/65535 of the bounds at most, along each axis.
    colours : mapping of str to (red, green, blue), optional
        Of surfaces that have one, from 0 to 1, sRGB.
    values : mapping of str to (V,) uint8, optional
        A number for every vertex of a surface, which the page shows as a colour: 128 leaves that of the surface, less
        is red, more is blue.
    compact : bool
        Whether surfaces of 20 thousand triangles or more become smaller: a third when they are compressed, which takes
        longer. Triangles and vertices come in another order then.

    Returns
    -------
    bytes

    Raises
    ------
    ParameterError
        If the values of a surface are not as many as its vertices.
    """
    packing = _Packing()
    for name, surface in surfaces.items():
        value = None if values is None else values.get(name)
        if value is not None and value.shape != (len(surface.vertices),):
            raise ParameterError.about("values", f"are {value.shape}, and {name} has {len(surface.vertices)} vertices")
        colour = None if colours is None or name not in colours else list(colours[name])
        packing.add(name, surface, colour, value, compact=compact and len(surface.faces) >= COMPACT_FROM)
    return packing.finish()


class _Packing:
    """The header and the arrays of packed surfaces, while they are added."""

    def __init__(self) -> None:
        self._arrays: list[bytes] = []
        self._end = 0
        self._entries: list[dict[str, Any]] = []

    def add(
        self, name: str, surface: Surface, colour: list[float] | None, value: NDArray[np.uint8] | None, *, compact: bool
    ) -> None:
        """Add a surface."""
        low, size, steps = quantise(surface.vertices)
        entry: dict[str, Any] = {
            "name": name,
            "vertices": len(steps),
            "triangles": len(surface.faces),
            "low": low.tolist(),
            "size": size.tolist(),
            "closed": bounds_solid(surface),
            "colour": colour,
        }
        if compact:
            from infill.viewer.compact import encode_compact

            coded = encode_compact(surface.faces, steps)
            value = None if value is None else value[coded.origin]
            entry["vertices"] = len(coded.origin)
            entry |= {key: [self._place(array), len(array)] for key, array in coded.arrays().items()}
        else:
            entry |= {"positions": self._place(steps), "indices": self._place(subtract_previous(surface.faces))}
        entry["values"] = None if value is None else self._place(value.astype("<u1"))
        self._entries.append(entry)

    def _place(self, array: NDArray[Any]) -> int:
        """Append an array; return its offset."""
        data = _pad(array.tobytes(), b"\0")
        self._arrays.append(data)
        self._end += len(data)
        return self._end - len(data)

    def finish(self) -> bytes:
        """Return the header and the arrays."""
        header = _pad(json.dumps({"surfaces": self._entries}, separators=(",", ":")).encode(), b" ")
        return b"".join([MAGIC, len(header).to_bytes(4, "little"), header, *self._arrays])


def bounds_solid(surface: Surface) -> bool:
    """Tell whether a cut through a surface can be filled: as many triangles run along every edge one way as the other.

    >>> bounds_solid(Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]])))
    False
    """
    edges = None if surface.closed else surface.edges
    return surface.closed or (edges is not None and not edges.surplus.any())


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
