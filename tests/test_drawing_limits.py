"""Drawings that would take gigabytes or minutes are refused before a library is asked, each with its limit."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from test_command_line import one_line_error, run

from infill import FormatError
from infill.drawing import MOST_POINTS
from infill.drawings.drawing_files import read_drawing, read_tile
from infill.drawings.tiled import Tiled, read_tiled
from infill.errors import GeometryError
from infill.lattices.line_sample import LineSample
from infill.paths.tiles.borders import find_borders
from infill.plain_numbers import plain_size
from patterns.errors import PatternError

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">'


def nested(inner: str, times: int, levels: int) -> str:
    """Return groups of copies of copies: `times` to the power of `levels` in a few hundred bytes."""
    groups = "".join(
        f'<g id="g{i}">{(f"<use href={chr(34)}#g{i - 1}{chr(34)}/>") * times}</g>' for i in range(1, levels)
    )
    return f'{HEAD}<defs><g id="g0">{inner}</g>{groups}</defs><use href="#g{levels - 1}"/></svg>'


SVG = {
    "points of copies": (nested(f'<path d="M0 0{"c1 2 3 1 2 2" * 100}"/>', 10, 5), "points or more"),
    "copies of nothing": (nested('<path d="M1 1"/>', 10, 7), "drawn elements or more, copies counted"),
    "one path": (f'{HEAD}<path d="M0 0{"h1v1" * 300_000}"/></svg>', "letters or more in a path"),
    "one letter": (f'{HEAD}<path d="M0 0L{"1 1 " * 500_001}"/></svg>', "points or more in a path"),
    "curves": (f'{HEAD}<path d="M0 0{"a9 9 0 1 1 1 1" * 4000}"/></svg>', "points or more in a path"),
    "transforms": (
        f'{HEAD}<rect width="5" height="5" transform="{"scale(1)" * 101}"/></svg>',
        "transforms of one element",
    ),
    "elements": (f"{HEAD}{'<g/>' * 400_001}</svg>", "elements or more"),
    "groups": (f"{HEAD}{'<g>' * 200}{'</g>' * 200}</svg>", "groups in one another"),
}
WKT = {
    "deep collections": (
        "GEOMETRYCOLLECTION(" * 50_000 + "POINT(1 1)" + ")" * 50_000,
        "50001 parentheses in one another",
    ),
    "deep and open": ("(" * 50_000, "50000 parentheses in one another"),
    "points": ("LINESTRING(" + "1 1," * (MOST_POINTS + 1) + "2 2)", "points or more"),
}


def repeated(block: Callable[[ezdxf.layouts.BlockLayout], object], **grid: object) -> ezdxf.document.Drawing:
    document = ezdxf.new(setup=False, units=4)
    block(document.blocks.new("A"))
    document.modelspace().add_blockref("A", (0, 0), dxfattribs=grid)
    return document


def blocks_of_blocks() -> ezdxf.document.Drawing:
    """Ten copies of ten copies ..., of a block with nothing in it."""
    document = ezdxf.new(setup=False, units=4)
    document.blocks.new("B0")
    for i in range(1, 12):
        block = document.blocks.new(f"B{i}")
        for _ in range(10):
            block.add_blockref(f"B{i - 1}", (0, 0))
    document.modelspace().add_blockref("B11", (0, 0))
    return document


def wave(count: int) -> list[tuple[float, float]]:
    return [(i * 0.001, math.sin(i)) for i in range(count)]


def hatched(count: int) -> ezdxf.document.Drawing:
    document = ezdxf.new(setup=False, units=4)
    document.modelspace().add_hatch().paths.add_edge_path().add_spline(fit_points=wave(count))
    return document


DXF = {
    "a spline through points": (lambda: repeated(lambda b: b.add_spline(wave(1001))), "1001 points that a spline goes through"),
    "a hatch's spline": (lambda: hatched(1001), "1001 points that a spline goes through"),
    "a helix": (lambda: repeated(lambda b: b.add_helix(2, 1, 3000)), "points or more"),
    "copies": (lambda: repeated(lambda b: b.add_line((0, 0), (1, 1)), row_count=300, column_count=300, row_spacing=2, column_spacing=2), "180001 entities, repeated"),
    "copies of copies of nothing": (blocks_of_blocks, "entities, repeated blocks counted"),
    "copies of a spline": (
        lambda: repeated(lambda b: b.add_open_spline(wave(3000)), row_count=10, column_count=10, row_spacing=2, column_spacing=2), "points or more"
    ),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", SVG)
def test_a_large_svg_is_refused_by_its_limit(name: str, tmp_path: Path) -> None:
    text, limit = SVG[name]
    path = tmp_path / "a.svg"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=rf"a\.svg has \d+ {limit}; the limit is \d+; give a simpler drawing"):
        read_drawing(path)


@pytest.mark.slow
@pytest.mark.parametrize("name", WKT)
def test_a_deep_or_long_wkt_is_refused_by_its_limit(name: str, tmp_path: Path) -> None:
    """GEOS overflows its stack at a depth of some ten thousand: in a process of its own, should it be asked."""
    text, limit = WKT[name]
    path = tmp_path / "a.wkt"
    path.write_text(text, encoding="utf-8")
    code = f"from infill.drawings.drawing_files import read_drawing; read_drawing({str(path)!r})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 1
    assert f"{limit}; the limit is" in done.stderr.splitlines()[-1]


@pytest.mark.long
@pytest.mark.parametrize("name", DXF)
def test_a_large_dxf_is_refused_by_its_limit(name: str, tmp_path: Path) -> None:
    make, limit = DXF[name]
    path = tmp_path / "a.dxf"
    make().saveas(path)
    with pytest.raises(FormatError, match=rf"a\.dxf has .*{limit}.*; the limit is \d+; give a simpler drawing"):
        read_drawing(path)


def test_a_block_in_itself_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.dxf"
    repeated(lambda block: block.add_blockref("A", (1, 1))).saveas(path)
    with pytest.raises(FormatError, match=r"its block 'A' contains itself"):
        read_drawing(path)


@pytest.mark.slow
def test_what_is_below_the_limits_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a.dxf"
    repeated(
        lambda block: block.add_spline(wave(200)), row_count=3, column_count=3, row_spacing=9, column_spacing=9
    ).saveas(path)
    assert len(read_drawing(path).lines) == 9
    wkt = tmp_path / "a.wkt"
    wkt.write_text("GEOMETRYCOLLECTION(" * 10 + "LINESTRING (0 0, 4 3)" + ")" * 10)
    assert len(read_drawing(wkt).lines) == 1
    svg = tmp_path / "a.svg"
    svg.write_text(nested('<path d=" M0 0 h4 v3 "/>', 10, 3))
    drawing = read_drawing(svg)
    assert (len(drawing.lines), drawing.left_out) == (1, ("99 repeated lines",))


@pytest.mark.slow
@pytest.mark.parametrize("unit", ["99", "-1", "25"])
def test_an_unknown_unit_says_what_to_do(unit: str, tmp_path: Path) -> None:
    path = tmp_path / "a.dxf"
    document = ezdxf.new(setup=False)
    document.header["$INSUNITS"] = int(unit)
    document.modelspace().add_line((0, 0), (9, 9))
    document.saveas(path)
    with pytest.raises(
        FormatError, match=rf"states the unit {unit} \(\$INSUNITS\).*set the drawing's units to millimetres"
    ):
        read_drawing(path)
    document.header["$INSUNITS"] = 4  # the remedy
    document.saveas(path)
    assert read_drawing(path).bounds == pytest.approx((0, 0, 9, 9))


SQUARE = np.array([(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)])


def squares(path: Path, count: int, step: float) -> Path:
    """Outlines of hatches, each moved by a step."""
    document = ezdxf.new(setup=False, units=4)
    for i in range(count):
        document.modelspace().add_hatch().paths.add_polyline_path(SQUARE[:4] + step * i, is_closed=True)
    document.saveas(path)
    return path


@pytest.mark.longest
def test_a_line_drawn_many_times_is_one_line(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    drawing = read_tile(squares(tmp_path / "a.dxf", 3000, 0.0))
    assert [line.tolist() for line in drawing.lines] == [SQUARE.tolist()]
    assert [record.getMessage() for record in caplog.records] == [
        f"{tmp_path / 'a.dxf'}: left out: 2999 repeated lines"
    ]


@pytest.mark.longest
def test_lines_that_cross_too_often_are_refused_before_they_are_joined(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"cross or touch about [\d,]+ times; the limit is 500,000; draw fewer lines"):
        read_tile(squares(tmp_path / "a.dxf", 3000, 0.001))
    assert len(read_tile(squares(tmp_path / "b.dxf", 300, 0.001)).lines) == 300


@pytest.mark.longest
def test_a_long_line_that_never_crosses_itself_is_read(tmp_path: Path) -> None:
    """Neighbouring segments touch, once each: as many as there may be points; few lie within the chord tolerance."""
    x = np.linspace(0, 100, MOST_POINTS - 10)
    path = tmp_path / "a.wkt"
    path.write_text(f"LINESTRING ({', '.join(f'{a:.5f} {b}' for a, b in zip(x, np.arange(len(x)) % 2, strict=True))})")
    assert 0.99 * len(x) < sum(len(line) for line in read_tile(path).lines) <= len(x)


@pytest.mark.slow
def test_too_many_copies_of_a_tile_are_refused_before_they_are_made(tmp_path: Path) -> None:
    tiled = read_tiled(squares(tmp_path / "a.dxf", 300, 0.001))
    assert tiled.name == "a.dxf"
    with pytest.raises(PatternError, match=r"cell is 0\.1 mm: [\d,]+ copies of a\.dxf have [\d,]+ points") as caught:
        replace(tiled, cell=0.1).lines(shapely.box(0, 0, 100, 100))
    assert caught.value.parameters == ("cell",)
    assert replace(tiled, cell=30).lines(shapely.box(0, 0, 100, 100)).length > 0


def test_a_tile_whose_density_cannot_be_measured_is_refused_without_a_word_of_the_cell() -> None:
    """It is measured in cells of 1 mm, whatever the cell of the part: a larger one would not help."""
    line = np.random.default_rng(0).uniform(-0.5, 0.5, (50_000, 2))
    tiled = Tiled(name="a.wkt", drawn=(line,), height=1.0)
    with pytest.raises(
        PatternError, match=r"49 copies of a\.wkt have 2,[\d,]+ points; .* simplify the drawing"
    ) as caught:
        assert LineSample(pattern=tiled).spacing
    assert caught.value.parameters == ()
    assert "larger" not in str(caught.value)


def test_points_that_no_print_would_show_are_left_out_of_too_many_copies() -> None:
    """A circle of 5,000 points, 900 times: within 0.005 mm of its place, and with few enough points."""
    angles = np.linspace(0, 2 * np.pi, 5_001)
    circle = np.column_stack([np.cos(angles), np.sin(angles)]) * 0.4
    tiled = Tiled(name="a.svg", drawn=(circle,), height=1.0, cell=4.0)
    lines = tiled.lines(shapely.box(-60, -60, 60, 60))
    assert shapely.get_num_coordinates(lines) < 2_000_000 / 4
    one_tile = shapely.box(-1.9, -1.9, 1.9, 1.9)
    simplified, exact = shapely.intersection(lines, one_tile), tiled.lines(one_tile)
    assert shapely.get_num_coordinates(exact) > 5_000
    assert shapely.hausdorff_distance(simplified, exact) < 0.005


def test_lines_that_vanish_in_a_small_tile_are_an_error_of_ours() -> None:
    with pytest.raises(
        GeometryError, match=r"every line of the drawing is shorter than 0\.113 mm in tiles of 1 × 1 mm"
    ):
        find_borders([np.array([[0.0, 0.0], [0.01, 0.0]])], (1.0, 1.0), line_width=0.45)


@pytest.mark.slow
@pytest.mark.parametrize("far", [1e10, 1e300])
@pytest.mark.parametrize("words", [[], ["--shell", "2"]])
def test_a_point_that_is_too_far_is_named(far: float, words: list[str], tmp_path: Path) -> None:
    points = np.random.default_rng(1).normal(size=(200, 3))
    points[7, 1] = far
    path = tmp_path / "p.npy"
    np.save(path, points)
    one_line_error(
        run("smooth", path, "--as", "points", "--units", "mm", "--voxel", "0.5", *words, "-o", tmp_path / "a.stl"),
        re.escape(f"a point lies at {plain_size(far)}; the limit is 1,000 km"),
    )
    assert sorted(tmp_path.iterdir()) == [path]
