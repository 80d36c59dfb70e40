"""The voids of a part, and their measurements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from infill.interior.crossing import median_width
from infill.interior.interior import Interior
from infill.isosurfaces.components import shell_names
from infill.meshes.measuring import volume_and_area
from infill.meshes.shells import select_faces
from infill.meshes.solids import shared_volume
from infill.meshes.split_components import concatenate_surfaces
from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class DeferredVoids:
    """Voids whose surfaces are made later.

    Parameters
    ----------
    volume : float
        mm³
    made : callable
        Makes them, simplified within a tolerance, mm.
    """

    volume: float
    made: Callable[[float], VoidMeshes]


@dataclass(frozen=True, kw_only=True, eq=False)
class VoidMeshes:
    """The voids of a part.

    Parameters
    ----------
    space : Interior
        The inside of the part.
    cell, width : float
        Of the pattern as it was drawn, mm: smoothing makes walls between narrow voids wider, and bars thinner.
    surfaces : list of Surface, mm
        The voids, facing outwards from them, one surface for each field.
    tolerance : float
        Largest distance by which simplifying has moved them, mm; not finite if unknown.
    islands, specks : int
        Numbers of floating pieces of solid, which were dropped, and of voids that were too small.
    walls : Surface or None, mm
        The inner side of the walls, if voids reach through them.
    loose : float
        mm³ of infill that was left out: pieces that float where the part was cut open, or that slicers do not print.
    unmade : DeferredVoids or None
        Set in place of surfaces until they are made.
    """

    space: Interior
    cell: float
    width: float
    surfaces: list[Surface]
    tolerance: float
    islands: int
    specks: int
    walls: Surface | None = None
    loose: float = 0.0
    unmade: DeferredVoids | None = None

    @property
    def surface(self) -> Surface:
        """All voids, mm."""
        return concatenate_surfaces(self.surfaces)

    @cached_property
    def count(self) -> int:
        """Number of voids."""
        return sum(shell_names(surface)[1] for surface in self.surfaces)

    @property
    def open(self) -> int:
        """Number of voids that reach out of an open side of the part."""
        opening = self.space.opening
        return 0 if opening is None else sum(int(opening.opened(surface).sum()) for surface in self.surfaces)

    @cached_property
    def shut(self) -> Surface:
        """Surface of the voids that do not reach out of an open side of the part, mm."""
        opening = self.space.opening
        if opening is None:
            return self.surface
        return concatenate_surfaces(
            [
                select_faces(surface, ~opening.opened(surface)[shell_names(surface)[0][surface.faces[:, 0]]])
                for surface in self.surfaces
            ]
        )

    @property
    def triangles(self) -> int:
        """Number of triangles of all voids."""
        return sum(len(surface.faces) for surface in self.surfaces)

    @cached_property
    def volume(self) -> float:
        """Volume of all voids inside the walls, mm³."""
        opening = self.space.opening
        if self.unmade is not None:
            return self.unmade.volume
        if opening is not None:
            return self.loose + sum(opening.volume(surface) for surface in self.surfaces)
        if self.walls is None:
            return sum(volume_and_area(surface)[0] for surface in self.surfaces)
        return self.loose + sum(shared_volume(surface, self.walls) for surface in self.surfaces)

    @cached_property
    def median(self) -> tuple[float | None, int]:
        """Median width of walls, or thickness of bars, away from the part's walls, mm; and the number of points."""
        wall, part = self.space.wall, self.space.part
        return median_width(part, self.surface, wall=wall, width=self.width) if self.surfaces else (None, 0)

    @property
    def density(self) -> float:
        """Solid share of the space inside the walls."""
        return 1 - self.volume / self._room_volume

    @property
    def density_before(self) -> float:
        """Density before anything was left out."""
        return 1 - (self.volume - self.loose) / self._room_volume

    @cached_property
    def _room_volume(self) -> float:
        """Volume inside the walls, mm³."""
        return self.space.volume if self.walls is None else self.walls.volume
