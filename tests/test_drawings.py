"""Drawings as patterns: what is read from a file, what is told of a broken one, and the paths that come of it."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st
from PIL import Image, ImageDraw

from infill.drawing import Drawing, Picture
from infill.drawings.drawing_files import READERS, read_drawing, read_tile_family
from infill.drawings.svg_paths import bezier_points, path_lines
from infill.errors import FormatError, GeometryError, ParameterError
from infill.paths.covering import cover, solve_cell
from infill.paths.families.family import PathSpec
from infill.paths.tiles.drawn_family import BLUR_PER_RADIUS, DrawnFamily
from infill.paths.tiles.nodes import COARSEST, colour_parity, distance_field, tile_grid
from infill.paths.tiles.two_colours import ALPHA

WIDTH = 0.45
FLAT = 2e-4  # of the size of a drawing: chords lie within 1e-4 of their curves, and simplifying takes half as much


def svg(body: str, head: str = 'width="20mm" height="20mm" viewBox="0 0 20 20"') -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {head}>{body}</svg>'


def written(folder: Path, text: str | bytes, name: str = "tile.svg") -> Path:
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def lines_of(folder: Path, body: str, **head: str) -> Drawing:
    found = read_drawing(written(folder, svg(body, **head)))
    assert isinstance(found, Drawing)
    return found


def dxf(path: Path, *, unit: int = 4) -> tuple[object, object]:
    document = ezdxf.new()
    document.header["$INSUNITS"] = unit
    return document, document.modelspace()


# --- what is read ------------------------------------------------------------------------------------------


def circle_svg(path: Path) -> None:
    path.write_text(svg('<circle cx="10" cy="10" r="5"/>'))


def circle_dxf(path: Path) -> None:
    document, space = dxf(path, unit=1)
    space.add_circle((10 / 25.4, 10 / 25.4), 5 / 25.4)
    document.saveas(path)


def circle_wkt(path: Path) -> None:
    path.write_text(shapely.Point(10, 10).buffer(5, quad_segs=64).wkt)


@pytest.mark.parametrize(("suffix", "write"), [("svg", circle_svg), ("dxf", circle_dxf), ("wkt", circle_wkt)])
def test_a_circle_of_5_mm_is_one(tmp_path: Path, suffix: str, write: object) -> None:
    path = tmp_path / f"circle.{suffix}"
    write(path)
    (line,) = read_drawing(path).lines
    assert np.abs(np.hypot(*(line - 10).T) - 5).max() < FLAT * 10
    assert np.array_equal(line[0], line[-1])
    assert shapely.Polygon(line).area == pytest.approx(25 * math.pi, rel=4 * FLAT)


@pytest.mark.parametrize("name", ["circle.png", "circle.bmp", "circle.jpg"])
def test_a_picture_of_a_circle_has_its_radius(tmp_path: Path, name: str) -> None:
    """Drawn at four times its size and reduced, so that pixels at the edge are grey: a quarter of a pixel at most."""
    image = Image.new("L", (800, 800), 255)
    ImageDraw.Draw(image).ellipse((200, 200, 599.5, 599.5), fill=0)
    image.resize((200, 200), Image.Resampling.BOX).save(tmp_path / name)
    picture = read_drawing(tmp_path / name)
    assert isinstance(picture, Picture)
    family = read_tile_family(tmp_path / name, width=20)
    (line,) = family.drawing.lines
    assert family.width == pytest.approx(20)
    assert np.abs(np.hypot(*(line - line[:-1].mean(axis=0)).T) - 5).max() < 0.025


@pytest.mark.parametrize(
    ("head", "width"),
    [
        ('width="20mm" height="10mm" viewBox="0 0 2 1"', 20),
        ('width="2cm" height="1cm"', 20),
        ('width="1in" height="0.5in" viewBox="0 0 4 2"', 25.4),
        ('width="96" height="48"', 25.4),
        ('width="96px" height="48px" viewBox="10 10 200 100"', 25.4),
        ('width="72pt" height="36pt"', 25.4),
        ('viewBox="0 0 96 48"', 25.4),
        ('width="100%" height="100%" viewBox="0 0 96 48"', 25.4),
        ('width="40mm" height="10mm" viewBox="0 0 2 1"', 40),  # a drawing in the middle of a wider page
    ],
)
def test_pages_have_their_size(tmp_path: Path, head: str, width: float) -> None:
    drawing = read_drawing(written(tmp_path, svg('<path d="M0 0L.5 .5"/>', head)))
    x0, y0, x1, y1 = drawing.page
    assert (x0, y0, x1) == pytest.approx((0, 0, width))
    assert y1 == pytest.approx(10 if "mm" in head or "cm" in head else 12.7)


@pytest.mark.parametrize(
    ("body", "ends"),
    [
        ('<g transform="rotate(90 10 10) translate(2,0)"><line x1="0" y1="10" x2="4" y2="10"/></g>', (10, 18, 10, 14)),
        ('<line x2="1" transform="matrix(0 2 -3 0 5 6)"/>', (5, 14, 5, 12)),
        ('<line x2="1" y2="1" transform="scale(2 3) skewX(45)"/>', (0, 20, 4, 17)),
        ('<g id="a" transform="translate(1)"><line x2="1"/></g>', (1, 20, 2, 20)),
        ('<defs><line id="a" x2="1"/></defs><use href="#a" x="5" y="2" transform="scale(2)"/>', (10, 16, 12, 16)),
        ('<symbol id="s" viewBox="0 0 10 10"><line x2="10" y2="10"/></symbol><use xlink:href="#s" x="4" width="5" height="5"/>', (4, 20, 9, 15)),
        ('<svg x="10" y="10" width="5" height="5" viewBox="0 0 100 100"><line x2="100"/></svg>', (10, 10, 15, 10)),
        ('<line x1="10%" x2="50%" y2="100%"/>', (2, 20, 10, 0)),
        ('<polyline points="1,1 2 2,3-4"/>', (1, 19, 3, 24)),
    ],
)  # fmt: skip
def test_shapes_lie_where_they_are_drawn(tmp_path: Path, body: str, ends: tuple[float, ...]) -> None:
    """The y axis of SVG goes down from the top of the page, ours up from its bottom."""
    (line,) = lines_of(tmp_path, body).lines
    assert line[[0, -1]].ravel() == pytest.approx(ends, abs=1e-9)


@pytest.mark.parametrize(
    ("body", "area"),
    [
        ('<rect x="5" y="5" width="10" height="4"/>', 40),
        ('<rect x="5" y="5" width="10" height="4" rx="1"/>', 40 - (4 - math.pi)),
        ('<rect x="5" y="5" width="10" height="4" rx="9" ry="1"/>', 40 - (4 - math.pi) * 5),
        ('<ellipse cx="9" cy="9" rx="3" ry="2"/>', 6 * math.pi),
        ('<polygon points="0,0 4,0 4,4"/>', 8),
        ('<path d="M4 10a5 5 0 0110 0 5 5 0 11-10 0"/>', 25 * math.pi),
        ('<path d="M0 0h4v4h-4zm2 2"/>', 16),
    ],
)
def test_outlines_have_their_area(tmp_path: Path, body: str, area: float) -> None:
    line = lines_of(tmp_path, body).lines[0]
    assert shapely.Polygon(line).area == pytest.approx(area, rel=10 * FLAT)


def test_what_is_left_out_is_told(tmp_path: Path) -> None:
    body = (
        '<rect width="100%" height="100%" fill="white"/><text>a</text><text>b</text><image/>'
        '<clipPath id="c"><rect width="4" height="4"/></clipPath><mask><circle r="3"/></mask>'
        '<pattern><circle r="3"/></pattern><g style="display: none"><circle r="2"/></g><circle visibility="hidden" r="1"/>'
        '<line x2="3" y2="1" clip-path="url(#c)"/>'
    )
    drawing = lines_of(tmp_path, body)
    assert len(drawing.lines) == 1
    assert set(drawing.left_out) == {"1 background", "2 texts", "1 picture", "1 clip"}


@pytest.mark.parametrize(
    ("frame", "drawn"),
    [
        ('<rect width="20" height="20" fill="white"/>', False),
        ('<rect width="20" height="20" stroke="none" style="stroke-width:1"/>', False),
        ('<rect width="20" height="20" stroke="black"/>', True),
        ('<rect width="20" height="20" style="fill:none;stroke:#000"/>', True),
        ('<g stroke="black"><rect width="20" height="20"/></g>', True),
        ('<g style="stroke:red"><g><rect width="20" height="20" stroke="inherit"/></g></g>', True),
        ('<g stroke="black"><rect width="20" height="20" stroke="none"/></g>', False),
    ],
)
def test_a_page_sized_frame_is_drawn_if_it_has_a_stroke_be_it_inherited(
    tmp_path: Path, frame: str, drawn: bool
) -> None:
    drawing = lines_of(tmp_path, f'{frame}<line x2="3" y2="1"/>')
    assert (len(drawing.lines) == 2, drawing.left_out == ()) == (drawn, drawn)


def test_names_of_namespaces_may_be_abbreviated(tmp_path: Path) -> None:
    """Some programs declare entities for them."""
    text = '<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY n "http://www.w3.org/2000/svg">]><svg xmlns="&n;"><circle r="2"/></svg>'
    assert len(read_drawing(written(tmp_path, text)).lines) == 1
    assert len(read_drawing(written(tmp_path, svg('<circle r="2"/>').encode("utf-16"))).lines) == 1


def test_dxf_splines_bulges_blocks_and_layers(tmp_path: Path) -> None:
    path = tmp_path / "tile.dxf"
    document, space = dxf(path, unit=5)  # cm
    space.add_lwpolyline([(0, 0, 0, 0, 1), (2, 0, 0, 0, 1)], close=True)  # two half circles
    controls = [(0, 0), (1, 2), (3, 2), (4, 0)]
    space.add_open_spline(controls, degree=3)
    block = document.blocks.new("B")
    block.add_arc((0, 0), 1, 0, 90)
    space.add_blockref("B", (10, 0), dxfattribs={"xscale": 2, "yscale": 2, "rotation": 90})
    document.layers.add("off").off()
    space.add_line((0, 0), (90, 90), dxfattribs={"layer": "off"})
    space.add_text("words")
    document.saveas(path)
    drawing = read_drawing(path)
    disc, spline, arc = drawing.lines
    assert shapely.Polygon(disc).area == pytest.approx(100 * math.pi, rel=10 * FLAT)
    exact = bezier_points(np.array(controls, dtype=float)) * 10
    assert (
        shapely.hausdorff_distance(shapely.LineString(spline), shapely.LineString(np.vstack([[[0, 0]], exact])))
        < FLAT * 120
    )
    assert np.abs(np.hypot(*(arc - (100, 0)).T) - 20).max() < FLAT * 120
    assert arc[[0, -1]].ravel() == pytest.approx([100, 20, 80, 0], abs=1e-6)
    assert set(drawing.left_out) == {"1 hidden line", "1 text"}


def test_wkt_of_many_kinds(tmp_path: Path) -> None:
    text = "POLYGON ((0 0, 9 0, 9 9, 0 0), (5 1, 6 1, 6 2, 5 1))\nGEOMETRYCOLLECTION (POINT (1 1), MULTILINESTRING ((0 0, 1 1), (2 2, 3 3)))"
    drawing = read_drawing(written(tmp_path, text, "tile.wkt"))
    assert [len(line) for line in drawing.lines] == [2, 2, 4, 4]
    assert drawing.left_out == ("1 point",)


# --- path data against formulas ----------------------------------------------------------------------------

number = st.floats(-100, 100, allow_subnormal=False).map(lambda value: round(value, 3))
point = st.tuples(number, number)


def text_of(*numbers: float) -> str:
    return " ".join(f"{each:.3f}" for each in numbers)


@given(points=st.lists(point, min_size=4, max_size=4, unique=True), cubic=st.booleans())
@example(points=[(0, 0), (10, 0), (0, 0.001), (10, 0)], cubic=True)
def test_bezier_curves_are_those_of_the_formula(points: list[tuple[float, float]], cubic: bool) -> None:
    """Every point of the curve lies within a thousandth of its controls' extent of a chord."""
    controls = np.array(points if cubic else points[:3], dtype=float)
    (line,) = path_lines(f"M{text_of(*points[0])}{'C' if cubic else 'Q'}{text_of(*controls[1:].ravel())}")
    t = np.linspace(0, 1, 200)[:, None]
    degree = len(controls) - 1
    curve = sum(math.comb(degree, k) * t**k * (1 - t) ** (degree - k) * controls[k] for k in range(degree + 1))
    away = shapely.distance(shapely.LineString(line), shapely.points(curve))
    assert away.max() <= 1e-3 * np.ptp(controls, axis=0).max()
    assert line[[0, -1]].tolist() == controls[[0, -1]].tolist()


