"""What every command does alike: it shows its options, and says what is wrong in the words that were typed.

The library's messages begin with the name of the argument that they are about, as Python spells it: "line_width is
-1 mm; ...". Here, and nowhere else, the option that was typed takes its place: "--line-width is -1 mm; ...".

Exit status 2 is for a command line that cannot be understood, and 1 for one that is, and cannot be done.
"""

from __future__ import annotations

import re
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from infill.cli.console import say
from infill.errors import InfillError, UsageError
from patterns.errors import PatternError, PatternUsageError

FAILED, USAGE = 1, 2
Misused: type[Exception] = typer.BadParameter.__mro__[1]  # the root of usage errors, which typer does not export
ADVANCED = "Advanced"  # the panel of what needs the mathematics
# What an argument of the library is called by a command, where a command has other names for it or more than one.
CALLED = {
    "threshold": ("threshold", "between"),
    "radius": ("smooth_radius",),
    "object": ("part",),
    "as": ("kind",),
    "for": ("slicer",),
    "open": ("open_",),
    "range": ("between",),
    "smooth": ("method",),
}
ABOUT = re.compile(
    r"(?P<where>label [^:]*: )?"  # one of several labels
    r"(?P<names>\w+(?:(?:, | and )\w+)*)"
    r"(?= (?:is|are|of|goes|x|y|has|holds|exclude|belong)\b)"
)


class Command(TyperCommand):
    """A command of ours."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401 - typer's own class, which it does not export
        """Return the options and arguments in the order of the help."""
        return _shown(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401
        """Read the arguments, or end with the usage and exit status 2; without any, the help is shown."""
        if not args:
            return super().parse_args(ctx, args)
        try:
            return super().parse_args(ctx, args)
        except Misused as error:
            raise _misused(ctx, _plain(error)) from error

    def invoke(self, ctx: Any) -> Any:  # noqa: ANN401
        """Run the command; an error of ours is one line and exit status 1, or 2 with the usage."""
        try:
            return super().invoke(ctx)
        except Misused as error:
            raise _misused(ctx, _plain(error)) from error
        except (InfillError, PatternError) as error:
            message = spelled(str(error), ctx)
            # What a config file says is no usage of the command line.
            typed = message != str(error) or message.startswith("--")
            if typed and isinstance(error, (UsageError, PatternUsageError)):
                raise _misused(ctx, message) from error
            say(f"error: {message}")
        except MemoryError:
            say("error: out of memory; use larger cells or voxels, or a smaller part")
        raise typer.Exit(FAILED)


class Group(TyperGroup):
    """The app itself, which shows its flags and says what is wrong as its commands do."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401
        """Return the options of the app."""
        return _shown(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401
        """Read what stands before the command, or end with the usage and exit status 2."""
        if not args:
            return super().parse_args(ctx, args)
        try:
            return super().parse_args(ctx, args)
        except Misused as error:
            raise _misused(ctx, _plain(error)) from error

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:  # noqa: ANN401
        """Return the command, or end with the usage and exit status 2 if there is none of the name."""
        try:
            return super().resolve_command(ctx, args)
        except Misused as error:
            raise _misused(ctx, _plain(error)) from error


def spelled(message: str, context: typer.Context) -> str:
    """Return a message with the options that were typed in place of the arguments that it begins with."""
    found = ABOUT.match(message)
    if found is None:
        return message
    names = re.sub(r"\w+", lambda word: _option(word[0], context), found["names"])
    return f"{found['where'] or ''}{names}{message[found.end() :]}"


def _option(word: str, context: typer.Context) -> str:
    """Return the option that was typed for an argument of the library, or the word itself."""
    for each in context.command.params:
        source = context.get_parameter_source(str(each.name))
        if each.name in CALLED.get(word, (word,)) and source is not None and source.name == "COMMANDLINE":
            return max(each.opts, key=len)
    return word


def _plain(error: Any) -> str:  # noqa: ANN401 - a usage error of typer's
    """Return what typer says, without the words that say nothing."""
    message: str = error.format_message()
    return message.removeprefix("Invalid value: ").replace("Value error, ", "")


def _misused(context: typer.Context, message: str) -> typer.Exit:
    """Say what is wrong with a command line, below its usage, and return how to end."""
    say(context.get_usage())
    say(f"Try '{context.command_path} --help' for help.")
    say(f"error: {message}")
    return typer.Exit(USAGE)


def _shown(params: list[Any]) -> list[Any]:
    """Return parameters with those of the panel "Advanced" last; flags and arguments show no type: names say enough."""
    for each in params:
        if each.param_type_name == "argument":
            each.display_type_rich = lambda ctx: None  # noqa: ARG005 - the signature of typer's
        if getattr(each, "is_flag", False) and each.metavar is None:
            each.metavar = ""
    return sorted(params, key=lambda each: getattr(each, "rich_help_panel", None) == ADVANCED)
