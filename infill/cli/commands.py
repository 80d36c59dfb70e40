"""Behaviour of all commands: the help of their options, and errors in the words that were typed.

Errors of the library carry the names of the arguments that they are about: "line_width is -1 mm; ...". Here, and
nowhere else, the option that was typed replaces the name: "--line-width is -1 mm; ...".

Exit status 2 is for a command line that cannot be understood, and 1 for one that is, and cannot be done.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from infill.cli.console import say
from infill.cli.typed_values import TypedValueError, rewrite_values
from infill.errors import InfillError, OutputError, UsageError
from infill.files.broken import missing_file
from patterns.errors import PatternError, PatternUsageError

FAILED, USAGE = 1, 2
UsageException: type[Exception] = typer.BadParameter.__mro__[1]  # the root of usage errors, which typer does not export
ADVANCED = "Advanced"  # the panel of options that need the mathematics
# Options, by flag, that stand for an argument of the library with another name.
FLAGS_OF_ARGUMENT = {
    "threshold": ("--threshold", "--range"),
    "between": ("--range",),
    "radius": ("--smooth-radius",),
    "method": ("--smooth",),
    "kind": ("--as",),
    "slicer": ("--for",),
    "part": ("--object",),
}


class Command(TyperCommand):
    """A command of the app."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401 - typer's own class, which it does not export
        """Return the options and arguments in the order of the help."""
        return _sort_options(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401
        """Read the arguments, or end with the usage and exit status 2; without any, the help is shown."""
        if not args:
            return super().parse_args(ctx, args)
        try:
            return super().parse_args(ctx, rewrite_values(self.params, args))
        except TypedValueError as error:
            raise usage_exit(ctx, str(error)) from error
        except UsageException as error:
            raise usage_exit(ctx, _plain_message(error)) from error

    def invoke(self, ctx: Any) -> Any:  # noqa: ANN401
        """Run the command; print an error of the library as one line and exit with 1, or with the usage and 2."""
        try:
            return self.run(ctx)
        except (InfillError, PatternError, MemoryError) as error:
            say(f"error: {self.explain(ctx, error)}")
        raise typer.Exit(FAILED)

    def run(self, ctx: Any) -> Any:  # noqa: ANN401
        """Run the command; print an error of the command line with the usage, and exit with 2."""
        try:
            return super().invoke(ctx)
        except UsageException as error:
            raise usage_exit(ctx, _plain_message(error)) from error
        except (UsageError, PatternUsageError) as error:
            # An option of a config file is not part of the command line.
            message = use_typed_options(error, ctx)
            if message != str(error) or message.startswith("--"):
                raise usage_exit(ctx, message) from error
            raise

    def explain(self, ctx: Any, error: BaseException) -> str:  # noqa: ANN401
        """Return the message of an error of the library, with the options that were typed."""
        if isinstance(error, MemoryError):
            return "out of memory; use larger cells or voxels, or a smaller part"
        assert isinstance(error, (InfillError, PatternError))
        missing = _find_missing_input(ctx) if isinstance(error, OutputError) else None
        return use_typed_options(error, ctx) if missing is None else missing_file(missing)


# Options that people type from another command or a slicer, and what they mean here: the first that the command has.
OTHER_OPTIONS = {
    "--wall": ("--line-width",),
    "--wall-thickness": ("--wall", "--line-width"),
    "--line": ("--line-width",),
    "--width": ("--line-width", "--size"),
    "--infill": ("--density",),
    "--infill-density": ("--density",),
    "--fill-density": ("--density",),
    "--infill-pattern": ("--pattern",),
    "--fill-pattern": ("--pattern",),
    "--seed": ("--set seed=N",),
    "--angle": ("--set angle=DEGREES",),
    "--output": ("-o",),
}


def _find_missing_input(context: typer.Context) -> Path | None:
    """Find an input file that does not exist: a message about it comes before any about the outputs."""
    arguments = [option.name for option in context.command.params if option.param_type_name == "argument"]
    values = [context.params.get(str(name)) for name in arguments]
    paths = [path for value in values for path in (value if isinstance(value, (list, tuple)) else [value])]
    # A URL, or a dataset in a file, is not a path.
    files = (path for path in paths if isinstance(path, Path) and ":/" not in str(path))
    return next((path for path in files if not path.exists()), None)


class Group(TyperGroup):
    """The app itself, with the same help and errors as its commands."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401
        """Return the options of the app."""
        return _sort_options(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401
        """Parse the arguments before the command, or end with the usage and exit status 2."""
        if not args:
            return super().parse_args(ctx, args)
        try:
            return super().parse_args(ctx, args)
        except UsageException as error:
            raise usage_exit(ctx, _plain_message(error)) from error

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:  # noqa: ANN401
        """Return the command of a name, or end with the usage and exit status 2 if it does not exist."""
        try:
            return super().resolve_command(ctx, args)
        except UsageException as error:
            raise usage_exit(ctx, _plain_message(error)) from error


def use_typed_options(error: InfillError | PatternError, context: typer.Context) -> str:
    """Return the message of an error with the options that were typed in place of its parameters."""
    return error.spell(lambda name: _typed_option(name, context))


def _typed_option(word: str, context: typer.Context) -> str:
    """Return the option that was typed for an argument of the library, or the word itself."""
    flags = FLAGS_OF_ARGUMENT.get(word, (f"--{word.replace('_', '-')}",))
    for option in context.command.params:
        source = context.get_parameter_source(str(option.name))
        if (
            (option.name == word or set(flags) & set(option.opts))
            and source is not None
            and source.name == "COMMANDLINE"
        ):
            return max(option.opts, key=len)
    return word


def _plain_message(error: Any) -> str:  # noqa: ANN401 - a usage error of typer's
    """Return a message of typer without its empty words."""
    message: str = error.format_message()
    option = getattr(error, "option_name", None)  # of an option that the command does not have
    if option in OTHER_OPTIONS and error.ctx is not None:
        flags = {flag for known in error.ctx.command.params for flag in known.opts}
        meant = next((words for words in OTHER_OPTIONS[option] if words.split()[0] in flags), None)
        message = f"No such option: {option}; did you mean {meant}?" if meant else message
    return message.removeprefix("Invalid value: ").replace("Value error, ", "")


def usage_exit(context: typer.Context, message: str) -> typer.Exit:
    """Print the usage and an error of the command line; return the exit."""
    say(context.get_usage())
    say(f"Try '{context.command_path} --help' for help.")
    say(f"error: {message}")
    return typer.Exit(USAGE)


def _sort_options(params: list[Any]) -> list[Any]:
    """Sort parameters of the panel "Advanced" to the end, and hide the types of flags and arguments."""
    for option in params:
        if option.param_type_name == "argument":
            option.display_type_rich = lambda ctx: None  # noqa: ARG005 - the signature of typer's
        if getattr(option, "is_flag", False) and option.metavar is None:
            option.metavar = ""
    return sorted(params, key=lambda option: getattr(option, "rich_help_panel", None) == ADVANCED)
