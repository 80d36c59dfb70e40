"""A part to fill, with all that making its infill takes: the request, the pattern in its place, and the means."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.interior.local_walls import LocalWall
from infill.lattices.bodies import BodyFields, Fields, draw_in_bodies
from infill.lattices.choosing import place_pattern
from infill.lattices.placed_regions import check_places
from infill.lattices.region_nodes import PlacedRegion
from infill.lattices.request import FillSpec
from infill.lattices.voids import Layout, VoidFields, VoidPattern
from infill.result import Clock
from infill.surface import Surface
from infill.volume import Volume


@dataclass(frozen=True, kw_only=True, eq=False)
class FillTask:
    """A part to fill as requested.

    Parameters
    ----------
    part : Surface, mm
    request : FillSpec
        With the side of the cells of the grid in place of a resolution.
    pattern : VoidPattern
        The requested pattern, in its place in the part.
    clock : Clock
    threads, max_memory : int, optional
    """

    part: Surface
    request: FillSpec
    pattern: VoidPattern
    clock: Clock
    threads: int | None = None
    max_memory: int | None = None

    @classmethod
    def of(
        cls,
        part: Surface,
        request: FillSpec,
        *,
        clock: Clock | None = None,
        threads: int | None = None,
        max_memory: int | None = None,
    ) -> FillTask:
        """Make the task of a request; raise an error if pattern or regions cannot be had as requested."""
        check_places(request.regions, part.bounds)
        if request.resolution is not None:
            request = replace(request, voxel=float(np.ptp(part.bounds, axis=0).max()) / request.resolution)
        return cls(
            part=part,
            request=request,
            pattern=place_pattern(request, part.bounds),
            clock=clock or Clock(None),
            threads=threads,
            max_memory=max_memory,
        )

    def shift(self, phase: tuple[float, float, float]) -> FillTask:
        """Return the same task with the pattern shifted by a phase, mm, and a clock of its own."""
        request = replace(self.request, phase=phase)
        return replace(self, request=request, pattern=place_pattern(request, self.part.bounds), clock=Clock(None))

    @property
    def extents(self) -> NDArray[np.floating]:
        """Sides of the box around the part, (3,) mm."""
        extents: NDArray[np.floating] = np.ptp(self.part.bounds, axis=0)
        return extents

    @property
    def local_walls(self) -> tuple[LocalWall, ...]:
        """The regions with a wall of their own."""
        bounds = np.asarray(self.part.bounds, dtype=np.float64)
        return tuple(
            LocalWall(
                wall=region.wall,
                measure=partial(_measure_depths, region=region, bounds=bounds, threads=self.threads),
            )
            for region in self.request.regions
            if region.wall is not None
        )

    def space_for_voids(self, space: Interior) -> Interior:
        """Return the space that voids may take: through the skin where a slicer makes the shell, or there is none."""
        return space.through_walls if self.request.reaches_skin else space

    def draw(self, layout: Layout, known: Fields | None = None) -> Fields:
        """Draw the pattern; what suits of an earlier drawing is used again."""
        if self.request.align == "body":
            return draw_in_bodies(self.request, layout, known if isinstance(known, BodyFields) else None)
        return self.pattern.draw(layout, known if isinstance(known, VoidFields) else None)


def _measure_depths(
    cells: Volume, reach: float, *, region: PlacedRegion, bounds: Floats, threads: int | None
) -> NDArray[np.float32]:
    """Measure how far the centres of cells lie inside a region: see `PlacedRegion.measure_depths`."""
    return region.measure_depths(cells, bounds, reach, threads)
