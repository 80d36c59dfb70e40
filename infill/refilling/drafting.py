"""Draw a print from its first layer to its last, and again if it misses its targets.

Sampled layers give a first estimate of the moves of corners and of the cell. The complete drawing decides on support
and contact and, in a small print, on the filament.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import BinaryIO

import numpy as np

from infill.arrays import Floats
from infill.errors import FormatError
from infill.files.whole_files import wrap_os_errors
from infill.gcode.estimates import find_estimates
from infill.gcode.machine_state import MachineState
from infill.gcode.sliced_file import SlicedText
from infill.gcode.survey import Survey
from infill.kernels.threads import in_order, thread_count
from infill.planner.open_timeline import make_timeline
from infill.planner.print_clock import PrintClock, path_seconds
from infill.refilling.even_drawing import EvenDrawing
from infill.refilling.even_layers import LEAST_WIDTH, MOST_WIDTH, measure_layers_of
from infill.refilling.layers import Layers, read_layers
from infill.refilling.planning import RefillPlan
from infill.refilling.replace import LayerMemory, replace_infill
from infill.refilling.request import AUTO, KEEP, Progress
from infill.refilling.rules import RefillRules
from infill.refilling.smooth_in_place import smooth_in_place
from infill.refilling.stats import NewInfill, RefillStats, count_refill
from infill.refilling.support import LEAST_SHARE, kept_length_share, kept_shares, measure_layers, smaller_deviation
from infill.refilling.widest_gap import GapMemory

PROGRESS_BYTES = 1 << 22  # bytes between two reports of progress
MOST_REDRAWS = 3  # times that a print is redrawn with smaller moves of corners
MOST_CELL_TRIES = 6  # times that a small print is redrawn at another cell
MOST_CELL_TRIES_IF_LARGE = 2  # a try takes as long as the first drawing
MOST_PRINT_TRIES = 4  # times that a print is redrawn with a pattern that follows it
LITTLE = 0.04  # relative error of its filament that beads make up for
FILAMENT_TOLERANCE = 0.005  # relative tolerance of the filament of all infill
FILAMENT_TOLERANCE_IF_LARGE = 0.01  # what refill promises of a print
MOST_THREADS = 4  # more threads would only take memory: a single one reads for all of them


@dataclass(frozen=True, kw_only=True)
class Drafting:
    """A print that is drawn into a draft, as often as its targets need.

    Parameters
    ----------
    file, draft : binary files
    begin : MachineState
        The state before the file, in which every drawing begins.
    print_survey : Survey
    progress : callable, optional
    gaps : GapMemory
    """

    file: BinaryIO
    begin: MachineState
    draft: BinaryIO
    print_survey: Survey
    progress: Progress | None
    gaps: GapMemory = field(default_factory=GapMemory)

    def meet_targets(
        self, rules: RefillRules, plan: RefillPlan | None, clock: PrintClock | None = None
    ) -> tuple[RefillStats, RefillRules, RefillPlan | None]:
        """Draw the print until it meets its targets; return the statistics, the final rules and the final plan.

        Parameters
        ----------
        rules : RefillRules
        plan : RefillPlan, optional
            Of a new pattern; None for the slicer's own paths.
        clock : PrintClock, optional
            Receives the lines of the file as they are read.

        Raises
        ------
        FormatError
            If no layer is marked.
        OutputError
            If the draft cannot be written.
        """
        stats = self.draw(rules, plan, clock)
        if plan is not None and not plan.fixed:
            if plan.scale is not None:
                stats, plan = self._match_print(stats, rules, plan, plan.scale)
            elif plan.density is None:
                stats, plan = self._match_filament(stats, rules, plan)
        previous = 0.0
        for _ in range(MOST_REDRAWS if rules.request.pattern == KEEP and rules.request.smooth_radius == AUTO else 0):
            length = kept_length_share(stats.infill.length, stats.infill_after.length)
            share = min(*kept_shares(stats.before, stats.after), length)
            smaller = smaller_deviation(rules.rounding.deviation, share, previous)
            if smaller == rules.rounding.deviation:
                break
            previous, rules = share, rules.rounded_by(smaller)
            stats = self.draw(rules, plan)
        else:  # all redraws are used up
            if previous and kept_length_share(stats.infill.length, stats.infill_after.length) < LEAST_SHARE:
                rules = rules.rounded_by(0.0)
                stats = self.draw(rules, plan)
        return stats, rules, plan

    def even_out(
        self, stats: RefillStats, rules: RefillRules, plan: RefillPlan, clock: PrintClock, sliced: SlicedText
    ) -> RefillStats:
        """Draw the print again, with even layers, if that is requested; return the statistics.

        Parameters
        ----------
        stats : RefillStats
            Of the last drawing, by `rules` and `plan`.
        rules : RefillRules
        plan : RefillPlan
        clock : PrintClock
            Of the print as sliced.
        sliced : SlicedText
        """
        by, begin = rules.request.even, self.print_survey.begin
        if by is None:
            return stats

        def measure(text: BinaryIO) -> Floats:
            """Measure seconds or filament of every layer of a text."""
            return measure_layers_of(make_timeline(sliced, text, found=clock.found), text, by)

        drawing = EvenDrawing(
            by=by,
            leeway=rules.request.allowed_leeway,
            draw=lambda plan: self.draw(rules, plan),
            measure=lambda: measure(self.draft),
            section=math.pi / 4 * begin.diameter**2 if begin.volumetric else 1.0,
        )
        return drawing.even_out(stats, plan, measure(self.file))

    def _match_filament(
        self, stats: RefillStats, rules: RefillRules, plan: RefillPlan
    ) -> tuple[RefillStats, RefillPlan]:
        """Redraw a print at other cells until its infill takes the old amount of filament; else at the best cell.

        In a large print, later layers make up for the excess or shortage of earlier ones in most cases, and drawing
        takes long: so a larger error is left, and fewer cells are tried.
        """
        is_small = self.print_survey.small
        tries = MOST_CELL_TRIES if is_small else MOST_CELL_TRIES_IF_LARGE
        tolerance = FILAMENT_TOLERANCE if is_small else FILAMENT_TOLERANCE_IF_LARGE
        best, smallest_error, current = plan, abs(stats.filament_error), plan
        errors: dict[float, float] = {}  # relative error of the filament, by cell
        for _ in range(tries):
            error = errors[current.cell] = stats.filament_error
            if abs(error) <= tolerance:
                return stats, current
            # The filament jumps with the cell: try between two that take too much and too little, if both exist.
            opposite = [cell for cell, cell_error in errors.items() if cell_error * error < 0]
            nearest = min(opposite, key=lambda cell: abs(cell - current.cell), default=0.0)
            current = current.with_cell(math.sqrt(nearest * current.cell) if nearest else current.cell * (1 + error))
            stats = self.draw(rules, current)
            if abs(stats.filament_error) < smallest_error:
                best, smallest_error = current, abs(stats.filament_error)
        return stats if current is best else self.draw(rules, best), best

    def _match_print(
        self, stats: RefillStats, rules: RefillRules, plan: RefillPlan, scale: float
    ) -> tuple[RefillStats, RefillPlan]:
        """Redraw a pattern that follows the print until all of it takes the filament asked for.

        Another cell where much is missing or too much, then wider or narrower beads in all layers alike.
        """
        for attempt in range(MOST_PRINT_TRIES):
            error, last = stats.placed_error, attempt == MOST_PRINT_TRIES - 1
            if abs(error) <= FILAMENT_TOLERANCE:
                break
            if abs(error) <= LITTLE or last:
                scale = min(max(scale / (1 + error), LEAST_WIDTH), MOST_WIDTH)
                plan = replace(plan, scale=scale)
            else:
                plan = plan.with_cell(plan.cell * (1 + error))
            stats = self.draw(rules, plan)
        return stats, plan

    def draw(self, rules: RefillRules, plan: RefillPlan | None, clock: PrintClock | None = None) -> RefillStats:
        """Write the new text to the draft, once."""
        self.file.seek(0)
        self.draft.seek(0)
        self.draft.truncate()
        total, memory, below, tags = RefillStats(), LayerMemory(), None, None
        bytes_read = shown = 0

        def refill_next(layers: Layers) -> tuple[NewInfill, RefillStats]:
            """Refill the next layers, and count them."""
            infill = layers.infill
            acceleration = layers.acceleration(rules.acceleration)
            seconds = path_seconds(infill.points, infill.first, layers.speed, acceleration)
            if plan is not None:
                new = replace_infill(layers, rules, plan, memory)
            elif len(infill):
                new = smooth_in_place(layers, rules, seconds, self.gaps)
            else:
                new = NewInfill.unchanged(layers, {})
            return new, count_refill(layers, new, seconds)

        # New paths continue those of the layer below, so that layers come one after another.
        threads = min(thread_count(), MOST_THREADS) if plan is None else 1
        with wrap_os_errors(Path("a temporary file")):
            for layers, (new, stats) in in_order(refill_next, read_layers(self.file, self.begin), threads=threads):
                if clock is not None:
                    clock.add(layers.table)
                stats.before, stats.after, below = measure_layers(
                    layers.paths,
                    new.paths,
                    layers.bead_samples,
                    np.unique(layers.marks.layer),
                    line_width=layers.line_width,
                    stride=rules.stride,
                    last=below,
                )
                total.add(stats)
                for begin_byte, end_byte in find_estimates(new.text):
                    total.lines.append((self.draft.tell() + begin_byte, new.text[begin_byte:end_byte]))
                self.draft.write(new.text)
                tags = layers.marks.after
                bytes_read += len(layers.table.data)
                if self.progress is not None and bytes_read >= shown:
                    self.progress("drawing infill", bytes_read / max(self.print_survey.size, 1))
                    shown = bytes_read + PROGRESS_BYTES
            self.draft.flush()
        total.densities = () if plan is None or plan.graded is None else plan.graded.averaged_range
        total.placed_error = memory.taken / memory.asked - 1 if memory.asked else 0.0
        if tags is None or not tags.layer:
            raise FormatError(
                "the file has no marked layers; give the G-code of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio "
                "or Cura, with its comments"
            )
        return total
