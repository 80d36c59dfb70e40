"""A user's request for a refill, checked."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from infill.checks import check_positive, check_range
from infill.errors import ParameterError, UsageError
from patterns.errors import PatternError

Progress = Callable[[str, float], None]
KEEP = "keep"
AUTO = "auto"
SAME = "same"
LARGEST_RADIUS = 100.0  # mm
DRAWINGS = (".svg", ".dxf", ".wkt", ".png", ".jpg", ".jpeg", ".bmp")


@dataclass(frozen=True, kw_only=True)
class Request:
    """Options of a refill.

    Parameters
    ----------
    pattern : str
        "keep" for the slicer's own paths, the name of a pattern, or the path of a drawing.
    density : None, "same" or float
        None: the slicer's filament per mm with its own paths, its filament with others. "same": its filament.
        A number above 0 and up to 1: the share of the volume.
    smooth_radius : "auto" or float
        mm; 0 leaves corners as they are.
    max_deviation : float, optional
        Largest move of a path, mm.
    layers : tuple of int, optional
        First and last layer to refill, counted from 1.
    part : str, optional
        Refill only objects whose name contains this.
    parameters : mapping
        Of the pattern, by name; angles in degrees.

    Raises
    ------
    ParameterError
        If one of them is out of range.
    """

    pattern: str = KEEP
    density: str | float | None = None
    smooth_radius: str | float = AUTO
    max_deviation: float | None = None
    layers: tuple[int, int] | None = None
    part: str | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.density is None:
            pass
        elif isinstance(self.density, str):
            if self.density != SAME:
                raise UsageError(f"density is {self.density!r}; give 'same', or a number above 0 and up to 1")
        elif not 0 < check_positive("density", self.density) <= 1:
            raise ParameterError(f"density is {self.density:g}; give 'same', or a number above 0 and up to 1")
        if isinstance(self.smooth_radius, str):
            if self.smooth_radius != AUTO:
                raise UsageError(f"smooth_radius is {self.smooth_radius!r}; give 'auto', or a number in mm")
        else:
            check_range("smooth_radius", self.smooth_radius, 0, LARGEST_RADIUS, "mm")
        if self.max_deviation is not None:
            check_range("max_deviation", self.max_deviation, 0, LARGEST_RADIUS, "mm")
        if self.layers is not None and not 1 <= self.layers[0] <= self.layers[1]:
            raise ParameterError(f"layers is {self.layers[0]} to {self.layers[1]}; count from 1, the lower one first")
        if self.pattern != KEEP and Path(self.pattern).suffix.lower() not in DRAWINGS:
            from infill.paths.families.catalogue import FAMILIES

            if self.pattern not in FAMILIES:
                matches = difflib.get_close_matches(self.pattern.lower(), FAMILIES, n=1, cutoff=0.4)
                advice = f"did you mean {matches[0]!r}?" if matches else f"give keep, or one of {', '.join(FAMILIES)}"
                raise ParameterError(f"there is no pattern {self.pattern!r}; {advice}")
        if self.pattern == KEEP and isinstance(self.density, int | float):
            raise UsageError("density is for built-in patterns; keep has the slicer's: leave it out, or set it there")
        if self.parameters:
            from infill.refilling.placement import pattern_parameters

            try:
                pattern_parameters(self.pattern, self.parameters)
            except PatternError as error:
                raise ParameterError(str(error)) from None
            if self.cell is not None and self.density is not None:
                raise UsageError("density and cell are both given, and each decides the other; leave one out")

    @property
    def radius(self) -> float:
        """The largest radius, mm."""
        return math.inf if isinstance(self.smooth_radius, str) else float(self.smooth_radius)

    @property
    def cell(self) -> float | None:
        """The requested size of the pattern, mm."""
        cell = self.parameters.get("cell")
        return None if cell is None else float(cell)

    @property
    def deviation(self) -> float:
        """The largest deviation, mm."""
        return math.inf if self.max_deviation is None else float(self.max_deviation)
