"""What the name of a pattern stands for: one of ours, a drawing, or what a module of the user's holds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.errors import ParameterError
from infill.options.modules import names_code, object_in
from patterns import PATTERNS
from patterns.cellular import CELLULAR, InSpace, no_such
from patterns.protocol import Pattern, gives
from patterns.unit_cells import Surfaces

if TYPE_CHECKING:
    from infill.lattices.tiled import Tiled

DRAWINGS = (".svg", ".dxf", ".wkt", ".png", ".jpg", ".jpeg", ".bmp")
SAMPLES = 16  # points along a cell, at which a function is tried

Kind = InSpace | Pattern | type[Pattern]


def kind_of(pattern: object) -> tuple[Kind, str]:
    """Return the pattern, or the class of patterns, that is meant, and what to call it.

    Parameters
    ----------
    pattern : str, Path, Pattern, Surfaces, Planes, Polyhedra, Octree, Network, Bars or callable
        A name; a drawing; "module.py:name"; what such a name stands for: a pattern, or a class of patterns; or a
        function of x, y and z, of one shape, in radians (2 pi is a cell), whose zeros are walls.

    Raises
    ------
    PatternError
        If there is no such pattern.
    ParameterError
        If it is no pattern, or a function that fails or is 0 nowhere.
    FormatError
        If there is no such file, or it is broken.
    """
    if not isinstance(pattern, (str, Path)):
        return _made(pattern, getattr(pattern, "name", getattr(pattern, "__name__", type(pattern).__name__)))
    name = str(pattern)
    if name in CELLULAR:
        return CELLULAR[name], name
    if names_code(name):
        return _made(object_in(name), name)
    if Path(name).suffix.lower() in DRAWINGS:
        return _drawing(name), name
    if name not in PATTERNS:
        raise no_such(name, [*CELLULAR, *PATTERNS])
    return PATTERNS[name], name


def _drawing(name: str) -> Tiled:
    from infill.lattices.tiled import tiled

    return tiled(name)


def _made(found: Any, name: str) -> tuple[Kind, str]:  # noqa: ANN401 - whatever a user gives
    if isinstance(found, InSpace) or gives(found):
        return found, name
    if callable(found) and not isinstance(found, type):
        return _level_set(found, name), name
    raise ParameterError(
        f"pattern is {name}, which is {type(found).__name__}; give a Pattern, Surfaces, Bars, or a function of x, y, z"
    )


def _level_set(function: Any, name: str) -> Surfaces:  # noqa: ANN401
    """Return walls where a function is 0, or raise ParameterError if it is so nowhere."""
    line = 2 * np.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES
    x, y, z = np.meshgrid(line, line, line, indexing="ij")
    try:
        found = np.asarray(function(x, y, z), dtype=np.float64)
    except Exception as error:
        said = " ".join(str(error).split())
        raise ParameterError(f"pattern is {name}, which fails: {type(error).__name__}: {said}") from error
    if found.shape != x.shape or not np.isfinite(found).all():
        raise ParameterError(f"pattern is {name}, which does not return a finite number for each point; mend it")
    if not found.min() < 0 < found.max():
        raise ParameterError(
            f"pattern is {name}, which is 0 nowhere: in a cell, x, y and z from 0 to 2 pi, it runs from "
            f"{found.min():.3g} to {found.max():.3g}"
        )
    return Surfaces(name=name, summary="walls where a function is 0", value=function)
