"""The voids of a tall part slab by slab, if they are upright: memory does not grow with the height of the part.

A step of the equation moves nothing further than a cell. So a slab is smoothed together with one layer beside it for
each step, and is the same as in the whole part, to the last bit. Slabs that are alike are computed once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.components import shell_names
from infill.isosurfaces.slabs import (
    SlabPiece,
    cut_slab_piece,
    measure_slab_shells,
    simplify_piece,
    stitch_pieces,
    sum_shell_volumes,
)
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.lattices.bodies import Fields
from infill.lattices.surfacing import SHARE, SPECK, choose_smoothing, drop_useless, smooth_void
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import DeferredVoids, VoidMeshes
from infill.meshes.shells import select_faces
from infill.surface import Surface

Outcome = TypeVar("Outcome")


def count_filled_cells(fields: Fields) -> float:
    """Count the cells that voids fill before they are smoothed, parts of cells counted as such."""

    def count(depth: NDArray[np.float32], *_: int) -> float:
        """Count the cells of a slab that all fields fill."""
        out = np.empty_like(depth)
        return sum(fields.write_sdf(out, which, depth) for which in range(fields.count))

    return sum(filled for _, filled in fields.layout.space.layers.map_slabs(count))


def defer_voids(task: FillTask, fields: Fields) -> VoidMeshes:
    """Defer the making of voids: compute only their volume."""
    least, volume = SPECK**3, 0.0
    for slabs in _map_pieces(task, fields, measure_slab_shells):
        volumes = sum_shell_volumes([shells for _, shells in slabs])
        volume += float(volumes[volumes >= least].sum()) * fields.layout.space.size**3
    return VoidMeshes(layout=fields.layout, deferred=DeferredVoids(volume=volume, fields=fields))


def surfaces_by_slabs(task: FillTask, fields: Fields, *, tolerance: float) -> VoidMeshes:
    """Make the surfaces of voids; those of a slab are simplified before the next slab is made.

    Parameters
    ----------
    task : FillTask
    fields : VoidFields or BodyFields
    tolerance : float
        mm; where slabs meet, all triangles stay, and with 0 everywhere.
    """
    size, origin = fields.layout.space.size, fields.layout.space.origin
    counts = np.zeros(2, dtype=np.int64)  # of pieces of solid that hang free, and of voids that are too small

    def simplify(piece: SlabPiece) -> _CleanPiece:
        cleaned = _clean_piece(piece)
        if cleaned.piece is None or tolerance == 0:
            return cleaned
        return replace(cleaned, piece=simplify_piece(cleaned.piece, SHARE * tolerance / size))

    def stitch() -> Iterator[Surface]:
        results = _map_pieces(task, fields, simplify)
        while results:  # popped, so that pieces are freed once they are stitched
            slabs = results.pop(0)
            for _, cleaned in slabs:
                counts[:] += (0, 0) if cleaned is None else cleaned.counts
            if any(cleaned is not None and cleaned.piece is not None for _, cleaned in slabs):
                surface = stitch_pieces(_pop_pieces(slabs))
                vertices = surface.vertices
                vertices *= size
                vertices += origin
                yield replace(surface, vertices=vertices)

    hollow = drop_useless(stitch(), fields.layout)
    islands, specks = counts.tolist()
    return replace(hollow, islands=hollow.islands + islands, specks=hollow.specks + specks)


def _pop_pieces(slabs: list[tuple[int, _CleanPiece | None]]) -> Iterator[tuple[int, SlabPiece | None]]:
    """Yield the pieces in slabs, from the bottom, and empty the list."""
    while slabs:
        low, cleaned = slabs.pop(0)
        yield low, None if cleaned is None else cleaned.piece


@dataclass(frozen=True, kw_only=True, eq=False)
class _CleanPiece:
    """The useful part of a piece, if any; the number of floating bits of solid, and of voids that are too small."""

    piece: SlabPiece | None
    counts: tuple[int, int]


def _clean_piece(piece: SlabPiece) -> _CleanPiece:
    """Drop shells of a piece that are too small and lie entirely inside the piece."""
    names, _ = shell_names(piece.surface)
    shells = measure_slab_shells(piece)
    small = np.abs(shells.volumes) < SPECK**3
    small[shells.low] = small[shells.high] = False
    if not small.any():
        return _CleanPiece(piece=piece, counts=(0, 0))
    is_kept, solid = ~small[names[piece.surface.faces[:, 0]]], shells.volumes < 0
    return _CleanPiece(
        piece=replace(piece, surface=select_faces(piece.surface, is_kept)) if is_kept.any() else None,
        counts=(int((small & solid).sum()), int((small & ~solid).sum())),
    )


def _map_pieces(
    task: FillTask, fields: Fields, function: Callable[[SlabPiece], Outcome | None]
) -> list[list[tuple[int, Outcome | None]]]:
    """Apply a function to each piece; return the results with the first layer of each slab, a list for each field."""
    smoothing, threads = choose_smoothing(task, fields), task.threads

    def process(depth: NDArray[np.float32], low: int, high: int) -> list[Outcome | None]:
        """Apply the function to the piece of each field in a slab."""
        outcomes: list[Outcome | None] = []
        for which in range(fields.count):
            distance, piece = np.empty_like(depth), None
            fields.write_sdf(distance, which, depth)
            if (field := smooth_void(distance, depth, smoothing, threads=threads)) is not None:
                surface = extract_bricks(field, spacing=(1.0,) * 3, origin=(-0.5,) * 3, threads=threads)
                piece = cut_slab_piece(surface, low, high)
            outcomes.append(None if piece is None else function(piece))
        return outcomes

    slabs = fields.layout.space.layers.map_slabs(process, below=smoothing.steps + 1, above=smoothing.steps + 2)
    return [[(low, outcomes[which]) for low, outcomes in slabs] for which in range(fields.count)]
