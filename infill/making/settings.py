"""The settings of `infill make`: defaults, overridden by a TOML file, overridden by flags.

Angles are in degrees here, as on the command line; `MakeSettings.make` turns them into radians.

In the file, make's options are at the top level; the pattern's parameters go next to them, or in a table
`[set]`, where they may have any name::

    pattern = "zigzag"
    size = [60, 40]

    [set]
    waves = 7.5
"""

from __future__ import annotations

import dataclasses
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.errors import FormatError, ParameterError
from infill.making.assigning import Source, assignments, merged, values
from patterns import PATTERNS, Pattern, in_degrees, parameters
from patterns.given import from_degrees, nearest

if TYPE_CHECKING:
    from infill.making.request import Block
    from infill.making.stages import MakeStages
    from infill.result import Progress, Result

SET = "set"


@dataclass(frozen=True, kw_only=True)
class MakeSettings:
    """One block of infill, described in terms of the command line.

    Parameters
    ----------
    pattern : str
        Name of a registered pattern.
    size : (x, y)
        mm.
    height, line_width : float
        mm.
    stamp : {"block", "exact"}
    cells : int or None
        Grid cells across a line; None for 3 (block) or 5 (exact).
    steps, fidelity, interface, alpha
        As in `infill.Smoothing`.
    parameters : dict
        The pattern's own parameters, angles in degrees.
    """

    pattern: str
    size: tuple[float, float] = (60.0, 60.0)
    height: float = 6.0
    line_width: float = 0.45
    stamp: str = "block"
    cells: int | None = None
    steps: int = 10
    fidelity: float = 0.01
    interface: float = 2.0
    alpha: float = 1 / 7
    parameters: dict[str, Any] = field(default_factory=dict)

    def build_pattern(self) -> Pattern:
        """Return the pattern with its parameters, angles in radians."""
        kind = PATTERNS.find(self.pattern)
        return kind(**from_degrees(kind, self.parameters))

    def _request(self) -> dict[str, Any]:
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
        }

    def plan(self) -> Block:
        """Return the checked request with its grid and its cost."""
        from infill.making.request import plan

        return plan(**self._request(), parameters={})

    def make(
        self, *, allow_broken: bool = False, max_memory: int | None = None, progress: Progress | None = None
    ) -> Result[MakeStages]:
        """Run `infill.make` with these settings."""
        from infill.making.block import make

        return make(**self._request(), allow_broken=allow_broken, max_memory=max_memory, progress=progress)

    def to_toml(self) -> str:
        """Return all settings, defaults included, as a TOML document that `resolve` reads back."""
        plain = dataclasses.asdict(self)
        del plain["parameters"]
        own = in_degrees(self.build_pattern())
        lines = ["# infill make --config THIS_FILE -o OUT", *_rows(plain), "", f"[{SET}]", *_rows(own), ""]
        return "\n".join(lines)


def resolve(flags: Mapping[str, Any], config: Path | None = None, assigned: Sequence[str] = ()) -> MakeSettings:
    """Return the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    flags : mapping
        Options by name, except those that are None: make's, and those parameters of the pattern that are flags.
    config : Path, optional
        A TOML file.
    assigned : sequence of str
        Parameters of the pattern as ``name=value``; they may share a name with one of make's options.

    Raises
    ------
    ParameterError, PatternError
        If a name is unknown to both `make` and the pattern, a parameter is given twice or cannot take its value,
        or no pattern is given.
    FormatError
        If the file is missing or not TOML.
    """
    filed = _read(config) if config else {}
    table = filed.pop(SET, {})
    if not isinstance(table, dict):
        raise ParameterError(f"{SET} is {table!r}; it must be a table: a line [{SET}], then lines such as cell = 5")
    flagged = {name: value for name, value in flags.items() if value is not None}
    given = filed | flagged
    if "pattern" not in given:
        raise ParameterError(
            "no pattern is given; name one ('infill list' shows all), or set pattern in the config file"
        )
    kind = PATTERNS.find(_typed("pattern", given["pattern"], ""))
    common = {each.name: each.default for each in dataclasses.fields(MakeSettings) if each.name != "parameters"}
    own = parameters(kind)
    for name in given:
        if name not in common and name not in own:
            word = name.replace("_", "-")
            raise ParameterError(f"{kind.name} has no option {word!r}; {nearest(name, own, others=common)}")
    typed = {name: _typed(name, value, common[name]) for name, value in given.items() if name in common}
    parameters_given = merged(
        kind,
        command=[*values(kind, _without(flagged, common), Source.FLAG), *assignments(kind, assigned, options=common)],
        file=[*values(kind, _without(filed, common), Source.TOP), *values(kind, table, Source.TABLE)],
    )
    return MakeSettings(**typed, parameters=parameters_given)


def parse_size(size: object) -> tuple[float, float]:
    """Return x and y in mm from ``60x40``, ``60``, 60 or [60, 40].

    >>> parse_size("60x40")
    (60.0, 40.0)
    """
    parts = re.split(r"\s*[x×X]\s*", size.strip()) if isinstance(size, str) else size
    numbers = list(parts) if isinstance(parts, (list, tuple)) else [parts]
    try:
        lengths = [float(number) for number in numbers]  # type: ignore[arg-type]
    except (TypeError, ValueError):
        lengths = []
    if len(lengths) not in (1, 2):
        raise ParameterError(f"size is {size!r}; give millimetres as 60x40, or 60 for a square")
    return lengths[0], lengths[-1]


def _read(path: Path) -> dict[str, Any]:
    """Return the contents of a TOML file, with dashes in option names turned into underscores."""
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FormatError(f"there is no config file {path}; check the name") from None
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror}; check the file") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(f"{path} is not TOML: {error}; write lines such as size = [60, 40]") from error
    return {name.replace("-", "_"): value for name, value in content.items()}


def _typed(name: str, value: Any, default: Any) -> Any:  # noqa: ANN401 - checks values of any type
    """Return the value of one of make's options if it has the same type as `default`, or raise ParameterError."""
    word = name.replace("_", "-")
    if name == "size":
        return parse_size(value)
    if isinstance(default, str) or name == "pattern":
        wanted, fits = "a word", isinstance(value, str)
    else:
        wanted, fits = "a number", _is_number(value)
    if not fits:
        raise ParameterError(f"{word} is {value!r}; it must be {wanted}")
    return value


def _without(given: Mapping[str, Any], names: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in given.items() if name not in names}


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _rows(values: Mapping[str, Any]) -> list[str]:
    """Return one line of TOML for each value that is not None."""
    return [f"{name} = {_toml(value)}" for name, value in values.items() if value is not None]


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)
