"""The frame of binary G-code (.bgcode): a header of ten bytes, then blocks of metadata, thumbnails and packed G-code.

    head    "GCDE", version 1 (4 bytes), checksum 0 none or 1 CRC32 (2)
    block   kind (2), compression (2), size (4), size as stored (4, if compressed),
            parameters (6 for a thumbnail, else 2: the encoding), data, CRC32 of all that (4, if the head says so)

Integers are little-endian. Source: doc/specifications.md of https://github.com/prusa3d/libbgcode. One block is in
memory at a time.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import BinaryIO

from infill.errors import FormatError

MAGIC = b"GCDE"
HEAD = struct.Struct("<4sIH")
MAX_BLOCK_BYTES, MAX_PACKED_BYTES = (
    1 << 28,
    1 << 24,
)  # bytes; real blocks are below 1 MB, or all G-code in one plain block
SLICE_AGAIN = "copy or slice the file again"


class Kind(IntEnum):
    """Content of a block."""

    FILE_METADATA = 0
    GCODE = 1
    SLICER_METADATA = 2
    PRINTER_METADATA = 3
    PRINT_METADATA = 4
    THUMBNAIL = 5


class Compression(IntEnum):
    """Compression of a block's data."""

    NONE = 0
    DEFLATE = 1
    HEATSHRINK_11 = 2
    HEATSHRINK_12 = 3


class Encoding(IntEnum):
    """Encoding of a block's G-code text, before compression."""

    NONE = 0
    MEATPACK = 1
    MEATPACK_COMMENTS = 2


@dataclass(frozen=True, kw_only=True)
class Block:
    """One block as stored in the file.

    Attributes
    ----------
    kind, compression : Kind, Compression
        Kind of the data, and its compression.
    size : int
        Bytes of the data once decompressed.
    parameters : bytes
        2 bytes, the encoding; of a thumbnail 6 bytes: format, width, height.
    data : bytes
        The data as stored.
    summed : bool
        Whether the file has checksums.
    number : int
        Place in the file from 1, for messages; 0 for a new block.
    """

    kind: Kind
    compression: Compression
    size: int
    parameters: bytes
    data: bytes
    summed: bool
    number: int = 0

    @property
    def encoding(self) -> int:
        """Encoding of the data; of a thumbnail, its format."""
        return int.from_bytes(self.parameters[:2], "little")

    @property
    def name(self) -> str:
        """Place and kind of the block, for messages."""
        return block_name(self.number, self.kind)


def block_name(number: int, kind: Kind) -> str:
    """Return the place and kind of a block as text, for messages."""
    return f"block {number} ({kind.name.lower().replace('_', ' ').replace('gcode', 'G-code')})"


def is_binary(head: bytes) -> bool:
    """Return True if the first bytes of a file are those of binary G-code (four are enough), whatever its name."""
    return head[:4] == MAGIC


def read_blocks(file: BinaryIO) -> Iterator[Block]:
    """Read the blocks of a file one by one, and compare checksums.

    Raises
    ------
    FormatError
        The file is cut off or damaged, or has an unsupported version, checksum, kind, compression or encoding;
        the message names the block.
    """
    head = file.read(HEAD.size)
    if not is_binary(head):
        raise FormatError(f"not binary G-code: it starts with {head[:4]!r}, and GCDE is needed")
    if len(head) < HEAD.size:
        raise FormatError(f"binary G-code is cut off: {len(head)} of the {HEAD.size} bytes of its head; {SLICE_AGAIN}")
    _, version, checksum = HEAD.unpack(head)
    if version != 1:
        raise FormatError(f"binary G-code of version {version}, and only 1 is known; export it as plain G-code")
    if checksum not in (0, 1):
        raise FormatError(f"binary G-code with checksum type {checksum}, and only 0 and 1 are known; {SLICE_AGAIN}")
    number = 0
    while block := _read_block(file, number := number + 1, summed=checksum == 1):
        yield block


def _read_block(file: BinaryIO, number: int, *, summed: bool) -> Block | None:
    """Read the next block of a binary file, or None at its end; `summed` says that checksums follow."""
    head = file.read(8)
    if not head:
        return None
    kind_number, compression_number, size = struct.unpack("<HHI", head.ljust(8, b"\0"))
    if len(head) < 8:
        raise FormatError(f"block {number} is cut off: {len(head)} of the first 8 bytes; {SLICE_AGAIN}")
    if kind_number not in Kind.__members__.values():
        raise FormatError(f"block {number} is of kind {kind_number}, and only 0 to 5 are known; {SLICE_AGAIN}")
    kind = Kind(kind_number)
    name = block_name(number, kind)
    if compression_number not in Compression.__members__.values():
        raise FormatError(f"{name} has compression {compression_number}, and only 0 to 3 are known; {SLICE_AGAIN}")
    compression = Compression(compression_number)
    packed_size = b"" if compression == Compression.NONE else file.read(4)
    parameters = file.read(6 if kind == Kind.THUMBNAIL else 2)
    encoding = int.from_bytes(parameters[:2], "little")
    if kind == Kind.GCODE and encoding not in Encoding.__members__.values():
        raise FormatError(f"{name} has encoding {encoding}, and only 0 to 2 are known; export it as plain G-code")
    length = int.from_bytes(packed_size, "little") if packed_size else size
    limit = (
        MAX_BLOCK_BYTES
        if compression == Compression.NONE and (kind != Kind.GCODE or encoding == 0)
        else MAX_PACKED_BYTES
    )
    if max(size, length) > limit:
        raise FormatError(
            f"{name} states {max(size, length)} bytes, and {limit} are the most that we read; {SLICE_AGAIN}"
        )
    data, sum_bytes = file.read(length), file.read(4 * summed)
    expected_sizes = (
        0 if compression == Compression.NONE else 4,
        6 if kind == Kind.THUMBNAIL else 2,
        length,
        4 * summed,
    )
    if (sizes := (len(packed_size), len(parameters), len(data), len(sum_bytes))) != expected_sizes:
        raise FormatError(f"{name} is cut off: {8 + sum(sizes)} of its {8 + sum(expected_sizes)} bytes; {SLICE_AGAIN}")
    body = head + packed_size + parameters + data
    if summed and zlib.crc32(body) != int.from_bytes(sum_bytes, "little"):
        raise FormatError(f"{name} is damaged: its checksum does not fit; {SLICE_AGAIN}")
    return Block(
        kind=kind,
        compression=compression,
        size=size,
        parameters=parameters,
        data=data,
        summed=summed,
        number=number,
    )


def pack_block(block: Block) -> bytes:
    """Return the bytes of a block as stored in a file, with its checksum."""
    sizes = (block.size,) if block.compression == Compression.NONE else (block.size, len(block.data))
    head = struct.pack(f"<HH{len(sizes)}I", block.kind, block.compression, *sizes)
    body = head + block.parameters + block.data
    return body + struct.pack("<I", zlib.crc32(body)) if block.summed else body
