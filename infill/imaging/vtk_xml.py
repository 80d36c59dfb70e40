"""VTK's XML format .vti: an image as text, base64, or bytes appended to the XML, plain or packed by zlib.

Source: "VTK XML file formats", VTK documentation. Every array has a head of whole numbers: its bytes; or, if it is
packed, the number of blocks, their size, that of the last one (0 if it is full), and the packed size of each.
"""

from __future__ import annotations

import base64
import math
import re
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.frames import choose_frame
from infill.imaging.vtk_images import Lattice, parse_numbers
from infill.machine import require_memory
from infill.volume import AXES, Volume

TYPES = {
    **{f"Int{8 * size}": f"i{size}" for size in (1, 2, 4, 8)},
    **{f"UInt{8 * size}": f"u{size}" for size in (1, 2, 4, 8)},
    "Float32": "f4",
    "Float64": "f8",
}
ZLIB = "vtkZLibDataCompressor"
APPENDED = re.compile(rb"<AppendedData\b[^>]*>\s*_")
BASE64_IN, BASE64_OUT = 3, 4  # bytes become characters
TEXT_BYTES = 100  # of memory for each number that is text: words, then numbers


@dataclass(frozen=True, kw_only=True)
class _Coding:
    """Storage of numbers: byte order, type of the head, packing, and the appended part."""

    order: Literal["<", ">"]
    head: np.dtype[np.generic]
    packed: bool
    appended: memoryview
    in_base64: bool


def read_vti(path: Path, frame: int | None = None) -> Volume:
    """Read the scalars of an image, [x, y, z], or one component of them, counted from 0."""
    with wrap_reader_errors(path):
        require_memory(2 * path.stat().st_size, None, SMALLER_VOLUME_ADVICE)
        content = path.read_bytes()
        marker = APPENDED.search(content)
        text = content if marker is None else content[: marker.start()] + b"</VTKFile>"
        # The standard parser fetches nothing from outside, and its output is only counted and turned into numbers.
        root = ElementTree.fromstring(text)  # noqa: S314
        image = root.find("ImageData")
        if root.tag != "VTKFile" or image is None:
            raise FormatError(f"{path} holds no ImageData of VTK; save an image as .vti")
        coding = _coding(path, root, memoryview(content)[len(content) if marker is None else marker.end() :], marker)
        return _assemble(path, image, coding, frame)


def _coding(path: Path, root: ElementTree.Element, appended: memoryview, tag: re.Match[bytes] | None) -> _Coding:
    """Return the storage of numbers by the attributes of the file."""
    compressor = root.get("compressor", "")
    if compressor not in ("", ZLIB):
        raise FormatError(f"{path} is packed by {compressor[:40]}; save it packed by zlib, or not packed")
    order: Literal["<", ">"] = ">" if root.get("byte_order") == "BigEndian" else "<"
    return _Coding(
        order=order,
        head=_kind(root.get("header_type", "UInt32")).newbyteorder(order),
        packed=bool(compressor),
        appended=appended,
        in_base64=tag is not None and b'"base64"' in tag[0].replace(b"'", b'"'),
    )


def _assemble(path: Path, image: ElementTree.Element, coding: _Coding, frame: int | None) -> Volume:
    """Assemble the volume from the pieces of an image."""
    extent = _extent(image.get("WholeExtent", ""))
    if image.get("Spacing") is None:
        warn("%s does not say the size of its cells; 1 mm is taken, unless --spacing gives it", path)
    spacing = _numbers(image.get("Spacing", "1 1 1"), AXES)
    direction = _numbers(image.get("Direction", "1 0 0 0 1 0 0 0 1"), AXES * AXES).reshape(AXES, AXES)
    first_point = _numbers(image.get("Origin", "0 0 0"), AXES) + direction @ (spacing * extent[:, 0])
    lattice = Lattice(
        points=tuple((extent[:, 1] - extent[:, 0] + 1).tolist()),
        origin=first_point,
        spacing=spacing,
        direction=direction,
    )
    pieces = [(piece, *_find_scalars(path, piece)) for piece in image.findall("Piece")]
    if not pieces:
        raise FormatError(f"{path} holds an image without a piece; save it again")
    _, array, in_cells = pieces[0]
    shape, kind = lattice.shape(in_cells=in_cells), _kind(array.get("type", ""))
    numbers = int(array.get("NumberOfComponents", "1"))
    component = choose_frame(path, frame, numbers, what=f"holds {numbers} numbers per cell")
    cell_bytes = kind.itemsize + (TEXT_BYTES if array.get("format") == "ascii" else kind.itemsize)
    require_memory(math.prod(shape) * numbers * cell_bytes, None, SMALLER_VOLUME_ADVICE)
    values = np.empty(0)
    covered = 0
    for piece, array, inside in pieces:
        part = _extent(piece.get("Extent", image.get("WholeExtent", "")))
        low = part[:, 0] - extent[:, 0]
        size = np.maximum(1, part[:, 1] - part[:, 0] + (0 if in_cells else 1))
        if inside != in_cells or (low < 0).any() or (low + size > shape).any():
            raise FormatError(f"{path} has pieces that do not fit into it; save it again")
        numbers_of_piece = _array_values(array, coding, int(size.prod()) * numbers)
        cells = numbers_of_piece[component::numbers].reshape(size, order="F")
        if len(pieces) == 1 and tuple(size) == shape:
            return lattice.volume(path, cells, in_cells=in_cells)
        if not covered:
            values = np.zeros(shape, dtype=kind)
        values[tuple(slice(begin, begin + count) for begin, count in zip(low, size, strict=True))] = cells
        covered += int(size.prod())
    if covered < math.prod(shape):
        raise FormatError(f"{path} lacks a part of itself: its pieces do not cover it; save it again")
    return lattice.volume(path, values, in_cells=in_cells)


