"""Values as people type them: numbers with a unit or a decimal comma, and other names of choices.

They are rewritten before the command line is parsed, so that every option of every command takes the same forms, and a
value that is none of them is refused in words that show it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from infill.checks import choose_word
from infill.files.excerpts import quote_value
from infill.options.declaration import unit_of
from patterns.quantities import number_advice, parse_quantity

# Placeholders of single numbers, or of several words.
NUMBERS = {"MM", "MM MM", "MM MM MM", "DEG", "NUMBER", "CELLS", "VOXELS", "VALUE", "MM3", "MM/S", "MM/S2"}
WHOLE = "N"


class TypedValueError(Exception):
    """A value that cannot be read, with the option it was typed for."""


def rewrite_values(options: Sequence[Any], arguments: Sequence[str]) -> list[str]:
    """Rewrite the values of options as plain numbers and listed choices.

    Parameters
    ----------
    options : sequence of typer's parameters
        Of the command.
    arguments : sequence of str

    Raises
    ------
    TypedValueError
        If a value is not a number where one is needed.
    """
    by_flag = {flag: option for option in options for flag in option.opts if flag.startswith("-")}
    return list(_rewrite_arguments(by_flag, arguments))


def _rewrite_arguments(by_flag: dict[str, Any], arguments: Sequence[str]) -> Iterator[str]:
    """Yield the arguments, with the values of options as plain numbers and listed choices."""
    place = 0
    while place < len(arguments):
        word = arguments[place]
        place += 1
        if word == "--":
            yield from (word, *arguments[place:])
            return
        flag, equals, value = word.partition("=")
        option = by_flag.get(flag)
        if option is None or getattr(option, "is_flag", False):
            yield word
        elif equals:
            yield f"{flag}={_rewrite_value(flag, option.metavar or '', value)}"
        else:
            count = len((option.metavar or "x").split()) if option.metavar in NUMBERS else 1
            values = arguments[place : place + count]
            place += len(values)
            yield word
            yield from (_rewrite_value(flag, option.metavar or "", value) for value in values)


def _rewrite_value(flag: str, placeholder: str, value: str) -> str:
    """Return a value as typer reads it; raise TypedValueError if a number is needed and it is none."""
    if placeholder in NUMBERS:
        unit = unit_of(placeholder)
        number = parse_quantity(value, unit)
        if number is None:
            raise TypedValueError(f"{flag} is {quote_value(value)}; {number_advice(value, unit)}")
        return repr(number)
    if placeholder == WHOLE:
        if not value.strip().lstrip("+-").isdecimal():
            raise TypedValueError(f"{flag} is {quote_value(value)}; give a whole number")
        return value
    choices = placeholder.split("|")
    return choose_word(value, choices) if len(choices) > 1 else value
