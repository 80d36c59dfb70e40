"""Numbers of SVG: lengths with units, transforms, and view boxes."""

from __future__ import annotations

import math
import re
from functools import lru_cache
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.drawing import require_at_most
from infill.drawings.svg_paths import NUMBER

Matrix = NDArray[np.float64]  # (2, 3)

PX = 25.4 / 96  # mm
UNITS = {"": 1.0, "px": 1.0, "pt": 4 / 3, "pc": 16.0, "mm": 1 / PX, "cm": 10 / PX, "q": 0.25 / PX, "in": 96.0}  # px
MOST_TRANSFORMS = 100  # one after another, of one element
IDENTITY = np.array([[1.0, 0, 0], [0, 1, 0]])


def parse_length(text: str | None, whole: float, otherwise: float = 0.0) -> float:
    """Convert a length to user units (px); `whole` is the length of 100 %."""
    if text is None or text.strip() in ("", "auto"):
        return otherwise
    match = re.fullmatch(rf"\s*({NUMBER})\s*([A-Za-z]*|%)\s*", text)
    if match and match[2] == "%":
        return float(match[1]) / 100 * whole
    if not match or match[2].lower() not in UNITS:
        raise ValueError(f"it gives the length {text[:30]!r}")
    return float(match[1]) * UNITS[match[2].lower()]


def parse_numbers(text: str) -> list[float]:
    """Parse a list of numbers, or raise ValueError for other content."""
    if re.sub(r"[\s,]", "", re.sub(NUMBER, "", text)):
        raise ValueError(f"it gives {text.strip()[:30]!r} for numbers")
    return [float(number) for number in re.findall(NUMBER, text)]


@lru_cache(maxsize=10_000)
def parse_transform(text: str | None) -> Matrix:
    """Parse an attribute `transform` to a matrix (2, 3); without one, it is the identity."""
    matrix = IDENTITY
    transforms = re.findall(r"(\w+)\s*\(([^)]*)\)", text or "")
    require_at_most(MOST_TRANSFORMS, len(transforms), "transforms of one element")
    for name, inside in transforms:
        numbers = parse_numbers(inside)
        match name, numbers:
            case "matrix", [a, b, c, d, e, f]:
                rows = [[a, c, e], [b, d, f]]
            case "translate", [x, *y] if len(y) < 2:
                rows = [[1, 0, x], [0, 1, *(y or [0])]]
            case "scale", [x, *y] if len(y) < 2:
                rows = [[x, 0, 0], [0, *(y or [x]), 0]]
            case "rotate", [angle, *centre] if len(centre) in (0, 2):
                cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                x, y0 = centre or (0.0, 0.0)
                rows = [[cos, -sin, x - cos * x + sin * y0], [sin, cos, y0 - sin * x - cos * y0]]
            case "skewX", [angle]:
                rows = [[1, math.tan(math.radians(angle)), 0], [0, 1, 0]]
            case "skewY", [angle]:
                rows = [[1, 0, 0], [math.tan(math.radians(angle)), 1, 0]]
            case _:
                raise ValueError(f"it holds the transform {name}({inside[:30]})")
        matrix = compose(matrix, np.array(rows, dtype=np.float64))
    return matrix


def compose(outer: Matrix, inner: Matrix) -> Matrix:
    """Return the matrix of the inner transform followed by the outer one, (2, 3)."""
    product: Matrix = outer[:, :2] @ inner
    product[:, 2] += outer[:, 2]
    return product


def fit_view_box(element: ElementTree.Element, width: float, height: float) -> Matrix:
    """Return the matrix that fits the view box of an element into width × height."""
    box = element.get("viewBox")
    if not box:
        return IDENTITY
    numbers = parse_numbers(box)
    if len(numbers) != 4 or min(numbers[2:]) <= 0:
        raise ValueError(f"it gives the view box {box[:40]!r}")
    x, y, box_width, box_height = numbers
    x_scale, y_scale = width / box_width, height / box_height
    aspect_rule = element.get("preserveAspectRatio", "xMidYMid meet")
    if "none" not in aspect_rule:
        x_scale = y_scale = max(x_scale, y_scale) if "slice" in aspect_rule else min(x_scale, y_scale)
    x_shift, y_shift = width - box_width * x_scale, height - box_height * y_scale
    x_shift *= 0 if "xMin" in aspect_rule else 1 if "xMax" in aspect_rule else 0.5
    y_shift *= 0 if "YMin" in aspect_rule else 1 if "YMax" in aspect_rule else 0.5
    return np.array([[x_scale, 0, x_shift - x * x_scale], [0, y_scale, y_shift - y * y_scale]])
