"""Laws of paths in a region: clipped exactly, joined along its outline without crossing, as long as asked."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
import shapely.ops
from hypothesis import example, given
from hypothesis import strategies as st
from lines import BRACKET, DISC, PARTS, RING, least_spacing, length_of, travel_length
from roofed import ROOFED
from shapely import MultiPolygon, Polygon, box

from infill import GeometryError, ParameterError
from infill.paths import ordering
from infill.paths.clipping import clip
from infill.paths.covering import cover, solve_cell, total_length
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import CLEAR, TOUCH, Path, PathSpec
from infill.paths.joining import join
from infill.paths.layer_below import index_layer_below
from infill.paths.neighbours import index_beads
from infill.paths.ordering import order_paths
from infill.paths.outlines import outline_of
from infill.paths.trimming import EXEMPT, FARTHEST

WIDTH = 0.45
GAP = TOUCH * WIDTH
NEAR = 4 * WIDTH  # a corner of 25° comes back to 0.4 mm within this
SAMPLED = 0.002  # mm, by which the measure of spacings may be wrong
INSIDE = 1e-6  # mm
# Surfaces change with height, and a length is asked for at one.
Z, LAYER = 0.6, 3

every_family = pytest.mark.parametrize("name", FAMILIES)
# Every family at every density and in every part, once each, in turn.
ASKED = [
    (name, list(PARTS)[(number + turn) % 3], density)
    for number, name in enumerate(name for name, family in FAMILIES.items() if family.fills)
    for turn, density in enumerate((0.05, 0.15, 0.4))
]


def multi(paths: list[Path]) -> shapely.MultiLineString:
    return shapely.MultiLineString([shapely.LineString(path) for path in paths])


def assert_sound(paths: list[Path], region: Polygon | MultiPolygon) -> None:
    """Inside the region, no crossing, and beads overlap by at most 5 %."""
    if not paths:  # what is empty is covered by nothing
        return
    drawn = multi(paths)
    assert region.buffer(INSIDE).covers(drawn)
    assert drawn.is_simple
    assert least_spacing(paths, near=NEAR, most=0.6) > 0.95 * GAP - SAMPLED


# --- parts filled ----------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(("name", "part", "density"), ASKED)
def test_parts_are_filled_as_asked(name: str, part: str, density: float) -> None:
    family, region = FAMILIES[name], PARTS[part]
    outline = outline_of(region)
    asked = density * region.area / GAP
    radius = min(1.0, family.largest_radius(family.cell_for(density, WIDTH), WIDTH))
    solved = solve_cell([(outline, Z, LAYER)], family, asked, line_width=WIDTH, radius=radius)
    paths = cover(outline, family, cell=solved.cell, line_width=WIDTH, z=Z, layer=LAYER, radius=radius, start=(0, 0))
    assert_sound(paths, region)
    assert length_of(paths) == pytest.approx(solved.length)
    assert solved.error == pytest.approx(length_of(paths) / asked - 1)
    across = 2 * region.area / region.length / solved.cell
    # Rows run along walls of the bracket: they come and go whole, half of 70 mm more or less than asked. In a ring
    # narrower than a few cells every line is a piece of its own. What cannot be reached is said, as `error`.
    limit = {"disc": 0.01, "bracket": 0.025, "ring": 0.035}[part]
    if name != "concentric" or part != "ring":  # which takes a whole line around or leaves it
        assert abs(solved.error) <= limit or across < 1.5
    # Closed lines need a way from each to the next; others are joined, and ways are shorter than a fifth of them.
    closed = dict.fromkeys(("schwarz-p", "concentric", "voronoi"), 1.0)
    if across > 2:
        assert travel_length(paths) < closed.get(name, 0.35) * length_of(paths)


@pytest.mark.long
@every_family
def test_the_same_again(name: str) -> None:
    one, other = (cover(BRACKET, ROOFED[name], cell=4, line_width=WIDTH, z=Z, layer=LAYER) for _ in range(2))
    assert all((a == b).all() for a, b in zip(one, other, strict=True))


@pytest.mark.slow
def test_several_regions_and_layers_are_solved_together() -> None:
    regions = [(DISC, 0.2, 0), (BRACKET, 0.4, 1), (MultiPolygon([box(0, 0, 20, 20), box(30, 0, 50, 9)]), 0.6, 2)]
    family = FAMILIES["gyroid"]
    asked = 0.2 * sum(region.area for region, _, _ in regions) / GAP
    solved = solve_cell(regions, family, asked, line_width=WIDTH)
    length = sum(length_of(cover(r, family, cell=solved.cell, line_width=WIDTH, z=z, layer=k)) for r, z, k in regions)
    assert length == pytest.approx(solved.length)
    assert length == pytest.approx(asked, rel=0.005)


def test_the_length_may_be_measured_otherwise() -> None:
    """After rounding, for instance, which takes a share of it."""
    solved = solve_cell(
        [(DISC, Z, LAYER)],
        FAMILIES["honeycomb"],
        900,
        line_width=WIDTH,
        measure=lambda paths, _: 0.9 * total_length(paths),
    )
    paths = cover(DISC, FAMILIES["honeycomb"], cell=solved.cell, line_width=WIDTH, z=Z, layer=LAYER)
    assert 0.9 * length_of(paths) == pytest.approx(900, rel=0.005)


def test_what_cannot_be_asked_for() -> None:
    family = FAMILIES["honeycomb"]
    for length in (0.0, math.nan, -1.0):
        with pytest.raises(ParameterError, match="length is"):
            solve_cell([(DISC, Z, LAYER)], family, length, line_width=WIDTH)
    with pytest.raises(ParameterError, match="do not fit into"):
        solve_cell([(DISC, Z, LAYER)], family, 1e6, line_width=WIDTH)
    with pytest.raises(ParameterError, match="need at least"):
        cover(DISC, family, cell=0.1, line_width=WIDTH, z=Z, layer=LAYER)
    with pytest.raises(ParameterError, match="cell is nan"):
        cover(DISC, family, cell=math.nan, line_width=WIDTH, z=Z, layer=LAYER)
    with pytest.raises(ParameterError, match="line width is"):
        cover(DISC, family, cell=3, line_width=0, z=Z, layer=LAYER)
    bow = Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
    for region, said in ((bow, "Self-intersection"), (Polygon(), "empty"), (shapely.Point(0, 0), "is a Point")):
        with pytest.raises(GeometryError, match=said):
            cover(region, family, cell=3, line_width=WIDTH, z=Z, layer=LAYER)


def test_a_region_too_small_for_a_line_stays_empty() -> None:
    for family in ROOFED.values():
        assert cover(box(0.01, 0.01, 0.11, 0.11), family, cell=5, line_width=WIDTH, z=Z, layer=LAYER) == []


# --- any region --------------------------------------------------------------------------------------------------


@st.composite
def regions(draw: st.DrawFn) -> Polygon | MultiPolygon:
    """Stars about a point with holes in them, one or two of them; corners on a grid now and then, so that lines meet them."""
    shape = Polygon()
    for _ in range(draw(st.integers(1, 2))):
        count = draw(st.integers(3, 9))
        radii = draw(st.lists(st.floats(2, 14), min_size=count, max_size=count))
        x, y = draw(st.floats(-20, 20)), draw(st.floats(-20, 20))
        angle = 2 * np.pi * np.arange(count) / count
        points = np.stack([x + radii * np.cos(angle), y + radii * np.sin(angle)], axis=-1)
        if draw(st.booleans()):
            points = np.round(points)
        star = Polygon(points)
        if not star.is_valid or star.area < 1:
            continue
        hole = shapely.Point(x, y).buffer(draw(st.floats(0.5, 3)), 8)
        shape = shape.union(star.difference(hole) if draw(st.booleans()) else star)
    return shape if shape.area > 1 else box(0, 0, 10, 10)


def waves(cell: float) -> list[Path]:
    return FAMILIES["grid"].strands((-40, -40, 40, 40), PathSpec(cell=cell, line_width=WIDTH, z=0, layer=0, radius=0))


@pytest.mark.longest
@given(regions(), st.floats(1.5, 9))
@example(box(0, 0, 9, 9), 3.0)
@example(Polygon([(-10, 5), (-16, 8), (-16, 11), (-15, 13), (-13, 13), (-12, 11)]), 1.9)  # a wave begins on its edge
def test_clipping_keeps_what_is_inside_and_nothing_else(region: Polygon | MultiPolygon, cell: float) -> None:
    paths = [
        *waves(cell),
        *FAMILIES["schwarz-p"].strands(
            (-40, -40, 40, 40), PathSpec(cell=2 * cell, line_width=WIDTH, z=0, layer=0, radius=0)
        ),
    ]
    outline = outline_of(region)
    pieces = clip(paths, outline)
    expected = sum(shapely.LineString(path).intersection(region).length for path in paths)
    # Lines along the outline itself may go either way; these regions have none but by chance of rounding.
    along = sum(shapely.LineString(path).intersection(region.boundary).length for path in paths)
    assert length_of(pieces.paths) == pytest.approx(expected, abs=along + 1e-6)
    for path, ring, place in zip(pieces.paths, pieces.ring, pieces.place, strict=True):
        assert region.buffer(INSIDE).contains(shapely.LineString(path))
        for end, one, where in zip((path[0], path[-1]), ring, place, strict=True):
            if one >= 0:
                assert outline.points_at(int(one), np.array([where]))[0] == pytest.approx(end, abs=INSIDE)
        if ring[0] < 0:
            assert (path[0] == path[-1]).all()


@pytest.mark.longest
@given(regions(), st.sampled_from(list(FAMILIES)), st.floats(1.5, 9))
def test_any_region_is_covered_soundly(region: Polygon | MultiPolygon, name: str, cell: float) -> None:
    # A slot narrower than a bead holds no wall: no slicer leaves one between two parts of a region.
    region = region.buffer(WIDTH).buffer(-WIDTH)
    paths = cover(region, ROOFED[name], cell=cell, line_width=WIDTH, z=Z, layer=LAYER, start=(0, 0))
    assert_sound(paths, region)


@pytest.mark.longest
@given(regions(), st.floats(1.5, 9))
def test_joining_only_adds_walls(region: Polygon | MultiPolygon, cell: float) -> None:
    outline = outline_of(region)
    pieces = clip(waves(cell), outline)
    bare = join(pieces, outline, line_width=WIDTH, anchor=0, anchor_max=0)
    anchored = join(pieces, outline, line_width=WIDTH, anchor=2.5, anchor_max=0)
    joined = join(pieces, outline, line_width=WIDTH, anchor=2.5, anchor_max=12)
    long = [path for path in pieces.paths if length_of([path]) >= 2 * WIDTH]
    # What is taken away is ends that come near to other lines.
    apart = least_spacing(long, near=EXEMPT * WIDTH, most=WIDTH) >= CLEAR * TOUCH * WIDTH
    reach = 0.0 if apart else FARTHEST * WIDTH
    assert length_of(long) - 2 * reach * len(long) - 1e-9 <= length_of(bare) <= length_of(long) + 1e-9
    assert len(long) >= len(bare) >= len(long) * apart
    assert len(anchored) >= len(joined)
    # Each end adds an anchor at most, each join a wall.
    assert length_of(anchored) <= length_of(bare) + 5 * len(bare) + 1e-9
    for path in long:
        inner = shapely.ops.substring(shapely.LineString(path), reach, max(reach, length_of([path]) - reach))
        if inner.length > 2 * WIDTH:
            assert multi(joined).buffer(INSIDE).contains(inner)


# --- joining and order, in the small -----------------------------------------------------------------------------


def lines_across(count: int, apart: float = 2.0) -> list[Path]:
    return [np.array([[-1.0, apart * (k + 0.5)], [11.0, apart * (k + 0.5)]]) for k in range(count)]


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_parallel_lines_become_one_path(count: int) -> None:
    region = outline_of(box(0, 0, 10, 2 * count))
    (path,) = join(clip(lines_across(count), region), region, line_width=WIDTH, anchor=0, anchor_max=12)
    assert length_of([path]) == pytest.approx(10 * count + 2 * (count - 1))


@pytest.mark.parametrize("seed", range(4))
def test_equal_gaps_are_walked_on_one_side(seed: int) -> None:
    """Touching waves are joined by hairpins at one end of each pair: all at one side, or the path would end between."""
    ring = shapely.get_coordinates(shapely.segmentize(box(0, 0, 60, 60).exterior, 1))[:-1]
    rough = Polygon(ring + np.random.default_rng(seed).uniform(-0.002, 0.002, ring.shape))
    paths = cover(rough, FAMILIES["honeycomb"], cell=6, line_width=WIDTH, z=Z, layer=LAYER)
    assert len(paths) == 1


@pytest.mark.parametrize("mirrored", [False, True])
def test_ends_are_joined_above_what_lies_below(mirrored: bool) -> None:
    region = outline_of(box(0, 0, 10, 8))
    pieces = clip(lines_across(4), region)
    plain = join(pieces, region, line_width=WIDTH, anchor=0, anchor_max=12)
    below = [path * (-1, 1) + (10, 0) if mirrored else path for path in plain]
    ground = index_layer_below(below, index_beads(np.empty((0, 2))), WIDTH)
    paths = join(pieces, region, line_width=WIDTH, anchor=0, anchor_max=12, ground=ground)
    assert multi(paths).equals(multi(below))
    assert multi(plain).equals(multi(below)) != mirrored


def test_free_ends_are_anchored_above_what_lies_below() -> None:
    region = outline_of(box(0, 0, 10, 8))
    pieces = clip(lines_across(2, apart=4.0), region)
    for up in (-2.0, 2.0):
        wall = shapely.segmentize(shapely.LineString([(10, 2), (10, 2 + up)]), 0.1)
        ground = index_layer_below([], index_beads(shapely.get_coordinates(wall)), WIDTH)
        (path,) = (
            path
            for path in join(pieces, region, line_width=WIDTH, anchor=1.5, anchor_max=0, ground=ground)
            if path[:, 1].min() < 3
        )
        anchored = path[path[:, 0] > 10 - INSIDE]
        assert np.ptp(anchored[:, 1]) == pytest.approx(1.5)
        assert (anchored[:, 1].mean() - 2) * up > 0


@pytest.mark.longest
@given(regions(), st.sampled_from(list(FAMILIES)), st.floats(1.5, 9))
def test_any_region_is_covered_soundly_above_another(region: Polygon | MultiPolygon, name: str, cell: float) -> None:
    region = region.buffer(WIDTH).buffer(-WIDTH)
    under = cover(region.buffer(0.4), FAMILIES[name], cell=cell, line_width=WIDTH, z=Z, layer=LAYER)
    ground = index_layer_below(under, index_beads(shapely.get_coordinates(region)), WIDTH)
    paths = cover(region, FAMILIES[name], cell=cell, line_width=WIDTH, z=Z, layer=LAYER, ground=ground)
    assert_sound(paths, region)


def test_gaps_longer_than_asked_are_not_walked() -> None:
    region = outline_of(box(0, 0, 10, 8))
    pieces = clip(lines_across(4), region)
    paths = join(pieces, region, line_width=WIDTH, anchor=0, anchor_max=1.9)
    assert len(paths) == 4
    anchored = join(pieces, region, line_width=WIDTH, anchor=0.7, anchor_max=1.9)
    # Six ends between two others, two anchors a gap; those beside the corners have room as well.
    assert length_of(anchored) == pytest.approx(40 + 8 * 0.7)


def test_a_wall_beside_a_line_stays_free() -> None:
    region = outline_of(box(-20, 0, 30, 4))
    beside = np.array([[3.0, 0.2], [7.0, 0.2], [7.0, 3.0], [3.0, 3.0], [3.0, 0.2]])
    across = [np.array([[x, -1.0], [x, 2.0], [x + 0.1, 2.0], [x + 0.1, 5.0]]) for x in (1.0, 9.0)]
    paths = join(clip([beside, *across], region), region, line_width=WIDTH, anchor=0, anchor_max=12)
    assert len(paths) == 2
    upper, lower = (shapely.LineString([(-20, y), (30, y)]) for y in (4, 0))
    assert multi(paths).intersection(upper).length == pytest.approx(8)
    assert multi(paths).intersection(lower).length == 0


def test_a_line_along_the_outline_does_no_harm() -> None:
    region = box(0, 0, 10, 4)
    lines = [np.array([[-1.0, 0.0], [11.0, 0.0]]), np.array([[2.0, -1.0], [2.0, 0.0], [6.0, 0.0], [6.0, 5.0]])]
    pieces = clip(lines[1:], outline_of(region))
    assert length_of(pieces.paths) in (pytest.approx(4), pytest.approx(8))
    assert length_of(clip(lines[:1], outline_of(region)).paths) in (pytest.approx(0), pytest.approx(10))


def test_a_closed_line_that_leaves_the_region_is_cut_where_it_leaves() -> None:
    ring = np.array([[2.0, 2.0], [6.0, 2.0], [6.0, -2.0], [2.0, -2.0], [2.0, 2.0]])
    (path,) = clip([ring], outline_of(box(0, 0, 10, 10))).paths
    assert path.tolist() == [[2.0, 0.0], [2.0, 2.0], [6.0, 2.0], [6.0, 0.0]]


def test_order_goes_to_the_nearest_end() -> None:
    rng = np.random.default_rng(3)
    paths = [rng.uniform(0, 50, 2) + np.array([[0, 0], [1, 0], [1, 1]]) for _ in range(200)]
    ordered = order_paths(paths, (0, 0))
    assert length_of(ordered) == pytest.approx(length_of(paths))
    assert travel_length(ordered, (0, 0)) < 0.25 * travel_length(paths, (0, 0))
    assert order_paths([], (0, 0)) == []
    ring = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 0.0]])
    assert order_paths([ring], (5.0, 5.0))[0].tolist() == [[4.0, 4.0], [0.0, 0.0], [4.0, 0.0], [4.0, 4.0]]


def test_thin_rings_are_joined() -> None:
    paths = cover(RING, FAMILIES["rectilinear"], cell=2.0, line_width=WIDTH, z=Z, layer=LAYER)
    assert len(paths) <= 8  # of 60 lines


@pytest.mark.parametrize("raster", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("seed", range(8))
def test_few_paths_come_in_the_order_of_many(monkeypatch: pytest.MonkeyPatch, seed: int, raster: float) -> None:
    """Whose nearest point a tree finds; on a raster, several are often as near."""
    random = np.random.default_rng(seed)
    paths = [random.random((count, 2)) * 20 for count in random.integers(2, 20, 40)]
    paths = [np.round(path / raster) * raster for path in paths] if raster else paths
    paths[::4] = [np.concatenate([path, path[:1]]) for path in paths[::4]]
    few = order_paths(paths)
    monkeypatch.setattr(ordering, "FEW", 0)
    for one, other in zip(few, order_paths(paths), strict=True):
        np.testing.assert_array_equal(one, other)
