"""Blocks that `make` fills as a part is: every pattern at a density, in exact sizes, with and without a frame."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from shapes import one_of_each_kind
from test_command_line import one_line_error, run, usage_error

from infill import ParameterError, UsageError, fill, make
from infill.formats.mesh_files import read_mesh
from infill.making.request import Block, check_sides
from infill.making.settings import resolve
from infill.meshes.solids import FINE, manifold_status
from infill.meshes.winding import winding_numbers
from infill.surface import Surface
from patterns import PATTERNS, Cells, Gyroid, Honeycomb

pytestmark = pytest.mark.usefixtures("coarse_grids")

SIDES = (16.0, 13.0, 11.0)
UNIT = ["--size", "16x13x11", "--density", "20"]
TILE = '<svg xmlns="http://www.w3.org/2000/svg" width="6mm" height="6mm" viewBox="0 0 6 6"><path d="{}" stroke="#000"/></svg>'
# Without a frame, its rings lie half a cell inside the sides.
SMALLER = ("concentric",)


def assert_block(surface: Surface, sides: tuple[float, ...] = SIDES, *, density: float = 0.2) -> None:
    """Check that a block is closed, accepted as a solid, and has exactly its sides and its density."""
    assert surface.closed
    assert manifold_status(surface) == manifold_status(surface, single=True) == FINE
    assert np.ptp(surface.bounds, axis=0) == pytest.approx(sides, abs=0.01)
    assert surface.bounds[0] == pytest.approx([-sides[0] / 2, -sides[1] / 2, 0], abs=0.01)
    assert surface.volume / math.prod(sides) == pytest.approx(density, abs=0.005)


@pytest.mark.longest
@pytest.mark.parametrize("name", one_of_each_kind(PATTERNS.built_in))
def test_every_kind_of_pattern_is_a_block_at_a_density(name: str, tmp_path: Path) -> None:
    block = tmp_path / "a.stl"
    result = run("make", name, *UNIT, "-o", block, "--preview", tmp_path / "a.png", "--json", "-q")
    assert result.exit_code == 0, result.stderr
    assert_block(read_mesh(block))
    report = json.loads(result.stdout)
    assert report["density"] == pytest.approx(0.2, abs=0.005)
    assert report["extents"] == pytest.approx(SIDES, abs=0.01)
    assert (tmp_path / "a.png").stat().st_size > 1000


@pytest.mark.long
@pytest.mark.parametrize("frame", [False, True])
@pytest.mark.parametrize("name", ["honeycomb", "gyroid", "octet", "honeycomb-3d", "cross-3d"])
def test_a_block_has_a_frame_or_none(name: str, frame: bool) -> None:
    result = make(name, size=SIDES, density=0.25, frame=frame)
    assert_block(result.surface, density=0.25)
    assert result.report["request"]["frame"] == (0.45 if frame else 0)
    # In the middle of a side, a frame is solid everywhere, and a cut-off pattern is not.
    x, y, z = np.meshgrid([SIDES[0] / 2 - 0.2], np.linspace(-6, 6, 41), np.linspace(0.5, 10.5, 41))
    inside = winding_numbers(np.stack([x, y, z], axis=-1).reshape(-1, 3), result.surface) > 0
    assert inside.mean() == 1 if frame else 0.05 < inside.mean() < 0.7


@pytest.mark.slow
@pytest.mark.parametrize("pattern", ["drawing", "module", "function", "instance"])
def test_drawings_and_functions_are_blocks_too(pattern: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("tile.svg").write_text(TILE.format("M0 3H6 M3 0V6"))
    Path("waves.py").write_text(
        "import numpy as np\n\ndef wave(x, y, z):\n    return np.sin(x) + np.cos(y) + np.sin(z)\n"
    )
    given: Any = {
        "drawing": "tile.svg",
        "module": "waves.py:wave",
        "function": lambda x, y, z: np.cos(x) + np.cos(y) + np.cos(z),
        "instance": Gyroid(cell=6),
    }[pattern]
    if isinstance(given, str):
        result = run("make", given, *UNIT, "-o", "a.stl", "-q")
        assert result.exit_code == 0, result.stderr
        assert_block(read_mesh("a.stl"))
    else:
        assert_block(make(given, size=SIDES, density=20).surface)


@pytest.mark.parametrize("name", ["zigzag", "honeycomb", "gyroid"])
def test_lines_of_a_low_block_without_a_frame_have_their_width(name: str) -> None:
    """The voids come out of all its sides, which lie near most of them and are no walls."""
    report = make(name, size=(30, 30, 4), density=0.15, frame=False).report
    assert report["infill"]["line_width"] == pytest.approx(0.45, rel=0.05)
    assert report["problems"] == []


def test_the_third_of_cell_line_width_and_density_follows() -> None:
    small: dict[str, Any] = {"size": (12, 10, 4), "frame": False}
    by_cell = make("honeycomb", cell=4, density=0.3, **small).report
    assert (by_cell["infill"]["cell"], by_cell["request"]["line_width"]) == (4.0, None)
    assert by_cell["density"] == pytest.approx(0.3, abs=0.005)
    wide, thin = (make("honeycomb", line_width=width, density=0.3, **small).report["infill"] for width in (0.9, 0.6))
    assert (thin["line_width"], wide["line_width"]) == pytest.approx((0.6, 0.9), rel=0.06)
    assert wide["cell"] == pytest.approx(1.5 * thin["cell"], rel=0.1)


@pytest.mark.longest
def test_a_turn_by_its_symmetry_changes_nothing_and_another_does() -> None:
    options: dict[str, Any] = {"size": (12, 12, 4), "density": 0.3, "cell": 4, "frame": False}
    straight, turned, quarter = (make("grid", angle=angle, **options).surface for angle in (0, 30, 90))
    assert quarter.volume == pytest.approx(straight.volume, rel=1e-3)
    assert abs(len(turned.faces) - len(straight.faces)) > 20
    by_class = make(Honeycomb(angle=30), **{key: value for key, value in options.items() if key != "frame"})
    by_name = make("honeycomb", angle=30, **{**options, "frame": True})
    np.testing.assert_array_equal(by_class.surface.vertices, by_name.surface.vertices)


@pytest.mark.longest
def test_a_part_without_a_shell_is_the_infill_cut_off_at_its_skin() -> None:
    ball = trimesh.creation.icosphere(3, 8.0)
    result = fill(ball, "gyroid", density=0.3, wall=0, voxel=0.5)
    solid = result.surface
    assert solid.closed
    assert result.report["density"] == pytest.approx(solid.volume / ball.volume, abs=1e-6)
    assert solid.volume / ball.volume == pytest.approx(0.3, abs=0.005)
    distance = np.linalg.norm(solid.vertices, axis=1)
    assert distance.max() <= 8 + 1e-6
    assert (distance > 7.8).mean() > 0.02  # it reaches the skin
    shell = fill(ball, "gyroid", density=0.3, voxel=0.5).surface
    assert solid.volume < 0.6 * shell.volume


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["gyroid", "--density", "20", "--stamp", "exact"], "--stamp serves blocks that are stamped layer by layer"),
        (["gyroid", "--cells", "5"], "--cells serves blocks that are stamped layer by layer, and this pattern changes"),
        (["gyroid", "--size", "20x20x5", "--height", "6"], "--height is 6 mm, and size has 5 mm for it"),
        (["gyroid", "--cell", "5", "--line-width", "1", "--density", "20"], "are all given"),
    ],
)
def test_options_that_do_not_go_together_are_wrong_usage(words: list[str], says: str, tmp_path: Path) -> None:
    usage_error(run("make", *words, "-o", tmp_path / "a.stl"), says)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["honeycomb", "--size", "10x10x5", "--density", "5", "--frame"], "the frame alone takes 17.2% of the block"),
        (["honeycomb", "--size", "1x10x5", "--density", "40"], "no room in a frame of 0.45 mm"),
        (["gyroid", "--density", "95"], "density is 95%; give 1% to 90%"),
        (["gyroid", "--set", "waves=3"], "gyroid has no parameter 'waves'; it has cell, angle, phase, frame"),
    ],
)
def test_what_cannot_be_made_is_one_clear_line(words: list[str], says: str, tmp_path: Path) -> None:
    one_line_error(run("make", *words, "-o", tmp_path / "a.stl"), says)


def test_sizes_have_two_numbers_or_three() -> None:
    assert check_sides(5, None) == (5, 5, 6)
    assert check_sides((5, 4), 3) == check_sides((5, 4, 3), None) == check_sides((5, 4, 3), 3) == (5, 4, 3)
    with pytest.raises(ParameterError, match="size has 1 numbers"):
        check_sides((5,), None)


@pytest.mark.parametrize("size", [(30.0, 20.0), (40.03, 39.96), (17.77, 12.345)])
def test_stamped_blocks_have_exactly_their_size(size: tuple[float, float]) -> None:
    result = make("honeycomb", size=size, height=2.0)
    assert np.ptp(result.surface.bounds, axis=0) == pytest.approx([*size, 2.0], abs=0.005)
    assert result.report["request"]["size"] == pytest.approx(size, rel=1e-12)


def test_a_block_is_made_again_from_its_saved_options(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    words = ["--size", "12x10x4", "--density", "30%", "--set", "angle=30", "--cell", "4", "--no-frame"]
    assert run("make", "honeycomb", *words, "--save-config", config).exit_code == 0
    again, typed = resolve({}, config), resolve({"pattern": "honeycomb"}, None, ["angle=30", "cell=4", "frame=no"])
    assert again.parameters == {"cell": 4.0, "angle": 30.0, "frame": False} == typed.parameters
    plan = again.plan()
    assert not isinstance(plan, Block)
    assert (plan.sides, plan.density, plan.frame) == ((12, 10, 4), 0.3, 0)


@pytest.mark.parametrize("density", ["20", "20%", "0.2", "0,2", " 20 % "])
def test_a_density_is_a_share_or_a_percentage(density: str) -> None:
    assert resolve({"pattern": "gyroid", "density": density}).density == 0.2


def test_a_dry_run_tells_cell_grid_and_memory() -> None:
    result = run("make", "gyroid", "--size", "40x40x20", "--dry-run", "--json")
    plan = json.loads(result.stdout)
    assert set(plan) == {"request", "infill", "grid", "memory"}
    assert plan["infill"]["line_width"] == 0.45
    assert "nothing is written" in run("make", "gyroid", "--dry-run").stdout


def test_patterns_that_a_test_above_leaves_smaller_are_known() -> None:
    assert all(not issubclass(PATTERNS[name], Cells) for name in SMALLER)
    block = make("concentric", size=(16, 13, 3), density=0.3, frame=False)
    assert (np.ptp(block.surface.bounds, axis=0)[:2] < (16, 13)).all()


def test_a_drawing_without_a_density_has_no_frame_and_its_pieces_are_told(tmp_path: Path) -> None:
    drawing = tmp_path / "ring.svg"
    circle = '<circle cx="5" cy="5" r="3" fill="none" stroke="black"/>'
    drawing.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{circle}</svg>', encoding="utf-8")
    words = ["make", str(drawing), "--size", "24", "--cell", "12", "-o", str(tmp_path / "a.stl")]
    refused = run(*words, "--frame")
    assert refused.exit_code == 2
    assert "add a density, such as 20%" in " ".join(refused.stderr.split())
    with pytest.raises(UsageError, match="add a density"):
        make(drawing, frame=True)
    loose = run(*words)
    assert loose.exit_code == 0, loose.stderr
    assert "components touch nowhere" in loose.stderr
    assert run(*words, "--frame", "--density", "20%", "--force").exit_code == 0


def test_a_comma_between_sides_is_asked_about() -> None:
    refused = run("make", "honeycomb", "--size", "60,40", "--dry-run")
    assert refused.exit_code == 2
    assert "give 60x40 for two sides, or 60.40 for one" in " ".join(refused.stderr.replace("│", " ").split())


def test_pieces_of_a_block_that_touch_nowhere_are_told(tmp_path: Path) -> None:
    """As for blocks without a density: rings about one another are many pieces, and a gyroid is one."""
    rings = run("make", "concentric", "--size", "20x20x2", "--density", "20%", "-o", tmp_path / "rings.stl")
    assert re.search(r"\d+ pieces touch nowhere, and come apart unless", " ".join(rings.stderr.split()))
    one = run("make", "gyroid", "--size", "10x10x10", "--density", "20%", "-o", tmp_path / "one.stl")
    assert "touch nowhere" not in one.stderr
