"""Options as words of a command line, as a person would type them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, get_origin

from infill.options.declaration import DeclaredOption

JOINTS = {"size": "x", "density": ":", "layers": "-"}  # between the numbers of one word; others have commas


def flag_words(entry: DeclaredOption, value: object) -> list[str]:
    """Return an option as words of a command line.

    >>> from infill.lattices.settings import FillOptions
    >>> from infill.options.declaration import declared_options
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
