"""`fill`: the skin is the part's own, the density and the walls are those asked for, and what is not is told."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import slicers
import trimesh
from filled_parts import assert_filled
from made_shapes import ball, box, less, rod, together, turned, union
from PIL import Image
from shapes import IN_SPACE, one_of_each_kind
from test_command_line import one_line_error
from test_command_line import run as command

from infill import GeometryError, MemoryLimitError, ParameterError, Surface, UsageError, fill, read_mesh
from infill.cli.filled_words import summary
from infill.interior.opening import Opening
from infill.lattices import quality_checks as telling
from infill.lattices import sizing
from infill.lattices.forecast import plan_fill
from infill.lattices.grading import UNIFORM_WIDTH
from infill.lattices.hollowing import make_void_meshes
from infill.lattices.quality_checks import count_outside, measure_least_wall
from infill.lattices.request import check_request
from infill.lattices.root_finding import find_root
from infill.lattices.task import FillTask
from infill.meshes.distance import TriangleTree
from infill.meshes.flat_triangles import find_flat_triangles
from infill.meshes.solids import FINE, coincident_vertices, manifold_status, simplify_solid, to_manifold
from infill.meshes.winding import winding_numbers
from patterns import PATTERNS
from patterns.cross import Cross3D
from patterns.errors import PatternError
from patterns.honeycombs import LateralHoneycomb
from patterns.octree import Octree
from patterns.planes import LateralLattice
from patterns.polyhedra import Polyhedra
from patterns.unit_cells import Bars, Network, Planes, Surfaces

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

KINDS = one_of_each_kind([*IN_SPACE, *(name for name, kind in PATTERNS.items() if kind.prismatic)])
BAR = "octet"
FEW = {"voxel": 0.5, "wall": 1.5, "density": 0.3}  # quick
FEWEST = sizing.FEWEST  # before any test changes it


def surface(mesh: Any) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


@pytest.fixture(scope="module")
def part() -> trimesh.Trimesh:
    """A block with a hole and a ball on it, turned: no face lies along an axis."""
    mesh = union(less(box(26, 20, 14), rod(4, 30)), box(8, 8, 8, (9, 6, 8)))
    return turned(mesh, np.random.default_rng(4))


# --- every pattern ----------------------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.parametrize("pattern", KINDS)
def test_a_filled_part_is_the_part_without_voids_that_keep_their_distance(pattern: str, part: trimesh.Trimesh) -> None:
    """With the sizes that each has by default; test_fill_laws.py has all patterns in a smaller part."""
    result = fill(part, pattern, density=0.25, wall=1.2)
    assert_filled(result, part, wall=1.2, density=0.25)
    report = result.report
    assert len(result.surface.faces) == report["triangles"]
    assert report["voids"]["count"] == len(report["voids"]["closed"])  # all of which are closed, as there is no drain


def test_promises_that_are_broken_are_found() -> None:
    block = box(20, 20, 20)
    result = fill(block, "gyroid", **FEW)
    assert_filled(result, block, wall=1.5, density=0.3)
    for wall, density, other in ((1.5, 0.4, block), (2.5, 0.3, block), (1.5, 0.3, box(20, 20, 21))):
        with pytest.raises(AssertionError):
            assert_filled(result, other, wall=wall, density=density)


@pytest.mark.longest
@pytest.mark.parametrize("name", one_of_each_kind(IN_SPACE))
def test_a_shift_by_a_period_changes_nothing(name: str) -> None:
    given = {"cell": 6.0, "line_width": 0.7, "voxel": 0.4, "wall": 1.0}
    block = box(15, 15, 15)
    one = fill(block, name, **given).surface
    kind = IN_SPACE[name]
    # That of a curve is far too long, along x and y.
    period = np.array([0, 0, kind.height * 1.5] if isinstance(kind, Cross3D) else [1, -2, 1]) * 6.0
    period = period if isinstance(kind, Cross3D) else period * kind.cells
    if isinstance(kind, (Planes, Octree)):
        period = period @ np.array(kind.upright)
    if isinstance(kind, Polyhedra):
        period = period * kind.lattice()[0]
    other = fill(block, name, phase=tuple(period.tolist()), **given).surface
    assert other.volume == pytest.approx(one.volume, rel=1e-5)
    assert len(other.faces) == pytest.approx(len(one.faces), rel=0.01)


@pytest.mark.longest
def test_both_sides_of_a_gyroid_are_alike() -> None:
    """Turning it inside out at the middle of a block swaps them."""
    result = fill(box(20, 20, 20), "gyroid", cell=7, line_width=0.6, wall=1, voxel=0.4)
    voids = result.stages.voids
    pieces = sorted((each for each in voids.to_trimesh().split()), key=lambda each: -each.volume)
    assert len(pieces) % 2 == 0
    for one, other in zip(pieces[::2], pieces[1::2], strict=True):
        assert one.volume == pytest.approx(other.volume, rel=1e-3)


# --- what patterns are -------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name, each in IN_SPACE.items() if isinstance(each, Surfaces)])
def test_distances_to_a_surface_are_those_to_its_mesh(name: str) -> None:
    from skimage.measure import marching_cubes

    pattern = IN_SPACE[name]
    assert isinstance(pattern, Surfaces)
    line = np.linspace(-0.25, 1.25, 97)
    x, y, z = np.meshgrid(*[2 * np.pi * line] * 3, indexing="ij")
    corners, faces, _, _ = marching_cubes(pattern.value(x, y, z), 0.0, spacing=(line[1] - line[0],) * 3)
    mesh = Surface(vertices=corners.astype(np.float64) - 0.25, faces=faces)
    points = np.random.default_rng(3).random((3000, 3))
    exact, _ = TriangleTree.of(mesh).nearest(points)
    found = pattern.distance(points)
    off = np.abs(np.abs(found) - exact)
    near = exact < 0.06  # as thick as walls are, at least
    assert near.sum() > 500
    assert np.quantile(off[near], 0.99) < 1e-3
    assert off.max() < 5e-3
    assert (np.sign(found) == np.sign(pattern.value(*(2 * np.pi * points.T))))[exact > 1e-3].all()


@pytest.mark.longest
def test_cross_hatch_is_upright_at_half_of_all_heights_and_turned_half_a_period_up() -> None:
    pattern = IN_SPACE["cross-hatch"]
    assert isinstance(pattern, Surfaces)
    x, y, z = np.random.default_rng(4).uniform(0, 2 * np.pi, (3, 1000))
    assert pattern.value(x, y, z + np.pi) == pytest.approx(pattern.value(y, x, z), abs=1e-12)
    # Planes x = 1/4 and 3/4 of a cell, at the height 0; and within what 5 % of the weight moves them, up to an eighth.
    for height, off in ((0.0, 1e-12), (0.12, np.arcsin(0.05 / 0.95) / (2 * np.pi))):
        line = np.linspace(0, 2 * np.pi, 100)
        for place, sign in ((0.25 - off, 1), (0.25 + off, -1), (0.75 - off, -1), (0.75 + off, 1)):
            assert (
                sign * pattern.value(2 * np.pi * place + 0 * line, line, 2 * np.pi * height + 0 * line) > -1e-9
            ).all()
    # Both voids hang together: one is the other, half a cell along.
    assert pattern.value(x + np.pi, y + np.pi, z) == pytest.approx(-pattern.value(x, y, z), abs=1e-12)
    assert fill(box(16, 16, 16), "cross-hatch", cell=7, line_width=0.6, wall=1, voxel=0.4).report["voids"]["count"] == 2


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name, each in IN_SPACE.items() if isinstance(each, Bars)])
def test_the_bars_of_a_cell_repeat_and_none_that_is_near_is_missing(name: str) -> None:
    pattern = IN_SPACE[name]
    assert isinstance(pattern, Bars)
    edges, first, which = pattern.around_cell()
    shifts = np.stack(np.meshgrid(*[np.arange(-2, 3)] * 3), axis=-1).reshape(-1, 1, 1, 3)
    every = (pattern.axes()[None] + shifts).reshape(-1, 2, 3)
    points = np.random.default_rng(5).random((150, 3))
    # It does not matter in which period an edge is given.
    moved = pattern.axes() + np.random.default_rng(6).integers(-3, 4, (len(pattern.axes()), 1, 3))
    elsewhere = Bars(
        name="elsewhere", summary="", edges=tuple((tuple(a), tuple(b)) for a, b in moved.tolist()), cells=pattern.cells
    )
    assert to_edges(points, elsewhere.around_cell().edges) == pytest.approx(to_edges(points, every), abs=1e-12)
    exact = to_edges(points, every)
    assert to_edges(points, edges) == pytest.approx(exact, abs=1e-12)
    # Nor in the cube that a point lies in.
    bins = round((len(first) - 1) ** (1 / 3))
    cubes = np.ravel_multi_index((points * bins).astype(int).T, (bins,) * 3)
    for cube, point, away in zip(cubes, points, exact, strict=True):
        held = edges[which[first[cube] : first[cube + 1]]]
        assert to_edges(point[None], held)[0] == pytest.approx(away, abs=1e-12)


def to_edges(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """How far points lie from the nearest of some edges: the definition."""
    along, beside = edges[:, 1] - edges[:, 0], points[:, None] - edges[None, :, 0]
    share = np.clip((beside * along).sum(axis=2) / (along**2).sum(axis=1), 0, 1)
    return np.linalg.norm(beside - share[..., None] * along, axis=2).min(axis=1)


@pytest.mark.longest
@pytest.mark.parametrize("name", [name for name, each in IN_SPACE.items() if isinstance(each, Planes)])
def test_every_point_is_in_one_class_of_cells_and_no_two_of_a_class_touch(name: str) -> None:
    """Not even at a corner: cells grown by 0.02 still have pieces with one number in every family of planes each."""
    from scipy.ndimage import label

    pattern = IN_SPACE[name]
    assert isinstance(pattern, Planes)
    side = 60
    line = np.linspace(0, 1.422, side)  # a cell and its neighbours
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    points += (0.0041, 0.0013, 0.0029)  # none lies on a plane
    depths = np.array([pattern.depth(points, which) for which in range(pattern.classes)])
    assert ((depths > 0).sum(axis=0) == 1).all()
    assert depths.max(axis=0) == pytest.approx(pattern.distance(points), abs=1e-12)
    normals, offsets = pattern.families()
    slabs = np.floor(points @ normals.T + offsets)
    cells = np.unique(slabs, axis=0, return_inverse=True)[1]
    for deep in depths:
        pieces, count = label((deep > -0.02).reshape(side, side, side), np.ones((3, 3, 3)))
        within = deep > 0
        pairs = np.unique(np.stack([pieces.ravel()[within], cells[within]]), axis=1)
        assert count >= len(np.unique(cells[within])) == pairs.shape[1] > 0
        assert len(np.unique(pairs[0])) == pairs.shape[1]


POLYHEDRA = {name: each for name, each in IN_SPACE.items() if isinstance(each, Polyhedra)}
POLYHEDRA |= {"regular": LateralHoneycomb(overhang=60.0)}


@pytest.mark.slow
@pytest.mark.parametrize("name", POLYHEDRA)
def test_polyhedra_fill_space_and_no_two_of_a_class_touch(name: str) -> None:
    """Not even at a corner: polyhedra of a class that are grown by 0.02 still have no point in common."""
    pattern = POLYHEDRA[name]
    (normals, halves), (period, middles) = pattern.faces(), pattern.lattice()
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1)
    points = np.random.default_rng(2).random((8000, 3)) * period
    depths = np.array([pattern.depth(points, which) for which in range(pattern.classes)])
    assert ((depths > 0).sum(axis=0) == 1).all()
    assert (depths.max(axis=0) == pattern.distance(points)).all()
    # As many are in every class, and as large: within three times what chance does.
    assert np.mean(depths > 0, axis=1) == pytest.approx(1 / pattern.classes, abs=0.016)
    shifts = np.stack(np.meshgrid(*[np.arange(-1, 2)] * 3), axis=-1).reshape(-1, 1, 3) * period
    shifts = np.unique(
        np.where(np.abs(normals).max(axis=0) > 0, shifts, 0), axis=0
    )  # a tube shifted along it is itself
    for each, deep in zip(middles, depths, strict=True):
        copies = (each + shifts).reshape(-1, 3)
        away = np.array([(halves - np.abs((points - middle) @ normals.T)).min(axis=1) for middle in copies])
        assert ((away > -0.02).sum(axis=0) <= 1).all()
        assert ((away > 0).any(axis=0) == (deep > 0)).all()


@pytest.mark.slow
def test_the_cells_of_honeycomb_3d_are_those_of_voronoi_around_a_body_centred_lattice() -> None:
    points = np.random.default_rng(5).random((3000, 3))
    whole = np.stack(np.meshgrid(*[np.arange(-2.0, 4.0)] * 3), axis=-1).reshape(-1, 3)
    seeds = np.concatenate([whole, whole + 0.5])
    squared = ((points[:, None] - seeds) ** 2).sum(axis=2)
    nearest = squared.argmin(axis=1)
    apart = np.linalg.norm(seeds[None] - seeds[nearest][:, None], axis=2)
    apart[apart == 0] = np.inf
    exact = ((squared - squared.min(axis=1)[:, None]) / (2 * apart) + np.where(np.isinf(apart), np.inf, 0)).min(axis=1)
    assert IN_SPACE["honeycomb-3d"].distance(points) == pytest.approx(exact, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("overhang", [30.0, 45.0, 60.0, 75.0])
def test_the_walls_of_the_lateral_honeycomb_lean_as_asked(overhang: float) -> None:
    """By hexagons drawn anew, corner by corner, their six sides as long as one another."""
    lean = np.radians(overhang)
    side, rise = 0.5 / np.sin(lean), 0.5 / np.tan(lean)
    right = np.array([(0, -side / 2 - rise), (0.5, -side / 2), (0.5, side / 2), (0, side / 2 + rise)])
    hexagon = np.concatenate([right, right[2:0:-1] * (-1, 1), right[:1]])
    assert np.linalg.norm(np.diff(hexagon, axis=0), axis=1) == pytest.approx(side)
    rows = np.array([(m + n / 2, n * (side + rise)) for m in range(-6, 7) for n in range(-5, 6)])
    walls = shapely.MultiLineString(list(hexagon + rows[:, None]))
    points = np.random.default_rng(5).random((3000, 3)) * (9.0, 2.0, 2.0)
    exact = shapely.distance(shapely.points(points[:, 1:]), walls)
    assert LateralHoneycomb(overhang=overhang).distance(points) == pytest.approx(exact, abs=1e-12)


@pytest.mark.slow
def test_the_lateral_honeycomb_takes_its_overhang() -> None:
    given = {"density": 0.2, "cell": 5.0, "voxel": 0.4, "wall": 1.0}
    block = box(15, 15, 15)
    one, other = (fill(block, "lateral-honeycomb", overhang=overhang, **given) for overhang in (45.0, 60.0))
    assert one.report["request"]["parameters"] == {"overhang": 45.0}
    steep = [
        mesh.area_faces[mesh.face_normals[:, 2] > np.sin(np.radians(50))].sum() / mesh.area
        for mesh in (each.stages.voids.to_trimesh() for each in (one, other))
    ]
    assert steep[1] > steep[0] + 0.1
    with pytest.raises(PatternError, match="overhang of lateral-honeycomb is 80 degrees"):
        fill(block, "lateral-honeycomb", overhang=80.0)


@pytest.mark.long
@pytest.mark.parametrize(("first", "second"), [(-45.0, 45.0), (-20.0, 50.0), (0.0, 30.0)])
def test_the_walls_of_the_lateral_lattice_lean_as_asked(first: float, second: float) -> None:
    """As lines in the plane across them, a cell apart along y; and the part is as dense as asked for."""
    lines = []
    for lean in (first, second):
        up = np.array([-np.tan(np.radians(lean)), 1.0])
        lines += [[(at, 0.0) - 20 * up, (at, 0.0) + 20 * up] for at in range(-80, 81)]
    points = np.random.default_rng(5).random((3000, 3)) * (9.0, 4.0, 4.0)
    exact = shapely.distance(shapely.points(points[:, 1:]), shapely.MultiLineString(lines))
    assert LateralLattice(first=first, second=second).distance(points) == pytest.approx(exact, abs=1e-9)
    given = {"density": 0.2, "voxel": 0.4, "wall": 1.0, "first": first, "second": second}
    report = fill(box(16, 16, 16), "lateral-lattice", **given).report
    assert report["problems"] == []
    assert report["density"] == pytest.approx(0.2, abs=0.005)


def test_walls_of_the_lateral_lattice_that_hardly_cross_are_refused() -> None:
    with pytest.raises(PatternError, match="first and second of lateral-lattice are 10 and 20 degrees"):
        fill(box(15, 15, 15), "lateral-lattice", first=10.0, second=20.0)


@pytest.mark.longest
@pytest.mark.parametrize("name", [name for name, each in IN_SPACE.items() if isinstance(each, Network)])
def test_a_network_hangs_together_from_its_lowest_density_on(name: str) -> None:
    """Also across the border of a period: every piece of 2 x 2 x 2 of them touches another, or is a speck."""
    from scipy.ndimage import label

    pattern = IN_SPACE[name]
    assert isinstance(pattern, Network)
    line = np.arange(64) / 64
    core = pattern.distance(np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3))
    solid = np.tile((core <= np.quantile(core, pattern.thinnest)).reshape(64, 64, 64), (2, 2, 2))
    names, _ = label(solid, np.ones((3, 3, 3)))
    sizes = np.bincount(names.ravel())[1:]
    whole = names == 1 + sizes.argmax()
    assert sizes.max() > 0.95 * solid.sum()
    for axis in range(3):
        assert (whole.take(0, axis) & whole.take(-1, axis)).any()
    # The solid lies on one side of the surface, and deepest there first.
    away = pattern.side * pattern.surfaces.distance(np.argwhere(core.reshape(64, 64, 64) < 0.02) / 64)
    assert away.min() > 0.12
    assert away.max() - away.min() < 0.0201


@pytest.mark.longest
def test_the_edges_of_foam_are_as_far_from_three_seeds_as_from_no_other() -> None:
    from patterns.foam import voronoi_centroids, voronoi_edges

    period = 3
    seeds = np.random.default_rng(8).random((27, 3)) * period
    for _ in range(2):
        edges = voronoi_edges(seeds, period)
        shifts = np.stack(np.meshgrid(*[np.arange(-2, 3)] * 3), axis=-1).reshape(-1, 1, 3) * period
        images = (seeds[None] + shifts).reshape(-1, 3)
        for share in (0.0, 0.3, 0.5, 1.0):
            points = edges[:, 0] * (1 - share) + edges[:, 1] * share
            away = np.sort(np.linalg.norm(points[:, None] - images, axis=2), axis=1)[:, :4]
            equal = 4 if share in (0.0, 1.0) else 3
            assert np.ptp(away[:, :equal], axis=1).max() < 1e-9
        # Four edges end at every vertex, and a torus has as many vertices and faces as edges and cells.
        ends = np.round(edges.reshape(-1, 3) % period, 6) % period
        assert (np.unique(ends, axis=0, return_counts=True)[1] == 4).all()
        seeds = voronoi_centroids(seeds, period)


@pytest.mark.longest
def test_foam_of_another_seed_is_another() -> None:
    given = {"density": 0.2, "cell": 5.0, "voxel": 0.4, "wall": 1.0}
    block = box(15, 15, 15)
    one, same, other = (fill(block, "voronoi-foam", seed=seed, **given) for seed in (3, 3, 4))
    assert one.report["request"]["parameters"] == {"seed": 3}
    assert one.surface.volume == same.surface.volume != other.surface.volume
    with pytest.raises(ParameterError, match="no parameter 'sead'.*seed"):
        fill(block, "voronoi-foam", sead=3)
    with pytest.raises(PatternError, match="seed of voronoi-foam is -1.*whole number"):
        fill(block, "voronoi-foam", seed=-1)


def test_a_network_that_would_break_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"density is 0\.05, and the bars of schwarz-p-network break below 0\.08"):
        fill(box(15, 15, 15), "schwarz-p-network", density=0.05)
    with pytest.raises(ParameterError, match=r"density is 0\.03"):
        fill(box(15, 15, 15), "schwarz-p-network", density=(0.3, 0.03))


@pytest.mark.longest
def test_kernels_are_their_definitions() -> None:
    from infill.kernels.cells import from_bars, from_period, from_plane, from_planes, from_polyhedra, lower_to_segments

    rng = np.random.default_rng(6)
    depth = rng.uniform(-2, 6, (5, 6, 7)).astype(np.float32)
    cells = np.stack(np.meshgrid(*map(np.arange, depth.shape), indexing="ij"), axis=-1)
    turn = trimesh.transformations.random_rotation_matrix(rng.random(3))[:3, :3]
    start, period, half = rng.uniform(-9, 9, 3), 7.3, 0.8
    places = (start + cells @ turn.T) / period
    pattern = IN_SPACE["kelvin"]
    assert isinstance(pattern, Bars)
    binned, out = pattern.around_cell(), np.empty_like(depth)
    filled = from_bars(depth, -1.0, *binned, turn, start, period, half, *UNIFORM_WIDTH, out, 0, 1)
    exact = to_edges((places % 1).reshape(-1, 3), binned.edges).reshape(depth.shape) * period - half
    wanted = np.where(depth <= -1, depth, np.minimum(exact, depth))
    assert out == pytest.approx(wanted, abs=1e-5)
    assert filled == pytest.approx(np.clip(wanted + 0.5, 0, 1).sum(), abs=1e-3)
    # A table of a function that is linear between its nodes along each axis.
    table = rng.normal(size=(4, 4, 4)).astype(np.float32)
    from scipy.ndimage import map_coordinates

    for sign in (1.0, -1.0):
        from_period(depth, -1.0, table, turn, start, period, sign, half, *UNIFORM_WIDTH, out, 0, 1)
        there = map_coordinates(table, (places % 1 * 4).reshape(-1, 3).T, order=1, mode="grid-wrap")
        exact = sign * there.reshape(depth.shape) * period - half
        assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    crossing = IN_SPACE["quarter-cubic"]
    assert isinstance(crossing, Planes)
    normals, offsets = crossing.families()
    slopes, first = normals @ turn / period, normals @ start / period + offsets
    apart = period / np.linalg.norm(normals, axis=1)
    for which in range(crossing.classes):
        from_planes(depth, -1.0, slopes, first, apart, which, half, *UNIFORM_WIDTH, out, 0, 1)
        exact = crossing.depth(places.reshape(-1, 3), which).reshape(depth.shape) * period - half
        assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    solids = IN_SPACE["honeycomb-3d"]
    assert isinstance(solids, Polyhedra)
    (normals, halves), (sides, middles) = solids.faces(), solids.lattice()
    for which in range(solids.classes):
        placed = (normals, halves * period, sides * period, middles[which] * period)
        from_polyhedra(depth, -1.0, turn, start, *placed, half, *UNIFORM_WIDTH, out, 0, 1)
        exact = solids.depth(places.reshape(-1, 3), which).reshape(depth.shape) * period - half
        assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    plane = rng.uniform(-2, 2, (5, 6)).astype(np.float32)
    from_plane(depth, plane, 0.0, *UNIFORM_WIDTH, out, 0, 1)
    assert (out == np.minimum(plane[:, :, None], depth)).all()
    # Walls that are wider from place to place: nodes 2.5 cells apart, straight in between.
    ratio = rng.uniform(0.5, 2, (3, 4, 4)).astype(np.float32)
    times = map_coordinates(ratio.astype(float), cells.reshape(-1, 3).T / 2.5, order=1, mode="nearest")
    times = times.reshape(depth.shape)
    from_plane(depth, plane, half, ratio, 2.5, out, 0, 1)
    assert out == pytest.approx(np.minimum(plane[:, :, None] - half * times, depth), abs=1e-5)
    from_bars(depth, -1.0, *binned, turn, start, period, half, ratio, 2.5, out, 0, 1)
    exact = to_edges((places % 1).reshape(-1, 3), binned.edges).reshape(depth.shape) * period - half * times
    assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    from_polyhedra(depth, -1.0, turn, start, *placed, half, ratio, 2.5, out, 0, 1)
    exact = solids.depth(places.reshape(-1, 3), solids.classes - 1).reshape(depth.shape) * period - half * times
    assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    from_period(depth, -1.0, table, turn, start, period, 1.0, half, ratio, 2.5, out, 0, 1)
    there = map_coordinates(table, (places % 1 * 4).reshape(-1, 3).T, order=1, mode="grid-wrap").reshape(depth.shape)
    exact = there * period - half * times
    assert out == pytest.approx(np.where(depth <= -1, depth, np.minimum(exact, depth)), abs=1e-4)
    segments = rng.uniform(0, 9, (6, 2, 2))
    squared = np.full((10, 11), np.float32(9.0))
    lower_to_segments(segments, 3.0, squared)
    grid = np.stack(np.meshgrid(np.arange(10), np.arange(11), indexing="ij"), axis=-1).reshape(-1, 2)
    flat = to_edges(np.pad(grid, ((0, 0), (0, 1))), np.pad(segments, ((0, 0), (0, 0), (0, 1))))
    assert np.sqrt(squared).ravel() == pytest.approx(np.minimum(flat, 3.0), abs=1e-5)


def test_a_root_is_found_where_there_are_jumps() -> None:
    assert find_root(lambda times: np.log(times**2 / 5), 1e-9, 30) == pytest.approx(5**0.5)
    stairs = find_root(lambda times: np.log(np.ceil(20 * times) / 57), 0.02, 30)
    assert np.ceil(20 * stairs) == pytest.approx(57, abs=1)


# --- fillets -----------------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(("name", "size"), [("gyroid", (20, 8, 4)), ("grid", (20, 8, 4)), ("octet", (12, 12, 5))])
def test_a_radius_that_leaves_no_voids_is_refused_and_the_one_named_does(name: str, size: tuple[int, ...]) -> None:
    """Such a radius ran for minutes; the time grows with its square."""
    part: Any = box(*size)
    with pytest.raises(GeometryError, match=r"^smooth_radius is 90 mm, more than half of") as refusal:
        fill(part, name, smooth_radius=90)
    radius = float(re.search(r"give ([\d.]+) mm or less$", str(refusal.value))[1])  # type: ignore[index]
    assert fill(part, name, smooth_radius=radius).report["infill"]["radius"] == radius


@pytest.mark.long
@pytest.mark.parametrize("radius", [1.0, 2.0])
def test_a_right_angle_is_rounded_to_the_radius_asked_for(radius: float) -> None:
    """A block with one void, whose edges are right angles before they are smoothed."""
    empty = {"cell": 100.0, "line_width": 1.0, "phase": (50.0, 50.0, 50.0)}
    result = fill(box(30, 30, 30), "cubic-bars", **empty, smooth_radius=radius, voxel=0.25, tolerance=0, wall=2)
    assert result.report["voids"]["count"] == 1
    cut = result.stages.voids.to_trimesh().section((0, 0, 1), (0, 0, 0.01))
    ring = np.asarray(cut.discrete[0])[:, :2]
    corner = ring[(ring > 0).all(axis=1)]
    tip = corner[np.argmin(np.abs(corner[:, 0] - corner[:, 1]))]
    tip = corner[np.linalg.norm(corner - tip, axis=1) < 0.5 * radius]
    centre, fitted = circle(tip)
    assert radius <= fitted <= 1.2 * radius  # at least, on a coarse grid too: see `fillets.COARSE`
    assert (centre < 13 - radius).all()  # further from the corner than that of a circle that touches both sides


def circle(points: np.ndarray) -> tuple[np.ndarray, float]:
    """The centre and radius of the circle nearest to points."""
    system = np.column_stack([2 * points, np.ones(len(points))])
    x, y, rest = np.linalg.lstsq(system, (points**2).sum(axis=1), rcond=None)[0]
    return np.array([x, y]), float(np.sqrt(rest + x * x + y * y))


@pytest.mark.slow
def test_no_radius_is_no_fillet() -> None:
    empty = {"cell": 100.0, "line_width": 1.0, "phase": (50.0, 50.0, 50.0)}
    sharp = fill(box(20, 20, 20), "cubic-bars", **empty, smooth_radius=0, wall=2).stages.voids
    assert sharp.volume == pytest.approx(16**3, rel=0.005)


# --- parts -------------------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_cavity_keeps_its_wall() -> None:
    part = less(box(24, 24, 24), ball(5))
    result = fill(part, "gyroid", **FEW)
    assert result.report["problems"] == []
    assert TriangleTree.of(result.stages.voids).nearest(ball(5).vertices)[0].min() >= 0.9 * 1.5


@pytest.mark.longest
def test_what_overlaps_is_united_and_what_touches_is_not() -> None:
    two = together(box(14, 14, 14), box(14, 14, 14, (7, 3, 2)))
    result = fill(two, "gyroid", **FEW)
    whole = union(box(14, 14, 14), box(14, 14, 14, (7, 3, 2)))
    assert result.report["mesh"]["skin"] == "united"
    assert result.report["problems"] == []
    assert result.stages.part.volume == pytest.approx(whole.volume)
    assert result.report["density"] == pytest.approx(0.3, abs=0.005)
    apart = together(box(14, 14, 14), box(14, 14, 14, (14.01, 0, 0)))
    result = fill(apart, "gyroid", **FEW)
    assert result.report["mesh"]["skin"] == "as given"
    assert result.report["part"]["components"] == 2
    assert result.report["problems"] == []  # the wall along the gap, too


@pytest.mark.longest
def test_what_is_inside_out_or_has_a_hole_is_repaired_and_told() -> None:
    block = box(16, 16, 16)
    inverted = Surface(vertices=block.vertices, faces=block.faces[:, ::-1])
    result = fill(inverted, "gyroid", **FEW)
    assert result.report["mesh"]["skin"] == "turned"
    assert result.surface.volume > 0
    holed = Surface(vertices=block.vertices, faces=block.faces[1:])
    result = fill(holed, "gyroid", **FEW)
    assert (result.report["mesh"]["skin"], result.report["part"]["holes"]) == ("closed", 1)
    assert result.report["problems"] == []
    assert result.stages.part.volume == pytest.approx(16**3)


@pytest.mark.slow
def test_boxes_that_share_an_edge_are_told_apart() -> None:
    two = together(box(14, 14, 14), box(14, 14, 14, (14, 14, 0)))
    two.merge_vertices()
    result = fill(two, "gyroid", **FEW)
    assert result.report["mesh"]["manifold"] == FINE
    assert result.report["problems"] == []


@pytest.mark.longest
def test_far_from_the_origin() -> None:
    block = box(16, 12, 10)
    here = fill(block, "gyroid", **FEW).report
    there = fill(block.copy().apply_translation((9000, -8000, 7000)), "gyroid", **FEW).report
    assert there["density"] == pytest.approx(here["density"], abs=1e-3)
    assert there["problems"] == []


@pytest.mark.longest
@pytest.mark.parametrize("voxel", [0.01, 0.02, 0.023])
def test_fillets_are_small_in_small_parts_however_their_walls_lie_on_the_grid(voxel: float) -> None:
    """Walls that lie between two layers of cells, as near to one as to the other, have an area too."""
    report = fill(box(1, 1, 1), wall=0.1, voxel=voxel, tolerance=0.0).report
    assert report["infill"]["radius"] == pytest.approx(0.8 / 3 / 6, rel=0.02)  # a cube of 0.8 mm: V over A is a sixth
    assert report["density"] == pytest.approx(0.2, abs=0.01)
    assert report["walls"]["least"] == pytest.approx(0.1, abs=0.01)


@pytest.mark.longest
def test_a_part_smaller_than_a_cell_has_thinner_walls_instead() -> None:
    result = fill(box(6, 5, 4), "gyroid", density=0.1, wall=0.8)
    assert result.report["infill"]["line_width"] < 0.2
    (thin,) = result.report["problems"]
    assert "mm wide, thinner than most printers make" in thin
    # Unless a width is asked for: then the density is what it can be, and that is told.
    told = fill(box(6, 5, 4), "gyroid", density=0.02, line_width=0.8, wall=0.8).report["problems"]
    assert any("the density is" in each for each in told)


def test_bars_that_reach_the_wall_leave_one_void_around_them() -> None:
    result = fill(box(12, 12, 40), "cubic-bars", cell=100, line_width=3, wall=1, voxel=0.4)
    assert result.report["voids"]["islands"] == 0
    assert len(result.surface.to_trimesh().split(only_watertight=True)) == 2  # the skin, and one void


@pytest.mark.longest
def test_what_hangs_free_is_left_out_and_what_is_lost_is_told() -> None:
    """Bars as thin as a cell of the grid break into pieces; those that vanish leave none."""
    broken = fill(box(20, 20, 20), "bcc", cell=8, line_width=0.5, voxel=0.4)
    assert broken.report["voids"]["islands"] > 100
    solid = broken.surface.to_trimesh().split(only_watertight=False)
    assert sum(each.volume > 0 for each in solid) == 1
    gone = fill(box(20, 20, 20), BAR, cell=8, line_width=0.4, voxel=0.4)
    worn = fill(box(20, 20, 20), BAR, cell=8, line_width=0.4)
    advised = ("of 0.12 mm and voxels of 0.12 mm", "of 0.1 mm and voxels of 0.1 mm", "of 0.1 mm")
    for result, remedy in zip((broken, gone, worn), advised, strict=True):
        (told,) = (
            text for text in result.report["problems"] if text.startswith("the infill was drawn with a density of")
        )
        assert told.endswith(f"; give a smooth radius {remedy}, or wider lines")


@pytest.mark.longest
@pytest.mark.parametrize(
    ("pattern", "settings"),
    [
        (BAR, {"line_width": 1.2}),
        (BAR, {"line_width": 0.4, "smooth_radius": 0.1}),
        ("bcc", {"line_width": 0.5, "smooth_radius": 0.12, "voxel": 0.12}),
    ],
)
def test_what_is_advised_against_lost_bars_works(pattern: Any, settings: dict[str, float]) -> None:
    assert fill(box(20, 20, 20), pattern, cell=8, **settings).report["problems"] == []


@pytest.mark.longest
def test_bars_that_are_only_narrower_are_not_lost() -> None:
    """Drawn wider, so that the density holds after smoothing."""
    report = fill(box(24, 24, 24), "octet", density=0.05).report
    assert report["problems"] == []
    assert report["density"] == pytest.approx(0.05, abs=0.002)


@pytest.mark.slow
def test_a_part_far_thinner_than_the_wall_is_refused_at_once() -> None:
    """In millimetres where metres were meant: no distance is measured over thousands of cells."""
    with pytest.raises(
        GeometryError, match=r"0\.04 mm, is nowhere thicker .* a thinner wall, or the right unit: --units m$"
    ):
        fill(ball(0.02), "gyroid")


@pytest.mark.parametrize(("inches", "units"), [(2.4, "in or cm"), (0.05, "m"), (0.5, "in or m")])
def test_a_tiny_part_is_told_the_units_in_which_it_would_be_a_print(inches: float, units: str) -> None:
    with pytest.raises(GeometryError, match=rf"or the right unit: --units {units}$"):
        fill(box(inches, inches, inches), "gyroid")


def test_a_line_width_whose_cells_are_larger_than_the_part_is_refused_with_one_that_fits() -> None:
    """As before a run: a plan is refused too. The width that is named leaves cells of a third of the part."""
    solid = box(60, 40, 40)
    part = Surface(vertices=np.asarray(solid.vertices), faces=np.asarray(solid.faces))
    for wide in (30.0, 450.0):
        with pytest.raises(GeometryError, match=r"give a line width of ([\d.]+) mm or less") as caught:
            plan_fill(part, check_request(pattern="gyroid", own={}, line_width=wide))
        assert caught.value.parameters == ("line_width",)
    fitting = re.search(r"line width of ([\d.]+) mm", str(caught.value))
    assert fitting is not None
    assert (
        plan_fill(part, check_request(pattern="gyroid", own={}, line_width=float(fitting[1])))["infill"]["cell"] <= 20.5
    )


def test_no_triangle_of_filled_bars_is_without_an_area() -> None:
    """Their sides are flat, and cut by planes in which corners lie on one line: at the precision of STL too."""
    surface = fill(box(16, 16, 16), "octet", density=0.05).surface
    assert not find_flat_triangles(surface.vertices, surface.faces).any()
    assert not find_flat_triangles(surface.vertices.astype(np.float32), surface.faces).any()
    assert surface.closed


@pytest.mark.long
@pytest.mark.parametrize("form", ["solid", "infill"])
def test_the_infill_alone_reaches_into_the_wall(form: str) -> None:
    block = box(20, 20, 12)
    given = {"cell": 6.0, "line_width": 0.8, "wall": 1.5, "voxel": 0.3, "tolerance": 0}
    result = fill(block, "gyroid", as_=form, overlap=0.4, **given)
    assert list(result.surfaces) == [form]
    assert manifold_status(result.surface) == FINE
    lower, upper = result.surface.bounds
    if form == "infill":
        assert (upper - lower) / 2 == pytest.approx(np.array([10, 10, 6]) - 1.5 + 0.4, abs=0.03)
        inside = 17 * 17 * 9
        band = 17.8 * 17.8 * 9.8 - inside
        assert result.surface.volume == pytest.approx(
            result.report["density"] * inside + band, rel=0.02
        )  # its edges are cut


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["gyroid", BAR, "honeycomb", "adaptive-cubic"])
def test_every_void_drains_or_is_listed(pattern: str, part: trimesh.Trimesh) -> None:
    shut = fill(part, pattern, **FEW)
    assert len(shut.report["voids"]["closed"]) == shut.report["voids"]["count"] > 0
    assert sum(each["volume"] for each in shut.report["voids"]["closed"]) == pytest.approx(
        shut.report["voids"]["volume"], rel=1e-6
    )
    result = fill(part, pattern, drain=1.5, **FEW)
    report, solid = result.report, result.surface
    # Small voids in the corners of a turned part have room for a narrower branch alone, and that is told.
    assert [each for each in report["problems"] if "branches narrower than 1.5 mm" not in each] == []
    assert report["voids"]["closed"] == []
    assert {hole["void"] for hole in report["drains"]["holes"]} == set(range(report["voids"]["count"]))
    assert solid.closed
    assert manifold_status(solid) == FINE
    assert len(solid.to_trimesh().split(only_watertight=False)) == 1  # one surface, inside and out
    # A line through each drain meets no solid from the void to where it leaves the part.
    for x, y, z in report["drains"]["at"]:
        line = np.array([[x, y, z + step] for step in np.linspace(-0.5, 0.5, 9)])
        assert (winding_numbers(line, solid) == 0).all()
    assert TriangleTree.of(surface(part)).nearest(np.array(report["drains"]["at"]))[0].max() < 1e-6


def test_a_void_that_stays_closed_is_told() -> None:
    """Below the only void lies a closed cavity of the part, into which nothing would drain."""
    part = less(box(16, 16, 20), box(15, 15, 2, (0, 0, -8)))
    empty = {"cell": 100.0, "line_width": 1.0, "phase": (50.0, 50.0, 50.0)}
    report = fill(part, "cubic-bars", **empty, wall=2.5, voxel=0.4, drain=1.5).report
    assert report["drains"]["count"] == 0
    (void,) = report["drains"]["undrained"]
    closed = report["voids"]["closed"]
    assert sorted(each["volume"] for each in closed) == pytest.approx(sorted([15 * 15 * 2, void["volume"]]))
    assert any("2 voids still sealed" in each for each in report["problems"])


# --- bodies ------------------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["gyroid", BAR, "cubic", "adaptive-cubic", "honeycomb", "concentric-heart"])
def test_equal_bodies_are_filled_alike(pattern: str) -> None:
    """Whole cells of the grid apart, so that not even that tells them apart; the third is another size."""
    shapes = [box(16, 14, 12), box(16, 14, 12, (20, 3.5, 0)), box(10, 10, 12, (-17, 2, 0))]
    width = 1.6 if pattern == BAR else 0.9
    given = {"cell": 6.3, "line_width": width, "voxel": 0.5, "wall": 1.0, "tolerance": 0, "phase": (0.7, 0, 0)}
    alone = fill(shapes[0], pattern, align="part", smooth_radius=0, **given).stages.voids
    result = fill(together(*shapes), pattern, align="body", smooth_radius=0, **given)
    assert result.report["problems"] == []
    assert result.report["request"]["align"] == "body"
    voids = result.stages.voids.to_trimesh().split(only_watertight=False)
    in_x = [each.bounds.mean(axis=0)[0] for each in voids]
    one = trimesh.util.concatenate([each for each, x in zip(voids, in_x, strict=True) if -9 < x < 9])
    two = trimesh.util.concatenate([each for each, x in zip(voids, in_x, strict=True) if x > 11])
    assert two.volume == pytest.approx(one.volume, rel=1e-3)
    moved = surface(two.apply_translation((-20, -3.5, 0)))
    assert TriangleTree.of(surface(one)).nearest(moved.vertices)[0].max() < 0.05
    # As if it were the only one.
    assert TriangleTree.of(alone).nearest(np.asarray(one.vertices))[0].max() < 0.05
    apart = (
        fill(together(*shapes), pattern, smooth_radius=0, **given)
        .stages.voids.to_trimesh()
        .split(only_watertight=False)
    )
    other = trimesh.util.concatenate([each for each in apart if each.bounds.mean(axis=0)[0] > 11])
    assert TriangleTree.of(surface(other)).nearest(moved.vertices + np.array([20, 3.5, 0]))[0].max() > 0.5


@pytest.mark.longest
@pytest.mark.parametrize("more", [{"density": (0.2, 0.4), "by": "x"}, {"as_": "project"}, {"open_": "top"}])
def test_bodies_keep_all_other_promises(more: dict[str, Any]) -> None:
    """Also one in a cavity of another, and two that touch."""
    near = 20.0 if "as_" not in more else 21.0  # a slicer has no use for two infills that touch
    nested = together(less(box(30, 24, 20), box(18, 14, 12)), box(12, 10, 9), box(10, 24, 20, (near, 0, 0)))
    result = fill(nested, "gyroid", align="body", **({"voxel": 0.5, "wall": 1.2, "density": 0.3} | more))
    assert result.report["problems"] == []
    assert result.report["part"]["components"] == 4
    assert result.report["mesh"]["manifold"] == FINE


@pytest.mark.longest
def test_one_body_is_the_part() -> None:
    one, same = (fill(box(20, 14, 12), "gyroid", align=align, **FEW).surface for align in ("body", "part"))
    assert one.volume == pytest.approx(same.volume, rel=1e-4)


# --- open sides --------------------------------------------------------------------------------------------------------

STEPPED = union(box(24, 20, 10), box(14, 20, 9, (-5, 0, 6)))  # of two tops, one at 10.5 and one at 5
WAVES = {"cell": 8.0, "line_width": 0.8, "voxel": 0.4, "wall": 1.0}


def waves(x: Any, y: Any, z: Any) -> Any:
    """Sheets like egg boxes: cut level, they leave bowls."""
    return np.sin(z / 2 - 0.8 * (np.cos(x) + np.cos(y)))


@pytest.mark.longest
@pytest.mark.parametrize(
    ("pattern", "open_"),
    [
        ("schwarz-p", "top"),
        (BAR, "bottom"),
        ("honeycomb", "both"),
        ("cubic", "both"),
        ("grid", "top"),
        ("support-cubic", "top"),
    ],
)
def test_an_open_part_is_one_solid_with_its_own_skin_but_for_the_side(pattern: str, open_: str) -> None:
    result = fill(STEPPED, pattern, density=0.25, open_=open_, voxel=0.4)
    solid, report, opening = result.surface, result.report, result.stages.opening
    assert report["problems"] == []
    assert (solid.closed, manifold_status(solid)) == (True, FINE)
    # One piece, and what else there is are voids.
    shells = solid.to_trimesh().split(only_watertight=False)
    assert sum(each.volume > 0 for each in shells) == 1
    assert len(shells) == 1 + len(report["voids"]["closed"]) == 1 + report["voids"]["count"] - report["voids"]["open"]
    assert report["voids"]["open"] > 0
    # The skin: every corner of the part, bit for bit, and no face between them but those of the part and of the cuts.
    corners = set(map(tuple, np.asarray(solid.vertices).tolist()))
    assert corners.issuperset(map(tuple, STEPPED.vertices.tolist()))
    assert opening is not None
    skin = trimesh.sample.sample_surface(opening.shell.to_trimesh(), 3000, seed=2)[0]
    assert TriangleTree.of(solid).nearest(skin)[0].max() < 1e-9
    assert TriangleTree.of(result.stages.voids).nearest(skin)[0].min() >= 0.9 * 1.2
    assert report["bounds"] == pytest.approx(STEPPED.bounds)
    # Walls and density, by points: the wall is solid, and the density is that of what lies deeper, up to the very side.
    points = np.random.default_rng(1).uniform(*STEPPED.bounds, (10000, 3))
    points = points[winding_numbers(points, surface(STEPPED)) > 0]
    away = TriangleTree.of(opening.shell).nearest(points)[0]
    assert winding_numbers(points[away < 0.9 * 1.2], solid).all()
    deep = points[away > 1.2]
    assert len(deep) > 5000
    assert np.mean(winding_numbers(deep, solid) > 0) == pytest.approx(0.25, abs=0.02)  # three times what chance does
    ends = [end for end in (opening.low, opening.high) if np.isfinite(end)]
    for end in ends:
        near = deep[np.abs(deep[:, 2] - end) < 0.6]
        assert np.mean(winding_numbers(near, solid) > 0) < 0.7  # no skin
    assert result.surface.volume == pytest.approx(STEPPED.volume - report["voids"]["volume"], rel=1e-3)
    assert report["density"] == pytest.approx(1 - report["voids"]["volume"] / report["part"]["inside"])


@pytest.mark.longest
def test_an_open_part_stays_closed_in_a_file(tmp_path: Path) -> None:
    for pattern in ("honeycomb", "gyroid", "triangles"):
        result = fill(STEPPED, pattern, open_="both", **FEW)
        assert not coincident_vertices(result.surface).any()
        result.save(tmp_path / f"{pattern}.stl")
        assert manifold_status(read_mesh(tmp_path / f"{pattern}.stl")) == FINE


@pytest.mark.longest
def test_what_hung_on_what_is_cut_off_is_left_out() -> None:
    result = fill(box(24, 24, 14), waves, open_="top", **WAVES)
    solid = result.surface.to_trimesh().split(only_watertight=False)
    assert result.report["voids"]["islands"] >= 2
    assert sum(each.volume > 0 for each in solid) == 1
    assert result.report["problems"] == []
    # Their volume is void.
    assert result.surface.volume == pytest.approx(24 * 24 * 14 - result.report["voids"]["volume"], rel=1e-3)


@pytest.mark.longest
def test_open_voids_need_no_drain() -> None:
    # At 1.5 mm, voids that the step cuts off drain through narrower branches, and that is told.
    upright = fill(STEPPED, "honeycomb", open_="top", drain=1.2, **FEW).report
    assert upright["problems"] == []
    assert upright["voids"]["open"] > 0
    drained = {hole["void"] for hole in upright["drains"]["holes"]}
    assert len(drained) == upright["voids"]["count"] - upright["voids"]["open"] > 0
    assert upright["voids"]["closed"] == []
    every = fill(box(20, 20, 12), "honeycomb", open_="top", drain=1.5, **FEW).report
    assert every["problems"] == []
    assert (every["drains"]["count"], every["voids"]["open"]) == (0, every["voids"]["count"])


@pytest.mark.longest
def test_a_part_lower_than_two_walls_may_be_open() -> None:
    with pytest.raises(GeometryError, match="nowhere thicker"):
        fill(box(20, 20, 2.2), "grid")
    tray = fill(box(20, 20, 2.2), "grid", open_="top").report
    assert tray["problems"] == []
    assert tray["part"]["inside"] == pytest.approx(17.6 * 17.6, rel=1e-3)


@pytest.mark.longest
@pytest.mark.parametrize("open_", ["top", "both"])
def test_the_infill_alone_reaches_an_open_side(open_: str) -> None:
    given = {"cell": 6.0, "line_width": 0.8, "wall": 1.5, "voxel": 0.3, "tolerance": 0, "overlap": 0.4}
    result = fill(box(20, 20, 12), "gyroid", as_="infill", open_=open_, **given)
    assert (result.surface.closed, manifold_status(result.surface)) == (True, FINE)
    assert result.report["problems"] == []
    assert result.surface.bounds[1] == pytest.approx(np.array([8.9, 8.9, 6]), abs=0.03)
    assert result.surface.bounds[0] == pytest.approx(np.array([-8.9, -8.9, -6 if open_ == "both" else -4.9]), abs=0.03)


@pytest.mark.longest
@pytest.mark.parametrize("by", ["z", "skin"])
def test_a_density_that_changes_ends_at_an_open_side(by: str) -> None:
    result = fill(box(20, 20, 20), "gyroid", density=(0.15, 0.35), by=by, open_="top", voxel=0.4, wall=1.0)
    assert result.report["problems"] == []
    points = np.random.default_rng(1).uniform(-9, 9, (20000, 3)) + np.array([0, 0, 1])
    top = points[points[:, 2] > 8.5]
    # At the very top it is the last density by height; by the depth below the skin it is what it is further down.
    solid = np.mean(winding_numbers(top, result.surface) > 0)
    if by == "z":
        assert solid == pytest.approx(0.34, abs=0.05)
    else:
        middle = points[np.abs(points[:, 2] - 2) < 3]
        assert solid == pytest.approx(np.mean(winding_numbers(middle, result.surface) > 0), abs=0.05)


@pytest.mark.longest
def test_a_side_that_cannot_be_open_is_one_clear_line(tmp_path: Path) -> None:
    bar = less(box(20, 20, 12), box(17.8, 17.8, 12, (0, 0, 2)))  # a rim of 1.1 mm
    with pytest.raises(
        GeometryError, match="^open is 'top', and the flat top of the part is nowhere wider than two walls"
    ):
        fill(bar, "grid", open_="top", wall=0.6)
    with pytest.raises(
        GeometryError, match="^open is 'both', and the part has no flat face at its bottom, z = -8 mm; turn"
    ):
        fill(ball(8), "gyroid", open_="both")
    with pytest.raises(UsageError, match="^open is 'side'; choose from top, bottom, both$"):
        fill(box(9, 9, 9), "gyroid", open_="side")
    with pytest.raises(UsageError, match="^open is 'top', and as is 'project', whose shell is the slicer's"):
        fill(box(9, 9, 9), "gyroid", open_="top", as_="project")
    sealed = fill(box(20, 20, 20), lambda x, y, z: np.sin(z), open_="top", cell=8.0, line_width=2.0, phase=(0, 0, 2))
    assert any(each.startswith("no void is open at the top") for each in sealed.report["problems"])
    box(20, 20, 12).export(path := tmp_path / "box.stl")
    refused = command("fill", path, "--open", "top", "--for", "cura", "-o", tmp_path / "a.3mf")
    assert (refused.exit_code, refused.stdout) == (2, "")
    assert "error: --open is 'top', and as is 'project'" in refused.stderr
    done = command("fill", path, "--open", "both", "--pattern", "grid", "-o", tmp_path / "a.stl")
    assert done.exit_code == 0
    assert "except for the open top and bottom" in done.stderr
    assert "open at the top and bottom" in done.stderr


def test_volumes_between_open_sides_are_those_of_cut_solids() -> None:
    mesh = turned(union(box(9, 7, 8), ball(5)), np.random.default_rng(2))
    solid = to_manifold(surface(mesh))
    for low, high in ((-2.0, 3.0), (-np.inf, 1.5), (0.5, np.inf), (-np.inf, 0.0)):
        opening = Opening(name="both", low=low, high=high, shell=surface(mesh))
        cut = solid.trim_by_plane((0, 0, 1), max(low, -99.0)).trim_by_plane((0, 0, -1), -min(high, 99.0))
        assert opening.volume(surface(mesh)) == pytest.approx(cut.volume(), rel=1e-9)


# --- what is told ------------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_thin_wall_and_a_void_outside_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Planted: voids that are moved towards the skin, and through it."""
    part = surface(box(20, 20, 20))
    voids = fill(part, "gyroid", **FEW).stages.voids
    assert measure_least_wall(part, [voids], 1)[0] >= 0.9 * 1.5
    nearer = replace(voids, vertices=voids.vertices + np.array([1.0, 0, 0]))
    least, at = measure_least_wall(part, [nearer], 1)
    assert 0.3 < least < 0.6
    assert at[0] == pytest.approx(10 - least, abs=0.01)
    points = np.concatenate([nearer.vertices, nearer.vertices[nearer.faces].mean(axis=1)])
    assert least == pytest.approx(TriangleTree.of(part).nearest(points)[0].min(), rel=1e-12)
    monkeypatch.setattr(telling, "AT_ONCE", 700)
    assert measure_least_wall(part, [nearer], 1)[0] == least
    assert count_outside(part, [voids], 1) == 0
    assert count_outside(part, [replace(voids, vertices=voids.vertices + np.array([40.0, 0, 0]))], 1) > 0


