"""OBJ as the programs of the world write it: one box in many dialects, and words for what is none."""

from __future__ import annotations

import io
from pathlib import Path

import meshio
import numpy as np
import pytest
import trimesh
from polygon_meshes import BOX, SOLIDS, Solid, two_boxes

from infill import FormatError, read_mesh

V = ["v " + " ".join(f"{x:g}" for x in row) for row in BOX.vertices]
F = ["f " + " ".join(str(k + 1) for k in each) for each in BOX.polygons]
TEXT = "\n".join([*V, *F, ""])


def rows(solid: Solid, form: str = "{}", shift: int = 1) -> list[str]:
    return ["f " + " ".join(form.format(k + shift) for k in each) for each in solid.polygons]


def lines(solid: Solid) -> list[str]:
    return [f"v {x:g} {y:g} {z:g}" for x, y, z in solid.vertices]


def each_line(change: object) -> str:
    return "\n".join(map(change, TEXT.splitlines())) + "\n"


TEXTURED = "\n".join([*V, "vn 0 0 1", "vt 0 0", ""])
DIALECTS = {
    "plain": TEXT,
    "leading blanks": each_line(lambda line: "  \t" + line),
    "trailing blanks": each_line(lambda line: line + " \t "),
    "tabs": TEXT.replace(" ", "\t"),
    "many blanks": TEXT.replace(" ", "   "),
    "comments behind": each_line(lambda line: line + " # a side f 1 2 3"),
    "comments behind without a blank": each_line(lambda line: line + "#1"),
    "comments between": each_line(lambda line: f"# v 1 2 3\n#\n{line}\n\n"),
    "a comment that ends in a backslash": "# C:\\parts\\\n" + TEXT,
    "continued": TEXT.replace(" ", " \\\n "),
    "continued, blanks behind the mark": TEXT.replace(" ", " \\ \t\n"),
    "CRLF": TEXT.replace("\n", "\r\n"),
    "CR": TEXT.replace("\n", "\r"),
    "continued, CRLF": TEXT.replace(" ", " \\\n").replace("\n", "\r\n"),
    "no end of the last line": TEXT.rstrip("\n"),
    "fo": TEXT.replace("f ", "fo "),
    "upper case": TEXT.upper(),
    "colours": each_line(lambda line: line + " 0.5 0.25 1" if line[0] == "v" else line),
    "colours of eight bits": each_line(lambda line: line + " 255 0 128" if line[0] == "v" else line),
    "a weight": each_line(lambda line: line + " 1.0" if line[0] == "v" else line),
    "a weight and colours": each_line(lambda line: line + " 1 0.5 0.25 1 1" if line[0] == "v" else line),
    "some have colours": "\n".join([*(each + " 1 0 0" * (k % 2) for k, each in enumerate(V)), *F]),
    "texture": TEXTURED + "\n".join(rows(BOX, "{}/1")),
    "normals": TEXTURED + "\n".join(rows(BOX, "{}//1")),
    "texture and normals": TEXTURED + "\n".join(rows(BOX, "{}/1/1")),
    "nothing behind a slash": TEXTURED + "\n".join(rows(BOX, "{}/")),
    "normals counted backwards": TEXTURED + "\n".join(rows(BOX, "{}/-1/-1")),
    "texture, continued": (TEXTURED + "\n".join(rows(BOX, "{}/1/1"))).replace(" ", " \\\n"),
    "exponents and signs": each_line(
        lambda line: "v " + " ".join(f"+{float(x):.6E}" for x in line.split()[1:]) if line[0] == "v" else line
    ),
    "no digits before the point": TEXT.replace("v 0 ", "v .0 ").replace("v 20 ", "v 20. "),
    "groups, objects, materials": "mtllib a.mtl\no part\ng one two\n"
    + "\n".join([*V, "usemtl red", "s off", F[0], "s 1", "g", *F[1:]]),
    "lines and points": TEXT + "l 1 2 3\np 1\np 2 3\n",
    "faces first": "\n".join([*F, *V]),
    "counted from the end of the file": "\n".join([*V, *rows(BOX, shift=-8)]),
    "vertices that no face uses": "\n".join([*V, "v 900 900 900", *F]),
    "parameters and other statements": "vp 0.5 0.5\nlod 1\nshadow_obj a\nmg off\n" + TEXT,
}
ENCODINGS = {
    "mark of UTF-8": "utf-8-sig",
    "UTF-16": "utf-16",
    "UTF-16, little end first, unmarked": "utf-16-le",
    "UTF-16, big end first, unmarked": "utf-16-be",
    "Latin 1": "latin-1",
    "UTF-8": "utf-8",
}


