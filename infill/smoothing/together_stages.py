"""The stages of labels smoothed together: the partition, and its tetrahedra, which are made when they are asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from infill.errors import GeometryError
from infill.formats.label_walls import LabelTetrahedra, LabelWalls
from infill.formats.vtk_writing import write_vtu
from infill.machine import require_memory
from infill.partition.tetrahedral_mesh import cut_tetrahedra
from infill.partition.tetrahedral_quality import TetrahedralQuality, improve_tetrahedra, measure_quality
from infill.smoothing.label_stages import LabelStages

if TYPE_CHECKING:
    from infill.partition.volumes import VolumePartition
    from infill.partition.walls import Walls
    from infill.reports.smoothing import TetrahedraKeys
    from infill.volume import Volume

BYTES_PER_CELL = 4000  # of the grid, for about nine tetrahedra and those around their points; a measured peak
ADVICE = "give --roi for a part of the volume, or a volume of larger voxels"


@dataclass(frozen=True, kw_only=True, eq=False)
class WallStages(LabelStages):
    """Walls that labels share.

    Parameters
    ----------
    written : Walls
        The walls as they are written, in cells.
    volume : Volume
        The labels, or their place in space alone.
    values : tuple of int
        The value of the label with each number; 0 comes first, for all others.
    """

    written: Walls
    volume: Volume
    values: tuple[int, ...]

    @property
    def walls(self) -> LabelWalls:
        """The walls as they are written, mm, with the values of the labels on both sides."""
        walls = self.written
        values = np.array([*self.values, 0])  # the last is beyond the box
        labels = values[walls.sides]
        is_turned = walls.sides[:, 0] == 0  # so that triangles at the outside face outwards
        labels[is_turned] = labels[is_turned, ::-1]
        triangles = np.where((is_turned != self.volume.mirrored)[:, None], walls.triangles[:, ::-1], walls.triangles)
        points = self.volume.place(walls.points.astype(np.float64) * self.volume.cell_size)
        return LabelWalls(points=points, triangles=triangles, labels=labels)

    def write_walls(self, write: Callable[[LabelWalls, BinaryIO], None], file: BinaryIO) -> None:
        """Write the walls of all labels with a writer of a format."""
        write(self.walls, file)


@dataclass(frozen=True, kw_only=True, eq=False)
class TogetherStages(WallStages):
    """The stages of `infill.smooth_labels` with `together`.

    Parameters
    ----------
    partition : VolumePartition
        The walls with all triangles, in cells.
    max_memory : int or None, bytes
    """

    partition: VolumePartition
    max_memory: int | None = None

    @cached_property
    def tetrahedra(self) -> LabelTetrahedra:
        """Tetrahedra that fill the labels, face to face, mm.

        Raises
        ------
        GeometryError
            If one would be inside out.
        MemoryLimitError
        """
        return self._tetrahedra[0]

    @property
    def tetrahedra_facts(self) -> TetrahedraKeys:
        """Number and shapes of the tetrahedra, for the report."""
        mesh, quality, moved = self._tetrahedra
        return {
            "tetrahedra": len(mesh.tetrahedra),
            "points": len(mesh.points),
            "smallest_angle": quality.smallest_angle,
            "slivers": quality.slivers,
            "mean_radius_ratio": quality.mean_ratio,
            "moved": moved,
        }

    @cached_property
    def _tetrahedra(self) -> tuple[LabelTetrahedra, TetrahedralQuality, int]:
        """The tetrahedra, their shapes, and the number of points of walls that moved."""
        graph, cell_size = self.partition.graph, self.volume.cell_size
        require_memory(graph.winners.size * BYTES_PER_CELL, self.max_memory, ADVICE)
        mesh = cut_tetrahedra(graph, self.partition.walls.points)
        mesh, moved = improve_tetrahedra(mesh, graph, tuple((cell_size / cell_size.min()).tolist()))
        points = self.volume.place(mesh.points * cell_size)
        tetrahedra = mesh.tetrahedra[:, [0, 2, 1, 3]] if self.volume.mirrored else mesh.tetrahedra
        quality = measure_quality(points, tetrahedra)
        if quality.inverted:
            raise GeometryError(f"{quality.inverted:,} tetrahedra would be inside out; give fewer steps")
        labels = np.array(self.values)[mesh.labels]
        return LabelTetrahedra(points=points, tetrahedra=tetrahedra, labels=labels), quality, moved

    def write_tetrahedra(self, file: BinaryIO) -> None:
        """Write the tetrahedra as .vtu."""
        write_vtu(self.tetrahedra, file)
