"""`infill smooth` on volumes in chunks: files, hash, plan, workers, and one clear line for every fault."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import dask.array
import manifold3d
import numpy as np
import pytest
import zarr
from test_command_line import refused, run

from infill import InfillError, MemoryLimitError, ParameterError, Smoothing, read_mesh, smooth_volume
from infill.chunks import running
from infill.chunks.hashing import hash_surface
from infill.chunks.running import open_runner
from infill.lazy.opening import open_volume
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.request import SmoothRequest

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

SIDE = 50


def gyroid(side: int, period: float) -> np.ndarray[Any, np.dtype[np.uint8]]:
    x, y, z = np.indices((side, side, side), dtype=np.float32) * np.float32(2 * np.pi / period)
    level = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    return np.clip(128 + 80 * level, 0, 255).astype(np.uint8)


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A gyroid as .zarr and as .npy, and a mask."""
    folder = tmp_path_factory.mktemp("inputs")
    values = gyroid(SIDE, 30)
    array = zarr.create_array(str(folder / "g.zarr"), shape=values.shape, chunks=(32, 32, 32), dtype="u1")
    array[:] = values
    np.save(folder / "g.npy", values)
    np.save(folder / "mask.npy", values > 120)
    np.save(folder / "labels.npy", (values // 64).astype(np.uint8))
    return folder


@pytest.fixture
def folder(inputs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for path in inputs.iterdir():
        (tmp_path / path.name).symlink_to(path)
    return tmp_path


PLAIN = ("--threshold", "120", "--smooth", "plain", "--tolerance", "0")


def test_files_hash_and_report_are_those_of_memory(folder: Path) -> None:
    done = run(
        "smooth", "g.zarr", *PLAIN, "-o", "a.ply", "-o", "a.stl", "-o", "a.obj", "--json", "-q", "--workers", "2"
    )
    assert done.exit_code == 0, done.output
    report = json.loads(done.stdout)
    done = run(
        "smooth",
        "g.npy",
        *PLAIN,
        "-o",
        "b.ply",
        "-o",
        "b.obj",
        "--hash",
        "-q",
        "--strict",
        "--allow-broken",
    )
    assert done.exit_code == 0, done.output
    assert done.stdout == f"{report['hash']}\n"
    for name in ("a.ply", "a.stl", "a.obj"):
        mesh = read_mesh(name)
        assert mesh.closed
        assert len(mesh.faces) == report["triangles"]
        # Coordinates are rounded to 32 bits, of which a cell has 2^17.
        assert mesh.volume == pytest.approx(report["volume"], rel=1e-5)
    assert Path("a.ply").stat().st_size == Path("b.ply").stat().st_size
    assert sorted(Path("a.obj").read_text().splitlines()[2:2000]) != []
    assert report["files"] == ["a.ply", "a.stl", "a.obj"]
    assert report["closed"]


@pytest.mark.longest
def test_rows_of_obj_are_those_of_memory(folder: Path) -> None:
    run("smooth", "g.zarr", *PLAIN, "-o", "a.obj", "-q")
    run("smooth", "g.npy", *PLAIN, "-o", "b.obj", "-q", "--strict", "--allow-broken")
    rows = [
        sorted(line for line in Path(name).read_text().splitlines() if line.startswith("v"))
        for name in ("a.obj", "b.obj")
    ]
    assert rows[0] == rows[1]


@pytest.mark.long
@pytest.mark.parametrize("choice", [("--otsu",), ("--range", "90,160"), ("--label", "131", "--label", "132")])
def test_choices_of_the_solid(choice: tuple[str, ...], folder: Path) -> None:
    extra = ("--smooth", "plain", "--allow-broken", "--hash", "-q", *choice)
    chunks = run("smooth", "g.npy", "--workers", "1", *extra)
    whole = run("smooth", "g.npy", "--tolerance", "0", "--strict", *extra)
    assert chunks.exit_code == whole.exit_code == 0, chunks.output + whole.output
    assert chunks.stdout == whole.stdout


def test_a_mask_and_a_box(folder: Path) -> None:
    options = ("--smooth", "plain", "--hash", "-q", "--allow-broken", "--roi", "5,41,10,50,3,40", "--spacing", "1")
    chunks = run("smooth", "mask.npy", "--workers", "2", *options)
    whole = run("smooth", "mask.npy", "--tolerance", "0", "--strict", *options)
    assert chunks.exit_code == 0, chunks.output
    assert chunks.stdout == whole.stdout


@pytest.mark.longest
def test_other_methods_read_zarr_whole(folder: Path) -> None:
    hashes = [run("smooth", name, "--threshold", "120", "--hash", "-q").stdout for name in ("g.zarr", "g.npy")]
    assert hashes[0] == hashes[1] != ""


def test_the_field_is_written_as_zarr(folder: Path) -> None:
    assert run("smooth", "g.zarr", *PLAIN, "-o", "f.zarr", "-q").exit_code == 0
    assert run("smooth", "g.npy", *PLAIN, "-o", "f.npz", "-q", "--strict", "--allow-broken").exit_code == 0
    np.testing.assert_array_equal(open_volume("f.zarr").load().values, np.load("f.npz")["values"])
    refused(run("smooth", "g.zarr", *PLAIN, "-o", "f.zarr"), "f.zarr exists; give another name, or --force")
    refused(run("smooth", "g.zarr", *PLAIN, "-o", "new.zarr", "-o", "./new.zarr"), "new.zarr is named twice")
    assert run("smooth", "g.zarr", *PLAIN, "-o", "f.zarr", "-q", "--force").exit_code == 0


def test_a_dry_run_tells_the_cost(folder: Path) -> None:
    done = run("smooth", "g.zarr", *PLAIN, "-o", "a.ply", "--dry-run")
    assert done.exit_code == 0, done.output
    assert "nothing is written (--dry-run)" in done.stdout
    plan = json.loads(run("smooth", "g.zarr", *PLAIN, "-o", "a.ply", "--dry-run", "--json").stdout)
    report = json.loads(run("smooth", "g.zarr", *PLAIN, "--json", "-q").stdout)
    assert plan["chunks"] == report["chunks"]["count"]
    assert plan["files"] == ["a.ply"]
    assert plan["triangles"] == pytest.approx(report["triangles"], rel=0.7)
    assert plan["read"] >= SIDE**3
    assert plan["seconds"]["total"] > 0
    assert plan["memory_per_worker"] * 2 >= plan["memory"]
    assert plan["tasks"] > 5 * plan["chunks"]
    assert plan["sent"] > 1000 * plan["chunks"]
    hours = [fleet["hours"] for fleet in plan["hours"]]
    assert [fleet["workers"] for fleet in plan["hours"]] == [1, 10, 100]
    assert hours == sorted(hours, reverse=True)
    assert not Path("a.ply").exists()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (
            (*PLAIN[:4], "--tolerance", "2"),
            "--tolerance is 2 mm, and a volume in chunks is simplified by at most a voxel",
        ),
        ((*PLAIN, "--max-triangles", "9"), "--max-triangles is not for a volume in chunks; give a tolerance instead"),
        ((*PLAIN, "--voxel", "2"), "--voxel is not for a volume in chunks; leave it out"),
        ((*PLAIN, "--preview", "a.png"), "--preview is not for a volume in chunks; leave it out"),
        ((*PLAIN, "--workers", "0"), "--workers is 0"),
        ((*PLAIN, "--scheduler", "tcp://127.0.0.1:9"), "--scheduler is 'tcp://127.0.0.1:9', and nothing answers there"),
        ((*PLAIN, "--spacing", "1,1,5"), "slices 5 times as thick as its cells are wide"),
        ((*PLAIN[:1], "250", *PLAIN[2:]), "--threshold leaves no cell solid; the values go from"),
        (("--smooth", "plain"), "do not say what is solid; give --threshold X, --range LOW,HIGH"),
        ((*PLAIN, "--otsu"), "--threshold and --otsu exclude each other"),
    ],
)
def test_what_a_volume_in_chunks_refuses(
    words: tuple[str, ...], says: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running, "CONNECTING", 1)
    before = set(folder.iterdir())
    refused(run("smooth", "g.zarr", "-o", "a.ply", *words), says)
    assert set(folder.iterdir()) == before


@pytest.mark.parametrize(
    ("name", "words", "says"),
    [
        ("labels.npy", ("--smooth", "plain", "--workers", "1"), "do not say what is solid"),
        ("g.zarr", (*PLAIN, "--hash", "-o", "-"), "'-' is stdout, and a volume in chunks is written piece by piece"),
        ("g.zarr", (*PLAIN, "-o", "a.3mf"), "cannot be written piece by piece"),
        (
            "g.zarr",
            (*PLAIN, "--each-label", "-o", "a.3mf", "--workers", "1"),
            "--threshold does not go with --each-label",
        ),
        ("g.zarr", (*PLAIN, "--ascii", "-o", "a.stl"), "--ascii is not for a volume in chunks"),
        ("g.zarr", ("--each-label", "-o", "a.3mf"), "change from voxel to voxel, as grey levels do, and not labels"),
    ],
)
def test_what_else_is_refused(name: str, words: tuple[str, ...], says: str, folder: Path) -> None:
    before = set(folder.iterdir())
    out = () if "-o" in words else ("-o", "a.ply")
    refused(run("smooth", name, *out, *words), says)
    assert set(folder.iterdir()) == before


# --- faults ----------------------------------------------------------------------------------------------


def test_a_corrupt_chunk_is_one_line_and_leaves_nothing(folder: Path) -> None:
    array = zarr.create_array("bad.zarr", shape=(64, 64, 64), chunks=(32, 32, 32), dtype="u1")
    array[:] = gyroid(64, 30)
    Path("bad.zarr/c/1/0/1").write_bytes(b"no chunk")
    before = set(folder.iterdir())
    refused(run("smooth", "bad.zarr", *PLAIN, "-o", "a.ply", "-q"), "bad.zarr is damaged: its cells .* cannot be read")
    assert set(folder.iterdir()) == before


def test_values_that_are_not_finite(folder: Path) -> None:
    values = gyroid(40, 30).astype(np.float32)
    values[30, 3, 3] = np.nan
    np.save("nan.npy", values)
    refused(run("smooth", "nan.npy", *PLAIN, "--workers", "1", "-o", "a.ply", "-q"), "holds NaN or infinite values")


def test_without_the_extra_a_line_says_how_to_get_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running, "find_spec", lambda name: None)
    refused(
        run("smooth", "g.npy", *PLAIN, "--workers", "2", "-o", "a.ply"),
        r"needs the extra scale: pip install dask distributed fsspec h5py zarr$",
    )


