"""One contract for every pattern, then what is special about each."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from importlib.metadata import EntryPoint

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import box
from shapes import BUILT_IN, DESIGNS, LEVEL_SETS, REGIONS, Ripples

from patterns import (
    PATTERNS,
    ArchimedeanChords,
    Concentric,
    ConcentricHeart,
    Cross,
    Hilbert,
    Honeycomb,
    Octagons,
    OctagramSpiral,
    Pattern,
    PatternError,
    PatternWarning,
    Registry,
    Zigzag,
    gives,
    lacking,
    parameters,
)
from patterns import parameter as described
from patterns.heart import heart_outline
from patterns.linework import body_numbers, sample_points
from patterns.shared import SHARED

ROUNDING = 1e-9  # mm: clipping computes the cut points

every_design = pytest.mark.parametrize("pattern", [*DESIGNS, *LEVEL_SETS], ids=repr)
every_region = pytest.mark.parametrize("region", REGIONS, ids=["square", "rectangle", "disc", "notched"])


@pytest.mark.long
@every_design
@every_region
def test_lines_and_points_lie_inside_the_region(pattern: Pattern, region: shapely.Polygon) -> None:
    lines = pattern.lines(region)
    assert isinstance(lines, shapely.MultiLineString)
    assert lines.length > 0
    assert region.buffer(ROUNDING).contains(lines)
    points = pattern.points(region, 0.3)
    assert points.shape[1] == 2
    assert points.dtype == np.float64
    assert shapely.contains_xy(region.buffer(ROUNDING), points).all()


@pytest.mark.long
@every_design
def test_points_follow_the_lines_closely(pattern: Pattern) -> None:
    lines, spacing = pattern.lines(REGIONS[0]), 0.25
    points = pattern.points(REGIONS[0], spacing)
    assert shapely.distance(shapely.points(points), lines).max() < ROUNDING
    # Every place on a line has a point within half the spacing: so neighbours are at most one apart.
    probes = sample_points(lines, 0.05)
    distance = shapely.STRtree(shapely.points(points)).query_nearest(
        shapely.points(probes), return_distance=True, all_matches=False
    )[1]
    assert distance.max() <= spacing / 2 + ROUNDING


@pytest.mark.slow
@every_design
def test_height_does_not_matter_to_prismatic_patterns(pattern: Pattern) -> None:
    assert pattern.prismatic
    assert pattern.lines(REGIONS[0], 0.0).equals(pattern.lines(REGIONS[0], 12.5))


@every_design
def test_patterns_keep_the_protocol(pattern: Pattern) -> None:
    assert lacking(pattern) == lacking(type(pattern)) == []
    assert gives(pattern) == gives(type(pattern))
    assert set(gives(pattern)) & {"lines", "level set"}
    assert pattern.summary
    assert pattern.line_spacing(REGIONS[0]) > 0
    assert parameters(pattern)


def test_every_design_is_in_the_catalogue() -> None:
    assert {type(pattern) for pattern in DESIGNS} == {PATTERNS[name] for name in BUILT_IN}


@pytest.mark.longest
@every_design
@pytest.mark.parametrize("spacing", [0, -1, math.nan, math.inf])
def test_a_bad_spacing_of_points_is_refused(pattern: Pattern, spacing: float) -> None:
    with pytest.raises(PatternError, match="spacing"):
        pattern.points(REGIONS[0], spacing)


@pytest.mark.slow
@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.parametrize("value", [0, -3, math.nan, math.inf, 1e9])
def test_a_bad_cell_is_refused(name: str, value: float) -> None:
    with pytest.raises(PatternError, match=f"cell of {name}"):
        PATTERNS[name](cell=value)


@pytest.mark.parametrize("name", ["honeycomb", "zigzag"])
def test_the_frame_is_the_outline_of_the_region(name: str) -> None:
    region = REGIONS[3]
    bare, framed = (PATTERNS[name](frame=frame).lines(region) for frame in (False, True))
    assert framed.length == pytest.approx(bare.length + region.length)


def test_framed_designs_hang_together() -> None:
    for name in ("honeycomb", "zigzag"):
        assert body_numbers(PATTERNS[name]().lines(REGIONS[0])).max() == 0


@pytest.mark.longest
@given(
    cell=st.floats(2, 15),
    angle=st.floats(-180, 180),
    x=st.floats(-20, 20),
    y=st.floats(-20, 20),
)
def test_honeycomb_density_is_exact(cell: float, angle: float, x: float, y: float) -> None:
    """A wall length of 2 / cell on every mm², whatever the angle and phase."""
    region = shapely.Point(0, 0).buffer(20 * cell, quad_segs=64)
    lines = Honeycomb(cell=cell, angle=angle, phase=(x, y), frame=False).lines(region)
    # The edge of the disc cuts cells at random: 120 cells around it, 1 % of 1450.
    assert lines.length / region.area == pytest.approx(2 / cell, rel=0.01)


def test_honeycomb_is_regular() -> None:
    """About (0, 0) lies a hexagon with equal sides, `cell` across."""
    cell = 6.0
    lines = Honeycomb(cell=cell, frame=False).lines(box(-3.5, -3.7, 3.5, 3.7))
    joined = shapely.union_all(shapely.set_precision(lines, 1e-9))  # corners agree to rounding only
    hexagon = max(shapely.polygonize([joined]).geoms, key=lambda polygon: polygon.area)
    assert hexagon.centroid.distance(shapely.Point(0, 0)) < ROUNDING
    corners = shapely.get_coordinates(hexagon)[:-1]
    assert len(corners) == 6
    assert np.linalg.norm(corners, axis=1) == pytest.approx(cell / math.sqrt(3))
    assert hexagon.area == pytest.approx(math.sqrt(3) / 2 * cell**2)


@pytest.mark.slow
@pytest.mark.parametrize("kind", [Honeycomb, Octagons])
@pytest.mark.parametrize("angle", [0.0, 5.0, 45.0])
def test_lines_of_a_long_region_are_those_of_a_larger_one(kind: type[Pattern], angle: float) -> None:
    """Cells beside a long region are dropped before they have walls, and none that reaches into it."""
    pattern = kind(cell=5.0, angle=angle, phase=(0.7, 1.9), frame=False)  # type: ignore[call-arg]
    strip = box(0, 0, 200, 4)
    cut = shapely.intersection(pattern.lines(box(-20, -90, 220, 110)), strip)
    assert pattern.lines(strip).length == pytest.approx(cut.length, rel=ROUNDING)


def test_phase_and_angle_move_the_honeycomb_rigidly() -> None:
    region = shapely.Point(0, 0).buffer(12, quad_segs=90)
    plain = Honeycomb(frame=False).lines(region)
    turned = Honeycomb(frame=False, angle=23).lines(region)
    expected = shapely.affinity.rotate(plain, 23, origin=(0, 0))
    assert shapely.hausdorff_distance(turned, expected) < 0.2  # the disc is a polygon, cut elsewhere
    period = Honeycomb(frame=False, phase=(6.0, 0.0)).lines(region)
    assert shapely.hausdorff_distance(plain, period) < ROUNDING


@pytest.mark.longest
def test_zigzag_is_the_papers_design() -> None:
    """In the square |x|, |y| <= 1.5 / sqrt 2, 7.5 waves are y = 1.5 sin(5 pi x) turned by 45 degrees."""
    half = 1.5 / math.sqrt(2)
    region = box(-half, -half, half, half)
    x = np.linspace(-1.5, 1.5, 20001)
    wave = np.stack([x, 1.5 * np.sin(5 * math.pi * x)], axis=-1)
    lines = Zigzag(waves=7.5, frame=False).lines(region)
    drawn = [shapely.affinity.rotate(shapely.LineString(wave), a, origin=(0, 0)) for a in (45, -45)]
    expected = shapely.unary_union([each.intersection(region) for each in drawn])
    # Chords of a wave, 512 a period, against chords ten times finer: 1e-3 of the amplitude apart.
    assert shapely.hausdorff_distance(lines, expected) < 2e-3
    assert Zigzag(waves=7.5).line_spacing(region) == pytest.approx(0.2)


def test_the_heart_is_symmetric_about_the_diagonal() -> None:
    heart = heart_outline()
    assert np.array_equal(heart, heart[::-1, ::-1])
    assert np.array_equal(heart[0], heart[-1])


def test_the_heart_is_a_square_with_two_half_discs() -> None:
    polygon = shapely.Polygon(heart_outline())
    assert polygon.is_valid
    assert polygon.area == pytest.approx(1 + math.pi / 4, rel=1e-4)  # 256 chords an arc
    assert polygon.bounds == pytest.approx((0, 0, 1.5, 1.5))
    assert polygon.distance(shapely.Point(0, 0)) == 0


@pytest.mark.parametrize("hearts", [1, 2, 5])
def test_hearts_are_nested_with_even_gaps(hearts: int) -> None:
    region = box(-30, -30, 30, 30)
    lines = ConcentricHeart(hearts=hearts).lines(region)
    assert body_numbers(lines).max() + 1 == hearts
    assert lines.bounds == pytest.approx(region.bounds)
    polygons = sorted(map(shapely.Polygon, lines.geoms), key=lambda polygon: -shapely.envelope(polygon).area)
    left = [polygon.bounds[0] for polygon in polygons]
    gap = 40 / (2 * hearts)  # the square under the largest heart has a side of 60 / 1.5
    assert np.diff(left) == pytest.approx(gap)
    assert ConcentricHeart(hearts=hearts).line_spacing(region) == pytest.approx(gap)


def test_phase_moves_the_hearts() -> None:
    region, small = box(-30, -30, 30, 30), box(-12, -12, 12, 12)
    plain, moved = (ConcentricHeart(hearts=4, phase=phase).lines(region) for phase in ((0, 0), (3, -2)))
    inside = shapely.affinity.translate(plain, 3, -2).intersection(small)
    assert shapely.hausdorff_distance(moved.intersection(small), inside) < ROUNDING


def test_a_region_without_area_is_refused() -> None:
    with pytest.raises(PatternError, match="no area"):
        ConcentricHeart().lines(box(0, 0, 0, 5))


def test_the_registry_names_the_nearest() -> None:
    with pytest.raises(PatternError, match="did you mean 'honeycomb'"):
        PATTERNS.find("honycomb")
    with pytest.raises(PatternError, match="there are concentric-heart"):
        PATTERNS.find("qqqq")


class Lines(Pattern):
    """A plug-in of the smallest kind."""

    name = "lines"
    summary = "parallel lines"

    def lines(self, region: shapely.Polygon, z: float = 0.0) -> shapely.MultiLineString:
        x0, y0, x1, y1 = region.bounds
        return shapely.MultiLineString([[(x, y0), (x, y1)] for x in np.arange(x0 + 2, x1, 4)])

    def line_spacing(self, region: shapely.Polygon) -> float:
        return 4.0


class Nothing(Pattern):
    """Neither lines nor a level set."""

    name = "nothing"
    summary = "nothing"

    def line_spacing(self, region: shapely.Polygon) -> float:
        return 4.0


class Both(Lines):
    """Lines and a level set."""

    name = "both"

    def level_set(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.sin(np.pi * x / 4)


@dataclass(frozen=True, kw_only=True)
class Needs(Lines):
    name = "needs"
    thing: float


def registry_with(*entries: EntryPoint) -> Registry:
    return Registry({"honeycomb": "honeycomb:Honeycomb"}, plugins=lambda: list(entries))


def entry(name: str, value: str) -> EntryPoint:
    return EntryPoint(name=name, value=value, group="infill.patterns")


def test_a_plugin_is_a_pattern_like_any_other() -> None:
    registry = registry_with(entry("lines", f"{__name__}:Lines"))
    assert list(registry) == ["honeycomb", "lines"]
    pattern = registry.find("lines")()
    assert pattern.points(REGIONS[0], 1.0).shape[1] == 2


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("gone", "no_such_module:Thing", "ModuleNotFoundError"),
        ("odd", "math:pi", "it is not a pattern class"),
        ("honeycomb", f"{__name__}:Lines", "the name is taken"),
        ("other", f"{__name__}:Lines", "its class is named 'lines'; name both alike"),
        ("nothing", f"{__name__}:Nothing", "it is not a pattern class (lines or level_set missing)"),
        ("needs", f"{__name__}:Needs", "TypeError"),
    ],
)
def test_a_broken_plugin_is_one_warning_that_names_it(name: str, value: str, says: str) -> None:
    registry = registry_with(entry(name, value), entry("lines", f"{__name__}:Lines"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert set(registry) == {"honeycomb", "lines"}
        assert registry["honeycomb"] is Honeycomb
        assert len(registry) == 2
    assert len(caught) == 1
    assert issubclass(caught[0].category, PatternWarning)
    assert name in str(caught[0].message)
    assert says in str(caught[0].message)


def test_a_level_set_is_a_plugin_like_any_other() -> None:
    pattern = registry_with(entry("ripples", "shapes:Ripples")).find("ripples")()
    assert gives(pattern) == ("level set",)
    assert pattern.points(REGIONS[0], 1.0).shape[1] == 2


def test_a_pattern_gives_lines_or_a_level_set_or_both() -> None:
    assert [gives(kind) for kind in (Lines, Ripples, Both, Nothing)] == [
        ("lines",),
        ("level set",),
        ("lines", "level set"),
        (),
    ]
    assert Both().lines(REGIONS[0]).equals(Lines().lines(REGIONS[0]))  # its own
    with pytest.raises(PatternError, match="nothing gives neither lines nor a level set"):
        Nothing().lines(REGIONS[0])


def test_a_pattern_need_not_inherit() -> None:
    """One that only looks like a pattern is as good, as it always was."""

    class Duck:
        name, summary, prismatic = "duck", "walks like one", True

        def lines(self, region: object, z: float = 0.0) -> None: ...
        def points(self, region: object, spacing: float, z: float = 0.0) -> None: ...
        def line_spacing(self, region: object) -> None: ...

    assert lacking(Duck) == lacking(Duck()) == []
    assert gives(Duck()) == ("lines",)


def test_a_plugin_that_quits_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def quits(self: EntryPoint) -> None:
        raise SystemExit("over\nand out")

    monkeypatch.setattr(EntryPoint, "load", quits)
    with pytest.warns(PatternWarning, match="SystemExit: over and out"):
        assert list(registry_with(entry("quits", "a:b"))) == ["honeycomb"]


@pytest.mark.parametrize(("default", "unit"), [("a", "mm"), (0.1, "rad"), (3, "degrees"), ((1, "b"), ""), ([1], "")])
def test_a_parameter_must_be_one_that_can_be_offered(default: object, unit: str) -> None:
    with pytest.raises(PatternError, match="a parameter has the default"):
        described(default, "something", unit=unit)


def test_parameters_carry_their_range() -> None:
    field = described(3, "a number", low=1, high=5)
    assert field.metadata["parameter"].high == 5
    assert parameters(Lines) == {}


def test_shared_parameters_are_the_same_everywhere() -> None:
    """But for their defaults, and in their order."""
    found = [parameters(kind) for kind in (*map(PATTERNS.get, BUILT_IN), Ripples)]
    for name in SHARED:
        assert len({each[name][1] for each in found if name in each}) == 1
    assert list(parameters(Zigzag)) == ["cell", "waves", "angle", "phase", "frame"]
    assert not ConcentricHeart().frame
    assert Zigzag().frame


@dataclass(frozen=True, kw_only=True)
class Open(Lines):
    name = "open"
    least: float = described(3.0, "has one end", low=1)
    most: float = described(3.0, "has one end", high=4, unit="")
    any_: float = described(3.0, "has none")


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"least": 0.5}, "least of open is 0.5 mm; it must be a number of at least 1 mm"),
        ({"least": math.inf}, "least of open is inf mm; it must be a number of at least 1 mm"),
        ({"most": 5}, "most of open is 5; it must be a number of at most 4"),
        ({"any_": math.nan}, "any_ of open is nan mm; it must be a number"),
        ({"any_": "3"}, "any_ of open is '3'; it must be a number"),
    ],
)
def test_a_range_with_open_ends_is_told(given: dict[str, object], says: str) -> None:
    with pytest.raises(PatternError) as caught:
        Open(**given)
    assert str(caught.value) == says


def test_numbers_of_numpy_are_numbers() -> None:
    made = Honeycomb(cell=np.float64(5), phase=np.array([1, 2]))
    assert made == Honeycomb(cell=5, phase=(1.0, 2.0))
    with pytest.raises(PatternError, match="it must be 2 numbers from -10000 to 10000 mm"):
        Honeycomb(phase=np.array(3.0))


@pytest.mark.parametrize("angle", [181.0, -180.5, math.nan])
def test_a_bad_angle_is_told_in_degrees(angle: float) -> None:
    with pytest.raises(PatternError, match="from -180 to 180 degrees"):
        Honeycomb(angle=angle)


@pytest.mark.parametrize("angle", [0.0, 31.0])
def test_hilbert_is_one_line_through_every_square(angle: float) -> None:
    """In a region of whole squares, 1 / cell mm of line a mm^2; and the curve has no end: all parts cross the outline."""
    cell = 5.0
    region = shapely.affinity.rotate(box(-16 * cell, -16 * cell, 16 * cell, 16 * cell), angle, origin=(0, 0))
    lines = shapely.line_merge(Hilbert(cell=cell, angle=angle, frame=False).lines(region))
    assert lines.is_simple
    assert shapely.distance(shapely.get_parts(shapely.boundary(lines)), region.exterior).max() < ROUNDING
    # A square that the line enters and leaves holds a cell of it.
    assert lines.length == pytest.approx(32 * 32 * cell, rel=1e-9)


def test_hilbert_is_the_same_wherever_it_is_looked_at() -> None:
    pattern = Hilbert(cell=3, angle=17, phase=(0.4, 1.1), frame=False)
    whole = pattern.lines(box(-40, -40, 60, 60))
    part = box(11, -23, 37, 5)
    assert shapely.symmetric_difference(whole.intersection(part), pattern.lines(part)).length < 1e-6


@pytest.mark.parametrize("kind", [ArchimedeanChords, OctagramSpiral])
def test_spirals_are_one_line_that_lies_evenly(kind: type[Pattern]) -> None:
    """Strips of half a cell to either side of the line cover the plane, and nowhere one another."""
    cell, middle = 5.0, shapely.Point(2, 3)
    inner = middle.buffer(50)
    lines = kind(cell=cell, phase=(2, 3), frame=False).lines(box(-70, -70, 70, 70))
    line = min(lines.geoms, key=lambda each: each.distance(middle))
    assert line.distance(middle) < ROUNDING
    assert line.is_simple
    assert shapely.intersection(lines, inner).equals(shapely.intersection(line, inner))  # the others are at corners
    # Sides of stars leave tips uncovered unless strips are mitred; chords depart from arcs by 5e-4 of a cell.
    near, far = (cell / 2 * (1 + off) for off in (-2e-3, 2e-3))
    mitred = {"join_style": "mitre", "mitre_limit": 3, "cap_style": "flat"}
    assert shapely.difference(inner, shapely.buffer(line, far, **mitred)).area < 1e-3 * cell**2
    # As wide as its own length has it: were strips to overlap, they would cover less.
    strip = shapely.buffer(line, near, **mitred)
    assert strip.area == pytest.approx(2 * near * line.length, rel=2e-3)


def test_the_round_spiral_is_nearly_that_of_archimedes() -> None:
    spiral = ArchimedeanChords(cell=1, frame=False).lines(shapely.Point(0, 0).buffer(20))
    x, y = sample_points(spiral, 0.01).T
    radius = np.hypot(x, y)
    turns = radius + np.arctan2(y, x) / math.pi
    away = np.abs(turns - np.round(turns))
    assert 0.14 < away[radius > 1].max() < 0.15
    assert away[radius > 10].max() < 0.115
    # It turns nowhere sharper than on a circle a cell wide, by chords of it.
    corners = shapely.get_coordinates(min(spiral.geoms, key=lambda each: each.distance(shapely.Point(0, 0))))
    step = np.diff(corners, axis=0)
    heading, length = np.unwrap(np.arctan2(step[:, 1], step[:, 0])), np.hypot(*step.T)
    assert (np.abs(np.diff(heading)) / (length[1:] + length[:-1]) * 2).max() < 2.02


def wirth(order: int) -> np.ndarray:
    """Sierpinski's closed curve as Wirth has it, four procedures that call one another, its steps all 1 long."""
    headings: list[int] = []
    # What A, B, C and D draw: along the upper side, then the right one, and so on; headings in eighths of a turn.
    plans = {"A": ("A", -1, "B", 0, "D", 1, "A"), "B": ("B", -3, "C", -2, "A", -1, "B")}
    plans |= {"C": ("C", 3, "D", 4, "B", -3, "C"), "D": ("D", 1, "A", 2, "C", 3, "D")}

    def draw(name: str, left: int) -> None:
        if left:
            for each in plans[name]:
                draw(each, left - 1) if isinstance(each, str) else headings.append(each)

    for name, corner in (("A", -1), ("B", -3), ("C", 3), ("D", 1)):
        draw(name, order)
        headings.append(corner)
    angle = np.array(headings) * math.pi / 4
    return np.concatenate([[(0.0, 0.0)], np.cumsum(np.stack([np.cos(angle), np.sin(angle)], axis=-1), axis=0)])


