"""New paths as the text of a section of infill, with the retractions and the other lines of the old text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.arcs import find_arcs, mark_arc_lines
from infill.gcode.infill_sections import InfillSection
from infill.gcode.lines import ARC, MOVE, ODD
from infill.gcode.machine_state import firmware_retraction, sets_counter
from infill.gcode.numbers import format_word
from infill.gcode.path_moves import plan_moves
from infill.gcode.sections import is_printing
from infill.gcode.splicing import SplicedText, find_difference
from infill.gcode.strokes import FILAMENT_UNIT
from infill.gcode.table import GcodeTable, read_table

MIN_STEP = 1e-6  # mm: a kept line at a point of a path, up to rounding, stands behind it


@dataclass(frozen=True, kw_only=True)
class TravelSettings:
    """Travel and retraction of a print.

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


def measure_travel(table: GcodeTable, before: TravelSettings | None = None) -> TravelSettings:
    """Measure the travel and retraction of a table: the most usual amounts and feed rates."""
    moved = table.given[:, 0] | table.given[:, 1]
    still = (table.kind == MOVE) & ~moved
    back, forth = still & (table.extruded < 0), still & (table.extruded > 0)
    travel = (table.kind == MOVE) & moved & (table.extruded == 0)
    total = np.cumsum(table.extruded) - table.before.retracted
    depth = np.maximum.accumulate(np.maximum(total, 0.0)) - total
    rises = np.diff(table.z, prepend=table.before.z)
    is_back = (depth > 1e-6) | _is_back_by_firmware(table)
    upright = (table.kind == MOVE) & table.given[:, 2] & ~moved & is_back
    up = upright & (rises > 0)
    default = before or TravelSettings()

    def median_or(values: Floats, otherwise: float) -> float:
        """Return the median of the positive values, or a default without any."""
        values = values[np.isfinite(values) & (values > 0)]
        return float(np.median(values)) if len(values) else otherwise

    # Layers begin with a rise too: a lift comes down afterwards, and not below what was printed last, as an object does
    # that is printed after another.
    down = upright & (rises < 0) & (table.z >= _last_printed_height(table) - MIN_STEP)
    return TravelSettings(
        travel=median_or(table.f[travel], default.travel),
        retraction=median_or(np.round(depth[travel & (depth > 0.05)], 5), default.retraction),
        retract_feed=median_or(table.f[back], default.retract_feed),
        prime_feed=median_or(table.f[forth], default.prime_feed),
        lift=median_or(-rises[down], default.lift) if down.any() else default.lift,
        lift_feed=median_or(table.f[up], default.lift_feed),
        firmware=any(firmware_retraction(command, table.before.firmware) for command in table.commands)
        or default.firmware,
    )


def _is_back_by_firmware(table: GcodeTable) -> NDArray[np.bool_]:
    """Return for each line whether filament is retracted by firmware, (N,)."""
    turns = [(command.line, firmware_retraction(command, table.before.firmware)) for command in table.commands]
    turns = [(line, back) for line, back in turns if back is not None]
    states = np.array([table.before.firmware_retracted, *(back for _, back in turns)])
    return np.asarray(states[np.searchsorted([line for line, _ in turns], np.arange(len(table)), side="right")])


def _last_printed_height(table: GcodeTable) -> Floats:
    """Return the height, mm, of the last bead up to each line, (N,); inf before the first."""
    at = np.where(is_printing(table), np.arange(len(table)), -1)
    last = np.maximum.accumulate(at)
    return np.where(last >= 0, table.z[np.maximum(last, 0)], np.inf)


