"""The plainest of refills: every corner of the infill is cut off by 0.1 mm.

It shows what is lawful, in every print of the corpus, without any of the package's merits.
"""

from __future__ import annotations

import re

import numpy as np

from tests.gcode_judge import Replay, Section, replayed

STAMP = b"; refilled by phasefill 0.0.0: chamfers"
CUT = 0.1  # mm


def chamfered(old: bytes) -> bytes:
    """Return a print with the corners of its infill cut off, and less filament for the shorter paths."""
    parts, runs = replayed(old)
    first = parts[0].lines[0]
    left = [first.raw, STAMP, first.ending]
    for i, (part, ran) in enumerate(zip(parts, runs, strict=True)):
        purge = any(b"PURGING FINISHED" in other.lines[0].body for other in parts[i + 1 : i + 2])
        if part.sparse and not purge and not any(line.n for line in part.lines):
            left += _section(part, ran)
        else:
            left += [line.raw for line in part.lines[(i == 0) :]]
    return b"".join(left)


def _section(part: Section, ran: Replay) -> list[bytes]:
    left: list[bytes] = []
    saved = 0.0  # mm of filament, since the last G92 or since the section began
    at = np.zeros(2)
    absolute = ran.before.absolute_e
    for i, (line, move) in enumerate(zip(part.lines, ran.moves, strict=True)):
        if line.name == b"G92":
            saved = 0.0
        if move is None or not move.pushed:
            left.append(line.raw)
        elif not move.extrudes or len(move.points) > 2:
            to = b"E%.5f" % (move.logical - saved)
            left.append(re.sub(rb"E[-\d.]+", to, line.raw) if absolute else line.raw)
        else:
            joined = [
                0 <= j < len(ran.moves) and ran.moves[j] is not None and ran.moves[j].extrudes
                and len(ran.moves[j].points) == 2
                for j in (i - 1, i + 1)
            ]  # fmt: skip
            start, end = np.array(move.points[0]), np.array(move.points[1])
            step = (end - start) / move.length * min(CUT, move.length / 3)
            speed = re.search(rb" ?F[\d.]+", line.command)
            places = [start + step] if joined[0] else []
            at = at if joined[0] else start
            for place in np.round([*places, end - step if joined[1] else end], 3):
                dose = float(np.hypot(*(place - at))) * move.per_mm
                done = move.logical - move.pushed - saved + dose
                saved -= dose
                text = b"G1 X%.3f Y%.3f E%.5f" % (*place, done if absolute else dose)
                left.append(text + (speed[0] if speed else b"") + line.ending)
                at = place
            saved += move.pushed
    if absolute and saved:
        e = ran.after.at["E"] - ran.after.zero["E"]
        left.append(b"G92 E%.5f" % e + part.lines[-1].ending)
    return left
