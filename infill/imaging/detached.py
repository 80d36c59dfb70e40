"""Cells that lie behind a header, or in files beside it: one file or a list, each with an equal share of the cells."""

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
from infill.files.broken import SMALLER
from infill.imaging.assumed import warn
from infill.imaging.packed import NOTHING, cut_off, read_bytes
from infill.imaging.vtk_images import AT_ONCE, TEXT_BYTES, numbers_in
from infill.machine import require_memory

MOST_FILES = 100_000
LONGEST_LINE = 2**20  # bytes
PATTERN = re.compile(r"([^%]*)%(0?[0-9]{0,2})d([^%]*)")
PACKINGS = ("zlib", "gzip", "bzip2")


@dataclass(frozen=True, kw_only=True)
class Part:
    """A file that holds cells.

    Parameters
    ----------
    path : Path
    begin : int
        Where the data begin, bytes.
    lines : int
        How many lines to skip from there.
    skip : int
        How many bytes to skip then; of packed data, once they are unpacked.
    from_end : bool
        Whether the cells are the last bytes of the file, whatever stands before them.
    packed_bytes : int, optional
        How many packed bytes there are; all to the end of the file if left out.
    """

    path: Path
    begin: int = 0
    lines: int = 0
    skip: int = 0
    from_end: bool = False
    packed_bytes: int | None = None


def find_detached(header: Path, name: str) -> Path:
    """Return the file of a name that a header gives; it lies beside the header, unless the name leads elsewhere."""
    given = name.strip()
    # Written on Windows, it may lead through folders of that computer.
    for each in (given, given.replace("\\", "/"), re.split(r"[\\/]", given)[-1]):
        if each and "\0" not in each and (found := header.parent / each).is_file():
            return found
    raise FormatError(f"{header} keeps its cells in {given[:200]!r}, which is not there; put that file beside it")


def number_names(header: Path, pattern: str, low: int, high: int, step: int) -> list[str]:
    """Return the names that a pattern such as `slice%03d.raw` stands for, from one number to another.

    >>> number_names(Path("a.nhdr"), "a%02d.raw", 1, 5, 2)
    ['a01.raw', 'a03.raw', 'a05.raw']
    """
    found = PATTERN.fullmatch(pattern)
    numbers = range(low, high + (1 if step > 0 else -1), step) if step else range(0)
    if found is None or not 0 < len(numbers) <= MOST_FILES:
        raise FormatError(
            f"{header} names its files by {pattern[:80]!r} from {low} to {high} by {step}; list 1 to {MOST_FILES} files"
        )
    before, width, after = found.groups()
    return [f"{before}{number:{width or '0'}d}{after}" for number in numbers]


def read_parts(
    header: Path, parts: Sequence[Part], kind: np.dtype[Any], total: int, low: int, high: int, *, encoding: str
) -> NDArray[Any]:
    """Read cells from `low` to before `high` of the `total` that a file announces, and check all of them.

    Parameters
    ----------
    header : Path
        The file that announces them, for messages.
    parts : sequence of Part
    kind : dtype
        Of a cell, with the order of its bytes.
    total, low, high : int
    encoding : {"raw", "text", "hex", "zlib", "gzip", "bzip2"}

    Raises
    ------
    FormatError
        If there are fewer or more than announced, or they are damaged.
    MemoryLimitError
        If there is no room for them.
    """
    each, rest = divmod(total, len(parts))
    if rest:
        raise FormatError(
            f"{header} keeps {total} cells in {len(parts)} files, which cannot be equal shares; check its sizes"
        )
    require_memory((high - low) * kind.itemsize * (1 if len(parts) == 1 else 2), None, SMALLER)
    found = []
    for number, part in enumerate(parts):
        begin, end = np.clip((low - number * each, high - number * each), 0, each).tolist()
        found.append(_read_part(header, part, kind, each, begin, end, encoding))
    return found[0] if len(found) == 1 else np.concatenate(found)


def _read_part(
    header: Path, part: Part, kind: np.dtype[Any], total: int, low: int, high: int, encoding: str
) -> NDArray[Any]:
    size = kind.itemsize
    # A file beside its header is told along with it.
    said = str(header) if part.path == header else f"{header}, with its cells in {part.path.name},"
    with part.path.open("rb") as file:
        file.seek(part.begin)
        for _ in range(part.lines):
            if not file.readline(LONGEST_LINE):
                raise FormatError(f"{said} ends within the {part.lines} lines to skip; check its header")
        if encoding == "text":
            file.seek(part.skip, os.SEEK_CUR)
            return _read_text(said, file, kind, total)[low:high]
        if encoding == "hex":
            return np.frombuffer(_read_hex(said, file, total * size), dtype=kind)[low:high]
        packed = encoding in PACKINGS
        if part.from_end:
            held = os.fstat(file.fileno()).st_size - file.tell()
            if held < total * size:
                raise cut_off(said, held, total * size)
            if held > total * size:
                warn(
                    "%s holds %d bytes more than its header announces; the last %d are taken for the cells, since what "
                    "stands before them is said to be of any size (-1)",
                    said,
                    held - total * size,
                    total * size,
                )
            file.seek(-total * size, os.SEEK_END)
        elif not packed:
            file.seek(part.skip, os.SEEK_CUR)
        before = part.skip if packed else 0
        cells = read_bytes(
            said,
            file,
            (high - low) * size,
            packing=encoding if packed else "",
            packed_bytes=part.packed_bytes,
            skip=before + low * size,
            total=before + total * size,
        )
    return cells.view(kind)


def _read_text(said: str, file: BinaryIO, kind: np.dtype[Any], count: int) -> NDArray[Any]:
    """Return exactly so many numbers, with any white space, commas too, between them."""
    if os.fstat(file.fileno()).st_size - file.tell() < 2 * count - 1:
        raise cut_off(said, os.fstat(file.fileno()).st_size - file.tell(), 2 * count - 1, "characters")
    require_memory(TEXT_BYTES * (min(AT_ONCE, count) + count), None, SMALLER)
    found: list[NDArray[Any]] = []
    held = 0
    while held <= count and (lines := file.readlines(AT_ONCE)):
        found.append(numbers_in(b"".join(lines).replace(b",", b" ").split(), kind))
        held += len(found[-1])
    if held < count:
        raise cut_off(said, held, count, "numbers")
    if held > count:
        raise FormatError(f"{said} holds more numbers than the {count} that its header announces; check its sizes")
    return np.concatenate(found)


def _read_hex(said: str, file: BinaryIO, count: int) -> bytes:
    """Return bytes written as two digits each, with any white space between them."""
    left = os.fstat(file.fileno()).st_size - file.tell()
    if left < 2 * count:
        raise cut_off(said, left // 2, count)
    require_memory(left + 2 * count, None, SMALLER)
    held = bytes.fromhex(file.read().translate(None, NOTHING).decode("ascii", "replace"))
    if len(held) != count:
        raise FormatError(f"{said} holds {len(held)} bytes, and its header announces {count}; check its sizes")
    return held
