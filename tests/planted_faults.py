"""Faults of post-processors, planted in a print one at a time, each with the line on which it lies.

Nothing here comes from the package: lines are read by regular expressions, and a fault changes, drops or adds lines.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

ROLE = re.compile(rb";\s*(?:TYPE|FEATURE):\s*(.*?)\s*$")
LAYER = re.compile(rb"(;LAYER_CHANGE|; ?CHANGE_LAYER|;LAYER:)")
WALLS = (b"External perimeter", b"Perimeter", b"Outer wall", b"Inner wall", b"WALL-OUTER", b"WALL-INNER")
BEAD = re.compile(rb"(N\d+ )?G1 ?(?:F[\d.]+ ?)?X([-\d.]+) ?Y([-\d.]+) ?E([-\d.]+)")


@dataclass(frozen=True)
class Planted:
    """A print with a fault: its lines, and the number of the faulty one; of lines that were dropped, of the next one."""

    lines: list[bytes]
    line: int


@dataclass(frozen=True)
class Place:
    """Where a line stands."""

    layer: int
    role: bytes


def places(lines: list[bytes]) -> list[Place]:
    """Return the layer and the feature of each line."""
    layer, role, result = 0, b"", []
    for line in lines:
        if LAYER.match(line):
            layer += 1
        elif found := ROLE.match(line):
            role = found[1]
        result.append(Place(layer, role))
    return result


def wall_beads(lines: list[bytes], share: float = 0.5) -> list[int]:
    """Return two beads of a wall in a row, in a layer at a share of the height, and what follows."""
    where = places(lines)
    target = max(1, round(where[-1].layer * share))
    beads = [i for i, line in enumerate(lines) if where[i].role in WALLS and BEAD.match(line)]
    for layer in range(target, where[-1].layer + 1):
        of_layer = [i for i in beads if where[i].layer == layer]
        runs = [(a, b, c) for a, b, c in zip(of_layer, of_layer[1:], of_layer[2:], strict=False) if c == a + 2]
        if runs:
            return list(runs[0])
    raise AssertionError("no bead of a wall")


def next_bead(planted: Planted) -> int:
    """Return the number of the first line that lays filament, from the faulty one on."""
    lines = planted.lines
    return next((i + 1 for i in range(planted.line - 1, len(lines)) if BEAD.match(lines[i])), len(lines))


def number(line: bytes, letter: bytes) -> float:
    found = re.search(rb"(?<=" + letter + rb")[-\d.]+", line)
    assert found, (line, letter)
    return float(found[0])


def with_number(line: bytes, letter: bytes, text: bytes) -> bytes:
    return re.sub(rb"(?<=" + letter + rb")[-\d.]+", text, line, count=1)


def changed(lines: list[bytes], index: int, *new: bytes) -> Planted:
    """Put new lines in the place of one."""
    end = re.search(rb"[\r\n]*$", lines[index])
    assert end
    fresh = [line.rstrip(b"\r\n") + (end[0] or b"\n") for line in new]
    return Planted([*lines[:index], *fresh, *lines[index + 1 :]], index + 1)


def is_absolute(lines: list[bytes]) -> bool:
    return any(line.startswith(b"M82") for line in lines) and not any(line.startswith(b"M83") for line in lines)


def move_bead(lines: list[bytes]) -> Planted:
    i = wall_beads(lines)[1]
    return changed(lines, i, with_number(lines[i], b"X", b"%.3f" % (number(lines[i], b"X") + 0.4)))


def drop_bead(lines: list[bytes]) -> Planted:
    """Drop a corner of a wall."""
    for share in (0.3, 0.5, 0.7):
        a, b, c = wall_beads(lines, share)
        points = [(number(lines[i], b"X"), number(lines[i], b"Y")) for i in (a, b, c)]
        (x0, y0), (x1, y1), (x2, y2) = points
        if abs((x1 - x0) * (y2 - y1) - (y1 - y0) * (x2 - x1)) > 0.5:
            return changed(lines, b)
    raise AssertionError("no corner")


def drop_layer(lines: list[bytes]) -> Planted:
    where = places(lines)
    middle = where[-1].layer // 2
    inside = [i for i, place in enumerate(where) if place.layer == middle]
    return Planted([*lines[: inside[0]], *lines[inside[-1] + 1 :]], inside[0] + 1)


def raise_layer(lines: list[bytes]) -> Planted:
    """Raise the walls of a layer: its Z by half a layer."""
    a = wall_beads(lines)[0]
    i = next(i for i in range(a, 0, -1) if re.match(rb"(N\d+ )?G[01] ?.*Z", lines[i]))
    return changed(lines, i, with_number(lines[i], b"Z", b"%.3f" % (number(lines[i], b"Z") + 0.1)))


def more_filament(lines: list[bytes]) -> Planted:
    a, b, _ = wall_beads(lines)
    e = number(lines[b], b"E")
    e += 0.3 * (e - number(lines[a], b"E") if is_absolute(lines) else e)
    return changed(lines, b, with_number(lines[b], b"E", b"%.5f" % e))


def jump_filament(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    return changed(lines, b, with_number(lines[b], b"E", b"%.5f" % (number(lines[b], b"E") + 40)))


def lose_reset(lines: list[bytes]) -> Planted:
    """Set the counter of filament where nothing asks for it."""
    b = wall_beads(lines)[1]
    return changed(lines, b, b"G92 E0" if is_absolute(lines) else b"G92 E5", lines[b])


def before_walls(text: bytes, share: float = 0.5) -> Callable[[list[bytes]], Planted]:
    def plant(lines: list[bytes]) -> Planted:
        b = wall_beads(lines, share)[1]
        return changed(lines, b, text, lines[b])

    return plant


def drop_line(pattern: bytes, *, last: bool = False) -> Callable[[list[bytes]], Planted]:
    """Drop a line of a kind, in the second half of the print or the last."""

    def plant(lines: list[bytes]) -> Planted:
        where = places(lines)
        fitting = [i for i, line in enumerate(lines) if re.match(pattern, line)]
        assert fitting, "no such line"
        late = [i for i in fitting if where[i].layer > where[-1].layer // 2]
        i = fitting[-1] if last or not late else late[0]
        return changed(lines, i)

    return plant


def drop_prime(lines: list[bytes]) -> Planted:
    """Drop the move or command that primes the nozzle before a wall."""
    a = wall_beads(lines)[0]
    i = next(i for i in range(a, 0, -1) if re.match(rb"(N\d+ )?(G1 ?(F[\d.]+ ?)?E[\d.]|G11)", lines[i]))
    return changed(lines, i)


def drop_retraction(lines: list[bytes]) -> Planted:
    """Drop a retraction that is primed later."""
    a = wall_beads(lines)[0]
    i = next(i for i in range(a, 0, -1) if re.match(rb"(N\d+ )?(G1 ?(F[\d.]+ ?)?E-|G10)", lines[i]))
    return changed(lines, i)


def faster(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    line = re.sub(rb" ?F[\d.]+", b"", lines[b].rstrip(b"\r\n").split(b" ;")[0])
    return changed(lines, b, line + b" F12000")


def zero_feed(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    line = re.sub(rb" ?F[\d.]+", b"", lines[b].rstrip(b"\r\n").split(b" ;")[0])
    return changed(lines, b, line + b" F0")


def not_a_number(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    return changed(lines, b, with_number(lines[b], b"X", b"NaN"))


def exponent(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    return changed(lines, b, with_number(lines[b], b"E", b"1.2e-05"))


def add_bead(lines: list[bytes]) -> Planted:
    b = wall_beads(lines)[1]
    x, y = number(lines[b], b"X"), number(lines[b], b"Y")
    e = number(lines[b], b"E")
    words = [lines[b].rstrip(b"\r\n").split(b" ;")[0]]
    for k, (dx, dy) in enumerate(((3, 3), (0, 0)), 1):
        amount = e + 0.05 * k if is_absolute(lines) else 0.05
        words.append(b"G1 X%.3f Y%.3f E%.5f" % (x + dx, y + dy, amount))
    if is_absolute(lines):
        words.append(b"G92 E%.5f" % e)
    planted = changed(lines, b, *words)
    return Planted(planted.lines, planted.line + 1)


def no_wait(lines: list[bytes]) -> Planted:
    """Heat the nozzle without waiting for it."""
    i = next(i for i, line in enumerate(lines) if line.startswith(b"M109"))
    return changed(lines, i, lines[i].replace(b"M109", b"M104"))


def print_twice(lines: list[bytes]) -> Planted:
    """Go back along a bead of a wall and print it again."""
    a, b, _ = wall_beads(lines)
    x, y = number(lines[a], b"X"), number(lines[a], b"Y")
    bare = re.sub(rb" ?F[\d.]+", b"", lines[b].rstrip(b"\r\n").split(b" ;")[0])
    words = [lines[b].rstrip(b"\r\n").split(b" ;")[0], b"G1 X%.3f Y%.3f" % (x, y)]
    if is_absolute(lines):
        words.append(b"G92 E%.5f" % number(lines[a], b"E"))
    planted = changed(lines, b, *words, bare)
    return Planted(planted.lines, planted.line + 1)


def uneven_bead(lines: list[bytes]) -> Planted:
    """Print a bead of a wall in two halves, of which one has less filament, and the other what it lacks."""
    a, b, _ = wall_beads(lines)
    x0, y0, before = (number(lines[a], letter) for letter in (b"X", b"Y", b"E"))
    x1, y1, pushed = (number(lines[b], letter) for letter in (b"X", b"Y", b"E"))
    thin = before + 0.3 * (pushed - before) if is_absolute(lines) else 0.3 * pushed
    rest = pushed if is_absolute(lines) else pushed - thin
    first = b"G1 X%.3f Y%.3f E%.5f" % ((x0 + x1) / 2, (y0 + y1) / 2, thin)
    return changed(lines, b, first, b"G1 X%.3f Y%.3f E%.5f" % (x1, y1, rest))


FAULTS: dict[str, tuple[str, Callable[[list[bytes]], Planted]]] = {
    "a bead moved": ("place", move_bead),
    "a corner dropped": ("place", drop_bead),
    "a layer dropped": ("missing", drop_layer),
    "a layer raised": ("height", raise_layer),
    "more filament": ("material", more_filament),
    "an uneven bead": ("material", uneven_bead),
    "a jump of E": ("E jump", jump_filament),
    "a hotter nozzle": ("temperature", before_walls(b"M104 S245")),
    "a cold bed": ("temperature", before_walls(b"M140 S0")),
    "a slower fan": ("fan", before_walls(b"M106 S90", 0.8)),
    "no fan": ("fan", before_walls(b"M107", 0.8)),
    "another acceleration": ("acceleration", before_walls(b"M204 S7777")),
    "another jerk": ("acceleration", before_walls(b"M205 X33 Y33")),
    "another pressure advance": ("pressure advance", before_walls(b"M900 K0.77")),
    "another pressure advance in Klipper": ("pressure advance", before_walls(b"SET_PRESSURE_ADVANCE ADVANCE=0.5")),
    "no priming": ("retraction", drop_prime),
    "no retraction": ("retraction", drop_retraction),
    "another tool": ("tool", before_walls(b"T3")),
    "a faster bead": ("speed", faster),
    "all faster": ("speed", before_walls(b"M220 S180")),
    "more flow": ("material", before_walls(b"M221 S110")),
    "F0": ("F0", zero_feed),
    "a word that is not a number": ("number", not_a_number),
    "an exponent": ("unreadable", exponent),
    "a spline": ("unreadable", before_walls(b"G5 X1 Y2 I1 J1")),
    "a pause": ("command", before_walls(b"M600")),
    "no wait for the nozzle": ("command", no_wait),
    "a bead printed twice": ("added", print_twice),
    "a macro": ("command", before_walls(b"CLEAN_NOZZLE TIMES=3")),
    "a bead added": ("added", add_bead),
}


def crosses_bead(
    lines: list[bytes], where: list[Place], travel: int, start: tuple[float, float], end: tuple[float, float]
) -> bool:
    """Tell whether the middle of a travel crosses an earlier bead of its layer."""
    inner = [tuple(a + share * (b - a) for a, b in zip(start, end, strict=True)) for share in (0.2, 0.8)]
    place = None
    for i in range(travel):
        found = re.match(rb"(N\d+ )?G[01] ?(?:F[\d.]+ ?)?X([-\d.]+) ?Y([-\d.]+)", lines[i])
        if not found:
            continue
        at = float(found[2]), float(found[3])
        if place and where[i].layer == where[travel].layer and BEAD.match(lines[i]) and intersect(*inner, place, at):
            return True
        place = at
    return False


def intersect(a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...], d: tuple[float, ...]) -> bool:
    def side(p: tuple[float, ...], q: tuple[float, ...], r: tuple[float, ...]) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def drop_lift(lines: list[bytes]) -> Planted:
    """Drop the lift before the longest travel of the upper half that has one."""
    where = places(lines)
    best, at = 0.0, None
    place = (0.0, 0.0)
    for i, line in enumerate(lines):
        found = re.match(rb"(N\d+ )?G[01] ?(?:F[\d.]+ ?)?X([-\d.]+) ?Y([-\d.]+)", line)
        if not found:
            continue
        x, y = float(found[2]), float(found[3])
        length = max(abs(x - place[0]), abs(y - place[1]))
        if (
            0 < where[i].layer > where[-1].layer // 2
            and b"E" not in line
            and re.match(rb"(N\d+ )?G[01] ?Z[\d.]+", lines[i - 1])
            and re.match(rb"(N\d+ )?G[01] ?Z[\d.]+", lines[i + 1])
            and length > best
            and crosses_bead(lines, where, i, place, (x, y))
        ):
            best, at = length, i
        place = x, y
    assert at is not None, "no travel with a lift"
    return Planted([*lines[: at - 1], *lines[at:]], at)


def drop_object(lines: list[bytes]) -> Planted:
    """Drop what stands between the labels of the last object, in every layer."""
    begin = re.compile(
        rb"(M486 S1\b|EXCLUDE_OBJECT_START NAME=\S*_1\b|; start printing object, unique label id: 16|M624)"
    )
    ends = re.compile(rb"(M486 S-1|EXCLUDE_OBJECT_END|; stop printing object)")
    kept, inside, first = [], False, 0
    for line in lines:
        if begin.match(line) and (not line.startswith(b"M624") or inside):
            inside = True
            first = first or len(kept) + 1
        if not inside:
            kept.append(line)
        if ends.match(line) and inside:
            inside = False
            kept.append(line)
    assert first, "no labels of objects"
    return Planted(kept, first)


def infill_beads(lines: list[bytes], share: float = 0.5) -> list[int]:
    """Return the beads of the infill in a layer at a share of the height or above."""
    where = places(lines)
    target = max(1, round(where[-1].layer * share))
    beads = [
        i
        for i, line in enumerate(lines)
        if where[i].role in (b"Internal infill", b"Sparse infill", b"FILL") and BEAD.match(line) and b"E-" not in line
    ]
    layer = min(where[i].layer for i in beads if where[i].layer >= target)
    return [i for i in beads if where[i].layer == layer]


def in_infill(*new: bytes) -> Callable[[list[bytes]], Planted]:
    """Put lines before a bead of the infill; `%b` stands for the bead without its feed rate."""

    def plant(lines: list[bytes]) -> Planted:
        i = infill_beads(lines)[3]
        bare = re.sub(rb" ?F[\d.]+", b"", lines[i].rstrip(b"\r\n").split(b" ;")[0])
        with_bead = [text.replace(b"%b", bare) for text in new]
        if not any(b"%b" in text for text in new):
            with_bead.append(lines[i])
        return changed(lines, i, *with_bead)

    return plant


def jump_in_infill(lines: list[bytes]) -> Planted:
    i = infill_beads(lines)[3]
    return changed(lines, i, with_number(lines[i], b"E", b"%.5f" % (number(lines[i], b"E") + 40)))


def stray_in_infill(lines: list[bytes]) -> Planted:
    i = infill_beads(lines)[3]
    return changed(lines, i, with_number(lines[i], b"X", b"%.3f" % (number(lines[i], b"X") + 60)))


def drop_infill(lines: list[bytes]) -> Planted:
    """Drop all infill of a layer but a line."""
    beads = infill_beads(lines)
    gone = set(beads[1:])
    return Planted([line for i, line in enumerate(lines) if i not in gone], beads[0] + 1)


FAULTS["no lift"] = ("travel", drop_lift)
FAULTS_OF_LABELS: dict[str, tuple[str, Callable[[list[bytes]], Planted]]] = {
    "an object dropped": ("missing", drop_object),
    "a label dropped": ("object", drop_line(rb"(M486 S\d|EXCLUDE_OBJECT_START|M624)")),
}
# In the infill of a print that was refilled, where paths are free.
FAULTS_OF_INFILL: dict[str, tuple[str, Callable[[list[bytes]], Planted]]] = {
    "a jump of E in the infill": ("E jump", jump_in_infill),
    "a bead outside of the part": ("place", stray_in_infill),
    "faster infill": ("speed", in_infill(b"%b F19000")),
    "F0 in the infill": ("F0", in_infill(b"%b F0")),
    "hotter infill": ("temperature", in_infill(b"M104 S240")),
    "retracted infill": ("retraction", in_infill(b"G91", b"G1 E-1.5", b"G90")),
    "infill at another height": ("height", in_infill(b"G91", b"G1 Z.15", b"G90")),
    "infill dropped": ("material", drop_infill),
    "infill with NaN": ("number", in_infill(b"G1 XNaN Y5")),
}
