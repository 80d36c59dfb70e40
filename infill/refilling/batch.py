"""Batches of complete layers of a print: their lines, marks and infill."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.gcode.sections import (
    SKIN_ROLES,
    SPARSE,
    InfillStrokes,
    LineMarks,
    TagState,
    find_strokes,
    is_printing,
    mark_lines,
)
from infill.gcode.stream import batches
from infill.gcode.table import GcodeTable, MachineState, read_table
from infill.paths.neighbours import BeadMoves
from infill.refilling.measuring import LayerPaths

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LINE_WIDTH = 0.45  # mm, where no tag gives it
LEAST_SPEED = 1.0  # mm/s


@dataclass(frozen=True, kw_only=True)
class Batch:
    """Complete layers of a print.

    Parameters
    ----------
    table : GcodeTable
    marks : LineMarks
    infill : InfillStrokes
        M strokes of sparse infill.
    """

    table: GcodeTable
    marks: LineMarks
    infill: InfillStrokes

    @cached_property
    def layer(self) -> Places:
        """Of each stroke, (M,)."""
        return self.marks.layer[self.infill.opens]

    @cached_property
    def section(self) -> Places:
        """Of each stroke, (M,)."""
        return self.marks.section[self.infill.opens]

    @cached_property
    def sections(self) -> Places:
        """All sections of sparse infill, ascending: also those without strokes."""
        return self._printing_sections(self.marks.is_role(SPARSE) | self.marks.purged)

    @cached_property
    def purged_sections(self) -> Places:
        """The sections that take purged filament, ascending."""
        return self._printing_sections(self.marks.purged)

    def _printing_sections(self, lines: NDArray[np.bool_]) -> Places:
        """Return the sections in which some lines print."""
        return np.unique(self.marks.section[lines & is_printing(self.table)])

    @cached_property
    def speed(self) -> Floats:
        """Of each stroke, (M,), mm/s."""
        return np.maximum(self.table.f[self.infill.opens] / 60, LEAST_SPEED)

    @cached_property
    def drawing(self) -> LayerPaths:
        """The infill."""
        return LayerPaths(points=self.infill.points, first=self.infill.first, layer=self.layer)

    @cached_property
    def others(self) -> BeadMoves:
        """All beads except the infill."""
        return other_beads(self.table, self.marks, self.infill)

    @cached_property
    def line_width(self) -> float:
        """Median width of the infill, mm."""
        width = self.marks.width[self.infill.opens]
        return float(np.median(np.where(np.isnan(width), LINE_WIDTH, width))) if len(width) else LINE_WIDTH

    def acceleration(self, otherwise: float) -> Floats:
        """Return the acceleration of each stroke, (M,), mm/s²; `otherwise` where the print commands none."""
        commanded = self.marks.acceleration[self.infill.opens]
        return np.where(np.isnan(commanded), otherwise, commanded)


def mark_batch(table: GcodeTable, tags: TagState) -> Batch:
    """Mark the lines of a table and find its infill; `tags` are those before it."""
    marks = mark_lines(table, tags)
    return Batch(table=table, marks=marks, infill=find_strokes(table, marks))


def read_batches(file: BinaryIO, begin: MachineState | None = None) -> Iterator[Batch]:
    """Yield a print in batches, from the position of the file to its end; `begin` is the state before."""
    state, tags = begin or MachineState(), TagState()
    for text in batches(file):
        batch = mark_batch(read_table(text, state), tags)
        yield batch
        state, tags = batch.table.after, batch.marks.after


def other_beads(table: GcodeTable, marks: LineMarks, infill: InfillStrokes) -> BeadMoves:
    """Return the beads that are not among the strokes of infill."""
    prints = (table.extruded > 0) & (table.given[:, 0] | table.given[:, 1])
    prints[infill.moves] = False
    line = np.flatnonzero(prints)
    previous = line - 1
    x = np.where(previous >= 0, table.x[previous], table.before.x)
    y = np.where(previous >= 0, table.y[previous], table.before.y)
    ends = np.stack([x, y, table.x[line], table.y[line]], axis=1).reshape(-1, 2, 2)
    finite = np.isfinite(ends).all(axis=(1, 2))
    skin = np.isin(marks.role, [place for place, role in enumerate(marks.roles) if role in SKIN_ROLES])
    return BeadMoves(ends=ends[finite], layer=marks.layer[line][finite], skin=skin[line][finite])
