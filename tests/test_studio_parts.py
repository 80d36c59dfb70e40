"""What the studio makes of a part: a density that changes is painted, and a project is computed once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from infill import Surface, check_project, fill, read_mesh
from infill.lattices.density_map import DensityMap
from infill.studio import fill_product
from infill.studio.desk import Desk

LOW, HIGH = 0.15, 0.4


def cube() -> Surface:
    box = trimesh.creation.box((16, 16, 16))
    return Surface(vertices=np.asarray(box.vertices), faces=np.asarray(box.faces))


def test_a_map_is_linear_between_its_nodes_and_stays_within_its_ends() -> None:
    shares = np.broadcast_to(np.linspace(0, 1, 5, dtype=np.float32), (3, 4, 5))
    density = DensityMap(shares=shares, origin=np.array([1.0, 2, 3]), step=2.0, lowest=0.1, highest=0.9)
    points = np.array([[1, 2, 3], [2, 5, 7], [3, 2, 8], [-9, -9, 99]])
    assert density.at(points) == pytest.approx([0.1, 0.5, 0.625, 0.9])


@pytest.mark.longest
@pytest.mark.parametrize("by", ["z", "skin"])
def test_walls_are_painted_with_the_density_that_was_asked_for(by: str) -> None:
    result = fill(cube(), density=(LOW, HIGH), by=by, wall=1, voxel=0.5)
    density = result.stages.density
    assert density is not None
    assert (density.lowest, density.highest) == pytest.approx((LOW, HIGH), abs=0.02)
    surfaces = fill_product.shown_surfaces(result)
    painted = fill_product.paint_density(surfaces, density)
    assert set(painted) == {"infill"}
    vertices = np.asarray(surfaces["infill"].vertices)
    depth = vertices[:, 2] if by == "z" else 8 - np.abs(vertices).max(axis=1)
    assert np.corrcoef(depth, painted["infill"])[0, 1] > 0.95
    assert fill(cube(), density=LOW, wall=1, voxel=0.5).stages.density is None


@pytest.mark.longest
def test_a_project_for_another_slicer_is_not_computed_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    trimesh.creation.box((16, 16, 16)).export("cube.stl")
    desk = Desk(folder=str(tmp_path), memory=2**32)
    (tmp_path / "downloads").mkdir()
    request = {"product": "fill", "file": "f1", "options": {"voxel": 0.5}, "quality": "exact"}
    message: dict[str, Any] = {
        "action": "download",
        "format": "project",
        "result": "r1",
        "request": request,
        "files": {"f1": {"name": "cube.stl", "kind": "part"}},
    }
    projects = {}
    for slicer in ("prusaslicer", "cura"):
        (frame,) = desk.answer(message | {"slicer": slicer}, lambda stage, share: None, [])
        projects[slicer] = next(tmp_path.glob("downloads/*/*.3mf"))
        assert check_project(projects[slicer], slicer).fine
        projects[slicer] = projects[slicer].rename(tmp_path / f"{slicer}.3mf")
        monkeypatch.setattr(fill_product, "make", lambda order: pytest.fail("it was computed again"))
        assert frame.payload
    assert read_mesh(projects["cura"]).volume == pytest.approx(read_mesh(projects["prusaslicer"]).volume, rel=1e-6)
