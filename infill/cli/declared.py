"""Flags of a command from the declarations of its options."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from typing import Annotated, Any, cast

import typer

from infill.options.declaration import DeclaredOption, declared_options

TYPED = "typed"  # the parameter of a command in whose place the flags stand


def takes_options(
    declaration: type[Any], **completions: Callable[[str], Any]
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the flags of a declaration; its parameter `typed` receives the typed values by key.

    Parameters
    ----------
    declaration : type
        A dataclass: see `infill.options.declaration`.
    **completions
        By field, a function that completes a word in a shell.
    """

    def decorate(command: Callable[..., None]) -> Callable[..., None]:
        declared = declared_options(declaration)

        @wraps(command)
        def run(**values: Any) -> None:  # noqa: ANN401 - values of any type
            flags = {key: values.pop(entry.field) for key, entry in declared.items()}
            command(**values, typed={key: value for key, value in flags.items() if value is not None})

        signature = inspect.signature(command, eval_str=True)
        parameters = list(_replace_typed(signature, declared.values(), completions))
        run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
        return cast("Callable[..., None]", run)

    return decorate


def _replace_typed(
    signature: inspect.Signature, declared: Iterable[DeclaredOption], completions: Mapping[str, Callable[[str], Any]]
) -> Iterator[inspect.Parameter]:
    """Yield the parameters of a command, with flags in place of `typed`."""
    for parameter in signature.parameters.values():
        if parameter.name == TYPED:
            yield from (_parameter(entry, completions.get(entry.field)) for entry in declared)
        else:
            yield parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)


def _parameter(entry: DeclaredOption, complete: Callable[[str], Any] | None) -> inspect.Parameter:
    """Return the parameter of a command for an option; None stands for an option that was not typed."""
    option = entry.option
    flag = f"{entry.flag}/--no-{entry.flag[2:]}" if option.negatable else entry.flag
    kind: Any = (option.typed or entry.kind) | None
    described = typer.Option(
        flag,
        metavar=entry.placeholder,
        help=entry.help,
        rich_help_panel=option.group,
        show_default=False,
        autocompletion=complete,
    )
    return inspect.Parameter(
        entry.field,
        inspect.Parameter.KEYWORD_ONLY,
        default=None,
        annotation=Annotated[kind, described],
    )
