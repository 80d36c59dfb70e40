"""Plain data of smoothing: the options, checked; the input; and a way to smooth it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, TypedDict

from infill.checks import LONGEST, check_positive, check_range
from infill.errors import ParameterError, UsageError
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.schedule import MIN_STEPS, SNAPSHOT_QUARTERS
from infill.plain_numbers import plain_argument

if TYPE_CHECKING:
    from infill.inspection.changes import ConnectionCounts
    from infill.phasefield.sparse import SparseField
    from infill.reports.smoothing import InputKeys, SolidRequest
    from infill.result import Progress
    from infill.surface import Surface
    from infill.volume import Volume
    from infill.voxels.partial import EnclosedVolumes

LevelMethod = Literal["volume"] | float
Method = Literal["auto", "plain", "refine", "grey"]
METHODS = ("auto", "plain", "refine", "grey")
DEFAULT_STEPS = 20
AUTO: Literal["auto"] = "auto"
DEFAULT_TOLERANCE_IN_CELLS = 0.1  # of a cell: the distance by which simplification may move the surface by default
STEPS_PER_VARIANCE = 3.5  # cells²: the standard deviation of n steps is sqrt(2 n / 7) cells
MOST_STEPS = 2000  # minutes
HIGHEST, HIGHEST_REFINED = 0.999, 0.99  # of a fixed level of phi; beyond these, there is no profile to find it on


class SmoothOptions(TypedDict, total=False):
    """The options that the three functions have in common; see `infill.smooth_volume`."""

    smoothing: Smoothing
    method: Method
    refine: bool | None
    radius: float | None
    level: LevelMethod
    despeckle: float
    crumbs: float | None
    allow_broken: bool
    strict: bool
    tolerance: float | Literal["auto"] | None
    max_triangles: int | None
    threads: int | None
    max_memory: int | None
    progress: Progress | None


@dataclass(frozen=True, kw_only=True)
class SmoothRequest:
    """The options of `SmoothOptions`, checked, with defaults.

    Parameters
    ----------
    smoothing, method, radius, level, despeckle, crumbs, allow_broken, strict, tolerance, max_triangles, threads,
    max_memory, progress
        See `infill.smooth_volume`.
    refine : bool, optional
        True is `method="refine"`, False is `method="plain"`.
    keep_exact : bool
        Whether exact data bound the surface: see `ExactDataLimits`. False if a radius is requested.
    default_tolerance : bool
        Whether the tolerance is the default: a surface that cannot be simplified to it is left as it is.

    Raises
    ------
    ParameterError
        For a level that is neither "volume" nor a number in its range, or a despeckling volume below 0.
    """

    smoothing: Smoothing = Smoothing(steps=DEFAULT_STEPS)  # noqa: RUF009 - frozen
    method: Method = "auto"
    refine: bool | None = None
    radius: float | None = None
    level: LevelMethod = "volume"
    despeckle: float = 0.0
    crumbs: float | None = None
    allow_broken: bool = False
    strict: bool = False
    tolerance: float | Literal["auto"] | None = AUTO
    max_triangles: int | None = None
    threads: int | None = None
    max_memory: int | None = None
    progress: Progress | None = None
    default_tolerance: bool = False
    keep_exact: bool = True

    def __post_init__(self) -> None:
        """Check all options that do not depend on the data."""
        if self.method not in METHODS:
            raise UsageError.about("method", f"is {self.method!r}; choose from {', '.join(METHODS)}")
        if self.refine is not None:
            if self.method not in (AUTO, "refine" if self.refine else "plain"):
                raise UsageError.about("refine", f"is {self.refine} and method {self.method}; give one of them")
            object.__setattr__(self, "method", "refine" if self.refine else "plain")
        if self.radius is not None:
            object.__setattr__(self, "radius", check_positive("radius", self.radius, "mm"))
            if self.smoothing.steps != DEFAULT_STEPS:
                raise UsageError.about(
                    ("smoothing", "radius"),
                    f"are both given, and a radius decides the steps; leave the {self.smoothing.steps} steps out, or "
                    "the radius",
                )
        if isinstance(self.tolerance, str) and self.tolerance != AUTO:
            raise UsageError.about("tolerance", f"is {self.tolerance!r}; give a number of mm, or auto")
        if self.tolerance == 0:
            object.__setattr__(self, "tolerance", None)
        elif self.tolerance is not None and not isinstance(self.tolerance, str):
            check_range("tolerance", self.tolerance, 0.0, LONGEST, "mm")  # before the work
        if self.crumbs is not None:
            object.__setattr__(self, "crumbs", check_range("crumbs", self.crumbs, 0, math.inf, "mm³"))
        if not isinstance(self.level, str):
            highest = HIGHEST_REFINED if self.refined else HIGHEST
            object.__setattr__(self, "level", check_range("level", float(self.level), -highest, highest))
        elif self.level != "volume":
            raise UsageError.about("level", f"is {self.level!r}; give volume, or a number between -1 and 1")
        object.__setattr__(self, "despeckle", check_range("despeckle", self.despeckle, 0, math.inf, "mm³"))

    @property
    def refined(self) -> bool:
        """Whether edges and thin walls are refined; "auto" counts as no."""
        return self.method in ("refine", "grey")

    @property
    def total_steps(self) -> float:
        """Steps of the scheme: refining takes 65 for every 20."""
        return self.smoothing.steps * (SNAPSHOT_QUARTERS[-1] / 4 if self.refined else 1)

    def for_cell(self, cell: float) -> SmoothRequest:
        """Return the request for cells of a size, mm: the radius becomes steps, and an `auto` tolerance one in mm.

        n steps blur a field about as much as a Gaussian with a standard deviation of sqrt(2 n / 7) cells.
        """
        smoothing, tolerance = self.smoothing, self.tolerance
        if self.radius is not None:
            fewest = MIN_STEPS if self.refined else 1
            steps = max(fewest, round(STEPS_PER_VARIANCE * (self.radius / cell) ** 2))
            if steps > MOST_STEPS:
                raise ParameterError.about(
                    "radius",
                    f"is {plain_argument(self.radius)} mm, {plain_argument(self.radius / cell, 3)} voxels, which "
                    f"would take {steps} steps; give at most "
                    f"{plain_argument(cell * math.sqrt(MOST_STEPS / STEPS_PER_VARIANCE), 3)} mm, or larger voxels",
                )
            smoothing = replace(smoothing, steps=steps)
        if isinstance(tolerance, str):
            tolerance = DEFAULT_TOLERANCE_IN_CELLS * cell if self.max_triangles is None else None
        return replace(
            self,
            keep_exact=self.radius is None,
            smoothing=smoothing,
            radius=None,
            tolerance=tolerance,
            refine=None,
            default_tolerance=isinstance(self.tolerance, str),
        )

    def facts(self) -> SolidRequest:
        """Return the request as plain values; refinement does not use fidelity."""
        smoothing = self.smoothing
        return {
            "steps": smoothing.steps,
            "fidelity": 0.0 if self.refined else smoothing.fidelity,
            "interface": smoothing.interface,
            "alpha": smoothing.alpha,
            "method": self.method,
            "refine": self.refined,
            "level": self.level,
            "despeckle": self.despeckle,
            "crumbs": self.crumbs,
            "tolerance": self.tolerance,
            "max_triangles": self.max_triangles,
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothInput:
    """The solid to smooth, and facts about its origin.

    Parameters
    ----------
    data : Volume
        Booleans, or a phase field.
    facts : InputKeys
        The section `input` of the report.
    closed_mesh : Surface, optional
        The closed mesh that the volume was made from, mm.
    mesh : Surface, optional
        The input mesh, mm: the closed one without its caps.
    mesh_volumes : EnclosedVolumes, optional
        The volumes inside the mesh; the data are then its exact distances, not a staircase.
    topology : ConnectionCounts, optional
        The topology of the mesh, if it is known.
    voxel_surface : Surface, optional
        The surface of the input voxels, mm, if the data differ from them.
    volume : float, optional
        Volume of the input, mm³, if the data do not give it.
    cell : float, optional
        Unit by which distances are judged, mm; by default, the longest side of a cell of the data.
    seconds : float
        Time that the voxels of a mesh took.
    """

    data: Volume
    facts: InputKeys
    closed_mesh: Surface | None = None
    mesh: Surface | None = None
    mesh_volumes: EnclosedVolumes | None = None
    topology: ConnectionCounts | None = None
    voxel_surface: Surface | None = None
    volume: float | None = None
    cell: float | None = None
    seconds: float = 0.0

    @property
    def is_voxels(self) -> bool:
        """Whether the surface of the data themselves is the input."""
        return self.mesh is None and self.voxel_surface is None

    @property
    def distance_unit(self) -> float:
        """Unit by which distances are judged, mm."""
        return self.cell or float(self.data.cell_size.max())


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothedInput:
    """An input and the field that was smoothed from it.

    Parameters
    ----------
    smooth_input : SmoothInput
        Its data have no specks.
    request : SmoothRequest
        Lengths are in cells.
    field : SparseField
    """

    smooth_input: SmoothInput
    request: SmoothRequest
    field: SparseField

    @property
    def spacing(self) -> tuple[float, ...]:
        """Size of the cells, mm."""
        return tuple(self.smooth_input.data.cell_size.tolist())

    @property
    def threads(self) -> int | None:
        """Threads to use; None for all that are available."""
        return self.request.threads


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshOnGrid:
    """A mesh, and the grid on which it is to be voxelised when its way is run.

    Parameters
    ----------
    surface : Surface, mm
    resolution, voxel
        See `infill.smooth_mesh`.
    hint : bool
        Whether to log a hint at filters that may stay nearer to the mesh.
    """

    surface: Surface
    resolution: int | None = None
    voxel: float | None = None
    hint: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class Way:
    """One way to smooth an input.

    Parameters
    ----------
    name : str
        Its name in the report, such as "refine" or "300 voxels".
    data : SmoothInput or MeshOnGrid
    request : SmoothRequest
        Its method and steps, and the other options.
    cost : float
        Its work, relative to the first way.
    option : str, optional
        The option to give for it, such as "--despeckle 27". Such a way is run only to find out what a message may
        recommend: its surface is not taken.
    later : callable, optional
        Makes the way in place of this one when it is run, because making it takes long.
    """

    name: str
    data: SmoothInput | MeshOnGrid
    request: SmoothRequest
    cost: float = 1.0
    option: str | None = None
    later: Callable[[], Way] | None = None
