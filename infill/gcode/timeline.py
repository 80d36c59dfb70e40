"""A file of G-code as a stream of planned moves: where each goes, for which feature, and how long it takes.

The file is read in batches; what the planner has not settled yet waits for the next, so memory does not grow with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.gcode.bounds import Floats, Moves
from infill.gcode.chords import chords
from infill.gcode.columns import chained, part
from infill.gcode.dialect import tag_of
from infill.gcode.found_limits import FoundLimits, found_limits
from infill.gcode.limits import LIMITING_CODES, Limits
from infill.gcode.lines import ARC, COMMENT, MOVE
from infill.gcode.planner import Plan, settle
from infill.gcode.table import State, Table, read

BATCH: Final = 1 << 22  # bytes
ENDS: Final = 1 << 18  # bytes at the beginning and the end that may hold settings
STOPS: Final = frozenset({"G4", "G10", "G11", "G28", "G29", "M0", "M1", "M109", "M190", "M400", "M600", "M601"})


@dataclass(frozen=True, kw_only=True)
class Steps:
    """Moves, and what they are for.

    Parameters
    ----------
    moves : Moves
    start : (N, 3) float64
        mm; NaN where the file has not said yet.
    feature : (N,) int
        Which of the names of `Timeline.features` is in force; 0 before the first.
    layer : (N,) int
        From 1; 0 before the first.
    pause : (N,) float64
        Seconds of dwelling before the move.
    """

    moves: Moves
    start: Floats
    feature: NDArray[np.intp]
    layer: NDArray[np.intp]
    pause: Floats

    def __len__(self) -> int:
        return len(self.layer)


class Timeline:
    """The moves of a file, batch by batch.

    Parameters
    ----------
    path : Path
    fixed : mapping, optional
        Fields of `Limits` that hold instead of what the file says.

    Raises
    ------
    FormatError
        If the file is none of plain G-code.
    """

    def __init__(self, path: Path, fixed: Mapping[str, Any] | None = None) -> None:
        self.path = path
        self.features: list[bytes] = [b""]
        self.layers = 0
        self.pause = 0.0  # seconds of dwelling since the last move
        self._stopped = False
        with _opened(path) as file:
            head, tail = _ends(file, path)
        self.found: FoundLimits = found_limits(head, tail, fixed)
        self._limits: list[Limits] = [self.found.limits]

    def __iter__(self) -> Iterator[tuple[Steps, Plan]]:
        """Read the file from the beginning and yield moves with their plan."""
        waiting: list[Steps] = []
        entry: float | None = None
        moved = False
        for steps in self._steps():
            if len(steps):
                moved = True
                waiting = [chained([*waiting, steps])]
                settled, plan, entry = settle(waiting[0].moves, self._limits, entry, ends=False)
                yield part(waiting[0], slice(settled)), plan
                waiting = [part(waiting[0], slice(settled, None))]
        if not moved:
            raise FormatError(f"{self.path.name} has no moves; give a file of G-code that a slicer wrote")
        settled, plan, _ = settle(waiting[0].moves, self._limits, entry, ends=True)
        yield waiting[0], plan

    def _steps(self) -> Iterator[Steps]:
        state, feature = State(), 0
        with _opened(self.path) as file:
            for data in _batches(file):
                table = read(data, state)
                state = table.after
                if state.inches:
                    raise FormatError(f"{self.path.name} is in inches (G20); slice it in millimetres")
                setting, stop, pause = self._obeyed(table)
                which, layer, feature = self._tagged(table, feature)
                yield self._moves(table, setting, stop, pause, which, layer)

    def _obeyed(self, table: Table) -> tuple[NDArray[np.intp], NDArray[np.bool_], Floats]:
        """Follow the commands; return by line the setting in force, whether it stops the machine, and for how long."""
        setting = np.full(len(table), self._number(self.found.limits), dtype=np.intp)
        stop, pause = np.zeros(len(table), dtype=bool), np.zeros(len(table))
        for command in table.commands:
            if command.code in LIMITING_CODES:
                self.found = self.found.after(command.code, table.text(command.line, command.line + 1))
                setting[command.line :] = self._number(self.found.limits)
            elif command.code in STOPS:
                stop[command.line] = True
            if command.code == "G4":
                words = command.words
                pause[command.line] = max(words.get("S") or 0.0, 0.0) + max(words.get("P") or 0.0, 0.0) / 1000
        return setting, stop, pause

    def _number(self, limits: Limits) -> int:
        if limits not in self._limits:
            self._limits.append(limits)
        return self._limits.index(limits)

    def _tagged(self, table: Table, feature: int) -> tuple[NDArray[np.intp], NDArray[np.intp], int]:
        """Return feature and layer of every line, and the last feature."""
        which, layer = np.full(len(table), feature), np.full(len(table), self.layers)
        for line in np.flatnonzero(table.kind == COMMENT).tolist():
            tag = tag_of(table.text(line, line + 1))
            if tag is None:
                continue
            if tag[0] == "role":
                if tag[1] not in self.features:
                    self.features.append(tag[1])
                which[line:] = feature = self.features.index(tag[1])
            elif tag[0] == "layer":
                self.layers += 1
                layer[line:] = self.layers
        return which, layer, feature

    def _moves(
        self,
        table: Table,
        setting: NDArray[np.intp],
        stop: NDArray[np.bool_],
        pause: Floats,
        feature: NDArray[np.intp],
        layer: NDArray[np.intp],
    ) -> Steps:
        """Return the lines that move something; stops and pauses go to the move that follows them."""
        place = np.column_stack([table.x, table.y, table.z])
        before = np.vstack([[table.before.x, table.before.y, table.before.z], place[:-1]])
        travel = np.nan_to_num(place) - np.nan_to_num(before)  # from home, where the file has not said a place yet
        going = (table.kind == MOVE) & (travel.any(axis=1) | (table.extruded != 0))
        line, first, delta = np.flatnonzero(going), before[going], travel[going]
        pushed = table.extruded[going]
        arcs = table.kind == ARC
        if arcs.any():
            bent = np.flatnonzero(arcs & ~np.isnan(before[:, :2]).any(axis=1))
            centre = before[bent, :2] + np.nan_to_num(np.column_stack([table.i[bent], table.j[bent]]))
            ends = np.nan_to_num(before[bent]), np.nan_to_num(place[bent])  # z may be unknown
            which, start, end = chords(*ends, centre, table.code[bent] == 2)
            long = np.linalg.norm(end - start, axis=1)
            share = long / np.maximum(np.bincount(which, weights=long, minlength=len(bent))[which], 1e-300)
            order = np.argsort(np.concatenate([line, bent[which]]), kind="stable")
            line = np.concatenate([line, bent[which]])[order]
            first, delta = np.concatenate([first, start])[order], np.concatenate([delta, end - start])[order]
            pushed = np.concatenate([pushed, table.extruded[bent[which]] * share])[order]
        dwelt = np.diff(np.concatenate([[0.0], np.cumsum(pause)])[line], prepend=0.0)
        halts = np.diff(np.concatenate([[0], np.cumsum(stop)])[line], prepend=0) > 0
        left = (pause[line[-1] :].sum(), stop[line[-1] :].any()) if len(line) else (pause.sum(), stop.any())
        if len(line):
            dwelt[0] += self.pause
            halts[0] |= self._stopped
            self.pause, self._stopped = 0.0, False
        self.pause, self._stopped = self.pause + float(left[0]), self._stopped or bool(left[1])
        moves = Moves(
            delta=np.column_stack([delta, pushed]), feedrate=table.f[line] / 60, setting=setting[line], stop=halts
        )
        return Steps(moves=moves, start=first, feature=feature[line], layer=layer[line], pause=dwelt)


def _opened(path: Path) -> BinaryIO:
    try:
        return path.open("rb")
    except OSError as error:
        raise FormatError(f"{path} cannot be read: {error.strerror or error}") from None


def _ends(file: BinaryIO, path: Path) -> tuple[bytes, bytes]:
    """Return the beginning and the end of a file, or raise FormatError if it is not plain G-code."""
    head = file.read(ENDS)
    size = file.seek(0, 2)
    file.seek(max(size - ENDS, 0))
    if not head.strip():
        raise FormatError(f"{path.name} is empty; give a file of G-code")
    if head.startswith(b"GCDE"):
        raise FormatError(
            f"{path.name} is binary G-code; export it again with binary G-code off, or convert it with bgcode"
        )
    if head.startswith(b"PK"):
        raise FormatError(f"{path.name} is a 3MF or another zip; give the G-code in it, such as Metadata/plate_1.gcode")
    if b"\0" in head:
        raise FormatError(f"{path.name} is not text; give a file of G-code that a slicer wrote")
    return head, file.read()


def _batches(file: BinaryIO) -> Iterator[bytes]:
    """Yield the file in batches of whole lines."""
    rest = b""
    while data := file.read(BATCH):
        whole = data.rfind(b"\n") + 1
        if whole:
            yield rest + data[:whole]
            rest = data[whole:]
        else:
            rest += data
    if rest:
        yield rest
