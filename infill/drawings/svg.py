"""SVG: the outlines and strokes of its shapes, in mm and y upwards.

Read are paths, the basic shapes, groups, nested pages, symbols and copies by `use`, with their transforms, and the
size of the page in physical units. Lines have no width here, and colours do not matter; texts, pictures and the
shapes of clips, masks and fills are left out and counted. Style sheets are not read.

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

from infill.drawing import Bounds, Drawing, Line, checked_drawing, count_points, require_at_most
from infill.drawings.svg_numbers import IDENTITY, PX, Matrix, chained, fitted, length_in_px, matrix_of, numbers_in
from infill.drawings.svg_paths import ellipse_lines, path_lines, rectangle_lines
from infill.files.broken import told_broken

LARGEST_FILE = 20_000_000  # bytes
LONGEST_ENTITY = 256  # characters: names of namespaces, which some programs abbreviate
MOST_ELEMENTS = 100_000  # drawn, copies counted, which may copy copies
MOST_PARSED = 400_000  # elements of the file, drawn or not
DEEPEST = 100
HIDDEN = {"defs", "symbol", "clipPath", "mask", "pattern", "marker"}
LEFT_OUT = {"text": "text", "image": "picture", "foreignObject": "foreign object"}


def read_svg(path: Path) -> Drawing:
    """Return the drawing of an SVG file; see the module for what is read."""
    require_at_most(LARGEST_FILE, path.stat().st_size, "bytes")
    with told_broken(path, advice="save it again as plain SVG"), np.errstate(all="ignore"):
        root = _tree(path.read_bytes())
        if _tag(root) != "svg":
            raise ValueError(f"its root is {_tag(root)}, not svg")
        reader = _Reader(root)
        lines = list(count_points(reader.lines()))
    flip = np.array([1.0, -1.0])
    upright = [line * (PX, PX) * flip + (0, reader.page[3] * PX if reader.page else 0) for line in lines]
    page = None
    if reader.page:
        x0, y0, x1, y1 = (each * PX for each in reader.page)
        page = (x0, y1 - y1, x1, y1 - y0)
    return checked_drawing(path, upright, page=page, left_out=dict(reader.left_out))


# --- XML -------------------------------------------------------------------------------------------------


def _tree(data: bytes) -> ElementTree.Element:
    """Return the root; entities that could grow are refused, and none is fetched from outside."""
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
    return element.tag.rpartition("}")[2]


# --- shapes ----------------------------------------------------------------------------------------------


class _Reader:
    """Goes through the elements, and counts what it leaves out."""

    def __init__(self, root: ElementTree.Element) -> None:
        self.root = root
        self.left_out: Counter[str] = Counter()
        self.visited = 0
        self.shapes: dict[ElementTree.Element, list[Line]] = {}
        self.by_name = {each.get("id"): each for each in root.iter() if each.get("id")}
        self.page = self._page()
        x0, y0, x1, y1 = self.page or (0.0, 0.0, 0.0, 0.0)
        self.view = (x1 - x0, y1 - y0)  # what 100 % means

    def _page(self) -> Bounds | None:
        box = self.root.get("viewBox")
        numbers = numbers_in(box) if box else []
        wide, high = numbers[2:] if len(numbers) == 4 else (0.0, 0.0)
        width = length_in_px(self.root.get("width"), wide, wide)
        height = length_in_px(self.root.get("height"), high, high)
        return (0.0, 0.0, width, height) if width > 0 and height > 0 else None

    def lines(self) -> Iterator[Line]:
        """Yield the lines in px of the page, y downwards."""
        matrix = IDENTITY
        if self.page:
            matrix = fitted(self.root, self.page[2], self.page[3])
        box = self.root.get("viewBox")
        if box:
            self.view = (numbers_in(box)[2], numbers_in(box)[3])
        for each in self.root:
            yield from self._inside(each, matrix, 0)

    def _inside(self, element: ElementTree.Element, outer: Matrix, depth: int) -> Iterator[Line]:
        tag, get = _tag(element), element.get
        style = f"{get('style', '')};display:{get('display', '')};visibility:{get('visibility', '')}"
        if tag in HIDDEN or re.search(r"display:\s*none|visibility:\s*(hidden|collapse)", style):
            return
        if tag in LEFT_OUT:
            self.left_out[LEFT_OUT[tag]] += 1
            return
        if get("clip-path") or get("mask"):
            self.left_out["clip"] += 1
        self.visited += 1
        require_at_most(MOST_ELEMENTS, self.visited, "drawn elements or more, copies counted")
        if depth > DEEPEST:
            raise ValueError("a copy by `use` contains itself")
        matrix = chained(outer, matrix_of(get("transform")))
        width, height = self.view
        if tag in ("svg", "use", "symbol"):
            place = np.array([[1, 0, length_in_px(get("x"), width)], [0, 1, length_in_px(get("y"), height)]])
            matrix = chained(matrix, place)
        if tag == "svg":
            matrix = chained(matrix, self._nested(element, element))
        if tag == "use":
            yield from self._copied(element, matrix, depth)
        elif tag in ("g", "svg", "a", "switch"):
            for each in element:
                yield from self._inside(each, matrix, depth + 1)
        else:
            if element not in self.shapes:  # which copies share
                self.shapes[element] = self._shape(element, tag)
            for line in self.shapes[element]:
                yield line @ matrix[:, :2].T + matrix[:, 2]

    def _nested(self, element: ElementTree.Element, sized: ElementTree.Element) -> Matrix:
        width, height = (
            length_in_px(sized.get(name), whole, whole)
            for name, whole in zip(("width", "height"), self.view, strict=True)
        )
        return fitted(element, width, height)

    def _copied(self, element: ElementTree.Element, matrix: Matrix, depth: int) -> Iterator[Line]:
        name = element.get("href") or element.get("http://www.w3.org/1999/xlink}href") or ""
        target = self.by_name.get(name.removeprefix("#"))
        if target is None:
            self.left_out["broken link"] += 1
        elif _tag(target) == "symbol":
            matrix = chained(matrix, self._nested(target, element))
            for each in target:
                yield from self._inside(each, matrix, depth + 1)
        else:
            yield from self._inside(target, matrix, depth + 1)

    def _shape(self, element: ElementTree.Element, tag: str) -> list[Line]:
        width, height = self.view
        mean = math.hypot(width, height) / math.sqrt(2)

        def get(name: str) -> float:
            whole = {"x": width, "c": width, "w": width, "y": height, "h": height}.get(name[0], mean)
            return length_in_px(element.get(name), height if name in ("cy", "ry") else whole)

        match tag:
            case "path":
                return path_lines(element.get("d") or "")
            case "line":
                return [np.array([[get("x1"), get("y1")], [get("x2"), get("y2")]])]
            case "polyline" | "polygon":
                numbers = numbers_in(element.get("points") or "")
                points = np.array(numbers[: len(numbers) // 2 * 2]).reshape(-1, 2)
                return [np.vstack([points, points[:1]]) if tag == "polygon" else points]
            case "circle":
                return ellipse_lines(get("cx"), get("cy"), get("r"), get("r"))
            case "ellipse":
                rx, ry = (element.get(name) for name in ("rx", "ry"))
                return ellipse_lines(get("cx"), get("cy"), get("rx" if rx else "ry"), get("ry" if ry else "rx"))
            case "rect":
                if self._is_ground(element, (get("x"), get("y"), get("width"), get("height"))):
                    self.left_out["background"] += 1
                    return []
                across, up = get("rx"), get("ry")
                return rectangle_lines(get("x"), get("y"), get("width"), get("height"), across or up, up or across)
        return []

    def _is_ground(self, element: ElementTree.Element, box: Bounds) -> bool:
        """Return whether a rectangle is the ground of the page: filled, without a stroke, and covering it."""
        stroke = re.search(r"stroke:\s*(\w+)", element.get("style", ""))
        stroked = (stroke[1] if stroke else element.get("stroke", "none")) != "none"
        return (
            not stroked and self.page is not None and box[2] >= 0.999 * self.view[0] and box[3] >= 0.999 * self.view[1]
        )
