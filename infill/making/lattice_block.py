"""Blocks that are not drawn layer by layer: of patterns in space, and of any pattern at a density.

The block is a box that is filled without a shell, so that the pattern ends at its sides, or with a frame as a shell
that is open at the top and bottom.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass, make_dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.checks import check_length
from infill.errors import ParameterError
from infill.isosurfaces.components import count_bodies
from infill.lattices.choosing import HELD
from infill.lattices.forecast import plan_fill
from infill.lattices.job import fill_request
from infill.lattices.placed_regions import LOWEST, check_density
from infill.lattices.request import LINE_WIDTH, TOLERANCE, FillSpec, check_request
from infill.making.stages import LatticeStages
from infill.options.keyword_options import parse_share
from infill.options.resolve_pattern import Kind, resolve_pattern
from infill.plain_numbers import plain_argument
from infill.reports.common import declare, report_head, surface_keys
from infill.reports.making import LatticeInfill, LatticeMesh
from infill.result import Progress, Result
from infill.surface import Surface
from patterns.declared import parameter, parameters
from patterns.lightning import Lightning
from patterns.shared import angle_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    from infill.reports.making import LatticePlan, LatticeReport, LatticeRequest

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=np.float64)
# Two triangles a side, facing outwards.
FACES = np.array(
    [
        [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
        [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
    ]
)  # fmt: skip
NARROWEST = 4  # widths of the frame in the shortest side


@dataclass(frozen=True, kw_only=True)
class LatticeBlock:
    """A checked request for a block that is filled as a part is.

    Parameters
    ----------
    spec : FillSpec
        Of the box, with the density inside the frame.
    sides : (x, y, z)
        Of the box, mm.
    density : float or None
        Requested solid share of the whole block.
    frame : float
        Width of the frame, mm; 0 without one.
    """

    spec: FillSpec
    sides: tuple[float, float, float]
    density: float | None
    frame: float

    @property
    def box(self) -> Surface:
        """The block if it were solid, mm: centred on x = y = 0, on z = 0."""
        return Surface(vertices=(CORNERS - (0.5, 0.5, 0.0)) * self.sides, faces=FACES)

    def rename(self, name: str) -> LatticeBlock:
        """Return the same block of a pattern by the name that was typed, such as that of a drawing."""
        return replace(self, spec=replace(self.spec, pattern=name))

    def request_keys(self) -> LatticeRequest:
        """Return the section `request` of the report."""
        spec = self.spec
        return {
            "pattern": spec.pattern,
            "parameters": dict(spec.parameters),
            "size": list(self.sides[:2]),
            "height": self.sides[2],
            "density": self.density,
            "cell": spec.cell,
            "line_width": spec.line_width,
            "angle": spec.angle,
            "phase": list(spec.phase[:2]),
            "frame": self.frame,
            "tolerance": spec.tolerance,
        }

    def facts(self) -> LatticePlan:
        """Return the report of a dry run."""
        plan = plan_fill(self.box, self.spec)
        return {
            "request": self.request_keys(),
            "infill": plan["infill"],
            "grid": plan["grid"],
            "memory": plan["memory"],
        }


def declare_placed(kind: Kind) -> type[Any]:
    """Declare the parameters of a pattern as a lattice block takes them: cell, angle, phase and frame, then its own."""
    shared: dict[str, Any] = {
        "cell": parameter(None, "period of the pattern", low=0.001, high=1e4),
        "angle": angle_parameter(),
        "phase": phase_parameter(),
        "frame": frame_parameter(default=has_frame(kind)),
    }
    own = {
        name: field(default=described.default, metadata=described.metadata)
        for name, (described, _) in parameters(kind).items()
        if name not in HELD
    }
    declared = [(name, Any, declaration) for name, declaration in {**shared, **own}.items()]
    return make_dataclass("Placed", declared, frozen=True, kw_only=True, namespace={"name": kind.name})


def has_frame(kind: Kind) -> bool:
    """Tell whether blocks of a pattern have a frame unless they are asked not to."""
    if isinstance(kind, Lightning) or (isinstance(kind, type) and issubclass(kind, Lightning)):
        return True  # its branches carry a roof, and lean to walls
    if not isinstance(kind, type):
        return bool(getattr(kind, "frame", False))
    return is_dataclass(kind) and any(entry.name == "frame" and entry.default is True for entry in fields(kind))


def plan_lattice(
    pattern: object,
    *,
    sides: tuple[float, float, float],
    density: float | str | None,
    line_width: float | None,
    tolerance: float | None,
    values: Mapping[str, Any],
) -> LatticeBlock:
    """Check a request for a block and return it.

    Parameters
    ----------
    pattern : Pattern, Cells, Path, str or callable
        See `infill.options.resolve_pattern.resolve_pattern`.
    sides : (x, y, z)
        mm
    density : float, str or None
        Solid share of the whole block.
    line_width, tolerance : float or None
        mm
    values : mapping
        Parameters of the pattern by name, with cell, angle, phase and frame.
    """
    x, y, height = (check_length(name, side) for name, side in zip(("size x", "size y", "height"), sides, strict=True))
    kind, name = resolve_pattern(pattern, "make")
    line_width = None if line_width is None else check_length("line_width", line_width)
    framed = values.get("frame")
    if not isinstance(framed, (bool, type(None))):
        raise ParameterError.about("frame", f"is {framed!r}; it must be true or false")
    frame = (line_width or LINE_WIDTH) if (has_frame(kind) if framed is None else framed) else 0.0
    if frame and min(x, y) < NARROWEST * frame:
        raise ParameterError(
            f"a block of {plain_argument(x)} × {plain_argument(y)} mm has no room in a frame of "
            f"{plain_argument(frame)} mm; make it at least {plain_argument(NARROWEST * frame)} mm in x and y, or leave "
            "the frame out"
        )
    cell, roof = values.get("cell"), isinstance(kind, Lightning) and frame > 0
    inside = None
    if density is not None:
        density = check_density("density", parse_share("density", density))
        open_share = (1 - 2 * frame / x) * (1 - 2 * frame / y) * (1 - (frame / height if roof else 0.0))
        inside = 1 - (1 - density) / open_share
        if inside < LOWEST:
            raise ParameterError.about(
                "density",
                f"is {plain_argument(density, 3)}, and the frame alone takes {1 - open_share:.1%} of the block; give "
                "a higher one, a thinner line, or leave the frame out",
            )
    spec = check_request(
        pattern=kind,
        own={name: value for name, value in values.items() if name not in HELD},
        density=inside,
        cell=cell,
        line_width=line_width,
        wall=frame,
        open_=None if not frame else "bottom" if roof else "both",
        angle=values.get("angle") or 0.0,
        phase=tuple(values.get("phase") or (0.0, 0.0)),
        tolerance=TOLERANCE if tolerance is None else tolerance,
    )
    return LatticeBlock(
        spec=replace(spec, pattern=name, is_block=True), sides=(x, y, height), density=density, frame=frame
    )


def make_lattice(
    block: LatticeBlock, *, max_memory: int | None = None, progress: Progress | None = None
) -> Result[LatticeStages, LatticeReport]:
    """Make a block that is filled as a part is: see `infill.make`."""
    filled = fill_request(block.box, block.spec, max_memory=max_memory, progress=progress)
    surface, told = filled.surface, filled.report
    report: LatticeReport = {
        **report_head("make"),
        **surface_keys(surface),
        "volume": surface.volume,
        "components": count_bodies(surface),
        "density": surface.volume / math.prod(block.sides),
        "problems": told["problems"],
        "request": block.request_keys(),
        "grid": told["grid"],
        "mesh": declare(LatticeMesh, {key: value for key, value in told["mesh"].items() if key != "skin"}),
        "infill": declare(
            LatticeInfill,
            {
                **{key: told["infill"][key] for key in ("cell", "line_width", "radius")},
                "density": told["density"],
                "crumbs": told["voids"]["islands"],
            },
        ),
        "seconds": told["seconds"],
    }
    return Result(surfaces={"block": surface}, report=report, stages=LatticeStages(box=block.box))