@given(
    centre=point,
    radii=st.tuples(st.floats(0.5, 50), st.floats(0.5, 50)),
    turned=st.floats(-180, 180),
    first=st.floats(0, 6.28),
    swept=st.one_of(st.floats(0.1, 6), st.floats(-6, -0.1)),
)
def test_arcs_are_those_of_the_formula(
    centre: tuple[float, float], radii: tuple[float, float], turned: float, first: float, swept: float
) -> None:
    cos, sin = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    angles = first + swept * np.linspace(0, 1, 50)
    ellipse = np.stack([radii[0] * np.cos(angles), radii[1] * np.sin(angles)], axis=1)
    exact = ellipse @ np.array([[cos, sin], [-sin, cos]]) + centre
    data = f"M{exact[0, 0]!r} {exact[0, 1]!r}A{radii[0]!r} {radii[1]!r} {turned!r} {int(abs(swept) > math.pi)} {int(swept > 0)} {exact[-1, 0]!r},{exact[-1, 1]!r}"
    (line,) = path_lines(data.replace("np.float64(", "").replace(")", ""))
    away = shapely.distance(shapely.LineString(line), shapely.points(exact))
    # Near half an ellipse, where the centre lies depends on the root of a difference.
    assert away.max() < 2e-4 * max(radii) + 1e-5


