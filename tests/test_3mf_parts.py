"""What is a part in a 3MF and what is not: dialects of slicers, types, extensions, and slicers and lib3mf as judges."""

from __future__ import annotations

import json
import logging
import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import lib3mf
import numpy as np
import pytest
import slicers
from hypothesis import given, settings
from hypothesis import strategies as st
from test_command_line import one_line_error, run

from infill import FormatError, Surface, check, check_project, read_mesh

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
MODEL, PRUSA, BAMBU = "3D/3dmodel.model", "Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"
RELATIONS = (
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/%s" '
    'Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)
TYPES = (
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
    'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
# The part is 6,000 mm³ and 10 mm high. The column stands across it, 45 mm high; 1,000 of its 4,500 mm³ are in the part.
PART, COLUMN = ((0, 0, 0), (30, 20, 10)), ((10, 5, -5), (20, 15, 40))
VERSION = '<metadata name="slic3rpe:Version3mf">1</metadata>'
SPACES = f'xmlns:p="{PRODUCTION}" xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06"'
ITEM = '<item objectid="1"/>'
prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa() or "there")


def mesh(*boxes: Any, more: str = "", missing: int = 0) -> str:
    points, faces = [], []
    for (x0, y0, z0), (x1, y1, z1) in boxes:
        faces += [tuple(k + len(points) for k in t) for t in TRIANGLES]
        points += [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    rows = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in points)
    corners = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces[missing:])
    return f"<mesh><vertices>{rows}</vertices><triangles>{corners}</triangles>{more}</mesh>"


def thing(number: int, *boxes: Any, kind: str = "model", inner: str = "", more: str = "") -> str:
    return f'<object id="{number}" type="{kind}" name="o{number}">{inner}{mesh(*boxes, more=more)}</object>'


def group(number: int, *components: str, kind: str = "model") -> str:
    return f'<object id="{number}" type="{kind}"><components>{"".join(components)}</components></object>'


def component(number: int, more: str = "") -> str:
    return f'<component objectid="{number}" {more}/>'


def model(resources: str, build: str = ITEM, *, head: str = VERSION, more: str = "", unit: str = "millimeter") -> str:
    return (
        f'<model unit="{unit}" xmlns="{CORE}" {SPACES} {more}>{head}<resources>{resources}</resources>'
        f"<build>{build}</build></model>"
    )


def packed(path: Path, text: str, **files: str) -> Path:
    with zipfile.ZipFile(path, "w") as package:
        for name, each in {
            "[Content_Types].xml": TYPES,
            "_rels/.rels": RELATIONS % MODEL,
            MODEL: text,
            **files,
        }.items():
            package.writestr(name, each)
    return path


def volume(first: int, last: int, **rows: str) -> str:
    own = "".join(f'<metadata type="volume" key="{key}" value="{value}"/>' for key, value in rows.items())
    return f'<volume firstid="{first}" lastid="{last}">{own}</volume>'


def prusa_config(*volumes: str, number: int = 1) -> str:
    return f'<config><object id="{number}">{"".join(volumes)}</object></config>'


def by_ranges(path: Path, *, config: str = PRUSA, name: str = "", **rows: str) -> Path:
    """The part and the column as volumes of one mesh."""
    rows = {**({"name": name} if name else {}), **rows}
    told = prusa_config(volume(0, 11, volume_type="ModelPart"), volume(12, 23, **rows))
    return packed(path, model(thing(1, PART, COLUMN)), **{config: told})


def by_components(
    path: Path, kind: str, *, nested: bool = False, elsewhere: bool = False, typed: str = "model"
) -> Path:
    """The part and the column as components of one object, in the file of the model or in another one."""
    things = thing(1, PART) + thing(2, COLUMN, kind=typed)
    where = 'p:path="/3D/Objects/o.model"' if elsewhere else ""
    ends = [component(1, where), component(2, where)]
    between = group(7, *ends) if nested else ""
    whole = group(3, component(7)) if nested else group(3, *ends)
    config = (
        f'<config><object id="3"><part id="1" subtype="normal_part"/><part id="2" subtype="{kind}"/></object></config>'
    )
    text = model(("" if elsewhere else things) + between + whole, '<item objectid="3"/>')
    more = {"3D/Objects/o.model": model(things, "")} if elsewhere else {}
    return packed(path, text, **{BAMBU: config, **more})


