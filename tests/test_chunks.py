"""Volumes in chunks: the field, the triangles, the levels and the counts are those of the whole, to the last bit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import dask.array
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from infill import Smoothing, Volume, smooth_volume
from infill.chunks.encoding import digest_data
from infill.chunks.hashing import add_up, face_sums, hash_surface
from infill.chunks.layout import ChunkLayout
from infill.chunks.running import Runner, open_runner
from infill.chunks.shells import find_names
from infill.chunks.solids import SolidRule
from infill.chunks.solving import Solver
from infill.chunks.tasks import make_part, smooth
from infill.chunks.work import Work
from infill.errors import GeometryError
from infill.isosurfaces.components import data_bits, sum_exactly
from infill.isosurfaces.sparse_marching import euler_number_of_bits
from infill.kernels.sparse import BRICK
from infill.lazy.volume import LazyVolume
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.chunked_surface import ChunkedSurface
from infill.smoothing.levelling import SurfaceAtLevel, extract_surface, remove_crumbs
from infill.smoothing.request import SmoothedInput, SmoothRequest
from infill.smoothing.scans import volume_ways
from infill.smoothing.stages import place_surface

pytestmark = pytest.mark.usefixtures("silent_compiler")


@dataclass(frozen=True)
class Arranged:
    """An array in memory as a source of chunks."""

    array: NDArray[Any]

    @property
    def shape(self) -> tuple[int, ...]:
        return self.array.shape

    @property
    def dtype(self) -> np.dtype[Any]:
        return self.array.dtype

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        return self.array[box]


@dataclass(frozen=True, kw_only=True)
class Case:
    """A volume, how it is smoothed, and how it is divided."""

    seed: int
    shape: tuple[int, int, int]
    blur: float
    share: float
    steps: int
    spacing: tuple[float, float, float]
    size: tuple[int, int, int]
    level: float | str = "volume"

    @property
    def values(self) -> NDArray[np.uint8]:
        noise = np.random.default_rng(self.seed).normal(size=self.shape)
        noise = gaussian_filter(noise, self.blur) if self.blur else noise
        return np.round(255 * (noise - noise.min()) / np.ptp(noise)).astype(np.uint8)

    @property
    def threshold(self) -> float:
        return float(np.quantile(self.values, self.share))

    @property
    def request(self) -> SmoothRequest:
        return SmoothRequest(
            method="plain", smoothing=Smoothing(steps=self.steps), tolerance=None, level=self.level, threads=1
        )

    def work(self, **changes: Any) -> Work:
        layout = ChunkLayout(shape=self.shape, size=self.size, steps=self.steps)
        work = Work(
            source=Arranged(self.values),
            rule=SolidRule(low=self.threshold),
            layout=layout,
            smoothing=Smoothing(steps=self.steps),
            spacing=self.spacing,
            level=None if isinstance(self.level, str) else self.level,
        )
        return replace(work, **changes)


@st.composite
def cases(draw: st.DrawFn, largest: int = 40) -> Case:
    return Case(
        seed=draw(st.integers(0, 2**32 - 1)),
        shape=tuple(draw(st.integers(5, largest)) for _ in range(3)),
        blur=draw(st.sampled_from([0.0, 0.7, 1.5, 3.0])),
        share=draw(st.floats(0.3, 0.8)),
        steps=draw(st.integers(1, 23)),
        spacing=tuple(draw(st.sampled_from([0.3, 0.41, 0.5])) for _ in range(3)),
        size=tuple(draw(st.integers(1, 4)) for _ in range(3)),
        level=draw(st.sampled_from(["volume", "volume", 0.0, -0.2])),
    )


# Noise in chunks of a brick: thousands of components and of cubes whose signs decide nothing.
NOISE = Case(seed=3, shape=(25, 33, 18), blur=0, share=0.6, steps=16, spacing=(0.3, 0.5, 0.41), size=(1, 1, 1))
# Cells end with a brick, so that the last one holds only the void beyond the grid.
FITTING = Case(seed=1, shape=(23, 15, 31), blur=1.5, share=0.5, steps=5, spacing=(0.5, 0.5, 0.5), size=(1, 2, 1))


@dataclass(frozen=True)
class Whole:
    """The same at once, in memory."""

    field: NDArray[np.float32]
    surfaced: SurfaceAtLevel
    smoothed: SmoothedInput

    @classmethod
    def of(cls, case: Case) -> Whole:
        scan = Volume(values=case.values, spacing=case.spacing)
        way = volume_ways(scan, case.request, threshold=case.threshold)[0]
        request = way.request.for_cell(min(case.spacing))
        assert not isinstance(way.data, type(None))
        field = smooth_bricks(way.data.data.values, request.smoothing, spacing=case.spacing)
        dense = field.to_dense()
        smoothed = SmoothedInput(smooth_input=way.data, request=request, field=field)
        return cls(dense, extract_surface(smoothed), smoothed)


def triangles(vertices: NDArray[Any], faces: NDArray[Any]) -> NDArray[np.float64]:
    """Return the triangles as rows of nine numbers, each from its least corner, in order."""
    corners = np.asarray(vertices)[np.asarray(faces)].reshape(-1, 3, 3)
    rows = np.arange(len(corners))
    first = np.zeros(len(corners), dtype=int)
    for corner in (1, 2):
        least, other = corners[rows, first], corners[rows, corner]
        differs = least != other
        axis = differs.argmax(axis=1)
        first[differs.any(axis=1) & (other[rows, axis] < least[rows, axis])] = corner
    turned = np.stack([corners[rows, (first + n) % 3] for n in range(3)], axis=1).reshape(-1, 9)
    return turned[np.lexsort(turned.T[::-1])]


def solve(case: Case, **changes: Any) -> Solver:
    solver = Solver(work=case.work(**changes), runner=Runner(workers=1), tell=lambda *_: None)
    solver.smooth()
    return solver


def assembled(solver: Solver, surface: Any, marked: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the vertices and triangles that all chunks write, in one array each."""
    numbering = solver.number_vertices(surface, marked)
    vertices = np.full((numbering.first_vertices[-1], 3), np.nan)
    faces = np.full((numbering.first_faces[-1], 3), -1)
    for n, chunk in enumerate(numbering.chunks):
        part = make_part(solver.work, chunk, surface.tasks[chunk.number], numbering.removed[chunk.number])
        begin, at = numbering.first_vertices[n], numbering.first_faces[n]
        vertices[begin : begin + len(part.vertices)] = part.vertices
        numbers = np.concatenate([begin + np.arange(len(part.vertices)), numbering.find(part.foreign)])
        faces[at : at + len(part.faces)] = numbers[part.faces]
    return vertices, faces


