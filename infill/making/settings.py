"""The settings of `infill make`: defaults, overridden by a TOML file, overridden by flags.

In the file, make's options are at the top level; the pattern's parameters go next to them, or in a table::

    pattern = "zigzag"
    size = [60, 40]

    [set]
    waves = 7.5
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.options.assignments import SET, collect_parameters, pop_table
from infill.options.declaration import Option, by_key, declared_options, read_options
from infill.options.keyword_options import parse_number, parse_share, parse_word
from infill.options.toml import format_rows, read_toml
from infill.options.trust import check_trusted
from patterns.quantities import parse_quantity

if TYPE_CHECKING:
    from infill.making.lattice_block import LatticeBlock
    from infill.making.request import Block
    from infill.result import Progress, Result
    from patterns import Pattern


BLOCK, ADVANCED = "Block", "Advanced"
STAMP_OPTIONS = ("stamp", "cells", "surface", "steps", "fidelity", "interface", "alpha")


def parse_size(name: str, size: object) -> tuple[float, ...]:
    """Return x and y in mm, and the height if it is given, from ``60x40``, ``60x40x20``, ``60``, 60 or [60, 40].

    >>> parse_size("size", "60x40"), parse_size("size", "6cm x 40mm x 20,5")
    ((60.0, 40.0), (60.0, 40.0, 20.5))
    """
    parts = re.split(r"\s*[x×X]\s*", size.strip()) if isinstance(size, str) else size
    if isinstance(size, str) and re.fullmatch(r"\d+,\s*\d+", size.strip()):  # 60 x 40, or 60.4?
        first, second = re.split(r",\s*", size.strip())
        raise UsageError.about(
            name, f"is {quote_value(size)}; give {first}x{second} for two sides, or {first}.{second} for one"
        )
    numbers = list(parts) if isinstance(parts, (list, tuple)) else [parts]
    lengths = [parse_quantity(part, "mm") if isinstance(part, str) else _as_float(part) for part in numbers]
    if len(lengths) not in (1, 2, 3) or None in lengths:
        raise UsageError.about(
            name, f"is {quote_value(size)}; give millimetres as 60x40, as 60x40x20 with the height, or 60 for a square"
        )
    return tuple(side for side in (lengths if len(lengths) > 1 else 2 * lengths) if side is not None)


def _as_float(number: object) -> float | None:
    """Convert a value to a float; return None if it is not a number."""
    try:
        return float(number)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return None


@dataclass(frozen=True, kw_only=True)
class MakeSettings:
    """One block of infill, described in terms of the command line.

    Parameters
    ----------
    pattern : str
        Its name, a drawing, or "module.py:name".
    size : (x, y) or (x, y, z)
        mm.
    height, line_width : float or None
        mm; None for 6 and 0.45, or what follows from the size and the density.
    density : float or None
        Solid share of the whole block; None for that of the lines, or 0.2 in space.
    stamp : {"block", "exact"}
    cells : int or None
        Grid cells across a line; None for 3 (block) or 5 (exact).
    surface : {"prism", "grid"} or None
        None for prism, and for grid where the tolerance is 0.
    tolerance : float or None
        mm; None for 0.002, and for 0 where the surface is grid.
    steps, fidelity, interface, alpha
        As in `infill.Smoothing`.
    parameters : dict
        The pattern's own parameters.
    """

    pattern: str
    size: Annotated[
        tuple[float, ...],
        Option(
            "Block in x and y: 60x40, or 60 for a square; with its height: 60x40x20.",
            BLOCK,
            unit="MMxMM",
            default="60x60",
            read=parse_size,
            typed=str,
        ),
    ] = (60.0, 60.0)
    height: Annotated[float | None, Option("Height of the block.", BLOCK, unit="MM", default="6")] = None
    line_width: Annotated[
        float | None, Option("Width of the walls, or diameter of bars.", BLOCK, unit="MM", default="0.45")
    ] = None
    density: Annotated[
        float | None,
        Option(
            "Solid share of the block: 20%, 20 or 0.2; the cell follows from it, or the line width beside a cell.",
            BLOCK,
            unit="SHARE",
            default="as drawn; 20% in space",
            read=parse_share,
            typed=str,
        ),
    ] = None
    stamp: Annotated[
        Literal["block", "exact"],
        Option(
            "How lines become walls. block: quick, up to 41 % wider on diagonals; exact: the same width in "
            "every direction.",
            BLOCK,
            default="block",
        ),
    ] = "block"
    cells: Annotated[
        int | None,
        Option(
            "Grid cells across a line: more are finer.",
            BLOCK,
            unit="N",
            default="3 for block, 5 for exact",
            read=parse_number,
        ),
    ] = None
    surface: Annotated[
        Literal["prism", "grid"] | None,
        Option(
            "prism: straight walls between flat faces; grid: the surface as it was computed, with rounded rims "
            "and six times the triangles.",
            BLOCK,
            default="prism; grid for a tolerance of 0",
        ),
    ] = None
    tolerance: Annotated[
        float | None,
        Option(
            "How far straightened walls may move: more makes fewer triangles, and 0 keeps them all.",
            BLOCK,
            unit="MM",
            default="0.002",
        ),
    ] = None
    steps: Annotated[
        int,
        Option(
            "Smoothing steps: more are rounder, and wear thin walls.", BLOCK, unit="N", default="10", read=parse_number
        ),
    ] = 10
    fidelity: Annotated[
        float,
        Option(
            "How strongly the stamp constrains the result, 0 to 1 or more.", ADVANCED, unit="NUMBER", default="0.01"
        ),
    ] = 0.01
    interface: Annotated[float, Option("Distance from surface to phi = 0.9.", ADVANCED, unit="CELLS", default="2")] = (
        2.0
    )
    alpha: Annotated[
        float, Option("Time step over the cell size squared, up to 0.25.", ADVANCED, unit="NUMBER", default="1/7")
    ] = 1 / 7
    parameters: dict[str, Any] = field(default_factory=dict)
    kind: Any = field(default=None, repr=False, compare=False)  # of patterns, as read

    @property
    def is_stamped(self) -> bool:
        """True if the block is drawn once and extruded."""
        from infill.making.request import is_stamped

        return is_stamped(self.kind or self.pattern, self.density)

    def build_pattern(self) -> Pattern:
        """Return the pattern with its parameters."""
        from infill.options.resolve_pattern import resolve_lines, with_parameters

        return with_parameters(self.kind or resolve_lines(self.pattern), self.parameters)

    def _request(self) -> dict[str, Any]:
        """Return the settings as keyword arguments of `infill.make`."""
        from infill.phasefield.allen_cahn import Smoothing

        smoothing = Smoothing(steps=self.steps, fidelity=self.fidelity, interface=self.interface, alpha=self.alpha)
        return {
            "pattern": self.build_pattern(),
            "size": self.size,
            "height": self.height,
            "line_width": self.line_width,
            "stamp": self.stamp,
            "cells": self.cells,
            "smoothing": smoothing,
            "surface": self.surface,
            "tolerance": self.tolerance,
        }

    def plan(self) -> Block | LatticeBlock:
        """Check the settings, but not the memory they need; return the block with its grid, without drawing it."""
        from infill.making.request import check_sides, plan_block, refuse_stamp_options

        if self.is_stamped:
            return plan_block(**self._request(), parameters={})
        from infill.making.lattice_block import plan_lattice

        defaults = {name: type(self).__dataclass_fields__[name].default for name in STAMP_OPTIONS}
        refuse_stamp_options({name: getattr(self, name) != defaults[name] for name in STAMP_OPTIONS}, self.density)
        lattice = plan_lattice(
            self.kind or self.pattern,
            sides=check_sides(self.size, self.height),
            density=self.density,
            line_width=self.line_width,
            tolerance=self.tolerance,
            values=self.parameters,
        )
        return lattice.rename(self.pattern)

    def make(
        self, *, allow_broken: bool = False, max_memory: int | None = None, progress: Progress | None = None
    ) -> Result[Any, Any]:
        """Run `infill.make` with these settings."""
        from infill.making.block import make

        if self.is_stamped:
            return make(**self._request(), allow_broken=allow_broken, max_memory=max_memory, progress=progress)
        from infill.making.lattice_block import LatticeBlock, make_lattice

        lattice = self.plan()
        assert isinstance(lattice, LatticeBlock)
        return make_lattice(lattice, max_memory=max_memory, progress=progress)

    def to_toml(self) -> str:
        """Return all settings, defaults included, as a TOML document that `resolve` reads back."""
        plain = {"pattern": self.pattern, **by_key(self)}
        from patterns import parameter_values

        pattern_values = parameter_values(self.build_pattern()) if self.is_stamped else self.parameters
        lines = [
            "# infill make --config THIS_FILE -o OUT",
            *format_rows(plain),
            "",
            f"[{SET}]",
            *format_rows(pattern_values),
            "",
        ]
        return "\n".join(lines)


def resolve(
    flags: Mapping[str, Any], config: Path | None = None, assigned: Sequence[str] = (), *, trust: bool = False
) -> MakeSettings:
    """Return the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    flags : mapping
        Options by name, except those that are None: make's, and those parameters of the pattern that are flags.
    config : Path, optional
        A TOML file.
    assigned : sequence of str
        Parameters of the pattern as ``name=value``; they may share a name with one of make's options.
    trust : bool
        Whether the file may name code to run and files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError, PatternError
        If a name is unknown to both `make` and the pattern, a parameter is given twice or cannot take its value,
        or no pattern is given.
    FormatError
        If the file is missing or not TOML, or asks for what it is not trusted with.
    """
    from infill.making.request import is_stamped, refuse_frame
    from infill.options.resolve_pattern import resolve_pattern

    file_values = read_toml(config, example="size = [60, 40]") if config else {}
    flag_values = {name: value for name, value in flags.items() if value is not None}
    if config:
        typed_names = file_values.keys() & flag_values.keys()
        check_trusted({name: file_values[name] for name in file_values.keys() - typed_names}, config, trust=trust)
    table = pop_table(file_values)
    values = file_values | flag_values
    if "pattern" not in values:
        raise ParameterError(
            "no pattern is given; name one ('infill list' shows all), or set pattern in the config file"
        )
    kind, values["pattern"] = resolve_pattern(parse_word("pattern", values["pattern"]), "make")
    declared: Any = kind
    if not is_stamped(kind, values.get("density")):
        from infill.making.lattice_block import declare_placed

        declared = declare_placed(kind)
    else:
        refuse_frame(kind, given=bool(values.get("frame")))
    common = {"pattern", *declared_options(MakeSettings)}
    parameters_given = collect_parameters(
        declared, common, flags=flag_values, assigned=assigned, filed=file_values, table=table
    )
    options = read_options(
        "make", MakeSettings, {name: values[name] for name in values if name in common - {"pattern"}}
    )
    return MakeSettings(**options, pattern=values["pattern"], parameters=parameters_given, kind=kind)
