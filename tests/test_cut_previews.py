"""Pictures of filled parts that are cut open: where, and what the cut shows."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from made_shapes import box, less, together
from PIL import Image
from typer.testing import CliRunner

from infill import ParameterError, Surface, UsageError
from infill.cli.app import build_app
from infill.pictures import cuts
from infill.pictures.cuts import CUT, draw_cuts
from infill.pictures.sections import AXES, Cut, check_cuts, choose_cuts, parse_cut

pytestmark = pytest.mark.usefixtures("compiled")

SIDE, WALL = 30.0, 1.2


def surface(mesh: Any) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices, dtype=np.float64), faces=np.asarray(mesh.faces))


def walls(*axes: int, cells: int, width: float = 0.45) -> trimesh.Trimesh:
    """A block with walls across some axes, evenly apart; an even number has one right in the middle."""
    inside = SIDE - 2 * WALL
    voids = []
    counts = [cells if axis in axes else 1 for axis in range(3)]
    for cell in np.ndindex(*counts):
        size = [inside / count - (width if count > 1 else 0) for count in counts]
        at = [(index + 0.5) * inside / count - inside / 2 for index, count in zip(cell, counts, strict=True)]
        voids.append(box(*size, tuple(at)))
    return less(box(SIDE, SIDE, SIDE), *voids)


def void_at(mesh: trimesh.Trimesh, cut: Cut) -> float:
    """The share of a section that is void, by the lines in which trimesh cuts faces and the divergence of (x, y)."""
    normal = np.eye(3)[cut.axis]
    lines, faces = trimesh.intersections.mesh_plane(mesh, normal, cut.at * normal, return_faces=True)
    outwards = np.delete(mesh.face_normals[faces], cut.axis, axis=1)
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    middle = np.delete(lines.mean(axis=1), cut.axis, axis=1)
    length = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
    area = ((middle * outwards).sum(axis=1) * length).sum() / 2
    return float(1 - area / SIDE**2)


@pytest.mark.long
@pytest.mark.parametrize("cells", [2, 4, 5, 6, 12])
@pytest.mark.parametrize("axes", [(0, 1), (0, 1, 2), (2,), (0, 2)])
def test_no_cut_runs_along_a_wall(axes: tuple[int, ...], cells: int) -> None:
    mesh = walls(*axes, cells=cells)
    for cut in choose_cuts(surface(mesh), surface(box(SIDE, SIDE, SIDE))):
        assert void_at(mesh, cut) > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("cells", [4, 6])
def test_the_middle_shows_a_solid_part(cells: int) -> None:
    """What was drawn before: the law above can fail."""
    mesh = walls(0, 1, 2, cells=cells)
    assert all(void_at(mesh, Cut(axis=axis, at=1e-5)) < 0.01 for axis in (1, 2))


@pytest.mark.parametrize("axis", [0, 1])
def test_an_upright_cut_meets_the_walls(axis: int) -> None:
    """Of walls all one way, it is across them, not between two."""
    upright, level = choose_cuts(surface(walls(axis, cells=6)), surface(box(SIDE, SIDE, SIDE)))
    assert upright.axis == 1 - axis
    assert level.axis == 2


def test_a_cut_is_half_way_between_two_walls() -> None:
    upright, _ = choose_cuts(surface(walls(0, 1, cells=6)), surface(box(SIDE, SIDE, SIDE)))
    cell = (SIDE - 2 * WALL) / 6
    # Planes that are tried are 0.5 mm apart.
    assert abs((abs(upright.at) % cell) - cell / 2) < 0.55


def test_a_cut_meets_a_part_of_two_bodies() -> None:
    """Nothing is in the middle between them."""
    body = walls(0, 1, cells=4)
    both = together(body, body.copy().apply_translation((0, 50, 0)))
    outer = together(box(SIDE, SIDE, SIDE), box(SIDE, SIDE, SIDE, (0, 50, 0)))
    upright, level = choose_cuts(surface(both), surface(outer))
    for cut in (upright, level):
        section = both.section(plane_origin=cut.at * np.eye(3)[cut.axis], plane_normal=np.eye(3)[cut.axis])
        assert section is not None


def test_given_cuts_take_the_place_of_their_kind() -> None:
    mesh = surface(walls(0, 1, cells=4))
    low, side = Cut(axis=2, at=-5.0), Cut(axis=0, at=3.0)
    assert choose_cuts(mesh, given=[low])[1:] == [low]
    assert choose_cuts(mesh, given=[low])[0].axis < 2
    assert choose_cuts(mesh, given=[side])[0] == side
    assert choose_cuts(mesh, given=[side, low]) == [side, low]


def test_a_caption_has_regions_and_walls(monkeypatch: pytest.MonkeyPatch) -> None:
    """Density, pattern and wall of every region, as the summary has them, beside those of the whole part."""
    region = {"wanted": 0.4, "volume": 1.0, "wall": 2.0}
    report = {
        "extents": [SIDE] * 3,
        "density": 0.3,
        "request": {"pattern": "grid", "wall": 1.2},
        "voids": {"count": 1},
        "regions": [
            {**region, "place": "rest", "pattern": "grid", "density": 0.199, "wall": 1.2, "least": 1.18},
            {**region, "place": "z=0..10", "pattern": "cubic", "density": 0.401, "least": 1.99},
            {**region, "place": "z=90..", "pattern": None, "density": None, "least": None},
        ],
    }
    captions = []
    monkeypatch.setattr(cuts, "arrange_panels", lambda panels, facts, legend: captions.append(facts))
    monkeypatch.setattr(cuts, "choose_cuts", lambda *_: [])
    mesh = surface(walls(0, 1, cells=4))
    cuts.draw_cuts(mesh, report)
    cuts.draw_cuts(mesh, report | {"regions": []})
    cuts.draw_cuts(mesh, report | {"regions": [], "request": {"pattern": "grid", "wall": 0}})
    assert [caption.partition(" mm, ")[2] for caption in captions] == [
        "grid, 30.0% solid inside walls of 1.2 mm to 2 mm: 19.9% elsewhere with a wall of 1.18 mm, "
        "40.1% cubic in z=0..10 with a wall of 1.99 mm",
        "grid, 30.0% solid inside walls of 1.2 mm",
        "grid, 30.0% solid, without a shell",
    ]


@pytest.mark.long
@pytest.mark.parametrize("axis", range(3))
def test_the_cut_face_is_seen(axis: int) -> None:
    """In the colour of cuts, from every side that one is looked at from."""
    report = {
        "extents": [SIDE] * 3,
        "density": 0.2,
        "request": {"pattern": "grid", "wall": WALL},
        "regions": [],
        "voids": {"count": 1},
    }
    given = [Cut(axis=axis, at=2.0)]
    picture = np.asarray(draw_cuts(surface(walls(0, 1, cells=4)), report, given=given)).astype(float)
    panel = picture[40:450, :434] if axis < 2 else picture[40:450, 434:]
    share = panel / np.maximum(panel.max(axis=2, keepdims=True), 1)
    seen = (np.abs(share - np.array(CUT) / max(CUT)) < 0.02).all(axis=2)
    assert seen.mean() > 0.02


@pytest.mark.parametrize("text", ["z=10", "X = -2.5", "y=.5mm", "z=1e1", " x=3. "])
def test_a_cut_is_read_as_it_is_meant(text: str) -> None:
    cut = parse_cut(text)
    assert AXES[cut.axis] == text.strip()[0].lower()
    assert cut.at == float(text.split("=")[1].replace("mm", ""))


@pytest.mark.parametrize("text", ["", "10", "w=3", "z", "z=", "z=ten", "z=1,2", "x=1 y=2", "=3", "z==1", "z=1in"])
def test_a_cut_that_cannot_be_read_is_wrong_usage(text: str) -> None:
    with pytest.raises(UsageError, match=r"give x, y or z and a place in mm, such as z=10"):
        parse_cut(text)


@pytest.mark.parametrize("text", ["z=nan", "x=inf", "y=-inf"])
def test_a_cut_is_somewhere(text: str) -> None:
    with pytest.raises(ParameterError, match="give a place in mm"):
        parse_cut(text)


def test_a_cut_beside_the_part_is_told_with_where_it_is() -> None:
    bounds = np.array([[0.0, 0, 0], [10, 20, 30]])
    check_cuts([Cut(axis=2, at=29.9)], bounds)
    for at in (30.0, -1.0, 0.0):
        with pytest.raises(
            ParameterError, match=r"the part goes from z = 0 to 30 mm; give a place between, such as z=15"
        ):
            check_cuts([Cut(axis=2, at=at)], bounds)


@pytest.mark.longest
def test_the_command_cuts_where_it_is_told(tmp_path: Path) -> None:
    part, picture = tmp_path / "part.stl", tmp_path / "cut.png"
    box(20, 20, 20).export(part)
    words = ["fill", str(part), "--pattern", "grid", "--voxel", "0.5", "-q", "--preview", str(picture), "--force"]
    assert CliRunner().invoke(build_app("fill"), words).exit_code == 0
    usual = np.asarray(Image.open(picture))
    assert CliRunner().invoke(build_app("fill"), [*words, "--cut", "z=5", "--cut", "x=-3"]).exit_code == 0
    assert (np.asarray(Image.open(picture)) != usual).any()
    picture.unlink()
    for cut, code, said in (("z=99", 1, "error: --cut is z=99"), ("w=3", 2, "--cut is 'w=3'"), ("z=nan", 1, "--cut")):
        done = CliRunner().invoke(build_app("fill"), [*words, "--cut", cut])
        assert (done.exit_code, said in done.output) == (code, True), done.output
        assert not picture.exists()
    without = CliRunner().invoke(build_app("fill"), ["fill", str(part), "--cut", "z=5", "-o", str(tmp_path / "a.stl")])
    assert without.exit_code == 2
    assert "give --preview FILE.png" in without.output
