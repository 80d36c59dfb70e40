"""``infill verify``: whether a post-processor changed what it must not change."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from infill.cli.commands import FAILED
from infill.cli.common import RUN, Quiet
from infill.cli.console import format_table, print_json, say
from infill.cli.declared import takes_options
from infill.options.declaration import by_field, read_options
from infill.plain_numbers import count_noun, plain_clock
from infill.verifying.settings import VerifyRequest

if TYPE_CHECKING:
    from infill.reports.verifying import VerifyReport
    from infill.verifying.violations import Violation

MOST_SHOWN = 10  # violations of a kind that are printed
LEAST_SHOWN = 0.05  # s and mm by which a feature must change to be named


@takes_options(VerifyRequest)
def verify(
    old: Annotated[
        Path,
        typer.Argument(
            metavar="OLD.gcode", help="The print that the post-processor read: .gcode, .bgcode or .gcode.3mf."
        ),
    ],
    new: Annotated[Path, typer.Argument(metavar="NEW.gcode", help="The print that it wrote.")],
    *,
    typed: dict[str, Any],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object to stdout.", rich_help_panel=RUN)
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Compare a post-processed print with the one before; one line for each violation, and exit status 1."""
    from infill.verifying.job import verify as compare

    result = compare(old, new, **by_field(VerifyRequest, read_options("verify", VerifyRequest, typed)))
    if as_json:
        print_json(result.report)
    else:
        for line in list_violations(result.violations):
            typer.echo(line)
    if not quiet:
        say(_summary(result.report, str(new)))
    if not result.agrees:
        raise typer.Exit(FAILED)


def list_violations(violations: tuple[Violation, ...]) -> list[str]:
    """Return a line for each violation, the first ten of a kind, and one for the rest of each kind."""
    shown: Counter[str] = Counter()
    lines = []
    for violation in violations:
        shown[violation.kind] += 1
        if shown[violation.kind] <= MOST_SHOWN:
            lines.append(str(violation))
    rest = {kind: count - MOST_SHOWN for kind, count in shown.items() if count > MOST_SHOWN}
    return lines + [f"and {count_noun(count, 'more violation')} of kind {kind}" for kind, count in rest.items()]


def _summary(report: VerifyReport, name: str) -> str:
    """Return the short table for stderr."""
    compared, old, new = report["compared"], report["old"], report["new"]
    share = compared["agreeing_mm"] / compared["beads_mm"] if compared["beads_mm"] else 0.0
    kinds = ", ".join(f"{count} of {kind}" for kind, count in report["by_kind"].items())
    rows = {
        "violations": f"{report['count']}: {kinds}" if kinds else "none",
        "compared": f"{compared['beads_mm'] / 1000:.2f} m of beads, {share:.1%} in the same place",
    }
    if "material" in report["by_kind"]:
        rows["if it was meant"] = (
            "--allow material takes all amounts of filament; --material-limit 30% those up to 30 % away"
        )
    if report["allowed"]:
        rows["ALLOWED"] = ", ".join(f"{count} of {kind}" for kind, count in report["allowed"].items())
    if compared["not_compared"]:
        rows["NOT COMPARED"] = "; ".join(compared["not_compared"])
    rows["time"] = f"{plain_clock(new['seconds'])}, was {plain_clock(old['seconds'])}"
    rows["filament"] = f"{new['filament_mm'] / 1000:.3f} m, was {old['filament_mm'] / 1000:.3f} m"
    for feature in report["features"]:
        seconds = feature["seconds_after"], feature["seconds_before"]
        filament = feature["filament_after_mm"], feature["filament_before_mm"]
        if abs(seconds[0] - seconds[1]) > LEAST_SHOWN or abs(filament[0] - filament[1]) > LEAST_SHOWN:
            rows[feature["role"]] = (
                f"{plain_clock(seconds[0])}, was {plain_clock(seconds[1])}; "
                f"{filament[0] / 1000:.3f} m, was {filament[1] / 1000:.3f} m"
            )
    return format_table(rows, title=name)
