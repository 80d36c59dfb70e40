"""The voids of a tall part slab by slab, if they are upright: what is held at a time does not grow with its height.

A step of the equation moves nothing further than by a cell. So a slab is smoothed together with as many layers beside
it as there are steps, and is what it would be in the whole, to the last bit. Slabs that are alike are looked at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from infill.interior.hollow import Hollow, Unmade
from infill.interior.inside import SHARE
from infill.interior.interior import Space
from infill.isosurfaces.components import shell_names
from infill.isosurfaces.slabs import Piece, few_of, piece_between, shells_of, stitched, volumes_of
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.lattices.drawn_voids import Drawn
from infill.lattices.request import Request
from infill.lattices.surfacing import SPECK, outside_of, smoothed_void, smoothing_for, useful
from infill.meshes.shells import with_faces
from infill.surface import Surface

Found = TypeVar("Found")


def cells_filled(space: Space, voids: Drawn, *, cell: float, width: float) -> float:
    """Return how many cells voids fill before they are smoothed, parts of cells counted as such."""
    planes = voids.planes(space, cell=cell, width=width)
    known: dict[tuple[object, ...], float] = {}
    filled = 0.0
    for low, high in space.layers.bounds():
        if (key := space.layers.alike(low, high)) not in known:
            depth = space.layers.between(low, high)
            out = np.empty_like(depth)
            known[key] = sum(voids.lesser(out, depth, plane, width / space.size) for plane in planes)
        filled += known[key]
    return filled


def unmade(space: Space, voids: Drawn, request: Request, sizes: tuple[float, float], *, threads: int | None) -> Hollow:
    """Return voids of which only the volume is known, and how their surfaces are made."""
    least, volume = SPECK**3, 0.0
    for slabs in _by_field(space, voids, request, sizes, shells_of, threads):
        each = volumes_of([shells for _, shells in slabs])
        volume += float(each[each >= least].sum()) * space.size**3

    def made(tolerance: float) -> Hollow:
        return surfaces_by_slabs(space, voids, request, sizes, tolerance=tolerance, threads=threads)

    cell, width = sizes
    return Hollow(
        space=space,
        cell=cell,
        width=width,
        surfaces=[],
        tolerance=0.0,
        islands=0,
        specks=0,
        unmade=Unmade(volume=volume, made=made),
    )


def surfaces_by_slabs(
    space: Space,
    voids: Drawn,
    request: Request,
    sizes: tuple[float, float],
    *,
    tolerance: float,
    threads: int | None,
) -> Hollow:
    """Return the surfaces of the voids, of which those of a slab are simplified before the next one is made.

    Parameters
    ----------
    tolerance : float
        mm; where slabs meet, no triangle is taken, and 0 leaves all.
    """
    cell, width = sizes
    counts = np.zeros(2, dtype=np.int64)  # of pieces of solid that hang free, and of voids that are too small
    lost: list[Surface] = []

    def few(piece: Piece) -> _Few:
        found = _useful_piece(piece)
        if found.piece is None or tolerance == 0:
            return found
        return replace(found, piece=few_of(found.piece, SHARE * tolerance / space.size))

    surfaces = []
    fields = _by_field(space, voids, request, sizes, few, threads)
    while fields:  # what is stitched together is not kept in pieces too
        slabs = fields.pop(0)
        counts += np.sum([each.counts for _, each in slabs if each is not None] or [(0, 0)], axis=0)
        if all(each is None or each.piece is None for _, each in slabs):
            continue
        kept, islands, specks, loose = useful(_in_place(stitched(_taken(slabs)), space), (SPECK * space.size) ** 3)
        counts += (islands, specks)
        lost.extend(loose)
        if kept is not None:
            surfaces.append(kept)
    islands, specks = counts.tolist()
    return Hollow(
        space=space,
        cell=cell,
        width=width,
        surfaces=[each for each in (outside_of(surface, lost, threads) for surface in surfaces) if each is not None],
        tolerance=0.0,
        islands=islands,
        specks=specks,
    )


def _taken(slabs: list[tuple[int, _Few | None]]) -> Iterator[tuple[int, Piece | None]]:
    """Yield the pieces in slabs, from the bottom, and empty the list."""
    while slabs:
        low, each = slabs.pop(0)
        yield low, None if each is None else each.piece


def _in_place(surface: Surface, space: Space) -> Surface:
    """Return a surface in mm, of which the vertices were in cells and are overwritten."""
    vertices = surface.vertices
    vertices *= space.size
    vertices += space.origin
    return replace(surface, vertices=vertices)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Few:
    """What is of use in a piece, if anything is; how much solid hangs free in it, and how many voids are too small."""

    piece: Piece | None
    counts: tuple[int, int]


def _useful_piece(piece: Piece) -> _Few:
    """Return a piece without what is too small, as far as it lies in there entirely."""
    names, _ = shell_names(piece.surface)
    shells = shells_of(piece)
    small = np.abs(shells.volumes) < SPECK**3
    small[shells.low] = small[shells.high] = False
    if not small.any():
        return _Few(piece=piece, counts=(0, 0))
    kept, solid = ~small[names[piece.surface.faces[:, 0]]], shells.volumes < 0
    return _Few(
        piece=replace(piece, surface=with_faces(piece.surface, kept)) if kept.any() else None,
        counts=(int((small & solid).sum()), int((small & ~solid).sum())),
    )


def _by_field(
    space: Space,
    voids: Drawn,
    request: Request,
    sizes: tuple[float, float],
    then: Callable[[Piece], Found | None],
    threads: int | None,
) -> list[list[tuple[int, Found | None]]]:
    """Return what a function finds in each piece, with the first layer of its slab: a list for each field."""
    (cell, width), layers = sizes, space.layers
    smoothing = smoothing_for(space, voids, request, sizes)
    planes = voids.planes(space, cell=cell, width=width)
    beside = smoothing.steps + 1

    def found_in(depth: NDArray[np.float32], plane: NDArray[np.float32], low: int, high: int) -> Found | None:
        distance = np.empty_like(depth)
        voids.lesser(distance, depth, plane, width / space.size)
        field = smoothed_void(distance, depth, smoothing, threads=threads)
        if field is None:
            return None
        surface = extract_bricks(field, spacing=(1.0,) * 3, origin=(-0.5,) * 3, threads=threads)
        piece = piece_between(surface, low, high)
        return None if piece is None else then(piece)

    known: dict[tuple[object, ...], list[Found | None]] = {}
    found: list[list[tuple[int, Found | None]]] = [[] for _ in planes]
    for low, high in layers.bounds():
        first, last = max(0, low - beside), min(space.shape[2], high + 1 + beside)
        key = (low - first, high - first, *layers.alike(first, last))
        if key not in known:
            depth = layers.between(first, last)
            known[key] = [found_in(depth, plane, low - first, high - first) for plane in planes]
            del depth
        for each, one in zip(found, known[key], strict=True):
            each.append((low, one))
    return found
