"""The pattern that a request asks for, with its parameters, in its place."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.lattices.branching import BranchLines
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.layered import LayerLines, NonPrismatic
from infill.lattices.line_sample import follows_outline
from infill.lattices.request import FillSpec
from infill.lattices.subdivided import Subdivided
from infill.lattices.voids import Periodic, VoidPattern
from infill.options.assignments import ParameterSource, merge_parameters, parse_assignments, parse_values
from infill.options.density_fields import SKIN
from infill.options.resolve_pattern import resolve_pattern, with_parameters
from infill.plain_numbers import plain_argument
from patterns.cellular import Cells
from patterns.declared import parameters
from patterns.given import suggest_name
from patterns.lightning import Lightning
from patterns.octree import Octree
from patterns.protocol import Pattern
from patterns.unit_cells import Cellular, Network, Planes

SEED = "seed"
# Arguments of `fill`, which a misspelt parameter may mean.
OPTIONS = (
    "density",
    "regions",
    "cell",
    "line_width",
    "wall",
    "align",
    "angle",
    "phase",
    "drain",
    "vent",
    "drain_at",
    "ties",
    "smooth_radius",
    "overlap",
    "tolerance",
    "max_triangles",
    "resolution",
    "voxel",
    "shell",
    "meshing",
    "threads",
    "max_memory",
)
HELD = ("cell", "angle", "phase", "frame")  # parameters of patterns that `fill` has arguments for, or does not use


def place_pattern(request: FillSpec, bounds: NDArray[np.floating]) -> VoidPattern:
    """Put the requested pattern in its place in a part, or in a body of it, with these bounds (2, 3), mm."""
    is_on_bed = request.align == "bed"
    origin = np.array([0.0, 0.0, float(bounds[0][2])]) if is_on_bed else np.asarray(bounds, np.float64).mean(axis=0)
    anchor, radians = request.phase + origin, np.radians(request.angle)
    turn = np.array(
        [[np.cos(radians), np.sin(radians), 0.0], [-np.sin(radians), np.cos(radians), 0.0], [0.0, 0.0, 1.0]]
    )
    if isinstance(request.kind, Cells):
        pattern = configure_cellular(request.kind, request)
        if isinstance(pattern, Lightning):
            return NonPrismatic(layers=BranchLines(pattern=pattern, turn=turn, anchor=anchor))
        if isinstance(pattern, (Planes, Octree)):
            turn = np.array(pattern.upright) @ turn
        if isinstance(pattern, Octree):
            return Subdivided(pattern=pattern, turn=turn, anchor=anchor)
        assert isinstance(pattern, Cellular)
        return Periodic(pattern=pattern, turn=turn, anchor=anchor)
    lines = configure_lines(request.kind, request)
    if not lines.prismatic:
        return NonPrismatic(layers=LayerLines(pattern=lines, anchor=anchor))
    return Prismatic(pattern=lines, anchor=anchor, share=request.share, ties=request.ties_islands)


def read_own_parameters(
    pattern: object, assigned: Sequence[str], table: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Read the pattern's own parameters from ``name=value`` and a table, or raise ParameterError."""
    if not (assigned or table):
        return {}
    kind, name = resolve_pattern(pattern, "fill")
    if not set(parameters(kind)) - set(HELD):
        if assigned:
            raise ParameterError(f"--set {assigned[0]}: {name} has no parameters; give --cell or --line-width")
        return dict(table or {})  # refused later
    own = merge_parameters(
        kind,
        command=parse_assignments(kind, assigned, options=HELD),
        file=parse_values(kind, table or {}, ParameterSource.TABLE),
    )
    for name in own:
        if name in HELD:
            raise ParameterError(f"--set {name}: that is --{name.replace('_', '-')} here; give it instead")
    return own


def add_seed(pattern: object, own: Mapping[str, Any], seed: int) -> dict[str, Any]:
    """Add a seed to the pattern's own parameters, or raise ParameterError if the pattern has no randomness."""
    kind, name = resolve_pattern(pattern, "fill")
    if SEED not in parameters(kind):
        raise ParameterError.about(
            "seed", f"is {seed}, and {name} leaves nothing to chance; choose voronoi or voronoi-foam"
        )
    if own.get(SEED, seed) != seed:
        raise ParameterError.about("seed", f"is {seed}, and --set says {own[SEED]}; give one of them")
    return {**own, SEED: seed}


def configure_cellular(kind: Cells, request: FillSpec) -> Cells:
    """Make the requested pattern in space, or raise ParameterError."""
    for name in request.parameters:
        names = [declared for declared in parameters(kind) if declared not in HELD]
        if name not in names:
            hint = suggest_name(name, names, others=OPTIONS)
            raise ParameterError(f"{request.pattern} has no parameter {name!r}; {hint}")
    lowest = request.lowest or 1.0
    if isinstance(kind, Network) and lowest < kind.thinnest:
        raise ParameterError.about(
            "density",
            f"is {plain_argument(lowest, 3)}, and the bars of {kind.name} break below "
            f"{plain_argument(kind.thinnest)}; give a higher one, or choose {kind.surfaces.name}",
        )
    return replace(kind, **request.parameters) if request.parameters else kind


def configure_lines(kind: Pattern | type[Pattern], request: FillSpec) -> Pattern:
    """Make the requested pattern of lines, or raise ParameterError."""
    declared = parameters(kind)
    settable = [name for name in declared if name not in HELD]
    for name in request.parameters:
        if name not in settable:
            raise ParameterError(
                f"{request.pattern} has no parameter {name!r}; {suggest_name(name, settable, others=OPTIONS)}"
            )
    if request.angle and "angle" not in declared:
        raise ParameterError.about(
            "angle",
            f"is {plain_argument(request.angle)} degrees, and {request.pattern} cannot be turned; leave it out",
        )
    own_angle = 0.0 if isinstance(kind, type) else float(getattr(kind, "angle", 0.0))
    rotation = {"angle": math.remainder(own_angle + request.angle, 360.0)} if "angle" in declared else {}
    values = {**request.parameters, **rotation}
    made_pattern = with_parameters(kind, values)
    if follows_outline(made_pattern) and any(request.phase):
        shift = ", ".join(plain_argument(step) for step in request.phase)
        raise ParameterError.about("phase", f"is {shift} mm, and {request.pattern} follows the part; leave it out")
    if follows_outline(made_pattern) and request.grading is not None and request.grading.name == SKIN:
        raise ParameterError.about(
            "by", f"is 'skin', and every wall of {request.pattern} lies at one depth; choose x, y, z or another pattern"
        )
    return made_pattern