@pytest.mark.slow
@given(points=st.lists(point, min_size=6, max_size=6))
def test_relative_and_smooth_letters_are_short_for_absolute_ones(points: list[tuple[float, float]]) -> None:
    p = np.array(points)
    mirrored = 2 * p[3] - p[2]
    long = f"M{text_of(*p[0])} C{text_of(*p[1:4].ravel())} C{text_of(*mirrored, *p[4:].ravel())}"
    short = f"m{text_of(*p[0])} c{text_of(*(p[1:4] - p[0]).ravel())} s{text_of(*(p[4:] - p[3]).ravel())}"
    (one,), (other,) = path_lines(long), path_lines(short)
    assert shapely.hausdorff_distance(shapely.LineString(one), shapely.LineString(other)) < 0.05
    assert np.abs(one[-1] - other[-1]).max() < 0.01  # numbers are written to 0.001


# --- what is broken ----------------------------------------------------------------------------------------

BOMB = '<!DOCTYPE x [<!ENTITY a "lol"><!ENTITY b "&a;&a;&a;"><!ENTITY c "&b;&b;&b;">]><svg>&c;</svg>'
BROKEN = {
    "empty": ("tile.svg", "", "broken"),
    "text": ("tile.svg", "hello, world", "broken"),
    "cut off": ("tile.svg", svg('<circle r="3"/>')[:-9], "broken"),
    "not SVG": ("tile.svg", "<html/>", "root is html"),
    "a bomb": ("tile.svg", BOMB, "entity 'b'"),
    "a copy of itself": ("tile.svg", svg('<g id="a"><use href="#a"/></g>'), "contains itself"),
    "copies of copies": (
        "tile.svg",
        svg("".join(f'<g id="g{k}"><use href="#g{k + 1}"/><use href="#g{k + 1}"/></g>' for k in range(40)) + '<g id="g40"/>'),
        "100001 drawn elements or more",
    ),
    "deep": ("tile.svg", "<g>" * 2000, "101 groups in one another"),
    "only text": ("tile.svg", svg("<text>a</text>"), "only 1 text"),
    "no lines": ("tile.svg", svg(""), "no lines"),
    "a dot": ("tile.svg", svg('<path d="M1 1L1 1"/>'), "without length"),
    "path cut off": ("tile.svg", svg('<path d="M0 0L10 10C1 2"/>'), "instead of 6"),
    "path of words": ("tile.svg", svg('<path d="M0 0L10 nan"/>'), "not its numbers"),
    "path without M": ("tile.svg", svg('<path d="L10 10"/>'), "not with M"),
    "far away": ("tile.svg", svg('<path d="M0 0L1e308 1e308"/>'), "beyond"),
    "moved far away": ("tile.svg", svg('<line x2="1" transform="scale(1e300 1e300)"/>'), "the limit is 100,000 mm"),
    "a bad length": ("tile.svg", svg('<rect width="nan" height="3"/>'), "length 'nan'"),
    "a bad transform": ("tile.svg", svg('<line x2="1" transform="rotate(a)"/>'), "'a'"),
    "wkt of words": ("tile.wkt", "hello", "broken"),
    "wkt empty": ("tile.wkt", "LINESTRING EMPTY", "no lines"),
    "wkt of points": ("tile.wkt", "MULTIPOINT (1 1, 2 2)", "only 2 points"),
    "wkt with NaN": ("tile.wkt", "LINESTRING (0 0, 1 nan)", "nan mm"),
    "wkt far away": ("tile.wkt", "LINESTRING (0 0, 1e300 1)", "over 1000000000000000 mm"),
    "wkt in bytes": ("tile.wkt", b"\xff\xfe\x00\x80", "broken"),
    "dxf empty": ("tile.dxf", "", "is empty"),
    "dxf of words": ("tile.dxf", "hello", "not a DXF file"),
    "png of words": ("tile.png", "hello", "not a picture"),
    "no such format": ("tile.pdf", "hello", "use one of .svg"),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_is_told_in_one_line(tmp_path: Path, kind: str) -> None:
    name, content, said = BROKEN[kind]
    with pytest.raises(FormatError) as caught:
        read_tile_family(written(tmp_path, content, name))
    message = str(caught.value)
    assert said in message
    assert "\n" not in message
    assert name in message


def test_a_dxf_cut_off_anywhere_is_told_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "tile.dxf"
    document, space = dxf(path)
    space.add_circle((0, 0), 5)
    document.saveas(path)
    data = path.read_bytes()
    for share in (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
        path.write_bytes(data[: int(len(data) * share)])
        with pytest.raises(FormatError, match="broken or not a .dxf file") as caught:
            read_drawing(path)
        assert "\n" not in str(caught.value)


@pytest.mark.long
@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("nan", "extend over nan"),
        ("far", "over 1000000000000000 mm"),
        ("itself", "contains itself"),
        ("many", "the limit is 50000"),
        ("text", "only 1 text"),
    ],
)
def test_an_odd_dxf_is_told_in_one_line(tmp_path: Path, kind: str, said: str) -> None:
    document, space = dxf(tmp_path / "tile.dxf")
    block = document.blocks.new("B")
    block.add_line((0, 0), (1, 1))
    match kind:
        case "nan" | "far":
            space.add_line((0, 0), (math.nan if kind == "nan" else 1e300, 1))
        case "itself":
            block.add_blockref("B", (1, 1))
            space.add_blockref("B", (0, 0))
        case "many":
            space.add_blockref(
                "B", (0, 0), dxfattribs={"row_count": 3000, "column_count": 3000, "row_spacing": 1, "column_spacing": 1}
            )
        case "text":
            space.add_text("words")
    document.saveas(tmp_path / "tile.dxf")
    with pytest.raises(FormatError, match="tile.dxf") as caught:
        read_drawing(tmp_path / "tile.dxf")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_pictures_without_a_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "tile.png"
    Image.new("L", (30, 30), 77).save(path)
    with pytest.raises(FormatError, match="one colour"):
        read_drawing(path)
    Image.new("RGBA", (30, 30), (0, 0, 0, 0)).save(path)  # transparent, and so light
    with pytest.raises(FormatError, match="one colour"):
        read_drawing(path)
    speck = np.full((60, 60), 255, dtype=np.uint8)
    speck[30, 30] = 0
    Image.fromarray(speck).save(path)
    with pytest.raises(FormatError, match="specks"):
        read_tile_family(path)
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(FormatError, match="broken"):
        read_drawing(path)
    path.write_bytes(data)
    monkeypatch.setattr("infill.drawings.bitmaps.MOST_PIXELS", 1000)
    with pytest.raises(FormatError, match="60 × 60 pixels; the limit is 1000"):
        read_drawing(path)


