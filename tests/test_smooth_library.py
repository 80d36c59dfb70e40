"""Laws of `smooth_volume`, `smooth_mesh` and `smooth_points`: what must hold whatever is smoothed."""

from __future__ import annotations

import json
import math
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import ndimage
from shapes import assert_printable, smooth_noise

from infill import (
    GeometryError,
    MemoryLimitError,
    ParameterError,
    Result,
    Smoothing,
    Surface,
    Volume,
    smooth_mesh,
    smooth_points,
    smooth_volume,
)
from infill.isosurfaces.levels import SMALLEST
from infill.kernels.compiling import log_compilation
from infill.meshes.distance import distances
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.comparing import VOLUME_TOLERANCE

Solid = NDArray[np.bool_]

FACES = ndimage.generate_binary_structure(3, 1)  # solid is joined by faces
EDGES = ndimage.generate_binary_structure(3, 2)  # void by faces and edges
VOLUME = 1e-4  # of the volume: the level is looked for to 1e-5, and 32-bit corners cost the rest
COMPONENT = 1e-3  # of the volume of one component among several: found to 2e-4


def ball(shape: tuple[int, int, int], centre: tuple[float, ...], radius: float) -> Solid:
    """Cells whose centre lies in a ball, given in cells; the centre of the first cell is 0."""
    away = np.indices(shape) - np.reshape(centre, (3, 1, 1, 1))
    solid: Solid = (away**2).sum(axis=0) <= radius**2
    return solid


def brick(shape: tuple[int, int, int], *sides: tuple[int, int]) -> Solid:
    solid = np.zeros(shape, dtype=bool)
    solid[tuple(slice(*side) for side in sides)] = True
    return solid


def pear() -> Solid:
    """A lopsided solid with a hole through it: no two of its views are equal."""
    shape = (26, 22, 18)
    solid = ball(shape, (8, 10, 8.5), 6.5) | ball(shape, (16, 11, 9), 4.5) | brick(shape, (5, 9), (3, 20), (4, 9))
    solid[:, 9:12, 7:10] = False
    return solid


def counted(solid: Solid) -> tuple[int, int]:
    """Components and cavities, by SciPy."""
    outside = np.pad(~solid, 1, constant_values=True)
    return ndimage.label(solid, FACES)[1], ndimage.label(outside, EDGES)[1] - 1


def same(one: Surface, other: Surface) -> bool:
    """Whether two surfaces are the same to the last bit."""
    return np.array_equal(one.vertices, other.vertices) and np.array_equal(one.faces, other.faces)


def farthest(one: Surface, other: Surface) -> float:
    """The farthest that a corner of one surface lies from the nearest of the other, both ways, mm."""
    from scipy.spatial import cKDTree

    ways = ((one.vertices, other.vertices), (other.vertices, one.vertices))
    return max(float(cKDTree(b).query(a)[0].max()) for a, b in ways)


