"""Labels of volumes that are not in memory: each has the surface, the report and the name that memory gives it."""

from __future__ import annotations

import json
import pickle
import time
import weakref
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import dask.array
import h5py
import numpy as np
import pytest
import trimesh
import zarr
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from test_command_line import refused, run

from infill import ParameterError, Segment, UsageError, Volume, smooth_labels, smooth_volume
from infill.errors import FormatError, GeometryError, MemoryLimitError
from infill.lazy.dask_arrays import DaskArray
from infill.lazy.opening import open_volume
from infill.lazy.volume import LazyVolume, whole_boxes
from infill.smoothing.label_runs import LabelWork
from infill.smoothing.lazy_labels import (
    LabelTask,
    StoredSurfaces,
    name_lazy_pieces,
    plan_lazy_labels,
    smooth_label,
    smooth_lazy_labels,
    split_by_memory,
    survey_labels,
)
from infill.smoothing.request import SmoothRequest
from infill.voxels.label_survey import join_surveys, survey_box
from infill.voxels.labels import is_label_map, label_extents

pytestmark = pytest.mark.usefixtures("silent_compiler")

FULL: Any = {"write_empty_chunks": True}  # a chunk that is missing is worth a warning
PLACE: dict[str, Any] = {"spacing": (0.5, 0.6, 0.7), "origin": (10.0, -20.0, 30.0)}


@dataclass(frozen=True)
class Arranged:
    """An array in memory that is read in boxes, and notes how many cells were read."""

    array: NDArray[Any]
    grain: tuple[int, ...] | None = None
    read_cells: list[int] | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        return self.array.shape

    @property
    def dtype(self) -> np.dtype[Any]:
        return self.array.dtype

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        cells = np.ascontiguousarray(self.array[box])
        if self.read_cells is not None:
            self.read_cells.append(cells.size)
        return cells


def regions(seed: int, shape: tuple[int, ...], labels: int, blur: float) -> NDArray[np.uint8]:
    """Labels in pieces of any form, and cells without one."""
    random = np.random.default_rng(seed)
    noise = np.stack([gaussian_filter(random.normal(size=shape), blur) for _ in range(labels + 1)])
    noise /= noise.std(axis=(1, 2, 3), keepdims=True)
    return noise.argmax(axis=0).astype(np.uint8)


def lazily(values: NDArray[Any], **options: Any) -> LazyVolume:
    return LazyVolume(array=Arranged(values, **options), **PLACE)


def without_times(report: Any) -> Any:
    if isinstance(report, Mapping):
        return {key: without_times(value) for key, value in dict(report).items() if key != "seconds"}
    return [without_times(part) for part in report] if isinstance(report, list) else report


def require_same(result: Any, whole: Any) -> None:
    """Compare surfaces, names and reports to the last bit."""
    assert list(result.surfaces) == list(whole.surfaces)
    for name, surface in whole.surfaces.items():
        assert np.array_equal(result.surfaces[name].vertices, surface.vertices)
        assert np.array_equal(result.surfaces[name].faces, surface.faces)
        assert result.surfaces[name].space == surface.space
    assert json.dumps(without_times(result.report)) == json.dumps(without_times(whole.report))
    assert result.stages.segments == whole.stages.segments
    assert result.stages.failed == whole.stages.failed
    assert result.colours == whole.colours


# --- finding labels --------------------------------------------------------------------------------------


@given(
    seed=st.integers(0, 2**32 - 1),
    shape=st.tuples(*[st.integers(1, 7)] * 3),
    grain=st.tuples(*[st.integers(1, 4)] * 3),
    most=st.integers(1, 60),
    kind=st.sampled_from(["u1", "i2", "i8", "u8", "f4", "?"]),
    lowest=st.sampled_from([0, -2, 70_000]),
)
def test_boxes_find_what_the_whole_holds(
    seed: int, shape: tuple[int, ...], grain: tuple[int, ...], most: int, kind: str, lowest: int
) -> None:
    numbers = np.random.default_rng(seed).integers(0, 4, shape)
    values = np.where(numbers > 0, numbers + lowest, 0) if kind in ("i8", "f4") else numbers
    values = values.astype(kind)
    volume = lazily(values, grain=grain)
    seen = np.zeros(shape, dtype=int)
    for low, high in whole_boxes(volume.array, most):
        assert np.prod(np.subtract(high, low)) <= most
        seen[tuple(map(slice, low, high))] += 1
    assert (seen == 1).all()
    survey = survey_labels(volume, None, 2, most=most)
    assert survey.extents == label_extents(Volume(values=values))
    assert survey.is_label_map(shape[0] * shape[1]) == is_label_map(Volume(values=values))


