"""A run in chunks that ended early goes on where it stopped: nothing is lost, nothing is done twice, the same bytes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from test_chunked_command import PLAIN, gyroid
from test_command_line import refused, run

from infill import ParameterError, Smoothing, smooth_volume
from infill.chunks import solving, surveys, tasks
from infill.chunks.encoding import DamagedDataError, decode_data, digest_data, encode_data
from infill.chunks.joining import ChunkComponents
from infill.chunks.keeping import NOT_KEPT, ResultFolder
from infill.lazy.opening import open_volume
from infill.smoothing import chunk_plans, chunked_surface, chunked_verdict
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.request import SmoothRequest

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

CHUNKS = ("--workers", "1")
SIDE = 70


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A gyroid of several components, so that every kind of pass is run."""
    values = gyroid(SIDE, 30)
    values[:, 33:37] = 0
    path = tmp_path_factory.mktemp("source") / "g.zarr"
    zarr.create_array(str(path), shape=values.shape, chunks=(32, 32, 32), dtype="u1")[:] = values
    return path


@pytest.fixture
def folder(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(chunk_plans, "LARGEST_CELLS", 32)
    (tmp_path / "g.zarr").symlink_to(source)
    return tmp_path


class Calls:
    """Counts calls of the tasks, and ends the run in one of them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.counts: Counter[str] = Counter()
        self.stop_at: tuple[str, int] | None = None
        self.error: type[BaseException] = KeyboardInterrupt
        for module, names in (
            (solving, ("smooth", "try_level", "look_up_components", "rank_shared")),
            (chunked_verdict, ("compare_chunk", "match_chunk")),
            (surveys, ("count_noise",)),
            (chunked_surface, ("make_part",)),
        ):
            for name in names:
                monkeypatch.setattr(module, name, self.counted(getattr(module, name)))

    def counted(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            self.counts[function.__name__] += 1
            if self.stop_at == (function.__name__, self.counts[function.__name__]):
                raise self.error
            return function(*arguments)

        call.__module__, call.__qualname__ = function.__module__, function.__qualname__
        return call


def smooth(*words: str) -> Any:
    return run("smooth", "g.zarr", *PLAIN, *CHUNKS, "--allow-broken", "-q", *words)


@pytest.mark.long
@pytest.mark.parametrize("stop_at", [("smooth", 5), ("try_level", 4), ("try_level", 30), ("make_part", 3)])
def test_an_interrupted_run_goes_on_with_the_same_bytes(
    stop_at: tuple[str, int], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = Calls(monkeypatch)
    assert smooth("-o", "whole.ply").exit_code == 0
    whole = calls.counts
    assert min(whole[name] for name in ("smooth", "try_level", "make_part")) >= 8
    calls.counts, calls.stop_at = Counter(), stop_at
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 130
    first = calls.counts
    assert not Path("a.ply").exists()
    assert Path("kept/manifest.json").is_file()
    calls.counts, calls.stop_at = Counter(), None
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 0
    name, _ = stop_at
    for other in ("smooth", "look_up_components", "try_level", "rank_shared"):
        # Finished tasks are not run again; the one in which the run ended is.
        assert first[other] + calls.counts[other] == whole[other] + (other == name), other
    assert Path("a.ply").read_bytes() == Path("whole.ply").read_bytes()
    assert not Path("kept").exists()


KILLED = """
import os, sys
from infill.chunks import solving
from infill.cli import program
from infill.smoothing import chunk_plans
chunk_plans.LARGEST_CELLS = 32
name, number = sys.argv[1], int(sys.argv[2])
whole, count = getattr(solving, name), 0
def call(*arguments):
    global count
    count += 1
    if count == number:
        os.kill(os.getpid(), 9)
    return whole(*arguments)
call.__module__, call.__qualname__ = whole.__module__, whole.__qualname__
setattr(solving, name, call)
sys.argv = ["infill", "smooth", "g.zarr", *sys.argv[3:]]
program()
"""


@pytest.mark.longest
@pytest.mark.skipif(os.name == "nt", reason="signals are sent in another way")
def test_a_killed_run_goes_on(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = [*PLAIN, *CHUNKS, "-q", "-o", "a.ply", "--resume", "kept"]
    killed = subprocess.run([sys.executable, "-c", KILLED, "try_level", "6", *words], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert not Path("a.ply").exists()
    calls = Calls(monkeypatch)
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 0
    resumed, calls.counts = calls.counts, Counter()
    assert smooth("-o", "whole.ply").exit_code == 0
    assert resumed["smooth"] == 0
    # The fifth had ended, and its result may not have been written yet.
    assert calls.counts["try_level"] - 5 <= resumed["try_level"] <= calls.counts["try_level"] - 4
    assert Path("a.ply").read_bytes() == Path("whole.ply").read_bytes()


@pytest.mark.longest
def test_damaged_files_are_computed_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = Calls(monkeypatch)
    assert smooth("-o", "whole.ply").exit_code == 0
    calls.counts, calls.stop_at = Counter(), ("make_part", 2)
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 130
    fields, results = sorted(Path("kept/fields").iterdir()), sorted(Path("kept/results").rglob("*.kept"))
    for path, at in ((fields[0], -3000), (fields[1], 40), (results[0], -1), (results[1], 30)):
        data = bytearray(path.read_bytes())
        data[at] ^= 8
        path.write_bytes(data)
    fields[2].write_bytes(fields[2].read_bytes()[:900])
    fields[3].unlink()
    results[2].write_bytes(b"")
    calls.counts, calls.stop_at = Counter(), None
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 0
    assert calls.counts.total() - calls.counts["make_part"] == 3
    assert Path("a.ply").read_bytes() == Path("whole.ply").read_bytes()


def begun(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        calls = Calls(patch)
        calls.stop_at = ("make_part", 1)
        assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 130


def test_another_run_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun(monkeypatch)
    resume, remedy = ("-o", "a.ply", "--resume", "kept"), "give the same again, or another folder"
    line = f"--resume is 'kept', which holds a run whose steps is 20, and not 7; {remedy}"
    refused(smooth(*resume, "--steps", "7"), line)
    refused(smooth(*resume, "--threshold", "121"), "a run whose threshold is 120")
    refused(smooth(*resume, "--spacing", "2"), r"a run whose spacing is \(1.0, 1.0, 1.0\), and not \(2.0, 2.0, 2.0\)")
    refused(smooth(*resume, "--roi", "0,60,0,70,0,70"), "a run whose cells is 70 x 70 x 70 of uint8, and not 60 x")
    np.save("other.npy", np.zeros((70, 70, 70), dtype=np.uint8))
    refused(run("smooth", "other.npy", *PLAIN, *resume), "a run whose input is .*g.zarr, and not .*other.npy; give the")
    with monkeypatch.context() as patch:
        patch.setattr("infill.smoothing.work_folders.__version__", "9.9")
        refused(smooth(*resume), "a run whose version is .*, and not 9.9")
    assert smooth(*resume, "--crumbs", "3").exit_code == 0  # decided later than what is kept


def test_a_file_that_changed_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    values = gyroid(SIDE, 30)
    np.save("g.npy", values)
    words = ("smooth", "g.npy", *PLAIN, *CHUNKS, "-q", "-o", "a.ply", "--resume", "kept")
    with monkeypatch.context() as patch:
        Calls(patch).stop_at = ("make_part", 1)
        assert run(*words).exit_code == 130
    np.save("g.npy", values)
    refused(run(*words), "a run whose time of change is .* UTC, and not .* UTC; give the same again")


def test_folders_that_cannot_be_resumed(folder: Path) -> None:
    resume = ("-o", "a.ply", "--resume")
    Path("file").touch()
    Path("full").mkdir()
    Path("full/letter.txt").touch()
    refused(smooth(*resume, "file"), "--resume is 'file', which is not a folder; give another name")
    refused(smooth(*resume, "full"), r"which holds other files \(letter.txt\); give a new or an empty folder")
    refused(smooth(*resume, "none/here"), "there is no folder none; make it first")
    Path("full/manifest.json").write_text("{")
    refused(smooth(*resume, "full"), "whose manifest cannot be read; remove that folder, or give another one")
    Path("empty").mkdir()
    assert smooth(*resume, "empty").exit_code == 0
    assert not Path("empty").exists()
    refused(run("smooth", "g.zarr", "--each-label", "-o", "a.3mf", "--resume", "w"), "--resume is for one surface")


@pytest.mark.longest
@pytest.mark.skipif(os.name == "nt", reason="locks are of another kind")
def test_two_runs_in_one_folder(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import fcntl

    begun(monkeypatch)
    with Path("kept/lock").open("wb") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        refused(smooth("-o", "a.ply", "--resume", "kept"), "in which another run is at work; wait for it")
    assert smooth("-o", "a.ply", "--resume", "kept").exit_code == 0


@pytest.mark.longest
def test_chunks_are_those_of_the_run_that_is_resumed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun(monkeypatch)
    manifest = json.loads(Path("kept/manifest.json").read_text())
    words = ("smooth", "g.zarr", *PLAIN, "--allow-broken", "--json", "-q", "--resume", "kept")
    refused(
        run(*words, "--max-memory", "1M"),
        "--max-memory is 1 MiB, and the chunks of the run that is resumed may take 12; give 12M, or fewer workers",
    )
    report = json.loads(run(*words, "--max-memory", "900M").stdout)
    assert report["chunks"]["cells"] == (np.array(manifest["size"]) * (8, 8, 16)).tolist()


def test_python_resumes(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    options: dict[str, Any] = {"threshold": 120, "method": "plain", "smoothing": Smoothing(steps=6), "tolerance": None}
    calls = Calls(monkeypatch)
    calls.stop_at, calls.error = ("make_part", 1), ZeroDivisionError
    with pytest.raises(ZeroDivisionError):
        smooth_volume(source, resume=tmp_path / "kept", **options)
    smoothed = calls.counts["smooth"]
    calls.stop_at = None
    found = smooth_volume(source, resume=tmp_path / "kept", **options)
    assert calls.counts["smooth"] == smoothed
    expected = smooth_volume(source, **options)
    np.testing.assert_array_equal(found.surface.vertices, expected.surface.vertices)
    np.testing.assert_array_equal(found.surface.faces, expected.surface.faces)
    with pytest.raises(ParameterError, match="resume is for a volume in chunks, a Dask array, Zarr or HDF5; leave it"):
        smooth_volume(np.ones((5, 5, 5), dtype=bool), resume=tmp_path / "kept")


@pytest.mark.longest
def test_processes_resume(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    request = SmoothRequest(method="plain", tolerance=None, allow_broken=True)

    def smoothed(**options: Any) -> str:
        with smooth_in_chunks(open_volume(source), request, threshold=120, side=32, workers=2, **options) as surface:
            return surface.report()["hash"]

    with pytest.raises(ZeroDivisionError), monkeypatch.context() as patch:
        Calls(patch).stop_at = ("rank_shared", 1)
        patch.setattr(chunked_surface.ChunkedSurface, "check", lambda *_: 1 / 0)
        smoothed(resume=tmp_path / "kept")
    assert smoothed(resume=tmp_path / "kept", scheduler="processes") == smoothed()


# --- bytes of results ------------------------------------------------------------------------------------

plain_data = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False)
    | st.text(max_size=5)
    | arrays.arrays(st.sampled_from(["f4", "i8", "?"]), arrays.array_shapes(min_dims=0, min_side=0, max_side=3)).filter(
        lambda array: not np.isnan(array).any()
    ),
    lambda inner: st.lists(inner, max_size=3) | st.tuples(inner, inner) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=8,
)


def same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and a.shape == b.shape and bool((a == b).all())
    if isinstance(a, (list, tuple)):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return list(a) == list(b) and all(same(a[key], b[key]) for key in a)
    return type(a) is type(b) and a == b


@given(value=plain_data)
def test_data_survive(value: Any) -> None:
    data = b"".join(encode_data(value))
    assert same(decode_data(data), value)
    assert digest_data(decode_data(data)) == digest_data(value)


@given(value=plain_data, place=st.integers(0), bit=st.integers(0, 7))
def test_a_changed_bit_is_found(value: Any, place: int, bit: int) -> None:
    data = bytearray(b"".join(encode_data(value)))
    data[place % len(data)] ^= 1 << bit
    with pytest.raises(DamagedDataError):
        decode_data(bytes(data))
    with pytest.raises(DamagedDataError):
        decode_data(bytes(data[:-1]))


def test_dataclasses_survive_and_others_are_not_made(tmp_path: Path) -> None:
    number = np.arange(3)
    survey = ChunkComponents(cells=number, first=number, seen=number, seen_by=number, strange=number, strange_by=number)
    found = decode_data(b"".join(encode_data({"a": survey})))["a"]
    assert isinstance(found, ChunkComponents)
    np.testing.assert_array_equal(found.cells, number)
    with pytest.raises(TypeError, match="cannot encode a set"):
        encode_data({1})
    kept = ResultFolder(tmp_path)
    assert not kept.keep("aa", {1})
    assert kept.find("aa") is NOT_KEPT
    assert kept.keys(tasks.smooth, {1}, [(1,)]) is None
    forged = b"".join(encode_data(survey)).replace(b"infill.chunks.joining", b"shutil.chunks.joining")
    with pytest.raises(DamagedDataError):
        decode_data(forged)
