"""One contract for every file format: what is written is read back, whole or not at all."""

from __future__ import annotations

import errno
import io
import math
import os
import re
import shutil
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh
from shapes import assert_printable, smooth_noise

from infill import FormatError, OutputError, Surface, isosurface, make, read_mesh, save
from infill.files.whole_files import atomic_file, atomic_files, check_target
from infill.formats import stl
from infill.formats.mesh_files import READERS, WRITERS

every_format = pytest.mark.parametrize("suffix", list(WRITERS))


@pytest.fixture(scope="module")
def block() -> trimesh.Trimesh:
    return make("honeycomb", size=20, height=3, cell=5).mesh


@pytest.mark.slow
@every_format
def test_a_file_read_back_is_the_same_solid(suffix: str, block: trimesh.Trimesh, tmp_path: Path) -> None:
    path = save(block, tmp_path / f"block{suffix}")
    back = read_mesh(path)
    assert back.closed
    assert len(back.faces) == len(block.faces)
    # Coordinates of 32 bits: 10 mm to 1e-6 mm.
    assert back.volume == pytest.approx(block.volume, rel=1e-5)
    assert back.bounds == pytest.approx(block.bounds, abs=1e-5)
    assert_printable(back.to_trimesh())


@pytest.mark.parametrize("suffix", sorted(set(WRITERS) - {".3mf"}))  # which takes lxml; lib3mf reads it below
def test_trimesh_reads_it_too(suffix: str, block: trimesh.Trimesh, tmp_path: Path) -> None:
    path = save(block, tmp_path / f"block{suffix}")
    back = trimesh.load_mesh(path)
    back.merge_vertices()
    assert back.is_volume
    unit = 1e-3 if suffix == ".glb" else 1.0  # glTF is in metres
    assert back.volume == pytest.approx(block.volume * unit**3, rel=1e-5)
    assert back.extents == pytest.approx(block.extents * unit, rel=1e-5)


@every_format
def test_a_surface_is_saved_as_its_trimesh(suffix: str, block: trimesh.Trimesh, tmp_path: Path) -> None:
    surface = Surface(vertices=np.asarray(block.vertices), faces=np.asarray(block.faces))
    one, other = save(block, tmp_path / f"a{suffix}"), save(surface, tmp_path / f"b{suffix.upper()}")
    if suffix != ".3mf":  # a zip holds the time
        assert one.read_bytes() == other.read_bytes()
    assert len(read_mesh(other).faces) == len(block.faces)


@every_format
def test_the_old_file_stays_until_the_new_one_is_whole(
    suffix: str, block: trimesh.Trimesh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / f"block{suffix}"
    path.write_text("precious")

    def full(surface: Surface, file: object) -> None:
        file.write(b"half of a ")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setitem(WRITERS, suffix, full)
    with pytest.raises(OutputError, match="the disk is full"):
        save(block, path)
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupted_file_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), atomic_file(tmp_path / "x.stl") as file:
        file.write(b"half")
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("error", [OSError(errno.EACCES, "Permission denied"), KeyboardInterrupt()], ids=repr)
def test_files_of_one_run_take_their_places_together(
    error: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As `atomic_files` promises: if anything fails, an interrupt included, all paths are as they were."""
    paths = [tmp_path / "a.stl", tmp_path / "b.stl"]
    paths[0].write_text("precious")
    replace, calls = os.replace, []

    def second_fails(one: Path, other: Path) -> None:
        calls.append(other)
        if len(calls) == 2:
            raise error
        replace(one, other)

    monkeypatch.setattr(os, "replace", second_fails)
    with pytest.raises((OutputError, KeyboardInterrupt)), atomic_files(paths) as files:
        for file in files:
            file.write(b"new")
    assert paths[0].read_text() == "precious"
    assert list(tmp_path.iterdir()) == paths[:1]


@pytest.mark.parametrize("linked", [True, False])
def test_files_that_take_their_places_leave_nothing_behind(
    linked: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the file system has no links, the old file is copied; a copy that fails leaves no part of itself."""
    paths = [tmp_path / "a.stl", tmp_path / "b.stl"]
    paths[0].write_text("precious")

    def refused(*names: Path) -> None:
        raise OSError(errno.EPERM, "Operation not permitted")

    if not linked:
        monkeypatch.setattr(os, "link", refused)
    with atomic_files(paths) as files:
        for file in files:
            file.write(b"new")
    assert [path.read_bytes() for path in paths] == [b"new"] * 2
    assert sorted(tmp_path.iterdir()) == paths

    def full(source: Path, target: Path) -> None:
        target.write_bytes(b"hal")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "link", refused)
    monkeypatch.setattr(shutil, "copy2", full)
    with pytest.raises(OutputError, match="disk is full"), atomic_files(paths) as files:
        for file in files:
            file.write(b"newer")
    assert [path.read_bytes() for path in paths] == [b"new"] * 2
    assert sorted(tmp_path.iterdir()) == paths


