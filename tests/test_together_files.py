"""Files of labels smoothed together: every wall once, with the labels on both sides, and named objects in colour."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from test_command_line import refused, run
from test_together import voronoi

from infill import FormatError, Segment, Smoothing, Volume, read_mesh, smooth_labels
from infill.formats.label_walls import LabelWalls
from infill.formats.ply import ORDERS, TYPES, write_ply_walls
from infill.formats.vtk_writing import write_vtp
from infill.result import Result
from infill.surface import Surface

QUICK = Smoothing(steps=5)


def three_labels(**options: Any) -> Result[Any, Any]:
    """Three labels, and a part of the volume without a label."""
    labels = voronoi((16, 18, 20), 4)
    labels[labels == 4] = 0
    return smooth_labels(labels, together=True, smoothing=QUICK, **options)


def read_ply_labels(path: Path) -> tuple[NDArray[np.generic], NDArray[np.generic], NDArray[np.int64]]:
    """Points, triangles and labels of a file, by its header alone."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    words = [line.split() for line in head.decode().splitlines()]
    counts = {line[1]: int(line[2]) for line in words if line[0] == "element"}
    order = next(ORDERS[line[1]] for line in words if line[0] == "format")
    points = np.frombuffer(body, order + "f4", 3 * counts["vertex"]).reshape(-1, 3)
    kinds = [TYPES[line[1]] for line in words if line[:1] == ["property"] and line[-1].startswith("label")]
    assert [line[-1] for line in words if line[-1].startswith("label")] == ["label_back", "label_front"]
    rows = np.frombuffer(
        body,
        [("n", "u1"), ("at", order + "i4", 3), *((f"{i}", order + kind) for i, kind in enumerate(kinds))],
        offset=points.nbytes,
    )
    assert len(rows) == counts["face"]
    assert (rows["n"] == 3).all()
    return points, rows["at"], np.stack([rows["0"], rows["1"]], axis=1).astype(np.int64)


def read_vtp_labels(path: Path) -> tuple[NDArray[np.generic], NDArray[np.generic], NDArray[np.int64]]:
    """Points, triangles and labels of a file, as VTK reads them."""
    vtk = pytest.importorskip("vtk", reason="VTK, of the extra bench, is not installed")
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    labels = vtk_to_numpy(data.GetCellData().GetArray("BoundaryLabels"))
    return vtk_to_numpy(data.GetPoints().GetData()), corners, labels


READERS = {".ply": read_ply_labels, ".vtp": read_vtp_labels}


@pytest.mark.parametrize("suffix", READERS)
def test_a_file_has_every_wall_once_and_the_surface_of_every_label(tmp_path: Path, suffix: str) -> None:
    """The triangles of a label, those behind it turned round, are its surface, to the last bit of the file."""
    result = three_labels(spacing=(0.4, 0.5, 0.6), origin=(3.0, -7.0, 20.0))
    points, triangles, labels = READERS[suffix](result.save(tmp_path / f"all{suffix}"))
    assert len(triangles) == result.report["triangles"]
    assert len(np.unique(points, axis=0)) == len(points)
    assert (labels[:, 0] != labels[:, 1]).all()
    assert (labels[:, 0] != 0).all()
    for row in result.report["labels"]:
        back, front = (triangles[labels[:, side] == row["number"]] for side in (0, 1))
        faces = np.concatenate([back, front[:, ::-1]])
        surface = Surface(vertices=points.astype(np.float64), faces=faces)
        assert surface.closed
        assert surface.volume == pytest.approx(row["volume"], rel=1e-5)
    outer = Surface(vertices=points.astype(np.float64), faces=triangles[labels[:, 1] == 0])
    assert outer.closed  # and faces outwards
    assert outer.volume == pytest.approx(sum(row["volume"] for row in result.report["labels"]), rel=1e-5)


def test_walls_face_the_same_way_in_a_mirrored_volume(tmp_path: Path) -> None:
    labels = voronoi((16, 18, 20), 3)
    mirrored = Volume(values=labels, spacing=1.0, direction=np.diag([-1.0, 1.0, 1.0]))
    result = smooth_labels(mirrored, together=True, smoothing=QUICK)
    points, triangles, labels_beside = read_ply_labels(result.save(tmp_path / "all.ply"))
    outer = Surface(vertices=points.astype(np.float64), faces=triangles[labels_beside[:, 1] == 0])
    assert outer.volume == pytest.approx(labels.size, rel=1e-5)


