"""What several test files share."""

from __future__ import annotations

import logging
import os
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from infill import smooth_volume

settings.register_profile(
    "suite", deadline=None, max_examples=25, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("suite")


# What `make quick` leaves out, by the beginning of a test's name: what takes most processor time (os.times() around each
# test, on a warm cache), added up by file and by test, until the rest takes about 65 s, which is 35 s on two cores.
# Whole files are those that start processes, read many files or draw; each has a smaller relative that stays.
SLOW = (
    "tests/test_command_line_posix.py",
    "tests/test_data.py::test_a",
    "tests/test_examples.py",
    "tests/test_mathematics.py",
    "tests/test_points.py",
    "tests/test_site.py",
    "tests/test_slicers.py",
    "tests/test_smooth_command.py",
    "tests/test_smooth_command_posix.py",
    "tests/test_smooth_files.py",
    "tests/test_command_line.py::test_bad_input_is_one_clear_line",
    "tests/test_command_line.py::test_check_says_yes_and_no",
    "tests/test_command_line.py::test_make_writes_a_closed_mesh",
    "tests/test_command_line.py::test_names_that_a_console_cannot_show",
    "tests/test_formats.py::test_a_file_read_back_is_the_same_solid",
    "tests/test_inspection.py::test_real_files",
    "tests/test_kernels.py::TestLaws::test_takes_any_real_type",
    "tests/test_kernels.py::test_fast_kernels_agree",
    "tests/test_kernels.py::test_sparse_is_dense_to_the_last_bit",
    "tests/test_kernels.py::test_the_log_tells_of_compiling",
    "tests/test_make.py::test_the_designs_are_printable_at_many_sizes",
    "tests/test_make.py::test_the_exact_stamp_keeps_its_width",
    "tests/test_make.py::test_the_plan_expects_the_triangles",
    "tests/test_patterns.py::test_points_follow_the_lines_closely",
    "tests/test_point_files.py::test_real_points",
    "tests/test_point_files.py::test_text_in_columns",
    "tests/test_repository.py::test_the_schemas_hold",
    "tests/test_scans.py::test_a_file_with_a_flipped_byte_is_read_or_told",
    "tests/test_smooth_library.py::test_a_mesh_comes_back_in_its_place",
    "tests/test_smooth_library.py::test_components_close_to_one_another_do_not_grow",
    "tests/test_smooth_library.py::test_every_solid_gives_a_closed_mesh_and_an_honest_report",
    "tests/test_smooth_library.py::test_every_type_of_data_gives_the_mesh_of_its_solid",
    "tests/test_smooth_library.py::test_level_volume_keeps_a_ball_and_level_0_shrinks_it",
    "tests/test_smooth_library.py::test_memory_does_not_matter_and_nothing_is_changed",
    "tests/test_smooth_library.py::test_scaling",
    "tests/test_smooth_library.py::test_simplified_meshes_stay_closed_and_close",
    "tests/test_smooth_library.py::test_threads_and_runs_give_the_same_bits",
    "tests/test_smooth_library.py::test_tolerance_and_triangles_are_both_kept_or_it_is_told",
    "tests/test_smooth_library.py::test_void_around_the_data_moves_the_mesh_and_nothing_else",
    "tests/test_topology_and_width.py::test_a_straight_wall_has_its_width",
    "tests/test_topology_and_width.py::test_the_exact_stamp_keeps_the_width_through_smoothing",
    "tests/test_voxels.py::test_closed_meshes_have_their_volume",
    "tests/test_voxels.py::test_overlapping_bones_are_united",
)

ROOT = Path(__file__).resolve().parents[1]
HOMES = (ROOT / "data", ROOT.parent / "shared" / "data")
ADVICE = "run `make data`, or set INFILL_DATA"


def pytest_configure() -> None:
    """Find the data once, for the tests and for what they run."""
    if "INFILL_DATA" not in os.environ:
        found = next((home for home in HOMES if home.is_dir()), None)
        if found:
            os.environ["INFILL_DATA"] = str(found)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.nodeid.startswith(SLOW):
            item.add_marker("slow")


def known_data() -> set[str]:
    """Return the names of the real files, with the folders they lie in."""
    table = tomllib.loads((ROOT / "tools" / "data.toml").read_text(encoding="utf-8"))
    files = {Path(entry["path"]) for entry in (*table["public"], *table["other"])}
    return {path.as_posix() for file in files for path in (file, *file.parents)}


class Data(type(Path())):  # type: ignore[misc]
    """A folder of which some files may not have been fetched: the test that asks for one is skipped."""

    def __truediv__(self, name: str | os.PathLike[str]) -> Path:
        path = super().__truediv__(name)
        inside = path.relative_to(os.environ["INFILL_DATA"]).as_posix()
        if not path.exists() and inside in known_data():
            pytest.skip(f"no {path}; {ADVICE}")
        return path if path.is_dir() else Path(path)


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real meshes and scans; tests that need what it lacks skip."""
    folder = Path(os.environ.get("INFILL_DATA", HOMES[0]))
    if not folder.is_dir():
        pytest.skip(f"no test data at {folder}; {ADVICE}")
    return Data(folder)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20201)


@pytest.fixture(scope="session")
def compiled() -> None:
    """Compile what smoothing takes, so that nothing is said of it later, by other processes neither."""
    ball = np.sum((np.indices((20, 20, 20)) - 9.5) ** 2, axis=0) < 40
    for refine in (False, True):
        smooth_volume(ball, refine=refine)


@pytest.fixture
def silent_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    """Say nothing of what is compiled in this process: which test is first to need it depends on their order."""
    monkeypatch.setattr(logging.getLogger("infill"), "disabled", True)
