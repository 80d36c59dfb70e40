"""Compiling is told once in a process, only where something is compiled, and only once for what is one kind of input."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import threading
from pathlib import Path

import numba
import numpy as np
import pytest
import trimesh

from infill import smooth_volume
from infill.kernels import compiling, second_compiler
from infill.kernels.compiling import log_compilation, njit
from infill.meshes.compile_simplification import make_ring
from infill.meshes.measuring import volume_and_area
from infill.meshes.shells import shell_volumes, vertex_components
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import smooth_bricks
from infill.surface import Surface

KERNELS = Path(compiling.__file__).parent
MODULE = """
from infill.kernels.compiling import njit, log_compilation

@njit(cache=True)
def one(x): return x + 1

@njit(cache=True)
def two(x): return x * 2

with log_compilation("nothing"):
    pass
for what, kernel in (("one", one), ("two", two), ("one", one)):
    with log_compilation(what):
        kernel(3)
with log_compilation("one for other numbers"):
    one(0.5)
"""


@pytest.mark.longest
def test_compiling_is_told_once_in_a_process(tmp_path: Path) -> None:
    (tmp_path / "kernels.py").write_text(MODULE)
    root = str(Path(__file__).resolve().parents[1])
    environment = {
        **os.environ,
        "NUMBA_CACHE_DIR": str(tmp_path / "cache"),
        "PYTHONPATH": f"{root}{os.pathsep}{tmp_path}",
    }
    first, second = (
        subprocess.run(
            [sys.executable, "-c", "import kernels"],
            env=environment,
            capture_output=True,
            encoding="utf-8",
            check=True,
        )
        for _ in range(2)
    )
    assert first.stderr == "preparing one for input of this kind, up to a minute, the first time\n"
    assert second.stderr == ""  # found compiled


FULL_DISK = """
import resource
resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
from kernels import one, two
print(one(3), two(3), one(0.5))
"""


def test_code_that_the_disk_has_no_room_for_runs_all_the_same(tmp_path: Path) -> None:
    pytest.importorskip("resource", reason="limits of a process are asked of POSIX")
    (tmp_path / "kernels.py").write_text(MODULE)
    root = str(Path(__file__).resolve().parents[1])
    kept = tmp_path / "cache"
    environment = {
        **os.environ,
        "NUMBA_CACHE_DIR": str(kept),
        "PYTHONPATH": f"{root}{os.pathsep}{tmp_path}",
        "PYTHONDONTWRITEBYTECODE": "1",  # Python itself would keep what it compiled cut short
    }
    full, free = (
        subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, encoding="utf-8", check=True)
        for code in (FULL_DISK, "from kernels import one, two; print(one(3), two(3), one(0.5))")
    )
    assert full.stdout == free.stdout == "4 6 1.5\n"
    assert full.stderr.splitlines() == [
        "preparing one for input of this kind, up to a minute, the first time",
        "compiled code cannot be kept for the next run: File too large",
    ]
    assert any(kept.rglob("*.nbc")), "the next run with room keeps it"


def _last_of_twice(values: np.ndarray) -> float:
    return float((values + values)[-1])


def test_code_that_makes_an_array_says_so() -> None:
    values = np.arange(3.0)
    with pytest.raises(numba.core.errors.NumbaError):
        njit()(_last_of_twice)(values)
    assert njit(makes_arrays=True)(_last_of_twice)(values) == 4.0


def test_only_code_that_makes_arrays_counts_references() -> None:
    from infill.kernels import collapsing, covering

    for module in (collapsing, covering):
        kernels = [value for value in vars(module).values() if isinstance(value, numba.core.dispatcher.Dispatcher)]
        counted = {kernel.__name__ for kernel in kernels if kernel.targetoptions["_nrt"]}
        assert 0 < len(counted) < len(kernels)
        assert not {"_collapse_in_order", "_sample_in_order", "squared_distance"} & counted  # the loops inside


def test_the_second_process_compiles_for_the_number_types_of_smoothing() -> None:
    ring = make_ring()
    assert ring.closed
    assert ring.volume == pytest.approx(4 * np.pi**2, rel=0.01)
    cells = np.zeros((8, 8, 8), dtype=bool)
    cells[2:6, 2:6, 2:6] = True
    smoothed = smooth_volume(cells, tolerance=None).surface
    assert smoothed.vertices.dtype == ring.vertices.dtype
    assert smoothed.faces.dtype == ring.faces.dtype


LISTENING = """
import trimesh
from numba.core import event
from infill import smooth_mesh
from infill.kernels import components, distances, flips, measures, rays
from infill.meshes.compile_simplification import make_ring
from infill.meshes.edge_collapse import collapse_edges

