"""Trees seen from above, which grow from tips to the walls of a part, layer by layer from its top."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats

NONE = -1  # the next node after a foot
SAME = 0.5  # cells: a joint nearer to a node than this is the node
SURE = 0.01  # cells: distances that differ by less are equal


@dataclass(kw_only=True)
class Forest:
    """Nodes in a plane, each with a way to another node and in the end to a foot, which stands in a wall.

    Parameters
    ----------
    at : (N, 2) float64
        Cells of the grid.
    to : (N,) int64
        The next node on the way to the foot; `NONE` for a foot.
    inside : (N,) bool
        True for nodes that have been inside the walls.
    """

    at: Floats = field(default_factory=lambda: np.empty((0, 2)))
    to: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    inside: Flags = field(default_factory=lambda: np.empty(0, dtype=bool))

    @property
    def branches(self) -> Floats:
        """The segments from node to node, (B, 2, 2)."""
        has_next = self.to != NONE
        return np.stack([self.at[has_next], self.at[self.to[has_next]]], axis=1)

    @property
    def feet(self) -> NDArray[np.intp]:
        """The nodes that stand in a wall."""
        return np.flatnonzero(self.to == NONE)

    def draw_back(self, step: float) -> None:
        """Shorten every branch from its tip by a step; drop branches that are shorter."""
        tips = np.flatnonzero(self._is_tip() & (self.to != NONE))
        direction = self.at[self.to[tips]] - self.at[tips]
        length = np.linalg.norm(direction, axis=1)
        longer = length > step + SURE
        self.at[tips[longer]] += direction[longer] * (step / length[longer])[:, None]
        self._keep(~np.isin(np.arange(len(self.to)), tips[~longer]))
        self._drop_bare_feet()

    def record_inside(self, inside: Flags) -> None:
        """Record which nodes (N,) are inside the walls: a node that was inside and is not any more becomes a foot.

        The branch from there to the next node has a tip of its own.
        """
        for node in np.flatnonzero(self.inside & ~inside & (self.to != NONE)).tolist():
            self._add(self.at[node], int(self.to[node]), inside=False)
            self.to[node] = NONE
        self.inside[: len(inside)] |= inside
        self._drop_bare_feet()

    def move(self, foot: int, place: Floats, *, near: float) -> None:
        """Move a foot: itself if the place is near, otherwise by a branch from it to there."""
        if np.linalg.norm(place - self.at[foot]) <= near:
            self.at[foot] = place
        else:
            self.to[foot] = self._add(place, NONE, inside=False)

    def plant(self, tip: Floats, place: Floats, *, apart: float = 0.0) -> None:
        """Let a branch grow from a tip to the nearest branch, or to a place in a wall if that is nearer.

        Nothing grows if the nearest branch is less than `apart` away, in cells.
        """
        distance = float(np.linalg.norm(place - tip))
        nearest = self.nearest(tip)
        if nearest is not None and nearest[0] < apart - SURE:
            return
        if nearest is None or distance <= nearest[0] + SURE:
            self._add(tip, self._add(place, NONE, inside=False), inside=True)
            return
        _, node, share = nearest
        start, end = self.at[node], self.at[self.to[node]]
        joint = start + share * (end - start)
        if np.linalg.norm(joint - start) <= SAME:
            joined = node
        elif np.linalg.norm(joint - end) <= SAME:
            joined = int(self.to[node])
        else:
            joined = self._add(joint, int(self.to[node]), inside=bool(self.inside[node]))
            self.to[node] = joined
        self._add(tip, joined, inside=True)

    def nearest(self, place: Floats) -> tuple[float, int, float] | None:
        """Find the nearest branch: its distance, its first node, and the share of it to the nearest point; or None."""
        starts = np.flatnonzero(self.to != NONE)
        if not len(starts):
            return None
        start = self.at[starts]
        direction = self.at[self.to[starts]] - start
        squared = np.maximum((direction**2).sum(axis=1), 1e-300)
        share = np.clip(((place - start) * direction).sum(axis=1) / squared, 0, 1)
        distance = np.linalg.norm(start + share[:, None] * direction - place, axis=1)
        nearest = int(np.argmax(distance <= distance.min() + SURE))
        return float(distance[nearest]), int(starts[nearest]), float(share[nearest])

    def _add(self, place: Floats, to: int, *, inside: bool) -> int:
        """Add a node at a place, joined to node `to`; return its number."""
        self.at = np.concatenate([self.at, place[None]])
        self.to = np.append(self.to, to)
        self.inside = np.append(self.inside, inside)
        return len(self.to) - 1

    def _is_tip(self) -> Flags:
        """Mark the nodes that no branch leads to: (N,)."""
        is_tip = np.ones(len(self.to), dtype=bool)
        is_tip[self.to[self.to != NONE]] = False
        return is_tip

    def _drop_bare_feet(self) -> None:
        """Drop the feet without a branch."""
        self._keep(~(self._is_tip() & (self.to == NONE)))

    def _keep(self, mask: Flags) -> None:
        """Keep the nodes in a mask, and renumber the branches."""
        if mask.all():
            return
        number = np.cumsum(mask) - 1
        self.at, self.inside, to = self.at[mask], self.inside[mask], self.to[mask]
        self.to = np.where(to == NONE, NONE, number[to])
