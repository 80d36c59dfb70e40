"""Turn points on a surface into cells: a shell around them, or the solid that they enclose."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.arrays import Floats
from infill.checks import check_length, check_whole_number
from infill.errors import GeometryError, ParameterError
from infill.grid import Grid
from infill.kernels.threads import thread_count
from infill.machine import require_memory
from infill.plain_numbers import count_noun, plain_argument, plain_size
from infill.ragged import expand_rows
from infill.volume import Volume
from infill.voxels.flooding import enclosed_void

if TYPE_CHECKING:
    from scipy.spatial import KDTree

FEWEST = 4  # points that can enclose a volume
FARTHEST = 1e9  # mm, a thousand kilometres: beyond, a coordinate is broken
FLAT = 1e-6  # of the largest extent: points that deviate from their plane by less than this count as lying in it
AT_ONCE = 2**18  # spans of cells handled at a time
# Points spread evenly over a surface have six neighbours; the spacing is the distance to the sixth neighbour that 95 %
# of the points do not exceed, so that a shell of this size has only a few gaps. Measured on 20 000 points, the
# share is 95 % give or take 0.15 %.
NEIGHBOUR, QUANTILE, SAMPLED = 6, 0.95, 20_000
# Half widths of the shell to try, in spacings: half a spacing is the least at which balls around neighbours touch;
# each further one has twice the cross section, and after 2.8 it fills grooves that are five spacings wide.
WIDENING = (0.5, 0.7, 1.0, 1.4, 2.0, 2.8)
RIDGE = 0.2  # cells: eight times the ridge between balls, s² / 8 R with s² = RIDGE R, so a fortieth of a cell
REACH = 0.5  # cells: to bridge the gaps that the balls leave between them, since they are one cell or more apart
# Points with an inside behind them over points with an outside in front of them. In a whole shell this is nearly one,
# and a wider shell can add nothing; where it leaks, the inside is a few pockets, and under 0.3 most of it is outside.
BACKED, ENOUGH = 0.3, 0.9
SHELL_BYTES, SOLID_BYTES, POINT_BYTES = 1, 30, 400  # per cell and per point, measured peaks

Cells = NDArray[np.bool_]


def voxelise_points(
    points: ArrayLike,
    *,
    voxel: float,
    shell: float | None = None,
    margin: int = 2,
    max_memory: int | None = None,
    threads: int | None = None,
) -> Volume:
    """Mark the cells near points of a surface, or inside it.

    Parameters
    ----------
    points : (N, 3) array, mm
    voxel : float
        Cell size, mm.
    shell : float, optional
        Full width of the shell, mm: cells are True if their centre is within half of it of a point. If left
        out, the solid is filled.
    margin : int
        Empty cells beyond the points, or beyond their shell, on every side.
    max_memory : int, optional
        Bytes; by default, whatever is available.
    threads : int, optional
        Used to look for neighbours; see `infill.kernels.threads.thread_count`.

    Returns
    -------
    Volume
        Booleans.

    Raises
    ------
    ParameterError
        For numbers out of range, fewer than 4 points, or points that are not three finite numbers.
    GeometryError
        If the points lie in a plane, or the shell around them has gaps, so that they enclose nothing.
    MemoryLimitError
        If the grid does not fit into memory.

    Notes
    -----
    The shell is the narrow volume around the points. To fill the solid, a shell is laid around the points whose
    half width R is, with h the cell size and d the distance from a point to its sixth neighbour (its 95 %
    quantile), sqrt(d² / 4 + h²), or wider, up to sqrt(8 d² + h²), where the outside gets in. What the outside
    does not reach is filled, and the outer half of the shell is removed with balls of radius R that roll over
    the points from outside. Where balls that roll over them from inside come just as close, the nearer centre
    decides, so that the surface runs through the points and does not sag between them.

    Grooves and walls narrower than the shell are filled or lost: more points, or more evenly spread ones,
    make the shell thinner.

    >>> voxelise_points([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], voxel=1, shell=3).values.shape
    (12, 12, 12)
    """
    positions, size = _check_points(points), check_length("voxel", voxel)
    margin = check_whole_number("margin", margin, 0)
    if shell is not None:
        return _voxelise_shell(positions, size, check_length("shell", shell), margin, max_memory)
    return _voxelise_solid(positions, size, margin, max_memory, thread_count(threads))


def grid_around_points(points: ArrayLike, *, voxel: float, shell: float | None = None, margin: int = 2) -> Grid:
    """Lay the grid on which points are voxelised: see `voxelise_points`."""
    positions, size = _check_points(points), check_length("voxel", voxel)
    reach = 0 if shell is None else math.ceil(check_length("shell", shell) / 2 / size)
    shape, origin, _ = _lay_grid(positions, size, margin + reach)
    return Grid(shape=shape, spacing=size, origin=tuple(origin.tolist()))


def fill_balls(centres: Floats, radius: float, shape: tuple[int, ...]) -> Cells:
    """Mark the cells whose centre lies in a ball around one of the points.

    Parameters
    ----------
    centres : (N, 3) float64
        In cells: the centre of the first cell is 0, of the next 1.
    radius : float
        In cells.
    shape : (nx, ny, nz)

    Notes
    -----
    A ball cuts a row of cells in one span, so that the work is N times the number of rows across a ball.

    >>> fill_balls(np.array([[1.0, 1, 1]]), 1.2, (3, 3, 3)).sum()
    np.int64(7)
    """
    nx, ny, nz = shape
    inside = np.zeros(shape, dtype=bool)
    ordered = centres[np.argsort(centres[:, 0], kind="stable")]
    x, y, z = np.ascontiguousarray(ordered.T)
    for i in range(nx):
        begin, end = np.searchsorted(x, [i - radius, i + radius])
        if begin == end:
            continue
        ends = np.zeros((ny, nz + 1), dtype=np.int32)
        half_chord_squared = np.maximum(radius**2 - (x[begin:end] - i) ** 2, 0)
        reach = np.sqrt(half_chord_squared)
        low_row = np.clip(np.ceil(y[begin:end] - reach), 0, ny).astype(np.int64)
        high_row = np.clip(np.floor(y[begin:end] + reach), -1, ny - 1).astype(np.int64)
        for ball, step in expand_rows(np.maximum(high_row - low_row + 1, 0), AT_ONCE):
            row = low_row[ball] + step
            half = np.sqrt(np.maximum(half_chord_squared[ball] - (y[begin:end][ball] - row) ** 2, 0))
            middle = z[begin:end][ball]
            start = np.clip(np.ceil(middle - half), 0, nz).astype(np.int64)
            stop = np.clip(np.floor(middle + half) + 1, 0, nz).astype(np.int64)
            nonempty = start < stop
            row, start, stop = row[nonempty] * (nz + 1), start[nonempty], stop[nonempty]
            ends += np.bincount(row + start, minlength=ends.size).reshape(ends.shape).astype(np.int32)
            ends -= np.bincount(row + stop, minlength=ends.size).reshape(ends.shape).astype(np.int32)
        np.greater(np.cumsum(ends, axis=1)[:, :-1], 0, out=inside[i])
    return inside


def spacing_of_points(tree: KDTree) -> float:
    """Return the distance to the sixth neighbour that 95 % of the points do not exceed, in their unit."""
    points = np.asarray(tree.data)
    sample = points[:: max(1, len(points) // SAMPLED)]
    return float(np.quantile(tree.query(sample, k=[min(NEIGHBOUR + 1, len(points))])[0], QUANTILE))


def _check_points(points: ArrayLike) -> Floats:
    """Check points; return them as an array (N, 3)."""
    positions = np.asarray(points, dtype=np.float64)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise ParameterError(f"the points have the shape {positions.shape}; give N x 3, in mm")
    broken = len(positions) - int(np.isfinite(positions).all(axis=1).sum())
    if broken:
        raise ParameterError(f"{broken} of {len(positions)} points are not three finite numbers; leave them out")
    farthest = float(np.abs(positions).max(initial=0.0))
    if farthest > FARTHEST:
        raise ParameterError(
            f"a point lies at {plain_size(farthest, digits=6)}; the limit is "
            f"{plain_size(FARTHEST, digits=6)}; leave it out, or check units"
        )
    if len(positions) < FEWEST:
        raise ParameterError(f"{count_noun(len(positions), 'point')} given; give at least {FEWEST}")
    return positions


def _lay_grid(positions: Floats, size: float, pad: int) -> tuple[tuple[int, ...], Floats, Floats]:
    """Lay a grid with `pad` cells around the points' box; return its shape, its origin, and the points in its cells."""
    lower, upper = positions.min(axis=0), positions.max(axis=0)
    shape = tuple(max(1, math.ceil(side / size - 1e-6)) + 2 * pad for side in (upper - lower).tolist())
    origin = (lower + upper) / 2 - np.array(shape) * size / 2
    return shape, origin, (positions - origin) / size - 0.5