@st.composite
def solids(draw: st.DrawFn) -> Solid:
    """Balls and bricks, added and taken away, on small grids that they may leave."""
    numbers = st.integers(1, 22)
    shape = (draw(numbers), draw(numbers), draw(numbers))
    solid = np.zeros(shape, dtype=bool)
    places = np.indices(shape)
    for _ in range(draw(st.integers(1, 4))):
        centre = np.reshape([draw(st.integers(0, count)) for count in shape], (3, 1, 1, 1))
        size = draw(st.integers(1, 8))
        away = np.abs(places - centre)
        part = (away**2).sum(axis=0) < size**2 if draw(st.booleans()) else (away < size).all(axis=0)
        solid = solid | part if draw(st.integers(0, 3)) else solid & ~part
    if solid.all() or not solid.any():
        solid[tuple(count // 2 for count in shape)] ^= True
    return solid if solid.any() and not solid.all() else np.array([[[False, True]]])


# --- laws ------------------------------------------------------------------------------------------------


@pytest.mark.slow
@given(solids(), st.sampled_from([0, 1, 5, 20, 60]))
@example(np.array([[[True, False]]]), 20)
@example(brick((1, 12, 12), (0, 1), (2, 9), (3, 10)), 20)
@example(brick((1, 1, 12), (0, 1), (0, 1), (2, 9)), 20)
@example(brick((12, 12, 12), (0, 12), (0, 12), (0, 6)), 20)
def test_every_solid_gives_a_closed_mesh_and_an_honest_report(solid: Solid, steps: int) -> None:
    result = smooth_volume(solid, smoothing=Smoothing(steps=steps), allow_broken=True, tolerance=None)
    mesh, report = result.mesh, result.report
    assert mesh.is_volume
    assert report["closed"] is True
    components, cavities = counted(solid)
    assert (report["topology"]["data"]["components"], report["topology"]["data"]["cavities"]) == (components, cavities)
    assert report["solid"]["data"] == pytest.approx(solid.sum())
    assert report["volume"] == pytest.approx(mesh.volume, rel=1e-6)
    assert report["volume_change"] == pytest.approx(mesh.volume / solid.sum() - 1, abs=1e-6)
    assert report["topology"]["result"]["euler_number"] == mesh.euler_number
    held = report["topology"]["result"]
    assert held["components"] + held["cavities"] == mesh.body_count
    assert 2 * (held["components"] + held["cavities"] - held["tunnels"]) == held["euler_number"]
    assert report["triangles"] == len(mesh.faces)
    assert np.allclose(report["bounds"], mesh.bounds)
    # Nothing leaves the grid but by the half cell that marching cubes may add.
    assert mesh.bounds[0].min() >= -0.5
    assert (mesh.bounds[1] <= np.array(solid.shape) + 0.5).all()
    if components == 1 and solid.sum() >= SMALLEST:
        assert abs(report["volume_change"]) <= 5 * VOLUME  # crumbs of a few cells are not found as closely
    elif components == 1 and abs(report["volume_change"]) > VOLUME_TOLERANCE:
        assert any(problem.startswith("the volume is ") for problem in report["problems"])
    json.dumps(report, allow_nan=False)


@pytest.mark.slow
@pytest.mark.parametrize("turned", [(0, 2, 1), (2, 0, 1), (2, 1, 0)])
def test_transposing_the_axes_transposes_the_mesh(turned: tuple[int, int, int]) -> None:
    spacing = (1.0, 0.7, 1.3)
    one = smooth_volume(pear(), spacing=spacing, method="plain", allow_broken=True, tolerance=None)
    axes = [spacing[axis] for axis in turned]
    other = smooth_volume(
        pear().transpose(turned), spacing=tuple(axes), method="plain", allow_broken=True, tolerance=None
    )
    assert other.report["volume"] == pytest.approx(one.report["volume"], rel=5e-5)  # each is found to 1e-5 or so
    assert other.report["topology"]["result"] == one.report["topology"]["result"]
    back = np.argsort(turned)
    # 1e-4 in the level, and where the surface is flat in phi that is a hundredth of a cell.
    assert farthest(one.surface, Surface(vertices=other.surface.vertices[:, back], faces=other.surface.faces)) < 1e-2


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_mirroring_the_data_mirrors_the_mesh(axis: int) -> None:
    one = smooth_volume(pear(), method="plain", allow_broken=True, tolerance=None)
    other = smooth_volume(np.flip(pear(), axis), method="plain", allow_broken=True, tolerance=None)
    vertices = other.surface.vertices.copy()
    vertices[:, axis] = pear().shape[axis] - vertices[:, axis]
    assert farthest(one.surface, Surface(vertices=vertices, faces=other.surface.faces)) < 1e-2
    assert other.mesh.volume > 0


@pytest.mark.slow
@settings(max_examples=8)
@given(st.tuples(*[st.integers(0, 20)] * 3), st.tuples(*[st.integers(0, 20)] * 3))
@example((1, 0, 0), (0, 0, 0))
@example((16, 8, 8), (8, 8, 16))
def test_void_around_the_data_moves_the_mesh_and_nothing_else(before: tuple[int, ...], after: tuple[int, ...]) -> None:
    """Where the solid stands clear of the edge; the bricks fall in other places, which refining feels a little."""
    solid = np.pad(ball((15, 15, 15), (7, 7, 7), 6) | brick((15, 15, 15), (7, 15), (6, 9), (6, 9)), 8)
    one = smooth_volume(solid, method="plain", tolerance=None)
    other = smooth_volume(np.pad(solid, list(zip(before, after, strict=True))), method="plain", tolerance=None)
    assert len(other.surface.faces) == len(one.surface.faces)
    moved = Surface(vertices=other.surface.vertices - before, faces=other.surface.faces)
    assert farthest(one.surface, moved) < 1e-4  # 32-bit corners up to 51 cells from zero
    assert other.report["topology"]["result"] == one.report["topology"]["result"]


@pytest.mark.longest
@settings(max_examples=8)
@given(st.floats(1e-3, 1e3))
@example(0.3)
@example(25.4)
def test_scaling_the_cells_scales_the_mesh(scale: float) -> None:
    one = smooth_volume(pear(), spacing=(1.0, 0.7, 1.3), allow_broken=True, tolerance=None)
    other = smooth_volume(pear(), spacing=(scale, 0.7 * scale, 1.3 * scale), allow_broken=True, tolerance=None)
    assert np.array_equal(one.surface.faces, other.surface.faces)
    assert np.allclose(other.surface.vertices, one.surface.vertices * scale, rtol=1e-5, atol=2e-4 * scale)
    assert other.report["volume"] == pytest.approx(one.report["volume"] * scale**3, rel=1e-5)
    assert other.report["distance"]["result"]["rms"] == pytest.approx(
        one.report["distance"]["result"]["rms"] * scale, rel=1e-3
    )


def test_the_origin_and_the_direction_move_the_mesh() -> None:
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    plain = smooth_volume(pear(), spacing=0.5, allow_broken=True, tolerance=None)
    placed = smooth_volume(
        Volume(values=pear(), spacing=0.5, origin=(100, -20, 3), direction=turn, space="LPS"),
        allow_broken=True,
        tolerance=None,
    )
    assert np.allclose(placed.surface.vertices, plain.surface.vertices @ turn.T + (100, -20, 3))
    assert (placed.report["grid"]["space"], placed.surface.space) == ("LPS", "LPS")
    assert placed.report["volume"] == pytest.approx(plain.report["volume"])
    moved = smooth_volume(pear(), spacing=0.5, origin=(100, -20, 3), allow_broken=True, tolerance=None)
    assert np.allclose(moved.surface.vertices, plain.surface.vertices + np.array((100, -20, 3)))


@pytest.mark.slow
@pytest.mark.parametrize("axes", [(-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1)])
def test_mirrored_axes_keep_the_outside_outside(axes: tuple[int, int, int]) -> None:
    result = smooth_volume(
        Volume(values=pear(), direction=np.diag(np.array(axes, float))), allow_broken=True, tolerance=None
    )
    assert_printable(result.mesh)
    assert result.report["volume"] == pytest.approx(result.mesh.volume, rel=1e-6)
    # What is found on the grid does not know of the mirror; the volume is summed in space.
    one, other = result.report, smooth_volume(pear(), allow_broken=True, tolerance=None).report
    for key in ("topology", "changes", "walls"):
        assert one[key] == other[key]
    assert one["solid"]["level"] == other["solid"]["level"]
    assert one["volume_change"] == pytest.approx(other["volume_change"], abs=1e-9)


# --- threads, memory, types ------------------------------------------------------------------------------


@pytest.mark.longest
def test_threads_and_runs_give_the_same_bits() -> None:
    rng = np.random.default_rng(7)
    solid = smooth_noise(rng, (48, 40, 36)) > 0.1
    one = smooth_volume(solid, threads=1, allow_broken=True, tolerance=None)
    for threads in (2, None):
        other = smooth_volume(solid, threads=threads, allow_broken=True, tolerance=None)
        assert same(one.surface, other.surface)
        for report in (one.report, other.report):
            report.pop("seconds", None)
        # The sum that gives the level runs in parts, one a thread: another last digit.
        levels = other.report["solid"].pop("level")
        assert levels == pytest.approx(one.report["solid"]["level"], abs=1e-12)
        facts = {name: value for name, value in one.report["solid"].items() if name != "level"}
        assert other.report == one.report | {"solid": facts}


def variants(values: NDArray[Any], folder: Path) -> dict[str, NDArray[Any]]:
    """Return the same values in every way that memory can hold them."""
    spread = np.zeros([2 * count for count in values.shape], dtype=values.dtype)
    spread[::2, ::2, 1::2] = values
    frozen = values.copy()
    frozen.flags.writeable = False
    np.save(folder / "mapped.npy", values)
    odd = np.zeros(values.nbytes + 1, np.uint8)[1:].view(values.dtype).reshape(values.shape)
    odd[...] = values
    return {
        "fortran": np.asfortranarray(values),
        "strided": spread[::2, ::2, 1::2],
        "backwards": values[::-1, ::-1].copy()[::-1, ::-1],
        "frozen": frozen,
        "mapped": np.load(folder / "mapped.npy", mmap_mode="r"),
        "big-endian": values.astype(values.dtype.newbyteorder(">")),
        "little-endian": values.astype(values.dtype.newbyteorder("<")),
        "not aligned": odd,
        "subclass": np.ma.masked_array(values),
    }


KINDS: dict[str, tuple[Any, dict[str, Any]]] = {
    "bool": (lambda solid: solid, {}),
    "mask": (lambda solid: solid.astype(np.uint8), {}),
    "mask of 255": (lambda solid: solid.astype(np.uint8) * np.uint8(255), {}),
    "signs": (lambda solid: np.where(solid, 1, -1).astype(np.int64), {}),
    "labels": (lambda solid: np.where(solid, 7, 2).astype(np.int32), {"label": 7}),
    "two labels": (
        lambda solid: np.where(solid, np.indices(solid.shape)[0] % 2 + 3, 0).astype(np.uint16),
        {"label": (3, 4)},
    ),
    "threshold": (lambda solid: np.where(solid, 1200, -1000).astype(np.int16), {"threshold": 200}),
    "range": (lambda solid: np.where(solid, 300, 3000).astype(np.int16), {"threshold": (200, 900)}),
    "otsu": (lambda solid: np.where(solid, 1200.0, 40.0), {"threshold": "otsu"}),
    "half": (lambda solid: np.where(solid, 5, 1).astype(np.float16), {"threshold": 3}),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_type_of_data_gives_the_mesh_of_its_solid(kind: str) -> None:
    make, options = KINDS[kind]
    values = make(pear())
    before = values.copy()
    result = smooth_volume(values, allow_broken=True, tolerance=None, **options)
    assert same(result.surface, smooth_volume(pear(), allow_broken=True, tolerance=None).surface)
    assert np.array_equal(values, before)


def phase() -> NDArray[np.float32]:
    """A phase field of a ball whose interface is two cells."""
    away = np.sqrt(((np.indices((24, 24, 24)) - 11.5) ** 2).sum(axis=0))
    return np.tanh((8.2 - away) / 1.4).astype(np.float32)


@pytest.mark.longest
@pytest.mark.parametrize("kind", ["bool", "uint8", "int16", "float32", "float64"])
def test_memory_does_not_matter_and_nothing_is_changed(kind: str, tmp_path: Path) -> None:
    options: dict[str, Any] = {"allow_broken": True, "tolerance": None}
    values: NDArray[Any]
    if kind.startswith("float"):
        values = phase().astype(kind)
    else:
        values = pear().astype(kind)
        if kind == "int16":
            values, options["threshold"] = values * np.int16(500), 250
    expected = smooth_volume(values, **options).surface
    for name, each in variants(values, tmp_path).items():
        before = np.array(each)
        result = smooth_volume(each, **options)
        assert same(result.surface, expected), name
        assert np.array_equal(each, before), name
        smooth_volume(each, despeckle=1.5, **options)
        assert np.array_equal(each, before), name
    assert same(smooth_volume(values.tolist(), **options).surface, expected)


def test_a_phase_field_places_its_surface_between_the_cells() -> None:
    """The zero set of the field is a ball of 8.2 cells, and grey keeps what a mask has lost."""
    exact = 4 / 3 * math.pi * 8.2**3
    grey = smooth_volume(phase(), tolerance=None)
    # Marching cubes draws straight chords of the sphere: under it by about h² / (4 r²) of its radius.
    assert grey.mesh.volume == pytest.approx(exact, rel=0.01)
    away = np.linalg.norm(grey.surface.vertices - 12, axis=1)
    assert abs(away - 8.2).max() < 0.15
    mask = smooth_volume(phase() > 0, tolerance=None)
    from_mask = np.linalg.norm(mask.surface.vertices - 12, axis=1)
    assert abs(away - 8.2).std() < abs(from_mask - 8.2).std()


def test_grey_levels_place_the_surface_between_the_cells() -> None:
    away = np.sqrt(((np.indices((24, 24, 24)) - 11.5) ** 2).sum(axis=0))
    values = np.clip((8.2 - away) * 1000, -1000, 1000).astype(np.int16) // 2 + 500
    kept = smooth_volume(values, threshold=500, tolerance=None)
    cut = smooth_volume(values, threshold=500, method="refine", tolerance=None)
    off = [np.abs(np.linalg.norm(each.surface.vertices - 12, axis=1) - 8.2) for each in (kept, cut)]
    assert off[0].max() < 0.15
    assert off[0].mean() < off[1].mean()
    assert kept.report["input"]["grey"] is True


# --- the volume ------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("steps", [5, 20, 60])
@pytest.mark.parametrize("radius", [5, 9, 14])
def test_level_volume_keeps_a_ball_and_level_0_shrinks_it(radius: int, steps: int) -> None:
    solid = ball((34, 34, 34), (16.5,) * 3, radius)
    kept = smooth_volume(solid, smoothing=Smoothing(steps=steps), tolerance=None)
    assert kept.mesh.volume == pytest.approx(solid.sum(), rel=VOLUME)
    assert abs(kept.report["volume_change"]) <= VOLUME
    assert np.allclose(kept.mesh.centroid, 17, atol=1e-3)
    away = np.linalg.norm(kept.surface.vertices - 17, axis=1)
    round_radius = (solid.sum() * 3 / 4 / math.pi) ** (1 / 3)
    assert abs(away - round_radius).max() < 0.5  # of a cell: no stair is left that is higher
    if radius > 5 or steps == 5:  # a small ball is gone at level 0
        shrunk = smooth_volume(solid, smoothing=Smoothing(steps=steps), level=0, allow_broken=True, tolerance=None)
        assert shrunk.report["volume_change"] < -0.01
        assert shrunk.report["solid"]["level"]["common"] == 0


@pytest.mark.slow
def test_each_of_several_components_keeps_its_volume() -> None:
    """Far enough apart that none feels another: 30 cells, against 16 at which the equation forgets."""
    shape = (110, 40, 40)
    radii = {18: 12.0, 60: 9.0, 95: 7.0}
    parts = [ball(shape, (x, 19.5, 19.5), radius) for x, radius in radii.items()]
    result = smooth_volume(np.any(parts, axis=0), tolerance=None)
    found = sorted(result.mesh.split(only_watertight=True), key=lambda mesh: float(mesh.centroid[0]))
    assert len(found) == 3
    for mesh, part in zip(found, parts, strict=True):
        assert mesh.volume == pytest.approx(part.sum(), rel=COMPONENT)
    assert result.report["solid"]["level"]["components"] == 3
    assert result.report["solid"]["level"]["lowest"] < result.report["solid"]["level"]["highest"]


@pytest.mark.slow
def test_a_component_with_a_cavity_and_a_component_in_it() -> None:
    shape = (50, 50, 50)
    solid = ball(shape, (24.5,) * 3, 22) & ~ball(shape, (24.5,) * 3, 16) | ball(shape, (24.5,) * 3, 8)
    result = smooth_volume(solid, tolerance=None)
    assert result.report["topology"]["data"] == {"components": 2, "cavities": 1, "tunnels": 0, "euler_number": 6}
    assert result.report["topology"]["result"] == result.report["topology"]["data"]
    assert result.mesh.volume == pytest.approx(solid.sum(), rel=COMPONENT)
    inner = [mesh for mesh in result.mesh.split(only_watertight=True) if mesh.extents.max() < 20]
    assert inner[0].volume == pytest.approx(ball(shape, (24.5,) * 3, 8).sum(), rel=COMPONENT)


def near(gap: int) -> Solid:
    """Two cubes with flat faces `gap` cells from one another; 0: they share an edge."""
    shape = (60, 60, 40)
    second = (
        brick(shape, (30, 50), (30, 50), (10, 30)) if gap == 0 else brick(shape, (30 + gap, 50), (10, 30), (10, 30))
    )
    return brick(shape, (10, 30), (10, 30), (10, 30)) | second


@pytest.mark.slow
@pytest.mark.parametrize("gap", [0, 1, 2, 3, 4, 6])
def test_components_close_to_one_another_do_not_grow(gap: int) -> None:
    """They may fuse, and the report says so; but the volume is that of the data."""
    result = smooth_volume(near(gap), allow_broken=True, tolerance=None)
    assert_printable(result.mesh)
    assert abs(result.report["volume_change"]) < 0.01


def test_a_slit_of_two_cells_does_not_change_the_volume() -> None:
    solid = np.ones((20, 20, 20), dtype=bool)
    solid[:, :, 9:11] = False
    result = smooth_volume(solid, allow_broken=True, tolerance=None)
    assert abs(result.report["volume_change"]) < 0.01


# --- the edge of the grid --------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("radius", [6, 11, 14])
def test_a_solid_that_the_grid_cuts_is_closed_there(radius: int) -> None:
    """The cut is flat, at the edge of the grid: where the data end."""
    solid = ball((20, 20, 20), (9.5,) * 3, radius)
    result = smooth_volume(solid, tolerance=None)
    assert_printable(result.mesh)
    assert abs(result.report["volume_change"]) < VOLUME
    if radius > 10:
        assert np.allclose(result.mesh.bounds, [[0] * 3, [20] * 3], atol=0.1)


@pytest.mark.parametrize("place", [(0, 0, 0), (4, 4, 4), (8, 4, 0), (4, 0, 4)])
def test_all_solid_but_one_cell(place: tuple[int, int, int]) -> None:
    solid = np.ones((9, 9, 9), dtype=bool)
    solid[place] = False
    result = smooth_volume(solid, tolerance=None)
    assert_printable(result.mesh)
    assert result.mesh.volume == pytest.approx(728, rel=VOLUME)
    assert result.report["problems"] == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "shape", [(1, 16, 12), (16, 1, 12), (16, 12, 1), (1, 1, 20), (1, 20, 1), (20, 1, 1), (2, 16, 12)]
)
def test_one_layer_or_one_row_is_a_volume_too(shape: tuple[int, int, int]) -> None:
    solid = np.zeros(shape, dtype=bool)
    solid[tuple(slice(count // 4, -(count // 4) or None) for count in shape)] = True
    result = smooth_volume(solid, tolerance=None)
    assert_printable(result.mesh)
    assert result.mesh.volume == pytest.approx(solid.sum(), rel=VOLUME)
    assert (result.mesh.extents <= np.array(shape) + 1).all()  # half a cell beyond the edge on either side


def test_layers_of_one_kind_are_smoothed_as_their_layer() -> None:
    """Along an axis without change nothing happens, up to the ends."""
    layer = ball((30, 30, 1), (14.5, 14.5, 0), 9)
    result = smooth_volume(np.repeat(layer, 12, axis=2), tolerance=None)
    z = result.surface.vertices[:, 2]
    inner = result.surface.vertices[(z > 1) & (z < 11)]
    rings = [inner[np.isclose(inner[:, 2], height)] for height in np.unique(inner[:, 2].round(3))]
    radii = [np.sort(np.linalg.norm(ring[:, :2] - 15, axis=1)).mean() for ring in rings if len(ring) > 20]
    assert len(radii) > 3
    assert np.ptp(radii) < 1e-3


# --- despeckling, simplifying ----------------------------------------------------------------------------


def with_specks() -> Solid:
    solid = ball((40, 40, 40), (19.5,) * 3, 11)
    solid[2, 2, 2] = solid[37, 3, 3] = True
    solid[2:4, 35:37, 2:4] = True
    return solid


@pytest.mark.slow
@pytest.mark.parametrize(("largest", "gone", "components"), [(0.0, 0, 4), (0.1249, 0, 4), (0.125, 2, 2), (1.0, 3, 1)])
def test_despeckling_takes_what_is_small_and_nothing_else(largest: float, gone: int, components: int) -> None:
    """Cells of 0.125 mm³: two specks of one, one of eight."""
    result = smooth_volume(
        with_specks(), spacing=0.5, despeckle=largest, crumbs=0.0, smoothing=Smoothing(steps=0), tolerance=None
    )
    assert result.report["input"]["despeckled"] == gone
    assert (
        result.report["topology"]["data"]["components"]
        == result.report["topology"]["result"]["components"]
        == components
    )
    if components == 1:
        alone = smooth_volume(
            ball((40, 40, 40), (19.5,) * 3, 11), spacing=0.5, smoothing=Smoothing(steps=0), tolerance=None
        )
        assert same(result.surface, alone.surface)


def test_despeckling_that_would_take_everything_is_an_error() -> None:
    with pytest.raises(
        ParameterError, match="despeckle is 1,000,000 mm³ and the largest component has 702 mm³; give less"
    ):
        smooth_volume(with_specks(), spacing=0.5, despeckle=1e6, tolerance=None)
    for wrong in (-1.0, math.nan):
        with pytest.raises(ParameterError, match="despeckle is"):
            smooth_volume(with_specks(), despeckle=wrong, tolerance=None)


def test_a_speck_that_vanishes_is_told_and_no_error() -> None:
    solid = ball((40, 40, 40), (19.5,) * 3, 13)
    solid[2, 2, 2] = True
    result = smooth_volume(solid, tolerance=None)
    assert result.report["changes"]["vanished_thin"] == 1
    assert result.report["changes"]["vanished"] == 0
    assert result.report["problems"] == []
    assert result.report["topology"]["result"]["components"] == 1
    assert result.mesh.volume == pytest.approx(solid.sum(), rel=VOLUME)


@pytest.mark.longest
@pytest.mark.parametrize(
    "options",
    [
        {"tolerance": 0.02},
        {"tolerance": 0.1},
        {"max_triangles": 2000},
        {"max_triangles": 100},
        {"tolerance": 0.5, "max_triangles": 1000},
    ],
)
def test_simplified_meshes_stay_closed_and_close(options: dict[str, Any]) -> None:
    solid = ball((40, 40, 40), (19.5,) * 3, 13) | brick((40, 40, 40), (15, 25), (5, 35), (15, 25))
    full = smooth_volume(solid, tolerance=None)
    result = smooth_volume(solid, **options)
    assert_printable(result.mesh)
    report = result.report
    assert report["triangles"] == len(result.surface.faces) < len(full.surface.faces)
    assert report["mesh"]["simplified"]["triangles_before"] == len(full.surface.faces)
    assert report["triangles"] <= options.get("max_triangles", report["triangles"])
    assert report["volume"] == pytest.approx(result.mesh.volume, rel=1e-5)
    assert report["mesh"]["simplified"]["volume_change"] == pytest.approx(
        result.mesh.volume / full.mesh.volume - 1, abs=1e-6
    )
    assert report["mesh"]["simplified"]["volume_change"] == pytest.approx(0, abs=1e-6)
    if list(options) == ["tolerance"]:
        assert report["mesh"]["simplified"]["distance"]["max"] <= options["tolerance"]
    assert result.mesh.euler_number == full.mesh.euler_number


@pytest.mark.slow
def test_simplifying_keeps_the_space_and_what_it_cannot_do_is_told() -> None:
    volume = Volume(values=ball((20, 20, 20), (9.5,) * 3, 7), space="LPS", direction=np.diag([-1.0, 1, 1]))
    result = smooth_volume(volume, max_triangles=300)
    assert_printable(result.mesh)
    assert result.surface.space == "LPS"
    assert len(result.surface.faces) <= 300
    many = smooth_volume(volume, max_triangles=10**9)
    assert len(many.surface.faces) == many.report["mesh"]["simplified"]["triangles_before"]
    for wrong in (
        {"max_triangles": 3},
        {"max_triangles": -5},
        {"tolerance": -0.1},
        {"tolerance": -1.0},
        {"tolerance": math.nan},
    ):
        with pytest.raises(ParameterError, match=r"triangles is|tolerance is"):
            smooth_volume(volume, **wrong)
    # A tolerance larger than the part leaves a solid of few flat sides, perhaps of another volume.
    with pytest.raises(GeometryError, match=r"(would change the volume by|is missing).*; give --tolerance 0"):
        smooth_volume(volume, tolerance=100.0)
    with pytest.raises(GeometryError, match=r"is missing.*; give --tolerance 0"):
        smooth_volume(volume, max_triangles=8)
    rough = smooth_volume(volume, tolerance=100.0, allow_broken=True)
    assert_printable(rough.mesh)
    assert rough.report["verdict"]["word"] == "lost"


@pytest.mark.longest
def test_points_of_a_groove_that_is_filled_are_lost_and_strays_are_told() -> None:
    box, slot = trimesh.creation.box((20, 20, 10)), trimesh.creation.box((1, 30, 5))
    slot.apply_translation((0, 0, 3.5))
    points = np.asarray(trimesh.sample.sample_surface(trimesh.boolean.difference([box, slot]), 8000, seed=1)[0])
    with pytest.raises(GeometryError, match=r"of 8,000 points lie over 2 voxels from the surface, up to .*--shell"):
        smooth_points(points, voxel=0.4, method="plain", tolerance=None)
    filled = smooth_points(points, voxel=0.4, method="plain", allow_broken=True, tolerance=None).report
    assert filled["verdict"]["word"] == "lost"
    assert filled["distance"]["points"]["lost"] > 500
    assert filled["distance"]["points"]["max"] == pytest.approx(4.0, abs=0.5)
    assert any("8,000 points" in problem for problem in filled["problems"])
    opened = smooth_points(
        points, voxel=0.4, tolerance=None
    ).report  # planes through the points tell both sides of the groove
    assert opened["distance"]["points"]["lost"] == 0
    assert opened["distance"]["points"]["p95"] < 0.3
    ball = trimesh.creation.icosphere(5, 10).vertices
    clean = smooth_points(ball, voxel=0.5, tolerance=None).report
    assert clean["verdict"]["word"] == "kept"
    assert clean["distance"]["points"]["far"] == 0
    assert clean["distance"]["points"]["p95"] < 0.1
    stray = smooth_points(np.concatenate([ball, [[0.0, 0, 0], [3, 0, 0]]]), voxel=0.5, tolerance=None).report
    assert (stray["distance"]["points"]["far"], stray["distance"]["points"]["lost"]) == (2, 0)
    assert stray["verdict"]["word"] == "changed a little"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["mask", "phase", "grey", "labels", "whole numbers"])
def test_masked_cells_are_void(kind: str) -> None:
    solid = np.zeros((30, 30, 30), dtype=bool)
    solid[5:25, 5:25, 5:25] = True
    masked = np.zeros_like(solid)
    masked[15:] = True
    values, options = {
        "mask": (solid, {}),
        "phase": (np.where(solid, 1.0, -1.0), {}),
        "grey": (np.where(solid, 105.0, 5.0), {"threshold": 50.0}),
        "labels": (3 * solid.astype(np.uint8), {"label": 3}),
        "whole numbers": (np.where(solid, 255, 0).astype(np.uint8), {"threshold": 128}),
    }[kind]
    cut = smooth_volume(np.where(masked, values.ravel()[0], values), **options)
    result = smooth_volume(np.ma.MaskedArray(values, mask=masked), **options)
    assert result.mesh.bounds[1, 0] < 16
    assert result.mesh.volume == pytest.approx(cut.mesh.volume, rel=0.01)
    assert smooth_volume(np.ma.MaskedArray(values), **options).mesh.bounds[1, 0] > 24


def test_labels_are_any_sequence() -> None:
    values = np.zeros((20, 20, 20), dtype=np.uint8)
    values[4:10, 4:16, 4:16], values[10:16, 4:16, 4:16] = 1, 2
    volumes = [
        smooth_volume(values, label=each, tolerance=None).mesh.volume for each in ((1, 2), [1, 2], np.array([1, 2]))
    ]
    assert volumes[0] == volumes[1] == volumes[2] == pytest.approx(12**3, rel=1e-3)


# --- errors ----------------------------------------------------------------------------------------------


def plate(cells: int) -> Solid:
    """A plate between two blocks that hold."""
    shape = (60, 30, 30)
    blocks = brick(shape, (4, 16), (6, 24), (6, 24)) | brick(shape, (44, 56), (6, 24), (6, 24))
    return blocks | brick(shape, (16, 44), (6, 24), (14, 14 + cells))


@pytest.mark.slow
def test_a_thin_plate_that_breaks_is_an_error_and_allowed_on_request() -> None:
    smoothing = Smoothing(steps=60)
    with pytest.raises(GeometryError, match=r"mm² of the input \(\d+%\) is missing.*, up to .* mm away, at .*--strict"):
        smooth_volume(plate(2), smoothing=smoothing, method="plain", strict=True, tolerance=None)
    result = smooth_volume(plate(2), smoothing=smoothing, method="plain", allow_broken=True, tolerance=None)
    assert_printable(result.mesh)
    assert result.report["problems"]
    assert result.report["verdict"]["word"] == "lost"
    held = Smoothing(steps=60, fidelity=1)
    assert smooth_volume(plate(2), smoothing=held, method="plain", tolerance=None).report["problems"] == []
    assert smooth_volume(plate(8), method="plain", tolerance=None).report["problems"] == []


@pytest.mark.longest
def test_remedies_are_tried_before_anything_is_refused() -> None:
    result = smooth_volume(plate(2), smoothing=Smoothing(steps=60), method="plain", tolerance=None)
    assert result.report["verdict"]["word"] != "lost"
    tried = result.report["verdict"]["tried"]
    assert len(tried) > 1
    assert result.report["verdict"]["taken"] == tried[-1]
    assert result.report["request"]["steps"] < 60


WRONG: list[tuple[Any, dict[str, Any], str]] = [
    (np.zeros((5, 5)), {}, "three axes"),
    (np.zeros((5, 5, 5, 5), bool), {}, "three axes"),
    (np.zeros((0, 5, 5), bool), {}, "three axes"),
    (np.zeros((5, 5, 5), bool), {}, "no cell would be solid"),
    (np.ones((5, 5, 5), bool), {}, "every cell would be solid"),
    (np.zeros((1, 1, 1), bool), {}, "no cell would be solid"),
    (np.full((5, 5, 5), 3), {}, "do not say what is solid"),
    (np.full((5, 5, 5), math.nan), {}, "NaN or infinite"),
    (np.array([[[math.inf, 0.0]]]), {"threshold": 1}, "NaN or infinite"),
    (np.full((2, 2, 2), "x"), {}, "real numbers or booleans"),
    (np.zeros((2, 2, 2), complex), {}, "real numbers or booleans"),
    (pear(), {"spacing": 0}, "spacing is 0 mm; it must be a finite number above 0"),
    (pear(), {"spacing": (1, -1, 1)}, "spacing is -1 mm"),
    (pear(), {"spacing": (1, 1)}, "spacing has 2 numbers for 3 axes"),
    (pear(), {"spacing": math.nan}, "spacing is nan mm"),
    (pear(), {"origin": (0, 0, math.inf)}, "origin is .* 3 finite numbers"),
    (pear(), {"level": "middle"}, "level is 'middle'"),
    (pear(), {"level": 1.5}, "level is 1.5; it must be a number from -0.999 to 0.999"),
    (pear(), {"level": 1.5, "refine": True}, "level is 1.5; it must be a number from -0.99 to 0.99"),
    (pear(), {"method": "best"}, "method is 'best'; choose from auto, plain, refine, grey"),
    (pear(), {"refine": True, "method": "plain"}, "refine is True and method plain; give one of them"),
    (pear(), {"radius": 0.0}, "^radius is 0 mm"),
    (pear(), {"radius": 100.0}, "would take 35000 steps; give at most 23.9 mm"),
    (pear(), {"tolerance": "fine"}, "tolerance is 'fine'; give a number of mm, or auto"),
    (pear(), {"crumbs": -1.0}, "crumbs is -1; it must be a number from 0 to inf mm³"),
    (pear(), {"method": "grey"}, "one threshold"),
    (pear(), {"level": math.nan}, "level is nan"),
    (pear(), {"threads": 0}, "threads"),
    (pear(), {"threads": -2}, "threads"),
    (pear(), {"threshold": "odsu"}, "there is no threshold 'odsu'"),
    (pear().astype(float) * 9 + 1, {}, "holds 2 labels: .* give .*--label N for one of them, or --threshold X"),
    (pear().astype(int) * 9, {"threshold": 50}, "no cell would be solid"),
    (pear().astype(int) * 9, {"threshold": (9, 3)}, "lower end first"),
    (pear().astype(int) * 9, {"threshold": 3, "label": 9}, "exclude each other"),
    (pear().astype(int) * 9, {"label": 4}, "label is 4, and no cell would be solid"),
    (pear().astype(int) * 9, {"label": 9, "grey": True}, "one threshold"),
    (pear(), {"grey": True}, "one threshold"),
]


@pytest.mark.parametrize(
    ("values", "options", "says"), WRONG, ids=[f"{i}-{says[:24]}" for i, (_, _, says) in enumerate(WRONG)]
)
def test_what_cannot_be_smoothed_is_one_clear_line(values: Any, options: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says) as caught:
        smooth_volume(values, **options)
    assert "\n" not in str(caught.value)


def test_too_little_memory_is_told_before_the_work() -> None:
    with pytest.raises(MemoryLimitError, match=r"needs about .* GiB .* is allowed; give --voxel"):
        smooth_volume(smooth_noise(np.random.default_rng(3), (60, 60, 60)) > 0, max_memory=10_000, tolerance=None)
    cube = Surface(
        vertices=np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]]),
        faces=np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
    )
    with pytest.raises(MemoryLimitError, match="larger voxels or a lower resolution"):
        smooth_mesh(cube, voxel=1e-5, tolerance=None)
    with pytest.raises(MemoryLimitError, match="larger voxels"):
        smooth_points(cube.vertices, voxel=1e-5, tolerance=None)


# --- meshes and points -----------------------------------------------------------------------------------


def sphere(subdivisions: int = 4) -> Any:
    return trimesh.creation.icosphere(subdivisions=subdivisions, radius=10.0)


@pytest.mark.slow
def test_a_mesh_comes_back_in_its_place() -> None:
    mesh = sphere()
    mesh.apply_translation([5, -100, 30])
    result = smooth_mesh(mesh, resolution=60, tolerance=None)
    assert_printable(result.mesh)
    assert np.allclose(result.mesh.centroid, mesh.centroid, atol=0.01)
    assert result.mesh.volume == pytest.approx(mesh.volume, rel=VOLUME)
    assert result.report["distance"]["from"] == "mesh"
    assert result.report["distance"]["result"]["rms"] < 0.005
    assert result.report["verdict"]["word"] == "kept"
    inverted = trimesh.Trimesh(mesh.vertices, mesh.faces[:, ::-1])
    assert same(smooth_mesh(inverted, resolution=60, tolerance=None).surface, result.surface)
    as_surface = Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))
    assert same(smooth_mesh(as_surface, resolution=60, tolerance=None).surface, result.surface)
    assert (
        same(smooth_mesh(mesh, voxel=20 / 60, tolerance=None).surface, result.surface)
        or farthest(smooth_mesh(mesh, voxel=20 / 60, tolerance=None).surface, result.surface) < 1e-3
    )


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1e-3, 1 / 25.4, 1000.0])
def test_scaling_a_mesh_scales_the_result(scale: float) -> None:
    mesh = sphere(3)
    one = smooth_mesh(mesh, resolution=30, tolerance=None)
    other = smooth_mesh(
        Surface(vertices=np.asarray(mesh.vertices) * scale, faces=np.asarray(mesh.faces)), resolution=30, tolerance=None
    )
    assert farthest(Surface(vertices=other.surface.vertices / scale, faces=other.surface.faces), one.surface) < 1e-3