def test_cross_is_the_curve_of_sierpinski() -> None:
    """A block of 2^n nodes holds the curve of order n, but where it goes on to its neighbours: at its corners."""
    order, pitch = 4, 1 / (math.sqrt(2) - 1)
    corners = wirth(order)
    assert corners[-1] == pytest.approx(corners[0], abs=1e-9)
    corners[-1] = corners[0]
    assert shapely.LinearRing(corners).is_simple
    # Node (3, 3) is in the middle of a curve of order 4: counted from where the curve begins, 3 + 0b…0101 = 0b…1000.
    corners += 3 * pitch - (corners.min(axis=0) + corners.max(axis=0)) / 2
    half = 2 ** (order - 1) * pitch
    block = box(*(3 * pitch + side * half for side in (-1, -1, 1, 1)))
    joints = shapely.MultiPoint(shapely.get_coordinates(block)[:4]).buffer(pitch)
    inner = block.difference(joints)
    one, other = (
        lines.intersection(inner) for lines in (shapely.LineString(corners), Cross(cell=1, frame=False).lines(block))
    )
    assert shapely.hausdorff_distance(one, other) < 1e-6
    assert one.length == pytest.approx(other.length, abs=1e-6)
    assert 1000 < one.length < 4 * 4**order  # four steps for each node, but at the corners


