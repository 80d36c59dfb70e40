"""Infill patterns: lines in a plane at height z, or level sets in space, in millimetres.

Needs numpy and shapely, and loads them only when lines are requested; names are loaded on first use,
so that the help of a command does not wait for a catalogue. Knows nothing of grids.

>>> from patterns import PATTERNS
>>> "honeycomb" in PATTERNS.built_in
True
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from patterns.catalogue import PATTERNS
    from patterns.concentric import Concentric
    from patterns.cross import Cross
    from patterns.declared import Parameter, check_parameters, parameter, parameter_values, parameters
    from patterns.errors import PatternError, PatternUsageError
    from patterns.heart import ConcentricHeart
    from patterns.hilbert import Hilbert
    from patterns.honeycomb import Honeycomb
    from patterns.octagons import Octagons
    from patterns.protocol import LevelSet, Pattern, gives, lacking
    from patterns.registry import PatternWarning, Registry
    from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter
    from patterns.spirals import ArchimedeanChords, OctagramSpiral
    from patterns.straight import Grid, Rectilinear, Triangles, TriHexagon
    from patterns.voronoi import Voronoi
    from patterns.zigzag import Zigzag

_HOMES = {
    "catalogue": ("PATTERNS",),
    "concentric": ("Concentric",),
    "cross": ("Cross",),
    "declared": ("Parameter", "check_parameters", "parameter", "parameter_values", "parameters"),
    "errors": ("PatternError", "PatternUsageError"),
    "heart": ("ConcentricHeart",),
    "hilbert": ("Hilbert",),
    "honeycomb": ("Honeycomb",),
    "octagons": ("Octagons",),
    "protocol": ("LevelSet", "Pattern", "gives", "lacking"),
    "registry": ("PatternWarning", "Registry"),
    "shared": ("angle_parameter", "cell_parameter", "frame_parameter", "phase_parameter"),
    "spirals": ("ArchimedeanChords", "OctagramSpiral"),
    "straight": ("Grid", "Rectilinear", "Triangles", "TriHexagon"),
    "voronoi": ("Voronoi",),
    "zigzag": ("Zigzag",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "PATTERNS",
    "ArchimedeanChords",
    "Concentric",
    "ConcentricHeart",
    "Cross",
    "Grid",
    "Hilbert",
    "Honeycomb",
    "LevelSet",
    "Octagons",
    "OctagramSpiral",
    "Parameter",
    "Pattern",
    "PatternError",
    "PatternUsageError",
    "PatternWarning",
    "Rectilinear",
    "Registry",
    "TriHexagon",
    "Triangles",
    "Voronoi",
    "Zigzag",
    "angle_parameter",
    "cell_parameter",
    "check_parameters",
    "frame_parameter",
    "gives",
    "lacking",
    "parameter",
    "parameter_values",
    "parameters",
    "phase_parameter",
]


def __getattr__(name: str) -> object:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'patterns' has no attribute {name!r}")
    return getattr(importlib.import_module(f"patterns.{_HOME_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
