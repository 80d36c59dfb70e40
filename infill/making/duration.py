"""Estimate the time of smoothing a block on this machine, and warn if it is long."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from infill.phasefield.methods import smooth

if TYPE_CHECKING:
    from infill.making.request import Block

NOTICED = 60.0  # s: longer times are reported
ROUGHLY = 2e-8  # s per cell and step, more than any machine of today needs: times that are short by it are not measured
USUAL = 10  # steps
TRIED, SIDE = 20, 1000  # steps of a trial, and most cells along its side
UNITS = {"seconds": 1.0, "minutes": 60.0, "hours": 3600.0, "days": 86400.0, "years": 365.25 * 86400}


def smoothing_seconds(block: Block) -> float:
    """Estimate the seconds of smoothing: from a trial on a piece of the grid, if they are many.

    Every step updates every cell, whatever its value, so that all cells and steps take equally long.
    """
    work = block.grid.cells * block.smoothing.steps
    if work * ROUGHLY < NOTICED:
        return work * ROUGHLY
    piece = np.where(np.indices([min(side, SIDE) for side in block.grid.shape]).sum(axis=0) % 20 < 10, 1.0, -1.0)
    trial = replace(block.smoothing, steps=TRIED)
    times = []
    for _ in range(2):  # the first also loads what smoothing needs
        begin = time.perf_counter()
        smooth(piece, trial)
        times.append(time.perf_counter() - begin)
    return min(times) / (TRIED * piece.size) * work


def warning_of(block: Block) -> str:
    """Return a warning of one line if smoothing a block takes long, else an empty string."""
    seconds = smoothing_seconds(block)
    if seconds < NOTICED:
        return ""
    cells, steps = " x ".join(map(str, block.grid.shape)), block.smoothing.steps
    advice = f"take fewer steps ({USUAL} are usual), or fewer cells" if steps > USUAL else "take fewer cells"
    return f"{steps:,} steps on {cells} cells take {as_time(seconds)} here; {advice}"


def as_time(seconds: float) -> str:
    """Format a time in the largest unit that gives two or more.

    >>> as_time(100), as_time(200), as_time(9 * 86400)
    ('about 100 seconds', 'about 3 minutes', 'about 9 days')
    """
    unit = next((candidate for candidate in reversed(UNITS) if seconds >= 2 * UNITS[candidate]), "seconds")
    return f"about {float(f'{seconds / UNITS[unit]:.2g}'):,.0f} {unit}"
