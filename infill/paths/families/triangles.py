r"""Lines in three directions with every crossing resolved: triangles, stars and hexagons, and cubes on a corner.

Lines along x cut the diamonds between the lines of the two other directions, at a share s of their half height::

      \    /\    /      s = 0: all lines meet in points, triangles
    ___\__/__\__/___    s = 1/2: triangles and hexagons
        \/    \/        s rises with z: sections of cubes that stand on a corner
        /\    /\

At each crossing of flanks, and at each crossing of a flank with a line along x, the strands turn off instead.
Two waves a row result, one above the line along x and one below it; their flats overlap where they touch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from infill.paths.families.family import PathSpec
from infill.paths.families.waves import Rows, Wave, WaveFamily, crest_length

TURN = math.radians(60)
LEAST = 0.25  # line widths: a lower wave is drawn as a straight line
SECTIONS = 24  # sections in which the mean of a family over its heights is taken


@dataclass(frozen=True, kw_only=True)
class Threefold(WaveFamily):
    """Resolved lines in three directions; `cell` is the distance between parallel lines.

    `share` is s at height 0; `rises` is True if the lines move with height as sections of cubes do.

    >>> rows = Threefold(name="stars", summary="", share=0.5).rows(PathSpec(cell=6.0, line_width=0.45))
    >>> [wave.height for wave in rows.waves]
    [3.0, 3.0]
    """

    share: float = 0.0
    rises: bool = False
    corner_share: ClassVar[float] = 0.25  # cells keep their shape; crests touch at any radius
    stretches: ClassVar[bool] = True
    touches: ClassVar[bool] = True

    def rows(self, spec: PathSpec) -> Rows:
        """Return the rows of waves."""
        cell, gap = spec.cell, spec.gap
        crest = crest_length(spec.line_width, self.radius_of(spec), TURN)
        pitch = cell + 2 * gap
        # A cube's faces are orthogonal planes: as z rises by 1, the lines along x sink by √½ and the crossings of
        # the other two directions rise by √2.
        rise = spec.z * math.sqrt(2) * pitch / cell if self.rises else 0.0
        place = (self.share - 1.5 * rise / pitch) % 1
        lowest = LEAST * spec.line_width / cell
        share = place if lowest <= place <= 1 - lowest else float(round(place))
        # Lines along x keep their places, and flanks move: sideways by half of that.
        base = rise + place * pitch - share * (cell + gap)
        heights = share * cell, (1 - share) * cell
        # Two crests a period, or four where flats overlap beside the crossings; as one wave becomes a straight line,
        # its neighbour needs no overlap, and flanks of the last layer and of the next one meet.
        crests = 4 if self.share or self.rises else 2
        tip = crest * (crests / 2 - min(share, 1 - share) * (crests - 2))
        period = 2 * cell / math.sqrt(3) + crests * crest
        free = [period - tip - 2 * height / math.sqrt(3) for height in heights]
        low = Wave(period=period, bottom=tip, top=free[0], height=heights[0], base=base)
        high = Wave(period=period, bottom=free[1], top=tip, height=heights[1], base=base + heights[0] + gap)
        return Rows(waves=[low, high], pitch=pitch, slip=period / 2)

    def heights(self, cell: float) -> list[float]:
        """Return the heights of the sections of a period, mm."""
        return [cell * math.sqrt(2) / 3 * part / SECTIONS for part in range(SECTIONS if self.rises else 1)]


TRIANGLES = Threefold(name="triangles", summary="straight lines with zigzags between them that touch both")
TRI_HEXAGON = Threefold(name="tri-hexagon", summary="triangles around hexagons, drawn as waves that touch", share=0.5)
CUBIC = Threefold(
    name="cubic", summary="cubes that stand on a corner; stiff in height as well", rises=True, prismatic=False
)
