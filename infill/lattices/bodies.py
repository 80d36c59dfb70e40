"""A pattern that starts over in every body: each component of a part has it about its own middle."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Interior
from infill.interior.layer_stack import LayerStack
from infill.isosurfaces.components import shell_names
from infill.lattices.grading import LocalWidths
from infill.meshes.shells import select_faces, shell_volumes
from infill.meshes.winding import winding_numbers

DEEP = np.float32(-1e6)  # cells: where no void is
Field = NDArray[np.float32]


class Anchored(Protocol):
    """The voids of a pattern that begins at a point."""

    def count(self, space: Interior, *, cell: float, width: float) -> int:
        """Count the fields that the voids need."""
        ...

    def sharpest(self, space: Interior, *, cell: float, width: float) -> float:
        """Return the angle of the sharpest corners of the voids, degrees; few are sharper."""
        ...

    def into(self, out: Field, space: Interior, which: int, *, cell: float, width: float) -> float:
        """Write one field; return how many cells it fills."""
        ...

    def about(self, middle: NDArray[np.float64]) -> Self:
        """Return the same voids, shifted by a vector, mm, in the whole part."""
        ...

    def prepare(self, space: Interior, *, cell: float, width: float) -> Self:
        """See `Voids`."""
        ...

    def with_widths(self, local: LocalWidths) -> Self:
        """See `Voids`."""
        ...

    @property
    def local(self) -> LocalWidths | None:
        """See `Voids`."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class PartBody:
    """A component of a part: where it is, and which cells belong to it.

    Parameters
    ----------
    middle : (3,) float64
        Of the box around it, mm.
    box : three slices
        Of the grid.
    cells : (nx, ny, nz) bool
        True for the cells of this box that belong to the component.
    """

    middle: NDArray[np.float64]
    box: tuple[slice, ...]
    cells: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class Bodies:
    """Draws a pattern body by body.

    Parameters
    ----------
    space : Interior, optional
        The space in which they were found.
    drawn : tuple of (PartBody, Interior, Anchored)
        The bodies, each with its part of the space and its voids.
    """

    space: Interior | None = None
    drawn: tuple[tuple[PartBody, Interior, Anchored], ...] = ()

    def prepare(self, voids: Anchored, space: Interior, *, cell: float, width: float) -> Bodies:
        """Find the bodies in a space; see `Voids`."""
        drawn = self._draw_bodies(voids, space)
        return Bodies(
            space=space,
            drawn=tuple((body, box, anchored.prepare(box, cell=cell, width=width)) for body, box, anchored in drawn),
        )

    def with_widths(self, local: LocalWidths) -> Bodies:
        """Return the same with other local widths in the space."""
        return replace(
            self,
            drawn=tuple(
                (body, box, anchored.with_widths(_widths_in_box(local, box))) for body, box, anchored in self.drawn
            ),
        )

    def count(self, voids: Anchored, space: Interior, *, cell: float, width: float) -> int:
        """Count the fields of the body that needs the most."""
        drawn = self._draw_bodies(voids, space)
        return max((anchored.count(box_space, cell=cell, width=width) for _, box_space, anchored in drawn), default=0)

    def sharpest(self, voids: Anchored, space: Interior, *, cell: float, width: float) -> float:
        """Return the angle of the sharpest corners in any body, degrees; few are sharper, and it is 90 at most."""
        drawn = self._draw_bodies(voids, space)
        return min(
            (anchored.sharpest(box_space, cell=cell, width=width) for _, box_space, anchored in drawn), default=90.0
        )

    def into(self, voids: Anchored, out: Field, space: Interior, which: int, *, cell: float, width: float) -> float:
        """Write a field of all bodies; return how many cells it fills."""
        np.minimum(space.depth, np.float32(-BAND), out=out)
        filled = 0.0
        for body, box_space, anchored in self._draw_bodies(voids, space):
            if which < anchored.count(box_space, cell=cell, width=width):
                in_box = np.empty_like(box_space.depth)
                filled += anchored.into(in_box, box_space, which, cell=cell, width=width)
                np.copyto(out[body.box], in_box, where=body.cells)
        return filled

    def _draw_bodies(self, voids: Anchored, space: Interior) -> tuple[tuple[PartBody, Interior, Anchored], ...]:
        if self.space is space:
            return self.drawn
        drawn = []
        for body in find_bodies(space):
            corner = np.array([side.start for side in body.box])
            box_space = replace(
                space,
                layers=LayerStack.of(np.where(body.cells, space.depth[body.box], DEEP)),
                origin=space.origin + space.size * corner,
                walled=None,
                box_of=(space, corner),
            )
            anchored = voids.about(body.middle)
            if voids.local is not None:
                anchored = anchored.with_widths(_widths_in_box(voids.local, box_space))
            drawn.append((body, box_space, anchored))
        return tuple(drawn)


def _widths_in_box(local: LocalWidths, box_space: Interior) -> LocalWidths:
    """Return local widths in a box of the space that they belong to."""
    assert box_space.box_of is not None
    return local.in_box(box_space.box_of[1], box_space.shape)


def find_bodies(space: Interior) -> list[PartBody]:
    """Find the components of a part that have room inside their walls, by falling volume.

    A cell belongs to the component that encloses it, and a cell of the walls to the nearest component.
    """
    from scipy.ndimage import find_objects, grey_dilation, label, maximum_position

    walled = space.walled or space
    regions, count = label(walled.depth > 0)
    deepest = np.array(maximum_position(walled.depth, regions, np.arange(1, count + 1))).reshape(-1, 3)
    owner, middles = _find_owners(walled, walled.origin + walled.size * deepest)
    body_number = np.concatenate([[0], owner + 1]).astype(np.uint16)[regions]
    del regions
    for _ in range(math.ceil(BAND + float((space.depth - walled.depth).max()))):
        wider = grey_dilation(body_number, size=(3, 3, 3))
        np.copyto(body_number, wider, where=body_number == 0)
    return [
        PartBody(middle=middles[number], box=box, cells=body_number[box] == number + 1)
        for number, box in enumerate(find_objects(body_number))
        if box is not None
    ]


def _find_owners(space: Interior, points: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Find the component of a part that encloses each point (N, 3): its number (N,), and all middles, (M, 3) mm."""
    part = space.part
    names, count = shell_names(part)
    volume, shell = shell_volumes(part, names, count), names[part.faces[:, 0]]
    owner, middles = np.zeros(len(points), dtype=np.intp), []
    # The smaller ones last: they may lie in a cavity of a larger one.
    for number, outer in enumerate(sorted(np.flatnonzero(volume > 0).tolist(), key=lambda name: -volume[name])):
        body = select_faces(part, shell == outer)
        owner[winding_numbers(points, body) > 0] = number
        middles.append(np.asarray(body.bounds, dtype=np.float64).mean(axis=0))
    return owner, np.array(middles)
