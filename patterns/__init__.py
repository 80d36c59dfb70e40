"""Infill patterns: lines in a plane at height z, level sets or cells in space, in millimetres.

Needs numpy and shapely, and loads them only when lines are requested; names are loaded on first use,
so that the help of a command does not wait for a catalogue. Knows nothing of grids.

>>> from patterns import PATTERNS, Gyroid
>>> PATTERNS["gyroid"] is Gyroid
True
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from patterns.catalogue import PATTERNS
    from patterns.cellular import Cells
    from patterns.concentric import Concentric
    from patterns.cross import Cross, Cross3D
    from patterns.declared import Parameter, check_parameters, parameter, parameter_values, parameters
    from patterns.errors import PatternError, PatternUsageError
    from patterns.foam import VoronoiFoam
    from patterns.hatch import CrossHatch
    from patterns.heart import ConcentricHeart
    from patterns.hilbert import Hilbert
    from patterns.honeycomb import Honeycomb
    from patterns.honeycombs import Honeycomb3D, LateralHoneycomb
    from patterns.lightning import Lightning
    from patterns.octagons import Octagons
    from patterns.octree import AdaptiveCubic, Octree, SupportCubic
    from patterns.planes import Cubic, LateralLattice, QuarterCubic, Tetrahedral
    from patterns.polyhedra import Polyhedra
    from patterns.protocol import LevelSet, Pattern, gives, lacking, offers
    from patterns.registry import PatternWarning, Registry
    from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter
    from patterns.spirals import ArchimedeanChords, OctagramSpiral
    from patterns.straight import Grid, Rectilinear, Triangles, TriHexagon
    from patterns.struts import BCC, FCC, CubicBars, Diamond, Kelvin, Octet
    from patterns.tpms import (
        IWP,
        FischerKochS,
        FischerKochSNetwork,
        Gyroid,
        GyroidNetwork,
        IWPNetwork,
        Lidinoid,
        Neovius,
        SchwarzD,
        SchwarzDNetwork,
        SchwarzP,
        SchwarzPNetwork,
    )
    from patterns.unit_cells import Bars, Network, Planes, Surfaces
    from patterns.voronoi import Voronoi
    from patterns.zigzag import Zigzag

_HOMES = {
    "catalogue": ("PATTERNS",),
    "cellular": ("Cells",),
    "declared": ("Parameter", "check_parameters", "parameter", "parameter_values", "parameters"),
    "errors": ("PatternError", "PatternUsageError"),
    "octree": ("Octree",),
    "polyhedra": ("Polyhedra",),
    "protocol": ("LevelSet", "Pattern", "gives", "lacking", "offers"),
    "registry": ("PatternWarning", "Registry"),
    "shared": ("angle_parameter", "cell_parameter", "frame_parameter", "phase_parameter"),
    "unit_cells": ("Bars", "Network", "Planes", "Surfaces"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "BCC",
    "FCC",
    "IWP",
    "PATTERNS",
    "AdaptiveCubic",
    "ArchimedeanChords",
    "Bars",
    "Cells",
    "Concentric",
    "ConcentricHeart",
    "Cross",
    "Cross3D",
    "CrossHatch",
    "Cubic",
    "CubicBars",
    "Diamond",
    "FischerKochS",
    "FischerKochSNetwork",
    "Grid",
    "Gyroid",
    "GyroidNetwork",
    "Hilbert",
    "Honeycomb",
    "Honeycomb3D",
    "IWPNetwork",
    "Kelvin",
    "LateralHoneycomb",
    "LateralLattice",
    "LevelSet",
    "Lidinoid",
    "Lightning",
    "Neovius",
    "Network",
    "Octagons",
    "OctagramSpiral",
    "Octet",
    "Octree",
    "Parameter",
    "Pattern",
    "PatternError",
    "PatternUsageError",
    "PatternWarning",
    "Planes",
    "Polyhedra",
    "QuarterCubic",
    "Rectilinear",
    "Registry",
    "SchwarzD",
    "SchwarzDNetwork",
    "SchwarzP",
    "SchwarzPNetwork",
    "SupportCubic",
    "Surfaces",
    "Tetrahedral",
    "TriHexagon",
    "Triangles",
    "Voronoi",
    "VoronoiFoam",
    "Zigzag",
    "angle_parameter",
    "cell_parameter",
    "check_parameters",
    "frame_parameter",
    "gives",
    "lacking",
    "offers",
    "parameter",
    "parameter_values",
    "parameters",
    "phase_parameter",
]


def __getattr__(name: str) -> object:
    home = _HOME_OF.get(name)
    if home is None:
        from patterns.catalogue import BUILT_IN

        home = {pattern: module for module, pattern in (text.split(":") for text in BUILT_IN.values())}.get(name)
    if home is None:
        raise AttributeError(f"module 'patterns' has no attribute {name!r}")
    return getattr(importlib.import_module(f"patterns.{home}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