def _find_scalars(path: Path, piece: ElementTree.Element) -> tuple[ElementTree.Element, bool]:
    """Return the scalars of a piece, or else its first array, and whether it belongs to the cells."""
    for section_name in ("PointData", "CellData"):
        section = piece.find(section_name)
        if section is None:
            continue
        arrays = [array for array in section.findall("DataArray") if array.get("type") in TYPES]
        named = [array for array in arrays if array.get("Name") == section.get("Scalars")]
        if arrays:
            return (named or arrays)[0], section_name == "CellData"
    raise FormatError(f"{path} holds no array of numbers; save an image with one number per point")


def _array_values(array: ElementTree.Element, coding: _Coding, count: int) -> NDArray[Any]:
    """Return exactly `count` numbers of an array."""
    kind = _kind(array.get("type", ""))
    form = array.get("format")
    if form == "ascii":
        values = parse_numbers((array.text or "").encode().split(), kind)
    else:
        if form == "appended":
            begin = int(array.get("offset", "-1"))
            if not 0 <= begin < max(1, len(coding.appended)):
                raise ValueError("an array that begins where there is nothing")
            raw, in_base64 = coding.appended[begin:], coding.in_base64
        else:
            raw, in_base64 = memoryview("".join((array.text or "").split()).encode()), True
        data = _unpack(raw, coding, count * kind.itemsize, in_base64=in_base64)
        values = np.frombuffer(data, dtype=kind.newbyteorder(coding.order))
    if len(values) != count:
        raise ValueError(f"{len(values)} numbers where there should be {count}")
    return values


def _unpack(raw: memoryview, coding: _Coding, needed: int, *, in_base64: bool) -> bytes:
    """Return the `needed` bytes of an array, decompressed."""
    word = coding.head.itemsize

    def head(begin: int, count: int) -> list[int]:
        return [
            int(number)
            for number in np.frombuffer(_slice_bytes(raw, begin, count * word, in_base64), dtype=coding.head)
        ]

    if not coding.packed:
        size = head(0, 1)[0]
        if size != needed:
            raise ValueError(f"{size} bytes where there should be {needed}")
        return _slice_bytes(raw, 0, word + size, in_base64)[word:]
    blocks, size, last_size = head(0, 3)
    if blocks > len(raw) or (blocks - (last_size > 0)) * size + last_size != needed:
        raise ValueError(f"{blocks} blocks of {size} bytes where there should be {needed} bytes")
    packed = head(0, 3 + blocks)[3:]
    # The head is encoded in base64 separately, and the packed blocks after it as one.
    begin = math.ceil((3 + blocks) * word / BASE64_IN) * BASE64_OUT if in_base64 else (3 + blocks) * word
    data, parts = _slice_bytes(raw, begin, sum(packed), in_base64), []
    position = 0
    for number, length in enumerate(packed):
        stream = zlib.decompressobj()
        expected = last_size if last_size and number == blocks - 1 else size
        parts.append(
            stream.decompress(data[position : position + length], expected + 1)
        )  # its checksum is read with its end
        if len(parts[-1]) != expected or not stream.eof:
            raise ValueError(f"a block of {len(parts[-1])} bytes or more where there should be {expected}")
        position += length
    return b"".join(parts)


def _slice_bytes(raw: memoryview, begin: int, count: int, in_base64: bool) -> bytes:
    """Return `count` decoded bytes from the raw position `begin` on, or raise EOFError."""
    if in_base64:
        text = raw[begin : begin + math.ceil(count / BASE64_IN) * BASE64_OUT]
        decoded = base64.b64decode(text, validate=True)[:count]
    else:
        decoded = bytes(raw[begin : begin + count])
    if len(decoded) < count:
        raise EOFError(f"{len(decoded)} bytes where there should be {count}: it is cut off")
    return decoded


def _kind(name: str) -> np.dtype[np.generic]:
    """Return the NumPy type of a VTK type."""
    if name not in TYPES:
        raise ValueError(f"numbers of a type {name[:40]!r}")
    return np.dtype(TYPES[name])


def _extent(text: str) -> NDArray[np.int64]:
    """Return the first and last point along each axis, (3, 2)."""
    numbers = np.array([int(word) for word in text.split()], dtype=np.int64)
    ranges = numbers.reshape(AXES, 2)
    if (ranges[:, 1] < ranges[:, 0]).any():
        raise ValueError(f"an extent of {text!r}")
    return ranges


def _numbers(text: str, count: int) -> NDArray[np.float64]:
    """Parse exactly `count` numbers."""
    numbers = np.array([float(word) for word in text.split()])
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers in {text!r} where there should be {count}")
    return numbers
