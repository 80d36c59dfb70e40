"""The places where a surface may be far from the data it was smoothed from; only there, distances need measuring."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.inspection.sign_changes import SignChanges
from infill.kernels.flips import mark_points_near
from infill.kernels.sparse import BRICK
from infill.kernels.sparse_marching import FULL, ROWS
from infill.kernels.threads import in_threads, thread_count
from infill.volume import Volume

CERTAIN = 1.0  # cells: where all corners of a cube keep their signs, the surfaces are at most an edge apart
CUBES_AROUND = np.array(list(product(range(-1, 1), repeat=3)))  # the cubes around a cell, by their lowest corners
ROUNDING = 1e-6  # cells: a point on the side of a cube may be in either


@dataclass(frozen=True, kw_only=True, eq=False)
class UncertainPlaces:
    """The cubes in which the surfaces of the data and of the field may be further apart than an edge of a cube.

    Parameters
    ----------
    slots : (m0, m1, m2) int32
        The lattice of bricks: see `infill.phasefield.sparse.SparseField`.
    bits : (n, 64) uint16
        The uncertain cubes of each brick, by their lowest corners.
    grid : Volume
        The place of the cells in space.
    reach : float
        Cells that one of the surfaces has moved since.
    """

    slots: NDArray[np.int32]
    bits: NDArray[np.uint16]
    grid: Volume
    reach: float = ROUNDING

    @classmethod
    def of(cls, flips: SignChanges, grid: Volume) -> UncertainPlaces | None:
        """Find the places around cells that changed sign; return None if one of them lies where no brick is kept.

        Notes
        -----
        Where all corners of a cube keep their signs, and these determine the triangles, both surfaces cross the same
        edges of the cube and have the same triangles between these crossings: see
        `infill.inspection.sign_changes.are_surfaces_near`.
        """
        field = flips.field
        bits = np.zeros((len(field.where), ROWS), dtype=np.uint16)
        for step in CUBES_AROUND:  # one after the other: all eight together would take as much memory as the bricks
            place, cell = np.divmod(flips.places + step, BRICK)
            if (place < 0).any():
                return None
            slot = field.slots[tuple(place.T)]
            if (slot < 0).any():
                return None
            bit = np.uint16(1) << cell[:, 2].astype(np.uint16)
            np.bitwise_or.at(bits, (slot, cell[:, 0] * BRICK[1] + cell[:, 1]), bit)
        doubtful = field.slots[tuple(flips.doubt.T)]
        if (doubtful < 0).any():
            return None
        bits[doubtful] = FULL
        return cls(slots=field.slots, bits=bits, grid=grid)

    def after_moving(self, distance: float, *, near: float) -> UncertainPlaces | None:
        """Return the places after one of the surfaces has moved; None if it may be too far away everywhere.

        Parameters
        ----------
        distance : float, mm
        near : float, cells
            Surfaces this close count as near.
        """
        smallest, largest = float(self.grid.cell_size.min()), float(self.grid.cell_size.max())
        if distance > (near - CERTAIN) * largest:
            return None
        return replace(self, reach=self.reach + distance / smallest)

    def hold(self, points: Floats, *, threads: int | None = None) -> NDArray[np.bool_]:
        """Tell for points (N, 3), mm, of either surface whether they may be far from the other one."""
        is_near = np.empty(len(points), dtype=bool)
        origin, turn = np.array(self.grid.origin), np.asarray(self.grid.direction) / self.grid.cell_size
        arguments = (origin, np.ascontiguousarray(turn.T), self.slots, self.bits, self.reach, is_near)
        in_threads(mark_points_near, np.ascontiguousarray(points), *arguments, threads=thread_count(threads))
        return is_near
