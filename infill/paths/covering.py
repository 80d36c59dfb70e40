"""A region covered by a family of paths, and the cell at which that takes the length of line asked for."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from infill.checks import positive
from infill.errors import ParameterError
from infill.paths.clipping import clip
from infill.paths.families.protocol import TOUCH, Family, Path, RegionFamily
from infill.paths.joining import join
from infill.paths.layer_below import Ground
from infill.paths.ordering import order
from infill.paths.outlines import Outline, outline_of

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

ANCHOR, ANCHOR_MAX = 2.5, 12.0  # mm, as slicers have them
CLOSE = 0.005  # of the length asked for: near enough
SECANTS = 6
MORE = 10  # steps, if secants found none
AROUND = 1.012  # the factor between cells that are tried around the nearest one
FINEST = 1.002  # the factor between cells within which a jump is taken for one


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A cell, the length of line that it gives, mm, and by which share of the length asked for that is off."""

    cell: float
    length: float
    error: float


def cover(
    region: Polygon | MultiPolygon | Outline,
    family: Family,
    *,
    cell: float,
    line_width: float,
    z: float,
    layer: int,
    radius: float = 0.0,
    anchor: float = ANCHOR,
    anchor_max: float = ANCHOR_MAX,
    start: tuple[float, float] | None = None,
    ground: Ground | None = None,
) -> list[Path]:
    """Return centre lines of a family inside a region, joined along its outline and in the order of printing.

    Parameters
    ----------
    region : Polygon, MultiPolygon or Outline
        Where centre lines may lie, mm; the outline of one that is covered repeatedly is best found once.
    family : Family
    cell, line_width, z, layer, radius
        As for `Family.strands`. Corners are returned as such, to be rounded by up to `radius`.
    anchor, anchor_max : float
        As for `join`, mm.
    start : (x, y), optional
        Where the nozzle comes from, mm.
    ground : Ground, optional
        As for `join`.

    Returns
    -------
    list of (N, 2) float64, mm

    Raises
    ------
    ParameterError
        If a length is not a number above 0, or the cell is narrower than a bead.
    GeometryError
        If the region is not valid.

    >>> from shapely import box
    >>> from infill.paths.families.catalogue import FAMILIES
    >>> len(cover(box(0, 0, 20, 20), FAMILIES["honeycomb"], cell=6, line_width=0.45, z=0.2, layer=0))
    1
    """
    outline = region if isinstance(region, Outline) else outline_of(region)
    check_cell(cell, line_width)
    paths = _joined(outline, family, cell, line_width, z, layer, radius, anchor, anchor_max, ground)
    return order(paths, start)


def solve_cell(
    regions: Sequence[tuple[Polygon | MultiPolygon | Outline, float, int]],
    family: Family,
    length: float,
    *,
    line_width: float,
    radius: float = 0.0,
    anchor: float = ANCHOR,
    anchor_max: float = ANCHOR_MAX,
    measure: Callable[[Sequence[Path], float], float] | None = None,
) -> Solved:
    """Return the cell at which a family's paths in some regions are as long as asked, together.

    Secant steps in the logarithms of cell and length, inside the bracket that is known so far. In small regions
    the length jumps with the cell, as whole lines come and go: the nearest that was found is returned then, with the
    error that remains.

    Parameters
    ----------
    regions : sequence of (region, z, layer)
        mm. One and the same region is drawn once, if the family repeats in every layer.
    family : Family
    length : float
        mm, of all regions together.
    line_width, radius, anchor, anchor_max
        As for `cover`.
    measure : callable, optional
        What counts as the length of paths, mm, drawn at a cell, mm: after rounding, for instance. `total_length` if it
        is not given.

    Raises
    ------
    ParameterError
        If `length` is not above 0, or beads would have to overlap.
    """
    wanted = positive("length", length, "mm")
    own = {id(each): each if isinstance(each, Outline) else outline_of(each) for each, _, _ in regions}
    places = Counter((id(each), *((0.0, 0) if family.prismatic else (z, layer))) for each, z, layer in regions)
    least = TOUCH * line_width
    area = sum(own[region].region.area * number for (region, _, _), number in places.items())
    if not places or wanted * least > area:
        raise ParameterError(
            f"{wanted:g} mm of beads {least:g} mm apart do not fit into {area:g} mm²; ask for a lower density"
        )

    def ratio(cell: float) -> float:
        length = 0.0
        for (region, z, layer), number in places.items():
            paths = _joined(own[region], family, cell, line_width, z, layer, radius, anchor, anchor_max)
            length += number * (total_length(paths) if measure is None else measure(paths, cell))
        return length / wanted

    found: list[tuple[float, float]] = []
    for cell, share in _steps(ratio, max(least, family.cell_for(wanted * least / area, line_width)), least):
        found.append((share, cell))
        if abs(share - 1) <= CLOSE:
            break
    share, cell = min(found, key=lambda pair: abs(math.log(pair[0])) if pair[0] > 0 else math.inf)
    return Solved(cell=cell, length=share * wanted, error=share - 1)


