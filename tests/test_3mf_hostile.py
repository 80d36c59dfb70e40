"""3MF files and attached options that somebody broke or built to do harm: one line, soon, in little memory."""

from __future__ import annotations

import io
import random
import re
import struct
import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from test_3mf_parts import (
    COLUMN,
    ITEM,
    MODEL,
    PART,
    PRUSA,
    by_components,
    by_cura,
    by_ranges,
    component,
    group,
    model,
    packed,
    prusa_config,
    thing,
    volume,
)

from infill import FormatError, MemoryLimitError, check_project, read_mesh
from infill.errors import InfillError
from infill.formats import threemf_package
from infill.lattices.settings import resolve as resolve_fill
from infill.making.settings import resolve as resolve_make
from infill.projects.project import SLICERS
from infill.refilling.settings import resolve as resolve_refill
from infill.smoothing.settings import resolve as resolve_smooth
from patterns import PatternError

GOOD = model(thing(1, PART))
SETTINGS = "Metadata/phasefill.toml"
DECLARED = '<?xml version="1.0" encoding="%s"?>'


def readers(path: Path) -> dict[str, Callable[[], object]]:
    """Whatever opens a 3MF."""
    return {
        "mesh": lambda: read_mesh(path),
        **{slicer: lambda slicer=slicer: check_project(path, slicer) for slicer in SLICERS},  # type: ignore[misc]
        "settings": lambda: resolve_fill({}, config=path),
    }


def refused(read: Callable[[], object], says: str) -> None:
    """Hold that something is refused on one line that a console can show."""
    with pytest.raises((FormatError, MemoryLimitError), match=says) as told:
        read()
    assert str(told.value).isprintable()
    assert len(str(told.value)) < 900


def changed(path: Path, change: Callable[[bytearray, list[zipfile.ZipInfo]], None]) -> Path:
    """Change the bytes of a good package."""
    packed(path, GOOD, **{SETTINGS: 'pattern = "gyroid"\n'})
    with zipfile.ZipFile(path) as package:
        infos = package.infolist()
    whole = bytearray(path.read_bytes())
    change(whole, infos)
    path.write_bytes(whole)
    return path


# --- the zip ----------------------------------------------------------------------------------------------------------


def central(whole: bytearray) -> list[int]:
    return [found.start() for found in re.finditer(b"PK\x01\x02", bytes(whole))]


def set_in_all(
    offset: int, value: bytes, local: int | None = None
) -> Callable[[bytearray, list[zipfile.ZipInfo]], None]:
    """Set a field of all entries, in the list of files and before each of them."""

    def change(whole: bytearray, infos: list[zipfile.ZipInfo]) -> None:
        for start in central(whole):
            whole[start + offset : start + offset + len(value)] = value
        for info in infos if local is not None else ():
            at = info.header_offset + (local or 0)
            whole[at : at + len(value)] = value

    return change


def far_away(whole: bytearray, infos: list[zipfile.ZipInfo]) -> None:
    """A list of files that would begin before the file, at which zipfile asks the system to go there."""
    end = bytes(whole).rfind(b"PK\x05\x06")
    whole[end + 12 : end + 16] = struct.pack("<I", 0xFFFFFF)


ZIPS: dict[str, tuple[Callable[[bytearray, list[zipfile.ZipInfo]], None], str]] = {
    "encrypted": (set_in_all(8, b"\x01\x00", 6), "is encrypted; unpack it with its password"),
    "bzip2": (set_in_all(10, b"\x0c\x00", 8), "is compressed by method 12"),
    "lzma": (set_in_all(10, b"\x0e\x00", 8), "is compressed by method 14"),
    "unknown": (set_in_all(10, b"\x63\x00", 8), "is compressed by method 99"),
    "checksum": (set_in_all(16, b"\x01\x02\x03\x04", 14), "is not a 3MF file .*CRC"),
    "overlapping": (set_in_all(42, b"\x00\x00\x00\x00"), "holds files that overlap"),
    "far away": (far_away, "is not a 3MF file"),
    "a name": (set_in_all(46, b"\x1b[2"), "nothing to build|no 3D/3dmodel|no options|is not a 3MF|twice"),
    "a version": (set_in_all(6, b"\xff\xff"), "is not a 3MF file"),
    "a size": (set_in_all(24, b"\xff\xff\xff\x7f"), "would unpack to"),
}


@pytest.mark.parametrize("fault", ZIPS)
def test_zips_that_are_none_are_refused(fault: str, tmp_path: Path) -> None:
    change, says = ZIPS[fault]
    for read in readers(changed(tmp_path / "a.3mf", change)).values():
        refused(read, says)


