"""The lean surface of a block: a prism on the contour of the layer, straightened within a tolerance.

The truth is the isosurface itself, cut at mid height by trimesh.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapes import BUILT_IN, as_manifold, assert_printable, smooth_noise

from infill import GeometryError, ParameterError, Result, Smoothing, check, extrude, make, smooth
from infill.contours.straightening import simplify_contours
from infill.contours.strips import cut_strips
from infill.contours.triangulation import extrude_contours, triangulate_rings
from infill.contours.zero_contours import Contours, trace_contours
from infill.inspection.layers import count_layer, solid_area
from infill.isosurfaces.stacking import extrude_surface
from infill.making.request import plan_block
from patterns import PATTERNS, parameters

ROUNDING = 1e-5  # mm: marching cubes keeps its vertices as 32-bit numbers
CASES = [
    ("honeycomb", "block", {"size": 30}),
    ("honeycomb", "exact", {"size": (25, 31), "angle": 7, "cell": 4, "height": 3.3}),
    ("zigzag", "block", {"size": (20, 30), "angle": -33, "frame": False}),
    ("zigzag", "exact", {"size": 24, "cell": 5}),
    ("concentric-heart", "block", {"size": 30, "frame": True, "line_width": 0.4}),
    ("concentric-heart", "exact", {"size": 26, "cell": 2.5, "phase": (1.0, -2.0)}),
]


def cut(mesh: Any, z: float) -> np.ndarray:
    """Return where a mesh crosses a height, as segments (N, 2, 2)."""
    return trimesh.intersections.mesh_plane(mesh, plane_normal=(0, 0, 1), plane_origin=(0, 0, z))[:, :, :2]


def farthest(segments: np.ndarray, others: np.ndarray) -> float:
    """Return how far places on segments lie from the nearest of others."""
    share = np.linspace(0, 1, 5)[:, None, None]
    places = ((1 - share) * segments[:, 0] + share * segments[:, 1]).reshape(-1, 2)
    tree = shapely.STRtree(shapely.linestrings(others))
    return float(tree.query_nearest(shapely.points(places), all_matches=False, return_distance=True)[1].max())


def test_a_contour_elsewhere_is_far() -> None:
    side = np.array([[[0.0, 0.0], [10.0, 0.0]]])
    assert farthest(side, side + np.array([0, 0.004])) == pytest.approx(0.004)
    assert farthest(side, side / 2) == pytest.approx(5)


def smallest_angle(mesh: trimesh.Trimesh) -> float:
    caps = np.abs(mesh.face_normals[:, 2]) > 0.5
    return math.degrees(mesh.face_angles[caps].min())


def assert_lean(lean: Result[Any], raw: Result[Any], tolerance: float) -> None:
    """Everything that is promised of a prism, against the isosurface of the same block."""
    mesh, height = lean.mesh, lean.report["request"]["height"]
    assert_printable(mesh)
    found = check(lean.surface)
    assert found.printable
    assert found.warnings == ()
    assert mesh.body_count == raw.mesh.body_count
    assert mesh.euler_number == raw.mesh.euler_number
    assert set(np.unique(mesh.vertices[:, 2])) == {0.0, height}
    upright = np.abs(mesh.face_normals[:, 2])
    assert ((upright < 1e-9) | (upright > 1 - 1e-9)).all()
    here, there = cut(mesh, height / 2), cut(raw.mesh, height / 2)
    assert farthest(here, there) < tolerance + ROUNDING
    assert farthest(there, here) < tolerance + ROUNDING
    # The rims of the isosurface are rounded; between two heights they cancel, and the field's own volume is left.
    h = tuple(lean.stages.grid.cell_size.tolist())
    layers = 20 * min(h)
    area = (
        extrude(lean.stages.smoothed, 2 * layers, h).volume - extrude(lean.stages.smoothed, layers, h).volume
    ) / layers
    assert mesh.volume == pytest.approx(area * height, rel=2e-5)  # 32-bit vertices


@pytest.mark.longest
@pytest.mark.parametrize(("name", "stamp", "options"), CASES)
def test_a_prism_is_the_isosurface_with_fewer_triangles(name: str, stamp: str, options: dict[str, Any]) -> None:
    lean = make(name, stamp=stamp, **options)
    raw = make(name, stamp=stamp, surface="grid", **options)
    assert_lean(lean, raw, 0.002)
    assert lean.report["triangles"] < raw.report["triangles"] / 4
    assert smallest_angle(lean.mesh) > 1e-3
    assert lean.report["mesh"]["surface"] == lean.report["request"]["surface"] == "prism"
    assert lean.report["mesh"]["tolerance"] == 0.002


@pytest.mark.longest
@settings(max_examples=4, deadline=None)
@given(
    name=st.sampled_from(BUILT_IN),
    stamp=st.sampled_from(["block", "exact"]),
    angle=st.floats(-180, 180),
    cell=st.floats(2.5, 7),
    width=st.floats(12, 20),
    depth=st.floats(12, 20),
    frame=st.booleans(),
    tolerance=st.sampled_from([0.0005, 0.002, 0.01, 0.045]),
)
def test_any_block_is_lean(
    name: str, stamp: str, angle: float, cell: float, width: float, depth: float, frame: bool, tolerance: float
) -> None:
    options: dict[str, Any] = {"stamp": stamp, "cell": cell, "size": (width, depth), "frame": frame, "height": 2}
    if "angle" in parameters(PATTERNS[name]):
        options["angle"] = angle
    try:
        raw = make(name, surface="grid", allow_broken=True, **options)
    except GeometryError:  # nothing is left, or no line lies in the block
        return
    assert_lean(make(name, tolerance=tolerance, allow_broken=True, **options), raw, tolerance)


@pytest.mark.slow
def test_the_default_honeycomb_is_small(tmp_path: Any) -> None:
    result = make("honeycomb")
    assert result.report["triangles"] <= 45_000
    assert result.save(tmp_path / "honeycomb.stl").stat().st_size <= 2_500_000


# --- the isosurface, as it was ---------------------------------------------------------------------------


@pytest.mark.slow
def test_the_grid_is_the_isosurface_as_it_is() -> None:
    result = make("honeycomb", surface="grid", tolerance=0)
    stages, surface = result.stages, result.surface
    wanted = extrude_surface(stages.smoothed, 6.0, tuple(stages.grid.cell_size), origin=(*stages.grid.origin, 0.0))
    assert np.array_equal(surface.vertices, wanted.vertices)
    assert np.array_equal(surface.faces, wanted.faces)
    assert (len(surface.vertices), len(surface.faces)) == (105_980, 212_504)
    assert surface.volume == pytest.approx(4382.658, abs=1e-3)
    for options in ({"tolerance": 0}, {"surface": "grid"}):
        assert np.array_equal(make("honeycomb", **options).surface.vertices, surface.vertices)


@pytest.mark.slow
def test_a_prism_without_tolerance_has_the_whole_contour() -> None:
    lean = make("zigzag", size=20, surface="prism", tolerance=0)
    assert_lean(lean, make("zigzag", size=20, surface="grid"), 0.0)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"surface": "round"}, "surface is 'round'; choose prism or grid"),
        ({"tolerance": -1}, "tolerance is -1"),
        ({"tolerance": math.nan}, "tolerance is nan"),
        ({"tolerance": "fine"}, "tolerance is 'fine'; it must be a number"),
        ({"tolerance": 0.05}, "at most a tenth of the line width, 0.045 mm"),
        (
            {"tolerance": 0.002, "surface": "grid"},
            "grid is the isosurface as it is, and not 0.002 mm off; leave the tolerance out, or take prism",
        ),
    ],
)
def test_bad_surfaces_are_refused(options: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says) as caught:
        make("honeycomb", size=20, **options)
    assert "\n" not in str(caught.value)


def test_thin_lines_get_a_tolerance_that_fits() -> None:
    """The default never exceeds what may be asked for."""
    assert make("honeycomb", size=0.5, cell=0.12, line_width=0.01, height=0.1).report["mesh"]["tolerance"] == 0.001


# --- contours --------------------------------------------------------------------------------------------


def layer_of(kind: str, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    noise = rng.uniform(-1, 1, (14, 11))
    return {
        "grey": noise,
        "signs": np.sign(noise),
        "coarse": np.round(noise * 2) / 2,
        "smoothed": smooth(np.sign(noise), Smoothing(steps=1)),
        "soft": smooth_noise(rng, (14, 11)),
    }[kind].astype(np.float32)


any_layer = st.builds(
    layer_of, st.sampled_from(["grey", "signs", "coarse", "smoothed", "soft"]), st.integers(0, 2**32 - 1)
)


@pytest.mark.slow
@settings(max_examples=60)
@given(layer=any_layer, tolerance=st.sampled_from([0.0, 0.01, 0.1, 0.3]))
def test_any_layer_keeps_its_topology(layer: np.ndarray, tolerance: float) -> None:
    """Also with undecided saddles, exact zeros, and walls and gaps of a thousandth of a cell."""
    found = simplify_contours(trace_contours(layer), tolerance)
    surface = extrude_contours(found, 1.0)
    counts = count_layer(layer)
    assert surface.closed
    assert as_manifold(surface).status().name == "NoError"
    assert surface.euler_number == 2 * counts.euler_number
    assert surface.to_trimesh().body_count == counts.components
    assert (int((found.areas > 0).sum()), int((found.areas < 0).sum())) == (counts.components, counts.holes)


@pytest.mark.slow
@settings(max_examples=30)
@given(layer=any_layer)
def test_contours_are_the_cut_of_the_isosurface(layer: np.ndarray) -> None:
    found = trace_contours(layer, (0.5, 0.25), origin=(3, -2))
    mesh = extrude(layer, 1.0, (0.5, 0.25), origin=(3, -2, 0))
    here, there = np.stack([found.points, found.points[found.ahead]], axis=1), cut(mesh, 0.5)
    assert farthest(here, there) < 1e-6
    assert farthest(there, here) < 1e-6


@pytest.mark.slow
@settings(max_examples=30)
@given(layer=any_layer, tolerance=st.sampled_from([0.01, 0.1, 0.3]))
def test_straightening_keeps_every_area_and_stays_near(layer: np.ndarray, tolerance: float) -> None:
    raw = trace_contours(layer)
    found = simplify_contours(raw, tolerance)
    assert found.areas == pytest.approx(raw.areas, rel=1e-3, abs=1e-9)
    here, there = (np.stack([each.points, each.points[each.ahead]], axis=1) for each in (found, raw))
    assert farthest(here, there) <= tolerance + 1e-9
    assert farthest(there, here) <= tolerance + 1e-9


def test_a_circle_gets_the_chords_that_its_curvature_allows() -> None:
    """Corners two thirds outside and chords one third inside: a chord of length l lies l² / 8 r from its arc."""
    x = np.arange(200) - 99.5
    disc = trace_contours(np.clip(80 - np.hypot(x[:, None], x), -1, 1))
    found = simplify_contours(disc, 0.05)
    assert found.areas == pytest.approx(disc.areas, rel=1e-9)
    longest = math.sqrt(8 * 80 * 1.5 * 0.05)
    assert 1 <= len(found.points) / (2 * math.pi * 80 / longest) < 2.1  # halving stops at up to half of the longest
    assert simplify_contours(disc, 0) is disc


@example(corners=3)
@given(corners=st.integers(3, 60))
@settings(max_examples=10)
def test_strips_fill_the_same_area_with_the_same_contour(corners: int) -> None:
    rng = np.random.default_rng(corners)
    rings = trace_contours(smooth_noise(rng, (40, 30)))
    pieces = cut_strips(rings, corners)
    assert pieces.contours.areas == pytest.approx(rings.areas, rel=1e-12)
    around = Contours(points=pieces.contours.points[pieces.order], first=pieces.first)
    assert around.areas.sum() == pytest.approx(rings.areas.sum(), rel=1e-12)
    a, b, c = around.points[triangulate_rings(around)].transpose(1, 0, 2)
    doubled = np.cross(np.c_[b - a, np.zeros(len(a))], np.c_[c - a, np.zeros(len(a))])[:, 2]
    assert (doubled > 0).all()
    assert doubled.sum() / 2 == pytest.approx(rings.areas.sum(), rel=1e-12)


def test_the_area_of_contours_is_that_of_the_layer() -> None:
    layer = make("zigzag", size=20).stages.smoothed
    assert trace_contours(layer).areas.sum() == pytest.approx(solid_area(layer), rel=1e-5)  # weakened by `TIE`


def test_what_cannot_be_filled_is_an_error() -> None:
    bow = Contours(points=np.array([[0.0, 0], [4, 0], [1, 3], [3, 3]]), first=np.array([0, 4]))
    with pytest.raises(GeometryError, match="cannot be filled"):
        triangulate_rings(bow)
    hole = Contours(points=np.array([[0.0, 0], [0, 1], [1, 0]]), first=np.array([0, 3]))
    with pytest.raises(GeometryError):
        triangulate_rings(hole)


# --- what it will cost, and what the exact stamp would give -------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(("name", "stamp"), [("concentric-heart", "block"), ("honeycomb", "exact")])
def test_a_large_block_is_expected_from_samples(name: str, stamp: Any) -> None:
    block = plan_block(
        name, size=(120, 90), height=6, line_width=0.45, stamp=stamp, cells=None, smoothing=Smoothing(), parameters={}
    )
    assert block.triangles == pytest.approx(make(name, size=(120, 90), stamp=stamp).report["triangles"], rel=0.25)


@pytest.mark.long
@pytest.mark.parametrize("name", BUILT_IN)
def test_the_report_tells_what_the_exact_stamp_would_give(name: str) -> None:
    report = make(name, size=40.05).report  # whole cells of 0.15 mm
    exact = make(name, size=40.05, stamp="exact").report
    wrong = abs(report["wall_width"]["mean"] / 0.45 - 1)
    if name in ("rectilinear", "grid", "hilbert", "concentric"):  # lines along cells are stamped too well to tell
        assert wrong < 0.05
        assert report["walls"]["exact"] is None
    else:
        assert wrong > 0.05
        assert report["walls"]["exact"] == pytest.approx(exact["wall_width"]["mean"], rel=0.01)
    assert exact["walls"]["exact"] is None
