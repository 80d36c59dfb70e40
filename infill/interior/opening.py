"""Sides of a part without a shell: its flat top or bottom, through which voids open."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.meshes.clipped_volume import volume_in_box
from infill.meshes.shells import select_faces, shell_volumes
from infill.meshes.solids import FINE, coincident_vertices, from_manifold, manifold_status, solid_status, to_manifold
from infill.meshes.split_components import drop_pieces
from infill.plain_numbers import plain_argument
from infill.surface import Surface

Open = Literal["top", "bottom", "both"]

LEVEL = 1e-5  # of the part's longest side, by which a flat side may be uneven: as much as single precision makes it
LEAST = 1.0  # cells of the grid: voids that reach less deep into the part are left solid
# Cells of the grid: vertices of voids that are nearer to the plane are moved this far from it, so that no two vertices
# of the cut coincide; tried in order.
NEAR = (0.03, 0.05, 0.02, 0.08)
ENDS: dict[str, tuple[str, ...]] = {"top": ("top",), "bottom": ("bottom",), "both": ("bottom", "top")}


@dataclass(frozen=True, kw_only=True, eq=False)
class Opening:
    """Sides of a part without a shell.

    Parameters
    ----------
    name : {"top", "bottom", "both"}
    low, high : float
        Heights between which the part lies, mm; not finite at an end that has its shell.
    shell : Surface, mm
        The faces of the part that have a shell.
    """

    name: Open
    low: float
    high: float
    shell: Surface

    def inside(self, heights: Floats) -> NDArray[np.bool_]:
        """Test which heights, mm, lie in the part."""
        return (heights >= self.low) & (heights <= self.high)

    def reaches_out(self, voids: Surface) -> NDArray[np.bool_]:
        """Test which voids, component by component, reach out of the part: (N,)."""
        lowest, highest = _component_heights(voids)
        return (lowest < self.low) | (highest > self.high)

    def closed_ends(self, voids: Sequence[Surface]) -> list[str]:
        """List the open sides that no void reaches out of."""
        lowest, highest = (np.concatenate(heights) for heights in zip(*map(_component_heights, voids), strict=True))
        reached = {"bottom": bool((lowest < self.low).any()), "top": bool((highest > self.high).any())}
        return [end for end in ENDS[self.name] if not reached[end]]

    def keep_reaching(self, voids: Surface, size: float) -> Surface | None:
        """Keep the components that reach over one cell, of `size` mm, into the part; return None without any."""
        lowest, highest = _component_heights(voids)
        is_deep = (highest > self.low + LEAST * size) & (lowest < self.high - LEAST * size)
        if is_deep.all():
            return voids
        return select_faces(voids, is_deep[shell_names(voids)[0][voids.faces[:, 0]]]) if is_deep.any() else None

    def volume(self, voids: Surface) -> float:
        """Compute the volume that a closed surface encloses between the two heights, mm³.

        >>> import trimesh
        >>> ball = trimesh.creation.icosphere()
        >>> whole = Surface(vertices=ball.vertices, faces=ball.faces)
        >>> half = Opening(name="top", low=-np.inf, high=0.0, shell=whole)
        >>> bool(np.isclose(half.volume(whole), ball.volume / 2))
        True
        """
        sides = np.array([np.inf, np.inf])
        return volume_in_box(voids, np.append(-sides, self.low), np.append(sides, self.high))


def _component_heights(surface: Surface) -> tuple[Floats, Floats]:
    """Return the lowest and the highest point of every component, mm."""
    names, count = shell_names(surface)
    lowest, highest = np.full(count, np.inf), np.full(count, -np.inf)
    used = np.unique(surface.faces)
    height = np.asarray(surface.vertices, dtype=np.float64)[used, 2]
    np.minimum.at(lowest, names[used], height)
    np.maximum.at(highest, names[used], height)
    return lowest, highest


def find_flat_ends(part: Surface, name: Open) -> tuple[Opening, list[tuple[NDArray[np.bool_], float]]]:
    """Find the flat ends of a part; return the opening, and for each end its faces and the way out, 1 up or -1 down.

    Raises
    ------
    GeometryError
        If an end has no flat face.
    """
    heights = np.asarray(part.vertices, dtype=np.float64)[part.faces][:, :, 2]
    level = LEVEL * float(np.ptp(part.bounds, axis=0).max())
    ends, low, high = [], -math.inf, math.inf
    for end in ENDS[name]:
        is_top = end == "top"
        at = float(heights.max() if is_top else heights.min())
        flat = (np.abs(heights - at) <= level).all(axis=1)
        if not flat.any():
            raise GeometryError.about(
                "open",
                f"is {name!r}, and the part has no flat face at its {end}, z = {plain_argument(at, 4)} mm; turn it so "
                "that one lies there, or cut it off flat",
            )
        low, high = (low, at) if is_top else (at, high)
        ends.append((flat, 1.0 if is_top else -1.0))
    lids = np.logical_or.reduce([flat for flat, _ in ends])
    shell = Surface(vertices=part.vertices, faces=part.faces[~lids])
    return Opening(name=name, low=low, high=high, shell=shell), ends


def extend_ends(part: Surface, ends: list[tuple[NDArray[np.bool_], float]], far: float) -> Surface:
    """Move the flat sides of a part straight out, mm, and add upright walls behind them.

    >>> import trimesh
    >>> box = trimesh.creation.box((2, 3, 4))
    >>> whole = Surface(vertices=box.vertices, faces=box.faces)
    >>> longer = extend_ends(whole, find_flat_ends(whole, "both")[1], 1.0)
    >>> longer.closed, round(longer.volume, 9), longer.bounds[:, 2].tolist()
    (True, 36.0, [-3.0, 3.0])
    """
    for flat, way in ends:
        part = _move_out(part, flat, way * far)
    return part


def _move_out(part: Surface, flat: NDArray[np.bool_], distance: float) -> Surface:
    """Move flat faces by a distance, mm, along z, up if positive, and join them to the rest by upright faces."""
    # The faces keep their numbers, so that masks of the other end still hold.
    vertices, faces = np.asarray(part.vertices, dtype=np.float64), np.array(part.faces, dtype=np.int64)
    flat = np.pad(flat, (0, len(faces) - len(flat)))
    used = np.unique(faces[flat])
    number = np.full(len(vertices), -1, dtype=np.int64)
    number[used] = len(vertices) + np.arange(len(used))
    edges = np.concatenate([faces[flat][:, [i, (i + 1) % 3]] for i in range(3)])
    codes, reversed_codes = edges[:, 0] * len(vertices) + edges[:, 1], edges[:, 1] * len(vertices) + edges[:, 0]
    a, b = edges[~np.isin(codes, reversed_codes)].T
    sides = np.concatenate([np.stack([a, b, number[b]], axis=1), np.stack([a, number[b], number[a]], axis=1)])
    faces[flat] = number[faces[flat]]
    moved = vertices[used] + np.array([0.0, 0.0, distance])
    return Surface(vertices=np.concatenate([vertices, moved]), faces=np.concatenate([faces, sides]))


def cut_open(
    solid: Surface,
    voids: Sequence[Surface],
    opening: Opening,
    size: float,
    *,
    keep_loose: bool = False,
    threads: int | None = None,
) -> tuple[Surface, int, float]:
    """Subtract voids that reach out of the open sides of a solid; return it with the count and mm³ of dropped pieces.

    Dropped are pieces of infill that were held only by material beyond the side, unless `keep_loose`.

    Parameters
    ----------
    solid : Surface, mm
    voids : sequence of Surface, mm
    opening : Opening
    size : float
        Of a cell of the grid, mm.

    Raises
    ------
    GeometryError
        If manifold3d rejects the voids.
    """
    manifold, best = to_manifold(solid), None
    for candidate in _cut_candidates(manifold, voids, opening, size):
        if best is None or int(coincident_vertices(candidate).sum()) < int(coincident_vertices(best).sum()):
            best = candidate
        if best.closed and not coincident_vertices(best).any():
            break
    if best is None:
        raise GeometryError("manifold3d rejects the voids as solids; give another cell or smaller voxels")
    return (best, 0, 0.0) if keep_loose else _drop_loose(best, solid, opening, threads)


def clip_to_opening(surface: Surface, opening: Opening, size: float) -> Surface:
    """Cut a surface off at the open sides of a part; `size` is that of a cell of the grid, mm."""
    cut: Surface | None = None
    for distance in NEAR:
        trimmed = to_manifold(_move_off_planes(surface, opening, distance * size))
        if math.isfinite(opening.low):
            trimmed = trimmed.trim_by_plane((0.0, 0.0, 1.0), opening.low)
        if math.isfinite(opening.high):
            trimmed = trimmed.trim_by_plane((0.0, 0.0, -1.0), -opening.high)
        if solid_status(trimmed) == FINE and not coincident_vertices(cut := from_manifold(trimmed)).any():
            break
    if cut is None:
        raise GeometryError("manifold3d rejects the inside of the part; give another cell or smaller voxels")
    return cut


def _cut_candidates(body: object, voids: Sequence[Surface], opening: Opening, size: float) -> Iterator[Surface]:
    """Yield the body minus the voids, whose vertices keep one of several distances from the open sides, if it is solid.

    A candidate with vertices that coincide in single precision is followed by itself with these merged.
    """
    import manifold3d

    assert isinstance(body, manifold3d.Manifold)
    for distance in NEAR:
        solids = [to_manifold(_move_off_planes(void, opening, distance * size)) for void in voids]
        if any(solid_status(solid) != FINE for solid in (body, *solids)):
            continue
        remainder = reduce(lambda rest, solid: rest - solid, solids, body)
        if solid_status(remainder) == FINE and not remainder.is_empty():
            yield (candidate := from_manifold(remainder))
            if (
                coincident_vertices(candidate).any()
                and manifold_status(merged := _merge_coincident_vertices(candidate)) == FINE
            ):
                yield merged


def _merge_coincident_vertices(surface: Surface) -> Surface:
    """Merge vertices that are the same in single precision, and drop the triangles that this makes edges."""
    _, representative, number = np.unique(
        np.asarray(surface.vertices, dtype=np.float32), axis=0, return_index=True, return_inverse=True
    )
    twin = coincident_vertices(surface)
    merged_vertex = np.arange(len(surface.vertices))
    merged_vertex[twin] = representative[number.ravel()[twin]]
    faces = merged_vertex[surface.faces]
    is_triangle = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return select_faces(replace(surface, faces=faces), is_triangle)


def _move_off_planes(voids: Surface, opening: Opening, distance: float) -> Surface:
    """Move vertices near the planes of the open sides away from these, up or down, to a distance, mm."""
    vertices = np.array(voids.vertices, dtype=np.float64)
    for end in (opening.low, opening.high):
        height = vertices[:, 2] - end
        close = np.abs(height) < distance
        vertices[close, 2] = end + np.where(height[close] < 0, -distance, distance)
    return replace(voids, vertices=vertices)


def _drop_loose(cut: Surface, solid: Surface, opening: Opening, threads: int | None) -> tuple[Surface, int, float]:
    """Drop the components that keep nothing of the skin except an open side; return count and mm³ too."""
    names, count = shell_names(cut)
    volume = shell_volumes(cut, names, count)
    is_held = np.zeros(count, dtype=bool)
    is_held[names[_find_skin_vertices(cut, solid, opening)]] = True
    is_loose = (volume > 0) & ~is_held
    rest = drop_pieces(cut, [select_faces(cut, names[cut.faces[:, 0]] == n) for n in np.flatnonzero(is_loose)], threads)
    return rest, int(is_loose.sum()), float(volume[is_loose].sum())


def _find_skin_vertices(cut: Surface, solid: Surface, opening: Opening) -> NDArray[np.intp]:
    """Find the vertices that belong to the skin of a solid, not counting its open sides."""
    vertices = np.asarray(solid.vertices, dtype=np.float64)
    level = LEVEL * float(np.ptp(solid.bounds, axis=0).max())
    heights = vertices[solid.faces][:, :, 2]
    lids = np.any([(np.abs(heights - end) <= level).all(axis=1) for end in (opening.low, opening.high)], axis=0)
    corners = np.unique(vertices[np.unique(solid.faces[~lids])], axis=0)
    both = np.concatenate([corners, np.asarray(cut.vertices, dtype=np.float64)])
    _, number = np.unique(both, axis=0, return_inverse=True)
    number = number.ravel()
    return np.flatnonzero(np.isin(number[len(corners) :], number[: len(corners)]))