@pytest.mark.parametrize(
    ("wrong", "error", "says"),
    [
        ({"wall": 8}, GeometryError, "^wall is 8 mm, and the part, 12 x 12 x 12 mm, is .* give a thinner wall$"),
        ({"density": 120}, ParameterError, "^density is 120"),
        ({"density": 0.2, "cell": 5, "line_width": 0.4}, UsageError, "^density, cell and line_width are all given"),
        ({"pattern": "gyriod"}, PatternError, "did you mean 'gyroid'"),
        ({"waves": 3}, ParameterError, "^gyroid has no parameter 'waves'"),
        ({"pattern": "honeycomb", "waves": 3}, ParameterError, "^honeycomb has no parameter 'waves'"),
        ({"align": "top"}, UsageError, "^align is 'top'; choose from part, bed, body"),
        ({"as_": "shell"}, UsageError, "^as is 'shell'; choose from solid, infill"),
        ({"phase": (1.0,)}, UsageError, "^phase has 1 numbers"),
        ({"max_triangles": 20}, GeometryError, "^max_triangles is 20, and the skin of the part alone has 12"),
        ({"cell": 0.02, "line_width": 0.01, "voxel": None}, GeometryError, "^cell is 0.02 mm, and the part 12 mm long"),
        ({"max_memory": 10_000}, MemoryLimitError, "give larger voxels"),
    ],
)
def test_what_cannot_be_done_is_one_clear_line(wrong: dict[str, Any], error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says) as told:
        fill(box(12, 12, 12), **{"pattern": "gyroid", **wrong})
    assert "\n" not in str(told.value)