def test_other_errors_are_told_by_the_system(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write .*: Input/output error"), atomic_file(tmp_path / "x") as file:
        file.write(b"x")
        raise OSError(errno.EIO, "Input/output error")
    with pytest.raises(OutputError, match="No such file"), atomic_file(tmp_path / "missing" / "x"):
        pass
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/dev/null").exists(), reason="no /dev/null on this system")
def test_a_device_is_written_to_in_place(block: trimesh.Trimesh) -> None:
    with atomic_file("/dev/null") as file:
        file.write(b"x")
    assert Path("/dev/null").is_char_device()


def test_targets_are_checked_before_the_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    old = tmp_path / "old.stl"
    old.write_text("precious")
    with pytest.raises(OutputError, match="exists"):
        check_target(old, overwrite=False)
    assert check_target(old, overwrite=True) == old
    with pytest.raises(OutputError, match="there is no folder"):
        check_target(tmp_path / "no" / "x.stl", overwrite=True)
    with pytest.raises(OutputError, match="is a folder"):
        check_target(tmp_path, overwrite=True)
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(OutputError, match="may not be written to"):
        check_target(tmp_path / "x.stl", overwrite=True)


@pytest.mark.parametrize("name", ["block", "block.xyz", "block.stl.gz"])
def test_an_unknown_suffix_lists_the_known(name: str, block: trimesh.Trimesh, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"\.stl, \.3mf, \.obj, \.ply, \.glb"):
        save(block, tmp_path / name)
    with pytest.raises(FormatError, match=r"\.off"):
        read_mesh(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_stl_as_text(block: trimesh.Trimesh, tmp_path: Path) -> None:
    path = save(block, tmp_path / "block.stl", ascii=True)
    assert path.read_bytes().startswith(b"solid")
    binary = read_mesh(save(block, tmp_path / "binary.stl"))
    assert np.array_equal(read_mesh(path).vertices, binary.vertices)
    assert trimesh.load_mesh(path).is_volume
    with pytest.raises(FormatError, match="only .stl"):
        save(block, tmp_path / "block.obj", ascii=True)


def test_binary_stl_says_the_unit_and_is_no_text(block: trimesh.Trimesh, tmp_path: Path) -> None:
    data = save(block, tmp_path / "block.stl").read_bytes()
    assert b"UNITS=mm" in data[:80]
    assert not data.startswith(b"solid")
    assert len(data) == 84 + 50 * len(block.faces)


def test_stl_normals_are_unit_vectors_along_the_faces(block: trimesh.Trimesh, tmp_path: Path) -> None:
    record = np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    rows = np.frombuffer(save(block, tmp_path / "block.stl").read_bytes()[84:], dtype=record)
    assert np.einsum("ij,ij->i", rows["n"], block.face_normals) == pytest.approx(1, abs=1e-3)


def test_lib3mf_takes_the_3mf_strictly(block: trimesh.Trimesh, tmp_path: Path) -> None:
    lib3mf = pytest.importorskip("lib3mf", reason="lib3mf is not installed (test extra)")
    path = save(block, tmp_path / "block.3mf")
    model = lib3mf.Wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    meshes = model.GetMeshObjects()
    assert meshes.MoveNext()
    mesh = meshes.GetCurrentMeshObject()
    assert mesh.GetTriangleCount() == len(block.faces)
    assert mesh.IsManifoldAndOriented()


def test_big_meshes_are_written_some_at_a_time(
    block: trimesh.Trimesh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = [save(block, tmp_path / f"whole{suffix}").read_bytes() for suffix in (".stl", ".obj")]
    for module in ("rows", "stl"):
        monkeypatch.setattr(f"infill.formats.{module}.AT_ONCE", 17)
    assert [save(block, tmp_path / f"parts{suffix}").read_bytes() for suffix in (".stl", ".obj")] == whole


@every_format
def test_fine_cells_far_away_do_not_merge(suffix: str, rng: np.random.Generator, tmp_path: Path) -> None:
    """At 120 mm a 32-bit coordinate steps by 8e-6 mm; triangles at 0.05 mm cells stay apart."""
    mesh = isosurface(np.round(smooth_noise(rng, (20, 20, 6)), 3), spacing=0.05, origin=(120, -120, 0))
    assert read_mesh(save(mesh, tmp_path / f"far{suffix}")).closed


# --- reading what others wrote ---------------------------------------------------------------------------


def package(path: Path, model: str, more: dict[str, str] | None = None) -> Path:
    with zipfile.ZipFile(path, "w") as file:
        for name, text in {"3D/3dmodel.model": model, **(more or {})}.items():
            file.writestr(name, text)
    return path


CUBE = trimesh.creation.box()
CUBE_XML = (
    "<mesh><vertices>"
    + "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in CUBE.vertices)
    + "</vertices><triangles>"
    + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in CUBE.faces)
    + "</triangles></mesh>"
)


def model(resources: str, build: str, unit: str = 'unit="millimeter"') -> str:
    core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    production = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
    return f'<model {unit} xmlns="{core}" xmlns:p="{production}"><resources>{resources}</resources><build>{build}</build></model>'


def test_3mf_components_transforms_and_units(tmp_path: Path) -> None:
    """A cube, doubled in x and moved, beside one turned by a quarter, in inches."""
    resources = (
        f'<object id="1">{CUBE_XML}</object><object id="2"><components>'
        '<component objectid="1" transform="2 0 0 0 1 0 0 0 1 5 0 0"/>'
        '<component objectid="1" transform="0 1 0 -1 0 0 0 0 1 0 0 0"/></components></object>'
    )
    path = package(
        tmp_path / "a.3mf", model(resources, '<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 10"/>', 'unit="inch"')
    )
    mesh = read_mesh(path)
    assert mesh.volume == pytest.approx(3 * 25.4**3)
    assert mesh.bounds / 25.4 == pytest.approx(np.array([[-0.5, -0.5, 9.5], [6.0, 0.5, 10.5]]))


def test_3mf_parts_in_other_files(tmp_path: Path) -> None:
    other = model(f'<object id="7">{CUBE_XML}</object>', "")
    main = model(
        '<object id="1"><components><component p:path="/3D/part.model" objectid="7"/></components></object>',
        '<item objectid="1"/>',
    )
    assert read_mesh(package(tmp_path / "a.3mf", main, {"3D/part.model": other})).volume == pytest.approx(1)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("<model", "is not a 3MF file"),
        ("<model></model>", "nothing to build"),
        (model("", '<item objectid="4"/>'), "refers to an object 4"),
        (model('<object id="1"></object>', '<item objectid="1"/>'), "no triangles"),
        (
            model(f'<object id="1">{CUBE_XML.replace("0.5", "half", 1)}</object>', '<item objectid="1"/>'),
            "number that is not one",
        ),
        (
            model(
                f'<object id="1">{CUBE_XML.replace(chr(34) + "3" + chr(34), chr(34) + "99" + chr(34), 1)}</object>',
                '<item objectid="1"/>',
            ),
            "do not exist",
        ),
        (
            model('<object id="1"><components><component objectid="1"/></components></object>', '<item objectid="1"/>'),
            "refers to",
        ),
    ],
)
def test_a_broken_3mf_is_one_clear_line(text: str, says: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=says):
        read_mesh(package(tmp_path / "broken.3mf", text))


