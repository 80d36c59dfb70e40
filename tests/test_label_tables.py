"""Names and colours of labels, from the tables of other programs, and file names made of them."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from infill import Segment, read_labels, read_segmentation
from infill.errors import FormatError
from infill.files.file_names import MOST_BYTES, fill_template, is_template, safe_names
from infill.imaging.label_tables import segments_of_nrrd

SNAP = """################################################
# ITK-SnAP Label Description File
# IDX:   Zero-based index
################################################
    0     0    0    0        0  0  0    "Clear Label"
    1   255    0    0        1  1  1    "Label 1"
    7     0  128  255      0.5  1  0    "Os coxae, left"
"""
LUT = """#$Id: FreeSurferColorLUT.txt
#No. Label Name:                            R   G   B   A

0   Unknown                                 0   0   0   0
17  Left-Hippocampus                        220 216 20  0
1035    ctx-lh-insula  255 192 32 0
"""
CTBL = """# Color table file C:/table.ctbl
# 3 values
0 Background 0 0 0 0
1 tissue 128 174 128 255
2 corticospinal tract left 241 214 145 255
"""


@pytest.mark.parametrize(
    ("text", "value", "name", "colour"),
    [
        (SNAP, 7, "Os coxae, left", (0, 128, 255)),
        (SNAP, 1, "Label 1", (255, 0, 0)),
        (LUT, 17, "Left-Hippocampus", (220, 216, 20)),
        (LUT, 1035, "ctx-lh-insula", (255, 192, 32)),
        (CTBL, 1, "tissue", (128, 174, 128)),
        (CTBL, 2, "corticospinal tract left", (241, 214, 145)),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_table_names_and_colours(
    text: str, value: int, name: str, colour: tuple[int, ...], end: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(text.replace("\n", end).encode())
    found = {each.value: each for each in read_labels(path)}
    assert len(found) == 3
    assert found[value].name == name
    assert found[value].colour == pytest.approx(np.array(colour) / 255)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
def test_a_table_in_any_encoding(encoding: str, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_bytes("3 Köpfchen 1 2 3 0\n".encode(encoding))
    assert read_labels(tmp_path / "a.txt")[0].name == "Köpfchen"


def test_the_last_line_of_a_number_counts(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("3 first 1 2 3 0\n3 second 4 5 6 0\n")
    assert [each.name for each in read_labels(tmp_path / "a.txt")] == ["second"]


@pytest.mark.parametrize(
    ("held", "says"),
    [
        (b"", "names no label"),
        (b"# only\n# comments\n", "names no label"),
        (b"hello\n", "no label in line 1; give label descriptions of ITK-SNAP"),
        (SNAP.encode() + b'8 300 0 0 1 1 1 "red"\n', "no label in line 8"),
        (b"1 bone 1 2\n", "no label in line 1"),
        (b"1 2 3 4 5\n", None),
        (b"\0\1\2" * 100, "not a table of labels"),
        (b"# " + b"x" * 11_000_000, "not a table of labels"),
    ],
)
def test_something_else_is_no_table(held: bytes, says: str | None, tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(held)
    if says is None:  # a name may be a number
        assert read_labels(path)[0].name == "2"
        return
    with pytest.raises(FormatError, match=says) as caught:
        read_labels(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_table_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="there is no file .*; check the name"):
        read_labels(tmp_path / "a.txt")


# --- what 3D Slicer writes -------------------------------------------------------------------------------

VALUES = np.zeros((2, 6, 5, 4), np.uint8)
VALUES[0, 1:3, 1:3, 1:3], VALUES[0, 4, 1:3, 1:3], VALUES[1, 2:5, 2:4, 1:3] = 1, 2, 1
FIELDS = """Segment0_ID:=Segment_1
Segment0_Name:=Femur, left/right
Segment0_LabelValue:=1
Segment0_Layer:=0
Segment0_Color:=0.5 0.68 0
Segment1_Name:=Cartilage
Segment1_LabelValue:=2
Segment1_Layer:=0
Segment10_Name:=Plan
Segment10_LabelValue:=1
Segment10_Layer:=1
Segment10_Color:=1 0 0
"""


def seg_nrrd(path: Path, fields: str = FIELDS, values: np.ndarray = VALUES) -> Path:
    """Write a segmentation as 3D Slicer does: the layers are the first axis."""
    layered = values.ndim == 4
    head = (
        f"NRRD0004\n# made by hand\ntype: unsigned char\ndimension: {values.ndim}\nspace: left-posterior-superior\n"
        f"sizes: {' '.join(map(str, values.shape))}\n"
        f"space directions: {'none ' if layered else ''}(0.5,0,0) (0,0.5,0) (0,0,2)\n"
        f"kinds: {'list ' if layered else ''}domain domain domain\nencoding: raw\nspace origin: (10,-20,30)\n{fields}\n"
    )
    path.write_bytes(head.encode() + values.tobytes(order="F"))
    return path


def test_layers_names_and_colours_of_slicer(tmp_path: Path) -> None:
    found = read_segmentation(seg_nrrd(tmp_path / "a.seg.nrrd"))
    assert found.segments == (
        Segment(value=1, name="Femur, left/right", colour=(0.5, 0.68, 0.0), layer=0),
        Segment(value=2, name="Cartilage", layer=0),
        Segment(value=1, name="Plan", colour=(1.0, 0.0, 0.0), layer=1),
    )
    for layer, values in zip(found.layers, VALUES, strict=True):
        assert np.array_equal(layer.values, values)
        assert layer.spacing == (0.5, 0.5, 2.0)
        assert layer.place(np.array([[0.25, 0.25, 1.0]]))[0] == pytest.approx([10, -20, 30])
    only = read_segmentation(tmp_path / "a.seg.nrrd", frame=1)
    assert len(only.layers) == 1
    assert [(each.name, each.layer) for each in only.segments] == [("Plan", 0)]


def test_one_layer_of_slicer_and_a_plain_nrrd(tmp_path: Path) -> None:
    path = seg_nrrd(tmp_path / "a.seg.nrrd", FIELDS.partition("Segment10")[0], VALUES[0])
    assert [each.name for each in read_segmentation(path).segments] == ["Femur, left/right", "Cartilage"]
    plain = read_segmentation(seg_nrrd(tmp_path / "b.nrrd", "", VALUES[0]))
    assert plain.segments == ()
    assert len(plain.layers) == 1


def test_an_old_segmentation_has_a_layer_for_each_segment(tmp_path: Path) -> None:
    """Before 3D Slicer 4.11: no label values, no layers."""
    path = seg_nrrd(tmp_path / "a.seg.nrrd", "Segment0_Name:=A\nSegment1_Name:=B\n")
    assert [(each.name, each.value, each.layer) for each in segments_of_nrrd(path)] == [("A", 1, 0), ("B", 1, 1)]


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        (FIELDS.replace("LabelValue:=2", "LabelValue:=two"), "describes segment 1 wrongly"),
        (FIELDS.replace("0.5 0.68 0", "green"), "describes segment 0 wrongly"),
        (FIELDS.replace("Layer:=1", "Layer:=5"), "'Plan' lies in layer 5 and holds 2 of them"),
        (FIELDS.replace("Layer:=1", "Layer:=-1"), "lies in layer -1"),
    ],
)
def test_a_header_that_is_wrong_is_one_line(fields: str, says: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=says) as caught:
        read_segmentation(seg_nrrd(tmp_path / "a.seg.nrrd", fields))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("part", [0.0, 0.3, 0.7, 0.99])
def test_a_segmentation_that_is_cut_off(part: float, tmp_path: Path) -> None:
    path = seg_nrrd(tmp_path / "a.seg.nrrd")
    path.write_bytes(path.read_bytes()[: int(part * path.stat().st_size)])
    with pytest.raises(FormatError) as caught:
        read_segmentation(path)
    assert "\n" not in str(caught.value)


# --- file names ------------------------------------------------------------------------------------------

NAMES = st.lists(st.text(max_size=300), min_size=1, max_size=8)


@given(NAMES)
@example(["CON", "con.stl", "NUL", "Com1", "LPT9.x", "com10", "AUX ", "conout$"])
@example(['a/b\\c:d*e?f"g<h>i|j', "..", ".", "...", " ", "", ".hidden", "-rf", "trailing.", "trailing "])
@example(["Rib", "rib", "RIB", "rib_2", "Straße", "STRASSE", "e\u0301", "é", "ﬁn", "fin"])
@example(["x" * 1000, "x" * 1001, "骨" * 500, "👩‍👩‍👧" * 100, "\u202egnp.exe", "a\u0000b", "\ud800"])
def test_any_names_make_files_of_every_system(names: list[str]) -> None:
    safe = safe_names(names, [f"label_{number}" for number in range(len(names))])
    assert len({unicodedata.normalize("NFKC", each).casefold() for each in safe}) == len(names)
    for each in safe:
        assert 0 < len(each.encode()) <= MOST_BYTES + 4
        assert not set(each) & set('<>:"/\\|?*')
        assert all(unicodedata.category(letter)[0] != "C" for letter in each)
        assert each == each.strip()
        assert each[0] not in ".-"
        assert each[-1] != "."
        assert each.split(".")[0].lower() not in {"con", "prn", "aux", "nul", "com1", "lpt9", "conin$", "conout$"}


def test_names_that_are_safe_stay() -> None:
    names = ["Left-Hippocampus", "Os coxae, left", "ctx-lh-insula", "骨盆", "L1 (2)", "v1.2"]
    assert safe_names(names, names) == names


def test_a_template_takes_name_and_number(tmp_path: Path) -> None:
    segments = [Segment(value=3, name="A/B"), Segment(value=12)]
    assert [
        str(each)
        for each in fill_template(
            Path("x/{number}-{label}.stl"), ["A/B", "label_12"], [segment.value for segment in segments]
        )
    ] == [
        str(Path("x/3-A_B.stl")),
        str(Path("x/12-label_12.stl")),
    ]
    assert [
        str(each)
        for each in fill_template(Path("{number}.stl"), ["{number}", "b"], [segment.value for segment in segments])
    ] == [
        "3.stl",
        "12.stl",
    ]
    assert not is_template(Path("{other}.stl"))