REFUSED = {
    "cubes_touching_edge.stl": "a thinner wall, or the right unit",
    "empty_0bytes.stl": "is empty",
    "empty_binary.stl": "holds no triangles",
    "frog_legs_open.obj": "a thinner wall$",
    "huge_150m_inverted.stl": "give a wall of 820 mm, or the right unit",
    "invalid_vertex.stl": "a vertex that is not three numbers",
    "metres_part_47um.stl": "a thinner wall, or the right unit",
    "multibody_ascii.stl": "a thinner wall, or the right unit",
    "nonmanifold.stl": "a thinner wall, or the right unit",
    "prusa_raspberry_cover_nonmanifold.stl": "a thinner wall$",
    "triangle_soup.stl": "a thinner wall, or the right unit",
    "unit_cube_1mm.stl": "a thinner wall, or the right unit",
    "unparseable.stl": "a vertex that is not three numbers",
}


@pytest.mark.longest
def test_files_that_are_broken_are_filled_or_one_clear_line(data: Path, tmp_path: Path) -> None:
    for path in sorted(each for each in (data / "nasty").iterdir() if each.suffix in (".stl", ".obj")):
        out = tmp_path / f"{path.stem}.stl"
        done = command("fill", path, "--pattern", "honeycomb", "--density", "20%", "--json", "-q", "-o", out)
        if path.name in REFUSED:
            one_line_error(done, REFUSED[path.name])
            assert not out.exists()
        else:
            report = json.loads(done.stdout)
            assert (report["mesh"]["manifold"], report["density"]) == (FINE, pytest.approx(0.2, abs=0.005))
            assert manifold_status(read_mesh(out)) == FINE


