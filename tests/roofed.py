"""A box under a roof, for patterns that follow the infill of a print, and every family of paths in it."""

from __future__ import annotations

import numpy as np

from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.infill_space import InfillSpace, follows_print, place_family

HALF, TOP, LAYER = 40.0, 4.0, 0.2  # mm: half a side, the height of the uppermost layer, and that of all
STEP = 0.5  # mm between nodes


def roofed_space(half: float = HALF, top: float = TOP) -> InfillSpace:
    """Return the infill of a box about (0, 0) that stands on z = 0, walls around it and a roof above it."""
    count, layers = round(2 * half / STEP) + 3, round(top / LAYER) + 1
    inside = np.zeros((count, count, layers + 2), dtype=bool)
    inside[1:-1, 1:-1, 1:-1] = True
    # Depths below the roof alone: no wall of this box is steep, and its middle is far from all of them.
    below = np.maximum(LAYER * (layers + 0.5 - np.arange(layers + 2)), 0.0)
    return InfillSpace(
        corner=np.array([-half - STEP, -half - STEP, -LAYER]),
        steps=np.array([STEP, STEP, LAYER]),
        inside=inside,
        depths=np.where(inside, below, 0.0).astype(np.float32),
        heights=LAYER * np.arange(layers),
    )


SPACE = roofed_space()
# Branches alone need a roof: cubes without a print are all as small as those beside it.
ROOFED = {name: place_family(family, SPACE) if name == "lightning" else family for name, family in FAMILIES.items()}
FOLLOWING = [name for name, family in FAMILIES.items() if follows_print(family)]
