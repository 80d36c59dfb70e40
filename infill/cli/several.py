"""Several files to a command: it does its work for one after another, and what fails is listed at the end.

``infill smooth scans/*.nrrd -o out`` names its results after its inputs. A shell expands the star; where none does, as
on Windows, it is expanded here.
"""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import typer

from infill.cli.commands import FAILED, USAGE, Command, UsageException, usage_exit
from infill.cli.console import say
from infill.cli.piping import is_piped
from infill.errors import InfillError
from infill.files.whole_files import wrap_os_errors
from infill.plain_numbers import count_noun
from patterns.errors import PatternError

NAME, FOLDER = "{name}", "{folder}"  # the placeholders in names of outputs: of the input, without its suffix
NAMED = ("output", "preview")  # the parameters that name an output of every file
ONCE = "save_config"  # the one that is the same for all of them


class FileCommand(Command):
    """A command whose argument is a file, or several."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: ANN401 - typer's own class
        """Read the arguments, of which further files stay in the context."""
        ctx.allow_extra_args = True
        return super().parse_args(ctx, args)

    def invoke(self, ctx: Any) -> Any:  # noqa: ANN401
        """Run the command for every file; end with exit status 1 if one of them failed."""
        (argument,) = (option.name for option in self.params if option.param_type_name == "argument")
        files = expand_files([str(ctx.params[argument]), *ctx.args])
        given = dict(ctx.params)
        if len(files) == 1 and not _has_placeholder(given):
            ctx.params[argument] = files[0]
            return super().invoke(ctx)
        failures: dict[Path, str] = {}
        try:
            runs = name_outputs(files, given, _default_suffix(ctx))
        except UsageException as error:
            raise usage_exit(ctx, str(error)) from error
        for file, outputs in runs:
            ctx.params = {**given, argument: file, **outputs}
            try:
                with _new_folders(outputs):
                    self.run(ctx)
            except (InfillError, PatternError, MemoryError) as error:
                failures[file] = self.explain(ctx, error)
                say(f"error: {failures[file]}")
            except typer.Exit as end:
                if end.exit_code == USAGE:
                    raise
                if end.exit_code:
                    failures[file] = f"exit status {end.exit_code}"
        if failures:
            say(f"{len(failures)} of {count_noun(len(files), 'file')} failed:")
            for file, reason in failures.items():
                say(f"  {reason}" if str(file) in reason else f"  {file}: {reason}")
            raise typer.Exit(FAILED)
        return None


@contextlib.contextmanager
def _new_folders(outputs: Mapping[str, Any]) -> Iterator[None]:
    """Make the folders of outputs; those that are still empty at the end go again."""
    paths = [path for key in NAMED for path in _as_list(outputs.get(key)) if not is_piped(path)]
    folders = {folder for path in paths for folder in path.parents if not folder.exists()}
    made = sorted(folders, key=lambda folder: len(folder.parts))
    for folder in made:
        with wrap_os_errors(folder):
            folder.mkdir()
    try:
        yield
    finally:
        for folder in made[::-1]:
            with contextlib.suppress(OSError):
                folder.rmdir()


def expand_files(words: Sequence[str]) -> list[Path]:
    """Return the files that words name: each once, and those that match a word with a star.

    >>> [path.name for path in expand_files(["a.stl", "b.stl", "a.stl"])]
    ['a.stl', 'b.stl']
    """
    files: dict[Path, None] = {}
    for word in words:
        is_pattern = any(letter in word for letter in "*?") and not Path(word).exists()
        path = Path(word)
        files |= dict.fromkeys((sorted(path.parent.glob(path.name)) if is_pattern else []) or [path])
    return list(files)


def name_outputs(
    files: Sequence[Path], given: Mapping[str, Any], suffix: str | None
) -> list[tuple[Path, dict[str, Any]]]:
    """Return every file with the parameters that name its outputs.

    Parameters
    ----------
    files : sequence of Path
    given : mapping
        The parameters of the command. An output is a folder, or has a placeholder.
    suffix : str, optional
        Of a result in a folder; by default that of the input.

    Raises
    ------
    BadParameter
        If two files would be written to one.
    """
    named = {key: given[key] for key in NAMED if given.get(key) is not None}
    runs: list[tuple[Path, dict[str, Any]]] = []
    for number, file in enumerate(files):
        outputs: dict[str, Any] = {
            key: [_output_of(file, path, suffix) for path in value]
            if isinstance(value, (list, tuple))
            else _output_of(file, value, ".png" if key == "preview" else suffix)
            for key, value in named.items()
        }
        if number and ONCE in given:
            outputs[ONCE] = None
        runs.append((file, outputs))
    written = [path for _, outputs in runs for value in outputs.values() for path in _as_list(value)]
    shared = next((path for path, count in Counter(written).items() if count > 1), None)
    if shared is not None:
        raise typer.BadParameter(
            f"{count_noun(len(files), 'file')} would write to {shared}; name a folder, or a file with {NAME}, or with "
            f"{FOLDER}/{NAME} for the folder of each"
        )
    return runs


def _as_list(value: Any) -> list[Any]:  # noqa: ANN401 - one path, several or none
    return list(value) if isinstance(value, (list, tuple)) else [] if value is None else [value]


def _has_placeholder(given: Mapping[str, Any]) -> bool:
    return any(NAME in str(path) or FOLDER in str(path) for key in NAMED for path in _as_list(given.get(key)))


def _output_of(file: Path, output: Path, suffix: str | None) -> Path:
    """Return the output of a file: in a folder, or with its name in the place of the placeholder."""
    stem = Path(file.name.removesuffix(".gz")).stem
    if NAME in str(output) or FOLDER in str(output):
        return Path(str(output).replace(FOLDER, str(file.parent)).replace(NAME, stem))
    if is_piped(output) or (output.suffix and not output.is_dir()):
        return output
    return output / (file.name if suffix is None else f"{stem}{suffix}")


def _default_suffix(ctx: Any) -> str | None:  # noqa: ANN401
    """Return the suffix of results in a folder: a project's, a mesh's, or None for that of the input."""
    if ctx.command.name == "refill":
        return None
    return ".3mf" if ctx.params.get("slicer") or ctx.params.get("form") == "project" else ".stl"
