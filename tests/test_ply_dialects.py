"""PLY, OFF and STL as the programs of the world write them: one solid in many dialects, and words for what is none."""

from __future__ import annotations

import itertools
import struct
from collections.abc import Sequence
from pathlib import Path

import meshio
import numpy as np
import pytest
import trimesh
from polygon_meshes import BOX, SOLIDS, Solid, prism, two_boxes

from infill import FormatError, read_mesh

CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
CODES |= {
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "float32": "f",
    "float64": "d",
}
MIXED = prism([(0, 0), (20, 0), (20, 10), (10, 10), (10, 30), (0, 30)], 5, turn=2)  # of 6 corners and 4
HALVED = Solid(  # faces of 3 corners and 4 by turns
    vertices=BOX.vertices,
    polygons=[
        part for k, each in enumerate(BOX.polygons) for part in ([each[:3], [each[0], *each[2:]]] if k % 2 else [each])
    ],
    volume=BOX.volume,
    area=BOX.area,
)
Row = Sequence[float | tuple[float, ...]]


def ply(form: str, elements: list[tuple[str, list[str], list[Row]]], *, end: str = "\n", between: str = "") -> bytes:
    """Return a PLY of elements: name, properties as they stand in the header, and rows; a tuple is a list."""
    head = ["ply", f"format {form} 1.0", *between.splitlines()]
    body = b""
    for name, properties, rows in elements:
        head += [f"element {name} {len(rows)}", *(f"property {each}" for each in properties)]
        for row in rows:
            words: list[str] = []
            for value, each in zip(row, properties, strict=True):
                kinds = each.split()[1:-1] if each.startswith("list") else each.split()[:1]
                numbers = [len(value), *value] if isinstance(value, tuple) else [value]
                if form == "ascii":
                    words += [f"{number:g}" for number in numbers]
                    continue
                sign = ">" if "big" in form else "<"
                for kind, number in zip([*kinds, *kinds[-1:] * len(numbers)], numbers, strict=False):
                    body += struct.pack(sign + CODES[kind], int(number) if CODES[kind] not in "fd" else number)
            body += (" ".join(words) + end).encode() if form == "ascii" else b""
    return (end.join([*head, "end_header"]) + end).encode() + body


def points(solid: Solid) -> tuple[str, list[str], list[Row]]:
    return "vertex", ["float x", "float y", "float z"], solid.vertices.tolist()


def faces(solid: Solid, kind: str = "list uchar int vertex_indices") -> tuple[str, list[str], list[Row]]:
    return "face", [kind], [(tuple(each),) for each in solid.polygons]


def assert_is(path: Path, solid: Solid) -> None:
    mesh = read_mesh(path)
    assert mesh.closed
    assert len(mesh.faces) == solid.triangles
    assert (mesh.volume, mesh.area) == (pytest.approx(solid.volume, rel=1e-12), pytest.approx(solid.area, rel=1e-12))
    assert np.array_equal(mesh.bounds, [solid.vertices.min(axis=0), solid.vertices.max(axis=0)])


def write(folder: Path, data: bytes | str, name: str = "part.ply") -> Path:
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    return folder / name


FORMS = ["ascii", "binary_little_endian", "binary_big_endian"]
every_form = pytest.mark.parametrize("form", FORMS)


@every_form
@pytest.mark.parametrize("solid", [BOX, HALVED, MIXED], ids=["alike", "3 and 4 corners", "6 and 4 corners"])
@pytest.mark.parametrize("name", ["vertex_indices", "vertex_index"])
def test_faces_of_any_number_of_corners(form: str, solid: Solid, name: str, tmp_path: Path) -> None:
    kind = f"list uchar int {name}"
    assert_is(write(tmp_path, ply(form, [points(solid), faces(solid, kind)])), solid)