def test_a_sheet_is_no_part() -> None:
    sheet = Surface(vertices=np.array([[0.0, 0, 0], [9, 0, 0], [9, 9, 0]]), faces=np.array([[0, 1, 2]]))
    with pytest.raises(GeometryError, match="encloses nothing"):
        fill(sheet)


@pytest.mark.longest
def test_too_many_triangles_are_fewer_however_that_is_done(part: trimesh.Trimesh) -> None:
    """By a coarser grid; by larger cells; where both were asked for, by moving the surface, which is told."""
    given = {"cell": 5.0, "line_width": 0.8, "max_triangles": 3000}
    coarse = fill(part, BAR, density=0.2, max_triangles=20_000).report
    assert coarse["triangles"] <= 20_000
    assert coarse["problems"] == []
    assert coarse["infill"]["cell"] > 8
    moved = fill(part, "gyroid", **given).report
    assert moved["triangles"] <= 3000
    assert any(each.startswith("for so few triangles") for each in moved["problems"])
    assert moved["mesh"]["manifold"] == FINE


@pytest.mark.longest
def test_triangles_are_no_more_than_asked_for(part: trimesh.Trimesh) -> None:
    many = fill(part, "gyroid", density=0.25)
    few = fill(part, "gyroid", density=0.25, max_triangles=30_000)
    assert many.report["triangles"] > 40_000
    assert few.report["triangles"] <= 30_000
    assert few.report["mesh"]["manifold"] == FINE
    assert few.report["density"] == pytest.approx(0.25, abs=0.01)


