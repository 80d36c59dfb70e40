"""The two-colour field of a tile: signed distances to its borders, with room for a bead everywhere, and smoothed.

A border parts two colours, so the colour at a point is the parity of the borders crossed on the way there. The sign
of the field is the colour, its value the distance to the nearest border; smoothing by the paper's equation rounds
all corners together, and the zero contours of the field, which are the paths, cannot cross.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.paths.tiles.borders import TOUCH, Borders
from infill.paths.tiles.nodes import TileGrid, colour_parity, distance_field, periodic_copies, split_edges
from infill.phasefield.allen_cahn import STEEPNESS, Smoothing
from infill.phasefield.methods import smooth

FIDELITY = 0.001
# Cells: with a thinner interface, lines snap to the grid; a thicker one draws touching paths together.
INTERFACE = 2.3
ALPHA = 0.2  # time step: explicit diffusion is stable up to 1 / 4 in a plane, on cells that are nearly square
NARROWEST = 0.9  # line widths: narrower places are widened, or merged into their neighbours
RIDGE = 0.5  # slope of a distance on its ridge, at most: between lines, or in a corner of less than 60°
MOST_BLUR = 0.35  # of the thickest place of a colour: the limit of smoothing
COARSE = 4  # cells
EIGHT = np.ones((3, 3), dtype=bool)  # neighbours


def two_colour_field(borders: Borders, grid: TileGrid, *, line_width: float, blur: float) -> NDArray[np.float64]:
    """Compute the smoothed signed field at the nodes of a padded tile: zero on the paths, sign by colour.

    Parameters
    ----------
    borders : Borders
    grid : TileGrid
    line_width : float
        mm. Paths are kept 0.9 of it apart, and crossings open by as much.
    blur : float
        mm: how far to smooth, as the standard deviation of a Gaussian that diffuses as far.
    """
    h = max(grid.spacing)
    radius = NARROWEST / 2 * line_width
    band = radius + 3 * h
    edges = periodic_copies(borders.single, grid, band)
    field = np.where(colour_parity(edges, grid), 1, -1) * distance_field(edges, grid, band)
    field = _double_edges(field, borders.double, grid, TOUCH / 2 * line_width)
    field = _open_crossings(field, borders, grid, radius)
    for sign in (1, -1):
        field = sign * _widen_necks(sign * field, grid, radius)
    for sign in (1, -1, 1):
        field = sign * _open_field(sign * field, grid, radius)
    steps = math.ceil((min(blur, MOST_BLUR * _smallest_thickness(field, h)) / h) ** 2 / (2 * ALPHA))
    profile = np.tanh(STEEPNESS / (INTERFACE * h) * field)
    smoothing = Smoothing(steps=steps, fidelity=FIDELITY, interface=INTERFACE, alpha=ALPHA)
    phi = smooth(profile, smoothing, spacing=grid.spacing, method="inplace").astype(np.float64)
    return np.arctanh(np.clip(phi, -0.9999, 0.9999))


def _smallest_thickness(field: Floats, h: float) -> float:
    """Return the smaller of both colours' largest distances to the other, to a few cells, mm."""
    from scipy.ndimage import distance_transform_edt

    coarse = field[::COARSE, ::COARSE]
    return COARSE * h * min(float(distance_transform_edt(sign * coarse > 0).max()) for sign in (1, -1))


def _open_field(field: Floats, grid: TileGrid, radius: float) -> Floats:
    """Remove the places above 0 into which no disc fits; half a cell is allowed for the grid."""
    from scipy.ndimage import distance_transform_edt

    h = max(grid.spacing)
    core = field > radius - h / 2
    if not core.any():
        return np.minimum(field, -h)
    distance: Floats = distance_transform_edt(~core, sampling=grid.spacing)
    return np.minimum(field, radius + h - distance)


def _widen_necks(field: Floats, grid: TileGrid, radius: float) -> Floats:
    """Widen the narrow places above 0 about their middle, until beads there just touch.

    Only places that are long, or lead from one wide place to another, are widened; the others are tips and specks.
    """
    from scipy.ndimage import binary_dilation, distance_transform_edt, label, maximum_filter, sum_labels

    wide = _open_field(field, grid, radius) > 0
    narrow, count = label((field > 0) & ~wide, structure=EIGHT)
    if not count:
        return field
    slope = np.hypot(*np.gradient(field, *grid.spacing))
    middle = (narrow > 0) & (slope < RIDGE)
    long = sum_labels(middle, narrow, np.arange(count + 1)) > 4 * radius / max(grid.spacing)
    doors, _ = label(binary_dilation(narrow > 0, structure=EIGHT) & wide, structure=EIGHT)
    is_door = doors > 0
    pairs = np.unique(np.stack([maximum_filter(narrow, 3)[is_door], doors[is_door]]), axis=1)
    leading = np.bincount(pairs[0], minlength=count + 1) > 1
    middle &= (long | leading)[narrow]
    if not middle.any():
        return field
    distance: Floats = distance_transform_edt(~middle, sampling=grid.spacing)
    return np.maximum(field, radius - distance)


def _double_edges(field: Floats, edges: Floats, grid: TileGrid, radius: float) -> Floats:
    """Add a strip around each edge, of the opposite colour."""
    if not len(edges):
        return field
    band = radius + 4 * max(grid.spacing)
    pieces = split_edges(edges, 2 * radius)  # so that each lies in one colour wherever it is sampled
    middle = np.round((pieces.mean(axis=1) - grid.first) / grid.spacing).astype(int)
    # Edges lie in one tile, and so within the grid.
    colour = field[tuple(np.clip(middle, 0, np.array(grid.nodes) - 1).T)] > 0
    for sign, in_colour in ((1, colour), (-1, ~colour)):
        if in_colour.any():
            strip = distance_field(periodic_copies(pieces[in_colour], grid, band), grid, band) - radius
            field = sign * np.minimum(sign * field, strip)
    return field


def _open_crossings(field: Floats, borders: Borders, grid: TileGrid, radius: float) -> Floats:
    """Add a disc at each crossing, of the colour to connect there."""
    field = field.copy()
    reach = np.ceil(2 * radius / np.array(grid.spacing)).astype(int) + 1
    pairs = np.stack([borders.crossings, borders.crossings + radius * borders.inward], axis=1)
    for centre, inward in periodic_copies(pairs, grid, 2 * radius):
        inside = np.round((inward - grid.first) / grid.spacing).astype(int)
        middle = np.round((centre - grid.first) / grid.spacing).astype(int)
        low, high = np.maximum(middle - reach, 0), np.minimum(middle + reach + 1, grid.nodes)
        if (low >= high).any() or (inside < 0).any() or (inside >= grid.nodes).any():
            continue
        window = np.ix_(*(np.arange(a, b) for a, b in zip(low, high, strict=True)))
        x, y = (grid.first[axis] + window[axis] * grid.spacing[axis] - centre[axis] for axis in (0, 1))
        disc = radius - np.hypot(x, y)
        sign = 1 if field[tuple(inside)] > 0 else -1
        field[window] = sign * np.maximum(sign * field[window], disc)
    return field