@pytest.mark.slow
def test_finer_cells_come_closer_to_the_mesh() -> None:
    errors = [
        smooth_mesh(sphere(), resolution=n, tolerance=None).report["distance"]["result"]["rms"] for n in (15, 30, 60)
    ]
    assert errors[0] > errors[1] > errors[2]
    # The paper's levels blur by a part of a cell, so that the error falls about as the cell does.
    assert errors[2] < 0.5 * errors[0]


@pytest.mark.slow
def test_points_of_a_sphere_give_a_ball_or_a_shell() -> None:
    points = np.asarray(sphere(4).vertices)
    solid = smooth_points(points, voxel=0.5, tolerance=None)
    assert_printable(solid.mesh)
    assert solid.mesh.volume == pytest.approx(4 / 3 * math.pi * 1000, rel=0.03)
    shell = smooth_points(points, voxel=0.5, shell=3.0, tolerance=None)
    assert shell.report["topology"]["result"] == {"components": 1, "cavities": 1, "tunnels": 0, "euler_number": 4}
    assert shell.mesh.volume == pytest.approx(4 / 3 * math.pi * (11.5**3 - 8.5**3), rel=0.1)
    assert (shell.report["input"]["source"], shell.report["input"]["points"]) == ("points", len(points))


# --- the report ------------------------------------------------------------------------------------------