@pytest.mark.longest
def test_simplified_voids_stay_closed_in_single_precision(part: trimesh.Trimesh) -> None:
    """Files of most formats have no more: two vertices in one place would be one, and an edge between two such, four."""
    voids = fill(part, BAR, density=0.25, tolerance=0).stages.voids
    assert not coincident_vertices(voids).any()
    for tolerance in np.linspace(0.01, 0.1, 10):
        few = simplify_solid(voids, tolerance)
        assert not coincident_vertices(few).any()
        assert few.closed
    assert len(few.faces) < 0.6 * len(voids.faces)
    twice = replace(voids, vertices=np.concatenate([voids.vertices, voids.vertices[:1] + 1e-9]))
    assert coincident_vertices(twice).sum() == 2


@pytest.mark.longest
def test_a_hollow_knows_its_density() -> None:
    request = check_request(
        pattern="gyroid",
        own={},
        drain=None,
        density=0.3,
        by=None,
        cell=None,
        line_width=None,
        wall=1.0,
        overlap=0.1,
        angle=0.0,
        phase=(0.0, 0.0, 0.0),
        align="bed",
        form="solid",
        smooth_radius=None,
        tolerance=0.03,
        resolution=None,
        voxel=0.2,
        max_triangles=None,
    )
    block = surface(box(16, 16, 16))
    hollow, _ = make_void_meshes(FillTask.of(block, request))
    assert hollow.space.volume == pytest.approx(14**3, rel=1e-3)
    assert hollow.density == pytest.approx(0.3, abs=0.002 + 1e-9)
    assert hollow.triangles == len(hollow.surface.faces)