def test_dxf_without_ezdxf_names_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(FormatError, match="needs the extra drawings: pip install ezdxf"):
        read_drawing(written(tmp_path, "0\nEOF\n", "tile.dxf"))


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    for suffix in READERS:
        with pytest.raises(FormatError, match="there is no file"):
            read_drawing(tmp_path / f"none{suffix}")


# --- the contract of a family ------------------------------------------------------------------------------

HEART = "M10 17C2 11 2 4 6.5 4C9 4 10 6 10 7C10 6 11 4 13.5 4C18 4 18 11 10 17z"
HONEYCOMB = "M0 5.7735h3L6 0M3 5.7735L6 11.547M6 0h6M6 11.547h6M12 0L15 5.7735 12 11.547M15 5.7735h3"


def hearts(folder: Path) -> Path:
    return written(folder, svg(f'<path d="{HEART}"/><circle r="2.5"/>'), "hearts.svg")


def leaves(folder: Path) -> Path:
    """Leaves with veins that go on beyond the edge, 1 % of the pixels flipped."""
    image = Image.new("L", (160, 120), 255)
    draw = ImageDraw.Draw(image)
    t = np.linspace(0, math.pi, 30)
    leaf = np.vstack([np.stack([np.cos(t), s * np.sin(t) ** 1.5 / 2.5], axis=1)[::s] for s in (1, -1)])
    for x, y, angle, length in ((40, 30, 0.6, 38), (110, 40, -0.7, 42), (60, 95, 2.4, 40), (135, 100, 0.2, 32)):
        turn = length * np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        for i in (-160, 0, 160):
            for j in (-120, 0, 120):
                draw.polygon([tuple(each) for each in leaf @ turn + (x + i, y + j)], fill=0)
                draw.line(
                    [tuple(each) for each in np.array([[-1, 0], [0.5, 0]]) @ turn + (x + i, y + j)], fill=255, width=5
                )
    pixels = np.array(image)
    flipped = np.random.default_rng(3).random(pixels.shape) < 0.01
    pixels[flipped] = 255 - pixels[flipped]
    Image.fromarray(pixels).save(folder / "leaves.png")
    return folder / "leaves.png"


