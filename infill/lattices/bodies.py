"""A pattern that starts over in every body: each component of a part has it about its own middle."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.interior.interior import BAND, Interior
from infill.interior.layer_stack import LayerStack
from infill.isosurfaces.components import shell_names
from infill.lattices.choosing import place_pattern
from infill.lattices.request import FillSpec
from infill.lattices.voids import Layout, VoidFields
from infill.meshes.shells import select_faces, shell_volumes
from infill.meshes.winding import winding_numbers
from infill.paths.ties import Ties

DEEP = np.float32(-1e6)  # cells: where no void is


@dataclass(frozen=True, kw_only=True, eq=False)
class PartBody:
    """A component of a part: where it is, and which cells belong to it.

    Parameters
    ----------
    bounds : (2, 3) float64, mm
    box : three slices
        Of the grid.
    cells : (nx, ny, nz) bool
        True for the cells of this box that belong to the component.
    """

    bounds: NDArray[np.float64]
    box: tuple[slice, ...]
    cells: NDArray[np.bool_]

    @property
    def corner(self) -> NDArray[np.int64]:
        """The first cell of the box, (3,)."""
        return np.array([side.start for side in self.box])

    def crop(self, space: Interior) -> Interior:
        """Return the box of a space; there is no room in it except in the body."""
        return replace(
            space,
            layers=LayerStack.of(np.where(self.cells, space.depth[self.box], DEEP)),
            origin=space.origin + space.size * self.corner,
            walled=None,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class BodyFields:
    """The voids of a pattern that starts over in every body.

    Parameters
    ----------
    layout : Layout
    bodies : tuple of (PartBody, VoidFields)
        The bodies, each with its voids in its box.
    """

    layout: Layout
    bodies: tuple[tuple[PartBody, VoidFields], ...]

    @property
    def count(self) -> int:
        """Number of fields of the body that needs the most."""
        return max((fields.count for _, fields in self.bodies), default=0)

    @property
    def ties(self) -> Ties:
        """Bars that tie islands of lines to the rest, in all bodies, mm."""
        return Ties.none().join([fields.ties for _, fields in self.bodies])

    def find_sharpest(self) -> float:
        """Find the angle of the sharpest corners in any body, degrees; few are sharper, and it is 90 at most."""
        return min((fields.find_sharpest() for _, fields in self.bodies), default=90.0)

    def write_sdf(self, out: Field, which: int, depth: Field) -> float:
        """Write a field of all bodies; return the number of cells it fills."""
        np.minimum(depth, np.float32(-BAND), out=out)
        filled = 0.0
        for body, fields in self.bodies:
            if which < fields.count:
                in_box = np.empty_like(body.cells, dtype=np.float32)
                filled += fields.write_sdf(in_box, which, fields.layout.space.depth)
                np.copyto(out[body.box], in_box, where=body.cells)
        return filled


Fields = VoidFields | BodyFields


def draw_in_bodies(request: FillSpec, layout: Layout, known: BodyFields | None = None) -> BodyFields:
    """Draw the requested pattern about the middle of each body; what suits of an earlier drawing is used again."""
    space, local = layout.space, layout.local
    if known is not None and known.layout.space is space:
        boxes: list[tuple[PartBody, Interior, VoidFields | None]] = [
            (body, fields.layout.space, fields) for body, fields in known.bodies
        ]
    else:
        boxes = [(body, body.crop(space), None) for body in find_bodies(space)]
    bodies = []
    for body, box, fields in boxes:
        in_box = replace(layout, space=box, local=local and local.in_box(body.corner, box.shape))
        bodies.append((body, place_pattern(request, body.bounds).draw(in_box, fields)))
    return BodyFields(layout=layout, bodies=tuple(bodies))


def find_bodies(space: Interior) -> list[PartBody]:
    """Find the components of a part that have room inside their walls, by falling volume.

    A cell belongs to the component that encloses it, and a cell of the walls to the nearest component.
    """
    from scipy.ndimage import find_objects, grey_dilation, label, maximum_position

    walled = space.walled or space
    regions, count = label(walled.depth > 0)
    deepest = np.array(maximum_position(walled.depth, regions, np.arange(1, count + 1))).reshape(-1, 3)
    owner, bounds = _find_owners(walled, walled.origin + walled.size * deepest)
    body_number = np.concatenate([[0], owner + 1]).astype(np.uint16)[regions]
    del regions
    for _ in range(math.ceil(BAND + float((space.depth - walled.depth).max()))):
        wider = grey_dilation(body_number, size=(3, 3, 3))
        np.copyto(body_number, wider, where=body_number == 0)
    return [
        PartBody(bounds=bounds[number], box=box, cells=body_number[box] == number + 1)
        for number, box in enumerate(find_objects(body_number))
        if box is not None
    ]


def _find_owners(space: Interior, points: NDArray[np.float64]) -> tuple[NDArray[np.intp], list[NDArray[np.float64]]]:
    """Find the component of a part that encloses each point (N, 3): its number (N,), and the bounds of each, mm."""
    part = space.part
    names, count = shell_names(part)
    volume, shell = shell_volumes(part, names, count), names[part.faces[:, 0]]
    owner, bounds = np.zeros(len(points), dtype=np.intp), []
    # The smaller ones last: they may lie in a cavity of a larger one.
    for number, outer in enumerate(sorted(np.flatnonzero(volume > 0).tolist(), key=lambda name: -volume[name])):
        body = select_faces(part, shell == outer)
        owner[winding_numbers(points, body) > 0] = number
        bounds.append(np.asarray(body.bounds, dtype=np.float64))
    return owner, bounds
