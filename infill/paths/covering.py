"""Cover a region with a family of paths, and solve for the cell that gives a requested length of line."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from infill.checks import check_positive
from infill.errors import ParameterError
from infill.paths.clipping import clip
from infill.paths.families.family import TOUCH, Family, Path, PathSpec, RegionFamily
from infill.paths.joining import join
from infill.paths.layer_below import LayerBelow
from infill.paths.ordering import order_paths
from infill.paths.outlines import Outline, outline_of
from infill.plain_numbers import plain_argument, plain_size

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

ANCHOR, ANCHOR_MAX = 2.5, 12.0  # mm, as slicers have them
LENGTH_TOLERANCE = 0.005  # of the requested length: accurate enough
SECANTS = 6
EXTRA_STEPS = 10  # further steps, if no secant step is accurate enough
CELL_RATIO = 1.012  # ratio of the cells that are tried around the best one
FINEST = 1.002  # ratio of two cells below which a jump between them is not divided further


@dataclass(frozen=True, kw_only=True)
class CellSolution:
    """A cell, the length of line that it gives, mm, and its relative error against the requested length."""

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
    ground: LayerBelow | None = None,
) -> list[Path]:
    """Return centre lines of a family inside a region, joined along its outline and in the order of printing.

    Parameters
    ----------
    region : Polygon, MultiPolygon or Outline
        Area for centre lines, mm; pass an `Outline` to cover the same region repeatedly.
    family : Family
    cell, line_width, z, layer, radius
        As for `PathSpec`. Corners are returned as such, to be rounded by up to `radius`.
    anchor, anchor_max : float
        As for `join`, mm.
    start : (x, y), optional
        Where the nozzle comes from, mm.
    ground : LayerBelow, optional
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
    spec = PathSpec(cell=cell, line_width=line_width, z=z, layer=layer, radius=radius)
    return order_paths(_draw_joined(outline, family, spec, anchor, anchor_max, ground), start)


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
) -> CellSolution:
    """Solve for the cell at which a family's paths in some regions have a total length.

    Secant steps in the logarithms of cell and length stay inside the current bracket. In small regions the length
    jumps with the cell, as whole lines come and go: the result is then the closest cell, with the remaining error.

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
        Length of paths, mm, drawn at a cell, mm: after rounding, for instance. Default: `total_length`.

    Raises
    ------
    ParameterError
        If `length` is not above 0, or beads would have to overlap.
    """
    target = check_positive("length", length, "mm")
    outlines = {id(key): key if isinstance(key, Outline) else outline_of(key) for key, _, _ in regions}
    places = Counter((id(key), *((0.0, 0) if family.prismatic else (z, layer))) for key, z, layer in regions)
    smallest = TOUCH * line_width
    area = sum(outlines[region].region.area * number for (region, _, _), number in places.items())
    if not places or target * smallest > area:
        raise ParameterError(
            f"{plain_argument(target)} mm of beads {plain_argument(smallest)} mm apart do not fit into "
            f"{plain_size(area, digits=6, power=2)}; ask for a lower density"
        )

    def length_ratio(cell: float) -> float:
        """Return the length of paths of a cell over the requested length."""
        length = 0.0
        for (region, z, layer), number in places.items():
            spec = PathSpec(cell=cell, line_width=line_width, z=z, layer=layer, radius=radius)
            paths = _draw_joined(outlines[region], family, spec, anchor, anchor_max)
            length += number * (total_length(paths) if measure is None else measure(paths, cell))
        return length / target

    trials: list[tuple[float, float]] = []
    for cell, share in _search_cells(
        length_ratio, max(smallest, family.cell_for(target * smallest / area, line_width)), smallest
    ):
        trials.append((share, cell))
        if abs(share - 1) <= LENGTH_TOLERANCE:
            break
    share, cell = min(trials, key=lambda pair: abs(math.log(pair[0])) if pair[0] > 0 else math.inf)
    return CellSolution(cell=cell, length=share * target, error=share - 1)


def total_length(paths: Sequence[Path]) -> float:
    """Return the length of paths, mm.

    >>> total_length([np.array([[0.0, 0.0], [3.0, 4.0]])])
    5.0
    """
    return float(sum(np.hypot(*np.diff(path, axis=0).T).sum() for path in paths))


def _search_cells(ratio: Callable[[float], float], start: float, smallest: float) -> Iterator[tuple[float, float]]:
    """Yield cells, from `start` on, and their shares of the requested length.

    Secants come first. Where lengths jump over the requested one, the next cells lie around the best one, and between
    those on either side of it: between jumps lengths drift.
    """
    low, high = smallest, math.inf  # cells that give too much and too little
    cell, slope = start, -1.0
    trials: list[tuple[float, float]] = []
    for _ in range(SECANTS):
        share = ratio(cell)
        yield cell, share
        low, high = (max(low, cell), high) if share > 1 else (low, min(high, cell))
        if trials and share > 0 and trials[-1][1] > 0 and cell != trials[-1][0]:
            slope = math.log(share / trials[-1][1]) / math.log(cell / trials[-1][0])
            slope = min(-0.5, max(-2.0, slope))
        trials.append((cell, share))
        cell *= max(share, 0.1) ** (-1 / slope)
        if not low < cell < high:
            cell = math.sqrt(low * high) if high < math.inf else 2 * low
    nearest = min(trials, key=lambda pair: abs(pair[1] - 1))[0]
    attempts = 0
    for _ in range(EXTRA_STEPS):
        trials.sort()
        sides = [
            math.sqrt(fine * coarse)
            for (fine, fine_share), (coarse, coarse_share) in itertools.pairwise(trials)
            if (fine_share - 1) * (coarse_share - 1) < 0 and coarse > FINEST * fine
        ]
        if sides:
            cell = min(sides, key=lambda cell: abs(math.log(cell / nearest)))
        else:
            attempts += 1
            cell = max(smallest, nearest * CELL_RATIO ** ((attempts + 1) // 2 * (-1) ** attempts))
        trials.append((cell, ratio(cell)))
        yield trials[-1]


def _draw_joined(
    outline: Outline,
    family: Family,
    spec: PathSpec,
    anchor: float,
    anchor_max: float,
    ground: LayerBelow | None = None,
) -> list[Path]:
    """Draw the paths of a family in a region, in any order."""
    family = family.at(spec.z)
    if isinstance(family, RegionFamily):
        return family.strands_inside(outline.region, spec)
    pieces = clip(family.strands(outline.region.bounds, spec), outline)
    return join(
        pieces,
        outline,
        line_width=spec.line_width,
        anchor=anchor,
        anchor_max=anchor_max,
        ground=ground,
        least_spacing=family.least_spacing,
    )


def check_cell(cell: float, line_width: float) -> None:
    """Raise ParameterError if a cell is too small for beads."""
    smallest = TOUCH * check_positive("line width", line_width, "mm")
    if check_positive("cell", cell, "mm") < smallest * (1 - 1e-9):
        raise ParameterError.about(
            "cell",
            f"is {plain_argument(cell)} mm; beads of {plain_argument(line_width)} mm need at least "
            f"{plain_argument(smallest)} mm",
        )