def splines(folder: Path) -> Path:
    document, space = dxf(folder / "splines.dxf")
    for k in range(4):
        space.add_spline([(0, 5 * k), (4, 5 * k + 3), (10, 5 * k - 2), (16, 5 * k + 2), (20, 5 * k)])
    space.add_lwpolyline([(5, 0, 0, 0, 0.4), (7, 10, 0, 0, -0.4), (5, 20, 0, 0, 0)])
    document.saveas(folder / "splines.dxf")
    return folder / "splines.dxf"


def scribble(folder: Path) -> Path:
    """Lines that meet in any way: loose ends, junctions, crossings, outlines."""
    numbers = np.random.default_rng(1).random((8, 4)) * 20
    body = "".join(f'<path d="M{a:.2f} {b:.2f}L{c:.2f} {d:.2f}"/>' for a, b, c, d in numbers)
    return written(
        folder, svg(body + '<circle cx="9" cy="9" r="6"/><rect x="2" y="3" width="9" height="8"/>'), "scribble.svg"
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("drawings")


def as_lines(paths: list[np.ndarray]) -> np.ndarray:
    return np.array([shapely.LineString(path) for path in paths])


def crossings(paths: list[np.ndarray]) -> int:
    """Count pairs of paths that meet, and paths that meet themselves."""
    lines = as_lines(paths)
    one, other = shapely.STRtree(lines).query(lines, predicate="intersects")
    return int((one < other).sum()) + int((~shapely.is_simple(lines)).sum())


def turns(path: np.ndarray) -> np.ndarray:
    legs = np.diff(path, axis=0)
    angles = np.arctan2(legs[:, 1], legs[:, 0])
    return np.abs((np.diff(angles) + math.pi) % (2 * math.pi) - math.pi)


def inside(paths: list[np.ndarray], box: shapely.Polygon) -> shapely.Geometry:
    return shapely.intersection(shapely.multilinestrings(as_lines(paths)), box)


def test_crossings_are_counted() -> None:
    """The comparison can fail."""
    assert crossings([np.array([[0.0, 0], [1, 1]]), np.array([[0.0, 1], [1, 0]])]) == 1
    assert crossings([np.array([[0.0, 0], [1, 1], [1, 0], [0, 1]])]) == 1
    assert turns(np.array([[0.0, 0], [1, 0], [1, 1]])) == pytest.approx([math.pi / 2])


@pytest.mark.slow
@pytest.mark.parametrize("make", [hearts, leaves, splines, scribble], ids=lambda make: make.__name__)
def test_paths_of_a_drawing_keep_the_contract(folder: Path, make: object) -> None:
    family = read_tile_family(make(folder))
    cell, height = 14.0, 14.0 * (family.tile[3] - family.tile[1]) / family.width
    asked = {"cell": cell, "line_width": WIDTH, "radius": 0.6}
    paths = family.strands((-3, -3, 30, 30), PathSpec(**asked))
    assert crossings(paths) == 0
    assert all(path.dtype == np.float64 and path.shape[1] == 2 for path in paths)
    # Chords turn by 20° at most, and where they go on from tile to tile by as little.
    assert max(turns(path).max() for path in paths) < math.radians(26)
    # A window moved by a tile shows the same, and where lines lie does not depend on the window: to rounding.
    here = inside(paths, shapely.box(0, 0, cell, height))
    for i, j in ((1, 0), (0, 1), (-2, 3)):
        bounds = (i * cell - 1, j * height - 1, (i + 1) * cell + 1, (j + 1) * height + 1)
        there = inside(
            family.strands(bounds, PathSpec(**asked)),
            shapely.box(*(np.array((0, 0, cell, height)) + (i * cell, j * height) * 2)),
        )
        moved = shapely.transform(there, lambda points, i=i, j=j: points - (i * cell, j * height))
        assert shapely.length(moved) == pytest.approx(shapely.length(here), rel=1e-9)
        assert shapely.hausdorff_distance(moved, here) < 1e-6
    # No path ends inside the box: only where the tiles asked for end.
    ends = np.concatenate(
        [path[[0, -1]] for path in paths if not np.array_equal(path[0], path[-1])] or [np.empty((0, 2))]
    )
    assert not ((ends > -3) & (ends < 30)).all(axis=1).any()


@pytest.mark.slow
@pytest.mark.parametrize("make", [hearts, splines], ids=lambda make: make.__name__)
def test_the_first_guess_of_the_cell_is_near(folder: Path, make: object) -> None:
    """Smoothing to the radius shortens paths further, which the guess leaves out: a tenth."""
    family = read_tile_family(make(folder))
    cell = family.cell_for(0.15, WIDTH)
    height = cell * (family.tile[3] - family.tile[1]) / family.width
    paths = family.strands((0, 0, cell, height), PathSpec(cell=cell, line_width=WIDTH))
    found = shapely.length(inside(paths, shapely.box(0, 0, cell, height))) * 0.905 * WIDTH / (cell * height)
    assert found == pytest.approx(0.15, rel=0.1)


def test_lengths_change_smoothly_with_the_cell(folder: Path) -> None:
    """Between the cells whose fields are computed, 4 % apart, length per area is as 1 / cell, to rounding."""
    family = read_tile_family(scribble(folder))
    cells = 1.04 ** np.array([66.6, 67.0, 67.4])
    paths = [family.strands((0, 0, cell, cell), PathSpec(cell=cell, line_width=WIDTH, radius=0.6)) for cell in cells]
    lengths = [
        shapely.length(inside(some, shapely.box(0, 0, cell, cell))) for some, cell in zip(paths, cells, strict=True)
    ]
    assert lengths / cells == pytest.approx([lengths[0] / cells[0]] * 3, rel=1e-9)


@pytest.mark.parametrize(
    ("body", "head", "tile"),
    [
        ('<path d="M5 8h10"/>', 'viewBox="0 0 96 48" width="96mm" height="48mm"', (5, 39.5, 15, 40.5)),  # a small mark
        ('<path d="M5 8h30"/>', 'viewBox="0 0 96 48" width="96mm" height="48mm"', (0, 0, 96, 48)),
        ('<circle cx="5" cy="5" r="5"/>', "", (-0.5, -0.5, 10.5, 10.5)),  # an outline gets a gap
        ('<path d="M0 0h10v10h-10z"/>', "", (0, 0, 10, 10)),  # one along the edge does not
        ('<path d="M0 2q5 5 10 0M3 0l1 5-1 5"/>', "", (0, 0, 10, 10)),  # lines that go on
        ('<path d="M0 2q5 -5 10 0M3 0l-9 5 9 5"/>', "", (0, 0, 10, 10)),  # even where others bulge
    ],
)
def test_what_is_repeated(folder: Path, body: str, head: str, tile: tuple[float, ...]) -> None:
    """Without a page, a px is a px: 25.4 / 96 mm; y goes up from the first line."""
    found = np.array(read_tile_family(written(folder, svg(body, head), "some.svg")).tile)
    if not head:
        found = found * 96 / 25.4
        found[[1, 3]] = -found[[3, 1]]
    assert found == pytest.approx(tile, abs=0.01)


@pytest.mark.slow
def test_beads_have_room(folder: Path) -> None:
    """Wherever lines come close, other paths stay 0.8 line widths away; a hundredth may be nearer, at crossings."""
    paths = read_tile_family(scribble(folder)).strands((0, 0, 20, 20), PathSpec(cell=18, line_width=WIDTH, radius=0.6))
    lines = as_lines(paths)
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=0.8 * WIDTH)
    near = [
        shapely.intersection(lines[i], shapely.buffer(lines[j], 0.8 * WIDTH))
        for i, j in zip(one, other, strict=True)
        if i != j
    ]
    assert shapely.length(near).sum() < 0.01 * shapely.length(lines).sum()


