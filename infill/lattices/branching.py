"""Branches below the roofs of a part, layer by layer from its top: see `patterns.lightning`."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.paths.branches import SLACK, LayerWalls, grow_branches, lattice_twigs
from patterns.lightning import Lightning

DEEPER = 1.5  # cells by which feet stand in the wall, so that walls join
SHARE = 1.0  # width of branches over the cell, for a density of 1: a guess


@dataclass(frozen=True, kw_only=True)
class BranchLines:
    """The branches of a part.

    Parameters
    ----------
    pattern : Lightning
    turn : (3, 3) float64
        From the part to the pattern, about z.
    anchor : (3,) float64
        The point of the part that is (0, 0) of the pattern, mm; its height does not matter.
    """

    pattern: Lightning
    turn: Floats
    anchor: Floats

    @property
    def steepest(self) -> float:
        """Distance by which tips draw back in a layer, in cells, and its uncertainty."""
        return math.tan(math.radians(self.pattern.overhang)) + SLACK

    def sharpest(self, space: Interior, cell: float) -> float:  # noqa: ARG002 - as of `LayerLines`
        """Return the angle of the corners where branches meet walls, degrees."""
        return 90.0

    def widths(self, density: float) -> float:
        """Return a width of branches, in cells, for a density: a guess that does not depend on the part."""
        return SHARE * density

    def lines(self, space: Interior, cell: float) -> list[Floats]:
        """Draw the branches in each layer, for cells of a size, mm: (S, 2, 2), in cells from the first centre."""
        step = math.tan(math.radians(self.pattern.overhang))
        walls = LayerWalls(depth=space.below_walls, step=step, deeper=DEEPER + space.through)
        nx, ny, nz = space.shape
        node = self.anchor[:2] + cell * np.array(self.pattern.first) @ self.turn[:2, :2]
        lattice = (node - space.origin[:2]) / space.size, cell / space.size * self.turn[:2, :2]
        twigs = lattice_twigs((nx, ny), *lattice, self.pattern.cells)
        grown = grow_branches(walls, twigs, reach=cell / 2 / space.size, steps=[step] * nz)
        branches, new_branches = list[Floats](), list[Floats]()
        for forest, begins in grown:
            branches.append(forest.branches)
            new_branches.append(forest.branches if begins else np.empty((0, 2, 2)))
        layers_up = math.ceil(space.through)  # in a project, branches go through the roofs too
        return [np.concatenate([lines, *new_branches[k + 1 : k + 1 + layers_up]]) for k, lines in enumerate(branches)][
            ::-1
        ]
