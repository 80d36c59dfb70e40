"""Statistics of a refill: sums over the batches of a print."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats, Places
from infill.paths.contact import Contact
from infill.refilling.even_layers import LayerSteps
from infill.refilling.layers import LayerPaths, Layers

if TYPE_CHECKING:
    from infill.reports.refilling import RadiusKeys


PURGED, UNREAD = "purged filament", "no plain moves"  # reasons for a section without strokes
NO_CORNER = "no corner to round"
LEAST_RADIUS = 0.02  # mm: smaller arcs, at corners beside walls, do not count


@dataclass(kw_only=True)
class Histogram:
    """Histogram of lengths, by tenths of an octave from a micrometre to a metre, of constant size."""

    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(200, dtype=np.int64))

    def add(self, lengths: Floats) -> None:
        """Count some lengths, mm."""
        place = np.clip(10 * np.log2(np.maximum(lengths, 1e-3) / 1e-3), 0, len(self.counts) - 1)
        self.counts += np.bincount(place.astype(np.intp), minlength=len(self.counts))

    def __add__(self, other: Histogram) -> Histogram:
        return Histogram(counts=self.counts + other.counts)

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
class NewInfill:
    """Infill of some layers after their refill.

    Parameters
    ----------
    text : bytes
        Of the layers.
    paths : LayerPaths
        All infill.
    changed : (M,) bool
        The old strokes that were replaced.
    kept : mapping of str to array of int
        Sections that keep their paths, by reason; of several reasons, the first counts.
    amounts : InfillAmounts
        Of the new paths.
    lines, increase : (K,) int and (K,) float64, mm
        Lines of the old text, and the increase of filament from there on.
    widened : float
        Further mm of filament that the new paths would take with the beads of ``--density same``.
    radii : (C,) float64, mm
        Of their arcs; 0 or infinite at corners without an arc.
    drawn : mapping of int to (3,) float64
        Of the new paths by layer: mm of filament at the slicer's filament per mm, mm of filament, and seconds.
    """

    text: bytes
    paths: LayerPaths
    changed: Flags
    kept: Mapping[str, Places]
    amounts: InfillAmounts = field(default_factory=InfillAmounts)
    lines: Places = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    increase: Floats = field(default_factory=lambda: np.empty(0))
    widened: float = 0.0
    radii: Floats = field(default_factory=lambda: np.empty(0))
    drawn: Mapping[int, Floats] = field(default_factory=dict)

    @classmethod
    def unchanged(cls, layers: Layers, kept: Mapping[str, Places]) -> NewInfill:
        """Return the infill of layers that keep their paths."""
        changed = np.zeros(len(layers.infill), dtype=bool)
        return cls(text=layers.table.data, paths=layers.paths, changed=changed, kept=kept)


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
    """Statistics of the layers so far.

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
    objects : dict of str to int
        Names of the objects of the print, as keys.
    drawn : dict of int to (3,) float64
        As in `NewInfill`.
    steps : LayerSteps
        Between layers that were evened out.
    placed_error : float
        Relative error of the filament of a pattern that follows the print, against the requested amount.
    densities : tuple of float
        The lowest and the highest one of each print in which a density is averaged over layers.
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
    objects: dict[str, int] = field(default_factory=dict)
    drawn: dict[int, Floats] = field(default_factory=dict)
    steps: LayerSteps = field(default_factory=LayerSteps)
    placed_error: float = 0.0
    densities: tuple[float, ...] = ()

    @property
    def filament_error(self) -> float:
        """Relative change of the filament of the infill."""
        return self.infill_ratio - 1

    @property
    def infill_ratio(self) -> float:
        """Filament of the infill, after over before."""
        return self.infill_after.filament / self.infill.filament if self.infill.filament else 1.0

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

    def add(self, part: RefillStats) -> None:
        """Add the statistics of some layers, or of another print."""
        for name, value in vars(part).items():
            total = getattr(self, name)
            if isinstance(value, dict):
                for key, amount in value.items():
                    total[key] = total.get(key, 0) + amount
            else:
                setattr(self, name, total or value if name == "first_unread" else total + value)

    def count_millimetres(self, sections: Sequence[float]) -> None:
        """Count filament in mm, where the print counts it in mm³.

        Parameters
        ----------
        sections : sequence of float
            Of the filaments by tool, mm²; further tools have the last one.
        """

        def filament_section(tool: int) -> float:
            """Return the cross-section of the filament of a tool, mm²."""
            return sections[min(tool, len(sections) - 1)]

        volume = sum(self.filament.values())
        for amounts in (self.filament, self.change):
            amounts.update({tool: value / filament_section(tool) for tool, value in amounts.items()})
        length = sum(self.filament.values())
        usual = volume / length if length > 0 and volume > 0 else filament_section(0)
        self.infill = replace(self.infill, filament=self.infill.filament / usual)
        self.infill_after = replace(self.infill_after, filament=self.infill_after.filament / usual)
        self.widened /= usual


def count_refill(layers: Layers, new: NewInfill, seconds: Floats) -> RefillStats:
    """Count the infill of some layers before and after their refill, and the sections of each kind.

    Parameters
    ----------
    layers : Layers
    new : NewInfill
    seconds : (M,) float64
        Times of the old strokes.
    """
    infill = layers.infill

    def amounts(chosen: Flags) -> InfillAmounts:
        return InfillAmounts(
            seconds=float(seconds[chosen].sum()),
            length=float(infill.length[chosen].sum()),
            filament=float(infill.filament[chosen].sum()),
        )

    after = amounts(~new.changed) + new.amounts
    arcs = new.radii[(new.radii > LEAST_RADIUS) & np.isfinite(new.radii)]
    stats = RefillStats(
        layers=layers.marks.layers,
        sections=len(infill.sections),
        infill=amounts(np.ones(len(infill), dtype=bool)),
        infill_after=after,
        widened=after.filament + new.widened,
        filament=_sum_by_tool(layers.tools, layers.table.extruded),
        change=_sum_by_tool(layers.tools[new.lines], new.increase),
        corners=len(arcs),
        objects=dict.fromkeys(layers.marks.names.values(), 1),
        drawn=dict(new.drawn),
    )
    stats.radii.add(arcs)
    replaced = np.unique(layers.section[new.changed])
    stats.replaced = len(replaced)
    remaining = np.setdiff1d(infill.sections, replaced)
    unread = np.setdiff1d(remaining, layers.section)
    purged = np.intersect1d(unread, infill.purged_sections)
    for reason, sections in {PURGED: purged, UNREAD: unread, **new.kept, NO_CORNER: remaining}.items():
        stats.keep(reason, len(np.intersect1d(remaining, sections)))
        remaining = np.setdiff1d(remaining, sections)
    return stats


def _sum_by_tool(tools: Places, filament: Floats) -> dict[int, float]:
    """Sum up filament by tool."""
    return {tool: float(filament[tools == tool].sum()) for tool in np.unique(tools).tolist()}
