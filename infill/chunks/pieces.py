"""The piece of surface of one chunk: its triangles and vertices are those of the whole surface, to the last bit.

A piece has the triangles of the cubes that the chunk owns. Their corners lie on edges of the grid; a vertex is named by
its edge (`edge_names`), and belongs to the chunk in which the edge begins:

    own        vertices of the chunk, then those inside cubes with undecided signs
    foreign    vertices of the next chunks that its triangles take
    shared     vertices of its own that triangles of the chunks before it may take
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.chunks.fields import ChunkField
from infill.chunks.layout import Chunk
from infill.isosurfaces.sparse_marching import (
    CountedBricks,
    count_bricks,
    crossed_bricks,
    rows_above,
    triangulate_at,
    write_bricks,
)
from infill.kernels.chunk_sums import sum_shells
from infill.kernels.sparse import BRICK
from infill.kernels.sparse_marching import scale_to_mm
from infill.meshes.shells import vertex_components

Names = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """A piece of surface.

    Parameters
    ----------
    vertices : (V + W, 3) float64, mm along the axes of the grid
        V of its own, then W foreign ones.
    rate : (V + W, 3) float32
        Their movement when the level rises by one.
    faces : (F, 3) int32
    own : int
        V.
    foreign : (W,) int64
        The names of the foreign vertices.
    shared, shared_at : (S,) int64
        The names of the shared vertices, and their numbers.
    """

    vertices: NDArray[np.float64]
    rate: NDArray[np.float32]
    faces: NDArray[np.int32]
    own: int
    foreign: Names
    shared: Names
    shared_at: Names


@dataclass(frozen=True, kw_only=True, eq=False)
class UndecidedCubes:
    """The cubes of a chunk whose signs do not decide their triangles.

    Parameters
    ----------
    bricks : (b,) int64
        The numbers of the bricks that hold them, on the lattice of the whole volume, rising.
    counts : (b,) int64
        The number of cubes in each.
    """

    bricks: Names
    counts: Names


def count_piece(chunk_field: ChunkField, chunk: Chunk, level: float) -> tuple[CountedBricks, int, UndecidedCubes]:
    """Count the output of a chunk; return it with the number of its own bricks, which come first, and its cubes."""
    field = chunk_field.field
    bits = rows_above(field, field.values, level, threads=1)
    places = crossed_bricks(field, bits, 1)
    owned = chunk.owns(places)
    behind = (places + np.array(chunk.kept_low) >= np.array(chunk.low)).all(axis=1)  # no triangle takes others
    ordered = np.concatenate([places[owned], places[behind & ~owned]])
    bricks, count = count_bricks(field, bits, ordered, threads=1), int(owned.sum())
    cubes = np.diff(bricks.offsets[: count + 1, 2])
    numbers = brick_numbers(places[owned].astype(np.int64) + np.array(chunk.kept_low), chunk)
    return bricks, count, UndecidedCubes(bricks=numbers[cubes > 0], counts=cubes[cubes > 0])


def brick_numbers(places: Names, chunk: Chunk) -> Names:
    """Return the numbers of bricks (N, 3) of the whole lattice, the last axis fastest."""
    _, second, third = chunk.lattice
    numbers: Names = (places[:, 0] * second + places[:, 1]) * third + places[:, 2]
    return numbers


def edge_names(points: NDArray[np.float64], chunk: Chunk) -> Names:
    """Name vertices (N, 3) by their edges of the grid; points are in cells from the centre of the first cell."""
    cells = np.floor(points)
    axis = (points != cells).argmax(axis=1)
    x, y, z = (cells + 1).astype(np.int64).T  # -1, before the grid, becomes 0
    sizes = [count + 2 for count in chunk.shape]
    names: Names = ((x * sizes[1] + y) * sizes[2] + z) * 3 + axis
    return names


def make_piece(
    chunk_field: ChunkField,
    chunk: Chunk,
    counted: tuple[CountedBricks, int, UndecidedCubes],
    *,
    level: float,
    spacing: tuple[float, ...],
    first_cubes: Names,
) -> Piece:
    """Make the piece of surface of a chunk at a level of its field.

    Parameters
    ----------
    chunk_field : ChunkField
    chunk : Chunk
    counted : tuple
        What `count_piece` returned.
    level : float
    spacing : (hx, hy, hz), mm
    first_cubes : (b,) int64
        For each brick with undecided cubes, their number in all bricks of the whole volume before it.
    """
    bricks, own_count, cubes = counted
    corner = np.array(chunk.kept_low) * BRICK
    raw = write_bricks(chunk_field.field, bricks, level=level, first=tuple(corner.tolist()), threads=1)
    owned, own_faces, own_cubes = bricks.offsets[own_count].tolist()
    vertices, rate, faces = raw.vertices, raw.rate, raw.faces[:own_faces]
    inner = np.empty((0, 3))
    if own_cubes:
        per_brick = np.diff(bricks.offsets[:, 2])
        numbers = np.zeros(len(raw.corners), dtype=np.int64)
        rank = np.arange(own_cubes) - np.repeat(np.cumsum(cubes.counts) - cubes.counts, cubes.counts)
        numbers[:own_cubes] = np.repeat(first_cubes, cubes.counts) + rank
        assert per_brick[:own_count].sum() == own_cubes
        chosen = np.arange(len(numbers)) < own_cubes
        inner, inner_faces = triangulate_at(raw, chosen, numbers, len(vertices))
        faces = np.concatenate([faces, inner_faces])
    used = np.zeros(len(vertices) + len(inner), dtype=bool)
    used[faces] = True
    foreign = np.flatnonzero(used[: len(vertices)][owned:]) + owned
    order = np.concatenate([np.arange(owned), len(vertices) + np.arange(len(inner)), foreign])
    number = np.full(len(used), -1, dtype=np.int32)
    number[order] = np.arange(len(order), dtype=np.int32)
    points = np.concatenate([vertices, inner])[order]
    rates = np.concatenate([rate, np.zeros((len(inner), 3), dtype=np.float32)])[order]
    is_shared = np.zeros(owned, dtype=bool)
    for axis in range(3):
        if chunk.low[axis] > 0:
            is_shared |= np.floor(points[:owned, axis]) == chunk.low[axis] * BRICK[axis] - 1
    shared_at = np.flatnonzero(is_shared)
    names, foreign_names = edge_names(points[shared_at], chunk), edge_names(vertices[foreign], chunk)
    scale_to_mm(points, rates, np.array(spacing), np.zeros(3), 0, 1)
    return Piece(
        vertices=points,
        rate=rates,
        faces=number[faces],
        own=owned + len(inner),
        foreign=foreign_names,
        shared=names,
        shared_at=shared_at,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class ShellParts:
    """The connected parts of a piece, and their share in the sums of the whole.

    Parameters
    ----------
    names : (V + W,) int32
        The part of each vertex.
    sums : (s, 4) int64
        Six times volume and slope in cells, each in two integers: see `infill.kernels.chunk_sums`.
    vertices, faces : (s,) int64
        Vertices of its own, and triangles, of each part.
    """

    names: NDArray[np.int32]
    sums: NDArray[np.int64]
    vertices: NDArray[np.int64]
    faces: NDArray[np.int64]


def measure_parts(piece: Piece, chunk: Chunk, spacing: tuple[float, ...]) -> ShellParts:
    """Label the connected parts of a piece and measure them."""
    names, count = vertex_components(piece.faces, len(piece.vertices))
    middle = np.array(chunk.shape) * np.array(spacing) / 2
    sums = np.zeros((count, 4), dtype=np.int64)
    cell = float(np.prod(np.array(spacing)))
    sum_shells(piece.vertices, piece.rate, piece.faces, names, middle, cell, sums)
    return ShellParts(
        names=names,
        sums=sums,
        vertices=np.bincount(names[: piece.own], minlength=count),
        faces=np.bincount(names[piece.faces[:, 0]], minlength=count),
    )


def vertex_places(points: NDArray[np.float64], spacing: tuple[float, ...], chunk: Chunk) -> NDArray[np.int32]:
    """Return the cells of the lattice that hold points (N, 3), mm, counted from the first kept brick of a chunk.

    The whole volume is looked up in the same way: see `infill.isosurfaces.levels.nearest_components`.
    """
    lattice = np.array(chunk.lattice) * BRICK - 1
    place = np.floor(points / np.array(spacing) + 1).astype(np.int64).clip(0, lattice)
    return np.asarray(place - np.array(chunk.kept_low) * BRICK, dtype=np.int32)
