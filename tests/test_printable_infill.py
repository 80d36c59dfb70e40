"""The infill of projects: shifted to where slicers print it, and without what they print none for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slicers
import trimesh
from made_shapes import box
from test_command_line import run as command

from infill import Surface, fill, save_project
from infill.interior.narrow import drop_narrow, estimate_narrow
from infill.meshes.solids import coincident_vertices, manifold_status, to_manifold
from infill.result import Result

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

Size = tuple[float, float, float]
WALL, LINE, LEAST = 0.9, 0.45, 0.6  # mm
HARDLY_SHIFTED = (0.01, 0.0)  # mm: whoever says where the pattern is gets it there
prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa() or "there")
cut_by_walls = pytest.mark.parametrize(  # a wall of the pattern along one of the part, where it is not shifted
    ("pattern", "density", "size"), [("honeycomb", 0.2, (8, 8, 6)), ("rectilinear", 0.3, (16, 6, 6))]
)


def surface(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def standing(size: Size) -> trimesh.Trimesh:
    return box(*size, (100, 100, size[2] / 2))


def filled(pattern: str, density: float, size: Size, **more: Any) -> Result[Any, Any]:
    return fill(surface(standing(size)), pattern, as_="project", density=density, line_width=0.9, **more)


def printed(found: Result[Any, Any], size: Size, folder: Path) -> float:
    """Return what PrusaSlicer lays for the infill of a project, mm³."""
    standing(size).export(folder / "part.stl")
    save_project(found, folder / "part.3mf", slicer="prusaslicer")
    settings = {"top_solid_layers": 0, "bottom_solid_layers": 0}
    whole, _, said = slicers.prusa_volumes(folder / "part.3mf", folder, **settings)
    alone, _, _ = slicers.prusa_volumes(folder / "part.stl", folder, **settings, fill_density="0%")
    assert "repair" not in said.lower()
    return sum(whole.values()) - sum(alone.values())


def volume_in(infill: Surface, size: Size, wall: float = slicers.PERIMETERS - slicers.OVERLAP) -> float:
    """Return the volume of infill inside upright walls of a box, mm³: those where slicers print no infill."""
    room = standing((size[0] - 2 * wall, size[1] - 2 * wall, size[2]))
    return float((to_manifold(infill) ^ to_manifold(surface(room))).volume())


@pytest.mark.longest
@cut_by_walls
@prusa
def test_a_pattern_is_shifted_to_where_slicers_print_it(
    pattern: str, density: float, size: Size, tmp_path: Path
) -> None:
    found = filled(pattern, density, size)
    report = found.report
    assert report["request"]["phase"] == [0.0, 0.0, 0.0]
    assert report["infill"]["phase"] != [0.0, 0.0, 0.0]
    assert report["infill"]["left_out"] == 0
    assert report["density"] == pytest.approx(density, abs=0.005)
    assert report["problems"] == []
    laid = printed(found, size, tmp_path)
    assert laid == pytest.approx(volume_in(found.surfaces["infill"], size), rel=0.05)
    assert laid > 1.1 * printed(filled(pattern, density, size, phase=HARDLY_SHIFTED), size, tmp_path)


@pytest.mark.longest
@cut_by_walls
@prusa
def test_infill_that_slicers_do_not_print_is_left_out_and_told(
    pattern: str, density: float, size: Size, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = filled(pattern, density, size, phase=HARDLY_SHIFTED)
    report, infill = found.report, found.surfaces["infill"]
    assert report["infill"]["phase"] == [*HARDLY_SHIFTED, 0.0]
    assert any("so that was left out; shift the pattern by --phase" in each for each in report["problems"])
    assert manifold_status(infill) == "NoError"
    assert not coincident_vertices(infill).any()
    assert printed(found, size, tmp_path) == pytest.approx(volume_in(infill, size), rel=0.05)

    monkeypatch.setattr("infill.lattices.projected.NARROW", 1.0)
    whole = filled(pattern, density, size, phase=HARDLY_SHIFTED)
    before = whole.surfaces["infill"]
    assert whole.report["infill"]["left_out"] == 0
    assert printed(whole, size, tmp_path) < 0.9 * volume_in(before, size)
    gone = to_manifold(before) - to_manifold(infill)
    room = to_manifold(surface(box(*(np.array(size) - 2 * WALL), (100, 100, size[2] / 2))))
    assert report["infill"]["left_out"] == pytest.approx((gone ^ room).volume(), rel=0.03)
    lost = whole.report["density"] - report["density"]
    assert lost == pytest.approx(report["infill"]["left_out"] / report["part"]["inside"], abs=0.002)


@pytest.mark.parametrize("wide", [0.3, 0.5, 0.7, 2.0])
def test_bars_narrower_than_the_least_are_left_out_whole_and_wider_ones_stay(wide: float) -> None:
    part, bar = surface(box(10, 10, 8)), surface(box(wide, 12, 8))
    found = estimate_narrow(part, bar, WALL, LINE, LEAST)
    left = drop_narrow(part, bar, WALL, LINE, LEAST)
    inside = to_manifold(surface(box(10 - 2 * WALL, 10 - 2 * WALL, 8)))
    assert found is not None
    assert found.room == pytest.approx(0.0, abs=1e-9)
    if wide < LEAST:
        assert found.all == pytest.approx(1.0, abs=0.01)
        assert (to_manifold(left) ^ inside).volume() == pytest.approx(0.0, abs=1e-6)
    else:
        assert found.all == 0.0
        assert left is bar


def test_what_is_kept_is_not_touched() -> None:
    """A bar beside a sliver that goes: along a slope, so that each layer is cut on its own."""
    part = surface(box(20, 20, 10))
    bar, sliver = box(2, 24, 20, (-4, 0, 0)), box(0.4, 24, 14, (3, 0, 0))
    for each in (bar, sliver):
        each.apply_transform(trimesh.transformations.rotation_matrix(0.4, (0, 1, 0)))
    both = trimesh.util.concatenate([bar, sliver])
    slab = to_manifold(surface(box(40, 40, 10)))
    left = to_manifold(drop_narrow(part, surface(both), WALL, LINE, LEAST))
    kept = to_manifold(surface(bar)) ^ slab
    assert (left ^ kept).volume() == pytest.approx(kept.volume(), rel=1e-6)
    inside = to_manifold(surface(box(20 - 2 * WALL, 20 - 2 * WALL, 10)))
    assert (left ^ to_manifold(surface(sliver)) ^ inside).volume() < 0.01 * (
        to_manifold(surface(sliver)) ^ inside
    ).volume()


@pytest.mark.longest
def test_a_part_without_room_keeps_its_infill_and_that_is_told() -> None:
    found = fill(surface(box(30, 2.1, 12)), "honeycomb", as_="project", density=0.3, line_width=0.9)
    assert found.report["infill"]["left_out"] == 0
    assert found.report["density"] == pytest.approx(0.3, abs=0.005)
    assert any("slicers print none of it; shift" in each for each in found.report["problems"])


@pytest.mark.longest
@pytest.mark.parametrize("more", [{"align": "bed"}, {"density": (0.1, 0.3)}])
def test_a_pattern_stays_where_it_was_asked_for(more: dict[str, Any]) -> None:
    asked: dict[str, Any] = {"density": 0.2, "line_width": 0.9, **more}
    report = fill(surface(standing((6, 6, 10))), "honeycomb", as_="project", **asked).report
    assert report["infill"]["phase"] == [0.0, 0.0, 0.0]
    assert report["seconds"]["shift"] == 0


@pytest.mark.longest
def test_the_command_says_where_a_pattern_is_and_makes_it_again_there(tmp_path: Path) -> None:
    standing((6, 6, 10)).export(tmp_path / "part.stl")
    words = ["--for", "prusaslicer", "--pattern", "gyroid", "--density", "20%"]
    done = command("fill", tmp_path / "part.stl", *words, "-o", tmp_path / "one.3mf")
    assert "slicers print more of it there" in done.stderr
    command("fill", tmp_path / "part.stl", "--config", tmp_path / "one.3mf", "-o", tmp_path / "two.3mf")
    assert (tmp_path / "one.3mf").read_bytes() == (tmp_path / "two.3mf").read_bytes()
