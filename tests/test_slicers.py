"""The default designs in real slicers: nothing to repair, nothing to warn of, every layer, and about as much plastic.

A slicer ends with exit code 0 for a mesh full of holes too, so what it says and writes is read.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slicers
import trimesh

from infill import Result, make, smooth_volume

pytestmark = pytest.mark.usefixtures("coarse_grids")

DESIGNS = ["honeycomb", "zigzag", "concentric-heart"]
READ = 1e-3  # PrusaSlicer adds up the tetrahedra of all triangles in float32
# Walls of one line are printed only roughly: PrusaSlicer draws one line of 0.45 mm along walls of 0.51 to 0.58 mm,
# CuraEngine two that overlap. Measured, extruded volume over ours, less 1:
#                      honeycomb    zigzag    concentric-heart
#   PrusaSlicer 2.5     -12.6 %     -8.2 %         +1.2 %
#   CuraEngine 4.13     +10.3 %     +6.5 %        +11.4 %
EXTRUDED = 0.15

needs_prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa())
needs_cura = pytest.mark.skipif(bool(slicers.missing_cura()), reason=slicers.missing_cura())
both_slicers = pytest.mark.parametrize(
    "slice_mesh",
    [
        pytest.param(slicers.prusa_slice, id="prusa", marks=needs_prusa),
        pytest.param(slicers.cura_slice, id="cura", marks=needs_cura),
    ],
)
Slicer = Callable[[Path], dict[str, Any]]


@pytest.fixture(scope="session", params=DESIGNS)
def design(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Result, Path]:
    """A default design and the STL file of it."""
    result = make(request.param)
    return result, result.save(tmp_path_factory.mktemp("slicers") / f"{request.param}.stl")


@pytest.mark.longest
@needs_prusa
def test_a_slicer_reads_the_mesh_without_repair(design: tuple[Result, Path]) -> None:
    result, path = design
    info = slicers.prusa_info(path)
    assert info["manifold"]
    assert info["repairs"] == {}
    assert info["parts"] == result.report["components"]
    assert info["volume"] == pytest.approx(result.report["volume"], rel=READ)


@pytest.mark.longest
@both_slicers
def test_a_slicer_prints_every_layer_without_a_warning(
    design: tuple[Result, Path], slice_mesh: Slicer, request: pytest.FixtureRequest
) -> None:
    result, path = design
    sliced = slice_mesh(path)
    assert sliced["messages"] == []
    assert sliced["layers"] == round(result.report["request"]["height"] / slicers.LAYER_HEIGHT) == 20
    change = sliced["extruded_mm3"] / result.report["volume"] - 1
    figure = f"{sliced['extruded_mm3']:.0f} mm³ extruded, {change:+.1%} of the mesh's volume"
    print(figure)  # pytest -rP shows it
    request.node.user_properties.append(("figure", figure))  # and --junitxml keeps it, at which record_property warns
    assert abs(change) < EXTRUDED, figure


def saved(mesh: trimesh.Trimesh, folder: Path) -> Path:
    path = folder / "mesh.stl"
    mesh.export(path)
    return path


def without_a_triangle(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, np.delete(mesh.faces, len(mesh.faces) // 2, axis=0), process=False)


@pytest.mark.longest
@needs_prusa
def test_a_missing_triangle_is_read_as_open_edges(tmp_path: Path) -> None:
    mesh = make("honeycomb", size=20, height=3).mesh
    info = slicers.prusa_info(saved(without_a_triangle(mesh), tmp_path))
    assert not info["manifold"]
    assert info["repairs"] == {"open_edges": 3}


@pytest.mark.slow
@needs_prusa
def test_a_triangle_turned_over_is_read_as_repaired(tmp_path: Path) -> None:
    mesh = make("honeycomb", size=20, height=3).mesh
    faces = mesh.faces.copy()
    faces[7] = faces[7, ::-1]
    info = slicers.prusa_info(saved(trimesh.Trimesh(mesh.vertices, faces, process=False), tmp_path))
    assert info["repairs"] == {"facets_reversed": 1}


@pytest.mark.slow
@needs_cura
def test_a_missing_triangle_is_a_message(tmp_path: Path) -> None:
    mesh = make("honeycomb", size=20, height=3).mesh
    (message,) = slicers.cura_slice(saved(without_a_triangle(mesh), tmp_path))["messages"]
    assert "disconnected faces" in message


@pytest.mark.slow
@both_slicers
def test_a_gap_between_layers_is_a_message(slice_mesh: Slicer, tmp_path: Path) -> None:
    lower, upper = (trimesh.creation.box(bounds=[[0, 0, z], [20, 20, z + 2]]) for z in (0, 4))
    sliced = slice_mesh(saved(lower + upper, tmp_path))
    assert "empty" in " ".join(sliced["messages"]).lower()
    if slice_mesh is slicers.prusa_slice:
        assert sliced["layers"] < round(6 / slicers.LAYER_HEIGHT)


@pytest.mark.longest
@needs_prusa
@pytest.mark.parametrize("refine", [False, True])
def test_a_slicer_reads_a_smoothed_scan_without_repair(refine: bool, tmp_path: Path) -> None:
    """A gyroid ball, specks and all: as many parts, closed, the same volume."""
    x = (np.indices((60, 60, 60)) - 29.5) * 0.2
    sheet = sum(np.sin(x[i]) * np.cos(x[(i + 1) % 3]) for i in range(3))
    result = smooth_volume(
        (np.abs(sheet) < 0.5) & ((x**2).sum(axis=0) < 30), spacing=0.5, refine=refine, tolerance=None
    )
    path = result.save(tmp_path / "mesh.stl")
    info = slicers.prusa_info(path)
    assert info["manifold"]
    assert info["repairs"] == {}
    assert info["parts"] == result.report["topology"]["result"]["components"]
    assert info["volume"] == pytest.approx(result.report["volume"], rel=READ)