# --- two colours -------------------------------------------------------------------------------------------


def strands(folder: Path, body: str, *, cell: float = 20.0, radius: float = 0.0, **head: str) -> list[np.ndarray]:
    family = read_tile_family(written(folder, svg(body, **head), "some.svg"))
    return family.strands((0.5, 0.5, cell - 0.5, cell - 0.5), PathSpec(cell=cell, line_width=WIDTH, radius=radius))


def test_an_outline_is_kept(folder: Path) -> None:
    """To the shrinking of a circle by its own curvature: blur² / 2 R, and the deviation of chords."""
    (path,) = strands(folder, '<circle cx="10" cy="10" r="6"/>')
    away = np.hypot(*(path - 10).T)
    assert away.min() > 6 - 0.2**2 / 12 - 0.01
    assert away.max() < 6.002
    assert np.array_equal(path[0], path[-1])


@pytest.mark.long
@pytest.mark.parametrize("radius", [0.6, 1.0, 1.8])
def test_right_angles_get_about_the_radius(folder: Path, radius: float) -> None:
    (path,) = strands(folder, '<rect x="5" y="5" width="10" height="10"/>', radius=radius)
    legs = np.hypot(*np.diff(path, axis=0).T)
    bends = (legs[1:] + legs[:-1]) / 2 / np.maximum(turns(path), 1e-9)
    assert bends.min() == pytest.approx(radius, rel=0.15)


