"""Fewer triangles for the surface of a volume in chunks: tasks on its parts, and on the boxes around their seams.

The pieces of surface are fragments: their vertices have numbers by which fragments are joined. A vertex that stays has
its number among those of the whole surface, a new one a number of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.chunks.hashing import face_sums
from infill.chunks.layout import Chunk
from infill.chunks.level_parts import LevelTask
from infill.chunks.placing import place_points
from infill.chunks.seams import AROUND, ORIGINAL, Box, SeamPlan
from infill.chunks.tasks import make_part
from infill.chunks.work import Work
from infill.meshes.edge_collapse import collapse_edges
from infill.surface import Surface
from infill.volume import Volume

NUMBERS = 1 << 34  # numbers of new vertices for each fragment; the whole surface has fewer vertices
PARTS = 4096  # numbers of fragments for each chunk
Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Fragment:
    """A piece of surface.

    Parameters
    ----------
    numbers : (V,) int64
        Of its vertices.
    points : (V, 3) float64, mm along the axes of the grid
    faces : (F, 3) int32
    """

    numbers: Numbers
    points: NDArray[np.float64]
    faces: NDArray[np.int32]

    def select(self, chosen: NDArray[np.bool_]) -> Fragment:
        """Return the fragment of some faces (F,), with the vertices that they take."""
        faces = self.faces[chosen]
        used = np.zeros(len(self.points), dtype=bool)
        used[faces] = True
        rank = np.cumsum(used, dtype=np.int32) - np.int32(1)
        return Fragment(numbers=self.numbers[used], points=self.points[used], faces=rank[faces])

    @property
    def border(self) -> NDArray[np.bool_]:
        """Mask of the vertices (V,) at edges with one triangle."""
        ends = np.concatenate([self.faces[:, [0, 1]], self.faces[:, [1, 2]], self.faces[:, [2, 0]]]).astype(np.int64)
        ends.sort(axis=1)
        edges, count = np.unique(ends[:, 0] * len(self.points) + ends[:, 1], return_counts=True)
        single = edges[count == 1]
        marked = np.zeros(len(self.points), dtype=bool)
        marked[single // max(1, len(self.points))] = marked[single % max(1, len(self.points))] = True
        return marked


def join_fragments(fragments: Sequence[Fragment]) -> Fragment:
    """Join fragments at the vertices that they share; faces keep their order."""
    numbers = np.concatenate([np.empty(0, dtype=np.int64), *(piece.numbers for piece in fragments)])
    points = np.concatenate([np.empty((0, 3)), *(piece.points for piece in fragments)])
    joined, first, place = np.unique(numbers, return_index=True, return_inverse=True)
    place = place.reshape(-1).astype(np.int32)
    faces: list[NDArray[np.int32]] = [np.empty((0, 3), dtype=np.int32)]
    begin = 0
    for piece in fragments:
        faces.append(place[begin : begin + len(piece.points)][piece.faces].astype(np.int32))
        begin += len(piece.points)
    return Fragment(numbers=joined, points=points[first], faces=np.concatenate(faces))


@dataclass(frozen=True, kw_only=True, eq=False)
class SimplifiedPart:
    """A part of a chunk with fewer triangles.

    Parameters
    ----------
    fragment : Fragment
    original : Fragment
        Of its original triangles those near seams.
    """

    fragment: Fragment
    original: Fragment


def simplify_chunk(
    work: Work,
    chunk: Chunk,
    task: LevelTask,
    removed: NDArray[np.bool_],
    first: int,
    tolerance: float,
    place: Volume,
    foreign: Numbers,
) -> tuple[list[SimplifiedPart], Numbers]:
    """Simplify the surface of a chunk part by part; return the parts, and the sums of its triangles for the hash.

    Parameters
    ----------
    work, chunk, task, removed
        See `make_part`.
    first : int
        Number of its first vertex in the whole surface.
    tolerance : float, mm
    place : Volume
        The place of the grid in space.
    foreign : (W,) int64
        Numbers of its foreign vertices, in the order of their names.
    """
    part = make_part(work, chunk, task, removed)
    points = np.concatenate([part.vertices, part.corners])
    placed = place_points(points, place)
    faces = part.faces[:, ::-1] if place.mirrored else part.faces
    sums = face_sums(placed, faces, float(place.cell_size.max()) ** 2)
    numbers = np.concatenate([first + np.arange(len(part.vertices)), foreign])
    complete = Fragment(numbers=numbers, points=points, faces=part.faces.astype(np.int32))
    plan = SeamPlan(layout=work.layout)
    part_of = split_faces(complete, chunk, plan, work.spacing)
    around = plan.near_seams(points / np.array(work.spacing))[complete.faces].any(axis=1)
    parts = []
    for count, number in enumerate(np.unique(part_of)):
        chosen = part_of == number
        fragment = complete.select(chosen)
        base = NUMBERS * (1 + chunk.number * PARTS + count)
        simple = simplify_fragment(fragment, fragment.border, None, tolerance, base)
        parts.append(SimplifiedPart(fragment=simple, original=complete.select(chosen & around)))
    return parts, sums


def split_faces(complete: Fragment, chunk: Chunk, plan: SeamPlan, spacing: tuple[float, ...]) -> Numbers:
    """Return the part of the volume to which each face (F,) of a chunk belongs."""
    corners = (complete.points / np.array(spacing))[complete.faces]
    box = plan.box_of(chunk)
    cube = np.clip(np.floor(corners.min(axis=1)) + 0.5, np.array(box.low) + 0.5, np.array(box.high) - 0.5)
    return plan.parts_of(cube)


def simplify_fragment(
    fragment: Fragment, pinned: NDArray[np.bool_], original: Surface | None, tolerance: float, base: int
) -> Fragment:
    """Simplify a fragment, of which some vertices (V,) stay; its new vertices are numbered from `base`."""
    surface = Surface(vertices=fragment.points, faces=fragment.faces)
    if pinned.all():
        return fragment
    result = collapse_edges(surface, tolerance=tolerance, threads=1, pinned=pinned, original=original)
    if result is None:
        return fragment
    stays = fragment.numbers[pinned]
    fresh = base + np.arange(len(result.vertices) - len(stays))
    return Fragment(
        numbers=np.concatenate([stays, fresh]),
        points=np.asarray(result.vertices, dtype=np.float64),
        faces=result.faces.astype(np.int32),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class SimplifiedBox:
    """The changes in a box around a seam.

    Parameters
    ----------
    fragment : Fragment
        The faces that come.
    removed : list of (n,) int64
        The faces that go, of each of the fragments that were given.
    """

    fragment: Fragment
    removed: list[Numbers]


def simplify_box(
    spacing: tuple[float, ...],
    box: Box,
    fragments: list[Fragment],
    originals: list[Fragment],
    tolerance: float,
    base: int,
) -> SimplifiedBox:
    """Simplify the surface in a box: faces that lie in it change, others stay.

    Parameters
    ----------
    spacing : (hx, hy, hz), mm
    box : Box
    fragments : list of Fragment
        All faces that meet the box and `AROUND` cells around it.
    originals : list of Fragment
        The same, of the original surface.
    tolerance : float, mm
    base : int
        Number of the first new vertex.
    """
    current, was = join_fragments(fragments), join_fragments(originals)
    sizes = np.array(spacing)
    outside = ~box.holds(current.points / sizes)[current.faces].all(axis=1)
    pinned = np.zeros(len(current.points), dtype=bool)
    pinned[current.faces[outside]] = True
    pinned |= current.border
    nothing = SimplifiedBox(fragment=current.select(np.zeros(len(current.faces), dtype=bool)), removed=[])
    if pinned.all() or not len(was.faces):
        return nothing
    chosen = was.select(np.asarray(box.holds(was.points / sizes, ORIGINAL)[was.faces].any(axis=1)))
    original = Surface(vertices=chosen.points, faces=chosen.faces)
    simple = simplify_fragment(current, pinned, original, tolerance, base)
    if len(simple.faces) >= len(current.faces):
        return nothing
    stays = int(pinned.sum())
    gone, begin, removed = np.asarray(~pinned[current.faces].all(axis=1)), 0, []
    for fragment in fragments:
        removed.append(np.flatnonzero(gone[begin : begin + len(fragment.faces)]))
        begin += len(fragment.faces)
    return SimplifiedBox(fragment=simple.select(np.asarray((simple.faces >= stays).any(axis=1))), removed=removed)


def near_box(fragment: Fragment, box: Box, spacing: tuple[float, ...]) -> NDArray[np.bool_]:
    """Tell which faces (F,) of a fragment meet a box and `AROUND` cells around it."""
    corners = (fragment.points / np.array(spacing))[fragment.faces]
    return box.meets(corners.min(axis=1), corners.max(axis=1), AROUND)
