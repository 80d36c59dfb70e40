"""`make`: the designs at many sizes, the report, and what must not pass."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from scipy import ndimage
from shapes import BUILT_IN, OF_THE_PAPER, SIZES, assert_printable

from infill import GeometryError, Grid, MemoryLimitError, ParameterError, Smoothing, UsageError, extrude, make
from infill.inspection.layers import count_layer
from infill.making.request import Block, plan_block
from patterns import PATTERNS, Honeycomb, Pattern, PatternError

STAGES = {"points", "stamp", "smooth", "check", "surface", "total"}


def predicted_components_and_holes(stamp: np.ndarray) -> tuple[int, int, int]:
    """Count components of the stamp, and the fewest and most holes that may be left of it, by scipy alone.

    A hole with room for 3x3 cells stays; without, it may close. A neck of a hole may be cut.
    """
    solid = np.pad(stamp > 0, 2)
    square = np.ones((3, 3), dtype=bool)
    void, count = ndimage.label(~solid, structure=square)
    rooms, _ = ndimage.label(ndimage.binary_opening(~solid, structure=square))
    outside = void == void[0, 0]
    wide = len(set(np.unique(void[rooms > 0])) - {void[0, 0]})
    inner = len(np.unique(rooms[(rooms > 0) & ~outside]))
    narrow = count - 1 - wide
    return ndimage.label(solid)[1], wide, inner + narrow


@pytest.mark.long
@pytest.mark.parametrize(
    ("size", "cell", "stamp"),
    [((60, 60), 6, "block"), *((*each, "block") for each in SIZES), *((*each, "exact") for each in SIZES[::5])],
)
@pytest.mark.parametrize("name", BUILT_IN)
def test_the_designs_are_printable_at_many_sizes(name: str, size: Any, cell: float, stamp: str) -> None:
    # Corners where lines of other designs meet the frame are narrower than a cell is wide.
    cell = cell if name in OF_THE_PAPER else 3 * cell
    result = make(name, size=size, cell=cell, height=4, stamp=stamp)
    mesh, report = result.mesh, result.report
    assert_printable(mesh)
    assert mesh.body_count == report["components"] == report["topology"]["data"]["components"]
    lines = PATTERNS[name](cell=cell).lines(plan_of(name, size, cell).region)
    assert mesh.body_count == (len(lines.geoms) if name in ("concentric", "concentric-heart") else 1)
    assert mesh.euler_number == report["mesh"]["euler_number"] == report["topology"]["result"]["euler_number"]
    # A neck of a void may be cut or not: then the rooms on its sides are two holes, or one.
    components, fewest, most = predicted_components_and_holes(result.stages.stamp)
    assert components == mesh.body_count
    assert fewest <= components - mesh.euler_number // 2 <= most
    expected = [min(size)] * 2 if name == "concentric-heart" else list(size)
    assert mesh.extents == pytest.approx([*expected, 4], abs=report["grid"]["spacing"][0])
    assert report["problems"] == []


def plan_of(name: str, size: Any, cell: float) -> Any:
    return plan_block(
        name,
        size=size,
        height=4,
        line_width=0.45,
        stamp="block",
        cells=None,
        smoothing=Smoothing(),
        parameters={"cell": cell},
    )


@pytest.mark.long
@pytest.mark.parametrize("name", BUILT_IN)
def test_the_defaults_keep_every_hole_of_the_stamp(name: str) -> None:
    report = make(name).report
    if name in ("voronoi", "archimedean-chords"):  # somewhere a line meets the frame at a sharp angle
        assert report["changes"].pop("pinholes") <= 3
        assert report["changes"].pop("pinhole_share") < 0.001
    else:
        assert report["topology"]["data"] == report["topology"]["result"]
    assert not any(report["changes"].values())


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change"), [("honeycomb", 0.0265), ("zigzag", 0.0315), ("concentric-heart", -0.0158)])
def test_the_default_change_of_volume(name: str, change: float) -> None:
    assert make(name).report["volume_change"] == pytest.approx(change, abs=1e-4)


@pytest.mark.long
@pytest.mark.parametrize("name", BUILT_IN)
def test_the_report_tells_the_truth(name: str) -> None:
    result = make(name, size=(30, 40), height=5)
    mesh, report = result.mesh, result.report
    assert json.loads(json.dumps(report, allow_nan=False)) == report
    assert report["triangles"] == len(mesh.faces)
    assert report["closed"] is True
    assert report["volume"] == pytest.approx(mesh.volume)
    assert report["area"] == pytest.approx(mesh.area)
    assert report["extents"] == pytest.approx(mesh.extents.tolist())
    assert report["bounds"] == pytest.approx(mesh.bounds)
    assert report["density"] == pytest.approx(
        mesh.volume / math.prod([*report["request"]["size"], report["request"]["height"]])
    )
    assert result.stages.stamp.shape == result.stages.smoothed.shape
    assert report["grid"]["shape"] == [*result.stages.stamp.shape, round(5 / 0.15)]
    assert report["grid"]["spacing"] == pytest.approx([0.15, 40 / round(40 / 0.15), 5 / round(5 / 0.15)])
    assert report["request"]["size"] == pytest.approx([30, 40], rel=1e-12)
    assert (report["request"]["steps"], report["request"]["fidelity"]) == (10, 0.01)
    for key, layer in (("data", result.stages.stamp), ("result", result.stages.smoothed)):
        counts = count_layer(layer)
        assert report["topology"][key] == {
            "components": counts.components,
            "cavities": 0,
            "tunnels": counts.holes,
            "euler_number": 2 * counts.euler_number,
        }
    # The rims of a component 600 mm tall do not count.
    tall = [extrude(layer, 600, 0.15).volume for layer in (result.stages.smoothed, result.stages.stamp)]
    assert report["solid"]["data"] == pytest.approx(tall[1] / 120, rel=2e-3)
    assert report["volume_change"] == pytest.approx(tall[0] / tall[1] - 1, abs=2e-4)
    assert set(report["seconds"]) == STAGES
    assert report["wall_width"]["requested"] == 0.45
    assert report["wall_width"]["p5"] <= report["wall_width"]["mean"] <= report["wall_width"]["p95"]


@pytest.mark.slow
def test_the_block_stands_on_the_bed_about_the_origin() -> None:
    wanted = np.array([[-15, -12, 0], [15, 12, 5]])
    assert make("honeycomb", size=(30, 24), height=5, surface="grid").mesh.bounds == pytest.approx(wanted, abs=1e-3)
    lean = make("honeycomb", size=(30, 24), height=5).mesh.bounds
    assert lean == pytest.approx(wanted, abs=1e-3 + 2e-3)  # the contour may lie 0.002 mm away
    assert lean[:, 2].tolist() == [0, 5]


@pytest.mark.slow
def test_the_block_stamp_shows_its_true_widths() -> None:
    """Up to 41 % wide on diagonals: said, not hidden."""
    width = make("honeycomb", angle=7).report["wall_width"]
    assert width["mean"] / 0.45 == pytest.approx(1.17, abs=0.03)
    assert width["p95"] / 0.45 == pytest.approx(1.38, abs=0.04)


@pytest.mark.long
@pytest.mark.parametrize("degrees", [0, 7, 15, 22.5, 45])
def test_the_exact_stamp_keeps_its_width(degrees: float) -> None:
    width = make(Honeycomb(angle=degrees), stamp="exact", cells=5).report["wall_width"]
    assert width["mean"] == pytest.approx(0.45, rel=0.01)
    assert width["p5"] > 0.98 * 0.45
    assert width["p95"] < 1.02 * 0.45


@pytest.mark.long
@pytest.mark.parametrize("unit", [1 / 25.4, 0.001])
def test_the_unit_of_length_does_not_matter(unit: float) -> None:
    for surface, tolerance in (("grid", 0), ("prism", 0.002)):
        plain = make(Honeycomb(cell=5), size=20, height=3, surface=surface, tolerance=tolerance)
        scaled = make(
            Honeycomb(cell=5 * unit),
            size=20 * unit,
            height=3 * unit,
            line_width=0.45 * unit,
            surface=surface,
            tolerance=tolerance * unit,
        )
        assert len(plain.mesh.faces) == len(scaled.mesh.faces)
        assert scaled.mesh.volume / unit**3 == pytest.approx(plain.mesh.volume, rel=1e-6)
        if surface == "grid":
            assert np.array_equal(plain.mesh.faces, scaled.mesh.faces)
            assert scaled.mesh.vertices / unit == pytest.approx(plain.mesh.vertices, abs=1e-4)


def test_numpy_numbers_are_numbers() -> None:
    result = make("honeycomb", cell=np.float32(4), phase=np.array([1, 2]), size=np.int64(20), height=np.float64(3))
    assert json.loads(json.dumps(result.report)) == result.report
    assert result.report["request"]["parameters"]["phase"] == [1.0, 2.0]


@pytest.mark.slow
def test_height_costs_nothing() -> None:
    low, high = make("honeycomb", size=30, height=6), make("honeycomb", size=30, height=600)
    assert low.report["triangles"] == high.report["triangles"]
    assert high.mesh.extents[2] == pytest.approx(600, abs=1e-2)


def test_one_layer_is_enough() -> None:
    result = make("honeycomb", size=20, height=0.1)
    assert_printable(result.mesh)
    assert result.report["grid"]["shape"][2] == 1


def test_the_fields_tell_the_story() -> None:
    result = make("zigzag", size=24)
    assert isinstance(result.stages.grid, Grid)
    assert shapely.distance(shapely.points(result.stages.points), result.stages.lines).max() < 1e-9
    assert set(np.unique(result.stages.stamp)) == {-1, 1}


def test_a_result_saves_itself(tmp_path: Path) -> None:
    result = make("honeycomb", size=20)
    assert result.save(tmp_path / "x.stl").stat().st_size == 84 + 50 * result.report["triangles"]


def test_progress_is_told_in_order() -> None:
    told: list[tuple[str, float]] = []
    make("honeycomb", size=20, progress=lambda stage, share: told.append((stage, share)))
    assert [stage for stage, _ in told] == ["points", "stamp", "smooth", "check", "surface"]
    assert [share for _, share in told] == sorted(share for _, share in told)


def test_any_pattern_will_do() -> None:
    class Ring(Pattern):
        name = "ring"
        summary = "one circle"

        def lines(self, region: Any, z: float = 0.0) -> shapely.MultiLineString:
            return shapely.MultiLineString([shapely.centroid(region).buffer(5, quad_segs=64).exterior])

        def line_spacing(self, region: Any) -> float:
            return 10.0

    result = make(Ring(), size=20, height=2)
    assert result.report["request"]["parameters"] == {}
    assert result.mesh.euler_number == 0


# --- what must not pass ----------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", [0, -1, math.nan, math.inf])
@pytest.mark.parametrize("name", ["size", "height", "line_width"])
def test_bad_lengths_are_refused(name: str, bad: float) -> None:
    with pytest.raises(ParameterError, match="finite number above 0"):
        make("honeycomb", **{name: bad})


@pytest.mark.parametrize(
    ("pattern", "options", "error", "says"),
    [
        ("honycomb", {}, PatternError, "did you mean 'honeycomb'"),
        (
            "honeycomb",
            {"waves": 3},
            PatternError,
            "honeycomb has no parameter 'waves'; it has cell, angle, phase, frame",
        ),
        (Honeycomb(), {"cell": 3}, ParameterError, "together with a ready-made pattern"),
        (Honeycomb, {}, ParameterError, "give a name, or a pattern such as"),
        (7, {}, ParameterError, "is int, which is int; give a Pattern"),
        ("honeycomb", {"phase": (1, 2, 3)}, PatternError, "it must be 2 numbers"),
        ("honeycomb", {"cell": "6"}, PatternError, "it must be a number"),
        ("honeycomb", {"frame": 1}, PatternError, "must be true or false"),
        (
            "concentric-heart",
            {"hearts": 2.5},
            PatternError,
            "hearts of concentric-heart is 2.5; it must be a whole number",
        ),
        ("honeycomb", {"size": (1, 2, 3, 4)}, ParameterError, "size has 4 numbers"),
        ("honeycomb", {"size": (20, 20, 3), "height": 4}, UsageError, "height is 4 mm, and size has 3 mm for it"),
        ("honeycomb", {"size": 1e300}, ParameterError, "from 0.000001 to 1000000 mm"),
        ("honeycomb", {"height": 1e39}, ParameterError, "from 0.000001 to 1000000 mm"),
        ("honeycomb", {"height": 10**400}, ParameterError, "finite number"),
        ("honeycomb", {"size": 4, "cell": 100, "frame": False}, PatternError, "no line of honeycomb lies in the block"),
        ("honeycomb", {"cells": 4}, ParameterError, "4 × 4 cells has no middle cell"),
        ("honeycomb", {"cells": 0}, ParameterError, "^cells is 0"),
        ("honeycomb", {"stamp": "round"}, ParameterError, "choose block or exact"),
        ("honeycomb", {"cell": 1.2}, ParameterError, "1.2 mm apart, under 3 line widths"),
        ("zigzag", {"waves": 100}, ParameterError, "under 3 line widths"),
        ("concentric-heart", {"hearts": 90}, ParameterError, "under 3 line widths"),
        ("honeycomb", {"size": 1}, ParameterError, "no room for walls"),
        ("honeycomb", {"smoothing": Smoothing(alpha=0.3)}, ParameterError, "stable up to 0.25"),
        (
            "honeycomb",
            {"max_memory": 10_000_000},
            MemoryLimitError,
            "needs about .* GiB of memory and 0.01 GiB is allowed",
        ),
        ("honeycomb", {"size": 60_000}, MemoryLimitError, "fewer cells per line"),
        ("honeycomb", {"line_width": 1e-4, "cell": 0.01, "size": 40}, MemoryLimitError, "is at hand"),
    ],
)
def test_bad_requests_are_refused(pattern: Any, options: dict[str, Any], error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says) as caught:
        make(pattern, **options)
    assert "\n" not in str(caught.value)


def test_memory_is_refused_for_triangles_too() -> None:
    """The grid alone would fit; the triangles on top of it do not."""
    block = plan_of("honeycomb", (60, 60), 1.4)
    between = (block.memory + block.grid_memory) // 2
    with pytest.raises(MemoryLimitError, match="is allowed; .*fewer cells per line"):
        make("honeycomb", cell=1.4, max_memory=between)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"stamp": "exact", "cells": 3, "smoothing": Smoothing(steps=60)}, "vanished|broke"),
        ({"cells": 1, "smoothing": Smoothing(steps=10)}, "vanished|broke"),
        ({"stamp": "exact", "cells": 3, "smoothing": Smoothing(steps=25)}, "thin at the 5th percentile"),
        ({"cells": 1, "cell": 1.35}, "holes? closed in smoothing"),
    ],
)
def test_broken_walls_are_an_error_that_says_what_to_change(options: dict[str, Any], says: str) -> None:
    with pytest.raises(GeometryError, match=says) as caught:
        make("honeycomb", size=30, **options)
    assert "nothing is lost; --allow-broken" in str(caught.value)


@pytest.mark.slow
def test_many_narrow_holes_are_no_pinholes() -> None:
    with pytest.raises(GeometryError, match="68 holes narrower than a line, 10% of all void, closed"):
        make("zigzag", size=19.95, cell=1.35)  # whole cells of 0.15 mm


def test_broken_walls_can_be_had_anyway() -> None:
    options = {"size": 30, "stamp": "exact", "cells": 3, "smoothing": Smoothing(steps=25)}
    result = make("honeycomb", allow_broken=True, **options)
    assert result.report["problems"]
    assert_printable(result.mesh)


def test_the_defaults_stand_once_more_in_the_settings() -> None:
    """`make`, `Smoothing` and the command line begin from the same numbers."""
    import inspect

    from infill.cli import making
    from infill.making.settings import MakeSettings

    function = {name: each.default for name, each in inspect.signature(make).parameters.items()}
    settings, smoothing = MakeSettings(pattern="honeycomb"), Smoothing()
    for name in ("size", "height", "line_width", "density", "stamp", "cells"):
        assert getattr(settings, name) == function[name]
    block = settings.plan()
    assert isinstance(block, Block)
    defaults = {"height": block.height, "line_width": block.line_width, "steps": 10, "fidelity": 0.01}
    assert function["smoothing"] == smoothing
    for name in ("steps", "fidelity", "interface", "alpha"):
        assert getattr(settings, name) == getattr(smoothing, name)
    options = inspect.signature(making.make, eval_str=True).parameters
    shown = {name: options[name].annotation.__metadata__[0].help for name in defaults}
    assert all(f"(default: {defaults[name]:g})" in text for name, text in shown.items())


def test_nothing_left_is_an_error_even_then() -> None:
    with pytest.raises(GeometryError, match="nothing is left"):
        make("concentric-heart", size=30, cells=1, smoothing=Smoothing(steps=40), allow_broken=True)


def test_a_pattern_that_fails_is_named() -> None:
    class Failing(Pattern):
        name = "failing"
        summary = "raises"

        def lines(self, region: Any, z: float = 0.0) -> shapely.MultiLineString:
            raise RuntimeError("boom\nand more")

        def line_spacing(self, region: Any) -> float:
            return 3.0

    with pytest.raises(PatternError, match="the pattern failing failed: RuntimeError: boom and more"):
        make(Failing(), size=20)


def test_lines_that_run_together_in_the_stamp_are_an_error() -> None:
    class Close(Pattern):
        name = "close"
        summary = "two lines nearer than they say"

        def lines(self, region: Any, z: float = 0.0) -> shapely.MultiLineString:
            return shapely.MultiLineString([[(-5, 0), (5, 0)], [(-5, 0.5), (5, 0.5)]])

        def line_spacing(self, region: Any) -> float:
            return 3.0

    with pytest.raises(GeometryError, match="1 line of the pattern fused with others"):
        make(Close(), size=20)


def test_an_open_surface_is_never_written(monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.surface import Surface

    monkeypatch.setattr(Surface, "closed", property(lambda self: False))
    with pytest.raises(GeometryError, match="not closed"):
        make("honeycomb", size=20)


# --- what it will cost -----------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("surface", ["prism", "grid"])
@pytest.mark.parametrize("stamp", ["block", "exact"])
@pytest.mark.parametrize("name", BUILT_IN)
def test_the_plan_expects_the_triangles_and_the_file(name: str, stamp: Any, surface: Any, tmp_path: Path) -> None:
    block = plan_block(
        name,
        size=(50, 40),
        height=6,
        line_width=0.45,
        stamp=stamp,
        cells=None,
        smoothing=Smoothing(),
        parameters={},
        surface=surface,
    )
    result = make(name, size=(50, 40), stamp=stamp, surface=surface)
    assert block.triangles == pytest.approx(result.report["triangles"], rel=0.25)
    assert block.stl_bytes == pytest.approx(result.save(tmp_path / "a.stl").stat().st_size, rel=0.25)


# --- the paper's parameters ------------------------------------------------------------------------------


def disc(half: int = 50) -> np.ndarray:
    x = (np.arange(2 * half) + 0.5 - half) / half
    return np.where(x[:, None] ** 2 + x**2 < 0.6**2, 1.0, -1.0)


def roughness(phi: np.ndarray) -> float:
    """Length of the zero contour over that of the circle: 4 / pi for a staircase, 1 for a circle."""
    from skimage.measure import find_contours

    (contour,) = find_contours(phi, 0.0)
    return float(np.linalg.norm(np.diff(contour, axis=0), axis=1).sum() / (2 * math.pi * 0.6 * len(phi) / 2))


def relaxed(lam: float, m: float, steps: int) -> np.ndarray:
    from infill import smooth

    return smooth(disc(), Smoothing.paper(lam=lam, h=0.1, m=m, steps=steps), method="numpy")


def test_figure_2_large_lambda_keeps_the_mosaic() -> None:
    """lam = 10, 100, 1000 at h = 0.1 and eps_2: the larger, the more of the staircase stays."""
    raw = roughness(disc())
    rough = [roughness(relaxed(lam, m=2, steps=100)) for lam in (10, 100, 1000)]
    assert raw == pytest.approx(1.0557, abs=5e-4)
    assert rough == pytest.approx([0.9943, 1.0127, 1.0432], abs=5e-4)


def test_figure_3_fidelity_alone_brings_the_data_back() -> None:
    """Started from another shape, the field goes over to the data, the faster the larger lam is."""
    from infill import smooth

    data, other = disc(), np.roll(disc(), 25, axis=0)
    left = []
    for lam in (10, 100, 1000):
        phi = smooth(data, Smoothing.paper(lam=lam, h=0.1, steps=10), initial=other, method="numpy")
        left.append(float((np.sign(phi) != data).mean()))
    assert left[0] > left[1] > left[2]
    assert left[2] < 0.01
    assert left[0] > 0.1


def test_figure_4_epsilon_sets_the_width_of_the_interface() -> None:
    """eps_8, eps_2, eps_0.4: from phi = -0.9 to 0.9 there are 2 m cells, down to a jump."""
    widths = []
    for m in (8, 2, 0.4):
        phi = relaxed(lam=1, m=m, steps=200)
        row = phi[50, 50:]
        inside, outside = int((row > 0.9).sum()), int((row > -0.9).sum())
        widths.append(outside - inside)
    assert widths[0] > widths[1] > widths[2]
    assert widths[0] == pytest.approx(16, abs=1)
    assert widths[1] == pytest.approx(4, abs=1)
    assert widths[2] == 0


def test_the_lines_of_a_pattern_are_drawn_once(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn, lines = [], Honeycomb.lines

    def counted(self: Honeycomb, *arguments: Any) -> Any:
        drawn.append(1)
        return lines(self, *arguments)

    monkeypatch.setattr(Honeycomb, "lines", counted)
    result = make("honeycomb", size=20, height=3)
    assert len(drawn) == 1
    assert np.array_equal(result.stages.points, Honeycomb().points(plan_of("honeycomb", (20, 20), 6).region, 0.075))


def test_points_that_a_pattern_finds_itself_are_taken() -> None:
    class Corners(Honeycomb):
        """A honeycomb of dots: its points are the ends of its lines only."""

        def points(self, region: Any, spacing: float, z: float = 0.0) -> Any:
            return shapely.get_coordinates(self.lines(region, z))

    result = make(Corners(), size=20, height=3, allow_broken=True)
    assert len(result.stages.points) < 200
    assert result.report["components"] > 10


def test_angles_are_degrees_everywhere() -> None:
    by_name = make("honeycomb", size=(20, 20), height=3, angle=7)
    by_class = make(Honeycomb(angle=7), size=(20, 20), height=3)
    assert np.array_equal(by_name.surface.vertices, by_class.surface.vertices)
    assert by_name.report["request"]["parameters"]["angle"] == 7
    with pytest.raises(PatternError, match="angle of honeycomb is 190 degrees"):
        make("honeycomb", angle=190)


@pytest.mark.parametrize("options", [{"height": True}, {"height": "6"}, {"line_width": "0.45"}, {"size": (True, 20)}])
def test_what_is_no_number_is_refused(options: dict[str, Any]) -> None:
    with pytest.raises(ParameterError, match="it must be a number"):
        make("honeycomb", **options)


def test_results_compare_by_themselves_and_are_shown_in_a_line() -> None:
    one, other = (make("honeycomb", size=(20, 20), height=3) for _ in range(2))
    assert one == one
    assert one != other
    assert len({one, other}) == 2
    assert repr(one) == f"Result(block: {len(one.surface.faces):,} triangles, 20 x 20 x 3 mm)"
