"""The surfaces of labels that share their walls, each cut out of these when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_order, thread_count
from infill.meshes.measuring import measure_surface
from infill.partition.walls import LabelCutter, Walls
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.volume import Volume


@dataclass(frozen=True, kw_only=True)
class LabelMeasures:
    """What is known of the surface of a label.

    Parameters
    ----------
    number : int
        Of the label among the pieces, from 1 on.
    triangles : int
    closed : bool
    volume : float, mm³
    area : float, mm²
    """

    number: int
    triangles: int
    closed: bool
    volume: float
    area: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LabelSurfaces(Mapping[str, Surface]):
    """Surfaces by the names of labels; neighbours have the same coordinates at walls.

    They are held in memory no longer than someone uses them, since each takes a copy of its walls.

    Parameters
    ----------
    walls : Walls
        Of all labels, in cells.
    cutter : LabelCutter
        Of these walls.
    volume : Volume
        The place of the cells in space.
    measures : mapping of str to LabelMeasures
        Of the labels that have a surface.
    """

    walls: Walls
    cutter: LabelCutter
    volume: Volume
    measures: Mapping[str, LabelMeasures]
    _used: WeakValueDictionary[str, Surface] = field(default_factory=WeakValueDictionary, init=False)

    @classmethod
    def of(cls, walls: Walls, volume: Volume, names: Sequence[str], *, threads: int | None = None) -> LabelSurfaces:
        """Measure the surfaces of labels 1, 2 ..., by their names; those without any volume are left out."""
        cutter = LabelCutter.of(walls.triangles, walls.sides, len(names) + 1)
        surfaces = cls(walls=walls, cutter=cutter, volume=volume, measures={})
        measures = {}
        measured = in_order(surfaces.measure, range(1, len(names) + 1), threads=thread_count(threads))
        for number, facts in measured:
            if facts.volume > 0:
                measures[names[number - 1]] = facts
        return cls(walls=walls, cutter=cutter, volume=volume, measures=measures)

    def __getitem__(self, name: str) -> Surface:
        """Return the surface of a label; it is the same object as long as it is in use."""
        surface = self._used.get(name)
        if surface is None:
            facts = self.measures[name]
            surface = self.cut(facts.number).with_measures(closed=facts.closed, volume=facts.volume, area=facts.area)
            self._used[name] = surface
        return surface

    def __contains__(self, name: object) -> bool:
        """Tell whether a label has a surface, without making it."""
        return name in self.measures

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        return iter(self.measures)

    def __len__(self) -> int:
        """Return the number of labels that have a surface."""
        return len(self.measures)

    def __repr__(self) -> str:
        """Return the names."""
        return f"LabelSurfaces({', '.join(self)})"

    def cut(self, number: int) -> Surface:
        """Cut out the surface of a label, mm."""
        cut = self.cutter.cut(number)
        vertices = (
            self.volume.place(self.walls.points[cut.points] * self.volume.cell_size)
            if self._turned is None
            else self._turned[cut.points]
        )
        faces = cut.faces[:, ::-1] if self.volume.mirrored else cut.faces
        return Surface(vertices=vertices, faces=faces, space=self.volume.space)

    def measure(self, number: int) -> LabelMeasures:
        """Measure the surface of a label."""
        surface = self.cut(number)
        count = len(surface.faces)
        if not count:
            return LabelMeasures(number=number, triangles=0, closed=False, volume=0.0, area=0.0)
        known = measure_surface(surface, threads=1)
        return LabelMeasures(number=number, triangles=count, closed=known.closed, volume=known.volume, area=known.area)

    @cached_property
    def _turned(self) -> NDArray[np.float64] | None:
        """All points in space, mm, if the volume is turned; else None.

        A turn is done for all points at once: then neighbours have the same coordinates to the last bit.
        """
        if (np.asarray(self.volume.direction) == np.eye(3)).all():
            return None
        return self.volume.place(self.walls.points * self.volume.cell_size)


@dataclass(frozen=True, kw_only=True, eq=False)
class NumberedSurfaces(Mapping[int, Surface]):
    """The same surfaces by the numbers of labels."""

    surfaces: LabelSurfaces

    @cached_property
    def _names(self) -> dict[int, str]:
        """The names by number."""
        return {facts.number: name for name, facts in self.surfaces.measures.items()}

    def __getitem__(self, number: int) -> Surface:
        """Return the surface of a label."""
        return self.surfaces[self._names[number]]

    def __contains__(self, number: object) -> bool:
        """Tell whether a label has a surface, without making it."""
        return number in self._names

    def __iter__(self) -> Iterator[int]:
        """Iterate over the numbers."""
        return iter(self._names)

    def __len__(self) -> int:
        """Return the number of labels that have a surface."""
        return len(self._names)