def by_slic3r(path: Path, modifier: str) -> Path:
    space = 'xmlns:s="http://schemas.slic3r.org/3mf/2017/06"'
    told = f'<s:volumes {space}><s:volume ts="0" te="11" modifier="0"/><s:volume ts="12" te="23" modifier="{modifier}"/></s:volumes>'
    return packed(path, model(thing(1, PART, COLUMN, more=told)))


def by_cura(path: Path, key: str, *, old: bool = False) -> Path:
    space = 'xmlns:c="http://software.ultimaker.com/xml/cura/3mf/2015/10"'
    told = f'<metadatagroup><metadata name="c:{key}">True</metadata></metadatagroup>'
    if old:
        told = f'<c:settings><c:setting key="{key}">True</c:setting></c:settings>'
    text = model(
        thing(1, PART) + thing(2, COLUMN, inner=told) + group(3, component(1), component(2)),
        '<item objectid="3"/>',
        more=space,
    )
    return packed(path, text)


ASIDE: dict[str, tuple[Callable[[Path], Path], str]] = {
    "prusa, modifier": (lambda path: by_ranges(path, modifier="1", volume_type="ParameterModifier"), "modifier"),
    "prusa, blocker": (lambda path: by_ranges(path, volume_type="SupportBlocker"), "support blocker"),
    "prusa, enforcer": (lambda path: by_ranges(path, volume_type="SupportEnforcer"), "support enforcer"),
    "prusa, as of old": (lambda path: by_ranges(path, modifier="1"), "modifier"),
    "prusa, by a number": (lambda path: by_ranges(path, volume_type="1"), "modifier"),
    "prusa, the last row": (lambda path: by_ranges(path, volume_type="ModelPart", modifier="1"), "modifier"),
    "prusa, in capitals": (lambda path: by_ranges(path, config=PRUSA.upper(), modifier="1"), "modifier"),
    "superslicer": (lambda path: by_ranges(path, config="Metadata/SuperSlicer_model.config", modifier="1"), "modifier"),
    "slic3r": (lambda path: by_slic3r(path, "1"), "modifier"),
    "bambu, modifier": (lambda path: by_components(path, "modifier_part"), "modifier"),
    "bambu, blocker": (lambda path: by_components(path, "support_blocker"), "support blocker"),
    "bambu, enforcer": (lambda path: by_components(path, "support_enforcer"), "support enforcer"),
    "bambu, in a file": (lambda path: by_components(path, "modifier_part", elsewhere=True), "modifier"),
    "bambu, nested": (lambda path: by_components(path, "modifier_part", nested=True), "modifier"),
    "bambu, other": (lambda path: by_components(path, "modifier_part", typed="other"), "of type 'other'"),
    "cura": (lambda path: by_cura(path, "infill_mesh"), "modifier"),
    "cura, blocker": (lambda path: by_cura(path, "anti_overhang_mesh"), "support blocker"),
    "cura, support": (lambda path: by_cura(path, "support_mesh"), "support"),
    "cura, cutting": (lambda path: by_cura(path, "cutting_mesh"), "cutting mesh"),
    "cura, as of old": (lambda path: by_cura(path, "infill_mesh", old=True), "modifier"),
}
BOTH: dict[str, Callable[[Path], Path]] = {
    "prusa": lambda path: by_ranges(path, volume_type="ModelPart"),
    "prusa, none": lambda path: by_ranges(path, modifier="0"),
    "prusa, true is no 1": lambda path: by_ranges(path, modifier="true"),
    "prusa, the last row": lambda path: by_ranges(path, modifier="1", volume_type="ModelPart"),
    "prusa, unknown": lambda path: by_ranges(path, volume_type="Whatever"),
    "prusa, a matrix": lambda path: by_ranges(path, volume_type="ModelPart", matrix="1 0 0 9 0 1 0 0 0 0 1 0 0 0 0 1"),
    "slic3r": lambda path: by_slic3r(path, "0"),
    "bambu": lambda path: by_components(path, "normal_part"),
    "bambu, in a file": lambda path: by_components(path, "normal_part", elsewhere=True),
}
NEGATIVE: dict[str, Callable[[Path], Path]] = {
    "prusa": lambda path: by_ranges(path, volume_type="NegativeVolume"),
    "prusa, marked twice": lambda path: by_ranges(path, modifier="1", volume_type="NegativeVolume"),
    "bambu": lambda path: by_components(path, "negative_part"),
    "bambu, in a file": lambda path: by_components(path, "negative_part", elsewhere=True),
    "bambu, nested": lambda path: by_components(path, "negative_part", nested=True),
    "bambu, other": lambda path: by_components(path, "negative_part", elsewhere=True, typed="other"),
}


