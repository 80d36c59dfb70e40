"""The holes to plan for a part, and the part as seen from the directions in which they lead."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_places import TurnedPart
from infill.drains.holes import DrainNeeds
from infill.interior.opening import Opening
from infill.isosurfaces.components import shell_names
from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainTask:
    """The holes to plan for the voids of a part: see `infill.drains.drain_plan.plan_drains`.

    Parameters
    ----------
    part, voids : Surface, mm
    needs : DrainNeeds
    vent : bool
    places : tuple of (x, y, z), mm
    opening : Opening or None
    names : (V,) int64
        The void of every vertex of the voids: they are numbered by falling volume.
    volumes : tuple of float
        Of the voids, mm³.
    """

    part: Surface
    voids: Surface
    needs: DrainNeeds
    vent: bool
    places: tuple[tuple[float, float, float], ...]
    opening: Opening | None
    names: NDArray[np.int64]
    volumes: tuple[float, ...]
    _views: dict[bytes, TurnedPart] = field(default_factory=dict)

    def narrow(self, diameter: float) -> DrainTask:
        """Return the same task with holes of another diameter, mm."""
        return replace(self, needs=replace(self.needs, diameter=diameter))

    def along(self, turned: NDArray[np.float64]) -> TurnedPart:
        """Return the part and its voids turned by a rotation (3, 3), from a cache."""
        key = turned.round(12).tobytes()
        if key not in self._views:
            self._views[key] = TurnedPart.of(self.part, self.voids, self.names, len(self.volumes), turned)
        return self._views[key]

    @property
    def opened(self) -> set[int]:
        """The voids that reach out of an open side of the part."""
        if self.opening is None:
            return set()
        shells, _ = shell_names(self.voids)
        starts = np.unique(shells, return_index=True)[1]
        numbers = self.names[starts[shells[starts] >= 0]]
        return set(numbers[self.opening.opened(self.voids)].tolist())
