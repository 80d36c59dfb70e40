"""Numbers that a page shows beside a picture, from the reports of the library."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from infill.lattices.draft import FillDraft

# g/cm³, as makers of filament and resin state them for their plain materials.
MATERIALS = {
    "PLA": 1.24,
    "PETG": 1.27,
    "ABS": 1.04,
    "ASA": 1.07,
    "PA12": 1.01,
    "TPU": 1.21,
    "PC": 1.2,
    "resin": 1.18,
    "Ti-6Al-4V": 4.43,
    "AlSi10Mg": 2.67,
    "316L": 7.99,
}
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
    about : bool
        Whether it is only near that of the exact result.
    """

    name: str
    value: float | int | bool | str | None
    unit: str = ""
    help: str = ""
    about: bool = False

    def facts(self) -> dict[str, Any]:
        """Return the number as plain values."""
        return vars(self)


def grams_by_material(volume: float) -> dict[str, float]:
    """Return the weight of a volume, mm³, in each material, g."""
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
    """Yield those numbers of a draft of a fill that are near the result's; cell and line width are not."""
    hollow = draft.hollow
    yield Number(
        name="solid share",
        value=draft.volume / draft.part.volume,
        unit="%",
        help="Volume of the result over that of the part",
        about=True,
    )
    inside = "Solid share of the space inside the walls"
    yield Number(name="density", value=hollow.density, unit="%", help=inside, about=True)
    yield Number(name="volume", value=draft.volume, unit="mm³", about=True)
    yield Number(name="voids", value=hollow.count, about=True)


def block_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers of a block."""
    yield Number(name="density", value=report["density"], unit="%", help="Volume over that of the full block")
    yield Number(name="volume", value=report["volume"], unit="mm³")
    yield Number(name="triangles", value=report["triangles"])
    yield Number(name="components", value=report["components"])
    if "wall_width" in report:
        yield Number(name="wall width", value=report["wall_width"]["mean"], unit="mm", help="Mean, as measured")
    else:
        yield Number(name="cell", value=report["infill"]["cell"], unit="mm", help="Period of the pattern")
        yield Number(name="line width", value=report["infill"]["line_width"], unit="mm")
    yield Number(name="closed", value=report["closed"], help="Whether the mesh encloses its inside without a gap")


def smooth_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers of a smoothed solid."""
    before, after = report["topology"]["data"], report["topology"]["result"]
    yield Number(name="verdict", value=report["verdict"]["word"], help="Whether something of the input was lost")
    yield Number(name="volume", value=report["volume"], unit="mm³")
    yield Number(name="volume change", value=report["volume_change"], unit="%", help="Against the data")
    yield Number(name="triangles", value=report["triangles"])
    for name in ("components", "cavities", "tunnels"):
        yield Number(name=name, value=after[name])
        yield Number(name=f"{name} before", value=before[name])
    yield Number(name="steps", value=report["request"]["steps"])
    yield Number(name="voxel", value=max(report["grid"]["spacing"]), unit="mm")
    yield Number(name="closed", value=report["closed"], help="Whether the mesh encloses its inside without a gap")


def smooth_draft_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield those numbers of a solid smoothed in larger voxels that are near the result's; tunnels, say, are not."""
    yield Number(name="volume", value=report["volume"], unit="mm³", about=True)
    yield Number(name="steps", value=report["request"]["steps"])


def label_numbers(report: Mapping[str, Any], *, coarse: bool = False) -> Iterator[Number]:
    """Yield the numbers of smoothed labels: the volume of each, and the number of failures."""
    yield Number(name="labels", value=len(report["labels"]))
    for label in report["labels"]:
        volume = label["report"]["volume"] if "report" in label else label["volume"]
        yield Number(name=f"volume of {label['name']}", value=volume, unit="mm³", about=coarse)
    if report["failed"]:
        yield Number(name="failed", value=len(report["failed"]))


def refill_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers of a refilled print, before and after."""
    if "sections" not in report:
        yield Number(name="sections", value=0, help="The print was refilled before")
        return
    sections, time, filament = report["sections"], report["time"], report["filament"]
    yield Number(name="sections refilled", value=sections["replaced"])
    yield Number(name="sections", value=sections["all"], help="Runs of sparse infill in the print")
    for name, key in (("time of the print", "print"), ("time of the infill", "infill")):
        yield Number(name=f"{name} before", value=time[f"{key}_before_s"], unit="s")
        yield Number(name=name, value=time[f"{key}_after_s"], unit="s")
    unit = "mm" if filament["print_after_g"] is None else "g"
    yield Number(name="filament before", value=filament[f"print_before_{unit}"], unit=unit)
    yield Number(name="filament", value=filament[f"print_after_{unit}"], unit=unit)
    contact = report["contact"]
    if contact["measured_mm"]:
        yield Number(
            name="supported before", value=contact["supported_before"], unit="%", help="Share on the layer below"
        )
        yield Number(name="supported", value=contact["supported_after"], unit="%", help="Share on the layer below")


def refill_draft_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield those numbers that a print refilled in one layer shares with one that is refilled throughout."""
    of_all = [
        number for number in refill_numbers(report) if number.name == "sections" or number.name.endswith("before")
    ]
    return (replace(number, about=number.name == "supported before") for number in of_all)


def motion_numbers(report: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers of a print."""
    yield Number(name="time", value=report["seconds"], unit="s", help="As the printer's firmware plans the moves")
    if report["estimate"] is not None:
        yield Number(name="time as the slicer says", value=report["estimate"], unit="s")
    yield Number(name="layers", value=report["layers"])
    yield Number(name="filament", value=report["filament"], unit="mm")
    yield Number(name="travel", value=report["travel"], unit="mm")
    yield Number(name="retractions", value=report["retractions"])
