"""Cells behind a header or in files beside it: a single file, or a list of files with equal shares of the cells."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE
from infill.imaging.assumed import warn
from infill.imaging.packed import BLANK_BYTES, cut_off_error, read_bytes
from infill.imaging.vtk_images import TEXT_BYTES, TEXT_CHUNK, parse_numbers
from infill.machine import require_memory

MOST_FILES = 100_000
LONGEST_LINE = 2**20  # bytes
NUMBER_PATTERN = re.compile(r"([^%]*)%(0?[0-9]{0,2})d([^%]*)")
PACKINGS = ("zlib", "gzip", "bzip2")


@dataclass(frozen=True, kw_only=True)
class DataFile:
    """A file that holds cells.

    Parameters
    ----------
    path : Path
    begin : int
        Where the data begin, bytes.
    lines : int
        Number of lines to skip from there.
    skip : int
        Number of bytes to skip then; for packed data, after unpacking.
    from_end : bool
        Whether the cells are the last bytes of the file, regardless of the bytes before them.
    packed_bytes : int, optional
        Number of packed bytes; all to the end of the file if left out.
    """

    path: Path
    begin: int = 0
    lines: int = 0
    skip: int = 0
    from_end: bool = False
    packed_bytes: int | None = None


def find_data_file(header: Path, name: str) -> Path:
    """Find the data file that a header names: beside the header, unless the name has a folder."""
    stripped = name.strip()
    # A name written on Windows may contain folders of that computer.
    for candidate in (stripped, stripped.replace("\\", "/"), re.split(r"[\\/]", stripped)[-1]):
        if candidate and "\0" not in candidate and (path := header.parent / candidate).is_file():
            return path
    raise FormatError(f"{header} keeps its cells in {stripped[:200]!r}, which is not there; put that file beside it")


def numbered_names(header: Path, pattern: str, low: int, high: int, step: int) -> list[str]:
    """Return the names that a pattern such as `slice%03d.raw` produces for the numbers from `low` to `high` inclusive.

    >>> numbered_names(Path("a.nhdr"), "a%02d.raw", 1, 5, 2)
    ['a01.raw', 'a03.raw', 'a05.raw']
    """
    match = NUMBER_PATTERN.fullmatch(pattern)
    numbers = range(low, high + (1 if step > 0 else -1), step) if step else range(0)
    if match is None or not 0 < len(numbers) <= MOST_FILES:
        raise FormatError(
            f"{header} names its files by {pattern[:80]!r} from {low} to {high} by {step}; list 1 to {MOST_FILES} files"
        )
    prefix, width, suffix = match.groups()
    return [f"{prefix}{number:{width or '0'}d}{suffix}" for number in numbers]


def read_data_files(
    header: Path, parts: Sequence[DataFile], kind: np.dtype[Any], total: int, low: int, high: int, *, encoding: str
) -> NDArray[Any]:
    """Read cells `low` to `high - 1` of the `total` that a header announces, and check that the files hold them all.

    Parameters
    ----------
    header : Path
        The file that announces them, for messages.
    parts : sequence of DataFile
    kind : dtype
        Of a cell, with the order of its bytes.
    total, low, high : int
    encoding : {"raw", "text", "hex", "zlib", "gzip", "bzip2"}

    Raises
    ------
    FormatError
        If the files hold fewer or more cells, or damaged ones.
    MemoryLimitError
        If the cells need too much memory.
    """
    share, remainder = divmod(total, len(parts))
    if remainder:
        raise FormatError(
            f"{header} keeps {total} cells in {len(parts)} files, which cannot be equal shares; check its sizes"
        )
    require_memory((high - low) * kind.itemsize * (1 if len(parts) == 1 else 2), None, SMALLER_VOLUME_ADVICE)
    pieces = []
    for number, part in enumerate(parts):
        begin, end = np.clip((low - number * share, high - number * share), 0, share).tolist()
        pieces.append(_read_part(header, part, kind, share, begin, end, encoding))
    return pieces[0] if len(pieces) == 1 else np.concatenate(pieces)


def _read_part(
    header: Path, part: DataFile, kind: np.dtype[Any], total: int, low: int, high: int, encoding: str
) -> NDArray[Any]:
    """Read cells `low` to `high - 1` of one file."""
    size = kind.itemsize
    # Messages name the header and the file beside it.
    source = str(header) if part.path == header else f"{header}, with its cells in {part.path.name},"
    with part.path.open("rb") as file:
        file.seek(part.begin)
        for _ in range(part.lines):
            if not file.readline(LONGEST_LINE):
                raise FormatError(f"{source} ends within the {part.lines} lines to skip; check its header")
        if encoding == "text":
            file.seek(part.skip, os.SEEK_CUR)
            return _read_text(source, file, kind, total)[low:high]
        if encoding == "hex":
            return np.frombuffer(_read_hex(source, file, total * size), dtype=kind)[low:high]
        packed = encoding in PACKINGS
        if part.from_end:
            available = os.fstat(file.fileno()).st_size - file.tell()
            if available < total * size:
                raise cut_off_error(source, available, total * size)
            if available > total * size:
                warn(
                    "%s holds %d bytes more than its header announces; the last %d are taken for the cells, since what "
                    "stands before them is said to be of any size (-1)",
                    source,
                    available - total * size,
                    total * size,
                )
            file.seek(-total * size, os.SEEK_END)
        elif not packed:
            file.seek(part.skip, os.SEEK_CUR)
        lead = part.skip if packed else 0
        cells = read_bytes(
            source,
            file,
            (high - low) * size,
            packing=encoding if packed else "",
            packed_bytes=part.packed_bytes,
            skip=lead + low * size,
            total=lead + total * size,
        )
    return cells.view(kind)


def _read_text(source: str, file: BinaryIO, kind: np.dtype[Any], count: int) -> NDArray[Any]:
    """Read exactly `count` numbers, separated by white space or commas."""
    if os.fstat(file.fileno()).st_size - file.tell() < 2 * count - 1:
        raise cut_off_error(source, os.fstat(file.fileno()).st_size - file.tell(), 2 * count - 1, "characters")
    require_memory(TEXT_BYTES * (min(TEXT_CHUNK, count) + count), None, SMALLER_VOLUME_ADVICE)
    pieces: list[NDArray[Any]] = []
    count_read = 0
    while count_read <= count and (lines := file.readlines(TEXT_CHUNK)):
        pieces.append(parse_numbers(b"".join(lines).replace(b",", b" ").split(), kind))
        count_read += len(pieces[-1])
    if count_read < count:
        raise cut_off_error(source, count_read, count, "numbers")
    if count_read > count:
        raise FormatError(f"{source} holds more numbers than the {count} that its header announces; check its sizes")
    return np.concatenate(pieces)


def _read_hex(source: str, file: BinaryIO, count: int) -> bytes:
    """Read bytes written as two digits each, separated by any white space."""
    remaining = os.fstat(file.fileno()).st_size - file.tell()
    if remaining < 2 * count:
        raise cut_off_error(source, remaining // 2, count)
    require_memory(remaining + 2 * count, None, SMALLER_VOLUME_ADVICE)
    content = bytes.fromhex(file.read().translate(None, BLANK_BYTES).decode("ascii", "replace"))
    if len(content) != count:
        raise FormatError(f"{source} holds {len(content)} bytes, and its header announces {count}; check its sizes")
    return content
