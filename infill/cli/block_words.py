"""Texts of ``infill make`` for blocks that are filled as a part is: their plan, and their summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from infill.cli.console import format_bytes, format_table, print_json
from infill.cli.filled_words import format_plan
from infill.plain_numbers import count_noun, plain_argument, plain_size

if TYPE_CHECKING:
    from infill.reports.making import LatticePlan, LatticeReport, LatticeRequest


def show_lattice_plan(plan: LatticePlan, *, as_json: bool) -> None:
    """Print the plan of a block: infill, grid and memory."""
    if as_json:
        print_json(plan)
        return
    typer.echo(format_plan(plan, _format_request(plan["request"])))


def lattice_summary(report: LatticeReport, files: list[str], *, verbose: bool) -> str:
    """Format the report of a block as a short table for stderr."""
    request, infill = report["request"], report["infill"]
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}, "
        f"{count_noun(report['components'], 'piece')}",
        "solid": f"{report['volume']:.1f} mm³, {report['density']:.1%} of the block",
        "infill": f"cells of {plain_argument(infill['cell'], 4)} mm, lines of "
        f"{plain_argument(infill['line_width'], 3)} mm",
    }
    if request["frame"]:
        rows["frame"] = f"{plain_argument(request['frame'], 3)} mm wide; {infill['density']:.1%} inside it is solid"
    if report["components"] > 1:
        rows["loose"] = describe_loose(report["components"], "piece")
    if infill["crumbs"]:
        rows["left out"] = f"{count_noun(infill['crumbs'], 'loose piece')}, cut off the pattern by the sides"
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        grid = report["grid"]
        rows["grid"] = f"{' x '.join(map(str, grid['shape']))} cells of {plain_argument(grid['spacing'][0], 4)} mm"
        rows["fillets"] = f"{plain_argument(infill['radius'], 3)} mm"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=_format_request(request))


def describe_loose(count: int, noun: str) -> str:
    """Describe pieces of a block that touch nowhere, several of them."""
    return f"{count:,} {noun}s touch nowhere, and come apart unless something holds them"


def _format_request(request: LatticeRequest) -> str:
    """Return pattern and size of a requested block as text."""
    size = plain_size(*request["size"], request["height"], digits=6, separator="")
    return f"{request['pattern']}, {size}"