def extents(surface: Surface) -> list[float]:
    low, high = surface.bounds
    return (high - low).tolist()


# --- roles ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("dialect", ASIDE)
def test_what_is_no_part_is_left_out_and_said(dialect: str, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    write, role = ASIDE[dialect]
    path = write(tmp_path / "a.3mf")
    found = read_mesh(path)
    assert found.volume == pytest.approx(6000)
    assert extents(found) == pytest.approx([30, 20, 10])
    (note,) = found.notes
    assert role in note
    assert "is left out" in note
    assert [record.getMessage() for record in caplog.records] == [f"{path}: {note}"]
    assert caplog.records[0].levelno == logging.WARNING
    assert note in check(path).warnings


@pytest.mark.parametrize("dialect", BOTH)
def test_what_is_a_part_stays(dialect: str, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    found = read_mesh(BOTH[dialect](tmp_path / "a.3mf"))
    assert found.volume == pytest.approx(10500)  # what both have in common counts twice, until they are united
    assert extents(found) == pytest.approx([30, 20, 45])
    assert found.notes == ()
    assert not caplog.records


@pytest.mark.parametrize("dialect", NEGATIVE)
def test_negative_volumes_are_taken_off(dialect: str, tmp_path: Path) -> None:
    found = read_mesh(NEGATIVE[dialect](tmp_path / "a.3mf"))
    assert found.volume == pytest.approx(5000)
    assert extents(found) == pytest.approx([30, 20, 10])
    assert found.closed
    assert "negative volume: it is taken off" in found.notes[0]


def test_negative_volumes_go_where_their_object_goes(tmp_path: Path) -> None:
    """Two instances, one of them mirrored and scaled, and a part of another object, of which nothing is taken."""
    told = prusa_config(volume(0, 11), volume(12, 23, volume_type="NegativeVolume"))
    text = model(
        thing(1, PART, COLUMN) + thing(2, PART),
        '<item objectid="1" transform="-2 0 0 0 1 0 0 0 1 -50 0 0"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 99 0"/>'
        '<item objectid="2"/>',
    )
    found = read_mesh(packed(tmp_path / "a.3mf", text, **{PRUSA: told}))
    assert found.volume == pytest.approx(2 * 5000 + 5000 + 6000)
    assert found.closed


def test_a_negative_volume_takes_nothing_off_what_comes_after_it(tmp_path: Path) -> None:
    told = prusa_config(volume(12, 23, volume_type="NegativeVolume"), volume(0, 11))
    path = packed(tmp_path / "a.3mf", model(thing(1, PART, COLUMN)), **{PRUSA: told})
    found = read_mesh(path)
    assert found.volume == pytest.approx(6000)
    assert "meets no part before it" in found.notes[0]
    assert any("takes nothing off" in each for each in check_project(path, "prusaslicer").problems)


def test_an_open_negative_volume_is_refused(tmp_path: Path) -> None:
    text = model(f'<object id="1">{mesh(COLUMN, PART, missing=1)}</object>')
    told = prusa_config(volume(11, 22), volume(0, 10, volume_type="NegativeVolume", name="cut"))
    with pytest.raises(FormatError, match="takes the negative volume 'cut' .* off .*not closed; repair"):
        read_mesh(packed(tmp_path / "a.3mf", text, **{PRUSA: told}))


def test_a_part_that_is_cut_away_whole_is_none(tmp_path: Path) -> None:
    huge = ((-9, -9, -9), (99, 99, 99))
    told = prusa_config(volume(0, 11), volume(12, 23, volume_type="NegativeVolume"))
    with pytest.raises(FormatError, match="holds no part: .*negative volume: it is taken off"):
        read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART, huge)), **{PRUSA: told}))