def test_a_disk_that_is_full_leaves_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.formats.mesh_pieces import PlyPieces

    def fail(self: object, piece: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(PlyPieces, "add", fail)
    before = set(folder.iterdir())
    refused(run("smooth", "g.zarr", *PLAIN, "-o", "a.ply", "-q"), "cannot write a.ply: the disk is full")
    assert set(folder.iterdir()) == before


class Dying:
    """A source whose cells end the process that reads them."""

    shape, dtype = (64, 64, 64), np.dtype("u1")

    def __init__(self, parent: int) -> None:
        self.parent = parent

    def read(self, box: tuple[slice, ...]) -> Any:
        if os.getpid() != self.parent and box[0].start:
            os._exit(9)
        return gyroid(64, 30)[box]


@pytest.mark.long
@pytest.mark.parametrize("where", ["processes"])
def test_a_worker_that_dies_is_one_line(where: str) -> None:
    from infill.lazy.volume import LazyVolume

    volume = LazyVolume(array=Dying(os.getpid()))
    request = SmoothRequest(method="plain", smoothing=Smoothing(steps=2), tolerance=None)
    with (
        pytest.raises(MemoryLimitError, match="a worker ended before its chunk was done"),
        smooth_in_chunks(volume, request, threshold=120, workers=1, scheduler=where, side=32),
    ):
        pass


SCRIPT = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from infill.chunks import tasks
from infill.cli import program
whole = tasks.make_part
import infill.smoothing.chunked_surface as surface
def slow(*words):
    import time
    print("writing", flush=True)
    time.sleep(60)
surface.make_part = slow
sys.argv = ["infill", "smooth", "g.zarr", "--threshold", "120", "--smooth", "plain", "--tolerance", "0", "-o", "a.ply", "-q"]
program()
"""


@pytest.mark.skipif(os.name == "nt", reason="signals are sent in another way")
def test_an_interrupt_leaves_no_half_written_file(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    scratch = tmp_path_factory.mktemp("scratch")
    before = set(folder.iterdir())
    environment = {**os.environ, "TMPDIR": str(scratch)}
    with subprocess.Popen(
        [sys.executable, "-c", SCRIPT], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline() == "writing\n"
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=30) == 130
        assert time.monotonic() - begin < 20  # the task would take a minute
        assert process.stderr.read().count("\n") <= 1
    assert set(folder.iterdir()) == before
    assert not list(scratch.iterdir())


# --- processes and clusters ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def whole_hash() -> str:
    options: dict[str, Any] = {"method": "plain", "tolerance": None, "strict": True, "allow_broken": True}
    surface = smooth_volume(gyroid(SIDE, 30), threshold=120, smoothing=Smoothing(steps=6), **options).surface
    return hash_surface(surface.vertices, surface.faces)


def chunked_hash(inputs: Path, **options: Any) -> str:
    request = SmoothRequest(method="plain", smoothing=Smoothing(steps=6), tolerance=None)
    with smooth_in_chunks(open_volume(inputs / "g.zarr"), request, threshold=120, side=32, **options) as surface:
        return surface.report()["hash"]


@pytest.mark.longest
@pytest.mark.parametrize(
    "options", [{"scheduler": "processes", "workers": 2}, {"scheduler": "processes", "workers": 1}]
)
def test_processes_change_no_bit(options: dict[str, Any], inputs: Path, whole_hash: str) -> None:
    assert chunked_hash(inputs, **options) == whole_hash


@pytest.fixture
def cluster() -> Iterator[Any]:
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, memory_limit=0) as local:
        yield local


@pytest.mark.longest
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_changes_no_bit(cluster: Any, inputs: Path, whole_hash: str) -> None:
    from distributed import Client

    assert chunked_hash(inputs, scheduler=cluster.scheduler_address) == whole_hash
    with pytest.raises(ParameterError, match="workers is for this machine alone, and a cluster has its own"):
        chunked_hash(inputs, scheduler=cluster.scheduler_address, workers=2)
    with Client(cluster):  # the current client
        values = dask.array.from_zarr(str(inputs / "g.zarr"))
        found = smooth_volume(
            values, threshold=120, method="plain", smoothing=Smoothing(steps=6), tolerance=None
        ).surface
        with pytest.raises(
            ParameterError, match="is persisted on a cluster, where tasks cannot read it; leave persist"
        ):
            smooth_volume(values.persist() + 1, threshold=120, method="plain")
    assert hash_surface(found.vertices, found.faces) == whole_hash


@pytest.mark.longest
@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_goes_away_is_one_line(inputs: Path, cluster: Any) -> None:
    with open_runner(scheduler=cluster.scheduler_address) as runner:
        cluster.close()
        with pytest.raises(InfillError, match="the scheduler of the cluster does not answer"):
            runner.run(print, "hello", [("there",)])


@pytest.mark.longest
@pytest.mark.parametrize("workers", [1, 2])
def test_sixty_four_chunks_are_closed(workers: int, tmp_path: Path) -> None:
    values = gyroid(200, 37)
    array = zarr.create_array(str(tmp_path / "g.zarr"), shape=values.shape, chunks=(50, 64, 41), dtype="u1")
    array[:] = values
    request = SmoothRequest(method="plain", tolerance=None)
    with smooth_in_chunks(
        open_volume(tmp_path / "g.zarr"), request, threshold=120, workers=workers, side=64
    ) as surface:
        assert len(surface.plan.layout) == 64
        whole, report = surface.whole(), surface.report()
    mesh = manifold3d.Mesh(
        vert_properties=np.asarray(whole.vertices, dtype=np.float32), tri_verts=np.asarray(whole.faces, dtype=np.uint32)
    )
    solid = manifold3d.Manifold(mesh)
    assert solid.status() == manifold3d.Error.NoError
    # 32-bit coordinates of 200 cells
    assert solid.volume() == pytest.approx(report["volume"], rel=1e-5)
    assert report["closed"]


def test_an_array_that_is_written_anew_is_read_anew(tmp_path: Path) -> None:
    for side in (20, 12):
        array = zarr.create_array(
            str(tmp_path / "g.zarr"), shape=(side,) * 3, chunks=(8,) * 3, dtype="u1", overwrite=True
        )
        array[:] = side
        volume = open_volume(tmp_path / "g.zarr")
        assert volume.array.read((slice(0, side),) * 3).tolist() == np.full((side,) * 3, side).tolist()
