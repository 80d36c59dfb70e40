r"""Where lines in three directions meet, so that none crosses another: which arms are linked, and where they are cut.

Lines of the directions a, b and c run along 0°, 60° and 120°. Arm 0 of a junction leaves along 0°, arm 1 along 60°, and
so on; arms 0 and 3 belong to a, 1 and 4 to b, 2 and 5 to c. Where two lines cross, the strands turn off instead, and
touch along flats at right angles to the line between them::

        \    /                 \    /
         \  /                   \__/        the upper strand keeps above, the lower one below
          \/      becomes        __
          /\                    /  \
         /  \                  /    \

A line that ends on another keeps its distance from it, so that the beads touch. Three lines that nearly meet in a point
are one junction: a line that passes stays straight, and two arms on the same side of it are linked.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats

ARMS = 6
SIN, NONE = math.sqrt(3) / 2, -1
DIRECTIONS = np.array([[math.cos(math.radians(60 * arm)), math.sin(math.radians(60 * arm))] for arm in range(ARMS)])
A, B, C = range(3)
CROSSED = {(A, B): ((3, 1), (4, 0)), (A, C): ((2, 0), (3, 5)), (B, C): ((2, 1), (4, 5))}  # arms linked, from the left
SIDES = {A: ((1, 2), (4, 5)), B: ((2, 3), (5, 0)), C: ((0, 1), (3, 4))}  # arms on either side of a line that passes


@dataclass(frozen=True, kw_only=True, eq=False)
class JunctionTable:
    """How arms are linked and cut, for every set of arms.

    Parameters
    ----------
    partner : (64, 6) int
        The arm that each arm is linked to; `NONE` for an end. The set of arms is given by its bits.
    cut : (64, 6, 2) float64
        Where each arm begins, mm from the crossing of b and c.
    """

    partner: NDArray[np.int64]
    cut: Floats


def junction_table(offset: float, gap: float) -> JunctionTable:
    """Link and cut the arms of junctions.

    Parameters
    ----------
    offset : float
        Height of line a above the crossing of b and c, mm.
    gap : float
        Distance of beads that touch, mm.
    """
    partner = np.full((1 << ARMS, ARMS), NONE)
    cut = np.zeros((1 << ARMS, ARMS, 2))
    for code in range(1, 1 << ARMS):
        junction = _Junction(arms=[arm for arm in range(ARMS) if code >> arm & 1], offset=offset, gap=gap)
        junction.link()
        for arm in junction.arms:
            partner[code, arm] = junction.partner.get(arm, NONE)
            cut[code, arm] = junction.cut[arm] if arm in junction.cut else junction.free_cut(arm)
    return JunctionTable(partner=partner, cut=cut)


class _Junction:
    """One set of arms, while they are linked."""

    def __init__(self, arms: list[int], offset: float, gap: float) -> None:
        self.arms, self.offset, self.gap = arms, offset, gap
        self.partner: dict[int, int] = {}
        self.cut: dict[int, Floats] = {}
        self.lines = [line for line in (A, B, C) if {line, line + 3} & set(arms)]
        self.passing = [line for line in self.lines if {line, line + 3} <= set(arms)]

    def crossing(self, first: int, second: int) -> Floats:
        """Return the crossing of two lines."""
        x = {(A, B): self.offset / math.sqrt(3), (A, C): -self.offset / math.sqrt(3), (B, C): 0.0}
        pair = min(first, second), max(first, second)
        return np.array([x[pair], 0.0 if pair[0] == B else self.offset])

    def link(self) -> None:
        """Link the arms of lines that cross, and those on one side of a line that passes."""
        if len(self.passing) == 2:
            first, second = self.passing
            for arms in CROSSED[first, second]:
                self._turn_off(*arms, self.crossing(first, second), self.gap / 2)
        elif self.passing:
            self._pass(self.passing[0])
        elif len(self.arms) == 2:
            first, second = self.arms
            self._join(first, second, *[self.crossing(first % 3, second % 3)] * 2)

    def _pass(self, line: int) -> None:
        """Let a line pass, and link the arms on either side of it."""
        place = self.crossing(line, (line + 1) % 3)
        self._join(line, line + 3, place, place)
        for side, arms in enumerate(SIDES[line]):
            if set(arms) <= set(self.arms):
                apex = self.crossing(arms[0] % 3, arms[1] % 3)
                beyond = self.offset if (side == 0) != (line == A) else -self.offset  # of the line, on this side
                self._turn_off(*arms, apex, max(self.gap - beyond, self.gap / 2))

    def _turn_off(self, first: int, second: int, apex: Floats, distance: float) -> None:
        """Link two arms by a flat at a distance from where they would meet."""
        middle = DIRECTIONS[first] + DIRECTIONS[second]
        along = distance / float(DIRECTIONS[first] @ middle / np.hypot(*middle))
        self._join(first, second, apex + along * DIRECTIONS[first], apex + along * DIRECTIONS[second])

    def _join(self, first: int, second: int, place: Floats, second_place: Floats) -> None:
        """Link two arms that are cut at two places."""
        self.partner |= {first: second, second: first}
        self.cut |= {first: place, second: second_place}

    def free_cut(self, arm: int) -> Floats:
        """Return where an arm ends that is not linked: a bead away from all other lines."""
        line, direction = arm % 3, DIRECTIONS[arm]
        ends = [self.crossing(line, second) + self.gap / SIN * direction for second in self.lines if second != line]
        if len(self.passing) == 2 and ends:  # a flat may lie across it
            start = ends[0]
            along = float((self.crossing(*self.passing) - start) @ direction) + 1.5 * self.gap
            ends.append(start + along * direction)
        return max(ends, key=lambda end: float(end @ direction), default=self.crossing(line, (line + 1) % 3))
