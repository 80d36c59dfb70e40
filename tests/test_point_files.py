"""One contract for every format of points: the same points, whatever stands around them."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from infill.errors import FormatError
from infill.formats.point_files import READERS, read_points, read_points_and_normals

POINTS = np.array([[0.0, 1.5, -2.25], [3.0, 4.0, 5.125], [1e-3, -7e5, 0.1]])
ROWS = [" ".join(repr(float(x)) for x in row) for row in POINTS]
TEXT = [".xyz", ".txt", ".pts", ".csv"]


@pytest.mark.longest
@pytest.mark.parametrize("suffix", TEXT)
@pytest.mark.parametrize("mark", [" ", "\t", "  \t", ",", ", ", ";"])
@pytest.mark.parametrize(
    "front", ["", "# made by hand, für alle\n\n", "3\n", "x y z\n", '"X [mm]" "Y [mm]" "Z [mm]"\n']
)
@pytest.mark.parametrize("extra", ["", " 0.1 0.2 0.3", " 255 # red"])
def test_text_in_columns(suffix: str, mark: str, front: str, extra: str, tmp_path: Path) -> None:
    lines = [(row + extra).replace(" # ", "# ").replace(" ", mark) for row in ROWS]
    names = front.replace(" [mm]", "_mm").replace(" ", mark) if front[:1] in 'x"' and front else front
    path = tmp_path / f"a{suffix}"
    path.write_bytes((names + "\n".join(lines) + "\n").encode("latin-1"))
    points = read_points(path)
    assert np.array_equal(points, POINTS)
    assert points.dtype == np.float64
    assert points.flags.owndata


NORMALS = np.array([[0.0, 0.6, 0.8], [1.0, 0, 0], [0, 0, -1.0]])


@pytest.mark.parametrize(
    ("name", "head", "columns"),
    [
        ("a.xyz", "", "pn"),
        ("a.xyz", "3\n", "pn"),
        ("a.csv", "nx,ny,nz,x,y,z\n", "np"),
        ("a.csv", "Points:0,Points:1,Points:2,Normals:0,Normals:1,Normals:2\n", "pn"),
        ("a.ply", "property float nx\nproperty float ny\nproperty float nz\n", "pn"),
        ("a.npy", "", "pn"),
    ],
)
def test_normals_of_a_file(name: str, head: str, columns: str, tmp_path: Path) -> None:
    table = np.concatenate([{"p": POINTS, "n": NORMALS}[each] for each in columns], axis=1)
    path, mark = tmp_path / name, "," if name.endswith(".csv") else " "
    rows = "\n".join(mark.join(repr(float(x)) for x in row) for row in table)
    if name.endswith(".npy"):
        np.save(path, table)
    elif name.endswith(".ply"):
        first = "".join(f"property double {axis}\n" for axis in "xyz")
        path.write_text(f"ply\nformat ascii 1.0\nelement vertex 3\n{first}{head}end_header\n{rows}\n")
    else:
        path.write_text(head + rows)
    points, normals = read_points_and_normals(path)
    assert np.array_equal(points, POINTS)
    assert normals is not None
    assert np.array_equal(normals, NORMALS)


@pytest.mark.parametrize("extra", [["0.1 0.2 0.3"] * 3, ["255 0 0"] * 3, ["0 0 1", "", ""], ["1 0"] * 3])
def test_other_columns_are_no_normals(extra: list[str], tmp_path: Path) -> None:
    path = tmp_path / "a.xyz"
    path.write_text("\n".join(f"{row} {more}" for row, more in zip(ROWS, extra, strict=True)))
    points, normals = read_points_and_normals(path)
    assert np.array_equal(points, POINTS)
    assert normals is None


@pytest.mark.parametrize(
    ("names", "order"),
    [
        ("x,y,z", (0, 1, 2)),
        ("Z,X,Y", (2, 0, 1)),
        ('"y","z","x"', (1, 2, 0)),
        ("y [mm],x [mm],z [mm]", (1, 0, 2)),
        ("z_mm,y_mm,x_mm", (2, 1, 0)),
        ("Points:2,Points:1,Points:0", (2, 1, 0)),
        ("easting,northing,height", (0, 1, 2)),
    ],
)
def test_csv_by_the_names_of_its_columns(names: str, order: tuple[int, ...], tmp_path: Path) -> None:
    rows = [",".join(repr(float(row[axis])) for axis in order) for row in POINTS]
    path = tmp_path / "a.csv"
    path.write_text("\ufeff" + names + "\r\n" + "\r\n".join(rows), encoding="utf-8", newline="")
    assert np.array_equal(read_points(path), POINTS)
    beside = [f"7,word,{row},8" for row in rows]
    path.write_text(f"id,note,{names},x_error\n" + "\n".join(beside))
    if "easting" in names:  # then the first three are taken, and one of them is a word
        with pytest.raises(FormatError, match="word"):
            read_points(path)
    else:
        assert np.array_equal(read_points(path), POINTS)


@pytest.mark.parametrize("dtype", [np.float32, float, np.int16, ">f8"])
def test_npy(dtype: Any, tmp_path: Path) -> None:
    wide = np.arange(24).reshape(4, 6).astype(dtype)
    np.save(tmp_path / "a.npy", wide)
    points = read_points(tmp_path / "a.npy")
    assert np.array_equal(points, wide[:, :3])
    assert points.dtype == np.float64
    assert points.dtype.isnative


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_of_any_order_and_columns(encoding: str, tmp_path: Path) -> None:
    """Other elements in front, columns in another order, doubles kept as they are."""
    header = (
        f"ply\nformat {encoding} 1.0\ncomment by hand\nobj_info none\nelement camera 2\nproperty short a\n"
        "element vertex 3\nproperty uchar red\nproperty double z\nproperty double x\nproperty float32 nx\nproperty double y\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    if encoding == "ascii":
        component = "1\n2\n" + "".join(f"9 {z!r} {x!r} 0.5 {y!r}\n" for x, y, z in POINTS.tolist()) + "3 0 1 2\n"
        content = (header + component).encode()
    else:
        order = "<" if "little" in encoding else ">"
        rows = b"".join(struct.pack(f"{order}Bddfd", 9, z, x, 0.5, y) for x, y, z in POINTS)
        content = header.encode() + struct.pack(f"{order}hh", 1, 2) + rows + struct.pack(f"{order}B3i", 3, 0, 1, 2)
    (tmp_path / "a.ply").write_bytes(content)
    assert np.array_equal(read_points(tmp_path / "a.ply"), POINTS)
    (tmp_path / "a.ply").write_bytes(content[: content.rindex(b"end_header") + 45])
    with pytest.raises(FormatError, match="is cut off|is broken"):
        read_points(tmp_path / "a.ply")


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_ply_of_trimesh(encoding: Any, tmp_path: Path) -> None:
    mesh = trimesh.creation.icosphere(subdivisions=1)
    mesh.export(tmp_path / "mesh.ply", encoding=encoding)
    trimesh.PointCloud(mesh.vertices).export(tmp_path / "cloud.ply", encoding=encoding)
    for name in ("mesh.ply", "cloud.ply"):
        # Written with 32 bits or 8 digits.
        assert read_points(tmp_path / name) == pytest.approx(np.asarray(mesh.vertices), abs=1e-6)


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.xyz", "", "is empty .0 bytes."),
        ("a.xyz", "# nothing\n\n", "holds no points"),
        ("a.xyz", "x y z\n", "holds no points"),
        ("a.pts", "5\n", "holds no points"),
        ("a.pts", "5\n1 2 3\n4 5 6\n", "announces 5 points and holds 2"),
        ("a.xyz", "1 2\n3 4\n", "broken or holds no points"),
        ("a.xyz", "1 2 3\n4 5\n", "broken or holds no points .*row 2"),
        ("a.xyz", "1 2 3\n4 five 6\n", "five"),
        ("a.csv", "1,2,3\n4,,6\n", "broken or holds no points"),
        ("a.csv", "x,y,z\n1,2,3\n4,nan,6\n7,8,inf\n", r"2 points with NaN .* number 2"),
        ("a.txt", "some words only\nand more of them\n", "broken or holds no points"),
        ("a.xyz", "2\nwater\nO 0 0 0\nH 0 0 1\n", "broken or holds no points"),
        ("a.ply", "plx\n", "is not a PLY"),
        ("a.ply", "ply\n", "header that is broken"),
        ("a.ply", "ply\nformat ascii 1.0\nend_header\n", "no vertices"),
        ("a.ply", "ply\nformat odd 1.0\nend_header\n", "is broken"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n2\n",
            "without x, y and z",
        ),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex -2\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
            "-2 rows",
        ),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
            "holds no points",
        ),
        (
            "a.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n12",
            "is cut off",
        ),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int i\nelement vertex 1\nproperty float x\nend_header\n",
            "face lists in front",
        ),
        ("a.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n", "is broken"),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", "is broken"),
        ("a.npy", "text", "is broken"),
        ("a.stl", "x", r"cannot tell .* use one of \.xyz"),
        ("a", "x", "cannot tell"),
    ],
)
def test_a_broken_file_is_one_clear_line(name: str, content: str, says: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(FormatError, match=says) as caught:
        read_points(path)
    assert "\n" not in str(caught.value)
    assert "; " in str(caught.value)


@pytest.mark.parametrize(
    ("array", "says"),
    [
        (np.zeros((4, 2)), r"shape \(4, 2\); save points as \(N, 3\)"),
        (np.zeros(4), "shape"),
        (np.zeros((0, 3)), "holds no points|is broken"),
        (np.zeros((4, 3), complex), "type complex"),
        (np.full((4, 3), "x"), "type <U1"),
        (np.array([[object()] * 3]), "is empty"),
        (np.full((4, 3), np.nan), r"4 points with NaN"),
    ],
)
def test_an_npy_of_something_else(array: np.ndarray, says: str, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", array, allow_pickle=False) if array.dtype != object else (
        tmp_path / "a.npy"
    ).write_bytes(b"")
    with pytest.raises(FormatError, match=says):
        read_points(tmp_path / "a.npy")


@pytest.mark.parametrize("suffix", list(READERS))
@pytest.mark.parametrize(
    "content", [b"", b"\0" * 200, b"nonsense " * 40, b"\xff\xfe1\x00 \x00", b"ply\nformat ascii 1.0\n"]
)
def test_rubbish_is_one_clear_line(suffix: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / f"rubbish{suffix}"
    path.write_bytes(content)
    with pytest.raises(FormatError) as caught:
        read_points(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_and_unreadable_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.xyz"
    with pytest.raises(FormatError, match="there is no file"):
        read_points(path)
    path.write_text("1 2 3")
    assert read_points(path).tolist() == [[1, 2, 3]]
    monkeypatch.setitem(READERS, ".xyz", lambda path: open(path / "below"))  # noqa: SIM115 - raises
    with pytest.raises(FormatError, match="cannot read"):
        read_points(path)


@pytest.mark.longest
def test_real_points(data: Path) -> None:
    kitten = read_points(data / "models" / "kitten_points.xyz")
    assert kitten.shape == (5210, 3)
    assert kitten[0].tolist() == [-0.0721898, -0.159749, -0.108444]
    for name in ("models/horse_97k.ply", "medical/foot_bones_26.ply"):
        expected = trimesh.load_mesh(data / name, process=False).vertices
        # trimesh takes text as 32-bit numbers.
        assert read_points(data / name) == pytest.approx(np.asarray(expected), rel=1e-6, abs=1e-9)
