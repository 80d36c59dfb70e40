r"""Short segments of paths merged with their neighbours: they make a file large, and a machine no faster.

Where the path hardly bends, one of two close points A and B goes. Where it bends, that would make one sharp corner of
two blunt ones, at which a machine brakes: the points move apart along their legs instead::

        P ------ A                         P ---- A'
                  \                                `-.
                   B          becomes                 `-. B'
                   |                                     |
                   Q                                     Q

Where there is no room for that, A or B goes, or both give way to the point halfway between them, whichever keeps the
path nearest to where it was. The ends of a path stay.
"""

from __future__ import annotations

import numpy as np

from infill.arrays import Floats
from infill.kernels.compiling import log_compilation
from infill.paths.corners import UNIT, RoundedPaths

SHORTEST_SEGMENT = 0.05  # mm: a tenth of a bead's width, and less than two steps of a belt
MOST_MOVED = 0.02  # mm that merging may move a path where no law demands more, as chords leave their arcs
HARDLY_BENT = 0.002  # mm that a path moves where a point goes before points move apart instead
MOST_SPREAD = 0.0125  # mm that a path may move where points move apart: more, and ends of legs leave their walls
SPREAD_LENGTH = 0.052  # mm between points that moved apart, with room for their decimals
LENGTH_CLASSES = 0.01  # mm: shorter segments go first, in classes of this width
SCATTER = 0.6180339887498949  # of a place, to order equal segments so that many are merged at once


def merge_short_segments(paths: RoundedPaths, wanted: float | Floats = SHORTEST_SEGMENT) -> RoundedPaths:
    """Merge the short segments of paths; return the paths with fewer points.

    A segment below `SHORTEST_SEGMENT` is always merged, except for the only one of a path, and beside an end, where the
    path would move by more than `MOST_MOVED`. One below `wanted` is merged where the path moves no farther than that.

    Parameters
    ----------
    paths : RoundedPaths
    wanted : float or (K,) float64, mm
        Length below which segments are merged; of the segment after each point if an array.

    Returns
    -------
    RoundedPaths
        With multiples of `UNIT` where points are new.

    >>> path = np.array([[0.0, 0.0], [5.0, 0.0], [5.03, 0.03], [5.03, 5.0]])
    >>> paths = RoundedPaths(points=path, first=np.array([0, 4]), source=np.arange(4), radius=np.full(4, np.inf))
    >>> merge_short_segments(paths).points.tolist()
    [[0.0, 0.0], [4.993, 0.0], [5.03, 0.037], [5.03, 5.0]]
    """
    from infill.kernels.short_segments import merge_rounds

    count = len(paths.first) - 1
    number = np.diff(paths.first)
    points, source = paths.points.copy(), np.array(paths.source, dtype=np.int64)
    owner = np.repeat(np.arange(count), number)
    least = np.maximum(np.broadcast_to(wanted, len(points)), SHORTEST_SEGMENT)
    limits = (SHORTEST_SEGMENT, MOST_MOVED, HARDLY_BENT, MOST_SPREAD, SPREAD_LENGTH)
    with log_compilation("corners"):
        left = merge_rounds(points, owner, source, least, number, UNIT, limits, LENGTH_CLASSES, SCATTER)
    points, owner, source = points[:left], owner[:left], source[:left]
    first = np.searchsorted(owner, np.arange(len(paths.first)))
    return RoundedPaths(points=points, first=first, source=source, radius=paths.radius)
