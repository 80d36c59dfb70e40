"""Laws that hold for every pattern that fills parts: period, turns, mirrors, units, and what makes it denser.

Widths, fillets and densities are measured for every pattern. Turns, mirrors, units and repetition concern the code that
makes voids, so they run over one pattern of each kind of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import hypothesis
import numpy as np
import pytest
import shapely
import trimesh
from filled_parts import assert_filled
from hypothesis import strategies as st
from made_shapes import box, union
from shapes import IN_SPACE, one_of_each_kind

from infill import Surface, fill
from infill.lattices.fillets import DEGREES, TIPS
from infill.lattices.forecast import plan_fill
from infill.lattices.line_sample import centred_square, faces_between
from infill.lattices.request import check_request
from infill.meshes.distance import TriangleTree
from infill.meshes.merging import surface_of
from infill.meshes.winding import winding_numbers
from patterns import PATTERNS, Pattern
from patterns.cellular import Cells
from patterns.cross import Cross3D
from patterns.declared import parameter
from patterns.lightning import Lightning
from patterns.octree import Octree
from patterns.polyhedra import Polyhedra
from patterns.protocol import draw_lines, with_cell
from patterns.unit_cells import Bars, Network, Planes, Surfaces

pytestmark = pytest.mark.usefixtures("compiled")

EVERY = [*IN_SPACE, *(name for name, kind in PATTERNS.items() if kind.prismatic)]
KINDS = one_of_each_kind(EVERY)
FOLLOW = [name for name, kind in PATTERNS.items() if getattr(kind, "follows", False)]
# Without symmetry, and a whole number of cells of the grid along each side.
PART = union(box(20, 12, 10), box(6, 6, 10, (5, 0, 4)), box(3, 4, 10, (-7, 3, 2)))
EXACT: dict[str, Any] = {"voxel": 0.5, "wall": 1.0, "tolerance": 0, "smooth_radius": 0.0}  # nothing is drawn anew
QUARTER = trimesh.transformations.rotation_matrix(np.pi / 2, (0, 0, 1))
FLIP = np.diag([-1.0, 1.0, 1.0])


@cache
def far(name: str) -> dict[str, float]:
    """A cell and a line width that leave 0.3 far from any skin, and voids many cells of the grid wide."""
    kind = IN_SPACE.get(name)
    if isinstance(kind, Lightning):
        return {"cell": 3.0, "line_width": 1.6}  # which leave less: only roofs need them
    given = {"cell": 7.0} if isinstance(kind, Bars) else {"cell": 11.0} if isinstance(kind, Network) else {}
    sizes = fill(box(20, 20, 20), name, density=0.3, **(given or {"line_width": 0.8}), **EXACT).report["infill"]
    return {"cell": sizes["cell"], "line_width": sizes["line_width"]}


def farthest(one: Surface, other: Surface) -> float:
    """How far apart two surfaces are, either way, by their vertices, mm."""
    there = TriangleTree.of(one).nearest(np.asarray(other.vertices, np.float64))[0].max()
    return float(max(there, TriangleTree.of(other).nearest(np.asarray(one.vertices, np.float64))[0].max()))


@pytest.mark.long
@pytest.mark.parametrize("name", KINDS)
def test_wider_walls_and_smaller_cells_are_denser(name: str) -> None:
    sizes = far(name)
    cell, width = sizes["cell"], sizes["line_width"]

    def density(cell: float, line_width: float) -> float:
        return float(fill(PART, name, cell=cell, line_width=line_width, **EXACT).report["density"])

    middle = density(cell, width)
    assert density(cell, width / 1.2) < middle < density(cell, 1.2 * width)
    assert density(2 * cell, width) < middle


def across(voids: Surface, reach: float, inside: float) -> float:
    """The median way from void to void, straight across what is solid, mm: by points, each in a void or not."""
    mesh = voids.to_trimesh()
    some = np.random.default_rng(3).choice(len(mesh.faces), 1500, p=mesh.area_faces / mesh.area)
    points, normals = mesh.triangles_center[some], mesh.face_normals[some]
    far = np.abs(points).max(axis=1) < inside
    points, normals = points[far][:250], normals[far][:250]
    assert len(points) > 100
    step = reach / 50
    places = points[:, None] + step * (np.arange(1, 51) - 0.5)[:, None] * normals[:, None]
    hit = (winding_numbers(places.reshape(-1, 3), voids) > 0).reshape(len(points), 50)
    return float(np.median(np.where(hit.any(axis=1), hit.argmax(axis=1), 50))) * step


@pytest.mark.longest
@pytest.mark.parametrize("name", EVERY)
def test_every_pattern_keeps_its_promises_and_has_walls_as_wide_as_asked_for(name: str) -> None:
    """And bars as thick, though smoothing makes these thinner, and walls between narrow voids wider.

    A network has no walls: its line width is that of its surfaces.
    """
    kind = IN_SPACE.get(name)
    width = 1.6 if isinstance(kind, Bars) else 0.8
    given: dict[str, Any] = {"density": 0.3, "line_width": width, "voxel": 0.4}
    if isinstance(kind, Network):
        given = {"density": 0.3, "voxel": 0.4}
    elif isinstance(kind, Lightning):
        given = {"cell": 5.0, "line_width": width, "voxel": 0.25}
    block = box(*[20 if isinstance(kind, Lightning) else 18] * 3)
    result = fill(block, name, wall=1.0, **given)
    assert_filled(result, block, wall=1.0, density=given.get("density"), points=8000)
    if not isinstance(kind, Network):
        assert result.report["infill"]["line_width"] == pytest.approx(width, rel=0.06)
        inside = block.bounds[1, 0] - 1 - 1.5 * width
        assert across(result.stages.voids, 2.5 * width, inside) == pytest.approx(width, rel=0.08)


@pytest.mark.long
@pytest.mark.parametrize("name", KINDS)
def test_turning_the_part_and_the_pattern_turns_the_result(name: str) -> None:
    sizes = far(name)
    one = fill(PART, name, **sizes, **EXACT).stages.voids
    angle = 0 if name in FOLLOW else 90  # those turn with the part
    other = fill(PART.copy().apply_transform(QUARTER), name, angle=angle, **sizes, **EXACT).stages.voids
    assert other.volume == pytest.approx(one.volume, rel=1e-3)
    assert farthest(one, replace(other, vertices=np.asarray(other.vertices) @ QUARTER[:3, :3])) < 0.1


@pytest.mark.long
@pytest.mark.parametrize("name", ["gyroid", "octet", "honeycomb", "cubic"])
def test_smoothing_and_turning_may_change_places(name: str) -> None:
    """The density is met within 0.002 of it, so volumes are equal within twice that."""
    given = {"density": 0.3, "cell": far(name)["cell"], "voxel": 0.5, "wall": 1.0, "tolerance": 0, "smooth_radius": 0.5}
    one = fill(PART, name, **given).stages.voids
    other = fill(PART.copy().apply_transform(QUARTER), name, angle=90, **given).stages.voids
    assert other.volume == pytest.approx(one.volume, rel=4e-3)
    assert farthest(one, replace(other, vertices=np.asarray(other.vertices) @ QUARTER[:3, :3])) < 0.2
    sharp = fill(PART, name, **(given | {"smooth_radius": 0.0})).stages.voids
    assert sharp.area > 1.01 * one.area


@pytest.mark.longest
def test_tips_are_those_of_corners_that_stay_themselves() -> None:
    """By the equation: a curve that grows by curvature alone has, at the time 1/2, curvature = x · normal."""
    from scipy.integrate import solve_ivp
    from scipy.optimize import brentq

    def slope(tip: float) -> float:
        def along(_: float, at: Any) -> list[float]:
            x, y, turned = at
            return [np.cos(turned), np.sin(turned), y * np.cos(turned) - x * np.sin(turned)]

        return float(solve_ivp(along, (0, 30), (0.0, tip, 0.0), rtol=1e-9, atol=1e-11).y[2, -1])

    for degrees, tip in zip(DEGREES, TIPS, strict=True):
        end = np.pi / 2 - np.radians(degrees) / 2
        assert brentq(lambda at, end=end: slope(at) - end, 0.1, 3.0) == pytest.approx(tip, abs=2e-4)


@pytest.mark.longest
@pytest.mark.parametrize(("name", "corners"), [("honeycomb", 6), ("triangles", 3)])
@hypothesis.given(cell=st.floats(2.0, 9.0), half=st.floats(20, 30))
def test_no_wall_is_lost_between_voids(name: str, corners: int, cell: float, half: float) -> None:
    """Walls that meet but for rounding, in a pattern of any size: every face between them is as drawn."""
    region = centred_square(half)
    lines = shapely.intersection(draw_lines(with_cell(PATTERNS[name](), cell), centred_square(2 * half)), region)
    faces = faces_between(lines, region, cell=cell)
    whole = faces[shapely.distance(faces, region.exterior) > 0.01 * cell]
    assert len(whole) > 8
    shapes = shapely.simplify(whole, 1e-4 * cell)
    assert set(shapely.get_num_coordinates(shapes)) == {corners + 1}
    assert shapely.area(whole) == pytest.approx(np.full(len(whole), shapely.area(whole).mean()), rel=1e-4)


RADIUS = 0.8  # mm, four cells of the grid


def walls_meet(name: str) -> bool:
    """Whether walls or bars of a pattern meet or bend."""
    return name != "rectilinear" and not isinstance(IN_SPACE.get(name), Surfaces | Network | Lightning)


# With more, passages are narrower than two and a half radii.
WITH_ROOM = {"cross-3d": 0.12, "cross": 0.15}


def fillets(voids: Surface, part: Surface, radius: float = RADIUS) -> np.ndarray:
    """The radii of fillets away from the part's walls, mm: where the surface of voids is rounder than all around.

    The largest principal curvature of a quadric through the vertices within half the radius.
    """
    from scipy.spatial import cKDTree

    mesh = voids.to_trimesh()
    places, normals = np.asarray(mesh.vertices), np.asarray(mesh.vertex_normals)
    edges = np.concatenate([mesh.edges_unique, mesh.edges_unique[:, ::-1]])
    step = places[edges[:, 1]] - places[edges[:, 0]]
    bend = ((normals[edges[:, 1]] - normals[edges[:, 0]]) * step).sum(axis=1) / (step**2).sum(axis=1)
    rough = np.full(len(places), -np.inf)
    np.maximum.at(rough, edges[:, 0], bend)
    far = TriangleTree.of(part).nearest(places)[0] > 1 + 0.8 + 2.5 * radius
    round_ = np.flatnonzero(far & (rough > 0.25 / radius))
    round_ = np.random.default_rng(0).permutation(round_)[:3000]
    tree = cKDTree(places)
    bent = np.zeros(len(round_))
    for number, (each, near) in enumerate(
        zip(round_, tree.query_ball_point(places[round_], 0.5 * radius), strict=True)
    ):
        near = np.array(near)
        near = near[normals[near] @ normals[each] > 0.3]
        if len(near) < 8:
            continue
        frame = np.linalg.svd(normals[each][None])[2]  # the normal first, up to its sign
        x, y = frame[1:] @ (places[near] - places[each]).T
        up = (places[near] - places[each]) @ normals[each]
        a, b, c, p, q, _ = np.linalg.lstsq(
            np.column_stack([x * x / 2, x * y, y * y / 2, x, y, np.ones_like(x)]), up, rcond=None
        )[0]
        first = np.array([[1 + p * p, p * q], [p * q, 1 + q * q]])
        second = np.array([[a, b], [b, c]]) / np.sqrt(1 + p * p + q * q)
        bent[number] = -np.linalg.eigvals(np.linalg.solve(first, second)).real.min()
    # One of each place: the roundest within a radius.
    where, left = cKDTree(places[round_]), bent > 1 / (2.5 * radius)
    found = []
    for number in np.argsort(-bent):
        if left[number]:
            found.append(1 / bent[number])
            left[where.query_ball_point(places[round_[number]], radius)] = False
    return np.array(found)


@pytest.mark.longest
@pytest.mark.parametrize("name", [name for name in KINDS if walls_meet(name)])
def test_fillets_have_at_least_the_radius_asked_for(name: str) -> None:
    """At 95 % of all places where walls meet or bend, or bars meet, six radii thick."""
    radius, part = RADIUS, surface_of(box(20, 20, 20))
    if isinstance(IN_SPACE.get(name), Bars):
        radius = 0.5
        sizes = {"cell": 14.0, "line_width": 6 * radius}
    else:  # the cell as drawn for this density, because a search for the exact one takes minutes
        wanted = check_request(pattern=name, own={}, density=WITH_ROOM.get(name, 0.25), line_width=0.8)
        sizes = plan_fill(part, wanted)["infill"]
    result = fill(part, name, smooth_radius=radius, tolerance=0, wall=1.0, voxel=radius / 4, **sizes)
    found = fillets(result.stages.voids, result.stages.part, radius)
    assert len(found) > 40
    assert np.quantile(found, 0.05) >= radius


@pytest.mark.longest
def test_a_fillet_that_is_too_sharp_is_found() -> None:
    result = fill(box(17, 17, 17), "grid", smooth_radius=0.8 * RADIUS, voxel=0.2, tolerance=0, density=0.25)
    assert np.quantile(fillets(result.stages.voids, result.stages.part), 0.05) < 0.95 * RADIUS


@pytest.mark.longest
@pytest.mark.parametrize("name", KINDS)
def test_the_mirror_image_of_part_and_pattern_is_that_of_the_result(name: str) -> None:
    sizes = far(name)
    kind: Any = IN_SPACE[name] if name in IN_SPACE else PATTERNS[name]
    image = in_space(kind) if name in IN_SPACE else kind if name in FOLLOW else InPlane(of=kind)
    mirrored = trimesh.Trimesh(PART.vertices @ FLIP, PART.faces[:, ::-1])
    one = fill(PART, name, **sizes, **EXACT).stages.voids
    other = fill(mirrored, image, **sizes, **EXACT).stages.voids
    assert other.volume == pytest.approx(one.volume, rel=2e-3)
    assert farthest(one, replace(other, vertices=np.asarray(other.vertices) @ FLIP)) < 0.1


def in_space(kind: Cells | Pattern) -> Cells | Pattern:
    """The mirror image of a pattern in space, at x = 0."""
    if isinstance(kind, Network):
        surfaces = in_space(kind.surfaces)
        assert isinstance(surfaces, Surfaces)
        return replace(kind, surfaces=surfaces)
    if isinstance(kind, Surfaces):
        value = kind.value
        return replace(kind, value=lambda x, y, z: value(-x, y, z))
    if isinstance(kind, Bars):
        edges = tuple((tuple(a), tuple(b)) for a, b in (kind.axes() @ FLIP).tolist())
        return Bars(name="image", summary="", edges=edges, cells=kind.cells)
    if isinstance(kind, Polyhedra):
        (normals, halves), (period, middles) = kind.faces(), kind.lattice()
        return Polyhedra(
            name="image",
            summary="",
            normals=tuple(map(tuple, (normals @ FLIP).tolist())),
            halves=tuple(halves.tolist()),
            period=tuple(period.tolist()),
            middles=tuple(tuple(map(tuple, each)) for each in (middles @ FLIP).tolist()),
        )
    if isinstance(kind, Octree):
        return replace(kind, upright=tuple(map(tuple, (np.array(kind.upright) @ FLIP).tolist())))
    if isinstance(kind, Lightning):
        return replace(kind, first=(-kind.first[0], kind.first[1]))
    if isinstance(kind, Cross3D):
        return MirroredCross()
    assert isinstance(kind, Planes)
    normals = kind.families()[0] @ np.array(kind.upright) @ FLIP
    return replace(kind, normals=tuple(map(tuple, normals.tolist())), upright=tuple(map(tuple, np.eye(3).tolist())))


@dataclass(frozen=True, kw_only=True)
class MirroredCross(Cross3D):
    """The mirror image of cross-3d, at x = 0."""

    def lines(self, region: Any, z: float = 0.0) -> Any:
        there = super().lines(shapely.affinity.scale(region, -1, 1, origin=(0, 0)), z)
        return shapely.affinity.scale(there, -1, 1, origin=(0, 0))

    def level_set(self, x: Any, y: Any, z: Any) -> Any:
        return super().level_set(-x, y, z)


@dataclass(frozen=True, kw_only=True)
class InPlane(Pattern):
    """The mirror image of a pattern of lines, at x = 0."""

    name: str = "image"  # type: ignore[misc]
    summary: str = ""  # type: ignore[misc]
    of: Any
    cell: float = parameter(8.0, "period", unit="mm", low=0.1, high=100)

    def lines(self, region: Any, z: float = 0.0) -> Any:
        there = self.of(cell=self.cell).lines(shapely.affinity.scale(region, -1, 1, origin=(0, 0)), z)
        return shapely.affinity.scale(there, -1, 1, origin=(0, 0))

    def line_spacing(self, region: Any) -> float:
        return float(self.of(cell=self.cell).line_spacing(region))


@dataclass(frozen=True, kw_only=True)
class Waved(Pattern):
    """Lines that are y = 0.6 sin x, and shifted by half a cell, where 2 pi is a cell."""

    name: str = "waved"  # type: ignore[misc]
    summary: str = ""  # type: ignore[misc]
    cell: float = parameter(10.0, "period", unit="mm", low=0.1, high=100)

    def lines(self, region: Any, z: float = 0.0) -> Any:
        left, low, right, high = np.array(region.bounds) * 2 * np.pi / self.cell
        x = np.arange(left, right + 0.02, 0.02)
        shifts = np.pi * np.arange(np.floor(low / np.pi) - 1, np.ceil(high / np.pi) + 2)
        lines = [np.column_stack([x, shift - 0.6 * np.sin(x)]) * self.cell / (2 * np.pi) for shift in shifts]
        return shapely.intersection(shapely.MultiLineString(lines), region)

    def line_spacing(self, region: Any) -> float:
        return self.cell / 2


FORMS: dict[str, tuple[Any, float, Any]] = {
    "rectilinear": ("rectilinear", 5.0, lambda x, y, z: np.sin(y)),
    "waved": (Waved, 10.0, lambda x, y, z: np.sin(y + 0.6 * np.sin(x))),
    "grid": ("grid", 5.0, lambda x, y, z: np.sin(x) * np.sin(y)),
}


TURNED: dict[str, Any] = {"voxel": 0.4, "wall": 1.0, "angle": 30}


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "more"),
    [("rectilinear", EXACT), ("rectilinear", TURNED), ("waved", EXACT), ("grid", EXACT), ("grid", TURNED)],
)
def test_lines_and_the_function_that_is_0_on_them_fill_alike(name: str, more: dict[str, Any]) -> None:
    """Where walls cross too."""
    lines, cell, function = FORMS[name]
    given = {"line_width": 0.8, **more, "smooth_radius": 0.0}
    one = fill(PART, lines, cell=cell, **given)
    other = fill(PART, function, cell=10.0, **given)
    assert other.report["density"] == pytest.approx(one.report["density"], abs=0.002)
    there = TriangleTree.of(one.stages.voids).nearest(np.asarray(other.stages.voids.vertices, np.float64))[0]
    back = TriangleTree.of(other.stages.voids).nearest(np.asarray(one.stages.voids.vertices, np.float64))[0]
    assert max(there.max(), back.max()) < 0.04


@pytest.mark.long
@pytest.mark.parametrize("name", KINDS)
def test_units_are_no_matter(name: str) -> None:
    sizes = far(name)
    large = {key: 10 * value for key, value in (sizes | EXACT).items()}
    one = fill(PART, name, **sizes, **EXACT).surface
    other = fill(PART.copy().apply_scale(10), name, **large).surface
    assert other.volume == pytest.approx(1000 * one.volume, rel=1e-4)


@pytest.mark.long
@pytest.mark.parametrize("name", KINDS)
def test_what_is_made_again_is_the_same(name: str) -> None:
    one, other = (fill(PART, name, density=0.3, cell=5.0, **EXACT).surface for _ in range(2))
    assert (one.vertices == other.vertices).all()
    assert (one.faces == other.faces).all()
