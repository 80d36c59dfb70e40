"""Flat facets that smoothing leaves: they are told where they are there, and the options that are named round them."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from test_command_line import run
from trimesh import creation

from infill import smooth_mesh, smooth_volume
from infill.inspection.facets import LEAST_SHARE, find_flat_facets
from infill.meshes.merging import surface_of
from infill.surface import Surface

COARSE = {
    "ball": creation.icosphere(1, 20),
    "torus": creation.torus(15, 6, 10, 8),
    "cylinder": creation.cylinder(10, 30, sections=12),
}


def sphere(subdivisions: int) -> Surface:
    return surface_of(creation.icosphere(subdivisions, 10))


def test_a_mesh_has_its_own_facets_and_a_finer_ball_does_not() -> None:
    coarse = sphere(2)
    found = find_flat_facets(coarse, coarse, cell=0.1)
    assert found is not None
    assert found.share == 1
    sides = coarse.to_trimesh().edges_unique_length
    assert sides.min() / 2 < found.width < sides.max() * np.sqrt(3) / 2  # the height of a triangle
    assert found.radius < found.width
    assert found.voxel >= 0.1
    assert find_flat_facets(coarse, sphere(5), cell=0.1) is None


def test_neither_the_side_nor_the_order_of_faces_matters() -> None:
    coarse, rng = sphere(2), np.random.default_rng(1)
    other = replace(coarse, faces=rng.permutation(coarse.faces)[:, ::-1])
    assert find_flat_facets(other, coarse, cell=0.1) == find_flat_facets(coarse, coarse, cell=0.1)


@pytest.mark.parametrize(
    "mesh",
    [creation.box((10, 20, 30)), creation.cylinder(10, 30, sections=6), creation.icosphere(0, 10)],
    ids=["box", "hexagon", "icosahedron"],
)
def test_edges_of_more_than_45_degrees_are_meant(mesh: trimesh.Trimesh) -> None:
    """A box and a prism with edges of 60 degrees; the facets of an icosahedron meet at 42."""
    part = surface_of(mesh)
    found = find_flat_facets(part, part, cell=0.1)
    assert (found is None) == (mesh.face_adjacency_angles.max() > np.radians(45))


def test_facets_narrower_than_two_voxels_do_not_count() -> None:
    fine = sphere(5)
    assert find_flat_facets(fine, fine, cell=0.5) is None


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("name", COARSE)
def test_the_options_that_the_summary_names_round_the_facets(name: str, tmp_path: Path) -> None:
    """As they are typed: nothing is lost, the volume is kept, and the summary names no facets any more."""
    path, out = tmp_path / "coarse.stl", tmp_path / "out.stl"
    COARSE[name].export(path)
    first = run("smooth", path, "--resolution", 90 if name == "torus" else 60, "-o", out)
    assert first.exit_code == 0
    row = re.search(r"^  facets +(\d+)% of the surface .* mm wide; (--.*) rounds them", first.stderr, re.M)
    assert row, first.stderr
    assert int(row[1]) >= 100 * LEAST_SHARE
    assert "--smooth-radius" in row[2]
    second = run("smooth", path, *row[2].split(), "-o", out, "--force")
    assert second.exit_code == 0, second.stderr
    assert "facets" not in second.stderr
    assert "LOST" not in second.stderr
    assert trimesh.load(out).volume == pytest.approx(COARSE[name].volume, rel=1e-3)


@pytest.mark.usefixtures("compiled")
def test_the_report_has_none_where_there_are_none() -> None:
    assert smooth_volume(np.pad(np.ones((8, 8, 8), bool), 4), tolerance=None).report["facets"] is None
    assert smooth_mesh(creation.box((10, 20, 30)), resolution=40, tolerance=None).report["facets"] is None
    facets = smooth_mesh(creation.icosphere(1, 10), resolution=60, tolerance=None).report["facets"]
    assert facets is not None
    assert set(facets) == {"share", "width", "radius", "voxel", "fits"}


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize(("inner", "fits"), [(9.4, False), (4.0, True)])
def test_no_radius_is_named_that_the_thinnest_wall_does_not_bear(inner: float, fits: bool, tmp_path: Path) -> None:
    """Tubes of 16 sides, with walls of 0.6 and 6 mm; their facets take a radius of 1.4 mm."""
    path, out = tmp_path / "tube.stl", tmp_path / "out.stl"
    creation.annulus(inner, 10, 30, sections=16).export(path)
    told = run("smooth", path, "--resolution", 100, "-o", out)
    assert told.exit_code == 0
    row = re.search(r"^  facets +(.*)$", told.stderr, re.M)
    assert row, told.stderr
    assert ("--smooth-radius" in row[1]) == fits
    assert ("loses walls of" in row[1]) != fits