def test_settings_of_slicers_are_by_object(tmp_path: Path) -> None:
    """Also below components, and whatever zeros are before a number."""
    told = prusa_config(volume(0, 11), volume(12, 23, modifier="1"), number=5)
    tree = thing(5, PART, COLUMN) + group(8, component(5, 'transform="1 0 0 0 1 0 0 0 1 50 0 0"'))
    text = model(tree.replace('id="5" type', 'id="05" type'), '<item objectid="8"/><item objectid="5"/>')
    found = read_mesh(packed(tmp_path / "a.3mf", text, **{PRUSA: told}))
    assert found.volume == pytest.approx(12000)
    assert extents(found) == pytest.approx([80, 20, 10])


def test_triangles_in_no_volume_are_left_out_and_said(tmp_path: Path) -> None:
    told = prusa_config(volume(0, 11))
    found = read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART, COLUMN)), **{PRUSA: told}))
    assert found.volume == pytest.approx(6000)
    assert re.search("left out 12 triangles of .* that no volume of it covers", found.notes[0])


@pytest.mark.parametrize(
    ("first", "last"), [("12", "24"), ("23", "12"), ("-1", "5"), ("x", "5"), ("9" * 5000, "5"), ("", "")]
)
def test_volumes_of_triangles_that_are_not_there_are_refused(first: str, last: str, tmp_path: Path) -> None:
    told = f'<config><object id="1"><volume firstid="{first}" lastid="{last}"/></object></config>'
    with pytest.raises(FormatError, match="has a volume of triangles .* which has 24 from 0 on") as error:
        read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART, COLUMN)), **{PRUSA: told}))
    assert len(str(error.value)) < 500


# --- types, and what is printed ---------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["support", "solidsupport", "surface", "other", "lattice", " Support "])
def test_objects_of_other_types_are_no_parts(kind: str, tmp_path: Path) -> None:
    things = thing(1, PART) + thing(2, COLUMN, kind=kind)
    texts = {
        "beside": model(things, '<item objectid="1"/><item objectid="2"/>'),
        "within": model(things + group(3, component(1), component(2)), '<item objectid="3"/>'),
        "around": model(
            thing(1, PART)
            + thing(2, COLUMN)
            + group(4, component(2), kind=kind)
            + group(3, component(1), component(4)),
            '<item objectid="3"/>',
        ),
    }
    for name, text in texts.items():
        path = packed(tmp_path / f"{name}.3mf", text)
        found = read_mesh(path)
        assert found.volume == pytest.approx(6000)
        assert f"of type '{kind.strip()}', not a part: it is left out" in found.notes[0]
        for slicer in ("prusaslicer", "cura", "plain"):
            assert not check_project(path, slicer).fine  # type: ignore[arg-type]
    alone = packed(tmp_path / "alone.3mf", model(thing(1, PART, kind=kind)))
    with pytest.raises(FormatError, match=f"holds no part: .*of type '{kind.strip()}'.*make it a part"):
        read_mesh(alone)
    assert not check_project(alone, "prusaslicer").fine


@pytest.mark.parametrize("kind", ['type="model"', 'type=""', "", 'type="Model"'])
def test_objects_of_the_type_of_parts_are_parts(kind: str, tmp_path: Path) -> None:
    text = model(f'<object id="1" {kind}>{mesh(PART)}</object>')
    assert read_mesh(packed(tmp_path / "a.3mf", text)).notes == ()


@pytest.mark.parametrize("word", ["0", "false", "False", " 0 "])
def test_what_is_not_to_be_printed_is_said(word: str, tmp_path: Path) -> None:
    text = model(thing(1, PART) + thing(2, COLUMN), f'<item objectid="1"/><item objectid="2" printable="{word}"/>')
    path = packed(tmp_path / "a.3mf", text)
    found = read_mesh(path)
    assert found.volume == pytest.approx(6000)
    assert found.notes == ("object 2 is not to be printed: it is left out",)
    assert len(check_project(path, "prusaslicer").volumes) == 1