@pytest.mark.longest
@every_form
@pytest.mark.parametrize("count", [*list(CODES)[:6], "float"])
def test_lists_of_any_type(form: str, count: str, tmp_path: Path) -> None:
    for solid, kind in itertools.product((BOX, HALVED), CODES):
        data = ply(form, [points(solid), faces(solid, f"list {count} {kind} vertex_indices")])
        assert_is(write(tmp_path, data), solid)


@pytest.mark.slow
@every_form
@pytest.mark.parametrize("kind", CODES)
def test_coordinates_of_any_type_in_any_order(form: str, kind: str, tmp_path: Path) -> None:
    names = ["z", "red", "x", "confidence", "y"]
    properties = [f"{kind} z", "uchar red", f"{kind} x", "float confidence", f"{kind} y"]
    rows = [[z, 255, x, 0.5, y] for x, y, z in BOX.vertices.tolist()]
    assert_is(write(tmp_path, ply(form, [("vertex", properties, rows), faces(BOX)])), BOX)
    assert len(names) == len(properties)


@every_form
def test_properties_and_lists_beside_the_corners(form: str, tmp_path: Path) -> None:
    properties = [
        "uchar red",
        "list uchar float texcoord",
        "list ushort uint vertex_indices",
        "double quality",
        "list uchar uchar flags",
    ]
    for uneven in (False, True):
        rows = [
            [k, tuple([0.5] * (6 + uneven * k)), tuple(each), 1.5, (1,) * (2 + uneven * k)]
            for k, each in enumerate(HALVED.polygons)
        ]
        assert_is(write(tmp_path, ply(form, [points(HALVED), ("face", properties, rows)])), HALVED)


@every_form
def test_elements_in_any_order_and_others_between(form: str, tmp_path: Path) -> None:
    edges = ("edge", ["int vertex1", "int vertex2"], [[0, 1], [1, 2]])
    material = ("material", ["int ambient_red", "list uchar uchar name"], [[1, (104, 105)], [2, (104,)]])
    camera = ("camera", ["float view_px"], [[1.0]])
    empty = ("multi_texture_face", ["uchar tx"], [])
    for order in itertools.permutations([points(HALVED), faces(HALVED), material]):
        assert_is(write(tmp_path, ply(form, [edges, *order, camera, empty])), HALVED)


@every_form
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_comments_ends_of_lines_and_bytes_behind(form: str, end: str, tmp_path: Path) -> None:
    notes = "comment für element face 9\nobj_info property float x\ncomment\ncomment end_header\n"
    data = ply(form, [points(HALVED), faces(HALVED)], end=end, between=notes)
    assert_is(write(tmp_path, data), HALVED)
    assert_is(write(tmp_path, data + (b"\n" if form == "ascii" else b"\n\0 made by hand")), HALVED)


@every_form
def test_what_follows_the_last_row_is_told(form: str, tmp_path: Path) -> None:
    """A row more than announced, or bytes of a program's own; blanks are none of these."""
    data = ply(form, [points(HALVED), faces(HALVED)])
    more = b"3 0 1 2\n" if form == "ascii" else b"\3" + bytes(12)
    assert read_mesh(write(tmp_path, data + b"\n \n")).notes == ()
    (note,) = read_mesh(write(tmp_path, data + more)).notes
    assert note.startswith("left out 4 words after" if form == "ascii" else "left out 13 bytes after")


def test_text_with_odd_blanks(tmp_path: Path) -> None:
    head, mark, body = ply("ascii", [points(HALVED), faces(HALVED)]).partition(b"end_header\n")
    for blanks in (b"\t", b"   ", b" \t "):
        text = head.replace(b" ", blanks) + mark + b"\n  \n" + body.replace(b" ", blanks).replace(b"\n", b" \n\n \t")
        assert_is(write(tmp_path, text), HALVED)


def test_text_that_is_not_in_lines(tmp_path: Path) -> None:
    """All in one, or a number in each: where lines say nothing, numbers are counted."""
    head, mark, body = ply("ascii", [points(HALVED), faces(HALVED)]).partition(b"end_header\n")
    assert_is(write(tmp_path, head + mark + body.replace(b"\n", b" ")), HALVED)
    assert_is(write(tmp_path, head + mark + body.replace(b" ", b"\n")), HALVED)


