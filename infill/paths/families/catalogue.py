"""Paths drawn by hand, by the names of `patterns.PATTERNS`, loaded on first use; `families.lines` draws all others."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping

from infill.paths.families.family import Family

_HOMES = {
    "concentric-heart": ("nested", "ConcentricHeartPaths"),
    "zigzag": ("rows", "ZIGZAG"),
    "honeycomb": ("rows", "HoneycombPaths"),
    "honeycomb-3d": ("rows", "Honeycomb3DPaths"),
    "grid": ("rows", "GRID"),
    "triangles": ("triangles", "TRIANGLES"),
    "tri-hexagon": ("triangles", "TRI_HEXAGON"),
    "cubic": ("triangles", "CUBIC"),
    "adaptive-cubic": ("octree", "ADAPTIVE_CUBIC"),
    "support-cubic": ("octree", "SUPPORT_CUBIC"),
    "lightning": ("branches", "LightningPaths"),
    "rectilinear": ("rows", "RectilinearPaths"),
    "hilbert": ("one_line", "HilbertPaths"),
    "gyroid": ("level_sets", "GyroidPaths"),
    "schwarz-p": ("level_sets", "SchwarzPPaths"),
    "schwarz-d": ("level_sets", "SchwarzDPaths"),
    "concentric": ("nested", "ConcentricPaths"),
    "octagons": ("octagons", "OctagonsPaths"),
    "cross": ("one_line", "CrossPaths"),
    "archimedean-chords": ("one_line", "ARCHIMEDEAN_CHORDS"),
    "octagram-spiral": ("one_line", "OCTAGRAM_SPIRAL"),
    "voronoi": ("voronoi", "VoronoiPaths"),
    "cross-hatch": ("level_sets", "CrossHatchPaths"),
    "lateral-honeycomb": ("rows", "LateralHoneycombPaths"),
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