def test_cross_has_no_ends_and_keeps_its_distance() -> None:
    cell, region = 3.0, box(-100, -90, 110, 120)
    lines = shapely.line_merge(Cross(cell=cell, angle=10, frame=False).lines(region))
    assert lines.is_simple
    assert shapely.distance(shapely.get_parts(shapely.boundary(lines)), region.exterior).max() < ROUNDING
    # At the edge, of 290 octagons, steps are cut at random.
    assert lines.length / region.area == pytest.approx(4 * (math.sqrt(2) - 1) ** 2 / cell, rel=0.01)
    # Walls a little narrower than a cell meet nowhere, or there would be holes between them; wider ones do.
    holes = [
        sum(len(each.interiors) for each in shapely.get_parts(lines.buffer(share * cell, quad_segs=32)))
        for share in (0.49, 0.51)
    ]
    assert holes[0] <= 2  # where the edge of the region cuts lines at an angle
    assert holes[1] > 700


def test_cross_ends_where_numbers_do() -> None:
    with pytest.raises(PatternError, match="give a larger one"):
        Cross(cell=0.001, phase=(1e4, 0.0)).lines(box(-5e3, 0, -5e3 + 1e-3, 1e-3))


RING = shapely.Point(0, 0).buffer(20, quad_segs=256).difference(shapely.Point(0, 0).buffer(6, quad_segs=256))