def test_the_report_has_what_it_promises() -> None:
    stages: list[tuple[str, float]] = []
    result = smooth_volume(
        pear(), spacing=0.5, progress=lambda *at: stages.append(at), allow_broken=True, tolerance=None
    )
    assert isinstance(result, Result)
    assert result.report["input"]["segmentation"]["method"] == "mask"
    assert result.report["grid"]["shape"] == list(pear().shape)
    assert result.report["grid"]["spacing"] == [0.5] * 3
    assert result.report["area"] == pytest.approx(result.mesh.area, rel=1e-5)
    assert result.report["extents"] == pytest.approx(result.mesh.extents.tolist(), rel=1e-6)
    assert next(name for name, _ in stages if name != "smooth") == "surface"
    shares = [share for _, share in stages]
    assert shares == sorted(shares)
    assert 0 <= shares[0] <= shares[-1] <= 1
    json.dumps(result.report, allow_nan=False)


def distance_from_triangle(points: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """The distance of each point from one triangle: beside its plane by Shapely, and out of it."""
    frame = np.linalg.qr((corners[1:] - corners[0]).T, mode="complete")[0]  # two axes in the plane, one across
    flat, away = (corners - corners[0]) @ frame, (points - corners[0]) @ frame
    beside = shapely.distance(shapely.points(away[:, :2]), shapely.Polygon(flat[:, :2]))
    return np.hypot(beside, away[:, 2])


@pytest.mark.slow
def test_distances_are_those_of_the_nearest_triangle() -> None:
    """Needles, tiny triangles and large ones side by side, as CAD makes them; against every triangle in turn."""
    rng = np.random.default_rng(5)
    fan = np.column_stack([np.linspace(0, 100, 300), np.zeros(300), np.zeros(300)])
    vertices = np.concatenate([fan, [[50, 60, 0], [50, -0.2, 0.1]], rng.uniform(20, 21, (60, 3))])
    faces = [(i, i + 1, apex) for apex in (300, 301) for i in range(299)] + [
        (302 + i, 303 + i, 304 + i) for i in range(58)
    ]
    surface = Surface(vertices=vertices, faces=np.array(faces))
    points = rng.uniform((-5, -5, -5), (105, 65, 25), (400, 3))
    exact = np.min([distance_from_triangle(points, corners) for corners in vertices[surface.faces]], axis=0)
    found = distances(points, surface)
    assert (found >= exact - 1e-9).all()  # of 100: rounding, over a needle's long side
    assert (found - exact).max() < 0.5  # of 100: samples are as far apart
    assert np.isclose(found, exact).mean() > 0.9


def test_distances_from_a_ball_and_a_square_are_those_of_their_formulas() -> None:
    rng = np.random.default_rng(6)
    square = Surface(
        vertices=np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), faces=np.array([[0, 1, 2], [0, 2, 3]])
    )
    points = rng.uniform(-3, 3, (500, 3))
    beyond = np.maximum(np.abs(points) - (1, 1, 0), 0)
    assert distances(points, square) == pytest.approx(np.linalg.norm(beyond, axis=1), abs=1e-12)
    mesh = sphere()
    round_one = Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))
    points = 4 * points
    # Flat triangles of an edge of 0.7 lie up to 0.02 within a sphere of 10.
    assert distances(points, round_one) == pytest.approx(np.abs(np.linalg.norm(points, axis=1) - 10), abs=0.025)
    assert distances(round_one.vertices, round_one).max() < 1e-9  # its corners lie on it


