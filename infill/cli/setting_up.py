"""``infill setup``: the line that makes a slicer run ``infill refill``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from infill.checks import choose_word
from infill.cli.commands import use_typed_options
from infill.cli.completing import profiled_slicer_names
from infill.cli.console import format_table, print_json, say
from infill.errors import InfillError
from infill.files.excerpts import quote_value
from infill.plain_numbers import count_noun
from patterns.errors import PatternError

if TYPE_CHECKING:
    from infill.reports.profiles import ProfileKeys, SetupReport
    from infill.slicer_profiles.setting_up import SetupAction


def setup(
    slicer: Annotated[
        str,
        typer.Argument(
            metavar="SLICER",
            help="prusaslicer, superslicer, orcaslicer, bambustudio or cura.",
            autocompletion=profiled_slicer_names,
        ),
    ],
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="OPTION", help="Options of infill refill for the line; put -- before them."),
    ] = None,
    write: Annotated[bool, typer.Option("--write", help="Write the line into your print profiles.")] = False,
    remove: Annotated[bool, typer.Option("--remove", help="Remove it from them.")] = False,
    profile: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Only this print profile; may be given again. (default: all of your own)"),
    ] = None,
    folder: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Configuration folder of the slicer. (default: all in their usual places)"),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Write although the slicer seems to be running.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """Show the line that makes a slicer refill every export, and your print profiles; write nothing unless told to."""
    if write and remove:
        raise typer.BadParameter("--write and --remove exclude each other")
    from infill.slicer_profiles.desktops import PROFILED_SLICERS
    from infill.slicer_profiles.setting_up import SetupMeans, SetupRequest, set_up_slicer

    chosen = next((name for name in PROFILED_SLICERS if name == choose_word(slicer, PROFILED_SLICERS)), None)
    if chosen is None:
        *names, last = PROFILED_SLICERS
        raise typer.BadParameter(f"SLICER is {quote_value(slicer)}; choose {', '.join(names)} or {last}")
    _check_words(words or [])

    action: SetupAction = "write" if write else "remove" if remove else "look"
    request = SetupRequest(
        slicer=chosen,
        action=action,
        words=tuple(words or ()),
        profiles=tuple(profile or ()),
        folder=folder,
        force=force,
    )
    report = set_up_slicer(request, SetupMeans.current())
    if as_json:
        print_json(report)
        return
    typer.echo(_setup_table(report, request.title))
    for note in report["notes"]:
        say(f"note: {note}")
    if action == "look" and any(state["state"] != "present" for state in report["profiles"]):
        typer.echo(f"Nothing was written. 'infill setup {chosen} --write' writes it, and --remove removes it.")
    elif action != "look":
        changed = sum(state["changed"] for state in report["profiles"])
        typer.echo(f"changed {count_noun(changed, 'file')}")


def _check_words(words: list[str]) -> None:
    """Parse words as those of ``infill refill``; end with its usage and exit status 2 if it rejects them."""
    if not words:
        return
    from infill.cli.app import build_app
    from infill.options.declaration import declared_options
    from infill.refilling.placement import resolve_paths
    from infill.refilling.request import KEEP, Request
    from infill.refilling.settings import resolve

    group: Any = typer.main.get_command(build_app("refill"))
    command = group.commands["refill"]
    with command.make_context("infill refill", ["print.gcode", *words]) as context:
        if context.args or context.params.get("output") is not None:
            raise typer.BadParameter("the slicer names the file; leave files and -o out of the words for refill")
        typed = {key: context.params[entry.field] for key, entry in declared_options(Request).items()}
        try:
            if context.params["pattern"] not in (None, KEEP):
                resolve_paths(context.params["pattern"], {})
            resolve(typed, context.params["config"], context.params["assigned"] or [], trust=context.params["trust"])
        except (InfillError, PatternError) as error:
            raise typer.BadParameter(use_typed_options(error, context)) from error


def _setup_table(report: SetupReport, title: str) -> str:
    """Format the line, the folders and the profiles as a table."""
    rows = {"program" if report["slicer"] == "cura" else "line": report["line"]}
    for number, folder in enumerate(report["folders"], 1):
        rows[f"folder {number}"] = folder["folder"]
        if folder["line"] != report["line"]:
            rows[f"its line {number}"] = folder["line"]
    for number, state in enumerate(report["profiles"], 1):
        rows[f"profile {number}"] = f"{state['name']}: {_state_text(state)}"
    return format_table(rows, title=title)


def _state_text(state: ProfileKeys) -> str:
    """Describe the state of a profile."""
    if state["problem"]:
        return f"unreadable, {state['problem']}"
    scripts = [] if state["state"] == "present" else state["scripts"]
    texts = {"present": "has it", "other": "has another", "absent": "does not have it"}
    return "; ".join([texts[state["state"]] + (", changed" if state["changed"] else ""), *scripts])