with event.install_recorder("numba:compile") as recorder:
    collapse_edges(make_ring(), tolerance=0.02)
assert not recorder.buffer
with event.install_recorder("numba:compile") as recorder:
    smooth_mesh(trimesh.creation.icosphere(radius=10), voxel=0.5).report["distance"]
ahead = {
    components: ["label_cells", "meet_or_spread", "mark_runs", "join_beyond"],
    flips: ["flip_simple", "count_lonely"],
    measures: ["sum_up", "find_edge_starts", "match_sides", "measure_areas", "find_first_corners", "spread_points"],
    rays: ["sample_rays"],
    distances: ["interleave_bits", "box_leaves", "nearest_triangles"],
}
kernels = {getattr(module, name) for module, names in ahead.items() for name in names}
compiled = {found.data["dispatcher"] for _, found in recorder.buffer}
assert compiled, "the earlier stages compile"
print([kernel.__name__ for kernel in kernels & compiled])
"""


@pytest.mark.longest
def test_what_the_second_process_compiled_is_not_compiled_again(tmp_path: Path) -> None:
    # Which types are compiled for does not depend on how well the code is optimised.
    quickly = {"NUMBA_OPT": "1", "NUMBA_LOOP_VECTORIZE": "0", "NUMBA_SLP_VECTORIZE": "0"}
    environment = {**os.environ, **quickly, "NUMBA_CACHE_DIR": str(tmp_path)}
    module = [sys.executable, "-m", "infill.smoothing.compile_ahead"]
    subprocess.run(module, env=environment, check=True)
    ran = subprocess.run([sys.executable, "-c", LISTENING], env=environment, check=True, capture_output=True, text=True)
    assert ran.stdout == "[]\n"


def test_a_function_that_only_kernels_call_has_no_entry_for_python() -> None:
    inner = njit(from_python=False)(lambda x: x + 1)
    outer = njit()(lambda x: inner(x) + 1)
    assert outer(1) == 3
    assert inner.targetoptions["no_cpython_wrapper"]
    assert not outer.targetoptions["no_cpython_wrapper"]


def _kernel_functions() -> dict[tuple[str, str], bool]:
    """Return whether Python may call each compiled function, by module and name."""
    entries = {}
    for path in KERNELS.glob("*.py"):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and (options := _njit_options(node)) is not None:
                entries[path.stem, node.name] = "from_python" not in options
    return entries


def _njit_options(node: ast.FunctionDef) -> list[str | None] | None:
    """Return the names of the options with which a function is compiled, None if it is not."""
    for decorator in node.decorator_list:
        if isinstance(decorator, ast.Call) and getattr(decorator.func, "id", "") == "njit":
            return [keyword.arg for keyword in decorator.keywords]
    return None


def _python_calls(path: Path, entries: dict[tuple[str, str], bool]) -> set[tuple[str, str]]:
    """Return the compiled functions, by module and name, that uncompiled code of a file names."""
    tree, names, own = ast.parse(path.read_text(encoding="utf-8")), {}, path.parent == KERNELS
    nodes = [
        node
        for part in tree.body
        if not (own and isinstance(part, (ast.FunctionDef, ast.ImportFrom)) and _is_for_kernels(part))
        for node in ast.walk(part)
    ]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("infill.kernels."):
            names.update({alias.asname or alias.name: (str(node.module)[15:], alias.name) for alias in node.names})
    if own:
        names.update({name: (module, name) for module, name in entries if module == path.stem})
    found = {names[node.id] for node in nodes if isinstance(node, ast.Name) and node.id in names}
    found |= {
        (node.value.id, node.attr)
        for node in nodes
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
    }
    return found & set(entries)


def _is_for_kernels(part: ast.FunctionDef | ast.ImportFrom) -> bool:
    return isinstance(part, ast.ImportFrom) or _njit_options(part) is not None


@pytest.mark.longest
def test_python_calls_no_function_without_an_entry() -> None:
    entries = _kernel_functions()
    root = KERNELS.parents[1]
    assert not entries["rows", "copy_row"]
    assert not entries["collapsing", "_keep_volume"]
    assert entries["collapsing", "collapse"]
    assert ("collapsing", "collapse") in _python_calls(root / "infill" / "meshes" / "edge_collapse.py", entries)
    for folder in ("infill", "tests", "benchmarks", "tools", "examples"):
        for path in (root / folder).rglob("*.py"):
            wrong = [called for called in _python_calls(path, entries) if not entries[called]]
            assert not wrong, f"{path} calls {wrong}, which have no entry for Python: calling them ends the process"


def test_a_kernel_is_compiled_for_the_types_of_examples() -> None:
    kernel = njit()(lambda x, n: x[0] + n)
    compiling.compile_for(kernel, np.zeros(1), 1)
    assert len(kernel.signatures) == 1
    assert kernel(np.ones(3), 2) == 3
    assert len(kernel.signatures) == 1


@pytest.mark.parametrize(("cores", "uncached", "started"), [(2, False, True), (1, False, False), (2, True, False)])
def test_a_second_process_starts_if_there_is_a_core_and_a_folder(
    monkeypatch: pytest.MonkeyPatch, cores: int, uncached: bool, started: bool
) -> None:
    commands: list[list[str]] = []

    class Process:
        def __init__(self, command: list[str], **_options: object) -> None:
            commands.append(command)

        def wait(self) -> None:
            commands.append(["waited"])

    monkeypatch.setattr(second_compiler.subprocess, "Popen", Process)
    monkeypatch.setattr(second_compiler, "usable_cores", lambda: cores)
    monkeypatch.setattr(second_compiler, "UNCACHED", threading.Event())
    monkeypatch.setattr(compiling, "AT_FIRST_COMPILATION", starts := [])
    monkeypatch.setattr(second_compiler, "AT_FIRST_COMPILATION", starts)
    monkeypatch.setattr(compiling, "REPORTED", threading.Event())
    if uncached:
        second_compiler.UNCACHED.set()
    for _ in range(3):  # a process may run several commands
        second_compiler.compile_beside("some.module")
    assert not commands
    with log_compilation("a test"):
        njit()(lambda x: x + 1)(1)
    second_compiler.await_second_compiler()
    assert commands == ([[sys.executable, "-P", "-m", "some.module"], ["waited"]] if started else [])


def test_measures_are_compiled_once_whatever_faces_are_stored_as() -> None:
    from infill.kernels.measures import sum_shells, sum_up

    ball = trimesh.creation.icosphere(1)
    for kind in (np.int32, np.int64, np.uint32):
        for faces in (ball.faces.astype(kind), ball.faces.astype(kind)[:, ::-1]):
            surface = Surface(vertices=np.asarray(ball.vertices), faces=faces)
            assert abs(volume_and_area(surface)[0]) == pytest.approx(abs(surface.volume))
            names, count = vertex_components(faces, len(surface.vertices))
            assert shell_volumes(surface, names, count) == pytest.approx([surface.volume])
    for kernel in (sum_up, sum_shells):
        assert {str(signature[1]) for signature in kernel.signatures} == {"array(int32, 2d, C)"}


def test_bricks_are_gathered_by_one_kernel_whether_or_not_arrays_are_writable() -> None:
    from infill.kernels.transfer import gather

    values = np.linspace(-1, 1, 20**3, dtype=np.float32).reshape(20, 20, 20)
    field = smooth_bricks(values, Smoothing(steps=1), threads=1)
    before = len(gather.signatures)
    np.testing.assert_array_equal(field.gathered(values, threads=1), field.gathered(values[:], threads=1))
    new = gather.signatures[before:]
    assert all(not signature[0].mutable for signature in new)
    assert len(new) <= 1
