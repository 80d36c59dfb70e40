"""Whether a sliced print is whole: it can be read to its end, and every line that may move is understood."""

from __future__ import annotations

import os
from dataclasses import dataclass

from infill.gcode.ending import describe_missing_end
from infill.plain_numbers import count_noun
from infill.reports.checking import PrintCheckReport


@dataclass(frozen=True, kw_only=True)
class PrintCheck:
    """The verdict on a print.

    The attributes are the keys of `infill.reports.checking.PrintCheckReport`; filament in mm, time in s.
    """

    problems: tuple[str, ...]
    warnings: tuple[str, ...]
    slicer: str
    layers: int
    seconds: float
    filament: float

    @property
    def printable(self) -> bool:
        """Whether there are no problems."""
        return not self.problems

    def to_dict(self) -> PrintCheckReport:
        """Return the verdict as plain values."""
        return {
            "printable": self.printable,
            "problems": self.problems,
            "warnings": self.warnings,
            "slicer": self.slicer,
            "layers": self.layers,
            "seconds": self.seconds,
            "filament": self.filament,
        }


def check_print(path: str | os.PathLike[str]) -> PrintCheck:
    """Check a print: .gcode, .bgcode or .gcode.3mf; of several plates, the first.

    Raises
    ------
    FormatError
        If it cannot be read.
    """
    from infill.timing.printing_time import motion

    plan = motion(path)
    problems = [describe_missing_end(plan.missing_end)] if plan.missing_end else []
    if not plan.length:
        problems.append("no line of it prints anything")
    warnings = [] if plan.layers else ["no layers are marked"]
    if plan.unread_lines:
        warnings.append(
            f"{count_noun(plan.unread_lines, 'line')} that may move or extrude not understood, first line "
            f"{plan.first_unread_line}: {plan.first_unread_text}"
        )
    return PrintCheck(
        problems=tuple(problems),
        warnings=tuple(warnings),
        slicer=plan.slicer,
        layers=plan.layers,
        seconds=plan.seconds,
        filament=plan.filament,
    )
