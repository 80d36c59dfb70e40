"""How long smoothing a block will take, measured on this machine, where that is long enough to be told."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from infill.phasefield.methods import smooth

if TYPE_CHECKING:
    from infill.making.request import Block

NOTICED = 60.0  # s, from which it is told
ROUGHLY = 2e-8  # s per cell and step that no machine of today needs: what would be short by it is not measured
USUAL = 10  # steps
TRIED, SIDE = 20, 1000  # steps, and cells along a side at most, that are measured
UNITS = {"seconds": 1.0, "minutes": 60.0, "hours": 3600.0, "days": 86400.0, "years": 365.25 * 86400}


def smoothing_seconds(block: Block) -> float:
    """Return about how long smoothing will take, s: by the time of some steps on a piece of the grid, if it is long.

    Every step updates every cell, whatever it holds, so that the time of one cell and step is that of all.
    """
    work = block.grid.cells * block.smoothing.steps
    if work * ROUGHLY < NOTICED:
        return work * ROUGHLY
    piece = np.where(np.indices([min(side, SIDE) for side in block.grid.shape]).sum(axis=0) % 20 < 10, 1.0, -1.0)
    some = replace(block.smoothing, steps=TRIED)
    taken = []
    for _ in range(2):  # the first also loads what smoothing needs
        begun = time.perf_counter()
        smooth(piece, some)
        taken.append(time.perf_counter() - begun)
    return min(taken) / (TRIED * piece.size) * work


def warning_of(block: Block) -> str:
    """Return one line for a block that takes long to smooth, or nothing."""
    seconds = smoothing_seconds(block)
    if seconds < NOTICED:
        return ""
    cells, steps = " x ".join(map(str, block.grid.shape)), block.smoothing.steps
    advice = f"take fewer steps ({USUAL} are usual), or fewer cells" if steps > USUAL else "take fewer cells"
    return f"{steps:,} steps on {cells} cells take {as_time(seconds)} here; {advice}"


def as_time(seconds: float) -> str:
    """Return a time in the largest unit of which there are two or more.

    >>> as_time(100), as_time(200), as_time(9 * 86400)
    ('about 100 seconds', 'about 3 minutes', 'about 9 days')
    """
    unit = next((each for each in reversed(UNITS) if seconds >= 2 * UNITS[each]), "seconds")
    return f"about {float(f'{seconds / UNITS[unit]:.2g}'):,.0f} {unit}"