def test_the_largest_radius_is_a_tenth_of_the_tile(folder: Path) -> None:
    family = read_tile_family(written(folder, svg('<rect x="5" y="5" width="10" height="10"/>'), "some.svg"))
    cell = 1.04**59  # about 10 mm, and one of those whose fields are computed
    one, other = (
        family.strands((0, 0, 9, 9), PathSpec(cell=cell, line_width=WIDTH, radius=radius))[0]
        for radius in (family.largest_radius(cell, WIDTH), math.inf)
    )
    assert np.array_equal(one, other)


@pytest.mark.slow
def test_parallel_lines_stay_where_they_are(folder: Path) -> None:
    """Half a millimetre apart, or more: to a tenth of a grid cell, by which they settle on its lines."""
    paths = strands(folder, '<path d="M0 5h20M0 5.5h20M0 12h20"/>', radius=1.0)
    assert sorted(path[:, 1].mean() for path in paths) == pytest.approx([8, 14.5, 15], abs=0.006)
    assert max(np.ptp(path[:, 1]) for path in paths) < 1e-3


def test_a_honeycomb_drawn_once_becomes_touching_waves(folder: Path) -> None:
    """One wall in three is doubled; every path goes on for ever, and doubled walls are 0.905 line widths apart."""
    family = read_tile_family(
        written(folder, svg(f'<path d="{HONEYCOMB}"/>', 'viewBox="0 0 18 11.547"'), "honeycomb.svg")
    )
    paths = family.strands((0, 0, 36, 23.094), PathSpec(cell=18, line_width=WIDTH))
    assert not any(np.array_equal(path[0], path[-1]) for path in paths)
    length = shapely.length(inside(paths, shapely.box(0, 0, 18, 11.547)))
    assert length == pytest.approx(36 * 4 / 3, rel=0.06)  # corners are rounded
    lines = as_lines(paths)
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=WIDTH)
    gaps = [shapely.distance(lines[i], lines[j]) for i, j in zip(one, other, strict=True) if i < j]
    assert gaps
    assert gaps == pytest.approx([0.905 * WIDTH] * len(gaps), abs=0.02)  # a third of a grid cell


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "loops"),
    [
        ('<path d="M0 10h20M10 0v20M0 0h20M0 0v20"/>', False),  # a grid: stairs
        ('<path d="M0 0l20 20M0 20l20-20"/>', False),  # one on its corner: zigzags
        ('<rect width="20" height="20" stroke="red"/>', False),  # the page's edge, drawn twice
        ('<path d="M5 5Q10 0 15 5"/>', True),  # a stroke: a loop around it
    ],
)
def test_crossings_are_turned_off_at(folder: Path, body: str, loops: bool) -> None:
    family = read_tile_family(written(folder, svg(body), "some.svg"))
    paths = family.strands((0, 0, 40, 40), PathSpec(cell=20, line_width=WIDTH))
    assert crossings(paths) == 0
    assert all(np.array_equal(path[0], path[-1]) == loops for path in paths)
    lines = as_lines(paths)
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=3 * WIDTH)
    gaps = [shapely.distance(lines[i], lines[j]) for i, j in zip(one, other, strict=True) if i < j]
    # Beads touch where lines crossed; smoothing draws corners back a little.
    assert all(0.85 * WIDTH < gap < 1.7 * WIDTH for gap in gaps)


