"""The memory that a chunk takes, and the largest chunks that a limit allows."""

from __future__ import annotations

import math
from dataclasses import dataclass

from infill.chunks.layout import Place, margin_bricks
from infill.kernels.sparse import BRICK

LEAST_SIDE = 32  # cells
# Bytes of a cell, besides that in the file, of a chunk with its margin, if a surface runs everywhere, as it does in
# gyroid cells of 32 and 64 cells, or in a random field of standard deviation 2: measured peaks.
PLAIN, REFINED, GREY = 16, 28, 34
NOISY = 56  # the same where specks are looked for, of which there are many in noise: one cell in seven flipped


@dataclass(frozen=True, kw_only=True)
class ChunkMemory:
    """The quantities on which the memory of a chunk depends.

    Parameters
    ----------
    shape : (nx, ny, nz)
        Cells of the volume.
    steps : int
    item : int
        Bytes of a cell in the file.
    refined, grey : bool
        Whether the field is refined, and whether grey values are smoothed.
    speck_cells : int
        Cells of the specks that are taken out, 0 for none.
    """

    shape: tuple[int, ...]
    steps: int
    item: int
    refined: bool = False
    grey: bool = False
    speck_cells: int = 0

    def of_chunk(self, size: Place) -> int:
        """Return the memory that a chunk of some bricks along each axis takes, bytes, at most."""
        cells = 1
        margin = margin_bricks(self.steps, refined=self.refined)
        for count, brick, bricks, beside in zip(self.shape, BRICK, size, margin, strict=True):
            cells *= min(count, brick * (bricks + 2 * (beside + math.ceil(self.speck_cells / brick))))
        own = GREY if self.grey else REFINED if self.refined else PLAIN
        return cells * (self.item + max(own, NOISY if self.speck_cells else 0))

    def size_within(self, memory: int, largest: int = 512) -> Place:
        """Return the bricks of a chunk along each axis, so that one chunk takes at most `memory` bytes.

        Parameters
        ----------
        memory : int
        largest : int
            Cells along the longest side at most.
        """
        side = largest
        while side > LEAST_SIDE and self.of_chunk(self._bricks(side)) > memory:
            side -= BRICK[0]
        return self._bricks(side)

    def _bricks(self, side: int) -> Place:
        """Return the bricks of chunks of about the same size, with at most so many cells along a side."""
        bricks = []
        for count, size in zip(self.shape, BRICK, strict=True):
            lattice = math.ceil((count + 2) / size)
            chunks = math.ceil(lattice / max(1, side // size))
            bricks.append(math.ceil(lattice / chunks))
        first, second, third = bricks
        return first, second, third
