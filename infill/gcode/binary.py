"""Binary G-code (.bgcode) read as text and metadata, and written: the meaning of the blocks of `block_file`.

A file written with MeatPack does not return every byte that went in: see `meatpack`.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import BinaryIO

from infill.errors import FormatError, OutputError, ParameterError
from infill.gcode import heatshrink, meatpack
from infill.gcode.block_file import (
    HEAD,
    MAGIC,
    SLICE_AGAIN,
    Block,
    Compression,
    Encoding,
    Kind,
    is_binary,
    pack_block,
    read_blocks,
)
from infill.gcode.stream import whole_lines

__all__ = [
    "Block",
    "Compression",
    "Encoding",
    "Kind",
    "decode_block",
    "edit_metadata",
    "encode_block",
    "is_binary",
    "pack_block",
    "read_blocks",
    "read_metadata",
    "read_text_pieces",
    "rewrite_binary",
]

WINDOW_BITS = {Compression.HEATSHRINK_11: 11, Compression.HEATSHRINK_12: 12}
METADATA_KINDS = (Kind.FILE_METADATA, Kind.SLICER_METADATA, Kind.PRINTER_METADATA, Kind.PRINT_METADATA)


def decode_block(block: Block) -> bytes:
    """Decode the content of a block: G-code text, metadata as key=value lines, or an image.

    Raises
    ------
    FormatError
        The data does not decompress to the size that the block states, or does not unpack.
    """
    try:
        data = _decompress(block)
        packed = block.kind == Kind.GCODE and block.encoding != Encoding.NONE
        return meatpack.unpack_text(data) if packed else data
    except FormatError as told:
        raise FormatError(f"{block.name}: {told}") from None


def encode_block(text: bytes, *, like: Block) -> Block:
    """Make a block that holds a text, encoded and compressed like another block.

    MeatPack drops blank lines, blanks and comments behind commands, see `meatpack.normalise_text`. Prusa's firmware
    stops a print where a block of G-code has another encoding or compression than the previous block, so neither
    changes from block to block, even where a block grows. Each block is decoded as a check before it is returned.

    Parameters
    ----------
    text : bytes
        Whole lines of G-code, or key=value lines of metadata.
    like : Block
        The block whose kind, encoding and compression the new one takes.

    Raises
    ------
    OutputError
        The block does not decode to the text; with MeatPack the bytes 255 255 cannot be written.
    """
    data = expected = text
    if like.kind == Kind.GCODE and like.encoding != Encoding.NONE:
        comments = like.encoding == Encoding.MEATPACK_COMMENTS
        expected = meatpack.normalise_text(text, comments=comments)
        data = meatpack.pack_text(expected, comments=comments)
    result = replace(like, data=_compress(data, like.compression), size=len(data), number=0)
    try:
        same = decode_block(result) == expected
    except FormatError:
        same = False
    if not same:
        raise OutputError(
            f"a block of G-code from {text[:40]!r} on does not read back; is there text that is not UTF-8?"
        )
    return result


def read_metadata(block: Block) -> dict[str, str]:
    """Read the keys and values of a block of metadata."""
    lines = _metadata_text(block).decode(errors="surrogateescape").split("\n")
    return {key: value for key, equals, value in (line.partition("=") for line in lines) if equals}


def edit_metadata(block: Block, changes: Mapping[str, str]) -> Block:
    """Change values of a block of metadata; skip keys that it lacks, and keep all else.

    Raises
    ------
    ParameterError
        A new value has a line break in it.
    """
    for key, value in changes.items():
        if "\n" in value or "\r" in value:
            raise ParameterError(
                f"the value of {key} is {value!r}, and metadata has one line each; take the breaks out"
            )
    lines = _metadata_text(block).split(b"\n")
    named = {_encode_text(key): _encode_text(value) for key, value in changes.items()}
    new = []
    for line in lines:
        word = line.partition(b"=")[0]
        new.append(word + b"=" + named[word] if b"=" in line and word in named else line)
    return block if new == lines else replace(encode_block(b"\n".join(new), like=block), number=block.number)


def read_text_pieces(file: BinaryIO) -> Iterator[bytes]:
    """Read the G-code text of a file in pieces of whole lines, up to LONGEST_TEXT bytes; a longer line is one piece.

    Raises
    ------
    FormatError
        As `read_blocks` and `decode_block`; or the file has no G-code.
    """
    return whole_lines(_read_texts(file))


def rewrite_binary(
    source: BinaryIO, target: BinaryIO, text: Iterable[bytes], changes: Mapping[str, str] | None = None
) -> frozenset[str]:
    """Write a file with other G-code text; copy everything else byte for byte; return the keys of `changes` it has.

    The new blocks of G-code stand where the first old one stood, have its encoding, and hold at most LONGEST_TEXT
    bytes of text each, in whole lines.

    Parameters
    ----------
    source, target : BinaryIO
        The old file at its start, and the new one.
    text : iterable of bytes
        The new text in pieces of any length, read one by one; it may come from `read_text_pieces` of the same file
        opened a second time.
    changes : mapping, optional
        New values of metadata of the print and of the printer.

    Returns
    -------
    frozenset of str
        The keys of `changes` that the file has.
    """
    changes = changes or {}
    present_keys: set[str] = set()
    started = copied = False
    for block in read_blocks(source):
        if not started:
            target.write(HEAD.pack(MAGIC, 1, block.summed))
            started = True
        if block.kind == Kind.GCODE:
            if not copied:
                copied = True
                target.writelines(pack_block(encode_block(piece, like=block)) for piece in whole_lines(text))
            continue
        if changes and block.kind in (Kind.PRINT_METADATA, Kind.PRINTER_METADATA):
            present_keys |= read_metadata(block).keys() & changes.keys()
            block = edit_metadata(block, changes)
        target.write(pack_block(block))
    if not copied:
        raise FormatError(f"binary G-code without a block of G-code; {SLICE_AGAIN}")
    return frozenset(present_keys)


def _read_texts(file: BinaryIO) -> Iterator[bytes]:
    """Yield the decoded text of every G-code block; raise if there is none."""
    empty = True
    for block in read_blocks(file):
        if block.kind == Kind.GCODE:
            empty = False
            yield decode_block(block)
    if empty:
        raise FormatError(f"binary G-code without a block of G-code; {SLICE_AGAIN}")


def _encode_text(text: str) -> bytes:
    """Encode text as UTF-8; bytes that were not text come back as they were."""
    return text.encode(errors="surrogateescape")


def _metadata_text(block: Block) -> bytes:
    """Return the INI text of a metadata block."""
    if block.kind not in METADATA_KINDS:
        raise ParameterError(f"{block.name} holds no metadata; take one of metadata")
    if block.encoding != 0:
        raise FormatError(f"{block.name} has encoding {block.encoding}, and only 0 (INI) is read here; {SLICE_AGAIN}")
    return decode_block(block)


def _decompress(block: Block) -> bytes:
    """Return the data of a block, decompressed; raise if its size is not the stated one."""
    match block.compression:
        case Compression.NONE:
            return block.data
        case Compression.DEFLATE:
            inflating = zlib.decompressobj()
            try:
                data = inflating.decompress(block.data, block.size + 1)
            except zlib.error as trouble:
                raise FormatError(f"its data cannot be inflated ({trouble}); {SLICE_AGAIN}") from None
            if len(data) != block.size or not inflating.eof:
                raise FormatError(f"its data does not inflate to the {block.size} bytes that it states; {SLICE_AGAIN}")
            return data
    return heatshrink.decompress_heatshrink(block.data, size=block.size, window=WINDOW_BITS[block.compression])


def _compress(data: bytes, compression: Compression) -> bytes:
    """Return data compressed as a block states it."""
    match compression:
        case Compression.NONE:
            return data
        case Compression.DEFLATE:
            return zlib.compress(data)
    return heatshrink.compress_heatshrink(data, window=WINDOW_BITS[compression])
