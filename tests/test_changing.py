"""Patterns whose lines are others at every height, in a part: cross-3d, and those of users."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from made_shapes import box
from test_slabs import asked

from infill import Surface, fill
from infill.interior.interior import compute_interior
from infill.lattices.task import FillTask
from infill.lattices.voids import Layout
from infill.meshes.distance import TriangleTree
from infill.meshes.winding import winding_numbers
from patterns import Cross, Pattern, cell_parameter
from patterns.cross import Cross3D

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

REGION = shapely.box(-21, -17, 20, 23)
GIVEN: dict[str, Any] = {"line_width": 0.8, "wall": 1.0, "tolerance": 0, "smooth_radius": 0.0}


def beside(pattern: Pattern, z: float) -> tuple[np.ndarray, np.ndarray]:
    """Points a little to the left and to the right of every line."""
    lines = shapely.get_parts(pattern.lines(REGION, z))
    points, line = shapely.get_coordinates(lines, return_index=True)
    joined = np.flatnonzero(line[1:] == line[:-1])
    one, other = points[joined], points[joined + 1]
    long = np.linalg.norm(other - one, axis=1)
    kept = long > 0.3
    way = ((other - one) / long[:, None])[kept]
    middle, aside = ((one + other) / 2)[kept], 0.05 * np.stack([-way[:, 1], way[:, 0]], axis=1)
    return middle + aside, middle - aside


@pytest.mark.parametrize("angle", [0, 33])
def test_every_line_of_cross_3d_parts_its_two_sides(angle: float) -> None:
    pattern = Cross3D(cell=3.0, angle=angle, phase=(0.4, -0.7), frame=False)
    for z in (0.0, 1.7, -4.0, 9.1):
        left, right = (pattern.level_set(*each.T, np.full(len(each), z)) for each in beside(pattern, z))
        assert len(left) > 100
        assert (left == -right).all()
    # And there are no others: half of all is on either side of them.
    places = np.random.default_rng(0).uniform(-400, 400, (100000, 3))
    assert abs(pattern.level_set(*places.T).mean()) < 0.2


@pytest.mark.slow
def test_walls_wind_about_where_they_would_stand_and_lean_no_more_than_asked() -> None:
    for lean in (20.0, 45.0, 60.0):
        pattern = Cross3D(cell=3.0, lean=lean, frame=False)
        assert pattern.lines(REGION, 2.0).equals_exact(pattern.lines(REGION, 2.0 + pattern.height), 1e-6)
        x, y = (0.75 * np.cos(2 * np.pi / 8), 0.75 * np.sin(2 * np.pi / 8))
        there = Cross(cell=3.0, phase=(2 * x, 2 * y), frame=False).lines(REGION)
        assert pattern.lines(REGION, pattern.height / 8).equals_exact(there, 1e-6)
        step, moved = pattern.height / 500, []
        for z in np.linspace(0, pattern.height, 9):
            one, other = pattern.lines(REGION, z), pattern.lines(REGION.buffer(1), z + step)
            moved.append(shapely.hausdorff_distance(one, shapely.intersection(other, REGION.buffer(0.2))))
            points = shapely.points(shapely.get_coordinates(shapely.segmentize(one, 0.5)))
            assert shapely.distance(points, other).max() <= step * np.tan(np.radians(lean)) * 1.001
        assert max(moved) > 0.5 * step * np.tan(np.radians(lean))


@dataclass(frozen=True, kw_only=True)
class Leaning(Pattern):
    """Straight walls that lean to one side as they rise: by lines alone."""

    name = "leaning"
    summary = ""
    prismatic = False
    cell: float = cell_parameter(6.0)
    slope: float = 0.5

    def lines(self, region: Any, z: float = 0.0) -> Any:
        x0, y0, x1, y1 = region.bounds
        first, last = np.floor((np.array([x0, x1]) - self.slope * z) / self.cell) + np.array([0, 1])
        at = self.slope * z + self.cell * np.arange(first, last + 1)
        return shapely.intersection(shapely.multilinestrings([[(x, y0), (x, y1)] for x in at]), region)

    def line_spacing(self, region: Any) -> float:
        return self.cell


@dataclass(frozen=True, kw_only=True)
class LeaningSurface(Leaning):
    """The same, which also tells sides apart."""

    name = "leaning-surface"

    def level_set(self, x: Any, y: Any, z: Any) -> Any:
        return np.sin(np.pi * (x - self.slope * z) / self.cell)


@dataclass(frozen=True, kw_only=True)
class Twisting(Leaning):
    """Upright walls, and others across that meet them at a right angle where z is 0, and turn above and below."""

    name = "twisting"
    slope: float = 0.0
    turn: float = 3.0  # degrees a millimetre

    def lines(self, region: Any, z: float = 0.0) -> Any:
        straight = shapely.multilinestrings([[(-100, y), (100, y)] for y in np.arange(-96, 97, self.cell)])
        across = shapely.affinity.rotate(straight, self.turn * z, origin=(0, 0))
        return shapely.union(super().lines(region, z), shapely.intersection(across, region))


@pytest.mark.slow
@pytest.mark.parametrize("turn", [0.0, 1.5, 3.0])
def test_fillets_suit_the_height_at_which_walls_meet_at_the_sharpest_angles(turn: float) -> None:
    part = box(24, 20, 22)
    inside = compute_interior(Surface(vertices=part.vertices, faces=part.faces), wall=1.0, voxel=0.5)
    fields = FillTask.of(inside.part, asked(Twisting(turn=turn))).draw(Layout(space=inside, cell=6.0, width=0.8))
    assert fields.find_sharpest() == pytest.approx(90 - 10 * turn, abs=0.5 * turn)


def to_walls(points: np.ndarray, cell: float, slope: float) -> np.ndarray:
    """How far points lie from the middle of the nearest wall."""
    off = points[:, 0] - slope * points[:, 2]
    return np.abs(off - cell * np.round(off / cell)) / np.hypot(1, slope)


@pytest.mark.longest
@pytest.mark.parametrize(("kind", "slope"), [(Leaning, 0.6), (LeaningSurface, 0.6), (LeaningSurface, 0.0)])
def test_walls_of_lines_that_change_are_as_wide_as_asked_for_however_they_lean(kind: Any, slope: float) -> None:
    part = box(24, 20, 22)
    result = fill(part, kind(slope=slope), cell=6.0, voxel=0.25, **GIVEN)
    voids = result.stages.voids
    points = np.asarray(voids.vertices, dtype=np.float64)
    far = (np.abs(points) < np.array([12, 10, 11]) - 1.5).all(axis=1)
    away = to_walls(points[far], 6.0, slope)
    assert len(away) > 2000
    assert np.abs(away - 0.4).max() < 0.05
    # Points in walls are in no void, and those between them are in one.
    places = np.random.default_rng(5).uniform(-1, 1, (20000, 3)) * (np.array([12, 10, 11]) - 1.2)
    solid = winding_numbers(places, voids) == 0
    near = to_walls(places, 6.0, slope)
    assert solid[near < 0.33].all()
    assert not solid[near > 0.47].any()


@pytest.mark.longest
def test_a_level_set_makes_two_voids_that_share_no_field_and_lines_make_one() -> None:
    """So the grid may be as coarse as the voids allow with the one, and must resolve walls with the other."""
    part = box(30, 30, 30)
    grids = {}
    for kind in (Leaning, LeaningSurface):
        report = fill(part, kind(), cell=6.0, line_width=0.45).report
        assert report["problems"] == []
        grids[kind.name] = report["grid"]["spacing"][0]
    assert grids["leaning"] <= 0.45 / 3 * 1.001
    assert grids["leaning-surface"] > 0.25


@pytest.mark.longest
@pytest.mark.parametrize("kind", [Leaning, LeaningSurface, Cross3D])
def test_the_density_is_that_asked_for_and_nothing_hangs_free(kind: Any) -> None:
    result = fill(box(20, 20, 20), kind(), density=0.25, line_width=0.8, wall=1.0)
    assert result.report["problems"] == []
    assert result.report["density"] == pytest.approx(0.25, abs=0.005)
    assert result.report["voids"]["islands"] == 0


@pytest.mark.longest
def test_the_pattern_rises_with_align_and_phase() -> None:
    part = box(20, 20, 20)
    given = {"cell": 6.0, "voxel": 0.4, **GIVEN}
    one = fill(part, LeaningSurface(slope=0.5), phase=(0, 0, 4), **given).stages.voids
    other = fill(part, LeaningSurface(slope=0.5), phase=(-2, 0, 0), **given).stages.voids
    assert apart(one, other) < 0.02
    bed = fill(part, LeaningSurface(slope=0.5), align="bed", **given).stages.voids
    again = fill(part, LeaningSurface(slope=0.5), phase=(0, 0, -10), **given).stages.voids
    assert apart(bed, again) < 0.02


def apart(one: Surface, other: Surface) -> float:
    return float(TriangleTree.of(one).nearest(np.asarray(other.vertices, np.float64))[0].max())