def compose_section(
    table: GcodeTable,
    body: InfillSection,
    paths: Sequence[Floats],
    rate: float,
    ways: TravelSettings,
    retracts: Sequence[bool],
    arc_deviation: float = 0.0,
) -> tuple[bytes, float]:
    """Write the text of a body with new paths; return it, and the filament that the paths take, mm.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
        Multiples of the last decimal, in order.
    rate : float
        mm of filament per mm.
    retracts : sequence of bool, one more than paths
        Whether to retract on the way to each path, and from the last path to the end of the body.
    arc_deviation : float, mm
        As for `plan_moves`.
    """
    ends = b"\r\n" if table.text(body.first, body.first + 1).endswith(b"\r\n") else b"\n"
    relative = bool(table.relative_e[body.first])
    counter = float(table.e[body.first - 1]) if body.first else table.before.e
    begun = counter
    position, feed = body.start, float(table.f[body.first - 1]) if body.first else table.before.f
    pieces: list[bytes] = []
    pushed = 0.0

    def travel_to(goal: Floats, retract: bool) -> None:
        """Travel to a place, with retraction if asked."""
        nonlocal feed
        if np.abs(goal - position).max() < 1e-9:
            return
        up, down = _retraction_lines(body, ways, counter, relative, ends) if retract else (b"", b"")
        pieces.append(up)
        pieces.append(
            b"G1 X%s Y%s F%s%s" % (format_word(goal[0]), format_word(goal[1]), format_word(ways.travel), ends)
        )
        pieces.append(down)
        feed = ways.travel if not retract else np.nan

    interruptions, rest = _place_lines(_kept_lines(table, body), paths)
    for path, lines, retract in zip(paths, interruptions, retracts[:-1], strict=True):
        stops = np.zeros(len(path), dtype=bool)
        stops[[point for point, _ in lines]] = True
        moves = plan_moves(path, np.array([0, len(path)]), arc_deviation=arc_deviation, stops=stops)
        travel_to(path[0], retract)
        along = np.cumsum(moves.length)
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
        rows = moves.write(words, feeds, ends)
        copied_rows = 0
        for point, text in lines:
            row = int(np.searchsorted(moves.end, point, side="right"))
            pieces += [rows.text[rows.start[copied_rows] : rows.start[row]], text]
            copied_rows = row
        pieces.append(rows.text[rows.start[copied_rows] :])
        position = path[-1]
    travel_to(body.end, retracts[-1])
    pieces.extend(rest)
    expected = float(table.e[body.last])
    if not relative and abs(counter - expected) >= FILAMENT_UNIT / 2:
        pieces.append(b"G92 E%s%s" % (format_word(expected, 5), ends))
    if feed != body.feed_after:
        pieces.append(b"G1 F%s%s" % (format_word(body.feed_after), ends))
    return b"".join(pieces), pushed


def _place_lines(
    kept_lines: list[tuple[float, bytes]], paths: Sequence[Floats]
) -> tuple[list[list[tuple[int, bytes]]], list[bytes]]:
    """Place lines in new paths by the shares of filament before them.

    Returns
    -------
    lines : list of list of (point, text)
        For each path, the lines that stand behind its points, in order.
    rest : list of bytes
        The lines that stand behind all paths.
    """
    steps = [np.cumsum(np.hypot(*np.diff(path, axis=0).T)) for path in paths]
    total = sum(float(along[-1]) for along in steps)
    begun, number = 0.0, 0
    lines: list[list[tuple[int, bytes]]] = []
    for along in steps:
        inside = []
        while number < len(kept_lines) and kept_lines[number][0] * total < begun + along[-1]:
            share, text = kept_lines[number]
            inside.append((int(np.searchsorted(along, share * total - begun + MIN_STEP)), text))
            number += 1
        begun += float(along[-1])
        lines.append(inside)
    return lines, [text for _, text in kept_lines[number:]]


def redraw_sections(
    table: GcodeTable,
    drawn: Sequence[tuple[InfillSection, Sequence[Floats], float, Sequence[bool]]],
    ways: TravelSettings,
    arc_deviation: float = 0.0,
) -> tuple[bytes, list[float], str]:
    """Write new paths into the text of a table; return it, the filament of each section, mm, and the first fault.

    The fault is a difference elsewhere, or one of the new lines; "" if there is none.

    Parameters
    ----------
    table : GcodeTable
    drawn : sequence of (body, paths, rate, retracts)
        As for `compose_section`.
    ways : TravelSettings
    arc_deviation : float, mm
        As for `plan_moves`.
    """
    bodies = [body for body, *_ in drawn]
    composed = [
        compose_section(table, body, paths, rate, ways, retracts, arc_deviation)
        for body, paths, rate, retracts in drawn
    ]
    texts = [text for text, _ in composed]
    spliced = replace_sections(table, bodies, texts)
    new_table = read_table(spliced.text, table.before)
    fault = find_difference(table, new_table, spliced) or validate_sections(new_table, spliced, bodies, texts)
    return spliced.text, [filament for _, filament in composed], fault


