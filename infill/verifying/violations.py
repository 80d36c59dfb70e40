"""Violations: what differs, on which line, in plain words; equal ones in a row are one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from infill.arrays import Floats, Places
from infill.plain_numbers import count_noun, plain_argument
from infill.verifying.trace import Trace

RUN_GAP: Final = 3  # rows between two faults of one run


@dataclass(frozen=True, kw_only=True)
class Violation:
    """One difference that a post-processor must not make.

    Parameters
    ----------
    kind : str
        One of `infill.verifying.settings.KINDS`.
    line : int
        Line of the new print where it begins, from 1.
    layer : int
        Layer by the tags of the slicer, from 1; 0 before the first, or without tags.
    z : float or None
        Height of the nozzle, mm; None before it is stated.
    text : str
        New value, and the old one.
    lines : int
        Number of lines with this fault.
    last_line : int
    old_line : int
        Line of the old print that it is compared with; 0 without one.
    """

    kind: str
    line: int
    layer: int
    z: float | None
    text: str
    lines: int = 1
    last_line: int = 0
    old_line: int = 0

    def __str__(self) -> str:
        """Return one line: place, kind, new and old value, and number of lines."""
        place = [f"layer {self.layer}"] if self.layer else []
        place += [] if self.z is None else [f"z {plain_argument(round(self.z, 3))} mm"]
        where = f"line {self.line}" + (f" ({', '.join(place)})" if place else "")
        more = (
            f" ({count_noun(self.lines, 'line')}, to line {self.last_line})"
            if self.lines > 1 and self.last_line > self.line
            else ""
        )
        return f"{where}: {self.kind}: {self.text}{more}"


class ViolationList:
    """Violations as they are found."""

    def __init__(self, new: Trace) -> None:
        self._new = new
        self.violations: list[Violation] = []
        self.faulty = np.zeros(len(new.rows), dtype=bool)  # rows with a fault of their own
        self.travels: set[int] = set()  # rows of travels that are reported

    def add_runs(
        self,
        kind: str,
        rows: Places,
        describe: Callable[[int], str],
        old_lines: Places | None = None,
        lines: Places | None = None,
    ) -> None:
        """Add faults of rows of the new print; those in a row are one run, and runs of one text are one violation.

        Parameters
        ----------
        kind : str
        rows : (N,) int64, ascending
        describe : callable
            Returns the text of the fault at a place in `rows`.
        old_lines : (N,) int64, optional
            Lines of the old print that they are compared with.
        lines : (N,) int64, optional
            Where the faults lie, if not on the lines of the rows.
        """
        if not len(rows):
            return
        self.faulty[rows] = True
        lines = self._new.rows.line[rows] if lines is None else lines
        begins = np.flatnonzero(np.concatenate([[True], np.diff(rows) > RUN_GAP]))
        runs: dict[str, list[tuple[int, int]]] = {}
        for begin, end in zip(begins.tolist(), [*begins[1:].tolist(), len(rows)], strict=True):
            runs.setdefault(describe(begin), []).append((begin, end))
        for text, places in runs.items():
            old_line = 0 if old_lines is None else int(old_lines[places[0][0]])
            self._add(kind, np.concatenate([lines[begin:end] for begin, end in places]), text, old_line)

    def _add(self, kind: str, lines: Places, text: str, old_line: int) -> None:
        """Add one violation on some lines."""
        lines = np.unique(lines)
        self.add_line(kind, int(lines[0]), text, lines=len(lines), last_line=int(lines[-1]), old_line=old_line)

    def add_line(
        self, kind: str, line: int, text: str, *, lines: int = 1, last_line: int = 0, old_line: int = 0
    ) -> None:
        """Add a violation at a line of the new print."""
        rows = self._new.rows
        row = min(int(np.searchsorted(rows.line, line)), len(rows) - 1)
        z = float(rows.end[row, 2])
        self.violations.append(
            Violation(
                kind=kind,
                line=line,
                layer=int(rows.layer[row]),
                z=None if np.isnan(z) else z,
                text=text,
                lines=lines,
                last_line=last_line or line,
                old_line=old_line,
            )
        )

    def sorted(self) -> tuple[Violation, ...]:
        """Return the violations in the order of the lines; those of one kind and text are one."""
        merged: dict[tuple[str, str], Violation] = {}
        for violation in sorted(self.violations, key=lambda violation: violation.line):
            key = violation.kind, violation.text
            first = merged.setdefault(key, violation)
            if first is not violation:
                last = max(first.last_line, violation.last_line)
                merged[key] = replace(first, lines=first.lines + violation.lines, last_line=last)
        return tuple(sorted(merged.values(), key=lambda violation: (violation.line, violation.kind)))


def describe_lengths(new: float, old: float, what: str) -> str:
    """Say how much of something there is, and was, in mm.

    >>> describe_lengths(0.8, 0.0, "retracted")
    '0.8 mm retracted, was 0 mm'
    """
    return f"{plain_argument(round(new, 4))} mm {what}, was {plain_argument(round(old, 4))} mm"


def describe_speeds(now: float, was: float) -> str:
    """Say how fast a bead is, and was, from feed rates in mm/min.

    >>> describe_speeds(4800.0, 2400.0)
    '80 mm/s, was 40 mm/s'
    """
    return f"{plain_argument(round(now / 60, 2))} mm/s, was {plain_argument(round(was / 60, 2))} mm/s"


def describe_place(point: Floats) -> str:
    """Write the x and y of a point."""
    return f"x {plain_argument(round(point[0], 3))}, y {plain_argument(round(point[1], 3))} mm"
