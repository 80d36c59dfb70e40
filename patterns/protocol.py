"""The protocol of a pattern, and what patterns offer: lines, a level set, cells in space, paths of beads."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, runtime_checkable

from patterns.cellular import Cells
from patterns.declared import check_parameters
from patterns.errors import PatternError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

REQUIRED_ATTRIBUTES = ("name", "summary", "prismatic", "points", "line_spacing")
LINES, LEVEL_SET, CELLS, PATHS = "lines", "level set", "cells", "paths"


class Pattern(Protocol):
    """Lines in a plane at height z, or the zero set of a function of x, y and z; millimetres.

    To write a pattern, subclass it (best as a frozen, keyword-only dataclass) and provide `name`, `summary`,
    `line_spacing`, and `lines` or `level_set` or both. `points`, the lines of a level set and the range
    check of the parameters come for free.

    Attributes
    ----------
    name : str
        The name to type on the command line.
    summary : str
        What the pattern is for, in one phrase.
    prismatic : bool
        True if the lines do not depend on z.
    follows : bool
        True if the lines follow the outline of the region: in a part, that of its inside as seen from above. Such a
        pattern is neither turned nor shifted.
    paths : bool
        True if `refill` has paths drawn for this very class; it draws those of others along their lines.

    Notes
    -----
    Lines suit drawings: strokes, tiles, curves; ends and corners stay as they are drawn. A level set (see
    `LevelSet`) suits formulas: waves, gyroids; its lines have no ends inside the region and never cross.
    A pattern that provides both describes the same shape with both.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    prismatic: ClassVar[bool] = True
    follows: ClassVar[bool] = False
    paths: ClassVar[bool] = False

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:
        """Return the centre lines of the walls at height `z`, clipped to `region`.

        A pattern with a level set need not define this: the lines are then where the level set is zero,
        found on a grid of a 32nd of `line_spacing`, with every corner put onto the zero set itself. The
        outline of the region is added if the pattern has a parameter `frame` that is True.

        Parameters
        ----------
        region : Polygon or MultiPolygon
            Where lines may lie, mm. Walls reach half a line width beyond it.
        z : float
            Height, mm; a prismatic pattern ignores it.

        Returns
        -------
        MultiLineString
            mm. Each line becomes a wall of `line width` centred on it; lines that end or meet do so in
            the print as well.
        """
        from patterns.contours import zero_lines
        from patterns.linework import add_frame, clip, join_lines

        if not isinstance(self, LevelSet):
            raise PatternError(f"{self.name} gives neither lines nor a level set; give its class one of them")
        lines = join_lines(clip(zero_lines(self.level_set, region.bounds, z, self.line_spacing(region)), region))
        return add_frame(lines, region) if getattr(self, "frame", False) else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:
        """Return the distance, mm, between neighbouring lines in `region` for which the pattern is designed."""
        ...

    def points(self, region: Polygon | MultiPolygon, spacing: float, z: float = 0.0) -> NDArray[np.float64]:
        """Return points on the lines, neighbours at most `spacing` apart.

        Parameters
        ----------
        region : Polygon or MultiPolygon
            As for `lines`, mm.
        spacing : float
            Largest distance between neighbours on a line, mm. Half a grid cell or less makes
            neighbouring stamps overlap.
        z : float
            Height, mm.

        Returns
        -------
        (N, 2) float64, mm
        """
        from patterns.linework import sample_points

        return sample_points(self.lines(region, z), spacing)

    def __post_init__(self) -> None:
        """Check the parameters; a subclass that defines `__post_init__` calls this first."""
        check_parameters(self)


@runtime_checkable
class LevelSet(Protocol):
    """The level set of a pattern defined by a formula, in addition to its lines or instead of them."""

    def level_set(self, x: NDArray[np.float64], y: NDArray[np.float64], z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the value of a continuous function at points in space.

        Parameters
        ----------
        x, y, z : float64, of one shape
            mm.

        Returns
        -------
        float64, of that shape
            Above 0 in one phase of the pattern (the solid, where it is one), below 0 in the other. Where it
            is 0, there are walls or paths. Only the sign and where it changes matter, not the unit: a distance
            in mm is as good as a sum of sines.
        """
        ...


def draw_lines(pattern: Pattern, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:
    """Return the lines of a pattern; wrap any error, which may come from a plug-in, in a PatternError that names it."""
    try:
        return pattern.lines(region, z)
    except Exception as error:
        if isinstance(error, PatternError):
            raise
        message = " ".join(str(error).split())
        raise PatternError(f"the pattern {pattern.name} failed: {type(error).__name__}: {message}") from error


def with_cell(pattern: Pattern, cell: float) -> Pattern:
    """Set the cell of a pattern, mm, and drop its frame."""
    overrides: dict[str, Any] = {"cell": cell} if hasattr(pattern, "cell") else {}
    if hasattr(pattern, "frame"):
        overrides["frame"] = False
    return dataclasses.replace(pattern, **overrides)  # type: ignore[type-var]


def gives(pattern: object) -> tuple[str, ...]:
    """List the descriptions that a pattern, or a class of patterns, provides: "lines", "level set", or both.

    >>> from patterns import Honeycomb
    >>> gives(Honeycomb)
    ('lines',)
    """
    pattern_class = pattern if isinstance(pattern, type) else type(pattern)
    has_lines = hasattr(pattern, "lines") and getattr(pattern_class, "lines", None) is not Pattern.lines
    return (LINES,) * has_lines + (LEVEL_SET,) * callable(getattr(pattern, "level_set", None))


def offers(pattern: object) -> tuple[str, ...]:
    """List the forms in which products can have a pattern, or a class of patterns.

    Lines and level sets are walls of a block, cells are voids in a part, and paths are the beads of a layer.

    >>> from patterns import Gyroid, Honeycomb
    >>> offers(Gyroid), offers(Honeycomb)
    (('cells', 'paths'), ('lines', 'paths'))
    """
    pattern_class = pattern if isinstance(pattern, type) else type(pattern)
    has_paths = bool(vars(pattern_class).get("paths"))  # those of a base class are not its own
    return gives(pattern) + (CELLS,) * issubclass(pattern_class, Cells) + (PATHS,) * has_paths


def lacking(pattern: object) -> list[str]:
    """List the required attributes that a pattern, or a class of patterns, lacks.

    >>> lacking("honeycomb")[:2]
    ['name', 'summary']
    """
    if CELLS in offers(pattern):
        return [] if hasattr(pattern, "name") else ["name"]
    missing = [attribute for attribute in REQUIRED_ATTRIBUTES if not hasattr(pattern, attribute)]
    return missing if gives(pattern) else [*missing, "lines or level_set"]
