"""A pattern that begins anew in every body: each component of a part has it about its own middle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Space
from infill.interior.layer_stack import Layers
from infill.isosurfaces.components import shell_names
from infill.meshes.shells import shell_volumes, with_faces
from infill.meshes.winding import winding

DEEP = np.float32(-1e6)  # cells: where no void is
Field = NDArray[np.float32]


class Anchored(Protocol):
    """The voids of a pattern that begins at a point."""

    def count(self, space: Space, *, cell: float, width: float) -> int:
        """Return how many fields the voids need."""
        ...

    def sharpest(self, space: Space, *, cell: float, width: float) -> float:
        """Return the angle than which few corners of the voids are sharper, degrees."""
        ...

    def into(self, out: Field, space: Space, which: int, *, cell: float, width: float) -> float:
        """Write a field, and return how many cells it fills."""
        ...

    def about(self, middle: NDArray[np.float64]) -> Self:
        """Return the same, with everything shifted by a vector, mm, in all of a part."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """Where a component of a part is.

    Parameters
    ----------
    middle : (3,) float64
        Of the box around it, mm.
    box : three slices
        Of the grid.
    cells : (nx, ny, nz) bool
        Which cells of this box are its own.
    """

    middle: NDArray[np.float64]
    box: tuple[slice, ...]
    cells: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class Bodies:
    """How a pattern is drawn body by body.

    Parameters
    ----------
    known : dict
        What was found for a space.
    """

    known: dict[int, tuple[Space, list[tuple[Body, Space, Anchored]]]] = field(default_factory=dict)

    def count(self, voids: Anchored, space: Space, *, cell: float, width: float) -> int:
        """Return how many fields are needed in the body that needs the most."""
        each = self._each(voids, space)
        return max((one.count(part, cell=cell, width=width) for _, part, one in each), default=0)

    def sharpest(self, voids: Anchored, space: Space, *, cell: float, width: float) -> float:
        """Return the angle than which few corners are sharper in the body with the sharpest, degrees; 90 at most."""
        each = self._each(voids, space)
        return min((one.sharpest(part, cell=cell, width=width) for _, part, one in each), default=90.0)

    def into(self, voids: Anchored, out: Field, space: Space, which: int, *, cell: float, width: float) -> float:
        """Write a field of all bodies, and return how many cells it fills."""
        np.minimum(space.depth, np.float32(-BAND), out=out)
        filled = 0.0
        for body, part, one in self._each(voids, space):
            if which < one.count(part, cell=cell, width=width):
                own = np.empty_like(part.depth)
                filled += one.into(own, part, which, cell=cell, width=width)
                np.copyto(out[body.box], own, where=body.cells)
        return filled

    def _each(self, voids: Anchored, space: Space) -> list[tuple[Body, Space, Anchored]]:
        if id(space) not in self.known:
            self.known.clear()
            found = []
            for body in bodies_in(space):
                first = np.array([each.start for each in body.box])
                part = replace(
                    space,
                    layers=Layers.of(np.where(body.cells, space.depth[body.box], DEEP)),
                    origin=space.origin + space.size * first,
                    walled=None,
                    box_of=(space, first),
                )
                found.append((body, part, voids.about(body.middle)))
            self.known[id(space)] = space, found  # which keeps it, so that no other gets its number
        return self.known[id(space)][1]


def bodies_in(space: Space) -> list[Body]:
    """Return the components of a part inside whose walls there is room, by falling volume.

    A cell belongs to the component that encloses it, and cells of the walls to what is nearest.
    """
    from scipy.ndimage import find_objects, grey_dilation, label, maximum_position

    walled = space.walled or space
    regions, count = label(walled.depth > 0)
    deepest = np.array(maximum_position(walled.depth, regions, np.arange(1, count + 1))).reshape(-1, 3)
    owner, middles = _owners(walled, walled.origin + walled.size * deepest)
    own = np.concatenate([[0], owner + 1]).astype(np.uint16)[regions]
    del regions
    for _ in range(math.ceil(BAND + float((space.depth - walled.depth).max()))):
        wider = grey_dilation(own, size=(3, 3, 3))
        np.copyto(own, wider, where=own == 0)
    return [
        Body(middle=middles[number], box=box, cells=own[box] == number + 1)
        for number, box in enumerate(find_objects(own))
        if box is not None
    ]


def _owners(space: Space, points: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return in which component of a part each of some points (N, 3) lies, (N,), and their middles, (M, 3) mm."""
    part = space.part
    names, count = shell_names(part)
    volume, shell = shell_volumes(part, names, count), names[part.faces[:, 0]]
    found, middles = np.zeros(len(points), dtype=np.intp), []
    # The smaller ones last: they may lie in a cavity of a larger one.
    for number, each in enumerate(sorted(np.flatnonzero(volume > 0).tolist(), key=lambda one: -volume[one])):
        body = with_faces(part, shell == each)
        found[winding(points, body) > 0] = number
        middles.append(np.asarray(body.bounds, dtype=np.float64).mean(axis=0))
    return found, np.array(middles)
