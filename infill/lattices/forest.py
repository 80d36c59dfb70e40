"""Trees seen from above, which grow from tips to the walls of a part, layer by layer from its top."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

NONE = -1  # where the way of a foot goes on
SAME = 0.5  # cells: what is nearer to a node is the node
SURE = 0.01  # cells: distances that differ by less are equal

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(kw_only=True)
class Forest:
    """Nodes in a plane, each on its way to another one, and at last to a foot, which stands in a wall.

    Parameters
    ----------
    at : (N, 2) float64
        Cells of the grid.
    to : (N,) int64
        The next node on the way to the foot; `NONE` for a foot.
    inside : (N,) bool
        Which have been inside the walls.
    """

    at: Floats = field(default_factory=lambda: np.empty((0, 2)))
    to: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    inside: Flags = field(default_factory=lambda: np.empty(0, dtype=bool))

    @property
    def branches(self) -> Floats:
        """The ways from node to node, (B, 2, 2)."""
        some = self.to != NONE
        return np.stack([self.at[some], self.at[self.to[some]]], axis=1)

    @property
    def feet(self) -> NDArray[np.intp]:
        """The nodes that stand in a wall."""
        return np.flatnonzero(self.to == NONE)

    def draw_back(self, step: float) -> None:
        """Shorten every branch from its tip, by a step; what is shorter is gone."""
        tips = np.flatnonzero(self._tips() & (self.to != NONE))
        way = self.at[self.to[tips]] - self.at[tips]
        long = np.linalg.norm(way, axis=1)
        longer = long > step + SURE
        self.at[tips[longer]] += way[longer] * (step / long[longer])[:, None]
        self._keep(~self._flags(tips[~longer]))
        self._drop_bare_feet()

    def stand(self, inside: Flags) -> None:
        """Take note of which nodes (N,) are inside the walls: what was and is not any more stands in a wall now.

        The branch from there to the next node has a tip of its own.
        """
        for node in np.flatnonzero(self.inside & ~inside & (self.to != NONE)).tolist():
            self._add(self.at[node], int(self.to[node]), inside=False)
            self.to[node] = NONE
        self.inside[: len(inside)] |= inside
        self._drop_bare_feet()

    def move(self, foot: int, place: Floats, *, near: float) -> None:
        """Let a foot stand elsewhere: itself, if that is near, or else at the end of a branch from there."""
        if np.linalg.norm(place - self.at[foot]) <= near:
            self.at[foot] = place
        else:
            self.to[foot] = self._add(place, NONE, inside=False)

    def plant(self, tip: Floats, place: Floats, *, apart: float = 0.0) -> None:
        """Let a branch grow from a tip to the nearest one there is, or to a place in a wall if that is nearer.

        None is needed where the nearest one is less than `apart` away, in cells.
        """
        away = float(np.linalg.norm(place - tip))
        near = self.nearest(tip)
        if near is not None and near[0] < apart - SURE:
            return
        if near is None or away <= near[0] + SURE:
            self._add(tip, self._add(place, NONE, inside=False), inside=True)
            return
        _, node, share = near
        one, other = self.at[node], self.at[self.to[node]]
        joint = one + share * (other - one)
        if np.linalg.norm(joint - one) <= SAME:
            joined = node
        elif np.linalg.norm(joint - other) <= SAME:
            joined = int(self.to[node])
        else:
            joined = self._add(joint, int(self.to[node]), inside=bool(self.inside[node]))
            self.to[node] = joined
        self._add(tip, joined, inside=True)

    def nearest(self, place: Floats) -> tuple[float, int, float] | None:
        """Return how far the nearest branch is, the node it begins at, and where along it; None if there is none."""
        begin = np.flatnonzero(self.to != NONE)
        if not len(begin):
            return None
        one = self.at[begin]
        way = self.at[self.to[begin]] - one
        long = np.maximum((way**2).sum(axis=1), 1e-300)
        share = np.clip(((place - one) * way).sum(axis=1) / long, 0, 1)
        away = np.linalg.norm(one + share[:, None] * way - place, axis=1)
        first = int(np.argmax(away <= away.min() + SURE))
        return float(away[first]), int(begin[first]), float(share[first])

    def _add(self, place: Floats, to: int, *, inside: bool) -> int:
        self.at = np.concatenate([self.at, place[None]])
        self.to = np.append(self.to, to)
        self.inside = np.append(self.inside, inside)
        return len(self.to) - 1

    def _tips(self) -> Flags:
        found = np.ones(len(self.to), dtype=bool)
        found[self.to[self.to != NONE]] = False
        return found

    def _flags(self, numbers: NDArray[np.intp]) -> Flags:
        found = np.zeros(len(self.to), dtype=bool)
        found[numbers] = True
        return found

    def _drop_bare_feet(self) -> None:
        self._keep(~(self._tips() & (self.to == NONE)))

    def _keep(self, kept: Flags) -> None:
        if kept.all():
            return
        number = np.cumsum(kept) - 1
        self.at, self.inside, to = self.at[kept], self.inside[kept], self.to[kept]
        self.to = np.where(to == NONE, NONE, number[to])
