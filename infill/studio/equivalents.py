"""How to make a result again without the studio: a command, a few lines of Python, or a config file."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from infill.options.command_words import assignments, flag_words
from infill.options.declaration import declared_options


@dataclass(frozen=True, kw_only=True)
class Call:
    """A call of a public function, as a person writes it.

    Parameters
    ----------
    function : str
        Of `infill`.
    positional : tuple
    keywords : mapping
        By name; `Code` stays as it is.
    imports : tuple of str
        Further names of `infill` that it needs.
    save : str
        Line that writes the file; empty if the call does.
    """

    function: str
    positional: tuple[Any, ...] = ()
    keywords: Mapping[str, Any] = field(default_factory=dict)
    imports: tuple[str, ...] = ()
    save: str = ""

    def to_python(self) -> str:
        """Return the call as lines of Python."""
        names = sorted({self.function, *self.imports}, key=str.lower)
        words = [write_value(value) for value in self.positional]
        words += [f"{name}={write_value(value)}" for name, value in self.keywords.items()]
        lines = [f"from infill import {', '.join(names)}", "", f"result = {self.function}({', '.join(words)})"]
        return "\n".join([*lines, *filter(None, [self.save]), ""])


@dataclass(frozen=True)
class Code:
    """An expression of Python."""

    text: str


def write_value(value: object) -> str:
    """Return a plain value as Python.

    >>> write_value((1.0, 2)), write_value("part.stl"), write_value(Code("Smoothing(steps=5)"))
    ('(1.0, 2)', '"part.stl"', 'Smoothing(steps=5)')
    """
    if isinstance(value, Code):
        return value.text
    if isinstance(value, (tuple, list)):
        words = [write_value(item) for item in value]
        return f"({', '.join(words)}{',' if len(words) == 1 else ''})"
    if isinstance(value, str) and value.isprintable():
        return json.dumps(value, ensure_ascii=False)
    return repr(value)


def write_command(
    name: str,
    positional: Sequence[str],
    declaration: type[Any],
    options: Mapping[str, Any],
    parameters: Mapping[str, Any],
) -> list[str]:
    """Return the words of a command without its output.

    Parameters
    ----------
    name : str
        Of the command.
    positional : sequence of str
    declaration : type
        Of its options.
    options, parameters : mapping
        By key, and parameters of the pattern by name, as the page sent them.
    """
    declared = declared_options(declaration)
    words = ["infill", name, *(f"./{word}" if word.startswith("-") else word for word in positional)]
    for key, value in options.items():
        words += flag_words(declared[key], value)
    for text in assignments(parameters):
        words += ["--set", text]
    return words


def join_words(words: Iterable[str]) -> str:
    """Return words as one line for a shell."""
    return shlex.join(words)


def plain_parameters(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return parameters of a pattern as Python takes them."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in parameters.items()}