def test_values_that_are_no_labels() -> None:
    with pytest.raises(ParameterError, match="not whole numbers, and so not labels; give --threshold X"):
        smooth_lazy_labels(lazily(np.linspace(0, 1, 27).reshape(3, 3, 3)))
    with pytest.raises(ParameterError, match="over 4096 values, more than the labels"):
        smooth_lazy_labels(lazily(np.arange(20**3, dtype=np.int32).reshape(20, 20, 20)))
    halves = [survey_box(part, (0, 0, 0)) for part in np.arange(2 * 17**3).reshape(2, 17, 17, 17)[:, :9]]
    with pytest.raises(ParameterError, match="over 4096 values"):
        join_surveys(halves)
    grey = np.random.default_rng(0).integers(0, 200, (12, 12, 12), dtype=np.uint8)
    for most in (10**6, 100):
        with pytest.raises(ParameterError, match="change from voxel to voxel, as grey levels do"):
            smooth_lazy_labels(lazily(grey), most=most)
    with pytest.raises(ParameterError, match="holds no label, only 0"):
        smooth_lazy_labels(lazily(np.zeros((5, 5, 5), np.uint8)))
    with pytest.raises(ParameterError, match="label is 9, and the volume holds 1; give one that is there"):
        smooth_lazy_labels(lazily(np.ones((5, 5, 5), np.uint8)), label=9)


# --- smoothing -------------------------------------------------------------------------------------------


@pytest.mark.longest
@settings(max_examples=6, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    shape=st.tuples(*[st.integers(20, 44)] * 3),
    labels=st.integers(1, 4),
    chunks=st.tuples(*[st.integers(5, 50)] * 3),
    most=st.sampled_from([300, 5000, 10**6]),
    method=st.sampled_from(["auto", "plain"]),
)
@example(seed=1, shape=(40, 30, 33), labels=4, chunks=(7, 11, 9), most=900, method="auto")
def test_every_label_is_that_of_memory_to_the_last_bit(
    seed: int, shape: tuple[int, ...], labels: int, chunks: tuple[int, ...], most: int, method: Any
) -> None:
    values = regions(seed, shape, labels, 3.0)
    values[0, 0, 0] = 9
    options: dict[str, Any] = {"method": method, "allow_broken": True, "keep_going": True}
    try:
        whole = smooth_labels(values, **PLACE, **options)
    except GeometryError:
        return
    volume = LazyVolume(array=DaskArray(dask.array.from_array(values, chunks=chunks)), **PLACE)
    require_same(smooth_lazy_labels(volume, most=most, **options), whole)


@pytest.fixture(scope="module")
def balls() -> NDArray[np.uint16]:
    """Three balls far apart, two of which touch each other."""
    values = np.zeros((120, 40, 44), dtype=np.uint16)
    for number, middle in ((7, (15, 15, 20)), (300, (35, 20, 24)), (2, (100, 20, 20))):
        distance = ((np.indices(values.shape) - np.reshape(middle, (3, 1, 1, 1))) ** 2).sum(axis=0)
        values[(distance < 120) & (values == 0)] = number
    return values


TABLE = (Segment(value=7, name="left", colour=(1.0, 0.5, 0.0)), Segment(value=2, name="right"))


@pytest.mark.parametrize("form", ["v3.zarr", "a.h5", "a.npy"])
def test_labels_of_files(form: str, balls: NDArray[np.uint16], tmp_path: Path) -> None:
    path = tmp_path / form
    if form.endswith("zarr"):
        zarr.create_array(str(path), shape=balls.shape, chunks=(32, 16, 16), dtype="u2", config=FULL)[:] = balls
    elif form.endswith("h5"):
        with h5py.File(path, "w") as file:
            file.create_dataset("a", data=balls, chunks=(16, 40, 10))
    else:
        np.save(path, balls)
    whole = smooth_labels(balls, table=TABLE, spacing=0.5)
    result = smooth_lazy_labels(open_volume(path, spacing=0.5), table=TABLE, most=10_000)
    require_same(result, whole)
    assert list(result.surfaces) == ["right", "left", "label_300"]
    if form != "a.npy":
        require_same(smooth_labels(path, table=TABLE, spacing=0.5), whole)


def test_a_dask_array(balls: NDArray[np.uint16]) -> None:
    array: Any = dask.array.from_array(balls, chunks=(50, 20, 44))
    require_same(smooth_labels(array, label=(2, 300), **PLACE), smooth_labels(balls, label=(2, 300), **PLACE))
    options: dict[str, Any] = {"together": True, "method": "plain", "tolerance": None, **PLACE}
    together, whole = smooth_labels(array, **options), smooth_labels(balls, **options)
    assert np.array_equal(together.stages.written.points, whole.stages.written.points)
    with pytest.raises(UsageError, match="keep_going does not go with labels together"):
        smooth_labels(array, together=True, keep_going=True)