def write(folder: Path, text: str | bytes) -> Path:
    path = folder / "part.obj"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def assert_box(path: Path) -> None:
    mesh = read_mesh(path)
    assert mesh.closed
    assert len(mesh.faces) == 12
    assert (mesh.volume, mesh.area) == (pytest.approx(24000, rel=1e-12), pytest.approx(5200, rel=1e-12))
    assert np.array_equal(mesh.bounds, [[0, 0, 0], [20, 30, 40]])


@pytest.mark.slow
@pytest.mark.parametrize("name", DIALECTS)
def test_a_box_in_every_dialect(name: str, tmp_path: Path) -> None:
    assert_box(write(tmp_path, DIALECTS[name]))


@pytest.mark.parametrize("name", ENCODINGS)
def test_a_box_in_every_encoding(name: str, tmp_path: Path) -> None:
    text = TEXT if "unmarked" in name else f"# für\no grün\n{TEXT}"
    assert_box(write(tmp_path, text.encode(ENCODINGS[name])))


@pytest.mark.parametrize("form", ["{}", "{}/-1/-1", "{}//-1"])
@pytest.mark.parametrize("behind", [False, True])
def test_corners_counted_backwards_by_turns(form: str, behind: bool, tmp_path: Path) -> None:
    """An index -k is the k-th vertex before its own line: also where the vertices of the next part come after it."""
    boxes = two_boxes()
    blocks = [[*lines(each), "vn 0 0 1", "vt 0 0", *rows(each, form, -8)] for each in boxes]
    if behind:  # all vertices, then the faces of the first with what lies between
        blocks = [
            lines(boxes[0]),
            lines(boxes[1]),
            rows(boxes[0], form.replace("-1", "1"), -16),
            rows(boxes[1], shift=-8),
        ]
        blocks[0] += ["vn 0 0 1", "vt 0 0"]
    mesh = read_mesh(write(tmp_path, "\n".join(each for block in blocks for each in block)))
    assert mesh.closed
    assert mesh.volume == pytest.approx(48000, rel=1e-12)
    assert np.array_equal(mesh.bounds, [[0, 0, 0], [70, 30, 40]])


def test_one_face_between_every_two_vertices(tmp_path: Path) -> None:
    """Backwards and forwards by turns, in one line even; as an independent count has it."""
    rng = np.random.default_rng(3)
    text, expected = [], []
    for count in range(1, 201):
        text.append("v " + " ".join(f"{x:.3f}" for x in rng.normal(size=3)))
        if count > 3:
            corners = rng.choice(count, 3, replace=False)
            expected.append(corners)
            text.append("f " + " ".join(str(k + 1 if rng.random() < 0.5 else k - count) for k in corners.tolist()))
    points = np.array([each.split()[1:] for each in text if each[0] == "v"], dtype=float)
    mesh = read_mesh(write(tmp_path, "\n".join(text)))
    assert np.array_equal(mesh.vertices[mesh.faces], points[np.array(expected)])


@pytest.mark.parametrize("name", SOLIDS)
def test_polygons(name: str, tmp_path: Path) -> None:
    solid = SOLIDS[name]
    path = tmp_path / "part.obj"
    path.write_text("\n".join([*(f"v {x!r} {y!r} {z!r}" for x, y, z in solid.vertices.tolist()), *rows(solid)]))
    mesh = read_mesh(path)
    assert mesh.closed
    assert len(mesh.faces) == solid.triangles
    assert (mesh.volume, mesh.area) == (pytest.approx(solid.volume, rel=1e-12), pytest.approx(solid.area, rel=1e-12))


