"""How far two prints may differ: rounding of the decimals that slicers and scripts write, and a little."""

from __future__ import annotations

from typing import Final

UNIT: Final = 1e-3  # mm: the last decimal of coordinates
PATH_TOLERANCE: Final = 0.05  # mm by which a path may differ: that of arcs in place of lines
HEIGHT_TOLERANCE: Final = 0.005  # mm
FILAMENT_SHARE: Final = 0.02  # of a bead's filament
FILAMENT_STEP: Final = 6e-4  # mm: half of the third decimal of E, which some scripts keep, and a little
DEPTH_TOLERANCE: Final = 0.02  # mm of filament, of retractions and blobs
SPEED_STEP: Final = 6.0  # mm/min
