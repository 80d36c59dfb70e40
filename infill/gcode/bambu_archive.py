"""The archives that Bambu Studio and OrcaSlicer print from (.gcode.3mf): a zip with the G-code of each plate.

    Metadata/plate_1.gcode        the text
    Metadata/plate_1.gcode.md5    its MD5 in hexadecimal digits

A printer rejects a plate whose MD5 does not match, so the MD5 is compared on reading and recomputed on writing.
"""

from __future__ import annotations

import hashlib
import re
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from copy import copy
from typing import BinaryIO

from infill.errors import FormatError, ParameterError
from infill.gcode.stream import MAX_CHUNK_BYTES, whole_lines

PLATE_NAME = re.compile(r"Metadata/plate_([0-9]+)\.gcode")
MD5_SUFFIX = ".md5"
ZIP64_SIZE = 1 << 30  # bytes; from here on the zip is told that a member may pass 2 GiB
SLICE_AGAIN = "copy or slice the file again"


def is_archive(head: bytes) -> bool:
    """Return True if a file begins like a zip (four bytes are enough); `list_plates` finds the G-code in it."""
    return head[:4] == b"PK\x03\x04"


def list_plates(file: BinaryIO) -> tuple[int, ...]:
    """List the numbers of the plates that have G-code, in order.

    Raises
    ------
    FormatError
        The file is not a zip, is damaged, or holds no G-code.
    """
    with _open_archive(file) as archive:
        return tuple(sorted(_find_members(archive)))


def read_plate(file: BinaryIO, plate: int) -> Iterator[bytes]:
    """Read the G-code text of one plate in pieces of whole lines.

    Raises
    ------
    FormatError
        As `list_plates`; or, after the last piece, the stated MD5 does not match the text.
    ParameterError
        The archive does not have this plate.
    """
    return whole_lines(_read_text(file, plate))


def rewrite_archive(source: BinaryIO, target: BinaryIO, texts: Mapping[int, Iterable[bytes]]) -> None:
    """Copy an archive with new G-code and a new MD5 for some plates; all other members keep their bytes.

    Parameters
    ----------
    source, target : BinaryIO
        The old file and the new one.
    texts : mapping from plate to iterable of bytes
        The new text of each plate that changes, in pieces of any length, read one by one. It may come from
        `read_plate` of the same file opened a second time.

    Raises
    ------
    FormatError, ParameterError
        As `read_plate`.
    """
    with _open_archive(source) as old, zipfile.ZipFile(target, "w") as new:
        members = _find_members(old)
        changed = {_get_member(members, plate): text for plate, text in texts.items()}
        for info in old.infolist():
            if info.filename in changed:
                _write_plate(old, new, info, changed[info.filename])
            elif info.filename.removesuffix(MD5_SUFFIX) not in changed:
                with _open_member(new, info) as writing:
                    writing.writelines(_read_chunks(old, info.filename))
        new.comment = old.comment


def _write_plate(old: zipfile.ZipFile, new: zipfile.ZipFile, info: zipfile.ZipInfo, text: Iterable[bytes]) -> None:
    """Write the text of a plate as an archive member, and its new MD5 where the old archive states one."""
    digest = hashlib.md5(usedforsecurity=False)
    with _open_member(new, info) as writing:
        for piece in text:
            digest.update(piece)
            writing.write(piece)
    stated = _stated_md5(old, info.filename)
    if stated is not None:
        new_sum = digest.hexdigest()
        # Some readers want capitals: follow the old file.
        new_sum = new_sum if stated == stated.lower() else new_sum.upper()
        with _open_member(new, old.getinfo(info.filename + MD5_SUFFIX)) as writing:
            writing.write(new_sum.encode())


def _read_text(file: BinaryIO, plate: int) -> Iterator[bytes]:
    """Yield the text of a plate in chunks; raise at the end if its MD5 differs."""
    with _open_archive(file) as archive:
        name = _get_member(_find_members(archive), plate)
        digest = hashlib.md5(usedforsecurity=False)
        for piece in _read_chunks(archive, name):
            digest.update(piece)
            yield piece
        stated = _stated_md5(archive, name)
    if stated is not None and stated.lower() != digest.hexdigest():
        raise FormatError(f"{name} is damaged: its MD5 does not fit; {SLICE_AGAIN}")


def _stated_md5(archive: zipfile.ZipFile, name: str) -> str | None:
    """Read the MD5 that the archive states for a plate, if any."""
    if name + MD5_SUFFIX not in archive.namelist():
        return None
    return next(_read_chunks(archive, name + MD5_SUFFIX), b"").decode("ascii", "replace").strip()


def _find_members(archive: zipfile.ZipFile) -> dict[int, str]:
    """Return the archive members that hold G-code, by the number of their plate."""
    matches = (PLATE_NAME.fullmatch(name) for name in archive.namelist())
    members = {int(match[1]): match[0] for match in matches if match}
    if not members:
        raise FormatError("the archive holds no G-code (Metadata/plate_1.gcode); slice the plate, then export it again")
    return members


def _get_member(members: Mapping[int, str], plate: int) -> str:
    """Return the archive member of a plate; raise if there is none."""
    if plate not in members:
        available = ", ".join(map(str, sorted(members)))
        raise ParameterError.about("plate", f"is {plate}, which is not in the archive; it has {available}")
    return members[plate]


def _open_member(new: zipfile.ZipFile, like: zipfile.ZipInfo) -> BinaryIO:
    """Open a new member for writing, with the name, date and compression of an old one."""
    # A copy: zipfile changes sizes and offsets in the object it gets.
    return new.open(copy(like), "w", force_zip64=like.file_size > ZIP64_SIZE)  # type: ignore[return-value]


def _open_archive(file: BinaryIO) -> zipfile.ZipFile:
    """Open an archive; raise for other compressions and for names that occur twice."""
    with _wrap_zip_errors():
        archive = zipfile.ZipFile(file)
    names = archive.namelist()
    if any(info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED) for info in archive.infolist()):
        raise FormatError(f"the archive is not compressed as slicers do it; {SLICE_AGAIN}")
    if len(set(names)) < len(names):  # readers disagree on which of them counts
        twice = next(name for number, name in enumerate(names) if name in names[:number])
        raise FormatError(f"the archive holds {twice!r} twice; {SLICE_AGAIN}")
    return archive


def _read_chunks(archive: zipfile.ZipFile, name: str) -> Iterator[bytes]:
    """Yield the bytes of an archive member in chunks."""
    with _wrap_zip_errors(), archive.open(name) as reading:
        while piece := reading.read(MAX_CHUNK_BYTES):
            yield piece


@contextmanager
def _wrap_zip_errors() -> Iterator[None]:
    """Raise FormatError, in one line, where the zip itself is at fault.

    zipfile raises RuntimeError for an encrypted one, ValueError for a name that is not text, OSError for an offset
    before its start.
    """
    try:
        yield
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError, OSError) as trouble:
        raise FormatError(f"the archive cannot be read ({str(trouble) or 'it ends early'}); {SLICE_AGAIN}") from None