@every_form
def test_strips(form: str, tmp_path: Path) -> None:
    """As the Stanford archive has them: one list, whose strips end with -1."""
    around = (0, 4, 1, 5, 2, 6, 3, 7, 0, 4)
    strip = (*around, -1, 0, 1, 3, 2, -1, 4, 7, 5, 6)
    for kind in ("list int int vertex_indices", "list uint int vertex_index"):
        data = ply(form, [points(BOX), ("tristrips", [kind], [(strip,)])])
        mesh = read_mesh(write(tmp_path, data))
        assert mesh.closed
        assert (abs(mesh.volume), mesh.area) == (pytest.approx(24000), pytest.approx(5200))


@pytest.mark.slow
@every_form
@pytest.mark.parametrize("name", [each for each in SOLIDS if each != "pentagon"])
def test_polygons(form: str, name: str, tmp_path: Path) -> None:
    solid = SOLIDS[name]
    vertices = ("vertex", ["double x", "double y", "double z"], solid.vertices.tolist())
    if form == "ascii":
        solid = Solid(vertices=solid.vertices.round(2), polygons=solid.polygons, volume=solid.volume, area=solid.area)
        vertices = (vertices[0], vertices[1], solid.vertices.tolist())
    mesh = read_mesh(write(tmp_path, ply(form, [vertices, faces(solid)])))
    assert mesh.closed
    near = 1e-2 if form == "ascii" else 1e-12  # text of two digits
    assert (mesh.volume, mesh.area) == (pytest.approx(solid.volume, rel=near), pytest.approx(solid.area, rel=near))


