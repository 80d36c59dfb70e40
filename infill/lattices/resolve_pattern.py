"""Patterns by name: a built-in one, a drawing, or an object in a module of the user's."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.errors import ParameterError
from infill.options.modules import load_object, names_code
from patterns import PATTERNS
from patterns.cellular import CELLULAR, InSpace, unknown_pattern_error
from patterns.protocol import Pattern, gives
from patterns.unit_cells import Surfaces

if TYPE_CHECKING:
    from infill.lattices.tiled import Tiled

DRAWINGS = (".svg", ".dxf", ".wkt", ".png", ".jpg", ".jpeg", ".bmp")
SAMPLES = 16  # points along a cell at which a function is tested

Kind = InSpace | Pattern | type[Pattern]


def resolve_pattern(pattern: object) -> tuple[Kind, str]:
    """Resolve a pattern or class of patterns; return it and its name.

    Parameters
    ----------
    pattern : str, Path, Pattern, Surfaces, Planes, Polyhedra, Octree, Network, Bars or callable
        A name; a drawing; "module.py:name"; a pattern, or a class of patterns; or a function of x, y and z, of one
        shape, in radians (2 pi is a cell), whose zeros are walls.

    Raises
    ------
    PatternError
        If the pattern is unknown.
    ParameterError
        If it is not a pattern, or a function that fails or is 0 nowhere.
    FormatError
        If the file is missing or broken.
    """
    if not isinstance(pattern, (str, Path)):
        return _pattern_from_object(
            pattern, getattr(pattern, "name", getattr(pattern, "__name__", type(pattern).__name__))
        )
    name = str(pattern)
    if name in CELLULAR:
        return CELLULAR[name], name
    if names_code(name):
        return _pattern_from_object(load_object(name), name)
    if Path(name).suffix.lower() in DRAWINGS:
        return _pattern_from_drawing(name), name
    if name not in PATTERNS:
        raise unknown_pattern_error(name, [*CELLULAR, *PATTERNS])
    return PATTERNS[name], name


def _pattern_from_drawing(name: str) -> Tiled:
    from infill.lattices.tiled import read_tiled

    return read_tiled(name)


def _pattern_from_object(given: Any, name: str) -> tuple[Kind, str]:  # noqa: ANN401 - whatever a user gives
    if isinstance(given, InSpace) or gives(given):
        return given, name
    if callable(given) and not isinstance(given, type):
        return _pattern_from_function(given, name), name
    raise ParameterError.about(
        "pattern",
        f"is {name}, which is {type(given).__name__}; give a Pattern, Surfaces, Bars, or a function of x, y, z",
    )


def _pattern_from_function(function: Any, name: str) -> Surfaces:  # noqa: ANN401
    """Make walls where a function is 0, or raise ParameterError if it is 0 nowhere."""
    line = 2 * np.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES
    x, y, z = np.meshgrid(line, line, line, indexing="ij")
    try:
        level = np.asarray(function(x, y, z), dtype=np.float64)
    except Exception as error:
        reason = " ".join(str(error).split())
        raise ParameterError.about("pattern", f"is {name}, which fails: {type(error).__name__}: {reason}") from error
    if level.shape != x.shape or not np.isfinite(level).all():
        raise ParameterError.about(
            "pattern", f"is {name}, which does not return a finite number for each point; correct it"
        )
    if not level.min() < 0 < level.max():
        raise ParameterError.about(
            "pattern",
            f"is {name}, which is 0 nowhere: in a cell, x, y and z from 0 to 2 pi, it runs from "
            f"{level.min():.3g} to {level.max():.3g}",
        )
    return Surfaces(name=name, summary="walls where a function is 0", value=function)
