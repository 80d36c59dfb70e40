"""The space inside the walls of a part, as seen from above."""

from __future__ import annotations

import numpy as np
import shapely

from infill.interior.interior import BAND, Interior

LOW = 0.1  # cells: where no cell of a column lies deeper, rounding decides whether one lies inside
SIMPLER = 0.05  # cells
MITRE = 5.0  # largest move of a sharp corner, over that of its sides


def silhouette(space: Interior) -> shapely.Geometry:
    """Draw the polygons, mm, of the columns with a cell inside the walls, smooth between the cells.

    Where voids reach through the walls, the walls still count.
    """
    from skimage.measure import find_contours

    deepest = np.pad(space.deepest - np.float32(space.through), 1, constant_values=-BAND)
    rings = find_contours(deepest, LOW)  # type: ignore[no-untyped-call]
    area = shapely.build_area(shapely.MultiLineString([ring - 1 for ring in rings]))
    # Away from an upright wall, depths rise by one per cell.
    area = shapely.simplify(shapely.buffer(area, LOW, join_style="mitre", mitre_limit=MITRE), SIMPLER)
    return shapely.transform(area, lambda cells: space.origin[:2] + space.size * cells)
