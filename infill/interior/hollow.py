"""The voids of a part, and what is told of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from infill.interior.crossing import median_width
from infill.interior.interior import Space
from infill.isosurfaces.components import shell_names
from infill.meshes.measuring import volume_and_area
from infill.meshes.shells import with_faces
from infill.meshes.solids import volume_within
from infill.meshes.split_components import joined
from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class Unmade:
    """Voids whose surfaces are yet to be made.

    Parameters
    ----------
    volume : float
        mm³
    made : callable
        Returns them, simplified within a tolerance, mm.
    """

    volume: float
    made: Callable[[float], Hollow]


@dataclass(frozen=True, kw_only=True, eq=False)
class Hollow:
    """The voids of a part.

    Parameters
    ----------
    space : Space
        The inside of the part.
    cell, width : float
        Of the pattern as it was drawn, mm: smoothing makes walls between narrow voids wider, and bars thinner.
    surfaces : list of Surface, mm
        The voids, facing outwards from them, one surface for each field.
    tolerance : float
        mm by which simplifying has moved them, at most; not finite if that was not watched.
    islands, specks : int
        Pieces of solid that would have hung free in a void, and voids that were too small.
    walls : Surface or None, mm
        The inner side of the walls, if voids reach through them.
    loose : float
        mm³ of infill that was left out: what hung free where the part was cut open, or slicers print none for.
    unmade : Unmade or None
        What is known in place of surfaces.
    """

    space: Space
    cell: float
    width: float
    surfaces: list[Surface]
    tolerance: float
    islands: int
    specks: int
    walls: Surface | None = None
    loose: float = 0.0
    unmade: Unmade | None = None

    @property
    def surface(self) -> Surface:
        """All voids, mm."""
        return joined(self.surfaces)

    @cached_property
    def count(self) -> int:
        """How many voids there are."""
        return sum(shell_names(surface)[1] for surface in self.surfaces)

    @property
    def open(self) -> int:
        """How many voids reach out of an open side of the part."""
        opening = self.space.opening
        return 0 if opening is None else sum(int(opening.opened(surface).sum()) for surface in self.surfaces)

    @cached_property
    def shut(self) -> Surface:
        """The voids that reach out of no open side of the part, mm."""
        opening = self.space.opening
        if opening is None:
            return self.surface
        return joined(
            [
                with_faces(surface, ~opening.opened(surface)[shell_names(surface)[0][surface.faces[:, 0]]])
                for surface in self.surfaces
            ]
        )

    @property
    def triangles(self) -> int:
        """Of all voids."""
        return sum(len(surface.faces) for surface in self.surfaces)

    @cached_property
    def volume(self) -> float:
        """Of all voids inside the walls, mm³."""
        opening = self.space.opening
        if self.unmade is not None:
            return self.unmade.volume
        if opening is not None:
            return self.loose + sum(opening.volume(surface) for surface in self.surfaces)
        if self.walls is None:
            return sum(volume_and_area(surface)[0] for surface in self.surfaces)
        return self.loose + sum(volume_within(surface, self.walls) for surface in self.surfaces)

    @cached_property
    def median(self) -> tuple[float | None, int]:
        """How wide walls are, or bars thick, mm: the median where the part's walls are not near; of how many points."""
        wall, part = self.space.wall, self.space.part
        return median_width(part, self.surface, wall=wall, width=self.width) if self.surfaces else (None, 0)

    @property
    def density(self) -> float:
        """Solid share of what lies inside the walls."""
        return 1 - self.volume / self._room

    @property
    def density_before(self) -> float:
        """That before anything was left out."""
        return 1 - (self.volume - self.loose) / self._room

    @cached_property
    def _room(self) -> float:
        """What lies inside the walls, mm³."""
        return self.space.volume if self.walls is None else self.walls.volume
