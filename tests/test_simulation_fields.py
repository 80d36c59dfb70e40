"""Results of simulations as fields that a density follows: .vtu as VTK's and meshio's, .frd as CalculiX writes it."""

from __future__ import annotations

import base64
import math
import zlib
from pathlib import Path

import meshio
import numpy as np
import pytest
import trimesh
from handmade_prints import Dialect, written
from test_command_line import one_line_error, run

from infill import FormatError, GeometryError, fill, refill
from infill.files.array_names import split_array_name
from infill.formats.simulated_values import reduce_components
from infill.formats.simulations import read_simulation

CANTILEVER = Path(__file__).parent / "simulations" / "cantilever.frd"
TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
FORMS = [  # how numbers are stored, whether they are packed, and whether what is appended is base64
    ("ascii", False, False),
    ("binary", False, False),
    ("binary", True, False),
    ("appended", False, False),
    ("appended", False, True),
    ("appended", True, False),
    ("appended", True, True),
]


def bricks(sides: tuple[float, float, float], counts: tuple[int, int, int], corner: float = 0.0) -> meshio.Mesh:
    """Return a box of equal bricks."""
    axes = [corner + np.linspace(0, side, count + 1) for side, count in zip(sides, counts, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape([count + 1 for count in counts])
    ends = [slice(None, -1), slice(1, None)]
    around = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = np.stack([number[tuple(ends[i] for i in place)].ravel() for place in around], axis=1)
    return meshio.Mesh(points, [("hexahedron", cells)])


def vtu(
    mesh: meshio.Mesh,
    form: str = "ascii",
    *,
    packed: bool = False,
    base: bool = False,
    big: bool = False,
    pieces: int = 1,
) -> bytes:
    """Write a mesh of bricks as VTK does; every piece is the whole mesh, moved by 1 mm more along z."""
    order = ">" if big else "<"
    appended = b""

    def array(values: np.ndarray, name: str, components: int = 1) -> str:
        nonlocal appended
        kind = values.dtype.str[1:]
        head = f'<DataArray type="{TYPES[kind]}" Name="{name}" NumberOfComponents="{components}" format="{form}"'
        if form == "ascii":
            return f"{head}>\n{' '.join(map(repr, values.ravel().tolist()))}\n</DataArray>"
        data = values.astype(values.dtype.newbyteorder(order)).tobytes()
        if packed:
            blocks = [data[low : low + 304] for low in range(0, len(data), 304)]
            parts = [zlib.compress(block) for block in blocks]
            sizes = np.array([len(blocks), 304, len(blocks[-1]) % 304, *map(len, parts)]).astype(order + "u8").tobytes()
            stored = [sizes, b"".join(parts)]
        else:
            stored = [np.array([len(data)]).astype(order + "u8").tobytes() + data]
        raw = form == "appended" and not base
        coded = b"".join(stored if raw else map(base64.b64encode, stored))
        if form == "binary":
            return f"{head}>{coded.decode()}</DataArray>"
        offset = len(appended)
        appended += coded
        return f'{head} offset="{offset}"/>'

    cells = mesh.cells[0].data
    text = ""
    for number in range(pieces):
        points = mesh.points + np.array([0.0, 0.0, number])
        text += f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<PointData>'
        text += "".join(array(v, k, v[0].size) for k, v in mesh.point_data.items()) + "</PointData>\n<CellData>"
        text += "".join(array(v[0], k, v[0][0].size) for k, v in mesh.cell_data.items()) + "</CellData>\n<Points>"
        text += array(points, "Points", 3) + "</Points>\n<Cells>" + array(cells, "connectivity")
        text += array(8 * np.arange(1, len(cells) + 1), "offsets")
        text += array(np.full(len(cells), 12, dtype=np.uint8), "types") + "</Cells>\n</Piece>\n"
    return (
        (
            f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" header_type="UInt64" byte_order="'
            f'{"Big" if big else "Little"}Endian"{" compressor=" + chr(34) + "vtkZLibDataCompressor" + chr(34) if packed else ""}>'
            f"\n<UnstructuredGrid>\n{text}</UnstructuredGrid>\n"
        ).encode()
        + (
            b'<AppendedData encoding="%s">\n _' % (b"base64" if base else b"raw") + appended + b"\n</AppendedData>\n"
            if form == "appended"
            else b""
        )
        + b"</VTKFile>\n"
    )


def frd(points: np.ndarray, results: dict[str, dict[str, np.ndarray]], width: int = 10, end: str = " 9999\n") -> str:
    """Write results at nodes as CalculiX does: for each name, its components; "ALL" is not stored."""
    kind = {5: 0, 10: 1, 0: 2}[width]
    nodes = range(1, len(points) + 1)
    rows = [f" -1{node:{width}d}" + "".join(f"{x:12.5E}" for x in row) for node, row in zip(nodes, points, strict=True)]
    text = ["    1C", f"    2C{len(points):30d}{kind:38d}", *rows, " -3"]
    for name, components in results.items():
        text += [f"  100CL  101 1.000000000{len(points):12d}{0:21d}{1:5d}{kind:12d}"]
        text += [f" -4  {name:8s}{len(components) + 1:5d}    1"]
        text += [f" -5  {part:8s}    1    2    1    0" for part in components]
        text += [" -5  ALL         1    2    0    0    1ALL"]
        for node, values in zip(nodes, np.array(list(components.values())).T, strict=True):
            words = [f"{value:12.5E}" for value in values]
            text += [f" -1{node:{width}d}" + "".join(words[:6])]
            text += [" -2" + " " * width + "".join(words[low : low + 6]) for low in range(6, len(words), 6)]
        text += [" -3"]
    return "\n".join(text) + "\n" + end


# --- the readers -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("form", "packed", "base"), FORMS)
@pytest.mark.parametrize("big", [False, True])
def test_a_mesh_reads_alike_however_it_is_stored(
    tmp_path: Path, form: str, packed: bool, base: bool, big: bool
) -> None:
    """At points and in cells; a vector is its length."""
    mesh = bricks((3.0, 4.0, 5.0), (3, 2, 2))
    random = np.random.default_rng(1)
    mesh.point_data = {"heat": random.random(len(mesh.points)), "shift": random.random((len(mesh.points), 3))}
    mesh.cell_data = {"load": [random.random(12).astype(np.float32)]}
    path = tmp_path / "a.vtu"
    path.write_bytes(vtu(mesh, form, packed=packed, base=base, big=big))
    for name, points, values in (
        ("heat", mesh.points, mesh.point_data["heat"]),
        ("shift", mesh.points, np.linalg.norm(mesh.point_data["shift"], axis=1)),
        ("load", mesh.points[mesh.cells[0].data].mean(axis=1), mesh.cell_data["load"][0]),
    ):
        results = read_simulation(path, name)
        np.testing.assert_allclose(results.points, points, rtol=1e-12)
        np.testing.assert_allclose(results.values, values, rtol=1e-6)


@pytest.mark.parametrize("binary", [False, True])
def test_what_meshio_writes_is_read(tmp_path: Path, binary: bool) -> None:
    mesh = bricks((3.0, 4.0, 5.0), (3, 2, 2))
    mesh.point_data = {"heat": mesh.points[:, 0] * 7}
    meshio.write(tmp_path / "a.vtu", mesh, binary=binary)
    results = read_simulation(tmp_path / "a.vtu")
    np.testing.assert_allclose(results.values, 7 * results.points[:, 0], atol=1e-9)
    assert results.points.shape == mesh.points.shape


def test_meshio_reads_what_these_tests_write(tmp_path: Path) -> None:
    mesh = bricks((3.0, 4.0, 5.0), (3, 2, 2))
    mesh.point_data = {"heat": mesh.points[:, 0] * 7}
    (tmp_path / "a.vtu").write_bytes(vtu(mesh, "binary", packed=True))
    np.testing.assert_allclose(meshio.read(tmp_path / "a.vtu").point_data["heat"].ravel(), mesh.point_data["heat"])


def test_pieces_of_a_mesh_are_read_together(tmp_path: Path) -> None:
    mesh = bricks((3.0, 4.0, 1.0), (3, 2, 1))
    mesh.point_data = {"heat": mesh.points[:, 0]}
    (tmp_path / "a.vtu").write_bytes(vtu(mesh, pieces=3))
    results = read_simulation(tmp_path / "a.vtu")
    assert len(results.values) == 3 * len(mesh.points)
    assert results.points[:, 2].max() == 3.0
    np.testing.assert_array_equal(results.values, results.points[:, 0])


@pytest.mark.parametrize("width", [5, 10])
def test_results_of_calculix_are_read_in_both_widths(tmp_path: Path, width: int) -> None:
    """The last step counts; components have names of their own; more than six numbers go over two lines."""
    points = bricks((3.0, 4.0, 5.0), (3, 2, 2)).points - 1.5
    x, y, _ = points.T
    path = tmp_path / "a.frd"
    seven = {f"SDV{n}": n * y for n in range(1, 8)}
    results = {"DISP": {"D1": x, "D2": y, "D3": 0 * x}, "SDV": seven}
    path.write_text(frd(points, results, width).replace(" 9999\n", "") + frd(points, {"DISP": {"D1": 5 * x}}, width))
    np.testing.assert_allclose(read_simulation(path, "SDV7").values, 7 * y, rtol=1e-5)
    np.testing.assert_allclose(read_simulation(path, "DISP").values, 5 * x, rtol=1e-5)
    np.testing.assert_allclose(read_simulation(path, "D2").values, y, rtol=1e-5)
    np.testing.assert_allclose(read_simulation(path, "D2").points, points, rtol=1e-5)


def test_a_cantilever_of_calculix_bends_as_a_beam_does() -> None:
    """In its middle, sxx = F (L - x) (z - h/2) / I; away from its ends, that is nearly all there is."""
    length, side, force = 40.0, 10.0, 12.0
    results = read_simulation(CANTILEVER, "SXX")
    x, _, z = results.points.T
    beam = force * (length - x) * (z - side / 2) / (side**4 / 12)
    middle = (x > 10) & (x < 30)
    assert np.abs(results.values - beam)[middle].max() < 0.03 * np.abs(beam).max()
    stress = read_simulation(CANTILEVER)
    outer = middle & (np.abs(z - side / 2) == side / 2)
    np.testing.assert_allclose(stress.values[outer], np.abs(beam[outer]), rtol=0.05)
    assert read_simulation(CANTILEVER, "DISP").values.max() == pytest.approx(
        force * length**3 / (3 * 3500 * side**4 / 12), rel=0.1
    )


def test_a_stress_is_that_of_von_mises() -> None:
    """Under tension the tension, under shear √3 times as much, under pressure nothing; whatever way it is turned."""
    for stress, equivalent in (
        ([3, 0, 0, 0, 0, 0], 3.0),
        ([0, 0, 0, 2, 0, 0], 2 * math.sqrt(3)),
        ([5, 5, 5, 0, 0, 0], 0.0),
    ):
        xx, yy, zz, xy, yz, xz = map(float, stress)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
        turned = turn @ tensor @ turn.T
        six = [turned[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]
        for row in (stress, six, turned.ravel()):
            assert reduce_components(Path("a.vtu"), "S", np.array([row], dtype=float))[0] == pytest.approx(
                equivalent, abs=1e-12
            )


# --- what is wrong with a file ---------------------------------------------------------------------------


def test_files_that_hold_no_field_end_in_a_line(tmp_path: Path) -> None:
    mesh = bricks((3.0, 4.0, 5.0), (3, 2, 2))
    (tmp_path / "none.vtu").write_bytes(vtu(mesh))
    mesh.point_data = {"heat": mesh.points[:, 0], "load of all": mesh.points[:, 1]}
    whole = vtu(mesh)
    (tmp_path / "two.vtu").write_bytes(whole)
    (tmp_path / "cut.vtu").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "lzma.vtu").write_bytes(vtu(mesh, "binary", packed=True).replace(b"vtkZLibD", b"vtkLZMAD"))
    (tmp_path / "image.vtu").write_bytes(whole.replace(b"UnstructuredGrid", b"ImageData"))
    (tmp_path / "short.vtu").write_bytes(whole.replace(b'NumberOfPoints="36"', b'NumberOfPoints="37"'))
    (tmp_path / "huge.vtu").write_bytes(whole.replace(b'NumberOfPoints="36"', b'NumberOfPoints="%d"' % 10**15))
    (tmp_path / "nan.vtu").write_bytes(whole.replace(b"5.0", b"nan"))
    mesh.point_data = {"pairs": mesh.points[:, :2].copy()}
    (tmp_path / "pairs.vtu").write_bytes(vtu(mesh))
    mesh.point_data = {}
    mesh.cell_data = {"load": [np.arange(12.0)]}
    (tmp_path / "wild.vtu").write_bytes(
        vtu(mesh).replace(
            b'Name="connectivity" NumberOfComponents="1" format="ascii">\n0',
            b'Name="connectivity" NumberOfComponents="1" format="ascii">\n900',
        )
    )
    text = CANTILEVER.read_text()
    (tmp_path / "cut.frd").write_text(text[: len(text) * 2 // 3])
    (tmp_path / "mesh.frd").write_text(text[: text.index("  100CL")])
    (tmp_path / "binary.frd").write_text(frd(mesh.points, {}, 0))
    (tmp_path / "words.frd").write_text("results of a simulation\n" * 20)
    (tmp_path / "odd.frd").write_text(text.replace("E+00", "E+xx", 40))
    (tmp_path / "empty.frd").write_text("")
    for name, message in (
        ("none.vtu", "holds no array of numbers at its points or in its cells"),
        ("two.vtu", r"holds several arrays: 'heat', 'load of all'; choose one, such as .*two\.vtu:heat$"),
        ("two.vtu:lod", "holds no array 'lod'; choose from 'heat', 'load of all'"),
        ("cut.vtu:heat", r"is broken or not a \.vtu file"),
        ("lzma.vtu:heat", "is packed by vtkLZMADataCompressor; save it packed by zlib"),
        ("image.vtu:heat", "holds no UnstructuredGrid of VTK; save an unstructured grid as .vtu"),
        ("short.vtu:heat", "numbers where there should be"),
        ("huge.vtu:heat", "GB|memory"),
        ("nan.vtu:heat", "numbers that are not finite"),
        ("pairs.vtu", "holds 2 numbers a point in 'pairs'; choose an array of 1, 3, 6 and 9"),
        ("wild.vtu", r"is broken or not a \.vtu file"),
        ("cut.frd", "it is cut off"),
        ("mesh.frd", "holds no array of numbers"),
        ("binary.frd", "is binary; let CalculiX write its results as text"),
        ("words.frd", "no nodes"),
        ("odd.frd", "is broken or not a .frd file"),
        ("empty.frd", "is empty"),
        ("no.frd", "there is no file"),
    ):
        path, array = split_array_name(str(tmp_path / name))
        with pytest.raises((FormatError, MemoryError, ValueError), match=message) as caught:
            read_simulation(path, array)
        assert "\n" not in str(caught.value)
    assert len(read_simulation(tmp_path / "two.vtu", "load of all").values) == 36


# --- the density -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sliced(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("simulated") / "box.gcode"
    path.write_bytes(written(Dialect(size=30.0, cell=5.0, layers=6)))
    return path


@pytest.mark.slow
@pytest.mark.parametrize("corner", [0.0, 100.0, -500.0])
def test_a_density_follows_a_simulation_as_it_follows_the_axis(sliced: Path, tmp_path: Path, corner: float) -> None:
    """Of the part, wherever it was: on the bed as the print has it, or in the coordinates of a drawing."""
    mesh = bricks((30.0, 30.0, 1.2), (4, 4, 1), corner)
    values = mesh.points[:, 0] - corner
    (tmp_path / "a.frd").write_text(frd(mesh.points, {"STRESS": {"SXX": values}, "NDTEMP": {"T": 0 * values + 3}}))
    mesh.point_data = {"load": values, "heat": 0 * values}
    (tmp_path / "a.vtu").write_bytes(vtu(mesh, "appended", packed=True))
    expected = tmp_path / "x.gcode"
    refill(sliced, output=expected, pattern="grid", density=(0.15, 0.35), by="x")
    for by in ("a.frd", "a.frd:SXX", "a.vtu:load"):
        refill(sliced, output=tmp_path / "new.gcode", pattern="grid", density=(0.15, 0.35), by=str(tmp_path / by))
        first, second = (path.read_text().splitlines() for path in (expected, tmp_path / "new.gcode"))
        same = sum(a == b for a, b in zip(first, second, strict=False))
        assert len(first) == len(second)
        assert same > 0.3 * len(first)
    with pytest.raises(GeometryError, match="NDTEMP, which is 3 everywhere in the infill"):
        refill(
            sliced,
            output=tmp_path / "no.gcode",
            pattern="grid",
            density=(0.15, 0.35),
            by=f"{tmp_path / 'a.frd'}:NDTEMP",
        )


@pytest.mark.slow
def test_a_simulation_of_another_part_is_refused(sliced: Path, tmp_path: Path) -> None:
    lie = "whose points lie at x 0 to 40, y 0 to 10, z 0 to 10, and the "
    done = run(
        "refill", sliced, "--pattern", "grid", "--density", "15%:35%", "--by", CANTILEVER, "-o", tmp_path / "a.gcode"
    )
    one_line_error(done, lie + "infill at x 101 to 12")
    with pytest.raises(GeometryError, match=lie + "part at x .*; give results of this part, in its place and in mm"):
        fill(trimesh.creation.box((20, 20, 20)), density=(0.15, 0.35), by=str(CANTILEVER), voxel=0.6)
    assert not (tmp_path / "a.gcode").exists()


@pytest.mark.slow
def test_a_filled_cantilever_is_dense_where_it_bends(tmp_path: Path) -> None:
    part = trimesh.creation.box(bounds=[[0, 0, 0], [40, 10, 10]])
    report = fill(part, pattern="gyroid", density=(0.15, 0.5), by=str(CANTILEVER), voxel=0.4, cell=5).report
    assert len(report["graded"]) > 2
    assert all(abs(step["density"] - step["wanted"]) < 0.05 for step in report["graded"])


def test_a_config_names_no_results_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither by its path, nor by a link, whatever array is named."""
    folder = tmp_path / "theirs"
    folder.mkdir()
    (tmp_path / "secret.vtu").write_text("<VTKFile/>")
    (folder / "link.vtu").symlink_to(tmp_path / "secret.vtu")
    trimesh.creation.box((20, 20, 20)).export(folder / "part.stl")
    monkeypatch.chdir(folder)
    for by in ("../secret.vtu:S", "link.vtu:S", "link.vtu"):
        Path("a.toml").write_text(f'density = [0.1, 0.3]\nby = "{by}"\n')
        done = run("fill", "part.stl", "--config", "a.toml", "--dry-run", "-o", "b.stl")
        one_line_error(done, "asks to read a file from elsewhere")