def test_the_helpers_can_fail() -> None:
    one, other = (smooth_volume(ball((20, 20, 20), (9.5,) * 3, radius), tolerance=None).surface for radius in (5, 6))
    assert same(one, one)
    assert not same(one, other)
    assert farthest(one, other) > 0.5
    assert counted(np.zeros((3, 3, 3), bool)) == (0, 0)
    shell = np.ones((3, 3, 3), bool)
    shell[1, 1, 1] = False
    assert counted(shell) == (1, 1)


def test_despeckling_takes_whole_components_blocks_and_all() -> None:
    """A component so large that it has bricks that are solid throughout."""
    two = np.zeros((130, 70, 70), dtype=bool)
    two[5:55, 5:55, 5:55] = two[62:126, 3:67, 3:67] = True
    result = smooth_volume(two, despeckle=130_000.0, smoothing=Smoothing(steps=5), tolerance=None)
    assert result.report["input"]["despeckled"] == 1
    assert result.report["topology"]["result"]["components"] == 1
    assert result.mesh.volume == pytest.approx(64**3, rel=1e-4)


@pytest.mark.parametrize("kind", [">f4", "float16", "float64"])
def test_despeckling_a_phase_field_of_any_float(kind: str) -> None:
    field = np.where(ball((30, 30, 30), (14.5,) * 3, 9), 1.0, -1.0)
    field[2, 2, 2:4] = 1
    result = smooth_volume(field.astype(kind), despeckle=5.0, smoothing=Smoothing(steps=5), tolerance=None)
    assert (result.report["input"]["despeckled"], result.report["topology"]["result"]["components"]) == (1, 1)


