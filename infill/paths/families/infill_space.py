"""Where a print has infill, for patterns that follow its walls, roofs and floors."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.paths.families.family import Family, TurnedFamily
from patterns.octree import FLAT

LOOKED_DOWN = 3  # nodes over which the rise of depths below a roof is measured: more slowly below a steep one


@dataclass(frozen=True, kw_only=True, eq=False)
class InfillSpace:
    """Nodes of a grid over a print, and which of them lie in its infill.

    Parameters
    ----------
    corner, steps : (3,) float64, mm
        The first node, and the distances of nodes.
    inside : (X, Y, Z) bool
    depths : (X, Y, Z) float32, mm
        Distance of nodes inside from walls, roofs and floors.
    heights : (L,) float64, mm
        Of the layers of the print, ascending.
    angle : float, degrees
    phase : (x, y), mm
        How a pattern lies in the print: turned about (0, 0), then shifted.
    cache : dict
        What patterns compute once for all layers.
    """

    corner: Floats
    steps: Floats
    inside: Flags
    depths: Any
    heights: Floats
    angle: float = 0.0
    phase: tuple[float, float] = (0.0, 0.0)
    cache: dict[Any, Any] = field(default_factory=dict)

    def turn_back(self, angle: float, phase: tuple[float, float]) -> InfillSpace:
        """Return the space for a pattern that is turned by an angle, degrees, and then shifted, mm."""
        return replace(self, angle=angle, phase=phase, cache={})

    def to_pattern(self, points: Floats) -> Floats:
        """Move points (N, 3), mm, from the bed to the pattern."""
        from patterns.linework import turn

        return np.column_stack([turn(points[:, :2] - self.phase, -self.angle), points[:, 2]])

    def to_bed(self, points: Floats) -> Floats:
        """Move points (N, 3), mm, from the pattern to the bed."""
        from patterns.linework import turn

        return np.column_stack([turn(points[:, :2], self.angle) + self.phase, points[:, 2]])

    def contains(self, points: Floats) -> Flags:
        """Tell which points (N, 3) of the pattern, mm, lie in the infill: (N,)."""
        nodes = np.rint((self.to_bed(points) - self.corner) / self.steps).astype(np.intp)
        upper = np.array(self.inside.shape) - 1
        within = ((nodes >= 0) & (nodes <= upper)).all(axis=1)
        in_infill: Flags = within & self.inside[tuple(nodes.clip(0, upper).T)]
        return in_infill

    @cached_property
    def box(self) -> Floats:
        """The corners of the grid in the pattern, (8, 3), mm."""
        ends = np.stack([self.corner, self.corner + self.steps * (np.array(self.inside.shape) - 1)])
        corners = np.array([[ends[x, 0], ends[y, 1], ends[z, 2]] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
        return self.to_pattern(corners)

    @cached_property
    def skin(self) -> Floats:
        """Points on walls, roofs and floors, (N, 3), mm, in the pattern."""
        points = []
        for axis in range(3):
            low, high = (np.moveaxis(self.inside, axis, 0)[part] for part in (slice(None, -1), slice(1, None)))
            places = np.argwhere(low != high)
            points.append(self.corner + self.steps * _between(places, axis))
        return self.to_pattern(np.concatenate(points))

    @cached_property
    def roofs(self) -> Floats:
        """Points on roofs that are flatter than 45 degrees, (N, 3), mm, in the pattern."""
        tops = np.argwhere(self.inside[:, :, :-1] & ~self.inside[:, :, 1:])
        down = np.minimum(tops[:, 2], LOOKED_DOWN)
        lower = tops - np.column_stack([np.zeros((len(tops), 2), dtype=np.intp), down])
        rise = (self.depths[tuple(lower.T)] - self.depths[tuple(tops.T)]) / (down * self.steps[2])
        thin = ~self.inside[tuple(lower.T)]
        flat = tops[thin | (rise >= FLAT)]
        return self.to_pattern(self.corner + self.steps * (flat + np.array([0.0, 0.0, 0.5])))


def _between(places: NDArray[np.intp], axis: int) -> Floats:
    """Return the middles between pairs of nodes along an axis, given with that axis first: (N, 3)."""
    nodes = places.astype(np.float64)
    nodes[:, 0] += 0.5
    return np.insert(nodes[:, 1:], axis, nodes[:, 0], axis=1)


@runtime_checkable
class PlacedFamily(Protocol):
    """Protocol of a family whose lines depend on the infill of the entire print."""

    def in_print(self, space: InfillSpace) -> Family:
        """Return the family in a print."""
        ...


def follows_print(family: Family) -> bool:
    """Tell whether the lines of a family depend on the infill of the entire print."""
    return isinstance(family.family if isinstance(family, TurnedFamily) else family, PlacedFamily)


def fills_print(family: Family) -> bool:
    """Tell whether the cell of a family decides how much filament it takes."""
    return (family.family if isinstance(family, TurnedFamily) else family).fills


def place_family(family: Family, space: InfillSpace) -> Family:
    """Return a family in a print; one that does not depend on it as it is."""
    if isinstance(family, TurnedFamily):
        return replace(family, family=place_family(family.family, space.turn_back(family.angle, family.phase)))
    return family.in_print(space) if isinstance(family, PlacedFamily) else family
