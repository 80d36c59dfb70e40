"""The way of the nozzle through a print, as arrays: every move in x and y, with its filament and what goes before it.

Arcs are chords, as firmware drives them, so that an arc and the lines that it replaces are compared as paths. Moves of
the extruder or of z alone have no row: they change the retraction, the height and the filament before the next row.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.errors import FormatError
from infill.gcode.chords import chords_of_arc_lines
from infill.gcode.dialect import role_of
from infill.gcode.found_limits import FileLimits
from infill.gcode.lines import ARC, MOVE, ODD
from infill.gcode.sections import LineMarks, TagState, mark_lines
from infill.gcode.sliced_file import open_sliced
from infill.gcode.survey import STAMP
from infill.gcode.table import GcodeTable
from infill.planner.feature_sums import FeatureSums
from infill.planner.open_timeline import make_timeline
from infill.verifying.machine_settings import SettingsHistory

MAX_KEPT_LINES: Final = 1000  # lines with a fault of the text that are stored; further ones are counted
MAX_TEXT: Final = 60  # bytes of such a line that are shown
NOT_A_NUMBER: Final = re.compile(
    rb"[XYZEFSPIJKTRD=]\s*[-+]?(?:nan|inf|infinity|none|null|undefined)(?![a-z_](?![-+.\d]))", re.IGNORECASE
)
STAMP_SEARCH: Final = 1 << 18  # bytes at the beginning in which a refill leaves its stamp


@dataclass(frozen=True, kw_only=True)
class TraceRows:
    """Moves in x and y, in the order of the file.

    Parameters
    ----------
    start, end : (N, 3) float64
        mm; NaN where the file has not stated a position yet.
    filament : (N,) float64
        mm that the move pushes; negative retracts.
    feed : (N,) float64
        Feed rate in force, mm/min.
    line : (N,) int64
        In the file, from 1.
    layer : (N,) int64
        By the tags of the slicer, from 1; 0 before the first.
    role, thing : (N,) int64
        Places in `Trace.roles` and `Trace.objects`.
    retracted : (N,) float64
        Filament that is retracted when the move begins, mm.
    blob : (N,) float64
        Filament pushed in one place since the previous row, beyond what was retracted, mm.
    blob_line : (N,) int64
        The line that pushed most of it.
    """

    start: Floats
    end: Floats
    filament: Floats
    feed: Floats
    line: Places
    layer: Places
    role: Places
    thing: Places
    retracted: Floats
    blob: Floats
    blob_line: Places

    def __len__(self) -> int:
        return len(self.line)

    @property
    def draws(self) -> NDArray[np.bool_]:
        """True for rows that lay filament."""
        return self.filament > 0

    @property
    def length(self) -> Floats:
        """Length of each row, mm."""
        return np.asarray(np.linalg.norm(self.end - self.start, axis=1))

    def at(self, rows: Any) -> TraceRows:  # noqa: ANN401 - an index of NumPy
        """Return some of the rows."""
        return TraceRows(**{name: values[rows] for name, values in vars(self).items()})


@dataclass(frozen=True, kw_only=True)
class Trace:
    """A print as it is compared.

    Parameters
    ----------
    path : Path
    rows : TraceRows
    roles, objects : tuple of str
    history : SettingsHistory
    zero_feeds : tuple of (line, text)
        Lines that set a feed rate of 0 or less.
    unread : tuple of (line, text)
        Lines that may move or extrude and cannot be read.
    not_numbers : tuple of (line, text)
        Lines with a word such as XNaN.
    macros : tuple of str
        Commands of the printer that may move.
    features : dict of str to (seconds, filament)
        By role; filament in mm.
    layers, lines : int
        Number of layers and of lines.
    stamp : bytes
        The line that a refill has left; else empty.
    first_limits : FileLimits
        What the file says of itself before its first line: slicer, end, units, limits of the machine.
    plate : int or None
    plates : tuple of int
    """

    path: Path
    rows: TraceRows
    roles: tuple[str, ...]
    objects: tuple[str, ...]
    history: SettingsHistory
    zero_feeds: tuple[tuple[int, str], ...]
    unread: tuple[tuple[int, str], ...]
    not_numbers: tuple[tuple[int, str], ...]
    macros: tuple[str, ...]
    features: Mapping[str, tuple[float, float]]
    layers: int
    lines: int
    stamp: bytes
    first_limits: FileLimits
    plate: int | None
    plates: tuple[int, ...]

    def settings_at(self, line: Places) -> Places:
        """Return the number of the settings in force at each of some lines."""
        history = self.history
        return np.asarray(history.numbers)[np.searchsorted(history.lines, line, side="right") - 1]

    def set_before(self, name: str, line: int) -> int:
        """Return the last line up to `line` that set a setting, 0 if none did."""
        lines = self.history.since.get(name, [])
        place = int(np.searchsorted(lines, line, side="right"))
        return lines[place - 1] if place else 0


class _Collector:
    """The rows of a print, table by table."""

    def __init__(self) -> None:
        self.parts: list[TraceRows] = []
        self.roles: dict[str, int] = {}
        self.objects: dict[str, int] = {}
        self.history = SettingsHistory()
        self.zero_feeds: list[tuple[int, str]] = []
        self.unread: list[tuple[int, str]] = []
        self.not_numbers: list[tuple[int, str]] = []
        self.lines = 0
        self.stamp = b""
        self.tags = TagState()
        self._total = self._highest = 0.0  # filament pushed so far, and the most that it ever was
        self._blob, self._largest, self._blob_line = 0.0, 0.0, 0

    def add(self, table: GcodeTable) -> None:
        """Take the next lines of the print."""
        if not self.lines:
            head = table.data[:STAMP_SEARCH]
            self.stamp = head[head.find(STAMP) :].partition(b"\n")[0].strip() if STAMP in head else b""
        marks = mark_lines(table, self.tags)
        self.tags = marks.after
        for command in table.commands:
            line = command.line
            if not table.unread[line] and table.kind[line] != ODD and command.code:
                text = table.text(line, line + 1)
                self.history.follow(command, text, self.lines + line + 1, table.before.firmware)
        self._keep(self.unread, table, np.flatnonzero(table.unread))
        self._keep(self.zero_feeds, table, np.flatnonzero(table.given[:, 4] & (table.f <= 0)))
        self._keep(self.not_numbers, table, _find_not_numbers(table))
        self._add_rows(table, marks)
        self.lines += len(table)

    def _keep(self, kept: list[tuple[int, str]], table: GcodeTable, lines: Iterable[int]) -> None:
        """Store the number and the text of some lines."""
        for line in lines:
            if len(kept) == MAX_KEPT_LINES:
                return
            text = table.text(line, line + 1)[:MAX_TEXT].decode("utf-8", "replace").strip()
            kept.append((self.lines + int(line) + 1, text))

    def _add_rows(self, table: GcodeTable, marks: LineMarks) -> None:
        """Add the moves of a table in x and y."""
        place = np.column_stack([table.x, table.y, table.z])
        before = np.vstack([[table.before.x, table.before.y, table.before.z], place[:-1]])
        with np.errstate(invalid="ignore"):
            same = (place == before) | (np.isnan(place) & np.isnan(before))
        odd = table.kind == ODD
        arcs = ((table.kind == ARC) | (odd & (table.code > 1))) & ~table.unread
        straight = ((table.kind == MOVE) | (odd & (table.code >= 0) & (table.code < 2))) & ~same[:, :2].all(axis=1)
        line, start, end = np.flatnonzero(straight), before[straight], place[straight]
        share = np.ones(len(line))
        if arcs.any():
            line, start, end, share = _insert_arcs(table, np.flatnonzero(arcs), before, place, (line, start, end))
        filament = table.filament
        total = self._total + np.cumsum(filament)
        highest = np.maximum.accumulate(np.maximum(total, self._highest))
        total_before = np.concatenate([[self._total], total[:-1]])
        highest_before = np.concatenate([[self._highest], highest[:-1]])
        first = np.concatenate([[True], np.diff(line) != 0])[: len(line)]
        blob, blob_line = self._count_blobs(highest - highest_before, line[first], len(table))
        number = np.cumsum(first) - 1
        passed = np.cumsum(share) - share  # of the lines up to each chord
        passed -= passed[first][number] if len(line) else 0.0
        self.parts.append(
            TraceRows(
                start=start,
                end=end,
                filament=filament[line] * share,
                feed=table.f[line],
                line=self.lines + line + 1,
                layer=marks.layer[line].astype(np.int64),
                role=_renumber(marks.roles, self.roles)[marks.role[line]],
                thing=self._number_objects(marks, line),
                retracted=np.maximum((highest_before - total_before)[line] - filament[line] * passed, 0.0),
                blob=np.where(first, blob[number], 0.0) if len(line) else np.empty(0),
                blob_line=blob_line[number] if len(line) else np.empty(0, dtype=np.int64),
            )
        )
        if len(table):
            self._total, self._highest = float(total[-1]), float(highest[-1])

    def _count_blobs(self, gain: Floats, moving: Places, lines: int) -> tuple[Floats, Places]:
        """Sum up the filament that is pushed without a move, up to each moving line; name the line that pushed most."""
        still = gain.copy()
        still[moving] = 0.0
        sums = np.concatenate([[0.0], np.cumsum(still)])
        edges = np.concatenate([[0], moving, [lines]])
        blob = np.diff(sums[edges])
        blob_line = self.lines + 1 + edges[:-1]
        for k in np.flatnonzero(blob > 0).tolist():
            inside = still[edges[k] : edges[k + 1]]
            blob_line[k] += int(np.argmax(inside))
        blob[0] += self._blob
        if self._largest > blob[0] / 2:
            blob_line[0] = self._blob_line
        self._blob, self._largest, self._blob_line = float(blob[-1]), float(blob[-1]), int(blob_line[-1])
        return blob[:-1], blob_line[:-1]

    def _number_objects(self, marks: LineMarks, line: Places) -> Places:
        """Return the number of the object of each line."""
        sections = np.fromiter(marks.names, dtype=np.int64, count=len(marks.names))
        numbers = _renumber(tuple(marks.names.values()), self.objects)
        table = np.zeros(int(sections.max(initial=0)) + 1, dtype=np.int64)
        table[sections] = numbers
        return table[marks.section[line]]


def _find_not_numbers(table: GcodeTable) -> list[int]:
    """Return the lines with a word that is not a number, outside of comments."""
    places = np.array([match.start() for match in NOT_A_NUMBER.finditer(table.data)], dtype=np.int64)
    lines = np.searchsorted(table.start, places, side="right") - 1
    return [
        line
        for line, place in zip(lines.tolist(), places.tolist(), strict=True)
        if b";" not in table.data[table.start[line] : place]
    ]


def _renumber(names: tuple[str, ...], known: dict[str, int]) -> Places:
    """Return the number of each name in a list that grows."""
    return np.array([known.setdefault(name, len(known)) for name in names], dtype=np.int64)


def _insert_arcs(
    table: GcodeTable, arcs: Places, before: Floats, place: Floats, straight: tuple[Places, Floats, Floats]
) -> tuple[Places, Floats, Floats, Floats]:
    """Return lines, starts and ends of straight moves and chords of arcs, and the share of the filament of each."""
    line, start, end = straight
    start_at, end_at = np.nan_to_num(before[arcs]), np.nan_to_num(place[arcs])
    which, begin, _, share = chords_of_arc_lines(table, arcs, start_at, end_at)
    finish = np.vstack([begin[1:], begin[:1]])
    closing = np.concatenate([np.diff(which) != 0, [True]])
    finish[closing] = place[arcs[which[closing]]]
    owner = np.concatenate([line, arcs[which]])
    order = np.argsort(owner, kind="stable")
    return (
        owner[order],
        np.concatenate([start, begin])[order],
        np.concatenate([end, finish])[order],
        np.concatenate([np.ones(len(line)), share])[order],
    )


def read_trace(path: Path, plate: int | None = None, like: Trace | None = None) -> Trace:
    """Read a print as it is compared.

    Parameters
    ----------
    path : Path
        G-code as text, binary G-code, or an archive of plates.
    plate : int, optional
        Plate of an archive; by default the first that has G-code.
    like : Trace, optional
        A print for the same machine: what its comments say of units and limits holds where this one has no comments.

    Raises
    ------
    FormatError
        If the file is missing, is not G-code, or lays no filament.
    """
    collector, sums = _Collector(), FeatureSums(times_only=True)
    with open_sliced(path) as file:
        part = file.part_of_plate(plate)
        with file.text(part) as text:
            timeline = make_timeline(text)
            if like is not None and not timeline.found.slicer:
                timeline = make_timeline(text, found=replace(like.first_limits, slicer="", missing_end=""))
            first_limits = timeline.found
            for table in timeline.tables():
                sums.add(*timeline.follow(table))
                collector.add(table)
            sums.add(*timeline.rest())
        plates = file.plates
    sums.finish(timeline.pause, timeline.retractions)
    rows = TraceRows(
        **{name: np.concatenate([getattr(part, name) for part in collector.parts]) for name in vars(collector.parts[0])}
    )
    if not rows.draws.any():
        raise FormatError(f"{path}: {timeline.trouble or 'no line lays filament; give the G-code of a print'}")
    seconds = sums.total("seconds").tolist()
    roles = tuple(collector.roles)
    spent = np.bincount(rows.role, weights=np.maximum(rows.filament, 0.0), minlength=len(roles)).tolist()
    features: dict[str, tuple[float, float]] = {}
    for name, time in zip(timeline.features, seconds, strict=False):
        role = role_of(name)
        features[role] = (features.get(role, (0.0, 0.0))[0] + time, 0.0)
    for role, filament in zip(roles, spent, strict=True):
        if filament or role in features:
            features[role] = (features.get(role, (0.0, 0.0))[0], filament)
    return Trace(
        path=path,
        rows=rows,
        roles=roles,
        objects=tuple(collector.objects),
        history=collector.history,
        zero_feeds=tuple(collector.zero_feeds),
        unread=tuple(collector.unread),
        not_numbers=tuple(collector.not_numbers),
        macros=tuple(timeline.macros),
        features=features,
        layers=collector.tags.layer,
        lines=collector.lines,
        stamp=collector.stamp,
        first_limits=first_limits,
        plate=part,
        plates=plates,
    )
