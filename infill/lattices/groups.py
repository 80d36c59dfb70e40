"""Groups of the keywords of `fill`, for scripts that keep or share them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

from infill.errors import UsageError
from infill.lattices.request import TOLERANCE

FLAT_NAMES = {"open": "open_"}  # of keywords that Python reserves, or that are functions


@dataclass(frozen=True, kw_only=True)
class Shell:
    """The shell of a filled part, and its holes; every keyword is that of `infill.fill`.

    >>> Shell(wall=2, drain=3, open="top").wall
    2
    """

    wall: float | None = None
    drain: float | None = None
    vent: bool = False
    drain_at: Sequence[Sequence[float]] = ()
    open: str | None = None
    ties: bool = True


@dataclass(frozen=True, kw_only=True)
class Meshing:
    """How finely voids are computed, and how far they are simplified; every keyword is that of `infill.fill`."""

    voxel: float | None = None
    resolution: int | None = None
    tolerance: float = TOLERANCE
    max_triangles: int | None = None


@dataclass(frozen=True)
class Graded:
    """A density that changes from place to place.

    Parameters
    ----------
    first, last : float
        Densities where the field is lowest, and where it is highest.
    by, grade
        The keywords of `infill.fill`.

    >>> Graded(0.15, 0.4, by="skin").by
    'skin'
    """

    first: float
    last: float
    by: object = None
    grade: str | None = None


def add_group(keywords: dict[str, Any], name: str, group: Shell | Meshing) -> dict[str, Any]:
    """Return keywords with those of a group; raise UsageError for a keyword that is given alone and in the group."""
    merged = dict(keywords)
    for field in fields(group):
        flat, value = FLAT_NAMES.get(field.name, field.name), getattr(group, field.name)
        if value == field.default:
            continue
        if keywords[flat] != field.default:
            raise UsageError.about(field.name, f"is given alone and in {name}; give it once")
        merged[flat] = value
    return merged


def add_grading(keywords: dict[str, Any], density: Graded) -> dict[str, Any]:
    """Return keywords with those of a graded density; raise UsageError for `by` or `grade` that are given alone."""
    for name in ("by", "grade"):
        if keywords[name] is not None:
            raise UsageError.about(name, "is given alone, and density is a Graded; give it there")
    return {**keywords, "density": (density.first, density.last), "by": density.by, "grade": density.grade}
