"""Archives of plates: text and MD5 go together, and everything else stays."""

from __future__ import annotations

import hashlib
import io
import zipfile

import pytest

from infill.errors import FormatError, ParameterError
from infill.gcode.bambu_archive import is_archive, list_plates, read_plate, rewrite_archive

TEXT = b"".join(b"G1 X%d E.1\n" % number for number in range(20_000))


def digest(text: bytes) -> bytes:
    return hashlib.md5(text).hexdigest().upper().encode()


def archive(first: bytes = TEXT, stated: bytes | None = None) -> io.BytesIO:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        new.writestr("[Content_Types].xml", "<Types/>")
        new.writestr("Metadata/plate_2.gcode.md5", digest(b"G28\n").lower())
        new.writestr("Metadata/plate_2.gcode", b"G28\n")
        new.writestr("Metadata/plate_1.gcode", first)
        new.writestr("Metadata/plate_1.gcode.md5", digest(first) if stated is None else stated)
        new.writestr(zipfile.ZipInfo("Metadata/plate_1.png", (2026, 1, 2, 3, 4, 6)), bytes(range(256)))
        new.comment = b"a comment"
    return file


def contents(file: io.BytesIO) -> dict[str, bytes]:
    with zipfile.ZipFile(file) as whole:
        return {name: whole.read(name) for name in whole.namelist()}


def test_a_plate_is_read_in_whole_lines() -> None:
    assert is_archive(archive().getvalue())
    assert list_plates(archive()) == (1, 2)
    pieces = list(read_plate(archive(), 1))
    assert b"".join(pieces) == TEXT
    assert len(pieces) > 3
    assert all(piece.endswith(b"\n") for piece in pieces)


def test_only_the_plate_and_its_sum_change() -> None:
    old, target = archive(), io.BytesIO()
    rewrite_archive(old, target, {1: (piece.replace(b"X", b"Y") for piece in read_plate(archive(), 1))})
    text = TEXT.replace(b"X", b"Y")
    wanted = contents(old) | {"Metadata/plate_1.gcode": text, "Metadata/plate_1.gcode.md5": digest(text)}
    assert contents(target) == wanted
    with zipfile.ZipFile(old) as before, zipfile.ZipFile(target) as after:
        assert after.comment == before.comment
        for one, two in zip(before.infolist(), after.infolist(), strict=True):
            assert (one.filename, one.date_time, one.compress_type) == (two.filename, two.date_time, two.compress_type)


def test_the_sum_keeps_its_case_and_comes_only_where_it_was() -> None:
    target = io.BytesIO()
    rewrite_archive(archive(), target, {2: [b"G28", b" W\n"]})
    assert contents(target)["Metadata/plate_2.gcode.md5"] == digest(b"G28 W\n").lower()
    bare, target = io.BytesIO(), io.BytesIO()
    with zipfile.ZipFile(bare, "w") as new:
        new.writestr("Metadata/plate_1.gcode", b"G28\n")
    rewrite_archive(bare, target, {1: [b"G1\n"]})
    assert contents(target) == {"Metadata/plate_1.gcode": b"G1\n"}
    assert list(read_plate(target, 1)) == [b"G1\n"]


def test_what_is_wrong_is_told() -> None:
    with pytest.raises(FormatError, match=r"plate_1\.gcode is damaged: its MD5"):
        list(read_plate(archive(stated=digest(b"other")), 1))
    with pytest.raises(ParameterError, match="plate is 3, which is not in the archive; it has 1, 2"):
        rewrite_archive(archive(), io.BytesIO(), {3: []})
    with pytest.raises(FormatError, match="cannot be read"):
        list_plates(io.BytesIO(archive().getvalue()[:-30]))
    empty = io.BytesIO()
    with zipfile.ZipFile(empty, "w") as new:
        new.writestr("a.model", b"")
    with pytest.raises(FormatError, match="holds no G-code"):
        list_plates(empty)
    damaged = bytearray(archive().getvalue())
    place = damaged.index(b"plate_1.gcode") + 40
    damaged[place : place + 4] = b"\xff" * 4
    with pytest.raises(FormatError, match="cannot be read"):
        list(read_plate(io.BytesIO(bytes(damaged)), 1))


def test_a_fault_of_the_caller_does_not_read_as_a_broken_archive() -> None:
    def text():
        yield b"G28\n"
        raise RuntimeError("a bug")

    with pytest.raises(RuntimeError, match="a bug"):
        rewrite_archive(archive(), io.BytesIO(), {1: text()})