def test_another_unit_in_another_file_is_said(tmp_path: Path) -> None:
    """PrusaSlicer 2.9 scales by it, and lib3mf does not."""
    text = model(group(3, component(1, 'p:path="/3D/o.model"')), '<item objectid="3"/>')
    path = packed(tmp_path / "a.3mf", text, **{"3D/o.model": model(thing(1, PART), "", unit="inch")})
    found = read_mesh(path)
    assert extents(found) == pytest.approx([30, 20, 10])
    assert "in inch, and read in millimeter" in found.notes[0]
    with pytest.raises(FormatError, match="is in 'furlong', and 3MF knows micron"):
        read_mesh(packed(tmp_path / "b.3mf", model(thing(1, PART), unit="furlong")))


# --- extensions -------------------------------------------------------------------------------------------------------

UNREAD = {
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02": "beam lattices",
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07": "beam lattices",
    "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07": "stacks of slices",
    "http://schemas.microsoft.com/3dmanufacturing/securecontent/2019/04": "encrypted",
    "http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01": "volumetric data",
    "http://schemas.3mf.io/3dmanufacturing/implicit/2023/12": "implicit functions",
    "http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07": "boolean shapes",
    "http://schemas.3mf.io/3dmanufacturing/displacement/2023/10": "displaced surfaces",
    "http://example.com/anything": "http://example.com/anything",
}
READ = {
    PRODUCTION: "p:UUID='a'",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02": "",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07": "",
    "http://schemas.slic3r.org/3mf/2017/06": "",
    "http://schemas.bambulab.com/package/2021": "",
}


@pytest.mark.slow
@pytest.mark.parametrize("space", UNREAD)
@pytest.mark.parametrize("prefix", ["b", "p", "m", "x1-y.z"])
def test_a_required_extension_that_is_not_read_is_refused_by_name(space: str, prefix: str, tmp_path: Path) -> None:
    """By its namespace: a prefix means what the file says."""
    text = model(thing(1, PART), more="").replace(f'xmlns:p="{PRODUCTION}"', "")
    text = text.replace("<model ", f'<model xmlns:{prefix}="{space}" requiredextensions="{prefix}" ')
    path = packed(tmp_path / "a.3mf", text)
    with pytest.raises(
        FormatError, match=re.escape(f"requires the 3MF extension '{prefix}'") + f".*{UNREAD[space]}.*STL$"
    ):
        read_mesh(path)
    for slicer in ("prusaslicer", "orcaslicer", "cura", "plain"):
        found = check_project(path, slicer)  # type: ignore[arg-type]
        assert any(f"requires the extension '{prefix}'" in each for each in found.problems)


@pytest.mark.parametrize("space", READ)
@pytest.mark.parametrize("prefix", ["b", "m"])
def test_a_required_extension_that_is_read_is_fine(space: str, prefix: str, tmp_path: Path) -> None:
    more = f'xmlns:{prefix}="{space}" requiredextensions=" {prefix}  "'
    path = packed(tmp_path / "a.3mf", model(thing(1, PART), more=more))
    assert read_mesh(path).notes == ()
    assert check_project(path, "plain").fine


def test_a_prefix_that_nobody_declares_is_unknown(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"requires the 3MF extension 'z' \(which it does not declare\)"):
        read_mesh(packed(tmp_path / "a.3mf", model(thing(1, PART), more='requiredextensions="p z"')))


def test_several_extensions_are_told_together(tmp_path: Path) -> None:
    path = packed(tmp_path / "a.3mf", model(thing(1, PART), more='requiredextensions="y z"'))
    with pytest.raises(FormatError, match="requires the 3MF extensions 'y' .* and 'z' .*, which are not read; export"):
        read_mesh(path)


def test_what_another_file_requires_counts_where_it_is_used(tmp_path: Path) -> None:
    more = f'xmlns:b="{next(iter(UNREAD))}" requiredextensions="b"'
    inner = {"3D/o.model": model(thing(1, PART), "", more=more)}
    used = model(group(3, component(1, 'p:path="/3D/o.model"')), '<item objectid="3"/>')
    with pytest.raises(FormatError, match="requires the 3MF extension 'b'"):
        read_mesh(packed(tmp_path / "a.3mf", used, **inner))
    assert read_mesh(packed(tmp_path / "b.3mf", model(thing(1, PART)), **inner)).volume == pytest.approx(6000)


