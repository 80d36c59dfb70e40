"""One declaration of each option: its type, default, unit, help and group.

A product declares its options as the fields of a frozen dataclass::

    voxel: Annotated[float | None, Option("Voxel size.", "Grid", unit="MM")] = None

The flag on the command line, the key in a config file, the check of its value, a saved config file and the page of
commands follow from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from types import NoneType
from typing import Annotated, Any, Literal, get_args, get_origin, get_type_hints

from infill.checks import choose_word
from infill.errors import ParameterError
from infill.files.excerpts import quote_value
from infill.options.keyword_options import Reader, check_whole, parse_flag, parse_number, parse_word
from patterns.given import suggest_name
from patterns.quantities import UNITS, parse_quantity


@dataclass(frozen=True)
class Option:
    """The description of an option, beside its type and default.

    Parameters
    ----------
    help : str
    group : str
        Heading in ``--help``.
    unit : str
        Placeholder of the value, such as MM; by default, the choices that the type lists.
    default : str
        The default in words.
    name : str
        Key in config files, and the flag; by default, the name of the field.
    read : callable, optional
        Checks a value; by default, the reader for the type.
    typed : type, optional
        Type on the command line, if `read` takes text.
    replaces : tuple of str
        Keys of options that say the same: where this one is typed, a config file's are dropped.
    negatable : bool
        Whether ``--no-name`` exists.
    """

    help: str
    group: str
    unit: str = ""
    default: str = ""
    name: str = ""
    read: Reader | None = None
    typed: Any = None
    replaces: tuple[str, ...] = ()
    negatable: bool = False


@dataclass(frozen=True)
class DeclaredOption:
    """An option with the name, type and default of its field."""

    field: str
    kind: Any
    default: Any
    option: Option

    @property
    def key(self) -> str:
        """Name in config files."""
        return self.option.name or self.field

    @property
    def flag(self) -> str:
        """Name on the command line."""
        return f"--{self.key.replace('_', '-')}"

    @property
    def help(self) -> str:
        """Help, with the default."""
        return self.option.help + (f" (default: {self.option.default})" if self.option.default else "")

    @property
    def placeholder(self) -> str | None:
        """Placeholder of the value in ``--help``."""
        return self.option.unit or ("|".join(get_args(self.kind)) if get_origin(self.kind) is Literal else None)

    @property
    def choices(self) -> tuple[str, ...]:
        """The words that the option can be; none if it can be anything else too."""
        if get_origin(self.kind) is Literal:
            return tuple(map(str, get_args(self.kind)))
        words = self.option.unit.split("|")
        is_list = len(words) > 1 and all(word == word.lower() for word in words)
        return tuple(words) if is_list else ()

    def read(self, value: object) -> Any:  # noqa: ANN401 - of the type of the field
        """Check a value from the command line or a config file; units and other names of a choice are understood."""
        choices = get_args(self.kind) if get_origin(self.kind) is Literal else ()
        if isinstance(value, str) and choices:
            value = choose_word(value, choices)
        if isinstance(value, str) and self.kind is float and self.option.read is None:
            number = parse_quantity(value, unit_of(self.option.unit))
            value = value if number is None else number
        reader = self.option.read or READERS[str if get_origin(self.kind) is Literal else self.kind]
        return reader(self.key, value)


def unit_of(placeholder: str) -> str:
    """Return the unit that the placeholder of an option stands for, or "".

    >>> unit_of("MM MM"), unit_of("MM/S2"), unit_of("CELLS")
    ('mm', 'mm/s2', '')
    """
    word = placeholder.split()[0].lower() if placeholder else ""
    return word if word in UNITS else ""


def parse_path(name: str, value: object) -> Path:
    """Check the name of a file, or raise UsageError."""
    return value if isinstance(value, Path) else Path(parse_word(name, value))


READERS: Mapping[Any, Reader] = {
    float: parse_number,
    int: check_whole,
    str: parse_word,
    bool: parse_flag,
    Path: parse_path,
}


def declared_options(declaration: type[Any]) -> Mapping[str, DeclaredOption]:
    """Return the options that a dataclass declares, by key, in the order of their fields."""
    described: Any = declaration
    return _read_fields(described)


@cache
def _read_fields(declaration: Any) -> Mapping[str, DeclaredOption]:  # noqa: ANN401 - a class, as a cache takes it
    """Return the options that a dataclass declares, by their keys."""
    hints = get_type_hints(declaration, include_extras=True)
    declared = {}
    for field in fields(declaration):
        if get_origin(hints[field.name]) is Annotated:
            kind, option = get_args(hints[field.name])
            if NoneType in get_args(kind):
                kind = next(member for member in get_args(kind) if member is not NoneType)
            entry = DeclaredOption(field.name, kind, field.default, option)
            declared[entry.key] = entry
    return declared


def read_options(command: str, declaration: type[Any], values: Mapping[str, object]) -> dict[str, Any]:
    """Check the values of options by key; return them by key, without those that are None.

    Raises
    ------
    ParameterError
        If a key is unknown, or a value is of the wrong type or out of range.
    """
    declared = declared_options(declaration)
    for key in values:
        if key not in declared:
            word = key.replace("_", "-")
            raise ParameterError(f"{command} has no option {quote_value(word)}; {suggest_name(key, declared)}")
    return {key: declared[key].read(value) for key, value in values.items() if value is not None}


def drop_replaced(declaration: type[Any], typed: Mapping[str, Any], filed: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options of a config file without those that typed ones replace; a flag that is off replaces none."""
    declared = declared_options(declaration)
    replaced = {
        rival for key, value in typed.items() if value is not False for rival in declared[key].option.replaces
    } - typed.keys()
    return {key: value for key, value in filed.items() if key not in replaced}


def by_field(declaration: type[Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by field instead of by key."""
    declared = declared_options(declaration)
    return {declared[key].field: value for key, value in values.items()}


def by_key(settings: Any) -> dict[str, Any]:  # noqa: ANN401 - any dataclass that declares options
    """Return the values of all options by key, as a config file has them."""
    return {key: getattr(settings, entry.field) for key, entry in declared_options(type(settings)).items()}
