"""The parameters of a pattern as they are given: by flags, by ``--set name=value``, or in a config file.

In the file, options of the command are at the top level; the pattern's parameters go next to them, or in a table
`[set]`, where they may have any name.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import excerpt, quote_value
from patterns.declared import Named, parameters
from patterns.errors import PatternError, PatternUsageError
from patterns.given import assigned, nearest, value_of

SET = "set"


class Source(Enum):
    """Where a parameter can be given by name."""

    FLAG = "a flag"
    TOP = "the config file"
    TABLE = "[set] of the config file"


@dataclass(frozen=True, kw_only=True)
class Given:
    """A parameter that was given.

    Parameters
    ----------
    name : str
    value : bool, number, tuple or None
        Checked; angles in degrees.
    said : str
        What was typed, for messages.
    """

    name: str
    value: Any
    said: str


def table_of(filed: dict[str, Any]) -> Mapping[str, Any]:
    """Take the table of parameters out of what a config file holds, and return it."""
    table = filed.pop(SET, {})
    if not isinstance(table, dict):
        raise ParameterError(
            f"{SET} is {quote_value(table)}; it must be a table: a line [{SET}], lines such as cell = 5"
        )
    return table


def gathered(
    kind: Named,
    options: Collection[str],
    *,
    flags: Mapping[str, Any],
    assigned: Sequence[str],
    filed: Mapping[str, Any],
    table: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the parameters of a pattern by name, wherever they are given; the command line wins over the file.

    Parameters
    ----------
    kind : Pattern, or what else has a name and parameters
    options : collection of str
        Names that are options of the command.
    flags, filed : mapping
        What is given by flags and at the top of the file: options, and parameters that no option has the name of.
    assigned : sequence of str
        Parameters as ``name=value``.
    table : mapping
        Parameters in the table of the file.

    Raises
    ------
    ParameterError
        If a name is unknown, a parameter is given twice, or cannot have its value.
    """
    own = parameters(kind)
    for name in {**filed, **flags}:
        if name not in options and name not in own:
            word = name.replace("_", "-")
            raise ParameterError(f"{kind.name} has no option {quote_value(word)}; {nearest(name, [*own, *options])}")
    flagged, top = ({name: value for name, value in each.items() if name not in options} for each in (flags, filed))
    return merged(
        kind,
        command=[*values(kind, flagged, Source.FLAG), *assignments(kind, assigned, options=options)],
        file=[*values(kind, top, Source.TOP), *values(kind, table, Source.TABLE)],
    )


def values(kind: Named, named: Mapping[str, Any], source: Source) -> Iterator[Given]:
    """Yield parameters given as plain values; dashes and underscores in names are equivalent."""
    known = parameters(kind)
    for word, value in named.items():
        name = word.replace("-", "_")
        if name not in known:
            raise ParameterError(f"{kind.name} has no parameter {quote_value(word)}; {nearest(name, known)}")
        yield Given(name=name, value=value_of(kind, name, value), said=_said(name, value, source))


def assignments(kind: Named, texts: Sequence[str], *, options: Iterable[str] = ()) -> Iterator[Given]:
    """Yield parameters given as ``name=value``, or raise ParameterError whose message begins with what was typed.

    Parameters
    ----------
    kind : Pattern, or what else has a name and parameters
    texts : sequence of str
    options : iterable of str
        Names that are options of the command instead, so that the message can say so.
    """
    flags = {name: f"--{name.replace('_', '-')}" for name in options}
    for text in texts:
        said = f"--set {' '.join(text.splitlines())}"
        try:
            name, value = assigned(kind, text)
        except PatternError as error:
            word = text.partition("=")[0].strip().replace("-", "_")
            if word in flags and word not in parameters(kind):
                raise ParameterError(f"{said}: {word} is not a parameter of {kind.name}; give {flags[word]}") from None
            leaf = UsageError if isinstance(error, PatternUsageError) else ParameterError
            raise leaf(f"{said}: {error}") from error
        yield Given(name=name, value=value, said=said)


def merged(kind: Named, *, command: Iterable[Given], file: Iterable[Given]) -> dict[str, Any]:
    """Return the parameters by name; the command line wins over the file.

    A parameter that replaces another (`replaces`) drops the other one if only the file gives it; giving both in one
    place is an error, as is giving one parameter two values.
    """
    typed, filed = _once(command), _once(file)
    for name, (_, described) in parameters(kind).items():
        rival = described.replaces
        if _counts(typed, rival) and name not in typed:
            filed.pop(name, None)
        elif _counts(typed, name) and rival not in typed:
            filed.pop(rival, None)
        both = filed | typed
        if _counts(both, name) and _counts(both, rival):
            said = f"{both[name].said} and {both[rival].said}"
            raise UsageError(f"{said} are both given; {name} of {kind.name} replaces {rival}: leave one out")
    both = filed | typed
    return {name: both[name].value for name in parameters(kind) if name in both}


def _once(given: Iterable[Given]) -> dict[str, Given]:
    """Return the given parameters by name, or raise ParameterError if one of them has two values."""
    found: dict[str, Given] = {}
    for each in given:
        first = found.setdefault(each.name, each)
        if first.value != each.value:
            raise UsageError(f"{first.said} and {each.said} differ; give {each.name} once")
    return found


def _counts(given: Mapping[str, Given], name: str) -> bool:
    return name in given and given[name].value is not None


def _said(name: str, value: object, source: Source) -> str:
    """Return a parameter as it was typed."""
    if source is not Source.FLAG:
        return f"{name} = {excerpt(str(value))} in {source.value}"
    word = name.replace("_", "-")
    if isinstance(value, bool):
        return f"--{word}" if value else f"--no-{word}"
    shown = value if isinstance(value, (tuple, list)) else (value,)
    return " ".join([f"--{word}", *(f"{each:g}" for each in shown)])