def test_a_zip_that_ends_anywhere_is_refused(tmp_path: Path) -> None:
    whole = packed(tmp_path / "a.3mf", GOOD).read_bytes()
    for length in range(1, len(whole) - 1, 97):
        (tmp_path / "b.3mf").write_bytes(whole[:length])
        refused(lambda: read_mesh(tmp_path / "b.3mf"), "is not a 3MF file")


@pytest.mark.parametrize("name", [MODEL, MODEL.upper(), "/" + MODEL, "3D\\3dmodel.model", "3D/3dmodel%2Emodel"])
def test_a_file_that_is_there_twice_is_refused(name: str, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of zipfile, which writes it
        packed(tmp_path / "a.3mf", GOOD)
        with zipfile.ZipFile(tmp_path / "a.3mf", "a") as package:
            package.writestr(name, GOOD)
    for read in readers(tmp_path / "a.3mf").values():
        refused(read, "holds .* twice")


# --- the XML ----------------------------------------------------------------------------------------------------------

ENCODINGS = [
    "x-unknown", "zip", "hex", "rot13", "bz2", "base64", "idna", "punycode", "unicode_escape", "raw_unicode_escape",
    "undefined", "utf-7", "utf-32", "shift_jis", "mbcs", "charmap", "\x1b[2J", "utf-8\x00", "u" * 5000, "",
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("written", ["utf-8", "utf-16", "spaced"])
def test_encodings_of_no_text_are_refused(encoding: str, written: str, tmp_path: Path) -> None:
    text = DECLARED % encoding + GOOD
    if written == "spaced":
        text, written = text.replace(" encoding", " " * 3000 + "encoding"), "utf-8"
    path = tmp_path / "a.3mf"
    for name in (MODEL, PRUSA, "_rels/.rels"):
        packed(path, GOOD)
        with zipfile.ZipFile(path) as package:
            files = {each: package.read(each) for each in package.namelist()}
        files[name] = text.encode(written)
        with zipfile.ZipFile(path, "w") as package:
            for each, content in files.items():
                package.writestr(each, content)
        refused(lambda: read_mesh(path), "is not a 3MF file|has a broken")
        refused(lambda: check_project(path, "prusaslicer"), "is not a 3MF file|has a broken")


@pytest.mark.parametrize("encoding", ["utf-8", "UTF-8", "utf-16", "iso-8859-1", "us-ascii", "windows-1252"])
def test_encodings_of_texts_are_read(encoding: str, tmp_path: Path) -> None:
    text = (DECLARED % encoding + GOOD).encode(encoding)
    with zipfile.ZipFile(tmp_path / "a.3mf", "w") as package:
        package.writestr(MODEL, text)
    assert read_mesh(tmp_path / "a.3mf").volume == pytest.approx(6000)


XMLS = {
    "entities": ('<!DOCTYPE m [<!ENTITY a "&b;&b;"><!ENTITY b "ha">]>' + GOOD, "defines a document type"),
    "from outside": ('<!DOCTYPE m SYSTEM "file:///etc/hosts">' + GOOD, "defines a document type"),
    "deep": (GOOD.replace("<resources>", "<resources>" + "<a>" * 200_000 + "</a>" * 200_000), "in one another"),
    "deep groups": (GOOD.replace("<resources>", "<resources>" + "<object>" * 200), "in one another"),
    "a sign": (GOOD.replace("<resources>", "<resources>\x1b"), "is not a 3MF file"),
    "no number": (GOOD.replace('x="30"', 'x="&#x202e;thirty"'), "holds a number that is not one, among "),
    "digits": (GOOD.replace('v1="0"', f'v1="{"9" * 5000}"'), "holds a number that is not one"),
    "digits of a place": (GOOD.replace('x="30"', f'x="{"9" * 5000}"'), "coordinates that are not numbers"),
    "beyond 64 bits": (GOOD.replace('v1="0"', 'v1="99999999999999999999"'), "holds a number that is not one"),
    "beyond": (GOOD.replace('v1="0"', 'v1="8"'), "corners that do not exist"),
    "below": (GOOD.replace('v1="0"', 'v1="-1"'), "corners that do not exist"),
    "no corner": (GOOD.replace('v1="0"', ""), "holds a number that is not one, among nothing"),
    "nan": (GOOD.replace('x="30"', 'x="nan"'), "coordinates that are not numbers"),
    "infinite": (GOOD.replace('x="30"', 'x="1e999"'), "coordinates that are not numbers"),
    "huge": (GOOD.replace('x="30"', 'x="1e300"'), "coordinates that are not numbers up to 1,000,000,000,000,000"),
}


@pytest.mark.slow
@pytest.mark.parametrize("fault", XMLS)
def test_models_that_are_none_are_refused(fault: str, tmp_path: Path) -> None:
    text, says = XMLS[fault]
    path = packed(tmp_path / "a.3mf", text)
    for name, read in readers(path).items():
        if name != "settings":
            refused(read, says)


@pytest.mark.parametrize("numbers", ["nan " * 12, "1e300 " * 12, "1 " * 11, "1 " * 13, "x " * 12, "", "9" * 5000])
def test_transforms_that_are_none_are_refused(numbers: str, tmp_path: Path) -> None:
    for text in (
        model(thing(1, PART), f'<item objectid="1" transform="{numbers}"/>'),
        model(thing(1, PART) + group(2, component(1, f'transform="{numbers}"')), '<item objectid="2"/>'),
    ):
        refused(lambda text=text: read_mesh(packed(tmp_path / "a.3mf", text)), "holds a number that is not one")  # type: ignore[misc]


def test_transforms_that_grow_are_refused(tmp_path: Path) -> None:
    place = 'transform="1e9 0 0 0 1e9 0 0 0 1e9 0 0 0"'
    groups = "".join(group(n, component(n - 1, place)) for n in range(2, 9))
    refused(
        lambda: read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART) + groups, '<item objectid="8"/>'))), "number"
    )


