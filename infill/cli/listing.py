"""``infill list``: the patterns, what each is for, and its options."""

from __future__ import annotations

import math
from typing import Annotated, Any

import typer

from infill.cli.console import print_json, reports_errors, table
from patterns import PATTERNS, Pattern, parameters


@reports_errors
def list_patterns(
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object to stdout.")] = False,
) -> None:
    """List the patterns, what each is for, and its options."""
    described = {name: _described(kind) for name, kind in PATTERNS.items()}
    if as_json:
        print_json({"patterns": described})
        return
    rows = {}
    for name, facts in described.items():
        options = ", ".join(f"--{option.replace('_', '-')}" for option in facts["options"])
        rows[name] = f"{facts['summary']}\n{'':{max(map(len, described)) + 4}}{options}"
    typer.echo(table(rows))


def _described(kind: type[Pattern]) -> dict[str, Any]:
    """Return what a pattern is for and its options, angles in degrees."""
    options = {}
    for name, (field, each) in parameters(kind).items():
        turn = math.degrees if each.unit == "rad" else lambda value: value
        limits = {end: turn(value) for end, value in (("low", each.low), ("high", each.high)) if math.isfinite(value)}
        default = turn(field.default) if isinstance(field.default, float) else field.default
        unit = "degrees" if each.unit == "rad" else each.unit
        options[name] = {"help": each.help, "unit": unit, "default": default, **limits}
    return {"summary": kind.summary, "prismatic": kind.prismatic, "options": options}