def check_case(case: Case) -> None:
    """Compare everything with the whole."""
    try:
        whole = Whole.of(case)
    except GeometryError as error:
        with pytest.raises(GeometryError, match=str(error)[:20]):
            solve(case).find_surface()
        return
    solver = solve(case)
    surface, common, levels = solver.find_surface()
    levelled, components = whole.surfaced.levelled, whole.surfaced.components
    assert solver.joined is not None
    np.testing.assert_array_equal(solver.joined.cells, components.cells)
    # Sums of floating-point numbers in another order: the levels agree to rounding, and then the surface to the bit.
    assert common == pytest.approx(levelled.common, rel=1e-9, abs=1e-12)
    np.testing.assert_allclose(levels, levelled.levels, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(np.sort(surface.shells.volume), np.sort(levelled.shells.volume), rtol=1e-9, atol=1e-9)
    assert surface.shells.euler.sum() == levelled.shells.euler.sum()
    data = {n: done.data for n, done in solver.smoothed.items() if done.data is not None}
    vertices = sum(int(part.shells.vertices.sum()) for part in data.values())
    faces = sum(int(part.shells.faces.sum()) for part in data.values())
    bits = data_bits(levelled.field)
    assert vertices - faces // 2 == euler_number_of_bits(levelled.field, bits)
    for marked in (np.zeros(len(surface.shells.volume), dtype=bool), np.abs(surface.shells.volume) < 1e-3):
        points, corners = assembled(solver, surface, marked)
        assert np.isfinite(points).all()
        if not marked.any():
            expected = triangles(levelled.surface.vertices, levelled.surface.faces)
            np.testing.assert_array_equal(triangles(points, corners), expected)
            assert hash_surface(points, corners) == hash_surface(levelled.surface.vertices, levelled.surface.faces)
        assert add_up([face_sums(points, corners, 1.0)], 1.0)[1]  # closed
    for chunk in solver.chunks.values():
        kept = None if solver.smoothed[chunk.number].start is None else chunk
        if kept is not None and chunk.has_cells and isinstance(case.level, float):
            check_field(case, whole, chunk)


def check_field(case: Case, whole: Whole, chunk: Any) -> None:
    """Compare the field of a chunk's own cells with the whole's, bit for bit."""
    from infill.chunks.work import open_field

    kept = open_field(case.work(), chunk)
    first = np.maximum(np.array(chunk.low) * BRICK - 1, 0) - np.array(chunk.kept_low) * BRICK
    sizes = [part.stop - part.start for part in chunk.own_cells]
    own = kept.field.to_dense()[tuple(slice(a, a + n) for a, n in zip(first, sizes, strict=True))]
    box = tuple(
        slice(part.start + low, part.stop + low) for part, low in zip(chunk.own_cells, chunk.cell_low, strict=True)
    )
    np.testing.assert_array_equal(own, whole.field[box])


@settings(max_examples=3)
@example(case=NOISE)
@example(case=FITTING)
@given(case=cases(largest=24))
def test_chunks_give_the_whole(case: Case) -> None:
    check_case(case)


@pytest.mark.longest
@settings(max_examples=150)
@given(case=cases(largest=70))
def test_many_chunks_give_the_whole(case: Case) -> None:
    check_case(case)


def test_triangles_compares_sets() -> None:
    points, faces = np.eye(3), np.array([[0, 1, 2], [0, 2, 1]])
    np.testing.assert_array_equal(triangles(points, faces), triangles(points, faces[::-1][:, [1, 2, 0]]))
    assert (triangles(points, faces[:1]) != triangles(points, faces[1:])).any()


@pytest.mark.parametrize("shape", [(1, 1, 1), (14, 6, 15), (30, 31, 47)])
@pytest.mark.parametrize("size", [(1, 1, 1), (2, 3, 1), (9, 9, 9)])
def test_every_cell_belongs_to_one_chunk(shape: tuple[int, int, int], size: tuple[int, int, int]) -> None:
    seen = np.zeros(shape, dtype=int)
    for chunk in ChunkLayout(shape=shape, size=size, steps=7):
        if chunk.has_cells:
            box = tuple(
                slice(part.start + low, part.stop + low)
                for part, low in zip(chunk.own_cells, chunk.cell_low, strict=True)
            )
            seen[box] += 1
            for part, low, high in zip(chunk.own_cells, chunk.cell_low, chunk.cell_high, strict=True):
                assert 0 <= part.start <= part.stop <= high - low
    assert (seen == 1).all()


def test_a_margin_one_brick_narrower_is_not_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    """The comparison can fail: with half of the margin, cells at the border of chunks are wrong."""
    case = replace(FITTING, shape=(47, 40, 40), steps=23, blur=3.0, level=0.0, size=(1, 1, 1))
    whole = Whole.of(case)
    monkeypatch.setattr(ChunkLayout, "margin", property(lambda self: (1, 1, 1)))
    with pytest.raises(AssertionError):
        for chunk in case.work().layout:
            if chunk.has_cells and smooth(case.work(), chunk).start is not None:
                check_field(case, whole, chunk)


def test_kept_fields_change_nothing(tmp_path: Any) -> None:
    case = FITTING
    plain, kept = solve(case), solve(case, scratch=str(tmp_path))
    assert any(tmp_path.glob("*.npz"))
    results = [assembled(s, s.find_surface()[0], np.zeros(10_000, dtype=bool)) for s in (plain, kept)]
    for one, other in zip(*results, strict=True):
        np.testing.assert_array_equal(one, other)


def test_pieces_that_do_not_meet_are_an_error() -> None:
    with pytest.raises(GeometryError, match="do not meet"):
        find_names(np.array([3, 5]), np.array([4]))


def test_sums_depend_on_no_order(rng: np.random.Generator) -> None:
    values = rng.normal(size=200_000) * 1e6
    values[::2] *= 1e-9
    group = rng.integers(0, 3, len(values))
    order = rng.permutation(len(values))
    sums = sum_exactly(group, values, 3)
    exact = [math.fsum(values[group == n]) for n in range(3)]
    # Relative to the sum of sizes, 1e11, a double has 1e-5; here, a millionth of that is left.
    np.testing.assert_allclose(sums, exact, rtol=0, atol=1e-11 * 1e5)
    np.testing.assert_allclose(sum_exactly(group[order], values[order], 3), sums, rtol=0, atol=1e-11 * 1e5)
    assert sum_exactly(group, np.zeros(len(values)), 3).tolist() == [0.0, 0.0, 0.0]


# --- the product -----------------------------------------------------------------------------------------


@contextmanager
def chunked(case: Case, **options: Any) -> Iterator[ChunkedSurface]:
    volume = LazyVolume(array=Arranged(case.values), spacing=case.spacing, origin=(1.0, -2.0, 0.5))
    request = replace(case.request, allow_broken=True)
    with smooth_in_chunks(volume, request, threshold=case.threshold, side=32, **options) as surface:
        yield surface


@pytest.mark.parametrize("blur", [0.0, 1.5])
def test_the_surface_is_that_of_smooth_volume_with_its_crumbs_gone(blur: float) -> None:
    case = replace(FITTING, shape=(40, 45, 50), blur=blur, steps=6)
    whole = Whole.of(case)
    surfaced, crumbs = remove_crumbs(whole.surfaced, whole.smoothed)
    data = Volume(values=case.values, spacing=case.spacing, origin=(1.0, -2.0, 0.5))
    expected = place_surface(surfaced.levelled.surface, data)
    request = replace(case.request, allow_broken=True)
    volume = LazyVolume(array=Arranged(case.values), spacing=case.spacing, origin=(1.0, -2.0, 0.5))
    with smooth_in_chunks(volume, request, threshold=case.threshold, side=32) as surface:
        found, report = surface.whole(), surface.report()
    np.testing.assert_array_equal(triangles(found.vertices, found.faces), triangles(expected.vertices, expected.faces))
    assert report["verdict"]["crumbs"]["removed"] == crumbs.count
    assert report["hash"] == hash_surface(expected.vertices, expected.faces)
    assert report["closed"]
    assert found.closed
    shells = surfaced.levelled.shells
    counts = {"components": shells.components, "cavities": shells.cavities, "tunnels": shells.tunnels}
    assert report["topology"]["result"] == {**counts, "euler_number": int(shells.euler.sum())}
    assert report["volume"] == pytest.approx(surfaced.volume, rel=1e-9)
    assert report["area"] == pytest.approx(found.area, rel=1e-9)
    np.testing.assert_allclose(report["bounds"], found.bounds, rtol=1e-12)
    assert report["solid"]["data"] == pytest.approx(float(surfaced.targets.sum()), rel=1e-12)
    assert report["solid"]["level"]["common"] == pytest.approx(surfaced.common, rel=1e-9)


def test_counts_of_the_data_are_those_of_smooth_volume() -> None:
    shell = np.zeros((40, 40, 40), dtype=bool)
    shell[4:30, 4:30, 4:30] = True
    shell[10:24, 10:24, 10:24] = False  # a cavity
    shell[4:30, 33:37, 4:30] = True
    shell[12:18, 30:40, 12:18] = False  # a tunnel
    result = smooth_volume(shell, method="plain", tolerance=None, strict=True, allow_broken=True)
    lazy = smooth_volume(
        dask.array.from_array(shell, chunks=(7, 40, 13)), method="plain", allow_broken=True, tolerance=None
    )
    assert lazy.report["topology"] == result.report["topology"]
    assert lazy.report["topology"]["data"] == {"components": 2, "cavities": 1, "tunnels": 1, "euler_number": 4}
    assert hash_surface(lazy.surface.vertices, lazy.surface.faces) == hash_surface(
        result.surface.vertices, result.surface.faces
    )


@pytest.mark.parametrize("chunks", [(1, 9, 40), ((3, 20, 17), (40,), (39, 1)), -1])
def test_dask_arrays_give_what_arrays_give(chunks: Any) -> None:
    values = replace(FITTING, shape=(40, 40, 40)).values
    lazy = dask.array.from_array(values, chunks=chunks)
    choices: list[dict[str, Any]] = [{"threshold": 128}, {"threshold": "otsu"}, {"label": (130, 131, 132)}]
    for choice in choices[: 3 if chunks == -1 else 1]:
        options: dict[str, Any] = {"method": "plain", "spacing": 0.5, "allow_broken": True, **choice}
        found = smooth_volume(lazy, smoothing=Smoothing(steps=5), tolerance=None, **options)
        whole = smooth_volume(values, smoothing=Smoothing(steps=5), tolerance=None, strict=True, **options)
        assert whole.report["verdict"]["taken"] == "plain"
        assert hash_surface(found.surface.vertices, found.surface.faces) == hash_surface(
            whole.surface.vertices, whole.surface.faces
        )
        rule, other = found.report["input"]["segmentation"], whole.report["input"]["segmentation"]
        assert {**rule} == {**other}


def test_other_methods_read_a_dask_array_whole() -> None:
    values = replace(FITTING, shape=(30, 30, 30)).values > 128
    found, whole = (smooth_volume(array) for array in (dask.array.from_array(values), values))
    np.testing.assert_array_equal(found.surface.vertices, whole.surface.vertices)


def test_workers_and_processes_change_no_bit() -> None:
    case = replace(FITTING, shape=(60, 40, 40))
    hashes = set()
    for options in ({"workers": 1}, {"workers": 3}):
        with chunked(case, **options) as surface:
            hashes.add(surface.report()["hash"])
    assert len(hashes) == 1


def owners_of_views(value: Any) -> Iterator[NDArray[Any]]:
    """Yield arrays that plain data keep in memory and of which they hold only a part."""
    if isinstance(value, np.ndarray):
        if isinstance(value.base, np.ndarray) and value.base.nbytes > value.nbytes:
            yield value.base
    elif is_dataclass(value):
        for item in fields(value):
            yield from owners_of_views(getattr(value, item.name))
    elif isinstance(value, tuple | list):
        for part in value:
            yield from owners_of_views(part)


def test_results_of_tasks_keep_no_larger_arrays() -> None:
    work = replace(FITTING, shape=(40, 40, 40), size=(3, 3, 3)).work()
    items = [(chunk,) for chunk in work.layout]
    direct = [smooth(work, *item) for item in items]
    assert any(True for result in direct for _ in owners_of_views(result)), "views are what this test is about"
    with open_runner(workers=2) as runner:
        results = runner.run(smooth, work, items)
    assert not [owner.nbytes for result in results for owner in owners_of_views(result)]
    assert [digest_data(result) for result in results] == [digest_data(result) for result in direct]


DIRECTED = {"direction": np.diag([-1.0, -1.0, 1.0]), "space": "LPS"}


def test_a_mirrored_grid_is_placed_as_in_memory() -> None:
    case = replace(FITTING, shape=(30, 30, 30))
    place: dict[str, Any] = {"spacing": case.spacing, "origin": (3.0, 1.0, 2.0), "direction": np.diag([1.0, -1.0, 1.0])}
    lazy = LazyVolume(array=Arranged(case.values), **place)
    request = replace(case.request, allow_broken=True)
    with smooth_in_chunks(lazy, request, threshold=case.threshold, side=32) as surface:
        found = surface.whole()
    whole = smooth_volume(
        Volume(values=case.values, **place),
        threshold=case.threshold,
        method="plain",
        smoothing=Smoothing(steps=case.steps),
        tolerance=None,
        strict=True,
        allow_broken=True,
    )
    assert hash_surface(found.vertices, found.faces) == hash_surface(whole.surface.vertices, whole.surface.faces)
    assert found.volume > 0
