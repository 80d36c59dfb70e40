"""The numbers of SVG: lengths in their units, transforms, and view boxes."""

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


def length_in_px(text: str | None, whole: float, otherwise: float = 0.0) -> float:
    """Return a length in user units (px); `whole` is what 100 % means."""
    if text is None or text.strip() in ("", "auto"):
        return otherwise
    found = re.fullmatch(rf"\s*({NUMBER})\s*([A-Za-z]*|%)\s*", text)
    if found and found[2] == "%":
        return float(found[1]) / 100 * whole
    if not found or found[2].lower() not in UNITS:
        raise ValueError(f"it gives the length {text[:30]!r}")
    return float(found[1]) * UNITS[found[2].lower()]


def numbers_in(text: str) -> list[float]:
    """Return the numbers of a text that holds nothing else, or raise ValueError."""
    if re.sub(r"[\s,]", "", re.sub(NUMBER, "", text)):
        raise ValueError(f"it gives {text.strip()[:30]!r} for numbers")
    return [float(each) for each in re.findall(NUMBER, text)]


@lru_cache(maxsize=10_000)
def matrix_of(text: str | None) -> Matrix:
    """Return the matrix of an attribute `transform`."""
    matrix = IDENTITY
    transforms = re.findall(r"(\w+)\s*\(([^)]*)\)", text or "")
    require_at_most(MOST_TRANSFORMS, len(transforms), "transforms of one element")
    for name, inside in transforms:
        numbers = numbers_in(inside)
        match name, numbers:
            case "matrix", [a, b, c, d, e, f]:
                each = [[a, c, e], [b, d, f]]
            case "translate", [x, *y] if len(y) < 2:
                each = [[1, 0, x], [0, 1, *(y or [0])]]
            case "scale", [x, *y] if len(y) < 2:
                each = [[x, 0, 0], [0, *(y or [x]), 0]]
            case "rotate", [angle, *centre] if len(centre) in (0, 2):
                cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                x, y0 = centre or (0.0, 0.0)
                each = [[cos, -sin, x - cos * x + sin * y0], [sin, cos, y0 - sin * x - cos * y0]]
            case "skewX", [angle]:
                each = [[1, math.tan(math.radians(angle)), 0], [0, 1, 0]]
            case "skewY", [angle]:
                each = [[1, 0, 0], [math.tan(math.radians(angle)), 1, 0]]
            case _:
                raise ValueError(f"it holds the transform {name}({inside[:30]})")
        matrix = chained(matrix, np.array(each, dtype=np.float64))
    return matrix


def chained(outer: Matrix, inner: Matrix) -> Matrix:
    """Return the matrix of the inner transform followed by the outer one, (2, 3)."""
    both: Matrix = outer[:, :2] @ inner
    both[:, 2] += outer[:, 2]
    return both


def fitted(element: ElementTree.Element, width: float, height: float) -> Matrix:
    """Return the matrix that puts the view box of an element into width × height."""
    box = element.get("viewBox")
    if not box:
        return IDENTITY
    numbers = numbers_in(box)
    if len(numbers) != 4 or min(numbers[2:]) <= 0:
        raise ValueError(f"it gives the view box {box[:40]!r}")
    x, y, wide, high = numbers
    across, up = width / wide, height / high
    how = element.get("preserveAspectRatio", "xMidYMid meet")
    if "none" not in how:
        across = up = max(across, up) if "slice" in how else min(across, up)
    left, top = width - wide * across, height - high * up
    left *= 0 if "xMin" in how else 1 if "xMax" in how else 0.5
    top *= 0 if "YMin" in how else 1 if "YMax" in how else 0.5
    return np.array([[across, 0, left - x * across], [0, up, top - y * up]])
