"""Layers of a print: their lines, the strokes of their infill, their other beads, and their regions."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import BinaryIO

import numpy as np

from infill.arrays import Floats, Places
from infill.gcode.arcs import find_arcs, path_steps
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import SKIN_ROLES, WALL_ROLES, LineMarks, is_printing
from infill.gcode.strokes import CHORD_SAGITTA, InfillStrokes, mark_text, read_strokes
from infill.gcode.survey import Survey
from infill.gcode.table import GcodeTable
from infill.paths.contact import STEP, Samples, sample_paths
from infill.paths.neighbours import BeadIndex, index_beads
from infill.ragged import select_rows, split_rows
from infill.refilling.regions import BEAD_STEP, INFILL_STEP, FreeAreas, LayerBeads, find_region

LINE_WIDTH = 0.45  # mm, where no tag gives it
LEAST_SPEED = 1.0  # mm/s
WALL_STEP = 0.2  # mm between points on other beads, for the corners beside them
ENOUGH_INFILL = 1000.0  # mm of infill in a layer
MOST_BATCHES = 8  # of a print that are sampled, if none of its survey holds infill


@dataclass(frozen=True, kw_only=True)
class LayerPaths:
    """Paths of some layers.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
    layer : (M,) int
    """

    points: Floats
    first: Places
    layer: Places

    def of(self, number: int) -> tuple[Floats, Places]:
        """Return the paths of one layer: their points, and where each begins."""
        places, first = select_rows(self.first, np.flatnonzero(self.layer == number))
        return self.points[places], first


@dataclass(frozen=True, kw_only=True)
class Layers:
    """Consecutive complete layers of a print, read at once.

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

    def of(self, number: int) -> Layer:
        """Return one of the layers."""
        return Layer(layers=self, number=number)

    def __iter__(self) -> Iterator[Layer]:
        """Yield the layers that hold infill."""
        return map(self.of, np.unique(self.layer).tolist())

    @cached_property
    def upper(self) -> list[Layer]:
        """Layers with infill, without the lowest unless it is the only one: the layer below it is unknown."""
        lowest, layers = int(self.marks.layer.min()), list(self)
        return [layer for layer in layers if layer.number > lowest] or layers[-1:]

    @cached_property
    def typical(self) -> list[Layer]:
        """The `upper` layers, or the last of them alone if it has much infill, to stand for all."""
        return self.upper[-1:] if self.upper and self.upper[-1].length > ENOUGH_INFILL else self.upper

    @cached_property
    def layer(self) -> Places:
        """Layer of each stroke, (M,)."""
        return self.marks.layer[self.infill.opens]

    @cached_property
    def section(self) -> Places:
        """Section of each stroke, (M,)."""
        return self.marks.section[self.infill.opens]

    @cached_property
    def paths(self) -> LayerPaths:
        """The infill."""
        return LayerPaths(points=self.infill.points, first=self.infill.first, layer=self.layer)

    @cached_property
    def feed(self) -> Floats:
        """Feed rate of each stroke, (M,), mm/min."""
        return self.table.f[self.infill.opens]

    @cached_property
    def speed(self) -> Floats:
        """Speed of each stroke, (M,), mm/s."""
        return np.maximum(self.feed / 60, LEAST_SPEED)

    @cached_property
    def line_width(self) -> float:
        """Median width of the infill, mm."""
        width = self.marks.width[self.infill.opens]
        return float(np.median(np.where(np.isnan(width), LINE_WIDTH, width))) if len(width) else LINE_WIDTH

    def acceleration(self, otherwise: float) -> Floats:
        """Return the acceleration of each stroke, (M,), mm/s²; `otherwise` where the print commands none."""
        commanded = self.marks.acceleration[self.infill.opens]
        return np.where(np.isnan(commanded), otherwise, commanded)

    @cached_property
    def tools(self) -> Places:
        """The tool in use on every line."""
        tools = np.full(len(self.table), self.table.before.tool)
        for command in self.table.commands:
            if command.code[:1] == "T" and command.code[1:].isdigit():
                tools[command.line :] = int(command.code[1:])
        return tools

    @cached_property
    def steps(self) -> Floats:
        """Length of the path of each line of the table, (N,), mm."""
        return path_steps(self.table)

    @cached_property
    def seconds(self) -> Floats:
        """Time of each layer at its feed rates, from the first on, without acceleration, as slicers count."""
        layer = self.marks.layer
        seconds = np.nan_to_num(self.steps / (self.table.f / 60))
        return np.bincount(layer - layer[0], weights=seconds).astype(np.float64)

    @cached_property
    def bead_lines(self) -> tuple[Floats, Places]:
        """Other moves that extrude, arcs as chords: both ends of each, (K, 2, 2), mm, and their lines, (K,)."""
        table = self.table
        prints = is_printing(table)
        prints[self.infill.moves] = False
        line = np.flatnonzero(prints)
        previous = line - 1
        x = np.where(previous >= 0, table.x[previous], table.before.x)
        y = np.where(previous >= 0, table.y[previous], table.before.y)
        ends = np.stack([x, y, table.x[line], table.y[line]], axis=1).reshape(-1, 2, 2)
        arcs = find_arcs(table)
        arcs = arcs.select(prints[arcs.line])
        if len(arcs):
            chord, chord_line = arcs.chords(CHORD_SAGITTA)
            straight = ~np.isin(line, arcs.line)
            line = np.concatenate([line[straight], chord_line])
            order = np.argsort(line, kind="stable")
            line, ends = line[order], np.concatenate([ends[straight], chord])[order]
        finite = np.isfinite(ends).all(axis=(1, 2))
        return ends[finite], line[finite]

    @cached_property
    def bead_layer(self) -> Places:
        """Layer of each of these moves, (K,), ascending."""
        return self.marks.layer[self.bead_lines[1]]

    def bead_samples(self, number: int, step: float = STEP) -> Samples:
        """Return samples of the other beads of a layer, at most `step` apart, mm."""
        ends = self.of(number).bead_ends
        return sample_paths(ends.reshape(-1, 2), np.arange(len(ends) + 1) * 2, step)

    def walls(self) -> BeadIndex:
        """Index the other beads of all layers with infill."""
        chosen = np.flatnonzero(np.isin(self.bead_layer, self.layer))
        ends = self.bead_lines[0][chosen].reshape(-1, 2)
        samples = sample_paths(ends, np.arange(len(chosen) + 1) * 2, WALL_STEP)
        return index_beads(samples.points, self.bead_layer[chosen][samples.path])