@pytest.mark.long
@pytest.mark.parametrize("scheduler", ["threads", pytest.param("processes", marks=pytest.mark.slow)])
def test_tasks_of_dask(scheduler: str, balls: NDArray[np.uint16], tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    zarr.create_array(str(path), shape=balls.shape, chunks=(32, 16, 16), dtype="u2", config=FULL)[:] = balls
    heard: list[float] = []
    result = smooth_lazy_labels(
        open_volume(path), workers=2, scheduler=scheduler, progress=lambda _, share: heard.append(share)
    )
    require_same(result, smooth_labels(balls))
    assert heard == sorted(heard)
    assert heard[-1] > 0.8


@pytest.mark.slow
def test_a_cluster(balls: NDArray[np.uint16]) -> None:
    distributed = pytest.importorskip("distributed")
    array: Any = dask.array.from_array(balls, chunks=(50, 20, 44))
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster),
    ):
        require_same(smooth_labels(array), smooth_labels(balls))


def test_a_machine_without_the_folder_sends_the_surface_back(balls: NDArray[np.uint16]) -> None:
    volume, request = lazily(balls), SmoothRequest()
    (piece, *_) = name_lazy_pieces(volume, survey_labels(volume, None, 1), (), None, ())
    task = LabelTask(volume=volume, request=request, options={}, folder="/nowhere")
    smoothed = pickle.loads(pickle.dumps(smooth_label(task, piece)))
    assert np.array_equal(smoothed.surface.faces, smooth_labels(balls, label=2, **PLACE).surface.faces)


def test_only_the_parts_of_labels_are_read(balls: NDArray[np.uint16]) -> None:
    read: list[int] = []
    smooth_lazy_labels(lazily(balls, grain=(8, 40, 44), read_cells=read), label=2, most=20_000)
    assert max(read) < balls.size / 2
    assert sum(read[:-1]) == balls.size  # each cell once, to find the labels


def test_surfaces_are_not_in_memory_at_once(balls: NDArray[np.uint16]) -> None:
    result = smooth_lazy_labels(lazily(balls))
    assert isinstance(result.surfaces, StoredSurfaces)
    assert repr(result.surfaces) == "StoredSurfaces(label_2, label_7, label_300)"
    folder = Path(result.surfaces.folder.name)
    assert len(list(folder.iterdir())) == 9
    surface = result.surfaces["label_7"]
    assert result.surfaces["label_7"] is surface
    used = weakref.ref(surface)
    del surface
    assert used() is None
    del result
    assert not folder.exists()


def test_an_error_names_the_label() -> None:
    values = np.zeros((30, 30, 30), np.uint8)
    values[4:12, 4:12, 4:12], values[20, 20, 20] = 1, 5
    options: dict[str, Any] = {"despeckle": 3.0, "table": [Segment(value=5, name="speck")]}
    for form in ({}, {"workers": 1}):
        with pytest.raises(ParameterError, match=r"^label 5 \(speck\): "):
            smooth_lazy_labels(lazily(values), **form, **options)
        result = smooth_lazy_labels(lazily(values), keep_going=True, **form, **options)
        require_same(result, smooth_labels(values, keep_going=True, **PLACE, **options))
        assert list(result.stages.failed) == ["speck"]


# --- memory ----------------------------------------------------------------------------------------------


