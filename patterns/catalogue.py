"""The one registry of patterns: those of this package, each by its name with its module and class, and plug-ins.

Classes are loaded when they are asked for; `patterns.offers` says what `make`, `fill` and `refill` find in one.

>>> PATTERNS["honeycomb"]
<class 'patterns.honeycomb.Honeycomb'>
"""

from __future__ import annotations

from patterns.registry import Registry

BUILT_IN = {
    # Lines in a plane: upright walls.
    "concentric-heart": "heart:ConcentricHeart",
    "zigzag": "zigzag:Zigzag",
    "honeycomb": "honeycomb:Honeycomb",
    "rectilinear": "straight:Rectilinear",
    "grid": "straight:Grid",
    "triangles": "straight:Triangles",
    "tri-hexagon": "straight:TriHexagon",
    "octagons": "octagons:Octagons",
    "hilbert": "hilbert:Hilbert",
    "cross": "cross:Cross",
    "concentric": "concentric:Concentric",
    "archimedean-chords": "spirals:ArchimedeanChords",
    "octagram-spiral": "spirals:OctagramSpiral",
    "voronoi": "voronoi:Voronoi",
    # Walls in space: along surfaces, planes, and around cells.
    "gyroid": "tpms:Gyroid",
    "schwarz-p": "tpms:SchwarzP",
    "schwarz-d": "tpms:SchwarzD",
    "fischer-koch-s": "tpms:FischerKochS",
    "lidinoid": "tpms:Lidinoid",
    "neovius": "tpms:Neovius",
    "i-wp": "tpms:IWP",
    "cross-hatch": "hatch:CrossHatch",
    "cross-3d": "cross:Cross3D",
    "cubic": "planes:Cubic",
    "quarter-cubic": "planes:QuarterCubic",
    "tetrahedral": "planes:Tetrahedral",
    "lateral-lattice": "planes:LateralLattice",
    "adaptive-cubic": "octree:AdaptiveCubic",
    "support-cubic": "octree:SupportCubic",
    "lightning": "lightning:Lightning",
    "honeycomb-3d": "honeycombs:Honeycomb3D",
    "lateral-honeycomb": "honeycombs:LateralHoneycomb",
    # Bars.
    "gyroid-network": "tpms:GyroidNetwork",
    "schwarz-p-network": "tpms:SchwarzPNetwork",
    "schwarz-d-network": "tpms:SchwarzDNetwork",
    "fischer-koch-s-network": "tpms:FischerKochSNetwork",
    "i-wp-network": "tpms:IWPNetwork",
    "cubic-bars": "struts:CubicBars",
    "octet": "struts:Octet",
    "bcc": "struts:BCC",
    "fcc": "struts:FCC",
    "diamond": "struts:Diamond",
    "kelvin": "struts:Kelvin",
    "voronoi-foam": "foam:VoronoiFoam",
}

PATTERNS = Registry(BUILT_IN)
