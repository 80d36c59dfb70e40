"""Paths drawn by hand, by the names of `patterns.PATTERNS`, loaded on first use; `families.lines` draws all others."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping

from infill.paths.families.protocol import Family

_HOMES = {
    "concentric-heart": ("heart", "ConcentricHeartPaths"),
    "zigzag": ("grid", "ZIGZAG"),
    "honeycomb": ("honeycomb", "HoneycombPaths"),
    "honeycomb-3d": ("honeycomb_3d", "Honeycomb3DPaths"),
    "grid": ("grid", "GRID"),
    "triangles": ("triangles", "TRIANGLES"),
    "tri-hexagon": ("triangles", "TRI_HEXAGON"),
    "cubic": ("triangles", "CUBIC"),
    "rectilinear": ("rectilinear", "RectilinearPaths"),
    "hilbert": ("hilbert", "HilbertPaths"),
    "gyroid": ("level_sets", "GyroidPaths"),
    "schwarz-p": ("level_sets", "SchwarzPPaths"),
    "schwarz-d": ("level_sets", "SchwarzDPaths"),
    "concentric": ("concentric", "ConcentricPaths"),
    "octagons": ("octagons", "OctagonsPaths"),
    "cross": ("cross", "CrossPaths"),
    "archimedean-chords": ("spirals", "ARCHIMEDEAN_CHORDS"),
    "octagram-spiral": ("spirals", "OCTAGRAM_SPIRAL"),
    "voronoi": ("voronoi", "VoronoiPaths"),
    "cross-hatch": ("cross_hatch", "CrossHatchPaths"),
    "lateral-honeycomb": ("lateral_honeycomb", "LateralHoneycombPaths"),
    "quarter-cubic": ("quarter_cubic", "QuarterCubicPaths"),
}


class _Catalogue(Mapping[str, Family]):
    """Families of the patterns that offer paths, by name, the three designs of the paper first."""

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
