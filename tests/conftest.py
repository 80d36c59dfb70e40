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
    "tests/test_compiling.py",
    "tests/test_examples.py",
    "tests/test_mathematics.py",
    "tests/test_points.py",
    "tests/test_rays_and_thickness.py",
    "tests/test_report.py",
    "tests/test_site.py",
    "tests/test_slicers.py",
    "tests/test_smooth_command.py",
    "tests/test_smooth_command_posix.py",
    "tests/test_smooth_files.py",
    "tests/test_threads.py",
    "tests/test_architecture.py::test_make_needs_neither_a_compiler_nor_trimesh",
    "tests/test_architecture.py::test_no_private_name_comes_into_a_test",
    "tests/test_architecture.py::test_one_wrong_import_is_named",
    "tests/test_architecture.py::test_the_help_of_make_loads_no_pattern",
    "tests/test_command_line.py::test_a_bad_config_is_one_clear_line",
    "tests/test_command_line.py::test_bad_input_is_one_clear_line",
    "tests/test_command_line.py::test_check_says_yes_and_no",
    "tests/test_command_line.py::test_dry_run_writes_nothing",
    "tests/test_command_line.py::test_existing_files_are_kept_without_force",
    "tests/test_command_line.py::test_help_has_an_example_and_exits_0",
    "tests/test_command_line.py::test_list_draws_the_pattern",
    "tests/test_command_line.py::test_make_writes_a_closed_mesh",
    "tests/test_command_line.py::test_names_that_a_console_cannot_show",
    "tests/test_data.py::test_a",
    "tests/test_data.py::test_what_cannot_be_had_is_one_line",
    "tests/test_edges_and_shells.py::test_check_needs_no_compiler",
    "tests/test_formats.py::test_a_file_read_back_is_the_same_solid",
    "tests/test_formats.py::test_a_surface_is_saved_as_its_trimesh",
    "tests/test_formats.py::test_stl_as_text",
    "tests/test_formats.py::test_stl_with_bytes_at_the_end_or_a_mark_at_the_start",
    "tests/test_inspection.py::test_real_files",
    "tests/test_kernel_functions.py::test_cells_of_a_component",
    "tests/test_kernels.py::TestLaws::test_takes_any_real_type",
    "tests/test_kernels.py::test_fast_kernels_agree",
    "tests/test_kernels.py::test_sparse_is_dense_to_the_last_bit",
    "tests/test_kernels.py::test_straight_walls_shrink_as_measured_beforehand",
    "tests/test_kernels.py::test_the_log_tells_of_compiling",
    "tests/test_level_sets.py::test_a_block_is_made_of_a_level_set",
    "tests/test_make.py::test_broken_walls_are_an_error_that_says_what_to_change",
    "tests/test_make.py::test_the_default_change_of_volume",
    "tests/test_make.py::test_the_defaults_keep_every_hole_of_the_stamp",
    "tests/test_make.py::test_the_designs_are_printable_at_many_sizes",
    "tests/test_make.py::test_the_exact_stamp_keeps_its_width",
    "tests/test_make.py::test_the_plan_expects_the_triangles",
    "tests/test_make.py::test_the_report_tells_the_truth",
    "tests/test_make.py::test_the_unit_of_length_does_not_matter",
    "tests/test_parameters.py::test_the_flags_of_the_designs_still_work",
    "tests/test_parameters.py::test_the_help_of_make_stays_fast",
    "tests/test_parameters.py::test_the_help_of_make_stays_short",
    "tests/test_patterns.py::test_a_bad_spacing_of_points_is_refused",
    "tests/test_patterns.py::test_height_does_not_matter_to_prismatic_patterns",
    "tests/test_patterns.py::test_honeycomb_density_is_exact",
    "tests/test_patterns.py::test_lines_and_points_lie_inside_the_region",
    "tests/test_patterns.py::test_points_follow_the_lines_closely",
    "tests/test_patterns.py::test_zigzag_is_the_papers_design",
    "tests/test_picture.py::test_the_preview_shows_four_stages",
    "tests/test_point_files.py::test_real_points",
    "tests/test_point_files.py::test_text_in_columns",
    "tests/test_refining.py::test_levels_and_fields_of_a_result_are_those_of_phi",
    "tests/test_refining.py::test_thin_walls_survive_that_plain_smoothing_breaks",
    "tests/test_repository.py::test_the_schemas_hold",
    "tests/test_scans.py::test_a_file_with_a_flipped_byte_is_read_or_told",
    "tests/test_smooth_library.py::test_a_component_with_a_cavity_and_a_component_in_it",
    "tests/test_smooth_library.py::test_a_mesh_comes_back_in_its_place",
    "tests/test_smooth_library.py::test_a_thin_plate_that_breaks_is_an_error_and_allowed_on_request",
    "tests/test_smooth_library.py::test_components_close_to_one_another_do_not_grow",
    "tests/test_smooth_library.py::test_despeckling_takes_what_is_small_and_nothing_else",
    "tests/test_smooth_library.py::test_every_solid_gives_a_closed_mesh_and_an_honest_report",
    "tests/test_smooth_library.py::test_every_type_of_data_gives_the_mesh_of_its_solid",
    "tests/test_smooth_library.py::test_finer_cells_come_closer_to_the_mesh",
    "tests/test_smooth_library.py::test_level_volume_keeps_a_ball_and_level_0_shrinks_it",
    "tests/test_smooth_library.py::test_memory_does_not_matter_and_nothing_is_changed",
    "tests/test_smooth_library.py::test_mirrored_axes_keep_the_outside_outside",
    "tests/test_smooth_library.py::test_more_threads_than_make_sense_still_work",
    "tests/test_smooth_library.py::test_points_of_a_sphere_give_a_ball_or_a_shell",
    "tests/test_smooth_library.py::test_scaling",
    "tests/test_smooth_library.py::test_simplified_meshes_stay_closed_and_close",
    "tests/test_smooth_library.py::test_simplifying_keeps_the_space_and_what_it_cannot_do_is_told",
    "tests/test_smooth_library.py::test_threads_and_runs_give_the_same_bits",
    "tests/test_smooth_library.py::test_tolerance_and_triangles_are_both_kept_or_it_is_told",
    "tests/test_smooth_library.py::test_transposing_the_axes_transposes_the_mesh",
    "tests/test_smooth_library.py::test_void_around_the_data_moves_the_mesh_and_nothing_else",
    "tests/test_surface.py::test_extruding_is_stacking",
    "tests/test_surface.py::test_the_layer_predicts_the_euler_number_of_the_mesh",
    "tests/test_topology_and_width.py::test_a_straight_wall_has_its_width",
    "tests/test_topology_and_width.py::test_the_exact_stamp_keeps_the_width_through_smoothing",
    "tests/test_units.py::test_smooth_takes_a_small_glb_and_writes_one",
    "tests/test_voxels.py::test_a_mesh_with_holes_is_capped_once",
    "tests/test_voxels.py::test_broken_meshes_have_the_volume_of_the_part",
    "tests/test_voxels.py::test_closed_meshes_have_their_volume",
    "tests/test_voxels.py::test_overlapping_balls_are_united",
    "tests/test_voxels.py::test_overlapping_bones_are_united",
    "tests/test_voxels.py::test_triangles_turned_over_or_doubled_change_nothing",
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
