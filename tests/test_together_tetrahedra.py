"""Labels as tetrahedra: face to face, their outer faces the walls, none inside out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from test_command_line import refused, run
from test_together import NASTY, fields_of, voronoi

from infill import Smoothing, Volume, smooth_labels
from infill.partition.simplices import middle_points
from infill.partition.tetrahedral_mesh import TetrahedralMesh, cut_tetrahedra
from infill.partition.tetrahedral_quality import LEAST, improve_tetrahedra, mean_ratios, measure_quality
from infill.partition.volumes import keep_volumes
from infill.partition.walls import WallGraph, Walls, place_walls, trace_walls

QUICK = Smoothing(steps=5)


def volumes_of(points: NDArray[np.float64], tetrahedra: NDArray[np.int64]) -> NDArray[np.float64]:
    a, b, c, d = points[tetrahedra].swapaxes(0, 1)
    return np.asarray(np.linalg.det(np.stack([b - a, c - a, d - a], axis=1)) / 6)


def cut_of(labels: NDArray[np.int64], steps: int = 5) -> tuple[WallGraph, Walls, TetrahedralMesh]:
    fields = fields_of(labels, steps)
    graph = trace_walls(fields.winners(np.zeros(fields.count)))
    walls = place_walls(graph, fields, np.zeros(fields.count))
    return graph, walls, cut_tetrahedra(graph, walls.points)


def outer_faces(tetrahedra: NDArray[np.int64], labels: NDArray[np.integer]) -> set[Any]:
    """Faces that part labels, with the labels on both sides, -1 for none; no face has more than two tetrahedra."""
    sides: dict[Any, list[int]] = {}
    for corners, label in zip(tetrahedra.tolist(), labels.tolist(), strict=True):
        for left_out in corners:
            sides.setdefault(frozenset(set(corners) - {left_out}), []).append(label)
    assert max(map(len, sides.values()), default=1) <= 2
    return {
        (face, frozenset(beside if len(beside) > 1 else [*beside, -1]))
        for face, beside in sides.items()
        if len(set(beside)) > 1 or len(beside) == 1
    }


def walls_as_set(walls: Walls) -> set[Any]:
    sides = np.where(walls.sides <= 0, -1, walls.sides)  # 0 has no tetrahedra
    return {
        (frozenset(triangle), frozenset(pair))
        for triangle, pair in zip(walls.triangles.tolist(), sides.tolist(), strict=True)
    }


def assert_fills(walls: Walls, mesh: TetrahedralMesh) -> None:
    volumes = volumes_of(mesh.points, mesh.tetrahedra)
    assert (volumes > 0).all()
    np.testing.assert_allclose(np.bincount(mesh.labels, volumes, len(walls.volumes))[1:], walls.volumes[1:], atol=1e-6)
    assert outer_faces(mesh.tetrahedra, mesh.labels) == walls_as_set(walls)
    assert np.array_equal(np.unique(mesh.tetrahedra), np.arange(len(mesh.points)))


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.integers(1, 9)] * 3), st.integers(1, 12), st.integers(0, 10**6), st.booleans())
def test_tetrahedra_fill_every_label_and_end_at_its_walls(
    shape: tuple[int, int, int], count: int, seed: int, has_rest: bool
) -> None:
    labels = voronoi(shape, count, seed)
    if has_rest:
        labels[labels == 1] = 0
    _, walls, mesh = cut_of(labels)
    assert_fills(walls, mesh)


@pytest.mark.longest
@pytest.mark.parametrize("name", NASTY)
def test_nasty_labels_are_filled_too(name: str) -> None:
    graph, walls, mesh = cut_of(np.asarray(NASTY[name]()).astype(np.int64), steps=0)
    assert_fills(walls, mesh)
    middles = np.concatenate([middle_points(graph), mesh.points[mesh.wall_points :]])
    assert volumes_of(middles, mesh.tetrahedra).min() > 1e-3  # where points go if nothing else helps


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (1.0, 1.0, 3.0)])
def test_better_points_leave_walls_and_turn_nothing_inside_out(scale: tuple[float, float, float]) -> None:
    """Also where lines on which many labels meet were made smooth: there, a few points of walls move."""
    labels = voronoi((22, 22, 22), 25)
    fields = fields_of(labels, 10)
    partition = keep_volumes(fields, np.bincount(labels.ravel()) * float(np.prod(scale)), scale=scale)
    mesh = cut_tetrahedra(partition.graph, partition.walls.points)
    better, moved = improve_tetrahedra(mesh, partition.graph, scale)
    before, after = (measure_quality(m.points * scale, m.tetrahedra) for m in (mesh, better))
    assert before.inverted > 0  # else there is nothing to show
    assert after.inverted == 0
    assert mean_ratios(better.points * scale, mesh.tetrahedra).min() >= LEAST
    assert after.slivers < 0.5 * before.slivers
    assert after.smallest_angle > before.smallest_angle
    changed = (better.points[: mesh.wall_points] != mesh.points[: mesh.wall_points]).any(axis=1)
    assert changed.sum() <= moved < 0.03 * mesh.wall_points
    assert np.array_equal(mesh.tetrahedra, better.tetrahedra)
    assert volumes_of(better.points, better.tetrahedra).sum() == pytest.approx(labels.size)


@pytest.mark.longest
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_heat_flows_through_layers_as_their_resistances_say(axis: int, tmp_path: Path) -> None:
    """Another library solves on the file: linear elements are exact in layers, if they are conforming and in place."""
    skfem = pytest.importorskip("skfem", reason="scikit-fem is not installed")
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    labels = np.full((8, 8, 8), 3)
    labels[(slice(None),) * axis + (slice(0, 3),)] = 1
    spacing = (0.5, 1.0, 1.5)
    smooth_labels(labels, spacing=spacing, together=True).save(tmp_path / "layers.vtu")
    file = meshio.read(tmp_path / "layers.vtu")
    tetrahedra, label = file.cells_dict["tetra"], file.cell_data["Label"][0]
    basis = skfem.Basis(skfem.MeshTet(file.points.T.copy(), tetrahedra.T.copy()), skfem.ElementTetP1())
    conductivity = basis.with_element(skfem.ElementTetP0()).interpolate(np.where(label == 1, 2.0, 7.0))
    form = skfem.BilinearForm(lambda u, v, w: w.k * (u.grad * v.grad).sum(axis=0))
    stiffness = form.assemble(basis, k=conductivity)
    depth = file.points[:, axis]
    low, high = np.flatnonzero(depth == depth.min()), np.flatnonzero(depth == depth.max())
    assert min(len(low), len(high)) >= 81
    start = np.where(depth == depth.max(), 1.0, 0.0)
    heat = skfem.solve(*skfem.condense(stiffness, x=start, D=np.concatenate([low, high])))
    wall = depth[np.intersect1d(tetrahedra[label == 1], tetrahedra[label == 3])]
    assert wall == pytest.approx(3 * spacing[axis], rel=1e-4)  # to which volumes are kept
    assert np.ptp(wall) < 1e-9
    sides = 8 * np.array(spacing)
    resistance = (wall[0] / 2.0 + (sides[axis] - wall[0]) / 7.0) * sides[axis] / sides.prod()
    assert heat @ stiffness @ heat == pytest.approx(1 / resistance, rel=1e-9)


def test_qualities_are_those_of_vtk() -> None:
    vtk = pytest.importorskip("vtk", reason="VTK, of the extra bench, is not installed")
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    _, _, mesh = cut_of(voronoi((8, 8, 8), 4))
    grid, points, cells = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(mesh.points))
    count = len(mesh.tetrahedra)
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, 4 * count + 1, 4)), numpy_to_vtkIdTypeArray(mesh.tetrahedra.ravel())
    )
    grid.SetPoints(points)
    grid.SetCells(vtk.VTK_TETRA, cells)
    judge = vtk.vtkMeshQuality()
    judge.SetInputData(grid)

    def rated(measure: str) -> NDArray[np.float64]:
        getattr(judge, f"SetTetQualityMeasureTo{measure}")()
        judge.Update()
        return np.array(vtk_to_numpy(judge.GetOutput().GetCellData().GetArray("Quality")))

    quality = measure_quality(mesh.points, mesh.tetrahedra)
    assert quality.smallest_angle == pytest.approx(rated("MinAngle").min(), rel=1e-6)
    ratios = 1 / rated("RadiusRatio")
    assert quality.mean_ratio == pytest.approx(ratios.mean(), rel=1e-6)
    assert quality.slivers == pytest.approx((ratios < 0.1).mean())


@pytest.mark.parametrize("turned", [1.0, -1.0])
def test_a_file_has_the_tetrahedra_and_their_labels(tmp_path: Path, turned: float) -> None:
    """Their volumes are those of the labels, in millimetres, and above 0 in a mirrored volume too."""
    vtk = pytest.importorskip("vtk", reason="VTK, of the extra bench, is not installed")
    from vtk.util.numpy_support import vtk_to_numpy

    labels = 3 * voronoi((12, 13, 14), 3) - 6
    volume = Volume(values=labels, spacing=(0.5, 0.6, 0.7), direction=np.diag([turned, 1.0, 1.0]))
    result = smooth_labels(volume, together=True, smoothing=QUICK)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(result.save(tmp_path / "mesh.vtu")))
    reader.Update()
    data = reader.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())
    corners = vtk_to_numpy(data.GetCells().GetConnectivityArray()).reshape(-1, 4)
    assert {data.GetCellType(at) for at in range(data.GetNumberOfCells())} == {vtk.VTK_TETRA}
    given_labels = vtk_to_numpy(data.GetCellData().GetArray("Label"))
    volumes = volumes_of(points, corners)
    assert (volumes > 0).all()
    assert [row["number"] for row in result.report["labels"]] == [-3, 3]
    for row in result.report["labels"]:
        assert volumes[given_labels == row["number"]].sum() == pytest.approx(row["volume"], rel=2e-3)


def test_the_command_reports_shapes_and_refuses_what_is_too_large(tmp_path: Path) -> None:
    source = tmp_path / "labels.npy"
    np.save(source, voronoi((12, 13, 14), 3))
    result = run("smooth", source, "--together", "-o", tmp_path / "mesh.vtu", "--json")
    assert " degrees, " in result.stderr
    report = json.loads(result.stdout)
    facts = report["tetrahedra"]
    assert facts["tetrahedra"] > 6 * 12 * 13 * 14
    assert 0 < facts["smallest_angle"] < 60
    assert 0 < facts["mean_radius_ratio"] < 1
    plain = run("smooth", source, "--together", "-o", tmp_path / "all.ply", "--json")
    assert json.loads(plain.stdout)["tetrahedra"] is None
    refused(run("smooth", source, "-o", tmp_path / "b.vtu", "--each-label"), "cannot tell a mesh format")
    np.save(source, voronoi((40, 40, 40), 2))
    refused(
        run("smooth", source, "--together", "--max-memory", "120M", "-o", tmp_path / "b.vtu"),
        "give --roi for a part of the volume",
    )