def test_a_junction_keeps_one_line_and_doubles_the_other(folder: Path) -> None:
    paths = strands(folder, '<path d="M10 0v20M10 10h6"/>')
    assert len(paths) == 1
    length = shapely.length(inside(paths, shapely.box(0, 0, 20, 20)))
    assert length == pytest.approx(20 + 2 * 6, abs=1)


@given(corners=st.lists(st.tuples(st.floats(0.3, 4), st.floats(0, 1)), min_size=3, max_size=9))
def test_colours_are_insides(corners: list[tuple[float, float]]) -> None:
    """Against shapely, for polygons that are stars about the centre; within 1e-9 mm of a line either is right."""
    angles = (np.arange(len(corners)) + [turn * 0.9 for _, turn in corners]) * 2 * math.pi / len(corners)
    radii = np.array([radius for radius, _ in corners])
    ring = np.stack([5 + radii * np.cos(angles), 5 + radii * np.sin(angles)], axis=1)
    ring = np.vstack([ring, ring[:1]])
    edges = np.stack([ring[:-1], ring[1:]], axis=1)
    grid = tile_grid((10.0, 10.0), line_width=4.0, blur=0.1)
    x, y = (grid.first[axis] + grid.spacing[axis] * np.arange(grid.nodes[axis]) for axis in (0, 1))
    points = shapely.points(*np.broadcast_arrays(x[:, None], y[None]))
    exact = shapely.distance(shapely.LineString(ring), points)
    assert np.abs(distance_field(edges, grid, 2.0) - np.minimum(exact, 2.0)).max() < 1e-9
    polygon = shapely.Polygon(ring)
    if polygon.is_valid:
        assert (colour_parity(edges, grid) == shapely.contains(polygon, points))[exact > 1e-9].all()


@pytest.mark.parametrize("cell", [10.0, 40.0, 90.0, 120.0])
def test_a_tile_is_smoothed_in_seconds(cell: float) -> None:
    """Cells get wider, up to a limit, where a large tile would take long to smooth: with the fourth power of its size."""
    family = DrawnFamily(
        name="a", drawing=Drawing(lines=(np.array([[0.0, 0.0], [1.0, 1.0]]),), page=(0.0, 0.0, 1.0, 1.0))
    )
    blur = BLUR_PER_RADIUS * family.largest_radius(cell, 0.45)
    grid = tile_grid((cell, cell), line_width=0.45, blur=blur)
    steps = (blur / max(grid.spacing)) ** 2 / (2 * ALPHA)
    assert math.prod(grid.shape) * steps < 2.2e9  # 3 ns each
    assert max(grid.spacing) * 0.99 <= 0.45 / COARSEST


@pytest.mark.slow
def test_limits_are_told(folder: Path) -> None:
    family = read_tile_family(hearts(folder))
    with pytest.raises(GeometryError, match=r"too large .* the limit is \d+ × \d+ mm"):
        family.strands((0, 0, 1, 1), PathSpec(cell=2000, line_width=WIDTH))
    with pytest.raises(GeometryError, match=r"nothing is left of hearts.svg .* make the cell larger"):
        family.strands((0, 0, 1, 1), PathSpec(cell=0.5, line_width=WIDTH))
    far = read_tile_family(written(folder, svg('<path d="M-50000 0L50000 3"/>'), "far.svg"))
    with pytest.raises(GeometryError, match="draw on the page: .* copies of a line"):
        far.strands((0, 0, 1, 1), PathSpec(cell=20, line_width=WIDTH))
    with pytest.raises(ParameterError, match="cell"):
        family.strands((0, 0, 1, 1), PathSpec(cell=math.nan, line_width=WIDTH))
    with pytest.raises(ParameterError, match="width"):
        read_tile_family(hearts(folder), width=-1)


# --- a part --------------------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.parametrize("make", [hearts, leaves, splines], ids=lambda make: make.__name__)
def test_a_drawing_fills_a_bracket(folder: Path, make: object) -> None:
    """Without a crossing or a path outside, and with the length asked for: to 1 %, where lengths jump with the cell."""
    outside = shapely.Polygon([(0, 0), (75, 0), (75, 20), (25, 50), (0, 50)])
    bores = shapely.union_all(
        [shapely.Point(12, 40).buffer(5), shapely.Point(60, 10).buffer(4), shapely.box(25, 8, 45, 20)]
    )
    region = shapely.difference(outside, bores)
    family, asked = read_tile_family(make(folder)), {"line_width": WIDTH, "radius": 0.6}
    wanted = 0.2 * region.area / (0.905 * WIDTH)
    solved = solve_cell([(region, 0.2, 0)], family, wanted, **asked)
    paths = cover(region, family, cell=solved.cell, z=0.2, layer=0, **asked)
    assert sum(shapely.length(as_lines(paths))) == pytest.approx(wanted, rel=0.01)
    assert crossings(paths) == 0
    assert (
        shapely.length(shapely.difference(shapely.multilinestrings(as_lines(paths)), shapely.buffer(region, 1e-3))) == 0
    )
