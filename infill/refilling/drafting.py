"""A print drawn from its first layer to its last, and once more where it fell short of what was promised.

Some layers told beforehand how far corners may move and how large cells are to be. All of them, drawn, have the last
word: of support and contact, and, in a small print, of the filament.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from infill.errors import FormatError
from infill.files.whole_files import told
from infill.gcode.estimates import estimates
from infill.gcode.survey import Survey
from infill.kernels.threads import in_order, thread_count
from infill.refilling.batch import Batch, read_batches
from infill.refilling.layers import Refilled, measured_contact, refilled
from infill.refilling.planning import Plan
from infill.refilling.repath import Memory
from infill.refilling.request import AUTO, KEEP, Progress
from infill.refilling.rules import Rules
from infill.refilling.stats import Tally
from infill.refilling.support import LEAST_SHARE, kept_length, kept_shares, smaller_deviation
from infill.refilling.timing import PrintClock

SHOWN = 1 << 22  # bytes between two reports of progress
AGAIN = 3  # times that a print is drawn anew, with corners that move less
EVENED = 6  # times that a small one is, at another cell
EVEN = 0.005  # of the filament of all infill, that it may be off
MOST_THREADS = 4  # more of them would only take memory: one reads what all the others draw


def drafted(
    file: BinaryIO,
    draft: BinaryIO,
    found: Survey,
    rules: Rules,
    plan: Plan | None,
    progress: Progress | None,
    clock: PrintClock | None = None,
) -> tuple[Tally, Rules]:
    """Write the new text to a draft, and return what was done, by which rules.

    Parameters
    ----------
    file, draft : binary files
    found : Survey
    rules : Rules
    plan : Plan, optional
        Of a pattern of ours; None for the slicer's own paths.
    progress : callable, optional
    clock : PrintClock, optional
        Takes the lines of the file as they are read.

    Raises
    ------
    FormatError
        If no layer is marked.
    OutputError
        If the draft cannot be written.
    """

    def drawn(rules: Rules, plan: Plan | None, clock: PrintClock | None = None) -> Tally:
        return _drawn(file, draft, found, rules, plan, progress, clock)

    tally = drawn(rules, plan, clock)
    if plan is not None and plan.density is None and not plan.fixed and found.small:
        tally = _evened(tally, plan, lambda other: drawn(rules, other))
    last = 0.0
    for _ in range(AGAIN if rules.request.pattern == KEEP and rules.request.smooth_radius == AUTO else 0):
        length = kept_length(tally.infill.length, tally.infill_after.length)
        kept = min(*kept_shares(tally.before, tally.after), length)
        smaller = smaller_deviation(rules.rounding.deviation, kept, last)
        if smaller == rules.rounding.deviation:
            break
        last, rules = kept, rules.rounded_by(smaller)
        tally = drawn(rules, plan)
    else:  # drawn again as often as may be
        if last and kept_length(tally.infill.length, tally.infill_after.length) < LEAST_SHARE:
            rules = rules.rounded_by(0.0)
            tally = drawn(rules, plan)
    return tally, rules


def _evened(tally: Tally, plan: Plan, again: Callable[[Plan], Tally]) -> Tally:
    """Draw a small print again, at other cells, until its infill takes the filament that it took; else at the best.

    In a large one, what a layer takes too much or too little is made up for in the next ones.
    """

    def off(some: Tally) -> float:
        return some.infill_after.filament / some.infill.filament - 1 if some.infill.filament else 0.0

    best, least, drawn = plan, abs(off(tally)), plan
    found: dict[float, float] = {}  # what was off, by cell
    for _ in range(EVENED):
        error = found[drawn.cell] = off(tally)
        if abs(error) <= EVEN:
            return tally
        # The filament jumps with the cell: between two cells that take too much and too little, if they are known.
        across = [cell for cell, other in found.items() if other * error < 0]
        nearest = min(across, key=lambda cell: abs(cell - drawn.cell), default=0.0)
        drawn = drawn.with_cell(math.sqrt(nearest * drawn.cell) if nearest else drawn.cell * (1 + error))
        tally = again(drawn)
        if abs(off(tally)) < least:
            best, least = drawn, abs(off(tally))
    return tally if drawn is best else again(best)


def _drawn(
    file: BinaryIO,
    draft: BinaryIO,
    found: Survey,
    rules: Rules,
    plan: Plan | None,
    progress: Progress | None,
    clock: PrintClock | None,
) -> Tally:
    """Write the new text to a draft."""
    file.seek(0)
    draft.seek(0)
    draft.truncate()
    tally, memory, below, tags = Tally(), Memory(), None, None
    begin = None if clock is None else clock.begin
    done = shown = 0

    def work(batch: Batch) -> Refilled:
        return refilled(batch, rules, plan, memory)

    # Our own paths continue those of the layer below, so that batches come one after another.
    threads = min(thread_count(), MOST_THREADS) if plan is None else 1
    with told(Path("a temporary file")):
        for batch, new in in_order(work, read_batches(file, begin), threads=threads):
            if clock is not None:
                clock.add(batch.table)
            before, after, below = measured_contact(batch, new, below, rules.stride)
            tally.add(new.tally)
            tally.before += before
            tally.after += after
            for first, last in estimates(new.text):
                tally.lines.append((draft.tell() + first, new.text[first:last]))
            draft.write(new.text)
            tags = batch.marks.after
            done += len(batch.table.data)
            if progress is not None and done >= shown:
                progress("drawing infill", done / max(found.size, 1))
                shown = done + SHOWN
        draft.flush()
    if tags is None or not tags.layer:
        raise FormatError(
            "the file has no marked layers; give the G-code of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio "
            "or Cura, with its comments"
        )
    return tally