# --- more than there is -----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_circles_and_multitudes_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Thirty groups of two of one another are a billion boxes; the limits are lowered, so that the test is quick."""
    monkeypatch.setattr("infill.formats.threemf_placing.MOST_PLACED", 500)
    monkeypatch.setattr("infill.projects.reading.MOST_PLACED", 500)
    doubled = "".join(group(n, component(n - 1), component(n - 1)) for n in range(2, 32))
    circle = group(1, component(2)) + group(2, component(1), component(1))
    deep = "".join(group(n, component(n - 1)) for n in range(2, 40))
    for text, says in (
        (model(thing(1, PART) + doubled, '<item objectid="18"/>'), "more than 500 times"),
        (model(thing(1, PART) + doubled, '<item objectid="31"/>'), "more than 20 deep"),
        (
            model(thing(1, PART) + doubled, "".join(f'<item objectid="{n}"/>' for n in range(1, 12))),
            "more than 500 times",
        ),
        (model(circle), "refers to an object [12] that holds itself"),
        (model(thing(1, PART) + deep, '<item objectid="39"/>'), "more than 20 deep"),
    ):
        path = packed(tmp_path / "a.3mf", text)
        refused(lambda path=path: read_mesh(path), says)  # type: ignore[misc]
        for slicer in SLICERS:
            assert not check_project(path, slicer).fine
    for name, read in readers(packed(tmp_path / "b.3mf", model(thing(1, PART), ITEM * 501))).items():
        refused(read, "more than 500|no options of phasefill" if name == "settings" else "more than 500")


def test_volumes_without_end_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each names all triangles: of a large mesh, some kilobytes of them would be terabytes."""
    monkeypatch.setattr("infill.formats.threemf_placing.MOST_PLACED_ROWS", 10_000)
    told = prusa_config(*[volume(0, 11)] * 1000)
    refused(
        lambda: read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART)), **{PRUSA: told})), "places more than 10,000"
    )


def test_elements_without_end_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Those of extensions, of which nothing is kept, count too; vertices and triangles do not."""
    monkeypatch.setattr(threemf_package, "MOST_ELEMENTS", 30)
    assert read_mesh(packed(tmp_path / "a.3mf", model(thing(1, *[PART] * 20)))).volume > 0
    for row in ("<metadata/>", '<x:a xmlns:x="x"/>'):
        text = model(thing(1, PART), head=row * 40)
        refused(lambda text=text: read_mesh(packed(tmp_path / "a.3mf", text)), "more than 30 elements")  # type: ignore[misc]


def test_memory_is_asked_for_before_a_model_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("infill.machine.available_memory", lambda: 1000)
    for name, read in readers(packed(tmp_path / "a.3mf", GOOD, **{SETTINGS: ""})).items():
        if name != "settings":
            refused(read, "a.3mf is large: simplify the mesh")


def test_parts_that_are_encrypted_are_called_so(tmp_path: Path) -> None:
    text = model(group(3, component(1, 'p:path="/3D/o.model"')), '<item objectid="3"/>')
    path = packed(tmp_path / "a.3mf", text, **{"3D/o.model": "\x01\x02", "Secure/keystore.xml": "<keystore/>"})
    refused(lambda: read_mesh(path), "has encrypted parts .3MF secure content")


# --- attached options -------------------------------------------------------------------------------------------------