@pytest.mark.slow
def test_tolerance_and_triangles_are_both_kept_or_it_is_told() -> None:
    solid = ball((40, 40, 40), (19.5,) * 3, 13)
    with pytest.raises(GeometryError, match=r"at most 300 triangles and 0.02 mm of leeway"):
        smooth_volume(solid, max_triangles=300, tolerance=0.02)
    both = smooth_volume(solid, max_triangles=2000, tolerance=0.5).report
    assert both["triangles"] <= 2000
    assert both["mesh"]["simplified"]["distance"]["max"] <= 0.55
    assert both["mesh"]["simplified"]["shells"] == 1


@pytest.mark.slow
def test_a_volume_that_no_level_mends_is_a_problem(rng: np.random.Generator) -> None:
    noise = rng.random((20, 20, 20)) < 0.5
    result = smooth_volume(noise, method="plain", allow_broken=True, tolerance=None)
    assert abs(result.report["volume_change"]) > 0.01
    assert any(problem.startswith("the volume is ") for problem in result.report["problems"])


def test_otsu_of_half_precision_and_of_a_narrow_range() -> None:
    values = np.where(ball((30, 30, 30), (14.5,) * 3, 9), 1.0, -1.0)
    for data in (((values + 1) * 100).astype(np.float16), (1000 + 0.01 * values).astype(np.float32)):
        found = smooth_volume(data, threshold="otsu", smoothing=Smoothing(steps=5), tolerance=None)
        assert found.report["topology"]["result"]["components"] == 1