# --- files -------------------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_the_command_writes_what_python_makes(tmp_path: Path, part: trimesh.Trimesh) -> None:
    given, out, picture = tmp_path / "part.stl", tmp_path / "out.stl", tmp_path / "out.png"
    part.export(given)
    done = command(
        "fill", given, "--density", "30%", "--wall", 1.5, "--voxel", 0.5, "-o", out, "--preview", picture, "--json"
    )
    assert done.exit_code == 0, done.stderr
    report = json.loads(done.stdout)
    assert report["files"] == [str(out), str(picture)]
    read, made = read_mesh(out), fill(read_mesh(given), **FEW)
    assert len(read.faces) == len(made.surface.faces) == report["triangles"]
    assert read.volume == pytest.approx(made.surface.volume, rel=1e-5)
    assert "as it was" in done.stderr
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)
    orange = (pixels[..., 0] - pixels[..., 2] > 60).sum()
    assert orange > 500  # what was cut
    one_line_error(command("fill", given, "-o", out), "exists")


@pytest.mark.longest
def test_a_dry_run_says_what_it_would_take(tmp_path: Path, part: trimesh.Trimesh) -> None:
    given = tmp_path / "part.stl"
    part.export(given)
    plan = json.loads(command("fill", given, "--pattern", "honeycomb", "--dry-run", "--json").stdout)
    done = fill(read_mesh(given), "honeycomb").report
    assert plan["request"] == done["request"]
    assert plan["grid"]["spacing"] == pytest.approx(done["grid"]["spacing"])
    assert plan["infill"]["cell"] == pytest.approx(done["infill"]["cell"], rel=0.4)
    assert "memory" in command("fill", given, "--dry-run").stdout
    assert sorted(tmp_path.iterdir()) == [given]