def replace_sections(table: GcodeTable, selected: Sequence[InfillSection], texts: Sequence[bytes]) -> SplicedText:
    """Replace the bodies of some sections in the text of a table; return the new text."""
    pieces: list[bytes] = []
    same = np.ones(len(table), dtype=bool)
    change = np.zeros(len(table) + 1, dtype=np.intp)
    copied_lines = 0
    for body, text in zip(selected, texts, strict=True):
        pieces += [table.text(copied_lines, body.first), text]
        same[body.first : body.last + 1] = False
        change[body.last + 1] += text.count(b"\n") - (body.last + 1 - body.first)
        copied_lines = body.last + 1
    pieces.append(table.text(copied_lines, len(table)))
    return SplicedText(text=b"".join(pieces), shift=np.cumsum(change), same=same)


def validate_sections(
    new_table: GcodeTable, spliced_text: SplicedText, selected: Sequence[InfillSection], texts: Sequence[bytes]
) -> str:
    """Describe the first fault of the new lines; "" if there is none.

    Parameters
    ----------
    new_table : GcodeTable
        The new text as a table.
    selected, texts
        As for `replace_sections`.
    """
    fresh = spliced_text.new_lines(len(new_table))
    drawn = fresh & (new_table.code >= 0) & (new_table.given[:, 0] | new_table.given[:, 1]) & (new_table.extruded != 0)
    if (new_table.kind[fresh] == ODD).any():
        return "a new line that cannot be read"
    if not mark_arc_lines(find_arcs(new_table), len(new_table))[fresh & (new_table.kind == ARC)].all():
        return "a new arc that closes on no circle"
    if (new_table.extruded[drawn] < 0).any():
        return "a new move that draws filament back"
    if not np.isin(np.round(new_table.z[drawn], 6), np.round([body.z for body in selected], 6)).all():
        return "a new move at another height"
    if not (new_table.f[fresh] > 0).all():
        return "a new move without a feed rate"
    for body, text in zip(selected, texts, strict=True):
        first_line = body.first + int(spliced_text.shift[body.first])
        part = slice(first_line, first_line + text.count(b"\n"))
        total = np.cumsum(new_table.extruded[part])  # the nozzle is primed where a body begins
        depth = np.maximum.accumulate(np.maximum(total, 0.0)) - total
        if (depth[drawn[part]] > 1e-3).any():
            return "extrusion while retracted"
        if len(depth) and depth[-1] > 1e-3:
            return "a section that ends retracted"
    return ""


def _retraction_lines(
    body: InfillSection, ways: TravelSettings, counter: float, relative: bool, ends: bytes
) -> tuple[bytes, bytes]:
    """Return the lines before and after a travel with retraction."""
    if ways.firmware:
        back, forth = b"G10" + ends, b"G11" + ends
    elif ways.retraction:
        low = -ways.retraction if relative else counter - ways.retraction
        high = ways.retraction if relative else counter
        back = b"G1 E%s F%s%s" % (format_word(low, 5), format_word(ways.retract_feed), ends)
        forth = b"G1 E%s F%s%s" % (format_word(high, 5), format_word(ways.prime_feed), ends)
    else:
        return b"", b""
    if ways.lift:
        back += b"G1 Z%s F%s%s" % (format_word(body.z + ways.lift), format_word(ways.lift_feed), ends)
        forth = b"G1 Z%s F%s%s" % (format_word(body.z), format_word(ways.lift_feed), ends) + forth
    return back, forth


def _kept_lines(table: GcodeTable, body: InfillSection) -> list[tuple[float, bytes]]:
    """Return the lines of a body other than moves, in order, with the share of the filament before each.

    Leave out firmware retractions, since new paths have their own, and lines that set a counter which continues from
    path to path: slicers set it after every retraction, new text once, at the end.
    """
    inside = slice(body.first, body.last + 1)
    moved = table.given[inside, 0] | table.given[inside, 1]
    pushed = np.cumsum(np.where(moved, np.maximum(table.extruded[inside], 0.0), 0.0))
    share = pushed / max(float(pushed[-1]), 1e-12)
    rows = np.flatnonzero((table.kind[inside] != MOVE) & (table.code[inside] < 0))
    counted = not table.relative_e[body.first]
    left_out = {
        command.line
        for command in table.commands
        if firmware_retraction(command, table.before.firmware) is not None or (counted and sets_counter(command))
    }
    return [
        (float(share[place]), table.text(body.first + place, body.first + place + 1))
        for place in rows.tolist()
        if body.first + place not in left_out
    ]
