"""A surface: triangles as plain arrays, and what can be said of them."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh

AT_ONCE = 50_000  # faces measured at a time, so that they stay in the cache


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Triangles as plain arrays, so that the way to a file needs no mesh library.

    Parameters
    ----------
    vertices : (V, 3) float, mm
    faces : (F, 3) int, counter-clockwise seen from outside
    space : str
        Name of the axes, if they have one: "LPS" for medical images.
    """

    vertices: NDArray[np.floating]
    faces: NDArray[np.integer]
    space: str = ""

    @cached_property
    def closed(self) -> bool:
        """True if every edge has two faces that run along it in opposite directions."""
        if len(self.faces) == 0:
            return False
        count = len(self.vertices)
        rising, falling = [], []
        for i in range(3):
            start, end = self.faces[:, i].astype(np.int64), self.faces[:, (i + 1) % 3].astype(np.int64)
            if (start == end).any():
                return False
            up = start < end
            rising.append((start * count + end)[up])
            falling.append((end * count + start)[~up])
        there, back = np.concatenate(rising), np.concatenate(falling)
        helper = threading.Thread(target=back.sort)
        helper.start()
        there.sort()
        helper.join()
        return np.array_equal(there, back) and not bool((there[1:] == there[:-1]).any())

    @cached_property
    def _volume_and_area(self) -> tuple[float, float]:
        # Seen from the middle, so that far from the origin no digits are lost.
        vertices = self.vertices - self.vertices.mean(axis=0, dtype=np.float64)
        sixfold = doubled = 0.0
        for low in range(0, len(self.faces), AT_ONCE):
            a, b, c = (vertices[self.faces[low : low + AT_ONCE, i]].T for i in range(3))
            b, c = b - a, c - a
            normal = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
            sixfold += float(sum(part @ across for part, across in zip(a, normal, strict=True)))
            doubled += float(np.sqrt(sum(across**2 for across in normal)).sum())
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
        """V - E + F of a closed surface, in which every face has one and a half edges of its own."""
        return len(self.vertices) - len(self.faces) // 2

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Lower and upper corner, (2, 3), mm."""
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)], dtype=np.float64)

    def moved(self, vertices: NDArray[np.floating], *, space: str = "", mirrored: bool = False) -> Surface:
        """Return the same faces with other vertices (V, 3), turned over if those are mirrored.

        What is known of how the faces hang together stays known.
        """
        faces = self.faces[:, ::-1] if mirrored else self.faces
        other = Surface(vertices=vertices, faces=faces, space=space)
        if "closed" in self.__dict__:
            other.__dict__["closed"] = self.closed
        return other

    def to_trimesh(self) -> trimesh.Trimesh:
        """Return the same mesh as a trimesh.Trimesh; vertices are neither merged nor reordered."""
        import trimesh

        return trimesh.Trimesh(vertices=self.vertices, faces=self.faces, process=False)