NINES = "9" * 5000
VALUES = [
    NINES, "-" + NINES, "9" * 4000, "1e400", "nan", "-inf", "0", "-1", '""', '"\\u001b[2J"', '"\\u202e"', "true",
    "[" * 2000 + "]" * 2000, "{ a = 1 }", "2020-01-01", "[1, 2, 3, 4, 5, 6, 7]", f'"{NINES}"', "'\x1b'", "[[]]",
]  # fmt: skip
OPTIONS = [
    "pattern", "density", "by", "cell", "line_width", "wall", "as", "for", "units", "angle", "phase", "seed", "drain",
    "open", "smooth_radius", "tolerance", "max_triangles", "resolution", "voxel", "size", "height", "cells", "steps",
    "layers", "threshold", "range", "label", "spacing", "roi", "set", '"\\u001b"', "level", "labels",
]  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("value", VALUES, ids=lambda value: value[:12].encode("unicode_escape").decode())
def test_options_that_are_none_are_told_on_one_line(value: str, tmp_path: Path) -> None:
    """By every command that reads a config file, from TOML and from a project."""
    for number, option in enumerate(OPTIONS):
        text = f"{option} = {value}\n" + ('pattern = "voronoi"\n' if option != "pattern" else "")
        config = tmp_path / "a.toml"
        config.write_text(text)
        if number % 4 == 0:
            config = packed(tmp_path / "a.3mf", GOOD, **{SETTINGS: text})
        for resolve in (resolve_fill, resolve_refill, resolve_make, resolve_smooth):
            told = ""
            try:
                resolve({}, config=config)
            except (InfillError, PatternError) as error:
                told = str(error)
            assert told.isprintable()
            assert len(told) < 900


def test_options_that_are_no_text_are_refused(tmp_path: Path) -> None:
    for content in (b"\xff\xfe", b"a = 1\r\x00", b"a", b"\x1b[2J = 1"):
        with zipfile.ZipFile(tmp_path / "a.3mf", "w") as package:
            package.writestr(SETTINGS, content)
        (tmp_path / "a.toml").write_bytes(content)
        for config in (tmp_path / "a.3mf", tmp_path / "a.toml"):
            refused(lambda config=config: resolve_fill({}, config=config), r"a\.\w+ is not ")  # type: ignore[misc]


# --- at random --------------------------------------------------------------------------------------------------------

WORDS = [b"", b"-1", b"nan", b"1e999", NINES.encode(), b"\x1b[2J", b"&#27;", b"\xff", b"2", b"other", b"0", b"1 0 0"]


def mutated(rng: random.Random, files: dict[str, bytes]) -> bytes:
    """Return a package of which some of the texts are changed, and of some the bytes of the zip."""
    changes = dict(files)
    for _ in range(rng.randint(0, 3)):
        name = rng.choice(list(changes))
        text = changes[name]
        spans = list(re.finditer(rb'"[^"]*"|<[^>]*>', text)) or [re.match(b"", text)]
        found: Any = rng.choice(spans)
        new = rng.choice((b'"' + rng.choice(WORDS) + b'"', b"", found[0] * 2, text[: rng.randrange(len(text) + 1)]))
        changes[name] = text[: found.start()] + new + text[found.end() :]
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in changes.items():
            package.writestr(name, text)
    whole = bytearray(buffer.getvalue())
    for _ in range(rng.choice((0, 0, 1, 3))):
        whole[rng.randrange(len(whole))] = rng.randrange(256)
    return bytes(whole)


@pytest.mark.longest
@pytest.mark.parametrize("seed", range(4))
def test_files_changed_at_random_are_read_or_refused(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)
    sources = [
        by_ranges(tmp_path / "r.3mf", volume_type="NegativeVolume"),
        by_components(tmp_path / "c.3mf", "negative_part", elsewhere=True),
        by_cura(tmp_path / "u.3mf", "infill_mesh"),
        packed(tmp_path / "s.3mf", model(thing(1, PART, COLUMN)), **{SETTINGS: 'pattern = "gyroid"\nwall = 1.5\n'}),
    ]
    pool = []
    for source in sources:
        with zipfile.ZipFile(source) as package:
            pool.append({name: package.read(name) for name in package.namelist()})
    path = tmp_path / "a.3mf"
    read = 0
    for _ in range(60):
        path.write_bytes(mutated(rng, rng.choice(pool)))
        for each in readers(path).values():
            told = ""
            try:
                each()
                read += 1
            except (InfillError, PatternError) as error:
                told = str(error)
            assert told.isprintable()
            assert len(told) < 1200
    assert read > 20  # not all are broken beyond reading


def test_what_is_compared_can_differ(tmp_path: Path) -> None:
    """The judge of one line fails for a file that is fine, and for a message of several lines."""
    path = packed(tmp_path / "a.3mf", GOOD)
    with pytest.raises(pytest.fail.Exception):
        refused(lambda: read_mesh(path), "a")

    class RudeError(FormatError):
        def __str__(self) -> str:
            return "a\nb"

    def rude() -> None:
        raise RudeError

    with pytest.raises(AssertionError):
        refused(rude, "a")
