"""Path data of SVG: letters and numbers to points.

Curves become chords that turn by about `TURN_ANGLE`, so a chord lies within TURN²/8 of a radius from its curve.

Source: Scalable Vector Graphics (SVG) 2, chapter 9 (paths) and appendix B.2 (elliptical arcs), W3C 2018.
"""

from __future__ import annotations

import math
import re

import numpy as np

from infill.drawing import MOST_POINTS, Line, require_at_most
from infill.plain_numbers import plain_number

TURN_ANGLE = 0.03  # rad
LARGEST_NUMBER = 1e9
FEWEST_CHORDS = 4  # chords of a Bézier curve
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
SEPARATOR = r"[\s,]*"
NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
PIECE = re.compile(r"([MmLlHhVvCcSsQqTtAaZz])([^MmLlHhVvCcSsQqTtAaZz]*)")
# Flags of arcs need no blank after them: "a5 5 0 0110 0" ends in (10, 0).
ARC = re.compile(SEPARATOR.join([f"({NUMBER})"] * 3 + ["([01])"] * 2 + [f"({NUMBER})"] * 2))


def path_lines(data: str) -> list[Line]:
    """Return the lines of a path, (N, 2) each, in its units.

    Raises
    ------
    ValueError
        If the data are invalid: an unknown letter, or a wrong number of numbers.

    >>> [line.tolist() for line in path_lines("M0 0h2v1z m5,5 1-1")]
    [[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 0.0]], [[5.0, 5.0], [6.0, 4.0]]]
    """
    data = data.strip()
    pieces = PIECE.findall(data)
    if "".join(letter + rest for letter, rest in pieces) != data:
        raise ValueError(f"a path begins with {data[:20]!r}, not with a letter of a path")
    require_at_most(MOST_POINTS, len(pieces), "letters or more in a path")
    if pieces and pieces[0][0] not in "Mm":
        raise ValueError(f"a path begins with {pieces[0][0]!r}, not with M")
    pen = _Pen()
    for letter, rest in pieces:
        for number, row in enumerate(_number_rows(letter, rest)):
            # Further pairs after M are lines.
            command = {"M": "L", "m": "l"}.get(letter, letter) if number else letter
            pen.draw(command, row)
    pen.lift()
    return pen.lines


def _number_rows(letter: str, text: str) -> list[list[float]]:
    """Return the numbers of one letter, a row for each repetition."""
    numbers_per_row = NUMBERS[letter.upper()]
    pattern = ARC if letter in "Aa" else re.compile(NUMBER)
    if re.sub(r"[\s,]", "", pattern.sub("", text)):
        raise ValueError(f"a path holds {letter}{text.strip()[:30]!r}, which are not its numbers")
    if letter in "Aa":
        rows = [[float(number) for number in match] for match in ARC.findall(text)]
    else:
        numbers = [float(number) for number in pattern.findall(text)]
        if numbers_per_row == 0:
            rows = [[]] if not numbers else []
        elif len(numbers) % numbers_per_row:
            raise ValueError(f"a path gives {letter} {len(numbers)} numbers instead of {numbers_per_row} each time")
        else:
            rows = [numbers[i : i + numbers_per_row] for i in range(0, len(numbers), numbers_per_row)]
    require_at_most(MOST_POINTS, len(rows), "points or more in a path")
    if not rows:
        raise ValueError(f"a path gives {letter} a wrong number of numbers")
    if not all(abs(number) < LARGEST_NUMBER for row in rows for number in row):
        raise ValueError(f"a path holds a number beyond {plain_number(LARGEST_NUMBER, 6)}")
    return rows


class _Pen:
    """Position and lines of the pen."""

    def __init__(self) -> None:
        self.drawn = 0
        self.lines: list[Line] = []
        self.points: list[Line] = []
        self.here = self.start = np.zeros(2)
        self.handle: tuple[str, Line] | None = None  # the last control point, which S and T reflect

    def lift(self) -> None:
        """End the current line."""
        if len(self.points) > 1:
            self.lines.append(np.concatenate(self.points))
        self.points = []

    def draw(self, letter: str, numbers: list[float]) -> None:
        """Draw one segment of a path."""
        kind = letter.upper()
        origin = self.here if letter.islower() else np.zeros(2)
        handle, self.handle = self.handle, None
        if kind == "M":
            self.lift()
            self.here = self.start = np.array(numbers) + origin
            return
        if not self.points:
            self.points = [self.here[None]]
        if kind == "Z":
            segment = self.start[None]
        elif kind == "H":
            segment = np.array([[numbers[0] + origin[0], self.here[1]]])
        elif kind == "V":
            segment = np.array([[self.here[0], numbers[0] + origin[1]]])
        elif kind == "A":
            rx, ry, rotation, large, sweep = numbers[:5]
            end = np.array(numbers[5:]) + origin
            segment = arc_points(self.here, end, (rx, ry), math.radians(rotation), large=bool(large), sweep=bool(sweep))
        elif kind == "L":
            segment = np.array([numbers]) + origin
        else:
            controls = np.array(numbers).reshape(-1, 2) + origin
            if kind in "ST":
                same = handle is not None and handle[0] == {"S": "C", "T": "Q"}[kind]
                mirrored = 2 * self.here - handle[1] if same and handle is not None else self.here
                controls = np.vstack([mirrored, controls])
            segment = bezier_points(np.vstack([self.here, controls]))
            self.handle = ("C" if kind in "CS" else "Q", controls[-2])
        self.drawn += len(segment)
        require_at_most(MOST_POINTS, self.drawn, "points or more in a path")
        self.points.append(segment)
        self.here = segment[-1]
        if kind == "Z":
            self.lift()


