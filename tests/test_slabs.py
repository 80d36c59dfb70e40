"""Voids that are made slab by slab are those of the whole: the same numbers, the same surfaces, less memory."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from made_shapes import box, less, rod, turned, union
from scipy.spatial import KDTree

from infill import GeometryError, Surface, Volume, fill
from infill.interior import layer_stack as layers
from infill.interior.interior import Interior, compute_interior
from infill.interior.layer_stack import LayerStack
from infill.isosurfaces import slabs
from infill.isosurfaces.slabs import (
    SlabPiece,
    cut_slab_piece,
    measure_slab_shells,
    simplify_piece,
    stitch_pieces,
    sum_shell_volumes,
)
from infill.lattices import density_search
from infill.lattices.density_search import solid_share
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.hollowing import simplify_voids
from infill.lattices.request import FillSpec, check_request
from infill.lattices.slabwise import defer_voids, surfaces_by_slabs
from infill.lattices.surfacing import choose_smoothing, make_surfaces
from infill.lattices.task import FillTask
from infill.lattices.voids import Layout, VoidFields
from infill.meshes.distance import TriangleTree
from infill.meshes.hole_filling import open_edges
from infill.meshes.shells import select_faces
from infill.meshes.solids import FINE, manifold_status, simplify_open_piece
from patterns import Pattern
from patterns.shared import cell_parameter

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

THICK = 11  # layers: some slabs in a small part
SIZES = {"cell": 5.0, "width": 0.6}  # mm


def surface(mesh: Any) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def asked(pattern: str, **more: Any) -> FillSpec:
    given: dict[str, Any] = {
        "density": None,
        "by": None,
        "cell": SIZES["cell"],
        "line_width": SIZES["width"],
        "wall": 1.2,
        "overlap": None,
        "angle": 0.0,
        "phase": (0.3, 0.1),
        "align": "part",
        "form": "solid",
        "drain": None,
        "smooth_radius": None,
        "tolerance": 0.03,
        "resolution": None,
        "voxel": 0.4,
        "max_triangles": None,
    }
    return check_request(pattern=pattern, own={}, **(given | more))


def in_slabs(space: Interior, thick: int = THICK) -> Interior:
    nz = space.shape[2]
    return replace(
        space,
        layers=LayerStack.packed(space.layers.read_layers(low, min(low + thick, nz)) for low in range(0, nz, thick)),
    )


@pytest.fixture(scope="module")
def space() -> Interior:
    """Of a block with a hole and a ball on it, turned, so that no two layers are alike."""
    mesh = union(less(box(26, 20, 14), rod(4, 30)), box(8, 8, 8, (9, 6, 8)))
    return compute_interior(surface(turned(mesh, np.random.default_rng(4))), wall=1.2, voxel=0.4)


def drawn(space: Interior, pattern: str, **more: Any) -> tuple[FillTask, VoidFields]:
    """Draw a pattern in a space."""
    task = FillTask.of(space.part, asked(pattern, **more))
    fields = task.draw(Layout(space=space, **SIZES))
    assert isinstance(fields, VoidFields)
    return task, fields


def made(space: Interior, pattern: str, **more: Any) -> tuple[int, tuple[Surface, ...], tuple[Surface, ...], float]:
    """Return the steps, the surfaces of the whole and of slabs, every triangle of them, and the volume of slabs."""
    (task, fields), (_, sliced) = (drawn(each, pattern, **more) for each in (space, in_slabs(space)))
    whole, slabs = make_surfaces(task, fields), surfaces_by_slabs(task, sliced, tolerance=0.0)
    assert (whole.islands, whole.specks) == (slabs.islands, slabs.specks)
    return choose_smoothing(task, fields).steps, whole.surfaces, slabs.surfaces, defer_voids(task, sliced).volume


def corners(each: Surface, digits: int) -> np.ndarray:
    """Return the triangles, sorted whatever their order and that of their corners: (F, 9)."""
    points = np.round(np.asarray(each.vertices)[each.faces], digits) + 0.0
    first = np.lexsort(points.transpose(2, 0, 1)[::-1], axis=-1)[:, 0]
    rolled = np.take_along_axis(points, (first[:, None] + np.arange(3))[:, :, None] % 3, axis=1).reshape(-1, 9)
    return rolled[np.lexsort(rolled.T)]


# --- packed layers ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("at_once", [1, 100, layers.AT_ONCE])
def test_packed_layers_are_what_was_packed(
    at_once: int, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(layers, "AT_ONCE", at_once)
    whole = rng.normal(size=(5, 4, 23)).astype(np.float32)
    whole[:, :, 6:12] = whole[:, :, 12:18]
    packed = LayerStack.packed(whole[:, :, low : low + 6] for low in range(0, 23, 6))
    assert packed.in_slabs
    assert not LayerStack.of(whole).in_slabs
    assert packed.shape == whole.shape
    assert packed.bounds() == [(0, 6), (6, 12), (12, 18), (18, 23)]
    for low, high in ((0, 23), (0, 6), (3, 4), (5, 13), (17, 23)):
        assert np.array_equal(packed.read_layers(low, high), whole[:, :, low:high])
        assert np.array_equal(LayerStack.of(whole).read_layers(low, high), whole[:, :, low:high])
    assert packed.layer_key(6, 12) == packed.layer_key(12, 18) != packed.layer_key(0, 6)


@pytest.mark.parametrize("thick", [1, 5, 8, 23, 40])
def test_a_volume_in_slabs_is_that_volume(
    thick: int, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(layers, "LEAST_LAYERS", thick)
    monkeypatch.setattr(layers, "SLAB", 1)
    whole = Volume(values=rng.random((4, 5, 23)) < 0.5, spacing=0.5, origin=(1, 2, 3))
    found = list(layers.split_into_slabs(whole))
    assert np.array_equal(np.concatenate([each.values for each in found], axis=2), whole.values)
    assert [each.origin for each in found] == [(1, 2, 3 + 0.5 * low) for low in range(0, 23, thick)]


def test_a_space_in_slabs_measures_as_the_whole(space: Interior) -> None:
    slabs = in_slabs(space)
    assert slabs.shape == space.shape
    assert slabs.cells == pytest.approx(space.cells, rel=1e-12)
    assert slabs.thickness == pytest.approx(space.thickness, rel=1e-12)
    assert slabs.second_longest_side == space.second_longest_side
    shares = [solid_share(drawn(each, "honeycomb")[1]) for each in (space, slabs)]
    assert shares[0] == pytest.approx(shares[1], rel=1e-9)


def test_a_large_part_is_measured_slab_by_slab(monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.interior import interior as module

    part = surface(box(10, 12, 30))
    whole = compute_interior(part, wall=1.2, voxel=0.4)
    monkeypatch.setattr(module, "WHOLE", 1000)
    monkeypatch.setattr(layers, "SLAB", 10_000)
    slabs = compute_interior(part, wall=1.2, voxel=0.4, slabs=True)
    assert slabs.layers.in_slabs
    assert not whole.layers.in_slabs
    # Heights are counted from the slab: single precision may round the other way.
    assert np.allclose(slabs.depth, whole.depth, rtol=0, atol=1e-5)
    assert len({id(each) for each in slabs.layers.slabs}) < len(slabs.layers.slabs)


# --- surfaces ---------------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(
    ("pattern", "radius"),
    [
        ("honeycomb", 0.0),
        ("honeycomb", 0.25),
        ("honeycomb", 1.5),
        ("rectilinear", 0.0),
        ("concentric-heart", 0.25),
        ("concentric", 1.5),
    ],
)
def test_slabs_make_the_surfaces_of_the_whole(pattern: str, radius: float, space: Interior) -> None:
    """Triangle by triangle; with a radius of 1.5 mm, more layers are needed beside a slab than it has."""
    phase = (0.0, 0.0) if pattern == "concentric" else (0.3, 0.1)
    steps, whole, slabs, known = made(space, pattern, smooth_radius=radius, phase=phase)
    assert (steps > THICK) == (radius > 1)
    assert len(whole) == len(slabs) > 0
    for one, other in zip(whole, slabs, strict=True):
        assert other.closed
        assert len(one.faces) == len(other.faces)
        # Heights are counted from the slab, and so rounded otherwise in the last bits; the few vertices inside cubes
        # are in single precision.
        away, _ = KDTree(one.vertices).query(other.vertices)
        assert away.max() < 1e-5
        assert (away > 1e-12).mean() < 1e-3
        assert other.volume == pytest.approx(one.volume, rel=1e-9)
        # Rounding may part equal ones.
        assert (corners(one, 5) == corners(other, 5)).all(axis=1).mean() > 0.99
    assert known == pytest.approx(sum(each.volume for each in slabs), rel=1e-9)


def sharpest(mesh: Any, pattern: str, **more: Any) -> float:
    inside = compute_interior(surface(mesh), wall=1.0, voxel=0.4)
    task = FillTask.of(inside.part, asked(pattern, phase=(0.0, 0.0), **more))
    return task.draw(Layout(space=inside, cell=7.8, width=0.8)).find_sharpest()


@pytest.mark.slow
def test_corners_are_those_of_the_part_at_hand() -> None:
    """The waves of a zigzag are as long as the part: in a small one they meet at sharper angles than in a large one."""
    small, large = (box(side, side, 6) for side in (24.0, 96.0))
    assert sharpest(small, "zigzag") < 84 < 88 < sharpest(large, "zigzag") < 90
    both = union(small, box(24, 24, 6, (0, 72, 0)))
    assert sharpest(both, "zigzag", align="body") == pytest.approx(sharpest(small, "zigzag"), abs=0.01)
    assert sharpest(both, "zigzag") > 87
    assert sharpest(small, "cross-3d") == pytest.approx(90, abs=0.001)


@dataclass(frozen=True, kw_only=True)
class Star(Pattern):
    """Two lines that meet at 53 degrees in the middle."""

    name = "star"
    summary = ""
    cell: float = cell_parameter(6.0)

    def lines(self, region: Any, z: float = 0.0) -> Any:
        return shapely.intersection(
            shapely.multilinestrings([[(-50, -100), (50, 100)], [(50, -100), (-50, 100)]]), region
        )

    def line_spacing(self, region: Any) -> float:
        return self.cell


def test_corners_outside_of_the_walls_are_none() -> None:
    """Two walls that meet at 53 degrees in the hole of a frame, and nowhere in the frame itself."""
    frame, block = (surface(mesh) for mesh in (less(box(20, 20, 6), box(12, 12, 8)), box(20, 20, 6)))
    voids = Prismatic(pattern=Star(), anchor=np.zeros(3), share=0.1)
    spaces = [compute_interior(each, wall=1.0, voxel=0.4) for each in (frame, block)]
    found = [voids.draw(Layout(space=each, cell=7.8, width=0.8)).find_sharpest() for each in spaces]
    assert found == [90, pytest.approx(53.13, abs=0.01)]


@pytest.mark.slow
def test_too_few_layers_beside_a_slab_are_seen(space: Interior, monkeypatch: pytest.MonkeyPatch) -> None:
    """The comparison can fail: without them, pieces do not meet, or surfaces differ."""
    from infill.lattices import slabwise

    task, fields = drawn(in_slabs(space), "honeycomb", smooth_radius=1.5)
    smoothing = choose_smoothing(task, fields)

    def few(*_: Any) -> Any:
        return replace(smoothing, steps=0)

    real = slabwise.smooth_void
    monkeypatch.setattr(slabwise, "choose_smoothing", few)  # by which layers are counted
    monkeypatch.setattr(
        slabwise, "smooth_void", lambda out, depth, _, threads: real(out, depth, smoothing, threads=threads)
    )
    with pytest.raises(GeometryError, match="do not meet"):
        surfaces_by_slabs(task, fields, tolerance=0.0)


@pytest.mark.slow
def test_pieces_that_do_not_meet_are_refused() -> None:
    whole = surface(trimesh.creation.box((4, 4, 4)).subdivide().subdivide())
    pieces = [cut_slab_piece(whole, low, high) for low, high in ((-3, 0), (0, 3))]
    assert all(piece is not None for piece in pieces)
    lower, upper = (each for each in pieces if each is not None)
    again = stitch_pieces([(-3, lower), (0, upper)])
    assert again.closed
    assert np.array_equal(corners(again, 9), corners(whole, 9))
    assert sum_shell_volumes([measure_slab_shells(lower), measure_slab_shells(upper)]) == pytest.approx([64])
    moved = np.array(upper.surface.vertices)
    moved[upper.rim(0)[0], 0] += 1e-9
    for wrong in (replace(upper, surface=replace(upper.surface, vertices=moved)), None):
        with pytest.raises(GeometryError, match="do not meet"):
            stitch_pieces([(-3, lower), (0, wrong)])
    with pytest.raises(GeometryError, match="do not meet"):
        sum_shell_volumes([measure_slab_shells(lower), None])


# --- simplified -------------------------------------------------------------------------------------------------------


def test_open_edges_stay_to_the_last_bit() -> None:
    ball = surface(trimesh.creation.icosphere(5, radius=10))
    half = select_faces(ball, (ball.vertices[:, 2] > 0.2)[ball.faces].all(axis=1))
    few = simplify_open_piece(half, 0.1)
    assert len(few.faces) < len(half.faces) / 3

    def rim(each: Surface) -> np.ndarray:
        ends = np.asarray(each.vertices)[open_edges(each.faces)].reshape(-1, 6)
        return ends[np.lexsort(ends.T)]

    assert np.array_equal(rim(few), rim(half))
    assert TriangleTree.of(half).nearest(few.vertices)[0].max() < 1e-9  # vertices are some of those that were
    assert TriangleTree.of(few).nearest(half.vertices)[0].max() <= 0.1


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["honeycomb", "rectilinear", "concentric-heart"])
def test_simplified_slabs_stay_within_the_tolerance(pattern: str, space: Interior) -> None:
    task, fields = drawn(in_slabs(space), pattern)
    tolerance = task.request.tolerance
    every = surfaces_by_slabs(task, fields, tolerance=0.0)
    few = simplify_voids(task, defer_voids(task, fields), tolerance)
    alone = simplify_voids(task, every, tolerance)
    assert few.triangles < 1.4 * alone.triangles  # with a plane at every eleventh layer, at which all are kept at first
    assert few.triangles < every.triangles / 2
    assert few.count == every.count
    assert few.density == pytest.approx(every.density, abs=0.005)
    for one, other in zip(every.surfaces, few.surfaces, strict=True):
        assert manifold_status(other) == FINE
        for near, far in ((one, other), (other, one)):
            points = np.asarray(near.vertices)
            assert TriangleTree.of(far).nearest(points)[0].max() <= tolerance


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["honeycomb", "concentric-heart", "concentric"])
def test_a_part_filled_in_slabs_keeps_all_promises(pattern: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.interior import interior as module

    mesh = union(less(box(26, 20, 40), rod(4, 60)), box(8, 8, 30, (9, 6, 20)))
    monkeypatch.setattr(module, "WHOLE", 1000)
    monkeypatch.setattr(layers, "SLAB", 100_000)
    seen = []
    monkeypatch.setattr(density_search, "defer_voids", lambda *given: seen.append(1) or defer_voids(*given))
    result = fill(mesh, pattern, density=0.25)
    report, solid = result.report, result.surface
    assert seen
    assert report["problems"] == []
    assert (solid.vertices[: len(mesh.vertices)] == mesh.vertices).all()
    assert (solid.faces[: len(mesh.faces)] == mesh.faces).all()
    assert solid.closed
    assert manifold_status(solid) == FINE
    assert report["density"] == pytest.approx(0.25, abs=0.005)
    assert report["walls"]["least"] >= 0.9 * 1.2
    assert report["voids"]["count"] == len(report["voids"]["closed"])


def test_slabs_are_planned_for_upright_voids_alone() -> None:
    from infill.lattices.sizing import goes_by_slabs

    part = surface(box(20, 20, 20))
    for pattern, more, expected in (
        ("honeycomb", {}, True),
        ("gyroid", {}, False),
        ("honeycomb", {"open_": "top"}, False),
        ("honeycomb", {"form": "infill"}, False),
        ("honeycomb", {"align": "body"}, False),
        ("honeycomb", {"density": (0.1, 0.3), "cell": None, "line_width": None}, False),
    ):
        request = asked(pattern, **more)
        assert goes_by_slabs(FillTask.of(part, request)) is expected, (pattern, more)


@pytest.mark.slow
def test_a_tall_part_has_voxels_as_fine_as_a_low_one() -> None:
    from infill.lattices.sizing import choose_sizes, choose_voxel

    request = asked("honeycomb", cell=None, line_width=None, density=0.2, voxel=None)
    found = []
    for height in (100, 400):
        task = FillTask.of(surface(box(60, 60, height)), request)
        found.append(choose_voxel(task, *choose_sizes(task)))
    assert [low >= high for low, high in pairwise(found)] == [True]


def test_few_of_a_piece_keeps_its_planes() -> None:
    mesh = trimesh.creation.box((4, 4, 4))
    for _ in range(4):
        mesh = mesh.subdivide()
    piece = cut_slab_piece(surface(mesh), -3, 0)
    assert isinstance(piece, SlabPiece)
    few = simplify_piece(piece, 0.1)
    assert len(few.surface.faces) < len(piece.surface.faces)
    rims = [each.surface.vertices[each.rim(each.high)] for each in (piece, few)]
    assert np.array_equal(*rims)


def test_components_of_a_piece_are_simplified_some_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    ball = trimesh.creation.icosphere(4, radius=3)
    both = trimesh.util.concatenate([ball, ball.copy().apply_translation((8, 0, 0))])
    piece = cut_slab_piece(surface(both), -2, 1)
    assert isinstance(piece, SlabPiece)
    monkeypatch.setattr(slabs, "AT_ONCE", 100)
    few = simplify_piece(piece, 0.1)
    assert len(few.surface.faces) < len(piece.surface.faces) / 2
    for height in (0, piece.high):
        np.testing.assert_array_equal(few.surface.vertices[few.rim(height)], piece.surface.vertices[piece.rim(height)])
    for one, other in ((piece, few), (few, piece)):
        assert TriangleTree.of(one.surface).nearest(other.surface.vertices)[0].max() < 0.1
    assert len(open_edges(few.surface.faces)) == len(open_edges(piece.surface.faces))
