"""Arcs for segments, and segments for arcs: a plain arc fitter, as post-processors have one, and its opposite."""

from __future__ import annotations

import math
import re
from itertools import pairwise

from tests.gcode_judge import arc as judge_arc
from tests.gcode_judge import words

TOLERANCE = 0.04  # mm from the old path
RATE = 0.05  # by which the filament per mm may vary in an arc
LARGEST = 200.0  # mm, of a radius
BEAD = re.compile(rb"G1 X(-?[\d.]+) Y(-?[\d.]+) E(-?[\d.]+)\s*$")
Point = tuple[float, float]


def fit_arcs(text: bytes) -> bytes:
    """Return a print with arcs in place of lines."""
    relative = b"\nM82" not in text
    out: list[bytes] = []
    run: list[tuple[Point, float, bytes]] = []
    place: Point | None = None
    counter = 0.0
    for line in text.split(b"\n"):
        found = BEAD.match(line)
        if found and place is not None and not (relative and float(found[3]) <= 0):
            if not run:
                run = [(place, counter, b"")]
            place, counter = (float(found[1]), float(found[2])), float(found[3])
            run.append((place, counter, line))
            continue
        out += _fitted(run, relative=relative)
        run = []
        out.append(line)
        words = line.split(b";")[0]
        if words.startswith((b"M82", b"M83")):
            relative = words.startswith(b"M83")
        for letter in (b"X", b"Y", b"E"):
            value = re.search(letter + rb"(-?[\d.]+)", words)
            if not value or not re.match(rb"G[0-3] |G92 ", words):
                continue
            if letter == b"E":
                counter = float(value[1])
            elif letter == b"X":
                place = (float(value[1]), place[1] if place else 0.0)
            else:
                place = (place[0] if place else 0.0, float(value[1]))
    return b"\n".join(out + _fitted(run, relative=relative))


def _fitted(run: list[tuple[Point, float, bytes]], *, relative: bool) -> list[bytes]:
    """Return the lines of a run, with arcs where three beads or more lie on one."""
    points = [point for point, _, _ in run]
    pushed = [e if relative else e - before for (_, before, _), (_, e, _) in pairwise(run)]
    rates = [e / max(math.dist(*ends), 1e-9) for e, ends in zip(pushed, pairwise(points), strict=True)]
    out, i = [], 0
    while i < len(run) - 1:
        best = None
        for j in range(i + 3, len(run)):
            alike = abs(rates[j - 1] - rates[i]) <= RATE * abs(rates[i])
            arc = _arc(points[i : j + 1]) if alike else None
            if arc is None:
                break
            best = j, arc
        if best is None:
            out.append(run[i + 1][2])
            i += 1
            continue
        j, (centre, clockwise) = best
        e = sum(pushed[i:j]) if relative else run[j][1]
        offset = centre[0] - points[i][0], centre[1] - points[i][1]
        words = (b"G2" if clockwise else b"G3", *points[j], *offset, e)
        out.append(b"%s X%.3f Y%.3f I%.3f J%.3f E%.5f" % words)
        i = j
    return out


def _arc(points: list[Point]) -> tuple[Point, bool] | None:
    """Return centre and direction of the arc along points, None if they lie on none."""
    (ax, ay), (bx, by), (cx, cy) = points[0], points[len(points) // 2], points[-1]
    twice = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by))
    if abs(twice) < 1e-6:
        return None
    a, b, c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    x = (a * (by - cy) + b * (cy - ay) + c * (ay - by)) / twice
    y = (a * (cx - bx) + b * (ax - cx) + c * (bx - ax)) / twice
    radius = math.dist((ax, ay), (x, y))
    angles = [math.atan2(py - y, px - x) for px, py in points]
    steps = [(after - before + math.pi) % (2 * math.pi) - math.pi for before, after in pairwise(angles)]
    turns = all(step > 0 for step in steps) or all(step < 0 for step in steps)
    if radius > LARGEST or not turns or abs(sum(steps)) > 6:
        return None
    for (px, py), (qx, qy) in pairwise(points):
        apart = abs(math.dist((qx, qy), (x, y)) - radius), radius - math.dist(((px + qx) / 2, (py + qy) / 2), (x, y))
        if max(apart) > TOLERANCE:
            return None
    return (x, y), sum(steps) < 0


def straightened(data: bytes) -> bytes:
    """Return a print with relative filament in which chords stand for its arcs, as the judge cuts them."""
    lines, x, y = [], 0.0, 0.0
    for raw in data.splitlines(keepends=True):
        given = dict(words(raw.split(b";")[0])) if raw[:1] == b"G" else {}
        code = raw[:3].strip()
        goal = (given.get("X", x) or 0.0, given.get("Y", y) or 0.0) if code in (b"G0", b"G1", b"G2", b"G3") else (x, y)
        if code in (b"G2", b"G3") and "E" in given:
            points = judge_arc((x, y), goal, given, clockwise=code == b"G2")
            keep = [*points[1:-1:6], points[-1]]
            lengths = [math.dist(a, b) for a, b in zip([points[0], *keep], keep, strict=False)]
            for (px, py), length in zip(keep, lengths, strict=True):
                share = given["E"] * length / sum(lengths)
                feed = b" F%g" % given["F"] if "F" in given and (px, py) == keep[0] else b""
                lines.append(b"G1 X%.3f Y%.3f E%.5f%s\n" % (px, py, share, feed))
        else:
            lines.append(raw)
        x, y = goal
    return b"".join(lines)


def drawn_arcs(moves_of: bytes) -> tuple[int, int]:
    """Count the arcs and all moves that print in the sparse infill."""
    arcs = moves = 0
    inside = False
    for line in moves_of.split(b"\n"):
        if line.startswith((b";TYPE:", b"; FEATURE:")):
            inside = b"nternal infill" in line or b"Sparse infill" in line
        elif inside and re.match(rb"G[123] .*[XY].*E[\d.]", line):
            moves += 1
            arcs += line.startswith((b"G2", b"G3"))
    return arcs, moves
