"""Patterns in space: walls or bars around cells that repeat along x, y and z, or follow the skin of a part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from patterns.declared import check_parameters, parameter
from patterns.errors import PatternError


@dataclass(frozen=True, kw_only=True)
class Cells:
    """Walls or bars around cells in space.

    Parameters
    ----------
    name, summary : str
        The name to type on the command line; what the pattern is for, in one phrase.
    cell : float, optional
        Period, mm; None leaves it to a density.

    Attributes
    ----------
    prismatic : bool
        False, as sections change with height.
    bars : bool
        True for bars with one void around all of them, instead of walls.
    repeats : bool
        False if the cells follow the skin of a part.
    paths : bool
        See `patterns.Pattern`.
    """

    prismatic: ClassVar[bool] = False
    bars: ClassVar[bool] = False
    repeats: ClassVar[bool] = True
    paths: ClassVar[bool] = False

    name: str = ""
    summary: str = ""
    cell: float | None = parameter(None, "period, in place of a density", low=0.001, high=1e4)

    def __post_init__(self) -> None:
        """Check the parameters."""
        if not self.name:
            raise PatternError(f"a pattern of {type(self).__name__} has no name; give name='mine'")
        check_parameters(self)
