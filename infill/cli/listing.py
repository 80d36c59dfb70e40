"""``infill list``: the patterns and what each is for, or one of them with its parameters and a picture."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from infill.cli.completing import fill_pattern_names
from infill.cli.console import can_show, format_table, print_json, progress_bar, say

if TYPE_CHECKING:
    from infill.reports.checking import PatternKeys, PatternList
    from patterns import Pattern
    from patterns.registry import PatternClass

CUBE = (18.0, 18.0, 18.0)  # mm, of the picture of a pattern in space
# The options of a pattern in space that decide its sizes, of make and of fill.
SIZES = {
    "--density": "solid share, 20% by default",
    "--line-width": "width of walls or bars, 0.45 mm by default",
    "--cell": "period of the pattern; of the three, the one left out follows from the others",
}
BRAILLE_BLANK = "\N{BRAILLE PATTERN BLANK}"


def list_patterns(
    pattern: Annotated[
        str | None,
        typer.Argument(
            metavar="PATTERN",
            help="Show this one, with its parameters and a picture; also one of yours: module.py:name.",
            autocompletion=fill_pattern_names,
        ),
    ] = None,
    preview: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Picture to write of the pattern: in its default block, or in space in a cube cut open; a .png.",
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """List the patterns and what each is for, or show one of them."""
    from patterns import PATTERNS, Cells

    if pattern is None and preview is not None:
        raise typer.BadParameter("a preview shows a single pattern; name one")
    pattern = None if pattern is None else PATTERNS.spelled(pattern)
    shown: Mapping[str, PatternClass] = PATTERNS if pattern is None else {pattern: _find_class(pattern)}
    kinds = {name: kind for name, kind in shown.items() if kind.prismatic and not issubclass(kind, Cells)}
    in_space = {name: kind.summary for name, kind in shown.items() if name not in kinds}
    if preview is not None:
        _write_preview(str(pattern), shown[str(pattern)], preview, overwrite=force)
    if pattern in in_space:
        _show_in_space(str(pattern), shown[str(pattern)], as_json=as_json)
        return
    if as_json:
        listed: PatternList = {"patterns": {name: _facts(kind) for name, kind in kinds.items()}}
        if pattern is None:
            listed["in_space"] = in_space
        print_json(listed)
    elif pattern is None:
        typer.echo(format_table({name: kind.summary for name, kind in kinds.items()}))
        typer.echo("'infill list PATTERN' shows one, with its parameters and a picture.")
        typer.echo(format_table(in_space, title="\nin space:"))
    else:
        typer.echo(_pattern_text(kinds[pattern]))


def _find_class(name: str) -> PatternClass:
    """Return the class of a pattern: a registered one, or a class in a module of the user's.

    Raises
    ------
    ParameterError, PatternError, FormatError
        If there is no such pattern, or the module has a function or an instance in place of a class.
    """
    from infill.errors import ParameterError
    from infill.options.modules import load_object, names_code
    from infill.options.resolve_pattern import refuse_file
    from patterns import PATTERNS, lacking

    if name in PATTERNS or not names_code(name):
        refuse_file(name)
        return PATTERNS.find(name)
    found = load_object(name)
    if not isinstance(found, type) or lacking(found):
        raise ParameterError(
            f"{name} is not a class of patterns, and list shows classes alone; infill make takes functions too"
        )
    kind: PatternClass = found
    return kind


def _show_in_space(name: str, kind: PatternClass, *, as_json: bool) -> None:
    """Print the purpose of a pattern in space, and its parameters unless as JSON."""
    if as_json:
        listed: PatternList = {"patterns": {}, "in_space": {name: kind.summary}}
        print_json(listed)
    else:
        place = "follows the part" if not getattr(kind, "repeats", True) else "repeats in space"
        rows = {**SIZES, **_parameter_rows(kind, own=True)}
        typer.echo(format_table(rows, title=f"{name}: {kind.summary}\n  {place}\n"))
        drawn = f"'infill list {name} --preview {kind.name}.png' draws it"
        typer.echo(f"\n{drawn}, 'infill make {name}' makes a block of it.")


def _write_preview(name: str, kind: PatternClass, path: Path, *, overwrite: bool) -> None:
    """Draw a pattern with its defaults into a picture file: its lines, or in space, a cube of it cut open."""
    from infill.files.whole_files import check_targets, write_all_files
    from infill.pictures.drawing import write_drawing
    from infill.pictures.picture_files import check_preview
    from patterns import Cells

    check_targets([check_preview(path)], overwrite=overwrite)
    if kind.prismatic and not issubclass(kind, Cells):
        write_all_files({path: partial(write_drawing, kind())})
    else:
        from infill.making.block import make

        with progress_bar(shown=True) as progress:
            block = make(name, size=CUBE, progress=progress)
            write_all_files({path: block.write_picture})
    say(f"wrote {path}")


def _facts(kind: type[Pattern]) -> PatternKeys:
    """Return the summary of a pattern, its descriptions, and its parameters, angles in degrees."""
    from infill.reports.checking import ParameterKeys
    from infill.reports.common import declare
    from patterns import gives
    from patterns.given import describe_parameters

    return {
        "summary": kind.summary,
        "prismatic": kind.prismatic,
        "gives": list(gives(kind)),
        "options": {name: declare(ParameterKeys, keys) for name, keys in describe_parameters(kind).items()},
    }


def _pattern_text(kind: type[Pattern]) -> str:
    """Format a pattern for the terminal: its summary, its parameters, a picture."""
    from infill.pictures.drawing import draw_text
    from patterns import gives

    heights = "the same at every height" if kind.prismatic else "changing with height"
    title = f"{kind.name}: {kind.summary}\n  {' and '.join(gives(kind))}, {heights}\n"
    drawing = draw_text(kind(), braille=can_show(BRAILLE_BLANK))
    table = format_table(_parameter_rows(kind), title=title)
    return f"{table}\n\n{drawing}"


def _parameter_rows(kind: type[Any], *, own: bool = False) -> dict[str, str]:
    """Return rows of a table of the parameters of a pattern, or only of those it does not share."""
    from patterns import parameters
    from patterns.declared import describe_values
    from patterns.given import default_text
    from patterns.shared import SHARED

    shown_parameters = {name: parameter for name, parameter in parameters(kind).items() if not (own and name in SHARED)}
    flags = {name: name.replace("_", "-") for name in shown_parameters}
    words = {name: f"--{flag}" if name in SHARED else f"--set {flag}" for name, flag in flags.items()}
    indent = " " * (max(map(len, [*words.values(), *(SIZES if own else [])]), default=0) + 4)
    return {
        words[name]: f"{described.help}\n{indent}{default_text(shown_parameters[name])}; "
        + describe_values(field.default, described)
        for name, (field, described) in shown_parameters.items()
    }