def test_3mf_items_elsewhere_unprinted_and_mirrored(tmp_path: Path) -> None:
    """Parts are found by the relations; what is not to be printed is left out; a mirrored part faces out."""
    part = model(f'<object id="7">{CUBE_XML}</object>', "")
    main = model(
        f'<object id="1">{CUBE_XML}</object>',
        '<item p:path="/3D/a.model" objectid="7" transform="-2 0 0 0 1 0 0 0 1 9 0 0"/><item objectid="1" printable="0"/>',
    )
    kind = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    relations = f'<Relationships xmlns="x"><Relationship Target="/3D/main.model" Id="a" Type="{kind}"/></Relationships>'
    path = tmp_path / "a.3mf"
    with zipfile.ZipFile(path, "w") as file:
        for name, text in {"3D/a.model": part, "3D/main.model": main, "_rels/.rels": relations}.items():
            file.writestr(name, text)
    mesh = read_mesh(path)
    assert mesh.volume == pytest.approx(2)
    assert mesh.bounds[:, 0] == pytest.approx([8, 10])


def test_stl_with_bytes_at_the_end_or_a_mark_at_the_start(block: trimesh.Trimesh, tmp_path: Path) -> None:
    path = save(block, tmp_path / "a.stl")
    path.write_bytes(path.read_bytes() + b"\r\n")
    assert read_mesh(path).closed
    text = save(block, tmp_path / "b.stl", ascii=True)
    text.write_bytes(b"\xef\xbb\xbf" + text.read_bytes().replace(b"solid phasefill", b"solid a vertex of mine", 1))
    assert read_mesh(text).closed


