"""The settings of `infill make`: defaults, a TOML file, and flags over both.

Angles are degrees here, as at the command line; `MakeSettings.make` turns them into radians.
"""

from __future__ import annotations

import dataclasses
import difflib
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.errors import FormatError, ParameterError
from patterns import PATTERNS, Pattern, in_degrees, parameters

if TYPE_CHECKING:
    from infill.making.request import Block
    from infill.making.stages import MakeStages
    from infill.result import Progress, Result


@dataclass(frozen=True, kw_only=True)
class MakeSettings:
    """One block of infill, described in the words of the command line.

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
        The pattern's own, angles in degrees.
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

    def _pattern(self) -> Pattern:
        kind = PATTERNS.find(self.pattern)
        angles = {name for name, (_, described) in parameters(kind).items() if described.unit == "rad"}
        return kind(**{name: math.radians(v) if name in angles else v for name, v in self.parameters.items()})

    def _request(self) -> dict[str, Any]:
        from infill.phasefield.allen_cahn import Smoothing

        smoothing = Smoothing(steps=self.steps, fidelity=self.fidelity, interface=self.interface, alpha=self.alpha)
        return {
            "pattern": self._pattern(),
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
        own = in_degrees(self._pattern())
        rows = [f"{name} = {_toml(value)}" for name, value in {**plain, **own}.items() if value is not None]
        return "\n".join(["# infill make --config THIS_FILE -o OUT", *rows, ""])


def resolve(flags: dict[str, Any], config: Path | None = None) -> MakeSettings:
    """Return the settings: flags that are not None win over the file, the file over the defaults.

    Raises
    ------
    ParameterError
        For a key that neither `make` nor the pattern has, or without a pattern.
    FormatError
        If the file is missing or no TOML.
    """
    given = {name.replace("-", "_"): value for name, value in (_read(config) if config else {}).items()}
    flagged = {name: value for name, value in flags.items() if value is not None}
    if "pattern" not in given | flagged:
        raise ParameterError(
            "no pattern is given; name one ('infill list' shows all), or set pattern in the config file"
        )
    kind = PATTERNS.find(str((given | flagged)["pattern"]))
    common = {each.name: each for each in dataclasses.fields(MakeSettings) if each.name != "parameters"}
    own = parameters(kind)
    for name, (_, described) in own.items():
        rival = described.replaces
        if rival in flagged and name not in flagged:
            given.pop(name, None)  # the flag for one drops the other from the file
        elif name in flagged and rival not in flagged:
            given.pop(rival, None)
        if {name, rival} <= set(given | flagged):
            raise ParameterError(
                f"{name} and {rival} of {kind.name} are both given; {name} replaces {rival}: leave one out"
            )
    given |= flagged
    for name in given:
        if name not in common and name not in own:
            near = difflib.get_close_matches(name, [*common, *own], n=1)
            advice = f"did you mean {near[0]!r}?" if near else f"it has {', '.join(own)}"
            raise ParameterError(f"{kind.name} has no option {name.replace('_', '-')!r}; {advice}")
    if "size" in given:
        given["size"] = parse_size(given["size"])
    for name, default in {
        **{n: f.default for n, f in common.items()},
        **{n: f.default for n, (f, _) in own.items()},
    }.items():
        if name in given:
            given[name] = _typed(name, given[name], default)
    return MakeSettings(
        **{name: given[name] for name in common if name in given},
        parameters={name: given[name] for name in own if name in given},
    )


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
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FormatError(f"there is no config file {path}; check the name") from None
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror}; check the file") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(f"{path} is no TOML: {error}; write lines such as size = [60, 40]") from error


def _typed(name: str, value: Any, default: Any) -> Any:  # noqa: ANN401 - checks values of any type
    """Return `value` if it is of the kind that `default` is, or raise ParameterError."""
    word = name.replace("_", "-")
    if isinstance(default, bool):
        wanted, fits = "true or false", isinstance(value, bool)
    elif isinstance(default, tuple):
        fits = isinstance(value, (list, tuple)) and len(value) == len(default) and all(map(_is_number, value))
        wanted, value = f"{len(default)} numbers", tuple(value) if fits else value
    elif isinstance(default, str) or name == "pattern":
        wanted, fits = "a word", isinstance(value, str)
    else:
        wanted, fits = "a number", _is_number(value)
    if not fits:
        raise ParameterError(f"{word} is {value!r}; it must be {wanted}")
    return value


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)
