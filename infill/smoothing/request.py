"""The options that `smooth_volume`, `smooth_mesh` and `smooth_points` have in common, checked."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from infill.checks import within
from infill.errors import ParameterError
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.profile import REFINED, STRAIGHT, Profile

if TYPE_CHECKING:
    from infill.result import Progress
    from infill.surface import Surface
    from infill.volume import Volume

LevelMethod = Literal["volume"] | float
HIGHEST, HIGHEST_REFINED = 0.999, 0.99  # of a fixed level of phi; beyond these, there is no profile to find it on


class Options(TypedDict, total=False):
    """The options that the three functions have in common; see `infill.smooth_volume`."""

    smoothing: Smoothing
    refine: bool
    level: LevelMethod
    despeckle: float
    allow_broken: bool
    tolerance: float | None
    max_triangles: int | None
    threads: int | None
    max_memory: int | None
    progress: Progress | None


@dataclass(frozen=True, kw_only=True)
class Request:
    """The same options, checked, with defaults.

    Parameters
    ----------
    smoothing, refine, level, despeckle, allow_broken, tolerance, max_triangles, threads, max_memory, progress
        See `infill.smooth_volume`.

    Raises
    ------
    ParameterError
        For a level that is neither "volume" nor a number in its range, or a despeckling volume below 0.
    """

    smoothing: Smoothing = Smoothing(steps=20)  # noqa: RUF009 - frozen
    refine: bool = False
    level: LevelMethod = "volume"
    despeckle: float = 0.0
    allow_broken: bool = False
    tolerance: float | None = None
    max_triangles: int | None = None
    threads: int | None = None
    max_memory: int | None = None
    progress: Progress | None = None

    def __post_init__(self) -> None:
        """Check what does not depend on the data."""
        if not isinstance(self.level, str):
            highest = HIGHEST_REFINED if self.refine else HIGHEST
            object.__setattr__(self, "level", within("level", float(self.level), -highest, highest))
        elif self.level != "volume":
            raise ParameterError(f"there is no level {self.level!r}; give volume, or a number between -1 and 1")
        object.__setattr__(self, "despeckle", within("despeckle", self.despeckle, 0, math.inf, "mm³"))

    @property
    def profile(self) -> Profile:
        """The profile on which the level that keeps the volume is found."""
        return REFINED if self.refine else STRAIGHT

    def facts(self) -> dict[str, Any]:
        """Return the request as plain values; refinement does not use fidelity."""
        smoothing = self.smoothing
        return {
            "steps": smoothing.steps,
            "fidelity": 0.0 if self.refine else smoothing.fidelity,
            "interface": smoothing.interface,
            "alpha": smoothing.alpha,
            "refine": self.refine,
            "level": self.level,
            "despeckle": self.despeckle,
            "tolerance": self.tolerance,
            "max_triangles": self.max_triangles,
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class Given:
    """What is solid, and what is known about its origin.

    Parameters
    ----------
    data : Volume
        Booleans, or a phase field.
    facts : mapping
        For the report: `source`, and anything else worth reporting.
    reference : Surface, optional
        The closed mesh that the volume was made from, mm.
    volume : float, optional
        The volume that this mesh encloses, mm³.
    overlapping : bool
        Whether parts of the mesh may overlap: its volume then counts some places twice.
    """

    data: Volume
    facts: Mapping[str, Any]
    reference: Surface | None = None
    volume: float | None = None
    overlapping: bool = False
