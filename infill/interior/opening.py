"""Sides of a part without a shell: its flat top or bottom, through which voids open."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import reduce
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.meshes.shells import first_of_shells, shell_volumes, with_faces
from infill.meshes.solids import FINE, in_one_place, solid_of, status, status_of, surface_from
from infill.meshes.winding import winding
from infill.surface import Surface

Open = Literal["top", "bottom", "both"]
Floats = NDArray[np.float64]

LEVEL = 1e-5  # of the part's longest side, by which a flat side may be uneven: as much as single precision makes it
LEAST = 1.0  # cells of the grid: voids that reach less deep into the part are left solid
# Cells of the grid: vertices of voids that are nearer to the plane are moved this far from it, so that no two that come
# of the cut are in one place; tried in turn.
NEAR = (0.03, 0.05, 0.02, 0.08)
ENDS: dict[str, tuple[str, ...]] = {"top": ("top",), "bottom": ("bottom",), "both": ("bottom", "top")}


@dataclass(frozen=True, kw_only=True, eq=False)
class Opening:
    """Where a part has no shell.

    Parameters
    ----------
    name : {"top", "bottom", "both"}
    low, high : float
        Heights between which the part lies, mm; not finite at an end that has its shell.
    shell : Surface, mm
        The part without the faces that have none.
    """

    name: Open
    low: float
    high: float
    shell: Surface

    def inside(self, heights: Floats) -> NDArray[np.bool_]:
        """Return which heights, mm, are those of the part."""
        return (heights >= self.low) & (heights <= self.high)

    def opened(self, voids: Surface) -> NDArray[np.bool_]:
        """Return which voids, component by component, reach out of the part: (N,)."""
        lowest, highest = _heights(voids)
        return (lowest < self.low) | (highest > self.high)

    def closed_ends(self, voids: list[Surface]) -> list[str]:
        """Return the open sides that no void reaches out of."""
        lowest, highest = (np.concatenate(each) for each in zip(*map(_heights, voids), strict=True))
        reached = {"bottom": bool((lowest < self.low).any()), "top": bool((highest > self.high).any())}
        return [end for end in ENDS[self.name] if not reached[end]]

    def reaching(self, voids: Surface, size: float) -> Surface | None:
        """Return the components of a surface that reach so deep into the part that they are of use, or None."""
        lowest, highest = _heights(voids)
        kept = (highest > self.low + LEAST * size) & (lowest < self.high - LEAST * size)
        if kept.all():
            return voids
        return with_faces(voids, kept[shell_names(voids)[0][voids.faces[:, 0]]]) if kept.any() else None

    def volume(self, voids: Surface) -> float:
        """Return what a closed surface encloses between the two heights, mm³.

        Notes
        -----
        By the divergence of (0, 0, z), which stays at the height of an end beyond it.

        >>> import trimesh
        >>> ball = trimesh.creation.icosphere()
        >>> whole = Surface(vertices=ball.vertices, faces=ball.faces)
        >>> half = Opening(name="top", low=-np.inf, high=0.0, shell=whole)
        >>> bool(np.isclose(half.volume(whole), ball.volume / 2))
        True
        """
        corners = np.asarray(voids.vertices, dtype=np.float64)[voids.faces]
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        seen = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
        heights = corners[:, :, 2]
        height = heights.mean(axis=1) - heights.mean()
        if math.isfinite(self.low):
            height = height + mean_above(self.low - heights)
        if math.isfinite(self.high):
            height = height - mean_above(heights - self.high)
        return float(seen @ height)


def mean_above(values: Floats) -> Floats:
    """Return the mean of the positive part of something straight over triangles, from its values at corners (N, 3).

    >>> mean_above(np.array([[1.0, 2, 3], [-1, -2, -3], [-1, -1, 1]])).round(4).tolist()
    [2.0, 0.0, 0.0833]
    """
    a, b, c = np.sort(values, axis=1).T
    mean = np.where(a >= 0, (a + b + c) / 3, 0.0)
    one, two = (a < 0) & (b <= 0) & (c > 0), (a < 0) & (b > 0)
    mean[one] = c[one] ** 3 / (3 * (c[one] - a[one]) * (c[one] - b[one]))
    mean[two] = (a[two] + b[two] + c[two]) / 3 - a[two] ** 3 / (3 * (b[two] - a[two]) * (c[two] - a[two]))
    return mean


def _heights(surface: Surface) -> tuple[Floats, Floats]:
    """Return the lowest and the highest place of every component, mm."""
    names, count = shell_names(surface)
    lowest, highest = np.full(count, np.inf), np.full(count, -np.inf)
    used = np.unique(surface.faces)
    height = np.asarray(surface.vertices, dtype=np.float64)[used, 2]
    np.minimum.at(lowest, names[used], height)
    np.maximum.at(highest, names[used], height)
    return lowest, highest


def flat_sides(part: Surface, name: Open) -> tuple[Opening, list[tuple[NDArray[np.bool_], float]]]:
    """Return where a part is to be open, and the faces of each of its ends with the way out, 1 up and -1 down.

    Raises
    ------
    GeometryError
        If there is no flat face at such an end.
    """
    heights = np.asarray(part.vertices, dtype=np.float64)[part.faces][:, :, 2]
    level = LEVEL * float(np.ptp(part.bounds, axis=0).max())
    found, low, high = [], -math.inf, math.inf
    for end in ENDS[name]:
        top = end == "top"
        at = float(heights.max() if top else heights.min())
        flat = (np.abs(heights - at) <= level).all(axis=1)
        if not flat.any():
            raise GeometryError(
                f"open is {name!r}, and the part has no flat face at its {end}, z = {at:.4g} mm; turn it so that one "
                "lies there, or cut it off flat"
            )
        low, high = (low, at) if top else (at, high)
        found.append((flat, 1.0 if top else -1.0))
    lids = np.logical_or.reduce([flat for flat, _ in found])
    shell = Surface(vertices=part.vertices, faces=part.faces[~lids])
    return Opening(name=name, low=low, high=high, shell=shell), found


def lengthened(part: Surface, ends: list[tuple[NDArray[np.bool_], float]], far: float) -> Surface:
    """Return a part whose flat sides are moved straight out, mm, with upright walls behind them.

    >>> import trimesh
    >>> box = trimesh.creation.box((2, 3, 4))
    >>> whole = Surface(vertices=box.vertices, faces=box.faces)
    >>> longer = lengthened(whole, flat_sides(whole, "both")[1], 1.0)
    >>> longer.closed, round(longer.volume, 9), longer.bounds[:, 2].tolist()
    (True, 36.0, [-3.0, 3.0])
    """
    for flat, way in ends:
        part = _moved_out(part, flat, way * far)
    return part


def _moved_out(part: Surface, flat: NDArray[np.bool_], far: float) -> Surface:
    # The faces keep their numbers: those of the other end are still where they were.
    vertices, faces = np.asarray(part.vertices, dtype=np.float64), np.array(part.faces, dtype=np.int64)
    flat = np.pad(flat, (0, len(faces) - len(flat)))
    own = np.unique(faces[flat])
    number = np.full(len(vertices), -1, dtype=np.int64)
    number[own] = len(vertices) + np.arange(len(own))
    edges = np.concatenate([faces[flat][:, [i, (i + 1) % 3]] for i in range(3)])
    codes, back = edges[:, 0] * len(vertices) + edges[:, 1], edges[:, 1] * len(vertices) + edges[:, 0]
    a, b = edges[~np.isin(codes, back)].T
    sides = np.concatenate([np.stack([a, b, number[b]], axis=1), np.stack([a, number[b], number[a]], axis=1)])
    faces[flat] = number[faces[flat]]
    moved = vertices[own] + np.array([0.0, 0.0, far])
    return Surface(vertices=np.concatenate([vertices, moved]), faces=np.concatenate([faces, sides]))


def cut_open(
    solid: Surface, voids: list[Surface], opening: Opening, size: float, *, threads: int | None = None
) -> tuple[Surface, int, float]:
    """Return a solid without its voids, which reach out of its open sides; what is left out, in pieces and in mm³.

    That are pieces of infill that hung on nothing but what was beyond the side.

    Parameters
    ----------
    solid : Surface, mm
    voids : list of Surface, mm
    opening : Opening
    size : float
        Of a cell of the grid, mm.

    Raises
    ------
    GeometryError
        If manifold3d does not take the voids.
    """
    whole, best = solid_of(solid), None
    for found in _cut(whole, voids, opening, size):
        if best is None or int(in_one_place(found).sum()) < int(in_one_place(best).sum()):
            best = found
        if best.closed and not in_one_place(best).any():
            break
    if best is None:
        raise GeometryError("manifold3d does not take the voids as solids; give another cell or smaller voxels")
    return _without_loose(best, solid, opening, threads)


def between(surface: Surface, opening: Opening, size: float) -> Surface:
    """Return what a surface encloses between the open sides of a part; `size` is that of a cell of the grid, mm."""
    for near in NEAR:
        found = solid_of(_off_the_plane(surface, opening, near * size))
        if math.isfinite(opening.low):
            found = found.trim_by_plane((0.0, 0.0, 1.0), opening.low)
        if math.isfinite(opening.high):
            found = found.trim_by_plane((0.0, 0.0, -1.0), -opening.high)
        if status_of(found) == FINE and not in_one_place(cut := surface_from(found)).any():
            break
    return cut


def _cut(whole: object, voids: list[Surface], opening: Opening, size: float) -> Iterator[Surface]:
    import manifold3d

    assert isinstance(whole, manifold3d.Manifold)
    for near in NEAR:
        solids = [solid_of(_off_the_plane(each, opening, near * size)) for each in voids]
        if any(status_of(each) != FINE for each in (whole, *solids)):
            continue
        left = reduce(lambda one, other: one - other, solids, whole)
        if status_of(left) == FINE and not left.is_empty():
            yield (found := surface_from(left))
            if in_one_place(found).any() and status(merged := _in_single_places(found)) == FINE:
                yield merged


def _in_single_places(surface: Surface) -> Surface:
    """Return a surface without its edges that single precision makes points."""
    _, first, number = np.unique(
        np.asarray(surface.vertices, dtype=np.float32), axis=0, return_index=True, return_inverse=True
    )
    twin = in_one_place(surface)
    name = np.arange(len(surface.vertices))
    name[twin] = first[number.ravel()[twin]]
    faces = name[surface.faces]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return with_faces(replace(surface, faces=faces), whole)


def _off_the_plane(voids: Surface, opening: Opening, near: float) -> Surface:
    vertices = np.array(voids.vertices, dtype=np.float64)
    for end in (opening.low, opening.high):
        off = vertices[:, 2] - end
        close = np.abs(off) < near
        vertices[close, 2] = end + np.where(off[close] < 0, -near, near)
    return replace(voids, vertices=vertices)


def _without_loose(found: Surface, solid: Surface, opening: Opening, threads: int | None) -> tuple[Surface, int, float]:
    """Return a solid without the components that have nothing of its skin but an open side."""
    names, count = shell_names(found)
    volume = shell_volumes(found, names, count)
    held = np.zeros(count, dtype=bool)
    held[names[_of_skin(found, solid, opening)]] = True
    loose = np.flatnonzero((volume > 0) & ~held)
    lost, left = 0.0, found
    for each in loose:
        piece = with_faces(found, names[found.faces[:, 0]] == each)
        own, first = shell_names(left)[0], first_of_shells(left)
        gone = winding(np.asarray(left.vertices, dtype=np.float64)[first], piece, threads=threads) > 0
        gone[own[np.flatnonzero((np.asarray(left.vertices) == piece.vertices[0]).all(axis=1))]] = True
        lost += float(volume[each])
        left = with_faces(left, ~gone[own[left.faces[:, 0]]])
    return left, len(loose), lost


def _of_skin(found: Surface, solid: Surface, opening: Opening) -> NDArray[np.intp]:
    """Return the vertices that are those of faces of a solid besides its open sides."""
    vertices = np.asarray(solid.vertices, dtype=np.float64)
    level = LEVEL * float(np.ptp(solid.bounds, axis=0).max())
    heights = vertices[solid.faces][:, :, 2]
    lids = np.any([(np.abs(heights - end) <= level).all(axis=1) for end in (opening.low, opening.high)], axis=0)
    corners = np.unique(vertices[np.unique(solid.faces[~lids])], axis=0)
    both = np.concatenate([corners, np.asarray(found.vertices, dtype=np.float64)])
    _, number = np.unique(both, axis=0, return_inverse=True)
    number = number.ravel()
    return np.flatnonzero(np.isin(number[len(corners) :], number[: len(corners)]))
