"""What a refill did so far: sums over the batches of a print."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.paths.contact import Contact

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LEAST_RADIUS = 0.02  # mm: below this a corner beside a wall was hardly touched


@dataclass(kw_only=True)
class Histogram:
    """How often lengths occur, by tenths of an octave from a micrometre to a metre: it does not grow."""

    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(200, dtype=np.int64))

    def add(self, lengths: Floats) -> None:
        """Count some lengths, mm."""
        place = np.clip(10 * np.log2(np.maximum(lengths, 1e-3) / 1e-3), 0, len(self.counts) - 1)
        self.counts += np.bincount(place.astype(np.intp), minlength=len(self.counts))

    def report(self) -> dict[str, float] | None:
        """Return the lengths that 1, 50 and 99 % do not reach, to a fifteenth, mm."""
        total = np.cumsum(self.counts)
        if not total[-1]:
            return None
        places = np.searchsorted(total, np.array([0.01, 0.5, 0.99]) * total[-1])
        return {
            name: round(float(1e-3 * 2 ** ((place + 0.5) / 10)), 4)
            for name, place in zip(("smallest_hundredth", "median", "largest_hundredth"), places, strict=True)
        }


@dataclass(frozen=True, kw_only=True)
class Amounts:
    """What some infill takes.

    Parameters
    ----------
    seconds : float
    length, filament : float, mm
    """

    seconds: float = 0.0
    length: float = 0.0
    filament: float = 0.0

    def __add__(self, other: Amounts) -> Amounts:
        return Amounts(
            seconds=self.seconds + other.seconds,
            length=self.length + other.length,
            filament=self.filament + other.filament,
        )


@dataclass(frozen=True, kw_only=True)
class Whole:
    """What a whole print takes.

    Parameters
    ----------
    seconds, infill_seconds : float
        As `infill motion` plans them.
    filament : float
        mm
    grams : float or None
        None if the print tells neither grams nor a density.
    """

    seconds: float = 0.0
    infill_seconds: float = 0.0
    filament: float = 0.0
    grams: float | None = 0.0

    def __add__(self, other: Whole) -> Whole:
        return Whole(
            seconds=self.seconds + other.seconds,
            infill_seconds=self.infill_seconds + other.infill_seconds,
            filament=self.filament + other.filament,
            grams=None if self.grams is None or other.grams is None else self.grams + other.grams,
        )


@dataclass(kw_only=True)
class Tally:
    """What was done so far.

    Parameters
    ----------
    layers, sections, replaced : int
        Read, with infill, and refilled.
    kept : dict of str to int
        Sections that were left as they were, by reason.
    infill, infill_after : Amounts
        Before and after.
    widened : float
        mm of filament that the infill would take with beads as much wider as ``--density same`` makes them.
    filament, change : dict of int to float
        By tool, mm: of the whole print before, and what it takes more.
    corners : int
    radii : Histogram
        Of the arcs.
    lines : list of (place, line)
        Lines that tell time or filament, and where they stand in the draft.
    before, after : Contact
        What holds the infill up.
    print_before, print_after : Whole
        Before and after.
    slicer_seconds : float
        What the print said of its time; 0 if it said nothing.
    unread, first_unread : int
        Lines that may move or extrude and are not understood, and the number of the first in its print.
    """

    layers: int = 0
    sections: int = 0
    replaced: int = 0
    kept: dict[str, int] = field(default_factory=dict)
    infill: Amounts = field(default_factory=Amounts)
    infill_after: Amounts = field(default_factory=Amounts)
    widened: float = 0.0
    filament: dict[int, float] = field(default_factory=dict)
    change: dict[int, float] = field(default_factory=dict)
    corners: int = 0
    radii: Histogram = field(default_factory=Histogram)
    lines: list[tuple[int, bytes]] = field(default_factory=list)
    before: Contact = field(default_factory=Contact)
    after: Contact = field(default_factory=Contact)
    print_before: Whole = field(default_factory=Whole)
    print_after: Whole = field(default_factory=Whole)
    slicer_seconds: float = 0.0
    unread: int = 0
    first_unread: int = 0

    @property
    def filament_ratio(self) -> float:
        """Filament of the whole print, after over before."""
        whole = sum(self.filament.values())
        return 1 + sum(self.change.values()) / whole if whole > 0 else 1.0

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
        found = radius[(radius > LEAST_RADIUS) & np.isfinite(radius)]
        self.corners += len(found)
        self.radii.add(found)

    def use(self, tools: Places, filament: Floats) -> None:
        """Add what the print took, mm, by tool."""
        _add(self.filament, tools, filament)

    def save(self, tools: Places, before: Floats, after: Floats) -> None:
        """Add what sections took before and take now, mm, by tool."""
        _add(self.change, tools, after - before)

    def add(self, other: Tally) -> None:
        """Add what was done in a batch, or in another print."""
        self.layers += other.layers
        self.sections += other.sections
        self.replaced += other.replaced
        for reason, sections in other.kept.items():
            self.keep(reason, sections)
        self.infill += other.infill
        self.infill_after += other.infill_after
        self.widened += other.widened
        for mine, more in ((self.filament, other.filament), (self.change, other.change)):
            for tool, filament in more.items():
                mine[tool] = mine.get(tool, 0.0) + filament
        self.corners += other.corners
        self.radii.counts += other.radii.counts
        self.lines += other.lines
        self.before += other.before
        self.after += other.after
        self.print_before += other.print_before
        self.print_after += other.print_after
        self.slicer_seconds += other.slicer_seconds
        self.unread += other.unread
        self.first_unread = self.first_unread or other.first_unread

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


def _add(sums: dict[int, float], tools: Places, values: Floats) -> None:
    """Add values to the sums of their tools."""
    for tool in np.unique(tools).tolist():
        sums[tool] = sums.get(tool, 0.0) + float(values[tools == tool].sum())
