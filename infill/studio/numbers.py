"""Numbers that a page shows beside a picture, from the reports of the library."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from infill.studio.catalogue import MATERIALS

if TYPE_CHECKING:
    from infill.lattices.draft import FillDraft

MM3_PER_CM3 = 1000.0


@dataclass(frozen=True, kw_only=True)
class Number:
    """A number with its name and unit.

    Parameters
    ----------
    name : str
    value : float, int, bool, str or None
    unit : str
        "%" for shares, whose value is the share itself.
    help : str
    """

    name: str
    value: float | int | bool | str | None
    unit: str = ""
    help: str = ""

    def facts(self) -> dict[str, Any]:
        """Return the number as plain values."""
        return vars(self)


def grams_by_material(volume: float) -> dict[str, float]:
    """Return what a volume, mm³, weighs in each material, g."""
    return {name: volume / MM3_PER_CM3 * density for name, density in MATERIALS.items()}


def fill_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers of a fill."""
    part, infill, voids, form = report["part"], report["infill"], report["voids"], report["request"]["form"]
    if form == "solid":
        yield Number(
            name="solid share",
            value=report["volume"] / part["volume"],
            unit="%",
            help="Volume of the result over that of the part",
        )
    yield Number(name="density", value=report["density"], unit="%", help="Solid share of the space inside the walls")
    yield Number(name="volume", value=report["volume"], unit="mm³")
    yield Number(name="triangles", value=report["triangles"])
    yield Number(name="cell", value=infill["cell"], unit="mm", help="Period of the pattern")
    yield Number(name="line width", value=infill["line_width"], unit="mm", help="Width of walls, or diameter of bars")
    if form == "solid":
        yield Number(
            name="thinnest shell",
            value=report["walls"]["least"],
            unit="mm",
            help="Least distance of voids from the skin",
        )
        yield Number(name="voids", value=voids["count"])
        yield Number(
            name="voids without a drain",
            value=len(voids["closed"]),
            help="Voids from which resin and powder cannot leave",
        )
        if report["drains"]["count"]:
            yield Number(name="drains", value=report["drains"]["count"])
    yield Number(name="closed", value=report["closed"], help="Whether the mesh encloses its inside without a gap")


def draft_numbers(draft: FillDraft) -> Iterator[Number]:
    """Yield the numbers of a draft of a fill, which are near those of the result."""
    hollow = draft.hollow
    yield Number(
        name="solid share",
        value=draft.volume / draft.part.volume,
        unit="%",
        help="Volume of the result over that of the part",
    )
    yield Number(name="density", value=hollow.density, unit="%", help="Solid share of the space inside the walls")
    yield Number(name="volume", value=draft.volume, unit="mm³")
    yield Number(name="cell", value=hollow.cell, unit="mm", help="Period of the pattern")
    yield Number(name="line width", value=hollow.width, unit="mm", help="Width of walls, or diameter of bars")
    yield Number(name="voids", value=hollow.count)
