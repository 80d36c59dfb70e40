"""Sections of infill as wholes: what stands between the first and the last move of each, and new paths in its place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.gcode.lines import ARC, MOVE, ODD, Command
from infill.gcode.numbers import write_words
from infill.gcode.sections import FILAMENT_UNIT, Marks, Strokes
from infill.gcode.splicing import Spliced
from infill.gcode.table import Table, firmware_retraction

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LEAST_STEP = 1e-6  # mm
ALIKE = 0.03  # strokes of one section that are drawn anew extrude alike to this share
# What a machine is told on the way, and may as well be told at the end of a section.
HARMLESS = {"M73", "M117", "M118", "M106", "M107", "M204", "M205", "M900", "M572", "M70", "G10", "G11"}
HARMLESS_WORDS = {"SET_VELOCITY_LIMIT", "SET_PRESSURE_ADVANCE"}


@dataclass(frozen=True, kw_only=True)
class Body:
    """What stands between the first and the last move of a section, inclusive.

    Parameters
    ----------
    section : int
    first, last : int
        Lines of the table.
    strokes : (S,) int
        Its strokes.
    start, end : (2,) float64, mm
        Where the nozzle is before the first move, and where it must be in the end.
    z : float, mm
    layer : int
    rate : float
        mm of filament per mm.
    filament, length : float, mm
        Of all strokes.
    feed, feed_after : float, mm/min
        Of the moves, and in force at the end.
    """

    section: int
    first: int
    last: int
    strokes: Places
    start: Floats
    end: Floats
    z: float
    layer: int
    rate: float
    filament: float
    length: float
    feed: float
    feed_after: float


def bodies(table: Table, marks: Marks, infill: Strokes) -> tuple[list[Body], dict[str, list[int]]]:
    """Return the sections that can be drawn anew, and which cannot, by reason."""
    found: list[Body] = []
    odd: dict[str, list[int]] = {}
    opens, closes = infill.opens, infill.closes
    section = marks.section[opens]
    commands = {command.line: command for command in table.commands}
    for number in np.unique(section):
        some = np.flatnonzero(section == number)
        reason = _oddness(table, marks, infill, some, int(opens[some[0]]), int(closes[some[-1]]), commands)
        if reason:
            odd.setdefault(reason, []).append(int(number))
            continue
        length, filament = infill.length[some], infill.filament[some]
        feeds, which = np.unique(table.f[opens[some]], return_inverse=True)
        last = int(closes[some[-1]])
        found.append(
            Body(
                section=int(number),
                first=int(opens[some[0]]),
                last=last,
                strokes=some,
                start=infill.points[infill.first[some[0]]],
                end=infill.points[infill.first[some[-1] + 1] - 1],
                z=float(table.z[opens[some[0]]]),
                layer=int(marks.layer[opens[some[0]]]),
                rate=float(filament.sum() / length.sum()),
                filament=float(filament.sum()),
                length=float(length.sum()),
                feed=float(feeds[np.argmax(np.bincount(which, length))]),
                feed_after=float(table.f[last]),
            )
        )
    return found, odd


def _oddness(
    table: Table,
    marks: Marks,
    infill: Strokes,
    some: Places,
    first: int,
    last: int,
    commands: dict[int, Command],
) -> str:
    """Say why a section cannot be drawn anew; nothing if it can."""
    inside = slice(first, last + 1)
    kinds = table.kind[inside]
    if (kinds == ODD).any():
        return "a line that cannot be read"
    if (kinds == ARC).any():
        return "arcs"
    if table.numbered[inside].any():
        return "line numbers"
    rate = infill.filament[some] / infill.length[some]
    if np.ptp(rate) > ALIKE * rate.mean():
        long = infill.length[some] > 2.0
        if np.ptp(rate[long] if long.any() else rate) > ALIKE * rate.mean():
            return "lines of different widths"
    if np.isnan(table.z[first]) or np.ptp(table.z[infill.opens[some]]) > 0:
        return "lines at different heights"
    for line in range(first, last + 1):
        command = commands.get(line)
        if command is not None and not _harmless(command):
            return f"a {command.code or 'strange'} command in between"
    # Everything that extrudes between its first and last move must be a stroke.
    drawn = np.flatnonzero(table.extruded[inside] > 0) + first
    moving = drawn[table.given[drawn, 0] | table.given[drawn, 1]]
    own = np.isin(moving, infill.moves)  # where a stroke begins, another may end
    return "" if own.all() and (marks.section[inside] == marks.section[first]).all() else "extrusion of another kind"


def _harmless(command: Command) -> bool:
    """Return whether a command may stand between moves that are drawn anew."""
    return command.code in HARMLESS or command.code in HARMLESS_WORDS or _sets_counter(command)


def _sets_counter(command: Command) -> bool:
    """Return whether a command sets the counter of filament, and nothing else."""
    return command.code == "G92" and set(command.words) == {"E"}


@dataclass(frozen=True, kw_only=True)
class Ways:
    """How the print travels and retracts.

    Parameters
    ----------
    travel : float, mm/min
    retraction : float, mm
        0 if it never retracts.
    retract_feed, prime_feed : float, mm/min
    lift : float, mm
    lift_feed : float, mm/min
    firmware : bool
        Retract by G10 and G11.
    """

    travel: float = 7200.0
    retraction: float = 0.0
    retract_feed: float = 2100.0
    prime_feed: float = 2100.0
    lift: float = 0.0
    lift_feed: float = 600.0
    firmware: bool = False


def ways_of(table: Table, before: Ways | None = None) -> Ways:
    """Return how a table travels and retracts: the usual amounts and feed rates."""
    moved = table.given[:, 0] | table.given[:, 1]
    still = (table.kind == MOVE) & ~moved
    back, forth = still & (table.extruded < 0), still & (table.extruded > 0)
    travel = (table.kind == MOVE) & moved & (table.extruded == 0)
    total = np.cumsum(table.extruded) - table.before.retracted
    depth = np.maximum.accumulate(np.maximum(total, 0.0)) - total
    rises = np.diff(table.z, prepend=table.before.z)
    up = (table.kind == MOVE) & table.given[:, 2] & ~moved & (depth > 1e-6) & (rises > 0)
    known = before or Ways()

    def usual(values: Floats, otherwise: float) -> float:
        values = values[np.isfinite(values) & (values > 0)]
        return float(np.median(values)) if len(values) else otherwise

    # Layers begin with a rise too: a lift is what comes down again.
    down = (table.kind == MOVE) & table.given[:, 2] & ~moved & (depth > 1e-6) & (rises < 0)
    return Ways(
        travel=usual(table.f[travel], known.travel),
        retraction=usual(np.round(depth[travel & (depth > 0.05)], 5), known.retraction),
        retract_feed=usual(table.f[back], known.retract_feed),
        prime_feed=usual(table.f[forth], known.prime_feed),
        lift=usual(-rises[down], known.lift) if down.any() else known.lift,
        lift_feed=usual(table.f[up], known.lift_feed),
        firmware=any(firmware_retraction(command, table.before.firmware) for command in table.commands)
        or known.firmware,
    )


def composed(
    table: Table, body: Body, paths: Sequence[Floats], rate: float, ways: Ways, retracts: Sequence[bool]
) -> tuple[bytes, float]:
    """Return the text of a body with new paths, and the filament that they take, mm.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
        Multiples of the last decimal, in order.
    rate : float
        mm of filament per mm.
    retracts : sequence of bool, one more than paths
        Whether to retract on the way to each path, and from the last one to the end of the body.
    """
    ends = b"\r\n" if table.text(body.first, body.first + 1).endswith(b"\r\n") else b"\n"
    relative = bool(table.relative_e[body.first])
    counter = float(table.e[body.first - 1]) if body.first else table.before.e
    begun = counter
    here, feed = body.start, float(table.f[body.first - 1]) if body.first else table.before.f
    pieces: list[bytes] = []
    pushed = 0.0

    def go(there: Floats, retract: bool) -> None:
        nonlocal feed
        if np.abs(there - here).max() < 1e-9:
            return
        up, down = _retraction(body, ways, counter, relative, ends) if retract else (b"", b"")
        pieces.append(up)
        pieces.append(b"G1 X%s Y%s F%s%s" % (_word(there[0]), _word(there[1]), _word(ways.travel), ends))
        pieces.append(down)
        feed = ways.travel if not retract else np.nan

    held = _held(table, body)
    whole = sum(float(np.hypot(*np.diff(path, axis=0).T).sum()) for path in paths)
    drawn = 0.0
    for path, retract in zip(paths, retracts[:-1], strict=True):
        go(path[0], retract)
        along = np.cumsum(np.hypot(*np.diff(path, axis=0).T))
        steps = np.rint((pushed + along * rate) / FILAMENT_UNIT)
        if relative:
            words = np.diff(steps, prepend=np.rint(pushed / FILAMENT_UNIT)) * FILAMENT_UNIT
        else:
            words = (np.rint(begun / FILAMENT_UNIT) + steps) * FILAMENT_UNIT
        pushed += float(along[-1]) * rate
        counter = begun + pushed
        feeds = np.full(len(along), np.nan)
        if feed != body.feed:
            feeds[0] = feed = body.feed
        columns = [(b" X", path[1:, 0], 3), (b" Y", path[1:, 1], 3), (b" E", words, 5), (b" F", feeds, 3)]
        rows = write_words(columns, b"G1", ends)
        done = 0
        while held and held[0][0] * whole < drawn + along[-1]:  # a line that stood between moves
            share, text = held.pop(0)
            row = int(np.searchsorted(along, share * whole - drawn + LEAST_STEP))
            pieces += [rows.text[rows.start[done] : rows.start[row]], text]
            done = row
        pieces.append(rows.text[rows.start[done] :])
        drawn += float(along[-1])
        here = path[-1]
    go(body.end, retracts[-1])
    pieces.extend(text for _, text in held)
    expected = float(table.e[body.last])
    if not relative and abs(counter - expected) >= FILAMENT_UNIT / 2:
        pieces.append(b"G92 E%s%s" % (_word(expected, 5), ends))
    if feed != body.feed_after:
        pieces.append(b"G1 F%s%s" % (_word(body.feed_after), ends))
    return b"".join(pieces), pushed


def exchanged(table: Table, some: Sequence[Body], texts: Sequence[bytes]) -> Spliced:
    """Return the text of a table with the bodies of some sections exchanged."""
    pieces: list[bytes] = []
    same = np.ones(len(table), dtype=bool)
    change = np.zeros(len(table) + 1, dtype=np.intp)
    done = 0
    for body, text in zip(some, texts, strict=True):
        pieces += [table.text(done, body.first), text]
        same[body.first : body.last + 1] = False
        change[body.last + 1] += text.count(b"\n") - (body.last + 1 - body.first)
        done = body.last + 1
    pieces.append(table.text(done, len(table)))
    return Spliced(text=b"".join(pieces), shift=np.cumsum(change), same=same)


def unlawful(other: Table, done: Spliced, some: Sequence[Body], texts: Sequence[bytes]) -> str:
    """Say what is wrong with the lines that are new, if anything is.

    Parameters
    ----------
    other : Table
        The new text, read.
    some, texts
        As for `exchanged`.
    """
    fresh = np.ones(len(other), dtype=bool)
    old = np.flatnonzero(done.same)
    fresh[old + done.shift[old]] = False
    drawn = fresh & (other.kind == MOVE) & (other.given[:, 0] | other.given[:, 1]) & (other.extruded != 0)
    if (other.kind[fresh] == ODD).any():
        return "a new line that cannot be read"
    if (other.extruded[drawn] < 0).any():
        return "a new move that draws filament back"
    if not np.isin(np.round(other.z[drawn], 6), np.round([body.z for body in some], 6)).all():
        return "a new move at another height"
    if not (other.f[fresh] > 0).all():
        return "a new move without a feed rate"
    for body, text in zip(some, texts, strict=True):
        first = body.first + int(done.shift[body.first])
        part = slice(first, first + text.count(b"\n"))
        total = np.cumsum(other.extruded[part])  # the nozzle is primed where a body begins
        depth = np.maximum.accumulate(np.maximum(total, 0.0)) - total
        if (depth[drawn[part]] > 1e-3).any():
            return "extrusion while retracted"
        if len(depth) and depth[-1] > 1e-3:
            return "a section that ends retracted"
    return ""


def _retraction(body: Body, ways: Ways, counter: float, relative: bool, ends: bytes) -> tuple[bytes, bytes]:
    """Return the lines before and after a travel that is retracted."""
    if ways.firmware:
        back, forth = b"G10" + ends, b"G11" + ends
    elif ways.retraction:
        low = -ways.retraction if relative else counter - ways.retraction
        high = ways.retraction if relative else counter
        back = b"G1 E%s F%s%s" % (_word(low, 5), _word(ways.retract_feed), ends)
        forth = b"G1 E%s F%s%s" % (_word(high, 5), _word(ways.prime_feed), ends)
    else:
        return b"", b""
    if ways.lift:
        back += b"G1 Z%s F%s%s" % (_word(body.z + ways.lift), _word(ways.lift_feed), ends)
        forth = b"G1 Z%s F%s%s" % (_word(body.z), _word(ways.lift_feed), ends) + forth
    return back, forth


def _held(table: Table, body: Body) -> list[tuple[float, bytes]]:
    """Return the lines of a body that are no moves, in their order, with the share of the filament before each.

    Without retractions by firmware, which new paths have of their own, and without those that set a counter which goes
    on from path to path: slicers set it after every retraction, new text once, in the end.
    """
    inside = slice(body.first, body.last + 1)
    moved = table.given[inside, 0] | table.given[inside, 1]
    pushed = np.cumsum(np.where(moved, np.maximum(table.extruded[inside], 0.0), 0.0))
    share = pushed / max(float(pushed[-1]), 1e-12)
    kept = np.flatnonzero(table.kind[inside] != MOVE)
    counted = not table.relative_e[body.first]
    left_out = {
        command.line
        for command in table.commands
        if firmware_retraction(command, table.before.firmware) is not None or (counted and _sets_counter(command))
    }
    return [
        (float(share[place]), table.text(body.first + place, body.first + place + 1))
        for place in kept.tolist()
        if body.first + place not in left_out
    ]


def _word(value: float, decimals: int = 3) -> bytes:
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return text.encode() if text not in ("", "-", "-0") else b"0"
