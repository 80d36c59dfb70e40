"""Labels together in chunks: the same walls between the same labels as in memory, in the same order, to the last bit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import dask.array
import numpy as np
import pytest
import zarr
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from test_command_line import refused, run
from test_lazy_labels import FULL, Arranged
from test_together import voronoi

from infill import Segment, Smoothing, UsageError, Volume, smooth_labels
from infill.chunks import partition_parts
from infill.chunks.layout import ChunkLayout
from infill.chunks.partition_parts import HALO, PartitionWork, open_part, point_places
from infill.chunks.running import Runner
from infill.errors import MemoryLimitError
from infill.kernels.sparse import BRICK
from infill.lazy.dask_arrays import DaskArray
from infill.lazy.volume import LazyVolume
from infill.partition import fields as partition_fields
from infill.partition import volumes as partition_volumes
from infill.partition.walls import SLOTS_AT, Walls, trace_walls
from infill.smoothing import together_chunks
from infill.smoothing.label_stages import field_reach
from infill.smoothing.request import SmoothRequest
from infill.smoothing.together_chunks import field_margin, plan_partition, smooth_together_in_chunks

pytestmark = pytest.mark.usefixtures("silent_compiler")


def noisy(shape: tuple[int, ...], seed: int, share: float) -> NDArray[np.uint8]:
    """Cells of random form, and cells of random labels among them."""
    labels = voronoi(shape, max(2, int(np.prod(shape)) // 3000), seed)  # type: ignore[arg-type]
    random = np.random.default_rng(seed)
    labels[random.random(shape) < share] = 0
    return np.where(random.random(shape) < share, random.integers(0, 4, shape), labels).astype(np.uint8)


def in_chunks(values: NDArray[Any], size: tuple[int, int, int], place: dict[str, Any], **options: Any) -> Any:
    return smooth_together_in_chunks(LazyVolume(array=Arranged(values), **place), size=size, **options)


def require_same(walls: Walls, whole: Walls) -> None:
    """Compare points, triangles, labels and volumes, all in order."""
    assert np.array_equal(walls.points, whole.points)
    for name in ("triangles", "sides"):
        assert np.array_equal(getattr(walls, name), getattr(whole, name))
        assert getattr(walls, name).dtype == getattr(whole, name).dtype
    assert np.array_equal(walls.volumes, whole.volumes)


@pytest.mark.longest
@settings(max_examples=3, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    long=st.integers(0, 2),
    share=st.sampled_from([0.0, 0.0, 0.05]),
    bricks=st.integers(1, 3),
    spacing=st.tuples(*[st.sampled_from([0.5, 0.7])] * 3),
    steps=st.integers(1, 5),
)
@example(seed=2, long=0, share=0.05, bricks=2, spacing=(0.5, 0.7, 0.5), steps=2)
def test_walls_are_those_of_memory_to_the_last_bit(
    seed: int, long: int, share: float, bricks: int, spacing: tuple[float, ...], steps: int
) -> None:
    shape = tuple(np.roll((110, 13, 14), long).tolist())
    values = noisy(shape, seed, share)
    values[tuple(0 if axis == long else slice(None) for axis in range(3))] = 200
    options: dict[str, Any] = {"method": "plain", "smoothing": Smoothing(steps=steps), "tolerance": None}
    size = tuple(bricks if axis == long else 9 for axis in range(3))
    place = {"spacing": spacing, "origin": (1.0, 2.0, 3.0)}
    whole = smooth_labels(values, together=True, **place, **options)
    result = in_chunks(values, size, place, workers=2, **options)  # type: ignore[arg-type]
    assert result.report["chunks"]["count"] > 1
    require_same(result.stages.written, whole.stages.partition.walls)
    assert list(result.surfaces) == list(whole.surfaces)
    for keys, other in zip(result.report["labels"], whole.report["labels"], strict=True):
        assert keys == {name: other[name] for name in keys}
    for name in ("triangles", "closed", "request", "failed", "absent", "rounds"):
        assert result.report[name] == whole.report[name]


@pytest.mark.longest
@pytest.mark.parametrize("method", ["refine", "plain"])
def test_every_way_and_samples_as_of_a_large_volume(method: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(partition_fields, "SAMPLED_BRICKS", 20)
    monkeypatch.setattr(partition_fields, "SAMPLES", 4000)
    monkeypatch.setattr(partition_volumes, "SAMPLED", 2000)
    values = noisy((300, 15, 14), 4, 0.01)
    options: dict[str, Any] = {"method": method, "smoothing": Smoothing(steps=4), "tolerance": None}
    whole = smooth_labels(values, together=True, **options)
    require_same(in_chunks(values, (2, 2, 1), {}, **options).stages.written, whole.stages.partition.walls)


@pytest.mark.slow
def test_a_margin_too_small_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    values = noisy((110, 13, 14), 2, 0.05)
    options: dict[str, Any] = {"method": "plain", "smoothing": Smoothing(steps=60, interface=4.0), "tolerance": None}
    whole = smooth_labels(values, together=True, **options).stages.partition.walls
    monkeypatch.setattr(together_chunks, "field_margin", lambda _: -HALO)  # two bricks are left
    monkeypatch.setattr(partition_parts, "HALO", 8)
    other = in_chunks(values, (1, 9, 9), {}, **options).stages.written
    assert len(other.points) != len(whole.points) or not np.array_equal(other.points, whole.points)


def test_the_fields_of_a_chunk_are_those_of_the_whole(tmp_path: Path) -> None:
    values = noisy((90, 13, 20), 1, 0.02)
    request = SmoothRequest(method="plain", smoothing=Smoothing(steps=5))
    work = PartitionWork(
        source=Arranged(values),
        values=tuple(np.unique(values[values > 0]).tolist()),
        layout=ChunkLayout(shape=values.shape, size=(2, 2, 2), steps=field_margin(request) + HALO),  # type: ignore[arg-type]
        smoothing=request.smoothing,
        plain=True,
        reach=field_reach(2.0),
        spacing=(1.0, 1.0, 1.0),
        scale=(1.0, 1.0, 1.0),
    )
    (chunk,) = ChunkLayout(shape=values.shape, size=(99, 99, 99), steps=1)  # type: ignore[arg-type]
    whole = open_part(work, chunk)
    offsets = np.random.default_rng(0).uniform(-0.2, 0.2, work.count)
    winners = whole.winners(offsets)
    bricks = 0
    for part in work.layout:
        fields = open_part(work, part)
        assert np.array_equal(open_part(_kept_in(work, tmp_path), part).values, fields.values)
        assert np.array_equal(open_part(_kept_in(work, tmp_path), part).values, fields.values)  # from the file
        own = tuple(
            slice(max(low * side - 1, 0), high * side - 1)
            for low, high, side in zip(part.low, part.high, BRICK, strict=True)
        )
        local = tuple(slice(a.start - c, a.stop - c) for a, c in zip(own, fields.corner, strict=True))
        assert np.array_equal(fields.winners(offsets)[local], winners[own])
        assert fields.shape == values.shape
        bricks += len(fields.own_slots()[0])
    assert bricks == len(whole.own_slots()[0]) == len(whole.values)


def _kept_in(work: PartitionWork, folder: Path) -> PartitionWork:
    return PartitionWork(**{**vars(work), "scratch": str(folder)})


def test_points_have_the_names_of_their_places() -> None:
    winners = voronoi((6, 7, 8), 5).astype(np.uint16)
    graph = trace_walls(winners)
    places, slots = point_places(graph, (0, 0, 0))
    names = (places @ [1000 * 1000, 1000, 1]) * 32 + slots
    assert (np.diff(names) > 0).all()  # in the order of points, each once
    assert slots.max() < 32
    assert (slots >= SLOTS_AT[0]).any()
    cubes = places[graph.triangles].min(axis=1)
    assert (np.diff(cubes @ [1000 * 1000, 1000, 1]) >= 0).all()  # triangles are cut cube by cube


def test_labels_that_are_asked_for_names_and_colours() -> None:
    values = noisy((60, 20, 14), 3, 0.0)
    table = (Segment(value=2, name="left", colour=(1.0, 0.5, 0.0)), Segment(value=9, name="none"))
    options: dict[str, Any] = {"label": (2, 1), "table": table, "tolerance": 0, "method": "plain"}
    options["smoothing"] = Smoothing(steps=4)
    result = in_chunks(values, (2, 9, 9), {}, scheduler="threads", **options)
    whole = smooth_labels(values, together=True, **options)
    assert list(result.surfaces) == ["label_1", "left"] == list(whole.surfaces)
    require_same(result.stages.written, whole.stages.written)
    assert result.colours == whole.colours


@pytest.mark.longest
@pytest.mark.slow
def test_processes(tmp_path: Path) -> None:
    values = noisy((60, 20, 14), 3, 0.0)
    volume = LazyVolume(array=DaskArray(dask.array.from_array(values, chunks=(20, 20, 7))))
    options: dict[str, Any] = {"tolerance": None, "method": "plain", "smoothing": Smoothing(steps=4)}
    result = smooth_together_in_chunks(volume, workers=2, scheduler="processes", size=(3, 9, 9), **options)
    require_same(result.stages.written, smooth_labels(values, together=True, **options).stages.written)


# --- plans, and what is refused --------------------------------------------------------------------------


def test_chunks_fit_into_memory() -> None:
    volume = LazyVolume(array=Arranged(np.broadcast_to(np.uint8(1), (700, 600, 900))))
    for memory in (2**31, 2**33):
        request = SmoothRequest(method="plain", max_memory=memory).for_cell(1.0)
        plan = plan_partition(volume, [], request, Runner(workers=2))
        assert len(plan.layout) > 1
        assert plan.memory <= memory
        assert plan.read > 700 * 600 * 900
    assert len(plan_partition(volume, [], request, Runner(workers=2), size=(99, 99, 99)).layout) == 1


def test_what_is_refused() -> None:
    values = noisy((20, 14, 14), 3, 0.0)
    with pytest.raises(UsageError, match="tolerance is not for labels together in chunks, which keep all tri"):
        in_chunks(values, (9, 9, 9), {}, tolerance=0.3)
    with pytest.raises(UsageError, match="level does not go with labels together"):
        in_chunks(values, (9, 9, 9), {}, level=0.1)
    with pytest.raises(MemoryLimitError, match=r"the walls of all labels need about 0\.\d+ GiB .*; give --each-label"):
        in_chunks(values, (9, 9, 9), {}, max_memory=10_000)


# --- the command -----------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    values = noisy((60, 30, 20), 3, 0.0)
    zarr.create_array("a.zarr", shape=values.shape, chunks=(32, 16, 16), dtype="u1", config=FULL)[:] = values
    np.save("a.npy", values)
    return tmp_path


def test_the_command_writes_the_files_of_memory(folder: Path) -> None:
    words = ("--together", "--smooth", "plain", "--tolerance", "0", "-q")
    names = ("{label}.stl", "all.ply", "all.vtp", "all.3mf")
    outputs = [word for name in names for word in ("-o", name)]
    Path("m").mkdir()
    memory = [word for name in names for word in ("-o", f"m/{name}")]
    assert run("smooth", "a.npy", *words, *memory).exit_code == 0
    result = run("smooth", "a.zarr", *words, *outputs, "--workers", "2", "--json")
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["chunks"]["workers"] == 2
    written = sorted(path.name for path in Path("m").iterdir())
    assert len(written) > 6
    for name in written:
        assert Path(name).read_bytes() == Path("m", name).read_bytes()
    text = run("smooth", "a.npy", *words[:-1], "-o", "b.ply", "--workers", "1").stderr
    assert "% of the data" in text
    assert Path("b.ply").read_bytes() == Path("all.ply").read_bytes()


@pytest.mark.longest
def test_a_dry_run(folder: Path) -> None:
    before = set(folder.iterdir())
    words = ("--together", "--smooth", "plain", "--dry-run", "--json")
    plan = json.loads(run("smooth", "a.zarr", *words, "--workers", "2").stdout)
    memory = json.loads(run("smooth", "a.npy", *words).stdout)
    assert plan["labels"] == memory["labels"]
    assert plan["seconds"]["total"] > 0
    assert set(folder.iterdir()) == before


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("a.zarr --together --workers 2 -o a.vtu", "a.vtu is not made in chunks; leave --workers and --sch"),
        ("a.zarr --together --workers 2 --tolerance 0.2 -o a.ply", "--tolerance is not for labels together in chunks"),
        ("a.npy --together --scheduler threads --keep-going -o a.ply", "--keep-going does not go with labels together"),
        ("a.npy --together --workers 1 --frame 2 -o a.3mf", "--frame is 2, and a.npy is read in parts"),
    ],
)
def test_what_the_command_refuses(words: str, says: str, folder: Path) -> None:
    before = set(folder.iterdir())
    refused(run("smooth", *words.split()), says)
    assert set(folder.iterdir()) == before


def test_a_volume_that_is_turned_has_walls_in_its_place() -> None:
    values = noisy((40, 14, 12), 3, 0.0)
    turned = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, -1]])
    place = {"spacing": (0.5, 0.5, 1.0), "origin": (1.0, 2.0, 3.0), "direction": turned, "space": "LPS"}
    options: dict[str, Any] = {"tolerance": None, "method": "plain", "smoothing": Smoothing(steps=4)}
    result = in_chunks(values, (2, 9, 9), place, **options)
    whole = smooth_labels(Volume(values=values, **place), together=True, **options)
    for name, surface in whole.surfaces.items():
        assert np.array_equal(result.surfaces[name].vertices, surface.vertices)
        assert np.array_equal(result.surfaces[name].faces, surface.faces)
    assert np.array_equal(result.stages.walls.points, whole.stages.walls.points)