@every_form
def test_other_readers_agree(form: str, tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(2, radius=7)
    binary = {"ascii": False, "binary_little_endian": True}.get(form)
    if binary is not None:
        path = tmp_path / "meshio.ply"
        meshio.write(path, meshio.Mesh(ball.vertices, [("triangle", ball.faces)]), binary=binary)
        assert read_mesh(path).area == pytest.approx(ball.area, rel=1e-6)  # ten digits
    solid = Solid(vertices=ball.vertices, polygons=ball.faces.tolist(), volume=ball.volume, area=ball.area)
    path = write(tmp_path, ply(form, [points(solid), faces(solid)]))
    mesh, other = read_mesh(path), trimesh.load_mesh(path, process=False)
    assert np.array_equal(mesh.vertices[mesh.faces].astype(np.float32), other.triangles.astype(np.float32))
    if form != "binary_big_endian":  # meshio's big ends need a byte order of NumPy's that is gone
        other = meshio.read(path)
        assert np.array_equal(
            mesh.vertices[mesh.faces].astype(np.float32), other.points[other.cells_dict["triangle"]].astype(np.float32)
        )


PLAIN = ply("ascii", [points(BOX), faces(BOX)]).decode()
BINARY = ply("binary_little_endian", [points(BOX), faces(BOX)])
WRONG = {
    "no PLY": ("plyx\nformat ascii 1.0\nend_header\n", "does not begin with 'ply'"),
    "another format": (PLAIN.replace("ascii", "latin"), "header with the line 'format latin 1.0'"),
    "an unknown type": (PLAIN.replace("float y", "quaternion y"), "header with the line 'property quaternion y'"),
    "a command to the terminal": (
        PLAIN.replace("float y", "\x1b[2J y"),
        r"header with the line 'property \\x1b\[2J y'",
    ),
    "a negative number of rows": (PLAIN.replace("face 6", "face -6"), "header with the line 'element face -6'"),
    "no end of the header": (PLAIN.partition("end_header")[0], "header that is cut off"),
    "two of a name": (PLAIN.replace("float y", "float x"), "two elements or properties have one name"),
    "no z": (PLAIN.replace("float z", "float w"), "vertices without x, y and z"),
    "no list": (BINARY.replace(b"list uchar int vertex_indices", b"int a"), "face without a list vertex_indices"),
    "a list of other things": (
        PLAIN.replace("int vertex_indices", "float texcoord"),
        "face without a list vertex_indices",
    ),
    "more faces than there are": (PLAIN.replace("face 6", "face 7"), "announces 7 of 'face' and holds fewer"),
    "very many faces": (PLAIN.replace("face 6", "face 4000000000"), "announces 4000000000 of 'face' and holds fewer"),
    "very many vertices": (BINARY.replace(b"vertex 8", b"vertex 999999999999"), "announces 999999999999 of 'vertex'"),
    "very many binary faces": (BINARY.replace(b"face 6", b"face 999999999"), "announces 999999999 of 'face'"),
    "cut off": (BINARY[:-3], "is cut off: it announces 6 of 'face'"),
    "a corner beyond": (PLAIN.replace("4 3 2 1 0", "4 3 2 1 8"), "corner 8, which does not exist: it holds 8"),
    "a negative corner": (PLAIN.replace("4 3 2 1 0", "4 3 2 1 -1"), "corner -1, which does not exist"),
    "a corner of a half": (PLAIN.replace("4 3 2 1 0", "4 3 2 1 0.5"), "not whole numbers"),
    "a list of a half": (PLAIN.replace("4 3 2 1 0", "4.5 3 2 1 0"), "list of 4.5 numbers"),
    "a negative list": (PLAIN.replace("4 3 2 1 0", "-4 3 2 1 0"), "list of -4 numbers"),
    "a list of all": (PLAIN.replace("4 3 2 1 0", "99999999 3 2 1 0"), "cut off|fewer"),
    "a decimal comma": (PLAIN.replace("20 30 40", "20,5 30 40"), "'20,5' has a decimal comma"),
    "a word": (PLAIN.replace("20 30 40", "20 x 40"), "'x' is not a number"),
    "more columns than announced": (
        PLAIN.replace("0 0 0\n", "0 0 0 255\n", 1),
        "announces 3 numbers or lists for each 'vertex', and row 1 does not begin or end",
    ),
    "two rows in one line": (PLAIN.replace("20 0 0\n", "20 0 0 ", 1), "row 2 does not begin or end with a line"),
    "two rows run together": (PLAIN.replace("20 0 0\n", "20 0 0", 1), "row 2 does not begin or end with a line"),
    "no vertices": (
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n",
        "holds no vertices",
    ),
    "no faces": (ply("ascii", [points(BOX)]), "holds no triangles"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_read_is_said(name: str, tmp_path: Path) -> None:
    data, says = WRONG[name]
    with pytest.raises(FormatError, match=says) as caught:
        read_mesh(write(tmp_path, data))
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("kind", ["char", "short", "int"])
def test_a_list_of_fewer_than_none(kind: str, tmp_path: Path) -> None:
    data = bytearray(ply("binary_big_endian", [points(HALVED), faces(HALVED, f"list {kind} int vertex_indices")]))
    place = data.index(b"end_header\n") + 11 + 12 * 8
    data[place] = 0x80
    with pytest.raises(FormatError, match="list of -"):
        read_mesh(write(tmp_path, bytes(data)))


# --- OFF -------------------------------------------------------------------------------------------------


def off(
    solid: Solid, *, word: str = "OFF\n", vertex: str = "", face: str = "", edges: bool = True, counts: str = ""
) -> str:
    head = counts or f"{len(solid.vertices)} {len(solid.polygons)}{' 0' if edges else ''}"
    rows = [" ".join(f"{x!r}" for x in row) + vertex for row in solid.vertices.tolist()]
    rows += [" ".join(map(str, [len(each), *each])) + face for each in solid.polygons]
    return f"{word}{head}\n" + "\n".join(rows) + "\n"


OFFS = {
    "plain": off(MIXED),
    "counts on the first line": off(MIXED, word="OFF "),
    "no blank between": off(MIXED, word="OFF"),
    "no word": off(MIXED, word=""),
    "no edges": off(MIXED, edges=False),
    "counts in lines of their own": off(MIXED, counts=f"{len(MIXED.vertices)}\n{len(MIXED.polygons)}\n0"),
    "colours": off(MIXED, word="COFF\n", vertex=" 255 128 0 255"),
    "colours as fractions": off(MIXED, word="COFF\n", vertex=" 0.5 0.5 0.25", face=" 0.1 0.2 0.3"),
    "normals": off(MIXED, word="NOFF\n", vertex=" 0 0 1"),
    "normals and colours": off(MIXED, word="CNOFF\n", vertex=" 0 0 1 0.5 0.5 0.5 1"),
    "texture": off(MIXED, word="STOFF\n", vertex=" 0.5 0.5"),
    "all": off(MIXED, word="STCNOFF\n", vertex=" 0 0 1 1 1 1 1 0.5 0.5", face=" 7"),
    "colours of faces": off(MIXED, face=" 255 0 0"),
    "colours of some faces": off(MIXED).replace("\n6 ", "\n6 ", 1)[:-1] + " 0.5 0.5 0.5 1\n",
    "comments": "# made by hand\n" + off(MIXED).replace("\n", " # a comment\n# 1 2 3\n\n"),
    "tabs and blanks": off(MIXED).replace(" ", " \t "),
    "CRLF": off(MIXED).replace("\n", "\r\n"),
    "CR": off(MIXED).replace("\n", "\r"),
    "one line": off(MIXED).replace("\n", " "),
    "lower case": off(MIXED, word="off\n"),
    "UTF-8 mark": "\ufeff" + off(MIXED),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", OFFS)
def test_an_off_in_every_dialect(name: str, tmp_path: Path) -> None:
    assert_is(write(tmp_path, OFFS[name], "part.off"), MIXED)


@pytest.mark.slow
@pytest.mark.parametrize("name", SOLIDS)
def test_polygons_of_an_off(name: str, tmp_path: Path) -> None:
    assert_is(write(tmp_path, off(SOLIDS[name]), "part.off"), SOLIDS[name])


WRONG_OFFS = {
    "binary": ("OFF BINARY\n", "is a binary OFF file; export it as text"),
    "four dimensions": ("4OFF\n1 1 0\n", "more than three dimensions"),
    "any dimensions": ("nOFF\n3\n1 1 0\n", "more than three dimensions"),
    "no counts": ("OFF\n", "does not say how many"),
    "a count that is none": ("OFF\n8 x 0\n", "line 2: 'x' is not a whole number"),
    "a count below none": ("OFF\n8 -6 0\n", "line 2: '-6' is not a count"),
    "very many": (off(BOX, counts="4000000000 6 0"), "cut off|not in lines"),
    "cut off": (off(BOX)[:-30], "cut off|not in lines|corners with"),
    "a corner beyond": (off(BOX).replace("4 3 2 1 0", "4 3 2 1 8"), "corner 8, which does not exist: it holds 8"),
    "a face of too few": (off(BOX).replace("4 3 2 1 0", "5 3 2 1 0"), "line 11: a face of 5 corners with 4"),
    "a vertex of too few": (off(BOX).replace("20.0 30.0 40.0", "20.0 30.0"), r"line 9: a vertex of 2 numbers"),
    "a decimal comma": (off(BOX).replace("20.0 30.0 40.0", "20,0 30.0 40.0"), "line 9: '20,0' has a decimal comma"),
}


@pytest.mark.parametrize("name", WRONG_OFFS)
def test_what_is_wrong_with_an_off_is_said(name: str, tmp_path: Path) -> None:
    text, says = WRONG_OFFS[name]
    with pytest.raises(FormatError, match=says) as caught:
        read_mesh(write(tmp_path, text, "part.off"))
    assert str(caught.value).isprintable()


# --- STL -------------------------------------------------------------------------------------------------


def stl(triangles: np.ndarray, *, name: str = "a") -> str:
    vertex = ("vertex {} {} {}\n" * 3).format
    loops = ["facet normal 0 0 0\nouter loop\n" + vertex(*each.ravel()) + "endloop\nendfacet\n" for each in triangles]
    return f"solid {name}\n{''.join(loops)}endsolid {name}\n"


def binary_stl(triangles: np.ndarray, *, announced: int | None = None) -> bytes:
    count = len(triangles) if announced is None else announced
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *each.ravel(), 0) for each in triangles)
    return b"solid in name only".ljust(80) + struct.pack("<I", count) + rows


CORNERS = trimesh.creation.box((20, 30, 40)).triangles
APART = CORNERS + np.array([50, 0, 0])
STLS = {
    "two solids": stl(CORNERS, name="one vertex 1 2 3") + stl(APART, name="two"),
    "two solids, the first without an end": stl(CORNERS).replace("endsolid a\n", "") + stl(APART),
    "upper case": (stl(CORNERS) + stl(APART)).upper(),
    "tabs, blanks before": (stl(CORNERS) + stl(APART)).replace("vertex", "  \tvertex").replace(" ", "\t"),
    "blank lines": (stl(CORNERS) + stl(APART)).replace("\n", "\n \n"),
    "CRLF": (stl(CORNERS) + stl(APART)).replace("\n", "\r\n"),
    "exponents": (stl(CORNERS) + stl(APART)).replace(".0", ".0E+00"),
    "words behind": stl(CORNERS) + stl(APART) + "made by hand\n",
}


@pytest.mark.parametrize("name", STLS)
def test_a_text_stl_in_every_dialect(name: str, tmp_path: Path) -> None:
    mesh = read_mesh(write(tmp_path, STLS[name], "part.stl"))
    assert mesh.closed
    assert mesh.volume == pytest.approx(48000)
    mesh = read_mesh(write(tmp_path, STLS[name].encode("utf-16"), "part.stl"))
    assert mesh.closed


LEFT_OUT = "left out {} bytes after the last triangle that it announces"


def test_a_binary_stl_with_bytes_behind(tmp_path: Path) -> None:
    for more in (b"\r\n", b"x" * 49, b"made by hand" * 9):
        found = read_mesh(write(tmp_path, binary_stl(CORNERS) + more, "part.stl"))
        assert found.closed
        assert found.notes == (() if more.isspace() else (LEFT_OUT.format(len(more)),))


@pytest.mark.parametrize("more", [binary_stl(APART), stl(APART).encode()])
def test_a_binary_stl_with_another_behind(more: bytes, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="holds a second STL behind its 12 triangles; export each into a file"):
        read_mesh(write(tmp_path, binary_stl(CORNERS) + more, "part.stl"))


@pytest.mark.parametrize("announced", [1, 11, 13, 4_000_000_000])
def test_a_binary_stl_that_announces_another_number(announced: int, tmp_path: Path) -> None:
    with pytest.raises(
        FormatError, match=rf"announces {announced} triangles and holds 12|{announced} triangles announced"
    ):
        read_mesh(write(tmp_path, binary_stl(CORNERS, announced=announced), "part.stl"))


@pytest.mark.parametrize(
    ("old", "new"), [("vertex", "vertez"), ("outer loop\nvertex 10.0", "outer loop\nlost\nvertex 10.0")]
)
def test_a_facet_of_other_than_three_vertices(old: str, new: str, tmp_path: Path) -> None:
    text = stl(CORNERS)
    cut = (
        text.replace(old, new, 3)
        if old == "vertex"
        else text.replace("endloop\n", "vertex 1 2 3\n" * 3 + "endloop\n", 1)
    )
    with pytest.raises(FormatError, match=r"holds 12 facets and (33|39) vertices"):
        read_mesh(write(tmp_path, cut, "part.stl"))


def test_two_boxes_are_two(tmp_path: Path) -> None:
    """What the tests above would miss if only the first were read."""
    one, two = two_boxes()
    assert one.volume + two.volume == 48000
