"""Read SVG: the outlines and strokes of its shapes, in mm and y upwards.

Supported are paths, the basic shapes, groups, nested pages, symbols and copies by `use`, with their transforms, and
the size of the page in physical units. Widths and colours of lines are ignored; texts, pictures and the shapes of
clips, masks and fills are left out and counted. Style sheets are not read.

Source: Scalable Vector Graphics (SVG) 2, W3C 2018; CSS lengths at 96 px to the inch.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from infill.drawing import Bounds, Drawing, Line, build_drawing, count_points, require_at_most
from infill.drawings.svg_numbers import (
    IDENTITY,
    PX,
    Matrix,
    compose,
    fit_view_box,
    parse_length,
    parse_numbers,
    parse_transform,
)
from infill.drawings.svg_paths import ellipse_lines, path_lines, rectangle_lines
from infill.files.broken import wrap_reader_errors

LARGEST_FILE = 20_000_000  # bytes
LONGEST_ENTITY = 256  # characters: names of namespaces, which some programs abbreviate
MOST_ELEMENTS = 100_000  # drawn elements, including copies of copies
MOST_PARSED = 400_000  # elements of the file, drawn or not
DEEPEST = 100
HIDDEN_TAGS = {"defs", "symbol", "clipPath", "mask", "pattern", "marker"}
OMITTED_TAGS = {"text": "text", "image": "picture", "foreignObject": "foreign object"}


def read_svg(path: Path) -> Drawing:
    """Read the drawing of an SVG file; the module lists the supported elements."""
    require_at_most(LARGEST_FILE, path.stat().st_size, "bytes")
    with wrap_reader_errors(path, advice="save it again as plain SVG"), np.errstate(all="ignore"):
        root = _parse_xml(path.read_bytes())
        if _tag(root) != "svg":
            raise ValueError(f"its root is {_tag(root)}, not svg")
        reader = _Reader(root)
        lines = list(count_points(reader.lines()))
    flip = np.array([1.0, -1.0])
    upright = [line * (PX, PX) * flip + (0, reader.page[3] * PX if reader.page else 0) for line in lines]
    page = None
    if reader.page:
        x0, y0, x1, y1 = (coordinate * PX for coordinate in reader.page)
        page = (x0, y1 - y1, x1, y1 - y0)
    return build_drawing(path, upright, page=page, left_out=dict(reader.left_out))


# --- XML -------------------------------------------------------------------------------------------------


def _parse_xml(data: bytes) -> ElementTree.Element:
    """Parse XML and return its root; refuse entities that could grow, and fetch none from outside."""
    builder = ElementTree.TreeBuilder()
    parser = expat.ParserCreate(namespace_separator="}")
    parser.buffer_text = True
    depth = parsed = 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth, parsed
        depth, parsed = depth + 1, parsed + 1
        require_at_most(MOST_PARSED, parsed, "elements or more")
        require_at_most(DEEPEST, depth, "groups in one another")
        builder.start(name, attributes)

    def end(name: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(name)

    def entity(name: str, _parameter: bool, value: str | None, *_rest: object) -> None:
        if value is not None and (len(value) > LONGEST_ENTITY or "&" in value or "%" in value):
            raise ValueError(f"its entity {name[:30]!r} holds others or is too long")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ValueError(str(error)) from error
    return builder.close()


def _tag(element: ElementTree.Element) -> str:
    """Return the name of an element without its namespace."""
    return element.tag.rpartition("}")[2]


# --- shapes ----------------------------------------------------------------------------------------------


class _Reader:
    """Visitor of the elements that converts shapes to lines and counts omissions."""

    def __init__(self, root: ElementTree.Element) -> None:
        self.root = root
        self.left_out: Counter[str] = Counter()
        self.visited = 0
        self.shapes: dict[ElementTree.Element, list[Line]] = {}
        self.by_name = {element.get("id"): element for element in root.iter() if element.get("id")}
        self.strokes = _inherit_strokes(root)
        self.page = self._page()
        x0, y0, x1, y1 = self.page or (0.0, 0.0, 0.0, 0.0)
        self.view = (x1 - x0, y1 - y0)  # lengths of 100 %

    def _page(self) -> Bounds | None:
        """Return the page in px, or None without a size."""
        box = self.root.get("viewBox")
        numbers = parse_numbers(box) if box else []
        box_width, box_height = numbers[2:] if len(numbers) == 4 else (0.0, 0.0)
        width = parse_length(self.root.get("width"), box_width, box_width)
        height = parse_length(self.root.get("height"), box_height, box_height)
        return (0.0, 0.0, width, height) if width > 0 and height > 0 else None

    def lines(self) -> Iterator[Line]:
        """Yield the lines in px of the page, y downwards."""
        matrix = IDENTITY
        if self.page:
            matrix = fit_view_box(self.root, self.page[2], self.page[3])
        box = self.root.get("viewBox")
        if box:
            self.view = (parse_numbers(box)[2], parse_numbers(box)[3])
        for child in self.root:
            yield from self._lines_of(child, matrix, 0)

    def _lines_of(self, element: ElementTree.Element, outer: Matrix, depth: int) -> Iterator[Line]:
        """Yield the lines of an element and its children."""
        tag, get = _tag(element), element.get
        style = f"{get('style', '')};display:{get('display', '')};visibility:{get('visibility', '')}"
        if tag in HIDDEN_TAGS or re.search(r"display:\s*none|visibility:\s*(hidden|collapse)", style):
            return
        if tag in OMITTED_TAGS:
            self.left_out[OMITTED_TAGS[tag]] += 1
            return
        if get("clip-path") or get("mask"):
            self.left_out["clip"] += 1
        self.visited += 1
        require_at_most(MOST_ELEMENTS, self.visited, "drawn elements or more, copies counted")
        if depth > DEEPEST:
            raise ValueError("a copy by `use` contains itself")
        matrix = compose(outer, parse_transform(get("transform")))
        width, height = self.view
        if tag in ("svg", "use", "symbol"):
            shift = np.array([[1, 0, parse_length(get("x"), width)], [0, 1, parse_length(get("y"), height)]])
            matrix = compose(matrix, shift)
        if tag == "svg":
            matrix = compose(matrix, self._nested_matrix(element, element))
        if tag == "use":
            yield from self._lines_of_copy(element, matrix, depth)
        elif tag in ("g", "svg", "a", "switch"):
            for child in element:
                yield from self._lines_of(child, matrix, depth + 1)
        else:
            if element not in self.shapes:  # copies share them
                self.shapes[element] = self._shape_lines(element, tag)
            for line in self.shapes[element]:
                yield line @ matrix[:, :2].T + matrix[:, 2]

    def _nested_matrix(self, element: ElementTree.Element, sized: ElementTree.Element) -> Matrix:
        """Return the matrix that fits the view box of `element` into the width and height that `sized` states."""
        width, height = (
            parse_length(sized.get(name), full_size, full_size)
            for name, full_size in zip(("width", "height"), self.view, strict=True)
        )
        return fit_view_box(element, width, height)

    def _lines_of_copy(self, element: ElementTree.Element, matrix: Matrix, depth: int) -> Iterator[Line]:
        """Yield the lines of the target of a `use` element."""
        name = element.get("href") or element.get("http://www.w3.org/1999/xlink}href") or ""
        target = self.by_name.get(name.removeprefix("#"))
        if target is None:
            self.left_out["broken link"] += 1
        elif _tag(target) == "symbol":
            matrix = compose(matrix, self._nested_matrix(target, element))
            for child in target:
                yield from self._lines_of(child, matrix, depth + 1)
        else:
            yield from self._lines_of(target, matrix, depth + 1)

    def _shape_lines(self, element: ElementTree.Element, tag: str) -> list[Line]:
        """Return the lines of a shape in its own coordinates; count a background rectangle as left out instead."""
        width, height = self.view
        mean = math.hypot(width, height) / math.sqrt(2)

        def length(name: str) -> float:
            """Return the length of an attribute, px; a percentage is that of the page along its axis."""
            full_size = {"x": width, "c": width, "w": width, "y": height, "h": height}.get(name[0], mean)
            return parse_length(element.get(name), height if name in ("cy", "ry") else full_size)

        match tag:
            case "path":
                return path_lines(element.get("d") or "")
            case "line":
                return [np.array([[length("x1"), length("y1")], [length("x2"), length("y2")]])]
            case "polyline" | "polygon":
                numbers = parse_numbers(element.get("points") or "")
                points = np.array(numbers[: len(numbers) // 2 * 2]).reshape(-1, 2)
                return [np.vstack([points, points[:1]]) if tag == "polygon" else points]
            case "circle":
                return ellipse_lines(length("cx"), length("cy"), length("r"), length("r"))
            case "ellipse":
                rx, ry = (element.get(name) for name in ("rx", "ry"))
                return ellipse_lines(
                    length("cx"), length("cy"), length("rx" if rx else "ry"), length("ry" if ry else "rx")
                )
            case "rect":
                if self._is_background(element, (length("x"), length("y"), length("width"), length("height"))):
                    self.left_out["background"] += 1
                    return []
                corner_rx, corner_ry = length("rx"), length("ry")
                return rectangle_lines(
                    length("x"),
                    length("y"),
                    length("width"),
                    length("height"),
                    corner_rx or corner_ry,
                    corner_ry or corner_rx,
                )
        return []

    def _is_background(self, element: ElementTree.Element, box: Bounds) -> bool:
        """Tell whether a rectangle without a stroke is as large as the page, and so its background."""
        full_size = self.page is not None and box[2] >= 0.999 * self.view[0] and box[3] >= 0.999 * self.view[1]
        return full_size and self.strokes[element] == "none"


def _inherit_strokes(root: ElementTree.Element) -> dict[ElementTree.Element, str]:
    """Return the stroke of every element: its own, or that of the element around it."""
    strokes = {root: _own_stroke(root) or "none"}
    for parent in root.iter():
        for child in parent:
            strokes[child] = _own_stroke(child) or strokes[parent]
    return strokes


def _own_stroke(element: ElementTree.Element) -> str | None:
    """Return the stroke that an element states, if any; its style takes precedence over its attribute."""
    styled = re.search(r"(?:^|[;\s])stroke:\s*([^;\s]+)", element.get("style", ""))
    stated = styled[1] if styled else element.get("stroke")
    return None if stated == "inherit" else stated
