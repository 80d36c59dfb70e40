"""Patterns by name for every product: a registered one, a drawing, or an object in a module of the user's."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from infill.errors import ParameterError
from infill.files.suffixes import MESHES
from infill.options.modules import load_object, names_code
from infill.plain_numbers import plain_argument
from patterns import PATTERNS, lacking
from patterns.cellular import Cells
from patterns.declared import parameters as declared
from patterns.errors import PatternError
from patterns.protocol import CELLS, LEVEL_SET, LINES, PATHS, Pattern, offers
from patterns.unit_cells import Surfaces

DRAWINGS = (".svg", ".dxf", ".wkt", ".png", ".jpg", ".jpeg", ".bmp")
SAMPLES = 16  # points along a cell at which a function is tested
NEEDS = {  # of these, a product needs one
    "make": (LINES, LEVEL_SET, CELLS),
    "fill": (LINES, LEVEL_SET, CELLS),
    "refill": (PATHS, LINES, LEVEL_SET),
}

Kind = Cells | Pattern | type[Pattern]


def resolve_pattern(pattern: object, product: str) -> tuple[Kind, str]:
    """Resolve a pattern or class of patterns; return it and its name.

    Parameters
    ----------
    pattern : str, Path, Pattern, Cells or callable
        A name, also as slicers spell it, such as "3D Honeycomb"; a drawing; "module.py:name"; a pattern, or a class of
        patterns; or a function of x, y and z, of one shape, in radians (2 pi is a cell), whose zeros are walls.
    product : {"make", "fill", "refill"}
        The product that needs it.

    Raises
    ------
    PatternError
        If the pattern is unknown, or offers nothing that the product can use.
    ParameterError
        If it is not a pattern, or a function that fails or is 0 nowhere.
    FormatError
        If the file is missing or broken.
    """
    if not isinstance(pattern, (str, Path)):
        name = getattr(pattern, "name", getattr(pattern, "__name__", type(pattern).__name__))
        kind = _pattern_from_object(pattern, name)
    else:
        name = str(pattern)
        if name not in PATTERNS.built_in and names_code(name):
            kind = _pattern_from_object(load_object(name), name)
        elif is_drawing(name):
            from infill.drawings.tiled import read_tiled

            kind = read_tiled(name)
        else:
            refuse_file(name)
            name = PATTERNS.spelled(name)
            kind = _pattern_from_object(PATTERNS.find(name), name)
    offered = offers(kind)
    if not set(offered) & set(NEEDS[product]):
        others = [other for other, needed in NEEDS.items() if set(offered) & set(needed)]
        raise PatternError(
            f"{name} offers {_join(offered, 'and')}, and {product} needs {_join(NEEDS[product], 'or')}; choose another "
            f"pattern, or give it to {_join(others, 'or')}"
        )
    if product != "make" and not hasattr(kind, "cell"):
        raise PatternError(f"{name} has no parameter cell, and {product} needs one to reach a density; declare it")
    return kind, name


def refuse_file(name: str) -> None:
    """Raise PatternError for the name of a mesh or a module, which a person may give where a pattern is needed."""
    if name in PATTERNS:
        return
    if Path(name).suffix.lower() == ".py":
        raise PatternError(
            f"{name!r} names a file and no pattern in it; give {name}:NAME, where NAME is its class or its function"
        )
    if Path(name).suffix.lower() in MESHES:
        raise PatternError(
            f"there is no pattern {name!r}, which is named like a mesh; infill fill {Path(name).name} --pattern NAME "
            "fills a part, and infill list shows the patterns"
        )


def _join(words: Sequence[str], last: str) -> str:
    """Join the names of forms with commas, and `last` ("and", "or") before the end."""
    *most, end = ["a level set" if word == LEVEL_SET else word for word in words]
    return f"{', '.join(most)} {last} {end}" if most else end


def resolve_lines(pattern: object) -> Pattern | type[Pattern]:
    """Resolve a pattern or class of patterns that has lines for a block: see `resolve_pattern`."""
    kind, _ = resolve_pattern(pattern, "make")
    assert not isinstance(kind, Cells)
    return kind


def instantiate_pattern(
    pattern: Pattern | Cells | Path | str | Callable[..., Any], parameters: dict[str, Any]
) -> Pattern:
    """Return the pattern with lines that a name and its parameters describe, or the pattern itself."""
    if not isinstance(pattern, (str, Path)):
        if isinstance(pattern, type) or lacking(pattern):
            raise ParameterError(f"{pattern!r} is not a pattern; give a name, or a pattern such as Honeycomb(cell=5)")
        if parameters:
            raise ParameterError(
                f"{', '.join(parameters)} given together with a ready-made pattern; "
                "set parameters where the pattern is made"
            )
        return with_parameters(resolve_lines(pattern), {})
    kind = resolve_lines(pattern)
    is_class = isinstance(kind, type) and is_dataclass(kind)
    field_names = [f.name for f in fields(kind) if f.init] if is_class else list(declared(kind))  # type: ignore[arg-type]
    for name in parameters:
        if name not in field_names:
            raise PatternError(f"{pattern} has no parameter {name!r}; it has {', '.join(field_names)}")
    return with_parameters(kind, parameters)


def is_drawing(name: str) -> bool:
    """Tell whether a name is that of a drawing."""
    return Path(name).suffix.lower() in DRAWINGS


def with_parameters(kind: Pattern | type[Pattern], values: dict[str, Any]) -> Pattern:
    """Make a pattern of a class, or change one, with the values of parameters."""
    if isinstance(kind, type):
        return kind(**values)
    changed: Pattern = replace(kind, **values) if values else kind  # type: ignore[type-var]
    return changed


def _pattern_from_object(given: Any, name: str) -> Kind:  # noqa: ANN401 - whatever a user gives
    """Return a pattern given as an object: a class, an instance or a function of x, y and z."""
    if isinstance(given, type) and issubclass(given, Cells):
        try:
            return given()
        except TypeError as error:
            raise ParameterError.about("pattern", f"is {name}, which needs arguments: {error}; give it made") from error
    if isinstance(given, Cells):
        return given
    if offers(given):
        kind: Kind = given
        return kind
    if callable(given) and not isinstance(given, type):
        return _pattern_from_function(given, name)
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
    except (Exception, SystemExit) as error:
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
            f"{plain_argument(level.min(), 3)} to {plain_argument(level.max(), 3)}",
        )
    return Surfaces(name=name, summary="walls where a function is 0", value=function)
