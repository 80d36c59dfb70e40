"""A drawing once, at a place: its lines stand there and nowhere else, and what touches nothing is told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import manifold3d
import pytest
import shapely
from made_shapes import box
from test_command_line import run, usage_error

from infill import GeometryError, UsageError, fill
from infill.drawings.tiled import read_tiled
from infill.meshes.solids import to_manifold
from infill.paths.ties import tie_islands

pytestmark = pytest.mark.usefixtures("compiled")

LINE = 0.6


@pytest.fixture
def logo(tmp_path: Path) -> str:
    """A square of 6 x 6 in the left half of a page of 16 x 8, and a stroke of 6 in the right half."""
    path = tmp_path / "logo.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="16mm" height="8mm" viewBox="0 0 16 8"><g fill="none" '
        'stroke="black"><rect x="1" y="1" width="6" height="6"/><path d="M9 4 L15 4"/></g></svg>'
    )
    return str(path)


def once(part: Any, logo: str, **more: Any) -> Any:
    return fill(part, logo, repeat=False, cell=16.0, line_width=LINE, wall=1, voxel=0.3, **more)


def solid_in(result: Any, low: tuple[float, ...], high: tuple[float, ...]) -> float:
    """Volume of infill in a box, mm³."""
    cube = manifold3d.Manifold.cube([h - a for a, h in zip(low, high, strict=True)]).translate(low)
    return cube.volume() - (to_manifold(result.stages.voids) ^ cube).volume()


def test_a_drawing_once_stands_where_it_is_placed(logo: str) -> None:
    """Lines of 24 and 6 mm, and nothing else; the tile is the box around them, as for tiles."""
    drawn = replace(read_tiled(logo), cell=16.0, repeat=False).lines(shapely.box(-50, -50, 50, 50))
    result = once(box(44, 30, 8), logo, phase=(10, 5))
    report = result.report
    assert report["problems"] == []
    assert report["closed"]
    assert report["mesh"]["manifold"] == "NoError"
    assert report["voids"]["count"] == 2  # within the square, and around
    x0, y0, x1, y1 = drawn.bounds
    middle = solid_in(result, (x0 + 9, y0 + 4, -1), (x1 + 11, y1 + 6, 1))
    assert middle == pytest.approx(2 * LINE * drawn.length, rel=0.1)  # fillets at five ends and corners
    assert solid_in(result, (-20, -13, -1), (20, 13, 1)) == pytest.approx(middle, rel=1e-6)


def test_a_drawing_once_is_one_of_its_tiles(logo: str) -> None:
    """Within one tile, the lines are the same; beyond it, there are none."""
    tiled = replace(read_tiled(logo), cell=1.0)
    single = replace(tiled, repeat=False)
    inside, wide = shapely.box(-0.49, -0.24, 0.49, 0.24), shapely.box(-3, -3, 3, 3)
    assert single.lines(inside).equals(tiled.lines(inside))
    assert single.lines(wide).length < 1.2 * single.lines(inside).length
    assert tiled.lines(wide).length > 20 * single.lines(wide).length


def count_bodies(result: Any) -> int:
    """Pieces that hang together; with open ends or without a shell, no void is enclosed."""
    return len(to_manifold(result.surface).decompose())


def test_islands_are_tied_by_the_shortest_bars(logo: str) -> None:
    """A stroke 2 mm beside a square, and the square 11 mm below one wall and above another."""
    part = box(44, 30, 8)
    tied, loose = once(part, logo, open_="both"), once(part, logo, open_="both", ties=False)
    report = tied.report
    assert report["problems"] == []
    assert report["voids"]["islands"] == 0
    assert count_bodies(tied) == 1
    assert report["infill"]["untied"] == 0
    lengths = sorted(tie["length"] for tie in report["infill"]["ties"])
    assert lengths == pytest.approx([2, 11], abs=0.05)
    bars = report["infill"]["ties"][0]["width"] * sum(lengths)
    added = loose.report["voids"]["volume"] - report["voids"]["volume"]  # without floor and roof
    assert added == pytest.approx(8 * (LINE * 30 + bars), rel=0.15)  # fillets


def test_without_ties_pieces_are_left_out_and_told(logo: str) -> None:
    report = once(box(44, 30, 8), logo, open_="both", ties=False).report
    assert report["voids"]["islands"] == 2
    assert report["infill"]["ties"] == []
    assert report["problems"] == [
        "pieces of the drawing that touch no wall were left out: 2; leave out --no-ties, or close the top or the bottom "
        "of the part"
    ]
    assert once(box(44, 30, 8), logo, open_="top", ties=False).report["problems"] == []  # what it recommends


@pytest.mark.longest
@pytest.mark.parametrize("shell", [{"wall": 0}, {"wall": 1, "open_": "both"}])
def test_a_repeated_drawing_of_islands_is_one_piece(shell: dict[str, Any], tmp_path: Path) -> None:
    """The density is that of lines and ties together."""
    path = tmp_path / "rings.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="8mm" height="8mm" viewBox="0 0 8 8"><g fill="none" '
        'stroke="black"><circle cx="4" cy="4" r="3"/><circle cx="4" cy="4" r="1.2"/></g></svg>'
    )
    result = fill(box(20, 20, 4), str(path), density=0.25, **shell)
    assert result.report["infill"]["ties"]
    assert count_bodies(result) == 1
    assert result.report["density"] == pytest.approx(0.25, abs=0.005)
    assert result.report["problems"] == []


@pytest.mark.longest
def test_loose_bodies_without_a_shell_are_told(tmp_path: Path) -> None:
    """Rings that touch nothing: how many there are besides one, and the remedy, which ties them all."""
    path = tmp_path / "ring.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="6mm" height="6mm" viewBox="0 0 6 6">'
        '<circle cx="3" cy="3" r="2" fill="none" stroke="black"/></svg>'
    )
    loose = fill(box(20, 20, 4), str(path), density=0.25, wall=0, ties=False)
    count = count_bodies(loose)
    assert count > 4
    assert loose.report["voids"]["loose"] == count - 1
    assert [problem for problem in loose.report["problems"] if "come apart" in problem] == [
        f"{count - 1} bodies of infill touch nothing and come apart; leave out --no-ties"
    ]
    tied = fill(box(20, 20, 4), str(path), density=0.25, wall=0)
    assert tied.report["voids"]["loose"] == 0
    assert not any("come apart" in problem for problem in tied.report["problems"])


@pytest.mark.longest
def test_rings_along_the_outline_are_tied_too() -> None:
    """Islands are a matter of the lines, not of drawings."""
    assert count_bodies(fill(box(20, 20, 4), "concentric", open_="both")) == 1
    assert count_bodies(fill(box(20, 20, 4), "concentric", open_="both", ties=False)) == 1  # its rings are left out
    assert fill(box(20, 20, 4), "grid", open_="both").report["infill"]["ties"] == []


def test_an_island_that_no_straight_bar_reaches_is_told() -> None:
    """Two strokes in the arms of a horseshoe without walls: the way between them bends."""
    horseshoe = shapely.box(0, 0, 30, 30) - shapely.box(10, 8, 20, 31)
    strokes = shapely.MultiLineString([[(5, 20), (5, 28)], [(25, 20), (25, 28)]])
    ties = tie_islands(strokes, horseshoe, width=0.5, walled=False)
    assert (len(ties.segments), ties.loose) == (0, 1)
    below = shapely.MultiLineString([[(5, 4), (5, 28)], [(25, 4), (25, 28)]])
    ties = tie_islands(below, horseshoe, width=0.5, walled=False)
    assert (len(ties.segments), ties.loose) == (1, 0)
    assert shapely.covers(horseshoe, shapely.linestrings(ties.segments)).all()


def test_a_drawing_beside_the_part_is_refused(logo: str) -> None:
    with pytest.raises(GeometryError, match=r"phase puts the drawing at x 7.*, and the part spans x -22 to 22, y -15"):
        once(box(44, 30, 8), logo, phase=(80, 5))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"cell": None}, "cell is missing, and .*logo.svg is drawn once; give the width"),
        ({"density": 0.2}, "density is given, and .*logo.svg is drawn once"),
        ({"regions": ["z=0..:density=40%"]}, "region is given, and .*logo.svg is drawn once"),
    ],
)
def test_a_single_drawing_has_a_width_and_no_density(given: dict[str, Any], says: str, logo: str) -> None:
    with pytest.raises(UsageError, match=says):
        fill(box(44, 30, 8), logo, repeat=False, **{"cell": 16.0, **given})


def test_a_project_does_not_move_a_single_drawing(tmp_path: Path) -> None:
    """A square that touches the walls of the part, where slicers print little of it."""
    path = tmp_path / "square.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="8mm" height="8mm" viewBox="0 0 8 8"><g fill="none" '
        'stroke="black"><rect x="0" y="0" width="8" height="8"/><path d="M0 4 L8 4"/></g></svg>'
    )
    sizes: dict[str, Any] = {"cell": 9.0, "line_width": 0.9, "voxel": 0.3}
    report = fill(box(10, 10, 6), str(path), repeat=False, as_="project", **sizes).report
    assert report["infill"]["phase"] == [0, 0, 0]
    assert report["infill"]["narrow"] > 0.1


def test_ties_are_refused_where_there_is_nothing_to_tie(tmp_path: Path) -> None:
    """A pattern in space has no islands of upright walls, and a floor and a roof hold all of them."""
    part = tmp_path / "part.stl"
    box(20, 20, 4).export(part)
    words = ("fill", part, "--ties", "--dry-run", "--pattern")
    usage_error(run(*words, "gyroid", "--wall", "0"), "--ties is for islands of upright walls, and gyroid has none")
    usage_error(run(*words, "grid"), "--ties is given, and floor and roof of the shell hold all walls")
    assert run(*words, "grid", "--open", "both").exit_code == 0
    assert run("fill", part, "--dry-run", "--no-ties").exit_code == 0