@pytest.mark.longest
@pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa() or "there")
def test_prusaslicer_slices_it_without_repairs(tmp_path: Path, part: trimesh.Trimesh) -> None:
    path = tmp_path / "filled.stl"
    fill(part, **FEW).save(path)
    facts = slicers.prusa_info(path)
    assert (facts["manifold"], facts["repairs"]) == (True, {})
    assert facts["volume"] == pytest.approx(read_mesh(path).volume, rel=1e-4)
    assert slicers.prusa_slice(path)["layers"] > 20


@pytest.mark.longest
@pytest.mark.parametrize(
    ("name", "pattern", "density"),
    [
        ("bracket_medium.stl", "gyroid", 0.15),
        ("m3x10_screw.stl", "octet", 0.3),
        ("prusa_x-carriage.stl", "concentric-heart", 0.15),
        ("voron_thread_test_2.stl", "gyroid", 0.3),
        ("far_out_ring.stl", "honeycomb", 0.15),
        ("spur_gear.stl", "adaptive-cubic", 0.3),
    ],
)
def test_real_parts(name: str, pattern: str, density: float, data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On the grids that users have, which are finer than those of the other tests."""
    monkeypatch.setattr(sizing, "FEWEST", FEWEST)
    given = read_mesh(data / "printable" / name)
    result = fill(given, pattern, density=density)
    assert result.report["problems"] == []
    assert (result.surface.vertices[: len(given.vertices)] == given.vertices).all()
    assert abs(result.report["density"] - density) < 0.005
    assert result.report["walls"]["least"] >= 0.9 * 1.2
    assert result.report["triangles"] <= 1_000_000


@pytest.mark.slow
def test_a_resolution_is_a_size_of_voxels_along_the_longest_side() -> None:
    part = box(20, 12, 10)
    one, other = (fill(part, BAR, density=0.3, wall=1.5, **given) for given in ({"resolution": 50}, {"voxel": 0.4}))
    np.testing.assert_array_equal(one.surface.vertices, other.surface.vertices)
    assert one.report["grid"]["spacing"] == pytest.approx([0.4] * 3)
    assert (one.report["request"]["resolution"], one.report["request"]["voxel"]) == (50, None)
    with pytest.raises(UsageError, match="voxel and resolution are both given; give one of them"):
        fill(part, BAR, resolution=50, voxel=0.4)
    with pytest.raises(ParameterError, match="resolution"):
        fill(part, BAR, resolution=0)


@pytest.mark.longest
def test_large_fillets_do_not_draw_voids_into_the_wall_where_the_skin_bends_inwards(part: trimesh.Trimesh) -> None:
    """Around a corner that points inwards, curvature alone would leave half of the wall: R^2 - 4 t = 0.3 of 1.0 mm^2."""
    report = fill(part, "cubic", density=0.25, wall=1.0, smooth_radius=0.8, voxel=0.25).report
    assert report["walls"]["least"] >= 0.97
    assert report["problems"] == []


@pytest.mark.slow
def test_the_summary_says_that_filament_wants_something_else() -> None:
    """Of one solid alone: drains are for resin and powder, and infill alone and projects are for slicers."""

    def told(**options: Any) -> bool:
        report = fill(box(14, 14, 14), "cubic", cell=6, line_width=1, voxel=0.7, **options).report
        lines = summary(report, [], "part.stl", verbose=False).splitlines()
        return any(re.match(r"  filament  .*--for prusa.* infill refill$", line) for line in lines)

    assert told()
    assert not told(drain=2)
    assert not told(as_="infill")
    assert not told(as_="project")