def total_length(paths: Sequence[Path]) -> float:
    """Return the length of paths, mm.

    >>> total_length([np.array([[0.0, 0.0], [3.0, 4.0]])])
    5.0
    """
    return float(sum(np.hypot(*np.diff(path, axis=0).T).sum() for path in paths))


def _steps(ratio: Callable[[float], float], first: float, least: float) -> Iterator[tuple[float, float]]:
    """Yield cells, from `first` on, and the shares of the length asked for that they give.

    Secants first. Where lengths jump over the one asked for, cells around the one that came nearest, and between those
    on either side of it: between jumps lengths drift.
    """
    low, high = least, math.inf  # cells known to give too much and too little
    cell, slope = first, -1.0
    found: list[tuple[float, float]] = []
    for _ in range(SECANTS):
        share = ratio(cell)
        yield cell, share
        low, high = (max(low, cell), high) if share > 1 else (low, min(high, cell))
        if found and share > 0 and found[-1][1] > 0 and cell != found[-1][0]:
            slope = math.log(share / found[-1][1]) / math.log(cell / found[-1][0])
            slope = min(-0.5, max(-2.0, slope))
        found.append((cell, share))
        cell *= max(share, 0.1) ** (-1 / slope)
        if not low < cell < high:
            cell = math.sqrt(low * high) if high < math.inf else 2 * low
    nearest = min(found, key=lambda pair: abs(pair[1] - 1))[0]
    tried = 0
    for _ in range(MORE):
        found.sort()
        sides = [
            math.sqrt(one * other)
            for (one, more), (other, less) in itertools.pairwise(found)
            if (more - 1) * (less - 1) < 0 and other > FINEST * one
        ]
        if sides:
            cell = min(sides, key=lambda cell: abs(math.log(cell / nearest)))
        else:
            tried += 1
            cell = max(least, nearest * AROUND ** ((tried + 1) // 2 * (-1) ** tried))
        found.append((cell, ratio(cell)))
        yield found[-1]


def _joined(
    outline: Outline,
    family: Family,
    cell: float,
    line_width: float,
    z: float,
    layer: int,
    radius: float,
    anchor: float,
    anchor_max: float,
    ground: Ground | None = None,
) -> list[Path]:
    """Return the paths of a family in a region, in no order."""
    if isinstance(family, RegionFamily):
        return family.strands_inside(outline.region, cell=cell, line_width=line_width)
    strands = family.strands(outline.region.bounds, cell=cell, line_width=line_width, z=z, layer=layer, radius=radius)
    pieces = clip(strands, outline)
    return join(pieces, outline, line_width=line_width, anchor=anchor, anchor_max=anchor_max, ground=ground)


def check_cell(cell: float, line_width: float) -> None:
    """Raise ParameterError for a cell that beads do not fit into."""
    least = TOUCH * positive("line width", line_width, "mm")
    if positive("cell", cell, "mm") < least * (1 - 1e-9):
        raise ParameterError(f"cell is {cell:g} mm; beads of {line_width:g} mm need at least {least:g} mm")