@dataclass(frozen=True, kw_only=True)
class Layer:
    """One layer: its infill, its other beads, and its region.

    Parameters
    ----------
    layers : Layers
        Those that it was read with.
    number : int
    """

    layers: Layers
    number: int

    @cached_property
    def strokes(self) -> Places:
        """The strokes of its infill."""
        return np.flatnonzero(self.layers.layer == self.number)

    @cached_property
    def paths(self) -> tuple[Floats, Places]:
        """Its infill: the points of all paths, and where each begins."""
        return self.layers.paths.of(self.number)

    def paths_of(self, sections: Sequence[int]) -> list[Floats]:
        """Return the paths of some of its sections, (N, 2) each, mm."""
        infill = self.layers.infill
        places, first = select_rows(infill.first, self.strokes[np.isin(self.layers.section[self.strokes], sections)])
        return [path for path in split_rows(infill.points[places], first) if len(path) > 1]

    @property
    def length(self) -> float:
        """Length of its infill, mm."""
        return float(self.layers.infill.length[self.strokes].sum())

    @property
    def z(self) -> float:
        """Height of its infill, mm."""
        return float(self.layers.table.z[self.layers.infill.opens[self.strokes[0]]])

    @property
    def height(self) -> float:
        """Median height of its beads, mm; NaN where no tag gives it."""
        return float(np.median(self.layers.marks.height[self.layers.infill.opens[self.strokes]]))

    @cached_property
    def bead_ends(self) -> Floats:
        """Both ends of its other beads, (K, 2, 2), mm."""
        return self.layers.bead_lines[0][self._beads]

    @cached_property
    def _beads(self) -> slice:
        """Rows of its other beads among those of all layers."""
        return slice(*np.searchsorted(self.layers.bead_layer, [self.number, self.number + 1]))

    @cached_property
    def beads(self) -> LayerBeads:
        """Points on its other beads, and both ends of each, which stick out where lines turn."""
        samples, ends, marks = (
            self.layers.bead_samples(self.number, BEAD_STEP),
            self.bead_ends.reshape(-1, 2),
            self.layers.marks,
        )
        role = marks.role[self.layers.bead_lines[1][self._beads]]
        skin, wall = (
            np.isin(role, [place for place, name in enumerate(marks.roles) if name in roles])
            for roles in (SKIN_ROLES, WALL_ROLES)
        )
        return LayerBeads(
            points=np.concatenate([samples.points, ends]),
            skin=np.append(skin[samples.path], np.repeat(skin, 2)),
            wall=np.append(wall[samples.path], np.repeat(wall, 2)),
            half=np.concatenate([samples.half, np.zeros(ends.shape)]),
        )

    def find_region(self, below: FreeAreas | None) -> FreeAreas:
        """Find the region of its infill; `below` is that of the previous layer, which it may have too."""
        infill = sample_paths(*self.paths, INFILL_STEP)
        return find_region(self.beads, infill, below, line_width=self.layers.line_width)


def read_layers(file: BinaryIO, begin: MachineState | None = None) -> Iterator[Layers]:
    """Yield the layers of a print, from the position of the file to its end; `begin` is the state before."""
    for table, marks, infill in read_strokes(file, begin):
        yield Layers(table=table, marks=marks, infill=infill)


def sample_layers(print_survey: Survey, file: BinaryIO) -> list[Layers]:
    """Read the layers of a survey that hold infill; if none does, the first ones of the print.

    Parameters
    ----------
    print_survey : Survey
    file : binary file
        The print. Its survey may miss infill that only a few layers have, and misses that of the last layer.
    """
    samples = [mark_text(text, replace(print_survey.begin, z=z)) for text, z in print_survey.windows]
    layers = [Layers(table=table, marks=marks, infill=infill) for table, marks, infill in samples]
    kept = [window for window in layers if window.typical]
    if kept:
        return kept
    file.seek(0)
    with_infill = (batch for batch in read_layers(file, print_survey.begin) if batch.typical)
    return list(itertools.islice(with_infill, MOST_BATCHES))
