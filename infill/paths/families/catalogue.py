"""The catalogue: every family by name, loaded on first use."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping

from infill.paths.families.protocol import Family

_HOMES = {
    "concentric-heart": ("heart", "ConcentricHeart"),
    "zigzag": ("grid", "ZIGZAG"),
    "honeycomb": ("honeycomb", "Honeycomb"),
    "honeycomb-3d": ("honeycomb_3d", "Honeycomb3D"),
    "grid": ("grid", "GRID"),
    "triangles": ("triangles", "TRIANGLES"),
    "tri-hexagon": ("triangles", "TRI_HEXAGON"),
    "cubic": ("triangles", "CUBIC"),
    "rectilinear": ("rectilinear", "Rectilinear"),
    "hilbert": ("hilbert", "Hilbert"),
    "gyroid": ("level_sets", "Gyroid"),
    "schwarz-p": ("level_sets", "SchwarzP"),
    "schwarz-d": ("level_sets", "SchwarzD"),
    "concentric": ("concentric", "Concentric"),
    "octagons": ("octagons", "Octagons"),
    "cross": ("cross", "Cross"),
    "archimedean-chords": ("spirals", "ARCHIMEDEAN_CHORDS"),
    "octagram-spiral": ("spirals", "OCTAGRAM_SPIRAL"),
    "voronoi": ("voronoi", "Voronoi"),
    "cross-hatch": ("cross_hatch", "CrossHatch"),
    "lateral-honeycomb": ("lateral_honeycomb", "LateralHoneycomb"),
    "quarter-cubic": ("quarter_cubic", "QuarterCubic"),
}


class _Catalogue(Mapping[str, Family]):
    """Families by name, the three designs of the paper first."""

    def __getitem__(self, name: str) -> Family:
        module, attribute = _HOMES[name]
        member = getattr(importlib.import_module(f"infill.paths.families.{module}"), attribute)
        family: Family = member() if isinstance(member, type) else member
        return family

    def __iter__(self) -> Iterator[str]:
        return iter(_HOMES)

    def __len__(self) -> int:
        return len(_HOMES)


FAMILIES: Mapping[str, Family] = _Catalogue()
