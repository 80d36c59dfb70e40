"""How to make a result again without the studio: a command, a few lines of Python, or a config file."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, get_origin

from infill.options.declaration import DeclaredOption, declared_options

JOINTS = {"size": "x", "density": ":", "layers": "-"}  # between the numbers of one word; others have commas


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


def flag_words(entry: DeclaredOption, value: object) -> list[str]:
    """Return an option as words of a command line.

    >>> from infill.lattices.settings import FillOptions
    >>> declared = declared_options(FillOptions)
    >>> flag_words(declared["density"], [0.15, 0.4]), flag_words(declared["ties"], False)
    (['--density', '0.15:0.4'], ['--no-ties'])
    >>> flag_words(declared["drain_at"], [[1, 2, 3]]), flag_words(declared["phase"], [0, 1, 2])
    (['--drain-at', '1,2,3'], ['--phase', '0', '1', '2'])
    """
    flag, typed = entry.flag, get_origin(entry.option.typed)
    if isinstance(value, bool):
        return [flag] if value else [f"--no-{flag[2:]}"] if entry.option.negatable else []
    if isinstance(value, Mapping):
        return [flag, ",".join(f"{name}={item}" for name, item in value.items())]
    if isinstance(value, (list, tuple)):
        if typed is list:
            items = value if all(isinstance(item, (list, tuple, str)) for item in value) or len(value) != 3 else [value]
            if entry.key == "label":
                items = value
            return [word for item in items for word in (flag, _word(item, ","))]
        if typed is tuple:
            return [flag, *(_word(item, ",") for item in (*value, 0)[: max(len(value), 3)])]
    return [flag, _word(value, JOINTS.get(entry.key, ","))]


def _word(value: object, joint: str) -> str:
    """Return a value as one word."""
    if isinstance(value, (list, tuple)):
        return joint.join(_word(item, joint) for item in value)
    return str(value)


def assignments(parameters: Mapping[str, Any]) -> Iterator[str]:
    """Yield parameters of a pattern as name=value."""
    for name, value in parameters.items():
        if isinstance(value, bool) or value is None:
            yield f"{name}={str(value).lower()}"
        else:
            yield f"{name}={_word(value, ',')}"


def plain_parameters(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return parameters of a pattern as Python takes them."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in parameters.items()}