@pytest.mark.parametrize(
    ("space", "inside", "beside"),
    [
        (0, '<x:beamlattice radius="1"><x:beams><x:beam v1="0" v2="7"/></x:beams></x:beamlattice>', ""),
        (6, "", '<object id="2"><x:booleanshape objectid="1"/></object>'),
        (7, "", '<object id="2"><x:displacementmesh/></object>'),
    ],
)
def test_a_shape_that_is_not_read_is_said_though_not_required(
    space: int, inside: str, beside: str, tmp_path: Path
) -> None:
    address, words = list(UNREAD.items())[space]
    build = ITEM + ('<item objectid="2"/>' if beside else "")
    path = packed(tmp_path / "a.3mf", model(thing(1, PART, more=inside) + beside, build, more=f'xmlns:x="{address}"'))
    found = read_mesh(path)
    assert found.volume == pytest.approx(6000)
    assert f"has {words}, which are not read: they are left out" in found.notes[0]
    assert any(words in each for each in check_project(path, "plain").problems)


def test_namespaces_may_have_any_prefix(tmp_path: Path) -> None:
    """PrusaSlicer reads no such file, which the doctor has to say."""
    text = model(thing(1, PART)).replace("<", "<c:").replace("<c:/", "</c:").replace("xmlns=", "xmlns:c=")
    path = packed(tmp_path / "a.3mf", text)
    assert read_mesh(path).volume == pytest.approx(6000)
    assert any("names without a prefix" in each for each in check_project(path, "prusaslicer").problems)


# --- judges -----------------------------------------------------------------------------------------------------------

SMALL = ((0, 0, 0), (1, 2, 3))


def random_tree(seed: int) -> tuple[str, str]:
    """Objects and what is built: a box, groups of what comes before them, and transforms, mirrored ones too."""
    rng = np.random.default_rng(seed)

    def placed() -> str:
        matrix = np.zeros((3, 3))
        while abs(np.linalg.det(matrix)) < 0.01:
            matrix = rng.integers(-8, 9, size=(3, 3)) / 4
        return f'transform="{" ".join(map(str, [*matrix.ravel(), *rng.integers(-8, 9, size=3) / 4]))}"'

    count = int(rng.integers(1, 5))
    resources = f'<object id="1">{mesh(SMALL)}</object>'
    for number in range(2, count + 1):
        inner = rng.integers(1, number, size=rng.integers(1, 3))
        resources += group(number, *(component(each, placed()) for each in inner))
    built = rng.integers(1, count + 1, size=rng.integers(1, 3))
    return resources, "".join(f'<item objectid="{each}" {placed()}/>' for each in built)


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["millimeter", "inch", "micron"]))
def test_lib3mf_puts_the_same_where_we_do(tmp_path_factory: pytest.TempPathFactory, seed: int, unit: str) -> None:
    """Its merged model, vertex by vertex; to single precision, in which it holds vertices and matrices."""
    path = packed(tmp_path_factory.mktemp("a") / "a.3mf", model(*random_tree(seed), unit=unit))
    wrapper = lib3mf.Wrapper()
    theirs = wrapper.CreateModel()
    theirs.QueryReader("3mf").ReadFromFile(str(path))
    merged = theirs.MergeToModel()
    scale = {"millimeter": 1, "inch": 25.4, "micron": 1e-3}[unit]
    points, items = [], merged.GetBuildItems()
    while items.MoveNext():
        item = items.GetCurrent()
        place = np.array([list(row) for row in item.GetObjectTransform().Fields])
        own = np.array(
            [list(v.Coordinates) for v in merged.GetMeshObjectByID(item.GetObjectResourceID()).GetVertices()]
        )
        points.append(own @ place[:3] + place[3])
    expected = np.concatenate(points) * scale
    found = read_mesh(path)
    # Both as sets of places: which vertex comes first is nobody's concern.
    tolerance = 1e-5 * max(1.0, np.abs(expected).max())
    assert found.bounds == pytest.approx(np.array([expected.min(axis=0), expected.max(axis=0)]), abs=tolerance)
    for point in expected:
        assert np.linalg.norm(found.vertices - point, axis=1).min() < 4 * tolerance
    assert found.volume > 0


