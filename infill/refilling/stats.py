"""Statistics of a refill: sums over the batches of a print."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.paths.contact import Contact

if TYPE_CHECKING:
    from infill.reports.refilling import RadiusKeys

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LEAST_RADIUS = 0.02  # mm: smaller arcs, at corners beside walls, do not count


@dataclass(kw_only=True)
class Histogram:
    """Histogram of lengths, by tenths of an octave from a micrometre to a metre, of constant size."""

    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(200, dtype=np.int64))

    def add(self, lengths: Floats) -> None:
        """Count some lengths, mm."""
        place = np.clip(10 * np.log2(np.maximum(lengths, 1e-3) / 1e-3), 0, len(self.counts) - 1)
        self.counts += np.bincount(place.astype(np.intp), minlength=len(self.counts))

    def report(self) -> RadiusKeys | None:
        """Return the 1, 50 and 99 % quantiles of the lengths, to a fifteenth, mm."""
        total = np.cumsum(self.counts)
        if not total[-1]:
            return None
        places = np.searchsorted(total, np.array([0.01, 0.5, 0.99]) * total[-1])
        smallest, median, largest = (round(float(1e-3 * 2 ** ((place + 0.5) / 10)), 4) for place in places)
        return {"smallest_hundredth": smallest, "median": median, "largest_hundredth": largest}


@dataclass(frozen=True, kw_only=True)
class InfillAmounts:
    """Amounts that some infill takes.

    Parameters
    ----------
    seconds : float
    length, filament : float, mm
    """

    seconds: float = 0.0
    length: float = 0.0
    filament: float = 0.0

    def __add__(self, other: InfillAmounts) -> InfillAmounts:
        return InfillAmounts(
            seconds=self.seconds + other.seconds,
            length=self.length + other.length,
            filament=self.filament + other.filament,
        )


@dataclass(frozen=True, kw_only=True)
class PrintAmounts:
    """Amounts that an entire print takes.

    Parameters
    ----------
    seconds, infill_seconds : float
        As `infill motion` plans them.
    filament : float
        mm
    grams : float or None
        None if the print states neither grams nor a density.
    """

    seconds: float = 0.0
    infill_seconds: float = 0.0
    filament: float = 0.0
    grams: float | None = 0.0

    def __add__(self, other: PrintAmounts) -> PrintAmounts:
        return PrintAmounts(
            seconds=self.seconds + other.seconds,
            infill_seconds=self.infill_seconds + other.infill_seconds,
            filament=self.filament + other.filament,
            grams=None if self.grams is None or other.grams is None else self.grams + other.grams,
        )


@dataclass(kw_only=True)
class RefillStats:
    """Statistics up to the current batch.

    Parameters
    ----------
    layers, sections, replaced : int
        Read, with infill, and refilled.
    kept : dict of str to int
        Sections that stay as they were, by reason.
    infill, infill_after : InfillAmounts
        Before and after.
    widened : float
        mm of filament that the infill would take with the beads of ``--density same``.
    filament, change : dict of int to float
        By tool, mm: amount for the entire print before, and its increase.
    corners : int
    radii : Histogram
        Of the arcs.
    lines : list of (place, line)
        Lines that state time or filament, and their places in the draft.
    before, after : Contact
        Support and contact of the infill.
    print_before, print_after : PrintAmounts
        Before and after.
    slicer_seconds : float
        Time that the print stated; 0 without one.
    unread, first_unread : int
        Lines that may move or extrude and are not understood, and the number of the first in its print.
    """

    layers: int = 0
    sections: int = 0
    replaced: int = 0
    kept: dict[str, int] = field(default_factory=dict)
    infill: InfillAmounts = field(default_factory=InfillAmounts)
    infill_after: InfillAmounts = field(default_factory=InfillAmounts)
    widened: float = 0.0
    filament: dict[int, float] = field(default_factory=dict)
    change: dict[int, float] = field(default_factory=dict)
    corners: int = 0
    radii: Histogram = field(default_factory=Histogram)
    lines: list[tuple[int, bytes]] = field(default_factory=list)
    before: Contact = field(default_factory=Contact)
    after: Contact = field(default_factory=Contact)
    print_before: PrintAmounts = field(default_factory=PrintAmounts)
    print_after: PrintAmounts = field(default_factory=PrintAmounts)
    slicer_seconds: float = 0.0
    unread: int = 0
    first_unread: int = 0

    @property
    def filament_ratio(self) -> float:
        """Filament of the entire print, after over before."""
        total = sum(self.filament.values())
        return 1 + sum(self.change.values()) / total if total > 0 else 1.0

    @property
    def tool_ratios(self) -> tuple[float, ...]:
        """The same by tool."""
        tools = range(max(self.filament, default=-1) + 1)
        return tuple(
            1 + self.change.get(tool, 0.0) / self.filament[tool] if self.filament.get(tool, 0.0) > 0 else 1.0
            for tool in tools
        )

    def keep(self, reason: str, sections: int) -> None:
        """Count sections that stay as they were."""
        if sections:
            self.kept[reason] = self.kept.get(reason, 0) + sections

    def round(self, radius: Floats) -> None:
        """Count corners by the radii of their arcs, mm; those without an arc have 0 or none."""
        arcs = radius[(radius > LEAST_RADIUS) & np.isfinite(radius)]
        self.corners += len(arcs)
        self.radii.add(arcs)

    def use(self, tools: Places, filament: Floats) -> None:
        """Add the filament of the old print, mm, by tool."""
        _add(self.filament, tools, filament)

    def save(self, tools: Places, before: Floats, after: Floats) -> None:
        """Add the change of the filament of sections, mm, by tool."""
        _add(self.change, tools, after - before)

    def add(self, part: RefillStats) -> None:
        """Add the statistics of a batch, or of another print."""
        self.layers += part.layers
        self.sections += part.sections
        self.replaced += part.replaced
        for reason, sections in part.kept.items():
            self.keep(reason, sections)
        self.infill += part.infill
        self.infill_after += part.infill_after
        self.widened += part.widened
        for sums, increments in ((self.filament, part.filament), (self.change, part.change)):
            for tool, filament in increments.items():
                sums[tool] = sums.get(tool, 0.0) + filament
        self.corners += part.corners
        self.radii.counts += part.radii.counts
        self.lines += part.lines
        self.before += part.before
        self.after += part.after
        self.print_before += part.print_before
        self.print_after += part.print_after
        self.slicer_seconds += part.slicer_seconds
        self.unread += part.unread
        self.first_unread = self.first_unread or part.first_unread

    def count_millimetres(self, sections: Sequence[float]) -> None:
        """Count filament in mm, where the print counts it in mm³.

        Parameters
        ----------
        sections : sequence of float
            Of the filaments by tool, mm²; further tools have the last one.
        """

        def section(tool: int) -> float:
            return sections[min(tool, len(sections) - 1)]

        volume = sum(self.filament.values())
        for amounts in (self.filament, self.change):
            amounts.update({tool: value / section(tool) for tool, value in amounts.items()})
        length = sum(self.filament.values())
        usual = volume / length if length > 0 and volume > 0 else section(0)
        self.infill = replace(self.infill, filament=self.infill.filament / usual)
        self.infill_after = replace(self.infill_after, filament=self.infill_after.filament / usual)
        self.widened /= usual


def _add(sums: dict[int, float], tools: Places, values: Floats) -> None:
    """Add values to the sums of their tools."""
    for tool in np.unique(tools).tolist():
        sums[tool] = sums.get(tool, 0.0) + float(values[tools == tool].sum())