@pytest.mark.parametrize("suffix", READERS)
@pytest.mark.parametrize("values", [(-5, 7), (3, 2**32 - 1), (-1, 2**40)])
def test_labels_of_all_sizes_come_back(tmp_path: Path, suffix: str, values: tuple[int, int]) -> None:
    walls = LabelWalls(
        points=np.eye(3), triangles=np.array([[0, 1, 2], [0, 2, 1]]), labels=np.array([values, (values[1], 0)])
    )
    written = io.BytesIO()
    (write_ply_walls if suffix == ".ply" else write_vtp)(walls, written)
    (tmp_path / f"a{suffix}").write_bytes(written.getvalue())
    points, triangles, labels = READERS[suffix](tmp_path / f"a{suffix}")
    assert points.tolist() == np.eye(3).tolist()
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 1]]
    assert labels.tolist() == [list(values), [values[1], 0]]


def test_walls_are_read_as_a_mesh_too(tmp_path: Path) -> None:
    result = three_labels()
    mesh = read_mesh(result.save(tmp_path / "all.ply"))
    assert len(mesh.faces) == result.report["triangles"]


def test_other_results_have_no_walls(tmp_path: Path) -> None:
    result = smooth_labels(voronoi((9, 9, 9), 2), smoothing=QUICK)
    for name in ("all.vtp", "all.ply"):
        with pytest.raises(FormatError):
            result.save(tmp_path / name)


def test_objects_of_a_glb_have_the_names_and_colours_of_labels(tmp_path: Path) -> None:
    table = [Segment(value=2, name="liver", colour=(1.0, 0.5, 0.0))]
    data = three_labels(table=table).save(tmp_path / "all.glb").read_bytes()
    (size,) = struct.unpack("<I", data[12:16])
    description = json.loads(data[20 : 20 + size])
    assert [node["name"] for node in description["nodes"]] == ["label_1", "liver", "label_3"]
    assert len(description["materials"]) == 1


def test_the_command_writes_one_file_of_all_walls(tmp_path: Path) -> None:
    source, single = tmp_path / "labels.npy", tmp_path / "all.ply"
    np.save(source, voronoi((16, 18, 20), 3))
    result = run("smooth", source, "--together", "-o", single, "-o", tmp_path / "all.vtp", "-o", tmp_path / "all.3mf")
    assert result.exit_code == 0, result.stderr
    assert set(np.unique(read_ply_labels(single)[2])) == {0, 1, 2, 3}
    assert (tmp_path / "all.vtp").stat().st_size > 1000
    # Without --together, nothing changes: labels are listed, or the format is refused.
    refused(run("smooth", source, "-o", tmp_path / "b.ply"), "holds 3 labels")
    refused(run("smooth", source, "--each-label", "-o", tmp_path / "b.ply"), "use .3mf or .glb, or {label}")
    refused(run("smooth", source, "--each-label", "-o", tmp_path / "b.vtp"), "cannot tell a mesh format")
    refused(
        run("smooth", source, "--together", "-o", tmp_path / "b.off"), "use one of .stl, .3mf, .obj, .ply, .glb, .vtp"
    )
    refused(run("smooth", source, "--together", "--voxel", "2", "-o", single), "--voxel does not go with --together")


@pytest.mark.longest
def test_a_dry_run_names_labels_files_and_costs(tmp_path: Path) -> None:
    """Triangles are right to a factor of two; nothing is written."""
    source = tmp_path / "labels.npy"
    np.save(source, voronoi((40, 40, 40), 8))
    words = ["smooth", source, "--together", "--tolerance", "0"]
    words += ["-o", tmp_path / "{label}.stl", "-o", tmp_path / "mesh.vtu"]
    plan = json.loads(run(*words, "--dry-run", "--json").stdout)
    assert list(tmp_path.iterdir()) == [source]
    report = json.loads(run(*words, "--json").stdout)
    assert plan["files"] == report["files"]
    assert plan["request"] == report["request"]
    for expected, label in zip(plan["labels"], report["labels"], strict=True):
        assert (expected["name"], expected["data"]) == (label["name"], label["data"])
        assert 0.5 < expected["triangles_before"] / label["triangles"] < 2
    assert plan["memory"] > 40**3 * 4000  # with tetrahedra
    assert plan["seconds"]["total"] > 0
    refused(run(*words, "--level", "0.2", "--dry-run", "--force"), "level does not go with labels together")
    text = run(*words, "--dry-run", "--force").stdout
    assert "8 label_8" in text
    assert "for the largest" not in text