def _require_room(shape: tuple[int, ...], points: int, per_cell: int, limit: int | None) -> None:
    """Raise MemoryLimitError unless a grid and its points fit into memory."""
    advice = f"the grid has {' x '.join(map(str, shape))} cells; give larger voxels"
    require_memory(math.prod(shape) * per_cell + points * POINT_BYTES, limit, advice)


def _voxelise_shell(positions: Floats, size: float, shell: float, margin: int, limit: int | None) -> Volume:
    """Mark the cells in a shell around points."""
    if shell < size:
        raise ParameterError.about(
            "shell",
            f"is {plain_argument(shell)} mm and voxel {plain_argument(size)} mm: the shell would have gaps; give a "
            "shell of at least one voxel, better three",
        )
    radius = shell / 2 / size
    shape, origin, placed = _lay_grid(positions, size, margin + math.ceil(radius))
    _require_room(shape, len(placed), SHELL_BYTES, limit)
    return Volume(values=fill_balls(placed, radius, shape), spacing=size, origin=tuple(origin.tolist()))


def _voxelise_solid(positions: Floats, size: float, margin: int, limit: int | None, threads: int) -> Volume:
    """Mark the cells of the solid that points enclose."""
    from scipy.spatial import KDTree

    middle = positions.mean(axis=0)
    extents = np.ptp(positions, axis=0)
    thickness = np.ptp((positions - middle) @ np.linalg.eigh(np.cov((positions - middle).T))[1][:, 0])
    if not thickness > FLAT * extents.max():
        raise GeometryError(
            f"the {len(positions)} points lie in a plane, so they enclose nothing; give points all around the part, "
            "or a shell"
        )
    if thickness < 2 * size:
        raise ParameterError.about(
            "voxel",
            f"is {plain_argument(size)} mm and the points are {plain_argument(thickness, 4)} mm thick; give a voxel "
            "of at most half of that",
        )
    _require_room(_lay_grid(positions, size, margin)[0], len(positions), SOLID_BYTES, limit)
    distinct = np.unique(positions, axis=0)
    tree = KDTree(distinct)
    spacing = spacing_of_points(tree)
    radii = [math.hypot(spacing * factor, size) for factor in WIDENING]
    best, leaking, best_volume = BACKED, 0.0, None
    for radius in radii:
        pad = margin + math.ceil(radius / size) + 2
        shape, origin, placed = _lay_grid(distinct, size, pad)
        _require_room(shape, len(positions), SOLID_BYTES, limit)
        values, share = _fill_shell(placed, radius / size, shape, best, threads)
        leaking = max(leaking, share)
        if values is not None:
            cut = slice(pad - margin, margin - pad)
            corner = tuple((origin + (pad - margin) * size).tolist())
            best = share
            best_volume = Volume(values=np.ascontiguousarray(values[cut, cut, cut]), spacing=size, origin=corner)
        if best_volume is not None and (best >= ENOUGH or share < best):
            return best_volume
    if best_volume is not None:
        return best_volume
    raise GeometryError(
        f"the points do not enclose a solid: no more than {leaking:.0%} of them have an inside behind them in a shell "
        f"of {plain_argument(2 * radii[0], 3)} to {plain_argument(2 * radii[-1], 3)} mm; give more points, more evenly "
        "spread ones, or a shell"
    )