@pytest.mark.slow
def test_more_threads_than_make_sense_still_work() -> None:
    solid = ball((30, 30, 30), (14.5,) * 3, 9)
    assert smooth_volume(solid, threads=100_000, tolerance=None).report["volume"] == pytest.approx(
        smooth_volume(solid, tolerance=None).report["volume"]
    )


def test_what_was_lost_is_told_where_it_was_in_space() -> None:
    """A fin of two cells on a ball, in a volume that is shifted and mirrored along x."""
    solid = ball((60, 60, 60), (29.5,) * 3, 14)
    solid[29:31, 30:58, 20:40] = True
    volume = Volume(values=solid, spacing=0.5, origin=(100, -20, 3), direction=np.diag([-1.0, 1, 1]))
    report = smooth_volume(volume, smoothing=Smoothing(steps=30), level=0, allow_broken=True, tolerance=None).report
    (fin,) = report["walls"]["lost"]
    assert fin["voxels"] > 100
    assert fin["at"][0] == pytest.approx(100 - 15)  # exactly: fin and ball are even about x and z
    assert 2 < fin["at"][1] < 9  # beyond the ball, which ends at y = 2
    assert fin["at"][2] == pytest.approx(3 + 15)
    assert any("1 wall vanished" in problem for problem in report["problems"])


