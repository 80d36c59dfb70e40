"""A file of G-code as a stream of planned moves: path, feature and duration of each.

The file is read in batches; moves that are not settled yet wait for the next batch, so memory does not grow with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import FormatError
from infill.gcode.chords import chords_of_arc_lines
from infill.gcode.dialect import MAX_TAG_BYTES, TAGS, parse_tag
from infill.gcode.found_limits import FileLimits, read_limits
from infill.gcode.given_limits import GivenLimits
from infill.gcode.limits import LIMITING_CODES, Limits
from infill.gcode.lines import ARC, COMMENT, MOVE, ODD, GcodeCommand, fill_missing
from infill.gcode.machine_state import MachineState, firmware_retraction
from infill.gcode.table import GcodeTable, read_table
from infill.gcode.unusual_moves import is_macro
from infill.planner.bounds import Moves
from infill.planner.lookahead import EMPTY_PLAN, MotionPlan, plan_settled
from infill.planner.struct_of_arrays import concatenate_rows, slice_rows

BATCH: Final = 1 << 22  # bytes
ENDS: Final = 1 << 18  # bytes at the beginning and the end that may hold settings
TAG_BYTES: Final = 4  # bytes that distinguish a tag from most other comments
TAG_PREFIXES: Final = sorted(
    {int.from_bytes(tag[:TAG_BYTES], "little") for tag in TAGS if TAGS[tag] in ("role", "layer")}
)
MAX_SHOWN_BYTES: Final = 60  # bytes of a line that is not understood
MAX_MACROS: Final = 100  # names that are stored
MAX_PERCENT: Final = 1000.0  # per cent, of M220 and M221
STOPS: Final = frozenset({"G4", "G10", "G11", "G28", "G29", "M0", "M1", "M109", "M190", "M400", "M600", "M601"})


@dataclass(frozen=True, kw_only=True)
class Steps:
    """Moves, with feature, layer and position in the file.

    Parameters
    ----------
    moves : Moves
    start : (N, 3) float64
        mm; NaN where the file has not stated a position yet.
    feature : (N,) int
        Index in `Timeline.features` of the name in force; 0 before the first.
    layer : (N,) int
        From 1; 0 before the first.
    pause : (N,) float64
        Seconds of dwelling before the move.
    retractions : (N,) int
        By firmware (G10), before the move.
    section : (N,) float64
        Of the filament, mm².
    place : (N,) int
        Begin of the move's line in the text, bytes.
    """

    moves: Moves
    start: Floats
    feature: NDArray[np.intp]
    layer: NDArray[np.intp]
    pause: Floats
    retractions: NDArray[np.intp]
    section: Floats
    place: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.layer)


@dataclass(frozen=True, kw_only=True)
class UnreadLines:
    """Lines that may move or extrude, and are not planned.

    Parameters
    ----------
    lines : int
        Number of lines.
    first : int
        Number of the first one, from 1; 0 if there is none.
    text : str
        Text of that line.
    """

    lines: int = 0
    first: int = 0
    text: str = ""


@dataclass(frozen=True, kw_only=True)
class _Orders:
    """Requests of the commands of a table, by line.

    Parameters
    ----------
    setting : (N,) int
        Index of the limits in force.
    stop : (N,) bool
        The machine stands still.
    pause : (N,) float64
        Seconds of dwelling.
    retractions : (N,) int
        By firmware.
    speed, flow : (N,) float64
        Factors on the feed rate and on the filament: M220 and M221.
    """

    setting: NDArray[np.intp]
    stop: NDArray[np.bool_]
    pause: Floats
    retractions: NDArray[np.intp]
    speed: Floats
    flow: Floats


class Timeline:
    """The moves of a file, batch by batch.

    Parameters
    ----------
    file : binary file
        G-code as text, which can be read from any place.
    given : GivenLimits, optional
        Limits that override those of the file, and times of macros.
    settings : mapping, optional
        Settings of the slicer from outside the text.
    found : FileLimits, optional
        The limits of the file, if already read.

    Raises
    ------
    FormatError
        If the file is not plain G-code.
    """

    def __init__(
        self,
        file: BinaryIO,
        given: GivenLimits | None = None,
        settings: Mapping[str, str] | None = None,
        found: FileLimits | None = None,
    ) -> None:
        self._file = file
        self.features: list[bytes] = [b""]
        self.layers = 0
        self.pause = 0.0  # seconds of dwelling since the last move
        self.retractions = 0  # by firmware since the last move
        self.unread = UnreadLines()
        self.macros: dict[str, None] = {}  # without a time, in the order of the file
        self.macro_seconds: dict[str, float] = {}  # of all calls of the others
        self._stopped = self._drawn_back = False
        self.moved = False  # a move was read
        self._waiting: Steps | None = None
        self._entry: float | None = None
        self._feature = 0
        self._lines = self._bytes = 0  # read so far
        self._speed = self._stored_speed = 1.0
        self._flow: dict[int | None, float] = {None: 1.0}  # by tool
        self.found = found or read_limits(*_read_ends(file), given, settings)
        self.state = MachineState(
            volumetric=self.found.volumetric, diameters=self.found.diameters, firmware=self.found.rule_of_e
        )
        self._limits: list[Limits] = [self.found.limits]

    def __iter__(self) -> Iterator[tuple[Steps, MotionPlan]]:
        """Read the file from the beginning and yield moves with their plan."""
        for table in self.tables():
            yield self.follow(table)
        yield self.rest()

    def tables(self, batch: int | None = None) -> Iterator[GcodeTable]:
        """Read the file from the beginning, `batch` bytes at a time, for callers who follow each table."""
        self._file.seek(0)
        state = self.state
        for data in _read_batches(self._file, batch or BATCH):
            table = read_table(data, state)
            state = table.after
            yield table

    def follow(self, table: GcodeTable) -> tuple[Steps, MotionPlan]:
        """Take the next lines of the file, for callers who read it themselves, and plan the moves that are settled."""
        self.state = table.after
        orders = self._apply_commands(table)
        which, layer, self._feature = self._read_tags(table, self._feature)
        steps = self._take_moves(table, orders, which, layer)
        self._lines += len(table)
        self._bytes += len(table.data)
        if not len(steps):
            return steps, EMPTY_PLAN
        self.moved = True
        waiting = concatenate_rows([self._waiting, steps]) if self._waiting is not None else steps
        settled, plan, self._entry = plan_settled(waiting.moves, self._limits, self._entry, ends=False)
        self._waiting = slice_rows(waiting, slice(settled, None))
        return slice_rows(waiting, slice(settled)), plan

    def rest(self) -> tuple[Steps, MotionPlan]:
        """Plan the remaining moves at the end of the file.

        Raises
        ------
        FormatError
            If the file has no moves.
        """
        if self._waiting is None:
            raise FormatError(self.trouble or "the file has no moves; give a file of G-code that a slicer wrote")
        _, plan, _ = plan_settled(self._waiting.moves, self._limits, self._entry, ends=True)
        return self._waiting, plan

    @property
    def limits(self) -> list[Limits]:
        """The limits that the moves so far were planned with, in the order in which `Moves.setting` counts them."""
        return list(self._limits)

    @property
    def trouble(self) -> str:
        """Message about a file without a readable line that extrudes; "" if every line was read."""
        if not self.unread.lines:
            return ""
        return (
            f"no line that extrudes can be read: {self.unread.lines} are not understood, the first is line "
            f"{self.unread.first}, {self.unread.text!r}; slice it for Marlin or Klipper"
        )

    def _apply_commands(self, table: GcodeTable) -> _Orders:
        """Apply the commands of a table; return their requests by line."""
        setting = np.full(len(table), self._number_limits(self.found.limits), dtype=np.intp)
        stop, pause = np.zeros(len(table), dtype=bool), np.zeros(len(table))
        retractions = np.zeros(len(table), dtype=np.intp)
        speed, flow = np.full(len(table), self._speed), np.full(len(table), self._flow_of(table.before.tool))
        tool = table.before.tool
        unread = np.flatnonzero(table.unread).tolist()
        for command in table.commands:
            code, line = command.code, command.line
            if code in LIMITING_CODES:
                self.found = self.found.after(code, table.text(line, line + 1))
                setting[line:] = self._number_limits(self.found.limits)
            elif code in STOPS:
                stop[line] = True
            if code in self.found.macros:
                self.found = self.found.after_macro(code)
                setting[line:] = self._number_limits(self.found.limits)
            if (seconds := self.found.macro_seconds.get(code)) is not None:
                self.macro_seconds[code] = self.macro_seconds.get(code, 0.0) + seconds
                pause[line], stop[line] = seconds, True
            match code:
                case "G4":
                    words = command.words
                    pause[line] += max(words.get("S") or 0.0, 0.0) + max(words.get("P") or 0.0, 0.0) / 1000
                case "G10" | "G11":
                    back = firmware_retraction(command, table.before.firmware)
                    retractions[line] = back is True and not self._drawn_back
                    if back is not None and back != self._drawn_back:
                        pause[line] += self.found.retraction[not back]
                        self._drawn_back = back
                case "M220":
                    speed[line:] = self._apply_m220(command)
                case "M221":
                    share = command.words.get("S")
                    if share is not None and 0 < share < MAX_PERCENT:
                        of = command.words.get("T", command.words.get("D"))
                        self._flow[None if of is None else int(of)] = share / 100
                    flow[line:] = self._flow_of(tool)
                case _ if code[:1] == "T" and code[1:].isdigit():
                    tool = int(code[1:])
                    flow[line:] = self._flow_of(tool)
                case _ if is_macro(code) and seconds is None:
                    if len(self.macros) < MAX_MACROS:
                        self.macros[code] = None
            if code == "M101" and not table.after.letters and not table.unread[line]:
                unread.append(line)
        self._count(table, unread)
        return _Orders(setting=setting, stop=stop, pause=pause, retractions=retractions, speed=speed, flow=flow)

    def _apply_m220(self, command: GcodeCommand) -> float:
        """Apply M220: S, per cent of all feed rates; B saves the factor, R restores it; return the factor."""
        if "B" in command.words:
            self._stored_speed = self._speed
        share = command.words.get("S")
        if share is not None and 0 < share < MAX_PERCENT:
            self._speed = share / 100
        if "R" in command.words:
            self._speed = self._stored_speed
        return self._speed

    def _flow_of(self, tool: int) -> float:
        """Return the flow factor of a tool, or that of all tools."""
        return self._flow.get(tool, self._flow[None])

    def _count(self, table: GcodeTable, unread: list[int]) -> None:
        """Count lines that may move and are not planned."""
        if not unread:
            return
        first_line, text = self.unread.first, self.unread.text
        if not self.unread.lines:
            line = min(unread)
            first_line = self._lines + line + 1
            text = table.text(line, line + 1)[:MAX_SHOWN_BYTES].decode("utf-8", "replace").strip()
        self.unread = UnreadLines(lines=self.unread.lines + len(unread), first=first_line, text=text)

    def _number_limits(self, limits: Limits) -> int:
        """Return the number of these limits, which are remembered if they are new."""
        if limits not in self._limits:
            self._limits.append(limits)
        return self._limits.index(limits)

    def _read_tags(self, table: GcodeTable, feature: int) -> tuple[NDArray[np.intp], NDArray[np.intp], int]:
        """Count layers and add features by the tags; return feature and layer of every line, and the last feature."""
        lines, features, layers = [0], [feature], [self.layers]
        for line in _find_comments(table, TAG_PREFIXES):
            tag = parse_tag(table.text(line, line + 1)[:MAX_TAG_BYTES])
            if tag is None:
                continue
            if tag[0] == "role":
                if tag[1] not in self.features:
                    self.features.append(tag[1])
                feature = self.features.index(tag[1])
            elif tag[0] == "layer":
                self.layers += 1
            else:
                continue
            lines.append(line)
            features.append(feature)
            layers.append(self.layers)
        count = np.diff([*lines, len(table)])
        return np.repeat(features, count), np.repeat(layers, count), feature

    def _take_moves(
        self, table: GcodeTable, orders: _Orders, feature: NDArray[np.intp], layer: NDArray[np.intp]
    ) -> Steps:
        """Return the moves of the lines, arcs as chords; each move takes the stops and pauses since the one before."""
        place = np.stack([table.x, table.y, table.z])
        start_place = np.array([table.before.x, table.before.y, table.before.z])
        before = np.concatenate([start_place[:, None], place[:, :-1]], axis=1)
        if np.isnan(start_place).any():  # from home, where the file has not stated a position yet
            travel = fill_missing(place, 0.0) - fill_missing(before, 0.0)
        else:
            travel = place - before
        filament = table.filament * orders.flow
        odd = table.kind == ODD
        going = ((table.kind == MOVE) | (odd & (table.code < 2))) & ((travel != 0).any(axis=0) | (filament != 0))
        line = np.flatnonzero(going)
        begin, delta, pushed = before[:, line].T, travel[:, line].T, filament[line]
        arcs = (table.kind == ARC) | (odd & (table.code > 1) & ~table.unread)
        if arcs.any():
            bent = np.flatnonzero(arcs)
            which, start, way, share = chords_of_arc_lines(
                table, bent, fill_missing(before[:, bent].T, 0.0), fill_missing(place[:, bent].T, 0.0)
            )
            order = np.argsort(np.concatenate([line, bent[which]]), kind="stable")
            line = np.concatenate([line, bent[which]])[order]
            begin, delta = np.concatenate([begin, start])[order], np.concatenate([delta, way])[order]
            pushed = np.concatenate([pushed, filament[bent[which]] * share])[order]
            moving = delta.any(axis=1) | (pushed != 0)
            line, begin, delta, pushed = line[moving], begin[moving], delta[moving], pushed[moving]
        dwelt, halts, retractions = (
            _sum_since_move(column, line) for column in (orders.pause, orders.stop, orders.retractions)
        )
        rest_line = line[-1] if len(line) else 0
        if len(line):
            dwelt[0] += self.pause
            halts[0] += self._stopped
            retractions[0] += self.retractions
            self.pause, self._stopped, self.retractions = 0.0, False, 0
        self.pause += float(orders.pause[rest_line:].sum())
        self._stopped = self._stopped or bool(orders.stop[rest_line:].any())
        self.retractions += int(orders.retractions[rest_line:].sum())
        moves = Moves(
            delta=np.column_stack([delta, pushed]),
            feedrate=table.f[line] / 60 * orders.speed[line],
            setting=orders.setting[line],
            stop=halts > 0,
        )
        return Steps(
            moves=moves,
            start=begin,
            feature=feature[line],
            layer=layer[line],
            pause=dwelt.astype(np.float64),
            retractions=retractions.astype(np.intp),
            section=table.section[line],
            place=self._bytes + table.start[line],
        )


def _find_comments(table: GcodeTable, beginnings: Sequence[int]) -> list[int]:
    """Return the comments that begin with one of several words of four bytes."""
    lines = np.flatnonzero(table.kind == COMMENT)
    text = np.frombuffer(table.data, dtype=np.uint8)
    lines = lines[table.start[lines] + TAG_BYTES <= len(text)]
    begin = table.start[lines]
    words = sum(text[begin + byte].astype(np.int64) << (8 * byte) for byte in range(TAG_BYTES))
    return [int(line) for line in lines[np.isin(words, beginnings)]]


def _sum_since_move(values: NDArray[Any], line: NDArray[np.intp]) -> NDArray[Any]:
    """Sum the values of the lines up to each move, since the previous move."""
    if not values.any():
        return np.zeros(len(line), dtype=np.result_type(values, np.intp))
    return np.diff(np.concatenate([[0], np.cumsum(values)])[line], prepend=0)


def _read_ends(file: BinaryIO) -> tuple[bytes, bytes]:
    """Return the beginning and the end of a file; raise FormatError if it is empty or binary."""
    size = file.seek(0, 2)
    file.seek(0)
    head = file.read(ENDS)
    file.seek(max(size - ENDS, 0))
    if not head.strip():
        raise FormatError("the file is empty; give a file of G-code")
    if b"\0" in head:
        raise FormatError("the file is not text; give a file of G-code that a slicer wrote")
    return head, file.read()


def _read_batches(file: BinaryIO, batch: int) -> Iterator[bytes]:
    """Yield the file in batches of whole lines."""
    rest = b""
    while data := file.read(batch):
        complete = data.rfind(b"\n") + 1
        if complete:
            yield rest + data[:complete]
            rest = data[complete:]
        else:
            rest += data
    if rest:
        yield rest