def _fill_shell(
    points: Floats, radius: float, shape: tuple[int, ...], lowest_share: float, threads: int
) -> tuple[Cells | None, float]:
    """Fill a shell, in cells; return the solid, or None, and the ratio of points with inside to points with outside.

    The solid is None if that ratio is below `lowest_share`.
    """
    from scipy.spatial import KDTree

    shell = fill_balls(points, radius, shape)
    core = enclosed_void(shell)
    if not core.any():
        return None, 0.0
    tree = KDTree(points)
    inner, seen_inside = _roll_balls(tree, _adjacent_cells(core, shell), radius, threads)
    outer, seen_outside = _roll_balls(tree, _adjacent_cells(~(shell | core), shell), radius, threads)
    share = seen_inside / seen_outside
    if share < lowest_share:
        return None, share
    undecided = fill_balls(inner, radius + REACH, shape)
    undecided &= fill_balls(outer, radius + REACH, shape)
    undecided &= shell
    solid = shell
    solid |= core
    solid &= ~fill_balls(outer, radius, shape)
    lens = np.argwhere(undecided)
    if len(lens):
        inside, outside = (KDTree(centres).query(lens, workers=threads)[0] for centres in (inner, outer))
        solid[tuple(lens.T)] = inside < outside
    return solid, share


def _adjacent_cells(cells: Cells, neighbours: Cells) -> NDArray[np.int64]:
    """Return the indices (N, 3) of the cells that share a face with one of `neighbours`, without wrapping around."""
    adjacent = np.zeros_like(cells)
    for axis in range(3):
        for ahead, behind in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
            target, source = [slice(None)] * 3, [slice(None)] * 3
            target[axis], source[axis] = ahead, behind
            adjacent[tuple(target)] |= neighbours[tuple(source)]
    adjacent &= cells
    return np.argwhere(adjacent)


def _roll_balls(tree: KDTree, cells: NDArray[np.int64], radius: float, threads: int) -> tuple[Floats, int]:
    """Roll balls over the points from the side of the cells; return their centres, and how many points they touch."""
    distance, nearest = map(np.asarray, tree.query(cells, workers=threads))
    # On the ball around the nearest point, not at the cell: no part of a cell is lost.
    centres = tree.data[nearest] + (cells - tree.data[nearest]) * (radius / distance)[:, None]
    # Between balls s apart, a ridge of s² / 8 R remains: large balls need not be placed in every cell.
    pitch = max(1.0, math.sqrt(RIDGE * radius))
    _, chosen = np.unique(np.floor(centres / pitch).astype(np.int64), axis=0, return_index=True)
    return centres[chosen], len(np.unique(nearest))
