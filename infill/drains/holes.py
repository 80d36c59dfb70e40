"""Round holes out of the voids of a part, and what is required of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from infill.arrays import Floats

Kind = Literal["drain", "vent", "place", "branch"]


@dataclass(frozen=True, kw_only=True)
class DrainNeeds:
    """Requirements of a drain.

    Parameters
    ----------
    diameter, wall : float, mm
    cell : float
        Of the pattern, mm.
    closed_at : float or None
        Height of a side of the part that is open already, through which no drain leaves, mm.
    threads : int or None
    """

    diameter: float
    wall: float
    cell: float
    closed_at: float | None = None
    threads: int | None = None

    @property
    def radius(self) -> float:
        """Of a drain, mm."""
        return self.diameter / 2


@dataclass(frozen=True, kw_only=True, eq=False)
class Shaft:
    """A round hole along z.

    Parameters
    ----------
    at : (2,) float64, mm
    low, high : float
        Heights of its ends, mm.
    skin : float
        Height at which its axis leaves the part, mm.
    floor : float
        Height at which its axis enters the void, mm.
    clearance : float
        Least distance of the hole from the other skin, mm.
    near : (3,) float64, mm
        The place of that distance on the hole.
    """

    at: Floats
    low: float
    high: float
    skin: float
    floor: float
    clearance: float
    near: Floats

    @property
    def mouth(self) -> Floats:
        """The place where its axis leaves the part, (3,) mm."""
        return np.array([*self.at, self.skin])


@dataclass(frozen=True, kw_only=True, eq=False)
class Hole:
    """A round hole that drains a void; a branch, with round ends, leads into another void.

    Parameters
    ----------
    kind : {"drain", "vent", "place", "branch"}
        Down, up, at a requested place, or into another void.
    at : (3,) float64, mm
        The place where its axis leaves the part; of a branch, where it begins in its void.
    to : (3,) float64, mm
        The place where its axis ends in the void; of a branch, in the other void.
    way : (3,) float64
        The way out along the axis, of length 1.
    out : float
        Length of the hole beyond `at`, mm: to where its rim leaves the part, and a little more. 0 of a branch.
    void : int
        Number of the void, the largest is 0.
    into : int or None
        Of a branch, the other void.
    diameter : float
        mm; that of a branch may be less than requested, where the void is narrower.
    clearance : float
        Least distance from all skin except the face that it leaves through, mm.
    near : (3,) float64, mm
        The place of that distance; of a branch, on its axis.
    above : float
        Height of its start above the lowest place of the void, mm; of a vent, below the highest place.
    """

    kind: Kind
    at: Floats
    to: Floats
    way: Floats
    out: float = 0.0
    void: int
    into: int | None = None
    diameter: float
    clearance: float
    near: Floats
    above: float

    @classmethod
    def of(cls, shaft: Shaft, kind: Kind, void: int, *, diameter: float, lowest: float) -> Hole:
        """Make a hole straight down of a shaft, for a void whose lowest place has a height, mm."""
        return cls(
            kind=kind,
            at=shaft.mouth,
            to=np.array([*shaft.at, shaft.high]),
            way=np.array([0.0, 0.0, -1.0]),
            out=shaft.skin - shaft.low,
            void=void,
            diameter=diameter,
            clearance=shaft.clearance,
            near=shaft.near,
            above=max(0.0, shaft.floor - lowest),
        )

    def turn_back(self, rotation: Floats) -> Hole:
        """Return the same hole in the part before it was turned by a rotation (3, 3)."""
        at, to, way, near = (vector @ rotation for vector in (self.at, self.to, self.way, self.near))
        return replace(self, at=at, to=to, way=way, near=near)
