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

from infill.interior.hollow import DeferredVoids, VoidMeshes
from infill.interior.inside import SHARE
from infill.interior.interior import Interior
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
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.request import FillSpec
from infill.lattices.surfacing import SPECK, choose_smoothing, drop_inside_pieces, drop_small_and_floating, smooth_void
from infill.meshes.shells import select_faces
from infill.surface import Surface

Outcome = TypeVar("Outcome")


def count_filled_cells(space: Interior, voids: Prismatic, *, cell: float, width: float) -> float:
    """Count the cells that voids fill before they are smoothed, parts of cells counted as such."""
    planes = voids.planes(space, cell=cell, width=width)
    filled_by_slab: dict[tuple[object, ...], float] = {}
    filled = 0.0
    for low, high in space.layers.bounds():
        if (key := space.layers.alike(low, high)) not in filled_by_slab:
            depth = space.layers.between(low, high)
            out = np.empty_like(depth)
            filled_by_slab[key] = sum(voids.lesser(out, depth, plane, width / space.size) for plane in planes)
        filled += filled_by_slab[key]
    return filled


def defer_voids(
    space: Interior, voids: Prismatic, request: FillSpec, sizes: tuple[float, float], *, threads: int | None
) -> VoidMeshes:
    """Defer the making of voids: compute only their volume, and keep the function that makes their surfaces."""
    least, volume = SPECK**3, 0.0
    for slabs in _map_pieces(space, voids, request, sizes, measure_slab_shells, threads):
        volumes = sum_shell_volumes([shells for _, shells in slabs])
        volume += float(volumes[volumes >= least].sum()) * space.size**3

    def make(tolerance: float) -> VoidMeshes:
        return surfaces_by_slabs(space, voids, request, sizes, tolerance=tolerance, threads=threads)

    cell, width = sizes
    return VoidMeshes(
        space=space,
        cell=cell,
        width=width,
        surfaces=[],
        tolerance=0.0,
        islands=0,
        specks=0,
        unmade=DeferredVoids(volume=volume, made=make),
    )


def surfaces_by_slabs(
    space: Interior,
    voids: Prismatic,
    request: FillSpec,
    sizes: tuple[float, float],
    *,
    tolerance: float,
    threads: int | None,
) -> VoidMeshes:
    """Make the surfaces of the voids; those of a slab are simplified before the next slab is made.

    Parameters
    ----------
    tolerance : float
        mm; where slabs meet, all triangles stay, and with 0 everywhere.
    """
    cell, width = sizes
    counts = np.zeros(2, dtype=np.int64)  # of pieces of solid that hang free, and of voids that are too small
    lost: list[Surface] = []

    def simplify(piece: SlabPiece) -> _CleanPiece:
        cleaned = _clean_piece(piece)
        if cleaned.piece is None or tolerance == 0:
            return cleaned
        return replace(cleaned, piece=simplify_piece(cleaned.piece, SHARE * tolerance / space.size))

    surfaces = []
    fields = _map_pieces(space, voids, request, sizes, simplify, threads)
    while fields:  # popped, so that pieces are freed once they are stitched
        slabs = fields.pop(0)
        counts += np.sum([cleaned.counts for _, cleaned in slabs if cleaned is not None] or [(0, 0)], axis=0)
        if all(cleaned is None or cleaned.piece is None for _, cleaned in slabs):
            continue
        void_surface, islands, specks, loose = drop_small_and_floating(
            _scale_in_place(stitch_pieces(_pop_pieces(slabs)), space), (SPECK * space.size) ** 3
        )
        counts += (islands, specks)
        lost.extend(loose)
        if void_surface is not None:
            surfaces.append(void_surface)
    islands, specks = counts.tolist()
    return VoidMeshes(
        space=space,
        cell=cell,
        width=width,
        surfaces=[
            void for void in (drop_inside_pieces(surface, lost, threads) for surface in surfaces) if void is not None
        ],
        tolerance=0.0,
        islands=islands,
        specks=specks,
    )


def _pop_pieces(slabs: list[tuple[int, _CleanPiece | None]]) -> Iterator[tuple[int, SlabPiece | None]]:
    """Yield the pieces in slabs, from the bottom, and empty the list."""
    while slabs:
        low, cleaned = slabs.pop(0)
        yield low, None if cleaned is None else cleaned.piece


def _scale_in_place(surface: Surface, space: Interior) -> Surface:
    """Convert a surface from cells to mm; its vertices are overwritten."""
    vertices = surface.vertices
    vertices *= space.size
    vertices += space.origin
    return replace(surface, vertices=vertices)


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
    space: Interior,
    voids: Prismatic,
    request: FillSpec,
    sizes: tuple[float, float],
    function: Callable[[SlabPiece], Outcome | None],
    threads: int | None,
) -> list[list[tuple[int, Outcome | None]]]:
    """Apply a function to each piece; return the results with the first layer of each slab, a list for each field."""
    (cell, width), layers = sizes, space.layers
    smoothing = choose_smoothing(space, voids, request, sizes)
    planes = voids.planes(space, cell=cell, width=width)
    beside = smoothing.steps + 1

    def process(depth: NDArray[np.float32], plane: NDArray[np.float32], low: int, high: int) -> Outcome | None:
        distance = np.empty_like(depth)
        voids.lesser(distance, depth, plane, width / space.size)
        field = smooth_void(distance, depth, smoothing, threads=threads)
        if field is None:
            return None
        surface = extract_bricks(field, spacing=(1.0,) * 3, origin=(-0.5,) * 3, threads=threads)
        piece = cut_slab_piece(surface, low, high)
        return None if piece is None else function(piece)

    results_by_slab: dict[tuple[object, ...], list[Outcome | None]] = {}
    fields: list[list[tuple[int, Outcome | None]]] = [[] for _ in planes]
    for low, high in layers.bounds():
        low_layer, high_layer = max(0, low - beside), min(space.shape[2], high + 1 + beside)
        key = (low - low_layer, high - low_layer, *layers.alike(low_layer, high_layer))
        if key not in results_by_slab:
            depth = layers.between(low_layer, high_layer)
            results_by_slab[key] = [process(depth, plane, low - low_layer, high - low_layer) for plane in planes]
            del depth
        for field, result in zip(fields, results_by_slab[key], strict=True):
            field.append((low, result))
    return fields