JUDGED: dict[str, Callable[[Path], Path]] = {
    **{name: ASIDE[name][0] for name in ("prusa, modifier", "prusa, as of old", "prusa, by a number", "prusa, the last row")},
    **{name: BOTH[name] for name in ("prusa, true is no 1", "prusa, unknown")},
    "type": lambda path: packed(path, model(thing(1, PART, kind="other"))),
    "type within": lambda path: packed(path, model(thing(1, PART) + thing(2, PART, kind="support") + group(3, component(1), component(2)), '<item objectid="3"/>')),
    "capitals": lambda path: packed(path, model(thing(1, PART, kind="Model"))),
    "not built": lambda path: packed(path, model(thing(1, PART) + thing(2, COLUMN))),
    "support, not built": lambda path: packed(path, model(thing(1, PART) + thing(2, COLUMN, kind="support"))),
    "later": lambda path: packed(path, model(group(3, component(1)) + thing(1, PART), '<item objectid="3"/>')),
    "twice": lambda path: packed(path, model(thing(1, PART) + thing(1, COLUMN))),
    "deep": lambda path: packed(path, model(thing(1, PART) + "".join(group(n, component(n - 1)) for n in range(2, 14)), '<item objectid="13"/>')),
    "empty": lambda path: packed(path, model(thing(1, PART) + '<object id="2"/>', ITEM + '<item objectid="2"/>')),
    "elsewhere": lambda path: by_components(path, "normal_part", elsewhere=True),
    "group": lambda path: packed(path, model(thing(1, PART, COLUMN) + group(9, component(1)), '<item objectid="9"/>'), **{PRUSA: prusa_config(volume(0, 11), volume(12, 23, modifier="1"), number=9)}),
    "told twice": lambda path: packed(path, model(thing(1, PART)), **{PRUSA: "<config>" + 2 * '<object id="1"><volume firstid="0" lastid="11"/></object>' + "</config>"}),
    "no volumes": lambda path: packed(path, model(thing(1, PART)), **{PRUSA: prusa_config()}),
}  # fmt: skip


@pytest.mark.long
@prusa
@pytest.mark.parametrize("trait", JUDGED)
def test_the_doctor_says_what_prusaslicer_does(trait: str, tmp_path: Path) -> None:
    path = JUDGED[trait](tmp_path / "a.3mf")
    found = check_project(path, "prusaslicer")
    try:
        said = slicers.run_slicer(["prusa-slicer", "--datadir", "data", "--info", str(path)], tmp_path)
    except RuntimeError as error:
        said = str(error)
    opened = "size_x" in said
    refused = [each for each in found.problems if "is not opened" in each or "2.5 does not" in each]
    assert opened == (not refused), (said, found)
    if opened:
        parts = [each for each in found.volumes if each.role == "part"]
        taken = sum(int(each) for each in re.findall(r"number_of_facets = +(\d+)", said))
        assert taken == sum(each.triangles for each in parts)


# --- the command line -------------------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.parametrize(
    ("words", "keys"),
    [
        (["fill", "--voxel", "1.5", "-o", "a.stl"], ("part", "notes")),
        (["smooth", "--resolution", "24", "-o", "a.stl"], ("input", "notes")),
        (["smooth", "--by-component", "--resolution", "24", "-o", "a.3mf"], ("notes",)),
        (["check"], ("warnings",)),
    ],
)
def test_every_command_says_what_it_left_out(
    words: list[str],
    keys: tuple[str, ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.chdir(tmp_path)
    by_ranges(Path("part.3mf"), modifier="1", name="in\u00adfill")
    result = run(words[0], "part.3mf", *words[1:], "--json")
    assert result.exit_code == 0
    told = json.loads(result.stdout)
    for key in keys:
        told = told[key]
    note = "volume 'in\\xadfill' of object 1 'o1' is a modifier, not a part: it is left out"
    assert note in told
    assert f"part.3mf: {note}" in result.stderr + caplog.text  # the second for a command that has no log of its own


def test_what_holds_no_part_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    packed(Path("a.3mf"), model(thing(1, PART, kind="support")))
    for words in (["fill", "a.3mf", "-o", "a.stl"], ["smooth", "a.3mf", "-o", "a.stl"], ["check", "a.3mf"]):
        one_line_error(run(*words), "a.3mf holds no part: object 1 'o1' is of type 'support'")