def test_text_formats_may_hold_any_encoding(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    rows = [f"v {x} {y} {z}" for x, y, z in CUBE.vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in CUBE.faces]
    path.write_bytes(b"# f\xfcr\n" + "\n".join(rows).encode())
    assert read_mesh(path).volume == pytest.approx(1)


@pytest.mark.parametrize("suffix", list(READERS))
@pytest.mark.parametrize("content", [b"", b"solid", b"\0" * 200, b"nonsense " * 40, struct.pack("<80sI", b"", 5)])
def test_rubbish_is_one_clear_line(suffix: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / f"rubbish{suffix}"
    path.write_bytes(content)
    with pytest.raises(FormatError) as caught:
        read_mesh(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("suffix", sorted(set(WRITERS) - {".obj"}))  # text without a count: a shorter OBJ is an OBJ
def test_a_truncated_file_is_one_clear_line(suffix: str, block: trimesh.Trimesh, tmp_path: Path) -> None:
    path = save(block, tmp_path / f"cut{suffix}")
    path.write_bytes(path.read_bytes()[:-1000])
    with pytest.raises(FormatError, match=re.escape(str(path))) as caught:
        read_mesh(path)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="there is no file"):
        read_mesh(tmp_path / "gone.stl")


def test_an_unreadable_file_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.stl"
    path.write_bytes(b"solid")
    monkeypatch.setitem(READERS, ".stl", lambda path: open(path / "below"))  # noqa: SIM115 - raises
    with pytest.raises(FormatError, match="cannot read"):
        read_mesh(path)


def test_numbers_that_are_none_are_told(tmp_path: Path) -> None:
    path = tmp_path / "x.stl"
    text = "solid x\n" + "facet normal 0 0 1\nouter loop\n{}endloop\nendfacet\n".format("vertex 0 0 nan\n" * 3)
    path.write_text(text + "endsolid x\n")
    with pytest.raises(FormatError, match="not numbers"):
        read_mesh(path)


def test_corners_that_do_not_exist_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.off"
    path.write_text("OFF")
    monkeypatch.setitem(READERS, ".off", lambda path: (np.zeros((2, 3)), np.array([[0, 1, 2]])))
    with pytest.raises(FormatError, match="do not exist"):
        read_mesh(path)


def test_text_stl_of_old_macs(data: Path) -> None:
    for name in ("20mmbox_CR_line_ends.stl", "20mmbox_nonstandard.stl"):
        assert read_mesh(data / "nasty" / name).volume == pytest.approx(8000)


def test_merging_minds_minus_zero(tmp_path: Path) -> None:
    soup = CUBE.triangles.reshape(-1, 3).copy() - 0.5
    soup[soup == 0] = np.where(np.arange((soup == 0).sum()) % 2, 0.0, -0.0)
    path = save(Surface(vertices=soup, faces=np.arange(36).reshape(-1, 3)), tmp_path / "x.stl")
    mesh = read_mesh(path)
    assert len(mesh.vertices) == 8
    assert mesh.closed
    assert math.isclose(mesh.volume, 1)


def test_stl_by_the_kernel_is_stl_by_numpy_to_the_last_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also with triangles without an area."""
    from infill.kernels import facets  # numba is loaded by now

    rng = np.random.default_rng(0)
    vertices, faces = rng.normal(size=(500, 3)) * [1, 1e-3, 1e4], rng.integers(0, 500, (3000, 3))
    faces[::7, 1] = faces[::7, 0]
    called, kernel = [], facets.write_facets
    monkeypatch.setattr(facets, "write_facets", lambda *each: called.append(len(each)) or kernel(*each))
    written = []
    for most in (100, 10_000):  # the kernel is for surfaces of more than one block
        monkeypatch.setattr(stl, "AT_ONCE", most)
        file = io.BytesIO()
        stl.write_stl(Surface(vertices=vertices, faces=faces), file)
        written.append(file.getvalue())
    assert called
    assert written[0] == written[1]
    assert len(written[0]) == 84 + 50 * len(faces)
