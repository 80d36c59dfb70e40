"""What lies inside the walls of a part, as seen from above."""

from __future__ import annotations

import numpy as np
import shapely

from infill.filling.solids.space import BAND, Space

LOW = 0.5  # cells: a column in which a void would nowhere be twice as high is none, whatever rounding says
SIMPLER = 0.05  # cells
MITRE = 5.0  # how far a sharp corner may be moved, in distances by which its sides are


def shadow_of(space: Space) -> shapely.Geometry:
    """Return the polygons, mm, in which some cell of a column lies inside the walls, smooth between the cells.

    Where voids reach through the walls, these count.
    """
    from skimage.measure import find_contours

    deepest = np.pad(space.deepest - np.float32(space.through), 1, constant_values=-BAND)
    rings = find_contours(deepest, LOW)  # type: ignore[no-untyped-call]
    area = shapely.build_area(shapely.multilinestrings([shapely.linestrings(ring - 1) for ring in rings]))
    # Depths rise by a cell in every cell from an upright wall.
    area = shapely.simplify(shapely.buffer(area, LOW, join_style="mitre", mitre_limit=MITRE), SIMPLER)
    return shapely.transform(area, lambda cells: space.origin[:2] + space.size * cells)
