"""The catalogue: every pattern of this package by name, and those of installed plug-ins."""

from __future__ import annotations

from patterns.concentric import Concentric
from patterns.cross import Cross
from patterns.heart import ConcentricHeart
from patterns.hilbert import Hilbert
from patterns.honeycomb import Honeycomb
from patterns.octagons import Octagons
from patterns.registry import Registry
from patterns.spirals import ArchimedeanChords, OctagramSpiral
from patterns.straight import Grid, Rectilinear, Triangles, TriHexagon
from patterns.voronoi import Voronoi
from patterns.zigzag import Zigzag

PATTERNS = Registry(
    (
        ConcentricHeart,
        Zigzag,
        Honeycomb,
        Rectilinear,
        Grid,
        Triangles,
        TriHexagon,
        Octagons,
        Hilbert,
        Cross,
        Concentric,
        ArchimedeanChords,
        OctagramSpiral,
        Voronoi,
    )
)