@pytest.mark.slow
@pytest.mark.parametrize(("region", "chords"), [(box(0, 0, 41, 27), 0.0), (RING, 2e-3)], ids=["box", "ring"])
@pytest.mark.parametrize("frame", [False, True])
def test_concentric_lines_are_parallel_to_the_outline(region: shapely.Polygon, chords: float, frame: bool) -> None:
    """At half cells from it, or in a frame at whole ones; about a hole, chords are nearer by their share of a cell."""
    cell = 2.5
    lines = Concentric(cell=cell, frame=frame).lines(region)
    away = shapely.distance(shapely.points(sample_points(lines, 0.2)), region.boundary)
    place = away / cell - (0 if frame else 0.5)
    assert np.abs(place - np.round(place)).max() < chords * away.max() / cell + ROUNDING
    # Every inset has its lines: as many as fit into the widest place.
    widest = shapely.maximum_inscribed_circle(region, tolerance=0.01).length
    assert len(np.unique(np.round(place))) == math.floor(widest / cell - (0 if frame else 0.5)) + 1
    assert all(line.is_ring for line in lines.geoms)


@given(st.floats(0.8, 6), st.floats(20, 60), st.floats(20, 60))
def test_there_is_a_line_to_every_cell(cell: float, width: float, depth: float) -> None:
    """Within what one line more or less in the middle is."""
    lines = Concentric(cell=cell, frame=False).lines(box(0, 0, width, depth))
    middle = 2 * abs(width - depth) + 4 * cell
    assert lines.length * cell == pytest.approx(width * depth, abs=middle * cell)


def test_concentric_lines_turn_with_their_region() -> None:
    region, pattern = REGIONS[3], Concentric(cell=1.7)
    turned = pattern.lines(shapely.affinity.rotate(region, 31, origin=(0, 0)))
    expected = shapely.affinity.rotate(pattern.lines(region), 31, origin=(0, 0))
    assert shapely.hausdorff_distance(turned, expected, densify=0.05) < 0.02  # arcs begin elsewhere
