"""Numbers in VTK's XML files: text, base64, or bytes appended to the XML, plain or packed by zlib.

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
from infill.files.broken import SMALLER_VOLUME_ADVICE
from infill.imaging.vtk_images import parse_numbers
from infill.machine import require_memory

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
class VtkCoding:
    """Storage of numbers: byte order, type of the head, packing, and the appended part."""

    order: Literal["<", ">"]
    head: np.dtype[np.generic]
    packed: bool
    appended: memoryview
    in_base64: bool


def read_vtk_xml(path: Path, kind: str, what: str) -> tuple[ElementTree.Element, VtkCoding]:
    """Read the XML of a file; return the element of its data, such as ImageData, and the storage of its numbers.

    Parameters
    ----------
    path : Path
    kind : str
        Name of the element.
    what : str
        The remedy, if the file holds something else.
    """
    require_memory(2 * path.stat().st_size, None, SMALLER_VOLUME_ADVICE)
    content = path.read_bytes()
    marker = APPENDED.search(content)
    text = content if marker is None else content[: marker.start()] + b"</VTKFile>"
    # The standard parser fetches nothing from outside, and its output is only counted and turned into numbers.
    root = ElementTree.fromstring(text)  # noqa: S314
    data = root.find(kind)
    if root.tag != "VTKFile" or data is None:
        raise FormatError(f"{path} holds no {kind} of VTK; {what}")
    return data, _coding(path, root, memoryview(content)[len(content) if marker is None else marker.end() :], marker)


def _coding(path: Path, root: ElementTree.Element, appended: memoryview, tag: re.Match[bytes] | None) -> VtkCoding:
    """Return the storage of numbers by the attributes of the file."""
    compressor = root.get("compressor", "")
    if compressor not in ("", ZLIB):
        raise FormatError(f"{path} is packed by {compressor[:40]}; save it packed by zlib, or not packed")
    order: Literal["<", ">"] = ">" if root.get("byte_order") == "BigEndian" else "<"
    return VtkCoding(
        order=order,
        head=number_type(root.get("header_type", "UInt32")).newbyteorder(order),
        packed=bool(compressor),
        appended=appended,
        in_base64=tag is not None and b'"base64"' in tag[0].replace(b"'", b'"'),
    )


def array_values(array: ElementTree.Element, coding: VtkCoding, count: int) -> NDArray[Any]:
    """Return exactly `count` numbers of an array."""
    kind = number_type(array.get("type", ""))
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


def _unpack(raw: memoryview, coding: VtkCoding, needed: int, *, in_base64: bool) -> bytes:
    """Return the `needed` bytes of an array, decompressed."""
    word = coding.head.itemsize

    def read_head(begin: int, count: int) -> list[int]:
        """Read numbers of the header of an array."""
        return [
            int(number)
            for number in np.frombuffer(_slice_bytes(raw, begin, count * word, in_base64), dtype=coding.head)
        ]

    if not coding.packed:
        size = read_head(0, 1)[0]
        if size != needed:
            raise ValueError(f"{size} bytes where there should be {needed}")
        return _slice_bytes(raw, 0, word + size, in_base64)[word:]
    blocks, size, last_size = read_head(0, 3)
    if blocks > len(raw) or (blocks - (last_size > 0)) * size + last_size != needed:
        raise ValueError(f"{blocks} blocks of {size} bytes where there should be {needed} bytes")
    packed = read_head(0, 3 + blocks)[3:]
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


def number_type(name: str) -> np.dtype[np.generic]:
    """Return the NumPy type of a VTK type."""
    if name not in TYPES:
        raise ValueError(f"numbers of a type {name[:40]!r}")
    return np.dtype(TYPES[name])
