"""Parameters of a pattern from flags, from ``--set name=value``, or from a config file.

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
from infill.plain_numbers import plain_argument
from patterns.declared import HasName, parameters
from patterns.errors import PatternError, PatternUsageError
from patterns.given import check_named_value, parse_assignment, suggest_name

SET = "set"


class ParameterSource(Enum):
    """Ways to give a parameter by name."""

    FLAG = "a flag"
    TOP = "the config file"
    TABLE = "[set] of the config file"


@dataclass(frozen=True, kw_only=True)
class ParameterValue:
    """The value of a parameter, and its source.

    Parameters
    ----------
    name : str
    value : bool, number, tuple or None
        Checked; angles in degrees.
    said : str
        The typed text, for messages.
    """

    name: str
    value: Any
    said: str


def pop_table(filed: dict[str, Any]) -> Mapping[str, Any]:
    """Remove the table of parameters from the contents of a config file, and return it."""
    table = filed.pop(SET, {})
    if not isinstance(table, dict):
        raise ParameterError(
            f"{SET} is {quote_value(table)}; it must be a table: a line [{SET}], lines such as cell = 5"
        )
    return table


def collect_parameters(
    kind: HasName,
    options: Collection[str],
    *,
    flags: Mapping[str, Any],
    assigned: Sequence[str],
    filed: Mapping[str, Any],
    table: Mapping[str, Any],
) -> dict[str, Any]:
    """Collect the parameters of a pattern by name from all sources; the command line wins over the file.

    Parameters
    ----------
    kind : Pattern, or another object with a name and parameters
    options : collection of str
        Names that are options of the command.
    flags, filed : mapping
        Values from flags and from the top of the file: options, and parameters whose names are not those of options.
    assigned : sequence of str
        Parameters as ``name=value``.
    table : mapping
        Parameters in the table of the file.

    Raises
    ------
    ParameterError
        If a name is unknown, or a parameter is given twice or cannot have its value.
    """
    declared = parameters(kind)
    for name in {**filed, **flags}:
        if name not in options and name not in declared:
            word = name.replace("_", "-")
            raise ParameterError(
                f"{kind.name} has no option {quote_value(word)}; {suggest_name(name, [*declared, *options])}"
            )
    flagged, top = ({name: value for name, value in source.items() if name not in options} for source in (flags, filed))
    return merge_parameters(
        kind,
        command=[
            *parse_values(kind, flagged, ParameterSource.FLAG),
            *parse_assignments(kind, assigned, options=options),
        ],
        file=[*parse_values(kind, top, ParameterSource.TOP), *parse_values(kind, table, ParameterSource.TABLE)],
    )


def parse_values(kind: HasName, named: Mapping[str, Any], source: ParameterSource) -> Iterator[ParameterValue]:
    """Yield parameters given as plain values; dashes and underscores in names are equivalent."""
    declared = parameters(kind)
    for word, value in named.items():
        name = word.replace("-", "_")
        if name not in declared:
            raise ParameterError(f"{kind.name} has no parameter {quote_value(word)}; {suggest_name(name, declared)}")
        yield ParameterValue(
            name=name, value=check_named_value(kind, name, value), said=_format_typed(name, value, source)
        )


def parse_assignments(kind: HasName, texts: Sequence[str], *, options: Iterable[str] = ()) -> Iterator[ParameterValue]:
    """Yield parameters from ``name=value``, or raise ParameterError with a message that begins with the typed text.

    Parameters
    ----------
    kind : Pattern, or another object with a name and parameters
    texts : sequence of str
    options : iterable of str
        Names that are options of the command instead, so that the message can say so.
    """
    flags = {name: f"--{name.replace('_', '-')}" for name in options}
    for text in texts:
        typed_text = f"--set {' '.join(text.splitlines())}"
        try:
            name, value = parse_assignment(kind, text)
        except PatternError as error:
            word = text.partition("=")[0].strip().replace("-", "_")
            if word in flags and word not in parameters(kind):
                raise ParameterError(
                    f"{typed_text}: {word} is not a parameter of {kind.name}; give {flags[word]}"
                ) from None
            error_class = UsageError if isinstance(error, PatternUsageError) else ParameterError
            raise error_class(f"{typed_text}: {error}") from error
        yield ParameterValue(name=name, value=value, said=typed_text)


def merge_parameters(
    kind: HasName, *, command: Iterable[ParameterValue], file: Iterable[ParameterValue]
) -> dict[str, Any]:
    """Merge parameters by name; the command line wins over the file.

    A parameter that replaces another (`replaces`) drops that one if only the file gives it; giving both in one source
    is an error, and so are two values of one parameter.
    """
    typed, filed = _index_by_name(command), _index_by_name(file)
    for name, (_, described) in parameters(kind).items():
        rival = described.replaces
        if _has_value(typed, rival) and name not in typed:
            filed.pop(name, None)
        elif _has_value(typed, name) and rival not in typed:
            filed.pop(rival, None)
        both = filed | typed
        if _has_value(both, name) and _has_value(both, rival):
            pair = f"{both[name].said} and {both[rival].said}"
            raise UsageError(f"{pair} are both given; {name} of {kind.name} replaces {rival}: leave one out")
    both = filed | typed
    return {name: both[name].value for name in parameters(kind) if name in both}


def _index_by_name(entries: Iterable[ParameterValue]) -> dict[str, ParameterValue]:
    """Index parameters by name, the first of equal ones; raise UsageError if two of one name differ."""
    by_name: dict[str, ParameterValue] = {}
    for parameter in entries:
        earlier = by_name.setdefault(parameter.name, parameter)
        if earlier.value != parameter.value:
            raise UsageError(f"{earlier.said} and {parameter.said} differ; give {parameter.name} once")
    return by_name


def _has_value(by_name: Mapping[str, ParameterValue], name: str) -> bool:
    """Tell whether a parameter was set, on the command line or in a file."""
    return name in by_name and by_name[name].value is not None


def _format_typed(name: str, value: object, source: ParameterSource) -> str:
    """Format a parameter as it was typed."""
    if source is not ParameterSource.FLAG:
        return f"{name} = {excerpt(str(value))} in {source.value}"
    word = name.replace("_", "-")
    if isinstance(value, bool):
        return f"--{word}" if value else f"--no-{word}"
    shown = value if isinstance(value, (tuple, list)) else (value,)
    return " ".join([f"--{word}", *(plain_argument(number) for number in shown)])