def test_other_readers_agree(tmp_path: Path) -> None:
    """On a sphere of triangles: trimesh and meshio."""
    ball = trimesh.creation.icosphere(2, radius=7)
    path = write(tmp_path, trimesh.exchange.obj.export_obj(ball))
    mesh = read_mesh(path)
    other = meshio.read(path)
    assert mesh.area == pytest.approx(trimesh.load_mesh(path).area, rel=1e-12)
    assert np.array_equal(mesh.vertices[mesh.faces], other.points[other.cells_dict["triangle"]])


WRONG = {
    "a decimal comma": ("v 1,5 0 0\n", r"line 1: '1,5' has a decimal comma"),
    "a word for a number": ("# a\nv 0 0 0\nv 0 zero 0\n", "line 3: 'zero' is not a number"),
    "two numbers": ("v 0 0 0\nv 1 2\n", r"line 2: a vertex of 2 numbers"),
    "no number": ("v\n", r"line 1: a vertex of 0 numbers"),
    "a face cut off": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2", r"line 4: a face of 2 corners"),
    "a corner 0": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2", "line 4: corner 0 does not exist: the file holds 3"),
    "a corner beyond": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4", "line 4: corner 4 does not exist: the file holds 3"),
    "a corner too far back": (
        "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n",
        "line 3: corner -3 does not exist: 2 vertices",
    ),
    "a corner that is a fraction": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3.5", "line 4: '3.5' is not a whole number"),
    "a corner of many digits": (TEXT + "f 1 2 99999999999999999999999", "line 15: corner .* does not exist"),
    "a corner without a number": (TEXT + "f 1 2 /3", "line 15: '/3' is not a whole number"),
    "a surface of splines": (
        TEXT + "cstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nend\n",
        "'surf' is a free-form surface",
    ),
    "another file": ("call other.obj\n" + TEXT, "'call' takes in another file"),
    "a word that ran into its number": (TEXT + "f1 2 3\n", "line 15: 'f1' begins no line"),
    "a line of numbers": (TEXT + "1 2 3\n", "line 15: '1' begins no line of an OBJ file"),
    "a line that is damaged": (TEXT + "\x1b]0;mine\x07v 1 2 3\n", r"line 15: '\\x1b\]0;mine.*' begins no line"),
    "continued lines count": ("v 0 \\\n 0 \\\n 0\nv 1 x 0", "line 4: 'x' is not a number"),
    "bytes that no text has": (TEXT.encode() + b"\0\0\0", "bytes that no text has"),
    "only lines": ("v 0 0 0\nv 1 0 0\nl 1 2\n", "holds no triangles"),
    "only comments": ("# nothing\n", "holds no vertices"),
    "not a number": (TEXT.replace("v 20 0 0", "v nan 0 0"), "not numbers"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_read_is_said_with_its_line(name: str, tmp_path: Path) -> None:
    text, says = WRONG[name]
    with pytest.raises(FormatError, match=says) as caught:
        read_mesh(write(tmp_path, text))
    assert "\n" not in str(caught.value)
    assert str(caught.value).isprintable()


def test_the_writer_of_trimesh_with_everything(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(2, radius=7)
    ball.visual.vertex_colors = np.tile([10, 20, 30, 255], (len(ball.vertices), 1))
    text = io.StringIO(trimesh.exchange.obj.export_obj(ball, include_normals=True, include_color=True)).read()
    mesh = read_mesh(write(tmp_path, text))
    assert mesh.closed
    assert mesh.volume == pytest.approx(ball.volume, rel=1e-6)  # eight digits


def test_statements_that_the_format_does_not_have_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(TEXT + "blah 0 1\nBLAH 3\ncurv 0 1 1 2\n")
    mesh = read_mesh(path)
    assert mesh.notes == ("left out 2 lines starting with 'blah', 'BLAH': OBJ has no such lines",)
    path.write_text(TEXT + "".join(f"x{letter} 1\n" for letter in "abcde"))
    assert read_mesh(path).notes == ("left out 5 lines starting with 'xa', 'xb', 'xc' …: OBJ has no such lines",)