@pytest.mark.slow
def test_the_log_tells_once_of_compiling(caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is compiled inside of what is compiled is not told again, nor is what is compiled later."""
    import numba

    monkeypatch.setattr("infill.kernels.compiling.REPORTED", threading.Event())
    monkeypatch.setattr("infill.kernels.compiling.UNCACHED", threading.Event())  # another test may have set it

    @log_compilation("all")
    def work() -> int:
        with log_compilation("a part"):
            return numba.njit(lambda x: x + 1)(1) + numba.njit(lambda x: x * 2.5)(1)

    assert work() == work() == 4.5
    assert caplog.messages == ["preparing all for input of this kind, up to a minute, the first time"]


@pytest.mark.slow
@pytest.mark.parametrize("function", [smooth_volume, smooth_bricks])
def test_nobody_waits_for_a_compiler_untold(
    function: Any, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What takes seconds to compile is watched: here something that needs compiling is passed in as its progress."""
    import numba

    monkeypatch.setattr("infill.kernels.compiling.REPORTED", threading.Event())

    def progress(*_: object) -> None:
        numba.njit(lambda x: x + 1)(1)

    solid = ball((12, 12, 12), (5.5,) * 3, 2.9)
    function(solid, smoothing=Smoothing(steps=1), progress=progress)
    assert len(caplog.messages) == 1
    assert caplog.messages[0].startswith("preparing ")


@pytest.mark.slow
def test_how_far_edges_may_draw_back_goes_with_the_diffusion() -> None:
    """Four steps of a quarter of the length blur as one does: the same wall is lost, wherever it begins to count."""
    fin = np.zeros((40, 60, 40), dtype=bool)
    fin[5:35, 5:25, 5:35] = True
    fin[19:21, 25:33, 5:35] = True  # two cells thick, eight long
    lost = [
        smooth_volume(fin, smoothing=smoothing, method="plain", allow_broken=True, tolerance=None).report["walls"][
            "lost"
        ]
        for smoothing in (Smoothing(steps=20), Smoothing(steps=80, alpha=1 / 28))
    ]
    assert lost[0] == lost[1]
    assert [piece["voxels"] for piece in lost[0]] == [60]
    assert Smoothing(steps=20).blur == pytest.approx(Smoothing(steps=80, alpha=1 / 28).blur)


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [0.05, 0.5])
def test_changes_of_the_volume_say_what_they_compare(tolerance: float) -> None:
    """One is that of the mesh that is written over the data, in all places; the other is that of simplifying alone."""
    ball = trimesh.creation.icosphere(3, 10.0)
    options: dict[str, Any] = {"resolution": 30, "allow_broken": True, "level": 0.0}
    full = smooth_mesh(ball, tolerance=None, **options)
    lean = smooth_mesh(ball, tolerance=tolerance, **options)
    report, solid = lean.report, lean.report["solid"]
    assert report["volume"] == solid["volume"] == pytest.approx(lean.mesh.volume, rel=1e-6)
    assert report["volume_change"] == solid["change"] == solid["volume"] / solid["data"] - 1
    cost = report["mesh"]["simplified"]["volume_change"]
    assert cost == pytest.approx(report["volume"] / full.report["volume"] - 1, abs=1e-12)
    assert 1 + report["volume_change"] == pytest.approx((1 + full.report["volume_change"]) * (1 + cost), abs=1e-12)
    assert abs(full.report["volume_change"]) > 1e-4  # at the level 0 both are told apart