def bezier_points(controls: Line) -> Line:
    """Return points of a Bézier curve with 3 or 4 control points, without the first.

    >>> bezier_points(np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]))[-1].tolist()
    [2.0, 0.0]
    """
    legs = np.diff(controls, axis=0)
    legs = legs[np.hypot(*legs.T) > 0]
    angles = np.arctan2(legs[:, 1], legs[:, 0])
    turning = np.abs((np.diff(angles) + math.pi) % (2 * math.pi) - math.pi).sum()
    count = FEWEST_CHORDS + math.ceil(2 * turning / TURN_ANGLE)  # twice, since its speed is not even
    t = np.linspace(0, 1, count + 1)[1:, None]
    points = np.repeat(controls[None], count, axis=0)
    while points.shape[1] > 1:  # de Casteljau
        points = points[:, :-1] + t[:, None] * (points[:, 1:] - points[:, :-1])
    curve: Line = points[:, 0]
    curve[-1] = controls[-1]
    return curve


def arc_points(start: Line, end: Line, radii: tuple[float, float], turned: float, *, large: bool, sweep: bool) -> Line:
    """Return points of an arc turned by `turned` radians, without the first (SVG 2, B.2.4; small radii grow, B.2.5)."""
    rx, ry = abs(radii[0]), abs(radii[1])
    if rx == 0 or ry == 0 or np.array_equal(start, end):
        return np.array([end])
    axes = np.array([[math.cos(turned), math.sin(turned)], [-math.sin(turned), math.cos(turned)]])
    half = axes @ (start - end) / 2 / (rx, ry)  # in a frame in which the ellipse is the unit circle
    squared_distance = float(half @ half)
    if squared_distance > 1:
        rx, ry, half = (
            rx * math.sqrt(squared_distance),
            ry * math.sqrt(squared_distance),
            half / math.sqrt(squared_distance),
        )
        squared_distance = 1.0
    factor = math.sqrt((1 - squared_distance) / squared_distance) * (-1 if large == sweep else 1)
    centre = factor * np.array([half[1], -half[0]])
    start_angle = math.atan2(*(half - centre)[::-1])
    end_angle = math.atan2(*(-half - centre)[::-1])
    swept = (end_angle - start_angle) % (2 * math.pi) if sweep else -((start_angle - end_angle) % (2 * math.pi))
    angles = start_angle + swept * np.linspace(0, 1, 1 + max(1, math.ceil(abs(swept) / TURN_ANGLE)))[1:]
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1) + centre
    points: Line = (circle * (rx, ry)) @ axes + (start + end) / 2
    points[-1] = end
    return points


def ellipse_lines(x: float, y: float, rx: float, ry: float) -> list[Line]:
    """Return the outline of an ellipse, or an empty list if a radius is not above 0."""
    if not (rx > 0 and ry > 0):
        return []
    angles = np.linspace(0, 2 * math.pi, 1 + math.ceil(2 * math.pi / TURN_ANGLE))
    points = np.stack([x + rx * np.cos(angles), y + ry * np.sin(angles)], axis=1)
    points[-1] = points[0]
    return [points]


def rectangle_lines(x: float, y: float, width: float, height: float, rx: float, ry: float) -> list[Line]:
    """Return the outline of a rectangle, clockwise, with rounded corners; empty if a side is not above 0."""
    if not (width > 0 and height > 0):
        return []
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    if rx <= 0 or ry <= 0:
        return [np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height], [x, y]])]
    corners = []
    for sx, sy in ((1, 0), (1, 1), (0, 1), (0, 0)):  # clockwise on the page, from the upper right
        corner = np.array([x + sx * width, y + sy * height])
        inward = np.array([rx if sx == 0 else -rx, 0.0]), np.array([0.0, ry if sy == 0 else -ry])
        begin, end = (corner + inward[0], corner + inward[1]) if sx != sy else (corner + inward[1], corner + inward[0])
        corners += [begin[None], arc_points(begin, end, (rx, ry), 0.0, large=False, sweep=True)]
    points = np.concatenate(corners)
    return [np.vstack([points, points[:1]])]
