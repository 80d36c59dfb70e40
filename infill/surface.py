"""A surface: triangles as plain arrays, with derived quantities."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh

FACES_AT_ONCE = 50_000  # faces measured at a time, so that they stay in the cache


@dataclass(frozen=True, kw_only=True)
class Edges:
    """The edges of triangles, each once, ordered by their vertices; sides of zero length are left out.

    Parameters
    ----------
    ends : (E, 2) int64
        Two vertices, the lower one first.
    ahead, back : (E,) int64
        Number of faces that run along the edge from the lower vertex to the higher one, and from higher to lower.
    """

    ends: NDArray[np.int64]
    ahead: NDArray[np.int64]
    back: NDArray[np.int64]

    @classmethod
    def of(cls, faces: NDArray[np.integer]) -> Edges:
        """Return the edges of faces (F, 3).

        >>> edges = Edges.of(np.array([[0, 1, 2], [0, 2, 3]]))
        >>> edges.ends[edges.faces == 2].tolist()
        [[0, 2]]
        """
        edge_numbers, is_backward = np.divmod(_sorted_edge_keys(faces), 2)
        starts = np.flatnonzero(np.diff(edge_numbers, prepend=-1))
        faces_of, back = np.diff(starts, append=len(edge_numbers)), np.add.reduceat(is_backward, starts)
        ends = np.stack(np.divmod(edge_numbers[starts], int(faces.max()) + 1), axis=1)
        has_length = ends[:, 0] != ends[:, 1]
        return cls(ends=ends[has_length], ahead=(faces_of - back)[has_length], back=back[has_length])

    @property
    def faces(self) -> NDArray[np.int64]:
        """Number of faces at each edge: two in a closed surface."""
        return self.ahead + self.back

    @property
    def surplus(self) -> NDArray[np.int64]:
        """Number of faces that run forwards along each edge minus those that run backwards: 0 if closed as a sum."""
        return self.ahead - self.back


@dataclass(frozen=True, kw_only=True)
class Modifier:
    """A volume of a slicer's project in which infill or walls are set.

    Parameters
    ----------
    name : str
    surface : Surface, mm
    density : float or None
        The share that the slicer fills, 0 to 1; None if it is that of the part.
    pattern : str or None
        The pattern; None if it is that of the part, or has no equivalent.
    slicer_pattern : str or None
        The slicer's name of it.
    wall : float or None
        Thickness of the slicer's perimeters, mm; None if they are those of the part.
    """

    name: str
    surface: Surface
    density: float | None = None
    pattern: str | None = None
    slicer_pattern: str | None = None
    wall: float | None = None


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Triangles as plain arrays, so that writing a file needs no mesh library.

    Parameters
    ----------
    vertices : (V, 3) float, mm
    faces : (F, 3) int, counter-clockwise seen from outside
    space : str
        Name of the coordinate system, if it has one: "LPS" for medical images.
    notes : tuple of str
        Remarks of the reader on changes and omissions, a phrase each.
    modifiers : tuple of Modifier
        Volumes of a slicer's project that do not belong to the surface; later ones lie over earlier ones.
    """

    vertices: NDArray[np.floating]
    faces: NDArray[np.integer]
    space: str = ""
    notes: tuple[str, ...] = ()
    modifiers: tuple[Modifier, ...] = ()

    def __repr__(self) -> str:
        """Return the counts, without the arrays."""
        return f"Surface({len(self.vertices):,} vertices, {len(self.faces):,} triangles)"

    @cached_property
    def closed(self) -> bool:
        """True if every edge has two faces that run along it in opposite directions."""
        if len(self.faces) == 0 or len(self.faces) % 2:
            return False
        ahead, back = _sorted_edge_keys(self.faces).reshape(-1, 2).T
        return bool((back == ahead + 1).all() and not (ahead & 1).any() and (ahead[1:] != ahead[:-1]).all())

    @cached_property
    def edges(self) -> Edges | None:
        """Edges of the surface; None without faces."""
        return Edges.of(self.faces) if len(self.faces) else None

    @cached_property
    def _volume_and_area(self) -> tuple[float, float]:
        # Relative to the mean vertex, so that no digits are lost far from the origin.
        """Enclosed volume, mm³, and area, mm²."""
        vertices = self.vertices - self.vertices.mean(axis=0, dtype=np.float64)
        sixfold = doubled = 0.0
        for low in range(0, len(self.faces), FACES_AT_ONCE):
            a, b, c = (vertices[self.faces[low : low + FACES_AT_ONCE, i]].T for i in range(3))
            b, c = b - a, c - a
            normal = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
            # Not by BLAS: waking its threads takes longer than such a product.
            sixfold += sum(
                float(np.einsum("i,i->", component, normal_component))
                for component, normal_component in zip(a, normal, strict=True)
            )
            doubled += float(np.sqrt(sum(normal_component**2 for normal_component in normal)).sum())
        return sixfold / 6, doubled / 2

    @property
    def volume(self) -> float:
        """Enclosed volume, mm³; negative if the faces point inwards."""
        return self._volume_and_area[0]

    @property
    def area(self) -> float:
        """Area of all faces, mm²."""
        return self._volume_and_area[1]

    @cached_property
    def euler_number(self) -> int:
        """V - E + F of a closed surface, in which E = 3/2 F."""
        return len(self.vertices) - len(self.faces) // 2

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Lower and upper corner, (2, 3), mm."""
        # Axis by axis: a reduction along the first of two axes is ten times as slow.
        return np.array([[end(axis) for axis in self.vertices.T] for end in (np.min, np.max)], dtype=np.float64)

    @property
    def knows_closed(self) -> bool:
        """True if `closed` is computed already."""
        return "closed" in self.__dict__

    def with_measures(self, *, closed: bool, volume: float, area: float) -> Surface:
        """Return the same surface with quantities measured elsewhere: see `infill.meshes.measuring`."""
        copy = Surface(vertices=self.vertices, faces=self.faces, space=self.space)
        copy.__dict__.update(closed=closed, _volume_and_area=(volume, area))
        return copy

    def moved(self, vertices: NDArray[np.floating], *, space: str = "", mirrored: bool = False) -> Surface:
        """Return the same faces with new vertices (V, 3); reverse the faces if the vertices are mirrored.

        A known value of `closed` is kept.
        """
        faces = self.faces[:, ::-1] if mirrored else self.faces
        copy = Surface(vertices=vertices, faces=faces, space=space)
        if self.knows_closed:
            copy.__dict__["closed"] = self.closed
        return copy

    def scaled(self, times: float) -> Surface:
        """Return the surface and its modifiers, several times as large."""
        modifiers = tuple(replace(each, surface=each.surface.scaled(times)) for each in self.modifiers)
        return replace(self, vertices=self.vertices * times, modifiers=modifiers)

    def to_trimesh(self) -> trimesh.Trimesh:
        """Return the same mesh as a trimesh.Trimesh; vertices are neither merged nor reordered."""
        import trimesh

        return trimesh.Trimesh(vertices=self.vertices, faces=self.faces, process=False)


def _sorted_edge_keys(faces: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return the directed edges of all faces as sorted integer keys (3 F,).

    The edge from vertex i to j > i gets 2 (i n + j), with n the number of vertices, and that from j to i one more. So
    both directions are adjacent, that from the lower vertex first; keys of a closed surface come in pairs: an even
    number and the next one.
    """
    vertex_count = int(faces.max()) + 1
    sides = np.empty((3, len(faces)), dtype=np.int64)
    corners = [faces[:, i].astype(np.int64) for i in range(3)]
    for out, start, end in zip(sides, corners, (corners[1], corners[2], corners[0]), strict=True):
        np.minimum(start, end, out=out)
        out *= vertex_count
        out += np.maximum(start, end)
        out *= 2
        out += start > end
    numbers = sides.ravel()
    numbers.sort()
    return numbers
