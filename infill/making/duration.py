"""Estimate the time of smoothing a block on this machine, and warn if it is long."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from infill.phasefield.methods import smooth
from infill.plain_numbers import plain_number

if TYPE_CHECKING:
    from infill.making.request import Block

REPORTED_SECONDS = 60.0  # s: longer times are reported
ASSUMED_RATE = (
    2e-8  # s per cell and step, more than any machine of today needs: times that are short by it are not measured
)
USUAL_STEPS = 10  # steps
TRIAL_STEPS, TRIAL_SIDE = 20, 1000  # steps of a trial, and most cells along its side
UNITS = {"seconds": 1.0, "minutes": 60.0, "hours": 3600.0, "days": 86400.0, "years": 365.25 * 86400}


def smoothing_seconds(block: Block) -> float:
    """Estimate the seconds of smoothing: from a trial on a piece of the grid, if they are many.

    Every step updates every cell, whatever its value, so that all cells and steps take equally long.
    """
    work = block.grid.cells * block.smoothing.steps
    if work * ASSUMED_RATE < REPORTED_SECONDS:
        return work * ASSUMED_RATE
    piece = np.where(np.indices([min(side, TRIAL_SIDE) for side in block.grid.shape]).sum(axis=0) % 20 < 10, 1.0, -1.0)
    trial = replace(block.smoothing, steps=TRIAL_STEPS)
    times = []
    for _ in range(2):  # the first also loads what smoothing needs
        begin = time.perf_counter()
        smooth(piece, trial)
        times.append(time.perf_counter() - begin)
    return min(times) / (TRIAL_STEPS * piece.size) * work


def duration_warning(block: Block) -> str:
    """Return a warning of one line if smoothing a block takes long, else an empty string."""
    seconds = smoothing_seconds(block)
    if seconds < REPORTED_SECONDS:
        return ""
    cells, steps = " x ".join(map(str, block.grid.shape)), block.smoothing.steps
    advice = (
        f"take fewer steps ({USUAL_STEPS} are usual), or fewer cells" if steps > USUAL_STEPS else "take fewer cells"
    )
    return f"{steps:,} steps on {cells} cells take {format_duration(seconds)} here; {advice}"


def format_duration(seconds: float) -> str:
    """Format a time in the largest unit that gives two or more.

    >>> format_duration(100), format_duration(200), format_duration(9 * 86400)
    ('about 100 seconds', 'about 3 minutes', 'about 9 days')
    """
    unit = next((candidate for candidate in reversed(UNITS) if seconds >= 2 * UNITS[candidate]), "seconds")
    return f"about {plain_number(round(seconds / UNITS[unit]), 2)} {unit}"