def test_a_label_that_does_not_fit_is_named_or_smoothed_in_chunks(balls: NDArray[np.uint16]) -> None:
    needed = plan_lazy_labels(lazily(balls), begin=time.perf_counter(), method="plain")["memory"] - 300_000_000
    with pytest.raises(MemoryLimitError, match=r"^label 2: its part of the volume, \d+ x 40 x 44 voxels, needs about"):
        smooth_lazy_labels(lazily(balls), max_memory=needed // 2, max_triangles=5000)
    with pytest.raises(
        MemoryLimitError, match="in chunks, but max_triangles is not for a volume in chunks; give a tolerance instead"
    ):
        plan_lazy_labels(lazily(balls), begin=time.perf_counter(), max_memory=needed // 2, max_triangles=5000)
    options: dict[str, Any] = {"method": "plain", "tolerance": None, "max_memory": needed // 2}
    result = smooth_lazy_labels(lazily(balls), **options)
    for name, surface in result.surfaces.items():
        whole = smooth_volume(balls, label=int(name[6:]), method="plain", tolerance=None, **PLACE).surface
        assert len(surface.faces) == len(whole.faces)
        assert surface.volume == pytest.approx(whole.volume, rel=1e-12)
        assert surface.closed
    for keys in result.report["labels"]:
        assert "chunks" in keys["report"]


def test_labels_that_run_beside_each_other_fit_into_memory() -> None:
    works = [LabelWork(cells=1, memory=memory) for memory in (3, 8, 3, 5, 1, 1)]
    parts = list(split_by_memory(works, 4, 10))
    assert sorted(number for part, _ in parts for number in part) == list(range(6))
    for part, beside in parts:
        assert beside * max(works[number].memory for number in part) <= 10
    assert list(split_by_memory(works, 2, None)) == [([1, 3, 0, 2, 4, 5], 2)]


# --- the command -----------------------------------------------------------------------------------------


@pytest.fixture
def folder(balls: NDArray[np.uint16], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    zarr.create_array("a.zarr", shape=balls.shape, chunks=(32, 16, 16), dtype="u2", config=FULL)[:] = balls
    np.save("a.npy", balls)
    Path("names.txt").write_text("2 right 255 0 0 255\n7 left 0 255 0 255\n")
    return tmp_path


def test_the_command_writes_the_files_of_memory(folder: Path) -> None:
    words = ("--spacing", "0.5", "--labels", "names.txt", "-q", "-o", "{label}.stl", "-o", "all.3mf", "-o", "all.glb")
    Path("m").mkdir()
    memory = run("smooth", "a.npy", *words[:-6], "-o", "m/{label}.stl", "-o", "m/all.3mf", "-o", "m/all.glb")
    assert memory.exit_code == 0
    for source, form in (("a.zarr", ()), ("a.npy", ("--workers", "2"))):
        result = run("smooth", source, *form, *words, "--force", "--json")
        assert result.exit_code == 0, result.stderr
        assert json.loads(result.stdout)["labels"][0]["name"] == "right"
        for name in ("right.stl", "left.stl", "label_300.stl", "all.3mf", "all.glb"):
            assert Path(name).read_bytes() == Path("m", name).read_bytes()


def test_a_part_of_the_volume(folder: Path) -> None:
    words = ("--roi", "0,60,0,40,0,44", "-q", "-o")
    assert run("smooth", "a.zarr", *words, "{label}.ply").exit_code == 0
    assert run("smooth", "a.npy", *words, "m_{label}.ply").exit_code == 0
    assert sorted(path.name for path in folder.glob("label_*.ply")) == ["label_300.ply", "label_7.ply"]
    for name in ("label_7.ply", "label_300.ply"):
        assert Path(name).read_bytes() == Path(f"m_{name}").read_bytes()


def test_a_dry_run_lists_labels_and_files(folder: Path) -> None:
    before = set(folder.iterdir())
    result = run("smooth", "a.zarr", "--each-label", "-o", "{label}.stl", "--dry-run", "--json")
    plan, memory = (
        json.loads(result.stdout),
        json.loads(run("smooth", "a.npy", "--each-label", "--dry-run", "--json").stdout),
    )
    assert plan["labels"] == memory["labels"]
    assert plan["files"] == ["label_2.stl", "label_7.stl", "label_300.stl"]
    text = run("smooth", "a.zarr", "--each-label", "-o", "a.3mf", "--workers", "1", "--dry-run").stdout
    assert "nothing is written" in text
    assert set(folder.iterdir()) == before


def test_together_reads_all_of_a_zarr(folder: Path) -> None:
    assert run("smooth", "a.zarr", "--together", "-q", "-o", "z.ply").exit_code == 0
    assert run("smooth", "a.npy", "--together", "-q", "-o", "m.ply").exit_code == 0
    assert Path("z.ply").read_bytes() == Path("m.ply").read_bytes()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("a.zarr --each-label --hash -o a.3mf", "--hash is for one surface"),
        ("a.npy --each-label --workers 0 -o a.3mf", "--workers is 0"),
        ("a.npy --each-label --workers 1 --frame 2 -o a.3mf", "--frame is 2, and a.npy is read in parts"),
        ("a.zarr --each-label --as mesh -o a.3mf", "--as is 'mesh', and a.zarr is read in parts"),
        ("none.zarr --each-label -o a.3mf", "there is no none.zarr"),
        ("a.zarr --each-label --threshold 2 -o a.3mf", "--threshold does not go with --each-label"),
    ],
)
def test_what_is_refused(words: str, says: str, folder: Path) -> None:
    before = set(folder.iterdir())
    refused(run("smooth", *words.split()), says)
    assert set(folder.iterdir()) == before


def test_a_chunk_that_is_damaged(folder: Path) -> None:
    Path("a.zarr/c/1/0/1").write_bytes(b"no chunk")
    result = run("smooth", "a.zarr", "--each-label", "-o", "a.3mf", "-q")
    refused(result, "is damaged: its cells")
    assert not Path("a.3mf").exists()
    with pytest.raises(FormatError, match="is damaged"):
        smooth_labels("a.zarr")


def test_meshes_of_the_command_are_closed(folder: Path) -> None:
    assert run("smooth", "a.zarr", "--each-label", "-o", "{number}.stl", "-q", "--smooth", "plain").exit_code == 0
    for number in (2, 7, 300):
        assert trimesh.load_mesh(f"{number}.stl").is_watertight
