"""Patterns by name: the built-in ones, loaded when they are asked for, and those of installed plug-ins.

A third party adds a pattern with the entry-point group ``infill.patterns``::

    [project.entry-points."infill.patterns"]
    waves = "my_package:Waves"
"""

from __future__ import annotations

import importlib
import itertools
import re
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from patterns.cellular import Cells
from patterns.errors import PatternError
from patterns.protocol import Pattern, lacking

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "infill.patterns"
# Words that people type, and names that slicers use, whose letters are nearer to another name; as `_letters` has them.
OTHER_NAMES = {
    "hexagon": "honeycomb",
    "hexagons": "honeycomb",
    "hex": "honeycomb",
    "squares": "grid",
    "lines": "rectilinear",
    "line": "rectilinear",
    "monotonic": "rectilinear",
    "monotonicline": "rectilinear",
    "monotoniclines": "rectilinear",
    "stars": "tri-hexagon",  # of PrusaSlicer
    "spiral": "archimedean-chords",
    "diamonds": "diamond",
    "heart": "concentric-heart",
    "schwarz": "schwarz-p",
    "primitive": "schwarz-p",
    "tpmsd": "schwarz-d",
    "tpmsfk": "fischer-koch-s",
    "foam": "voronoi-foam",
    "2dhoneycomb": "lateral-honeycomb",
    "2dlattice": "lateral-lattice",
    "cubicsubdiv": "adaptive-cubic",
    "cubicsubdivision": "adaptive-cubic",
}
PatternClass = type[Pattern] | type[Cells]


class PatternWarning(UserWarning):
    """A plug-in could not be used."""


def installed_plugins() -> list[EntryPoint]:
    """Return the entry points of the group, by name."""
    from importlib.metadata import entry_points

    return sorted(entry_points(group=GROUP), key=lambda entry: entry.name)


class Registry(Mapping[str, PatternClass]):
    """Classes of patterns by name; plug-ins are searched for once, when the registry is first read.

    Parameters
    ----------
    built_in : mapping of str to str
        By name, the module of this package and the class in it, as "honeycomb:Honeycomb".
    plugins : callable
        Returns the entry points of plug-ins.

    Notes
    -----
    A plug-in that cannot be imported, cannot be made without arguments, is not a pattern, or takes a name that is
    already in use causes one `PatternWarning` that names it.
    """

    def __init__(
        self, built_in: Mapping[str, str], plugins: Callable[[], list[EntryPoint]] = installed_plugins
    ) -> None:
        self.built_in = built_in
        self._plugins = plugins
        self._plugged_in: dict[str, PatternClass] | None = None

    def _load_plugins(self) -> dict[str, PatternClass]:
        """Load the patterns of installed plug-ins, once; warn of those that cannot be loaded."""
        if self._plugged_in is None:
            classes: dict[str, PatternClass] = {}
            for entry in self._plugins():
                try:
                    classes[entry.name] = _load(entry, [*self.built_in, *classes])
                except PatternError as error:
                    warnings.warn(str(error), PatternWarning, stacklevel=3)
            self._plugged_in = classes
        return self._plugged_in

    def __getitem__(self, name: str) -> PatternClass:
        if name not in self.built_in:
            return self._load_plugins()[name]
        module, _, class_name = self.built_in[name].partition(":")
        pattern_class: PatternClass = getattr(importlib.import_module(f"patterns.{module}"), class_name)
        return pattern_class

    def __contains__(self, name: object) -> bool:
        return name in self.built_in or name in self._load_plugins()

    def __iter__(self) -> Iterator[str]:
        return iter([*self.built_in, *self._load_plugins()])

    def __len__(self) -> int:
        return len(self.built_in) + len(self._load_plugins())

    def spelled(self, name: str) -> str:
        """Return the registered name that `name` spells in the way of a slicer, or `name` itself if there is none.

        Case, blanks, dashes and underscores do not count, nor does the order of words.

        >>> from patterns import PATTERNS
        >>> [PATTERNS.spelled(name) for name in ("Zig-zag", "3D Honeycomb", "CrossHatch", "gyriod")]
        ['zigzag', 'honeycomb-3d', 'cross-hatch', 'gyriod']
        """
        if name in self:
            return name
        typed = _letters(name)
        return next((registered for registered in self if typed in _spellings(registered)), name)

    def nearest(self, name: str, names: Collection[str]) -> str | None:
        """Return the pattern that a person who typed `name` may have meant, the nearest of `names`, or None."""
        import difflib

        known = OTHER_NAMES.get(_letters(name))
        if known in self:
            return known
        return next(iter(difflib.get_close_matches(name.lower(), names, n=1, cutoff=0.4)), None)

    def find(self, name: str) -> PatternClass:
        """Return the pattern called `name`, as `spelled` reads it, or raise PatternError suggesting the nearest."""
        spelled = self.spelled(name)
        if spelled in self:
            return self[spelled]
        meant = self.nearest(name, list(self))
        advice = f"there are {', '.join(self)}" if meant is None else f"did you mean {meant!r}?"
        raise PatternError(f"there is no pattern {name!r}; {advice} ('infill list' shows all)")


def _letters(name: str) -> str:
    """Return a name in lower case, with its letters and digits alone."""
    return "".join(re.findall(r"[^\W_]", name.lower()))


def _spellings(name: str) -> set[str]:
    """Return the letters of a name with its words in every order."""
    words = re.findall(r"[^\W_]+", name.lower())
    return {"".join(order) for order in itertools.permutations(words)}


def _load(entry: EntryPoint, used_names: Collection[str]) -> PatternClass:
    """Return the class behind `entry`, or raise PatternError that names the plug-in."""
    prefix = f"plug-in pattern {entry.name!r} ({entry.value}) is left out:"
    if entry.name in used_names:
        raise PatternError(f"{prefix} the name is taken; rename the entry point")
    try:
        pattern = entry.load()
        _check_class(pattern, entry.name)
        pattern()
    except (Exception, SystemExit) as error:
        message = " ".join(str(error).split())
        kind = "" if isinstance(error, PatternError) else f"{type(error).__name__}: "
        raise PatternError(f"{prefix} {kind}{message}; repair or uninstall it") from error
    loaded_class: PatternClass = pattern
    return loaded_class


def _check_class(pattern: Any, name: str) -> None:  # noqa: ANN401 - whatever a plug-in offers
    """Raise PatternError if `pattern` is not a pattern class with the name `name`."""
    missing = lacking(pattern)
    if not isinstance(pattern, type) or missing:
        raise PatternError(f"it is not a pattern class ({', '.join(missing) or 'no class'} missing)")
    if pattern.name != name:  # type: ignore[attr-defined]
        raise PatternError(f"its class is named {pattern.name!r}; name both alike")  # type: ignore[attr-defined]
