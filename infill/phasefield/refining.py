"""Smoothing that keeps curvature, edges and thin walls: three strengths of the scheme, each used where it fits.

The scheme is run once with momentum, from phi_-1 = phi_0 = f, without fidelity:

    v = phi_k + b_k (phi_k - phi_k-1) + alpha Lap phi_k      b_k = 0 at first, then 1/2
    phi_k+1 = v / sqrt(E + (1 - E) v v)

Momentum reaches as far as about twice as many plain steps. Of a wave exp(i q x), step k leaves the share T_k(x),
x = alpha q², a polynomial with T_0 = 1 and T_k+1 = (1 - x) T_k + b_k (T_k - T_k-1). A sum of a_i T_k_i in which
the a_i add up to 1 and the lowest powers of x cancel lets long waves through untouched - so there is no
shrinkage - and still damps the short ones, the staircase:

    P_0 of steps (5, 10)    P_1 of steps (15, 25, 35)    P_2 of steps (35, 65)

P_0 is the mildest and keeps thin walls, P_1 is in the middle and keeps edges, and P_2 is strong, for smooth surfaces.
Each is turned into a distance from the surface, and two gates choose between them: see `blend_by_gate`.

What to expect, in cells rms from the true surface, after plain smoothing to the volume and after refinement: a box of
120 x 84 x 60 with edges of radius 8: 0.165, 0.031; a sphere of radius 80: 0.029, 0.021, but one of radius 26: 0.030,
0.043, because the plain scheme only shifts it evenly, which the level undoes. Walls 3 cells thick stay whole
after 30 steps. Noise in the surface is removed as in plain smoothing; specks that plain smoothing wipes out remain.

Exact data (a mesh's own distances, not a staircase) are a fourth field, milder than all others. A third gate leads to
them where smoothing would move the surface to one side; its limits grow with the noise that the data have. And nowhere
may the surface leave them by more than a quarter of a cell, or three times their noise: so a wall that is thicker than
twice that is never lost, and flat faces keep their place. See `ExactDataLimits`.

This is the package's own extension of the scheme of Wang et al., Computer-Aided Design 120 (2020) 102804.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.grid import spacing_of
from infill.kernels import refining as kernels
from infill.kernels.sparse import BRICK, CELLS, VOID_BRICK
from infill.kernels.threads import in_threads, thread_count
from infill.phasefield.allen_cahn import STEEPNESS, Smoothing, diffuse, react
from infill.phasefield.dense import StepCoefficients, on_three_axes, step_coefficients
from infill.phasefield.profile import REFINED_PROFILE
from infill.phasefield.schedule import Schedule
from infill.phasefield.sparse import LATER_GROWTH, Bricks, SparseField, brick_states

# Cells from the side of a brick beyond which no cell enters the gates there. The inner gate looks 3 coarse cells of 2
# far, one by interpolation and two by the blur. From these 6 cells, in 2 coarse cells of 4, the outer gate needs no
# third one to interpolate, and two by the blur: 4 coarse cells in all.
GATE_REACH = 16
Core = tuple[tuple[int, int, int], tuple[int, int, int]]

TINY_WEIGHT = 1e-6  # of a weight, added where no surface is near and the means are 0


@dataclass(frozen=True, kw_only=True)
class Gate:
    """Deviations between two fields at which the milder of them is used.

    Parameters
    ----------
    size : int
        Standard deviation of the averages, cells; 2 or 4.
    signed, unsigned : float
        Mean difference, and root mean square difference, at which it has half the weight, cells.
    """

    size: int
    signed: float
    unsigned: float


# Both limits lie above what a staircase causes and below what a lost shape causes. Measured at 20 steps, in cells;
# 95 % of the surface is below these values of the mean difference and the root mean square:
#
#                               outer, of 4 cells       inner, of 2 cells
#   planes, in five directions  0.05, 0.16              0.06, 0.40        the rest of the staircase: stay
#   wall 5 cells thick          0.07, 0.12              0.05, 0.37        whole in the strong filter: stay
#   ball of radius 10           1.2,  1.6               0.19, 0.34        too strong, the middle one is right
#   edge of 90°                 0.47, 1.25              0.12, 0.52        the middle one, and a little of the mild
#   wall 3 cells thick          3.7,  3.8               2.2,  2.4         gone in both: the mild one
OUTER_GATE = Gate(size=4, signed=0.05, unsigned=0.2)  # from the strong to the middle filter
INNER_GATE = Gate(size=2, signed=0.3, unsigned=0.7)  # from there to the mild one


NOISE_SIZE = 2  # cells: noise is what alternates over this distance
MIN_WEIGHT_SHARE = 0.3  # of the largest weight: cells above it are near enough to the surface to measure noise
QUIET_QUANTILE = 0.25  # quantile of the variance in those cells: edges are not noise, and may fill the rest


@dataclass(frozen=True, kw_only=True)
class ExactDataLimits:
    """Limits by which exact data hold the surface.

    Parameters
    ----------
    noise : float
        Standard deviation of the noise in the data, cells.
    """

    noise: float

    @property
    def gate(self) -> Gate:
        """Deviations from the data at which data and filtered field have half the weight each.

        Noise averages out in the mean, so that its limit grows less than that of the root mean square.

        Measured on boxes of 40 and 100 cells and on balls with noise of 0, 0.06, 0.15 and 0.3 cells: faces of boxes lie
        within 0.01 cells of their place, and 30 % of the noise remains.
        """
        return Gate(size=2, signed=0.02 + 0.25 * self.noise, unsigned=0.12 + 2 * self.noise)

    @property
    def bound(self) -> float:
        """Largest distance that the surface may move, cells."""
        return max(0.25, 3 * self.noise)


def estimate_noise(weight: NDArray[np.floating], mean: NDArray[np.floating], square: NDArray[np.floating]) -> float:
    """Estimate the noise of exact data, cells: the deviation of P_0 from their surface in quiet places.

    Parameters
    ----------
    weight, mean, square : float
        <w>, <w r> and <w r²> of `blend_by_gate`, with r the change by P_0, cells. Where an edge or a wall recedes, r
        has one sign: this is not noise, and is subtracted.
    """
    near_surface = weight > MIN_WEIGHT_SHARE * max(float(weight.max(initial=0.0)), TINY_WEIGHT)
    if not near_surface.any():
        return 0.0
    local_mean = mean[near_surface] / weight[near_surface]
    return float(
        np.sqrt(
            np.quantile(np.maximum(square[near_surface] / weight[near_surface] - local_mean**2, 0.0), QUIET_QUANTILE)
        )
    )


def refine_bricks(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    exact: bool = False,
    core: Core | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> SparseField:
    """Return a refined distance from the surface in bricks: 0 on the surface, +-1 from about 4 cells away.

    Parameters
    ----------
    f : up to three axes
        bool, True solid; or numbers in [-1, 1].
    smoothing : Smoothing
        `steps` sets the reach: that of plain smoothing with this number of steps. 65 / 20 times as many are done.
        Fidelity is ignored: the gates take its place.
    spacing : float or one per axis, mm
        Averages are taken over cells, and distances measured in units of the shortest cell side.
    exact : bool
        The data are distances from the surface themselves, put on the profile of the equation: `phase_from_distance`.
    core : (low, high), optional
        The bricks, from `low` up to but without `high`, in which the field is needed, and in the cells beside them.
        Only bricks that decide it are smoothed, as many steps as they do, and some with wrong values are returned. Not
        with exact data.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    progress : callable, optional
        Called before each step with the share of steps done.

    Returns
    -------
    SparseField
        Of distances, artanh phi / artanh 0.995, not of phi: `profile.REFINED_PROFILE` converts them to phi.

    Raises
    ------
    ParameterError
        For fewer than 4 steps.

    Notes
    -----
    The averages of the gates are taken on a coarse lattice within the bricks, with the variance of the Gaussians of
    `refine_reference`; results therefore differ from it by about 0.01 cells rms where the data are rough, and half
    as much between one placement of the data on the lattice and another. While it runs, the bricks take about three
    times the memory of `infill.phasefield.sparse.smooth_bricks`.
    """
    threads = thread_count(threads)
    mild, middle, strong = filter_bricks(f, smoothing, spacing=spacing, core=core, threads=threads, progress=progress)
    result = replace(strong, values=REFINED_PROFILE.distance(strong.values, threads=threads))
    unit = cut_off_distance(smoothing.interface)
    for milder, limits in ((middle, OUTER_GATE), (mild, INNER_GATE)):
        _blend_by_gate(result, milder.values, limits, unit, threads)
    if exact:
        _hold_to_data(result, mild.values, unit, threads)
    return result


def refined_reach(steps: int) -> int:
    """Return how many cells beyond a brick the data decide the last bits of its refined field, exact data aside.

    The gates look `GATE_REACH` cells far. There, the field after every step counts, and so does the step at which a
    brick begins to be kept: its neighbour's face shows it, one cell further and one step before.

    >>> refined_reach(20)
    81
    """
    return Schedule.of(steps).last + GATE_REACH


def _hold_to_data(result: SparseField, mild: Field, unit: float, threads: int) -> None:
    """Clamp the result to exact data, in place, within `ExactDataLimits` for the noise of `mild`, P_0."""
    data = np.asarray(result.data, dtype=np.float32)
    distance, mild_distance = (
        REFINED_PROFILE.distance(field, threads=threads).reshape(-1, CELLS) for field in (data, mild)
    )
    noise = _gate_averages(result, mild_distance, distance, data, NOISE_SIZE, unit, threads)
    exact = ExactDataLimits(noise=estimate_noise(noise[:, 0], noise[:, 1], noise[:, 2]))
    _blend_by_gate(result, data, exact.gate, unit, threads)
    in_threads(kernels.clamp_to_data, result.values.reshape(-1, CELLS), distance, exact.bound / unit, threads=threads)


def phase_from_distance(
    distance: NDArray[np.floating], interface: float, *, out: Field | None = None, threads: int | None = None
) -> Field:
    """Convert distances in cells to the phase field whose surface does not move: +-1 beyond the cut-off.

    The field is written to `out`, if given, which may be the distances.

    >>> phase_from_distance(np.array([-9, 0, 2, 9]), 2.0).round(2).tolist()
    [-1.0, 0.0, 0.8999999761581421, 1.0]
    """
    return REFINED_PROFILE.phase(distance, unit=cut_off_distance(interface), out=out, threads=threads)


def cut_off_distance(interface: float) -> float:
    """Return the distance from the surface beyond which the field stays at -1 or 1, cells."""
    return REFINED_PROFILE.scale * interface / STEEPNESS


def filter_bricks(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    core: Core | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> tuple[SparseField, SparseField, SparseField]:
    """Filter data mildly, more, and strongly: P_0, P_1 and P_2, which share all arrays except their values.

    For parameters, see `refine_bricks`.
    """
    threads = thread_count(threads)
    schedule = Schedule.of(smoothing.steps)
    numbers = step_coefficients(smoothing, spacing, f.ndim)
    data, state = brick_states(on_three_axes(f), threads)
    bricks = Bricks.around(state, data, threads)
    bricks.gather(data, data)
    previous, known_count = bricks.phi[: bricks.count].copy(), bricks.count
    sums = [_WeightedSum(weights) for weights in schedule.weights]
    needed = np.empty(0, dtype=np.int64)
    for k in range(schedule.last):
        if progress is not None:
            progress(k / schedule.last)
        bricks.activate()
        previous, known_count = _extend_to_new_bricks(previous, known_count, bricks), bricks.count
        if len(needed) < bricks.count:
            needed = _needed_steps(bricks, core, schedule.last)
        _step(bricks, previous, numbers, schedule.momentum(k), k, needed)
        for weighted_sum in sums:
            weighted_sum.add(bricks, k + 1)
    del previous
    shape = data.shape
    chosen: slice | NDArray[np.int64] = slice(bricks.count)
    slots = bricks.slots
    if core is not None:
        chosen = near = np.flatnonzero(_needed_steps(bricks, core, schedule.last) == schedule.last)
        slots = np.where(slots >= 0, VOID_BRICK, slots)
        slots[tuple(bricks.where[near].T)] = np.arange(len(near), dtype=np.int32)
    field = SparseField(
        shape=(shape[0], shape[1], shape[2]),
        slots=slots,
        where=bricks.where[chosen],
        values=np.empty((0, *BRICK), dtype=np.float32),
        data=bricks.held[chosen].reshape(-1, *BRICK),
    )
    mild, middle, strong = (
        replace(field, values=weighted_sum.whole(bricks)[chosen].reshape(-1, *BRICK)) for weighted_sum in sums
    )
    return mild, middle, strong


def _needed_steps(bricks: Bricks, core: Core | None, last: int) -> NDArray[np.int64]:
    """Return the number of steps, of `last`, after which no cell of a brick can reach the gates of the core, (n,).

    A step carries a change to the six cells beside one, so that the distance is the sum of those along the axes.
    """
    if core is None:
        return np.full(bricks.count, last, dtype=np.int64)
    size, (low, high) = np.array(BRICK), core
    first = bricks.where[: bricks.count].astype(np.int64) * size
    begin, end = np.array(low) * size - GATE_REACH, np.array(high) * size + GATE_REACH  # brick by brick
    gap = np.maximum(begin - (first + size - 1), 0) + np.maximum(first - (end - 1), 0)
    needed: NDArray[np.int64] = last - gap.sum(axis=1)
    return needed


class _WeightedSum:
    """A weighted sum of the fields after certain steps, for the bricks that exist so far."""

    def __init__(self, weights: dict[int, float]) -> None:
        self.weights, self.so_far = weights, 0.0
        self.total: Field = np.empty((0, CELLS), dtype=np.float32)

    def add(self, bricks: Bricks, step: int) -> None:
        """Add the field if the sum includes this step."""
        if step in self.weights:
            self._add(bricks, self.weights[step])

    def whole(self, bricks: Bricks) -> Field:
        """Return the sum for all bricks, including those that were added later."""
        if len(self.total) < bricks.count:
            self._add(bricks, 0.0)
        return self.total

    def _add(self, bricks: Bricks, weight: float) -> None:
        """Add the field of all bricks, times a weight, to the sum; bricks may be more than before."""
        known_count = len(self.total)
        if known_count < bricks.count:
            larger = np.empty((bricks.count, CELLS), dtype=np.float32)
            larger[:known_count] = self.total
            self.total = larger
        in_threads(
            kernels.add_snapshot,
            bricks.phi,
            bricks.held,
            self.total,
            np.float32(weight),
            known_count,
            np.float32(self.so_far),
            bricks.count,
            threads=bricks.threads,
        )
        self.so_far += weight


def _extend_to_new_bricks(previous: Field, known_count: int, bricks: Bricks) -> Field:
    """Extend the last but one field to the new bricks, in which it equals the data."""
    if len(previous) < bricks.count:
        larger = np.empty((bricks.capacity(LATER_GROWTH), CELLS), dtype=np.float32)
        larger[:known_count] = previous[:known_count]
        previous = larger
    previous[known_count : bricks.count] = bricks.held[known_count : bricks.count]
    return previous


def _step(
    bricks: Bricks,
    previous: Field,
    numbers: StepCoefficients,
    momentum: float,
    number: int,
    needed: NDArray[np.int64],
) -> None:
    """Do a step in place, in the bricks that need it; `previous` receives the old field."""
    in_threads(
        kernels.step,
        bricks.phi,
        previous,
        bricks.faces,
        bricks.next_faces,
        bricks.flat,
        bricks.next_flat,
        bricks.rows,
        bricks.next_rows,
        bricks.beside,
        bricks.where,
        bricks.count,
        numbers,
        np.float32(momentum),
        bricks.shape,
        number,
        needed,
        threads=bricks.threads,
    )
    bricks.swap()


def _gate_averages(
    bricks: SparseField, below: Field, above: Field, phase: Field, size: int, unit: float, threads: int
) -> NDArray[np.float32]:
    """Return <w>, <w r> and <w r²> of `blend_by_gate` on coarse cells; `phase` is the field at distance `above`."""
    sums = np.empty((len(bricks.values), kernels.SUMS, *(count // size for count in BRICK)), dtype=np.float32)
    in_threads(
        kernels.average,
        below,
        above,
        phase.reshape(-1, CELLS),
        np.float32(unit),
        size,
        sums,
        threads=threads,
    )
    blurred = np.empty_like(sums)
    in_threads(kernels.blur, sums, bricks.slots, bricks.where, blurred, threads=threads)
    return blurred


def _blend_by_gate(result: SparseField, phase: Field, gate_limits: Gate, unit: float, threads: int) -> None:
    """Blend two fields by `blend_by_gate`, in place, with averages from coarse cells; `phase` is the milder one."""
    below, above = result.values.reshape(-1, CELLS), REFINED_PROFILE.distance(phase, threads=threads).reshape(-1, CELLS)
    blurred = _gate_averages(result, below, above, phase, gate_limits.size, unit, threads)
    in_threads(
        kernels.blend,
        below,
        above,
        blurred,
        result.slots,
        result.where,
        result.shape,
        np.float32(gate_limits.signed),
        np.float32(gate_limits.unsigned),
        np.float32(TINY_WEIGHT),
        threads=threads,
    )


def filter_reference(
    f: NDArray[np.generic], smoothing: Smoothing, *, spacing: float | tuple[float, ...] = 1.0
) -> tuple[NDArray[np.float64], ...]:
    """Return P_0, P_1 and P_2 in float64: the reference that `filter_bricks` is tested against."""
    schedule = Schedule.of(smoothing.steps)
    phi = f.astype(np.float64)
    weights, decay = smoothing.weights(spacing_of(spacing, phi.ndim)), smoothing.decay
    previous, totals = phi, [np.zeros_like(phi) for _ in schedule.weights]
    for k in range(schedule.last):
        v = diffuse(phi, weights) + schedule.momentum(k) * (phi - previous)
        previous, phi = phi, react(v, decay)
        for total, shares in zip(totals, schedule.weights, strict=True):
            total += shares.get(k + 1, 0.0) * phi
    return tuple(totals)


def blend_by_gate(
    low: NDArray[np.float64], high: NDArray[np.float64], weight: NDArray[np.float64], limits: Gate
) -> NDArray[np.float64]:
    """Return low + g r, r = high - low, with g near 1 where the milder field `high` is right.

        g = max(<r>^4 / (<r>^4 + signed^4), <r²>^4 / (<r²>^4 + unsigned^8))

    <.> is the average over a Gaussian of `size` cells, weighted by nearness to the surface. A staircase averages
    out in <r>, and its <r²> is small; a rounded edge or a wall that melts away has neither property.

    Parameters
    ----------
    low, high : float64
        Distances from the surface, cells.
    weight : float64
        1 - phi² of the milder field.
    limits : Gate
    """
    r = high - low

    total_weight, mean, square = gaussian_averages(r, weight, limits.size)
    total_weight = total_weight + TINY_WEIGHT
    signed_power, unsigned_power = (mean / total_weight) ** 4, (square / total_weight) ** 4
    share = np.maximum(
        signed_power / (signed_power + limits.signed**4), unsigned_power / (unsigned_power + limits.unsigned**8)
    )
    blended: NDArray[np.float64] = low + share * r
    return blended


def gaussian_averages(
    r: NDArray[np.float64], weight: NDArray[np.float64], size: int
) -> tuple[NDArray[np.float64], ...]:
    """Return <w>, <w r> and <w r²>, averages over a Gaussian of `size` cells: see `blend_by_gate`."""
    from scipy.ndimage import gaussian_filter

    return tuple(
        gaussian_filter(values, size, mode="nearest", truncate=3) for values in (weight, weight * r, weight * r**2)
    )


def refine_reference(
    f: NDArray[Any], smoothing: Smoothing, *, spacing: float | tuple[float, ...] = 1.0, exact: bool = False
) -> NDArray[np.float64]:
    """Return the refined distance in float64, +-1 far away: the specification of `refine_bricks`."""
    fields = [np.clip(field, -1, 1) for field in filter_reference(f, smoothing, spacing=spacing)]
    unit = cut_off_distance(smoothing.interface)
    mild, middle, strong = (
        np.arctanh(np.clip(field, -REFINED_PROFILE.steepest, REFINED_PROFILE.steepest)) * (unit / REFINED_PROFILE.scale)
        for field in fields
    )
    blended = blend_by_gate(strong, middle, 1 - fields[1] ** 2, OUTER_GATE)
    blended = blend_by_gate(blended, mild, 1 - fields[0] ** 2, INNER_GATE)
    if exact:
        f = f.astype(np.float64)
        data = np.arctanh(np.clip(f, -REFINED_PROFILE.steepest, REFINED_PROFILE.steepest)) * (
            unit / REFINED_PROFILE.scale
        )
        exact_limits = ExactDataLimits(noise=estimate_noise(*gaussian_averages(data - mild, 1 - f**2, NOISE_SIZE)))
        blended = blend_by_gate(blended, data, 1 - f**2, exact_limits.gate)
        blended = np.where(f < 1, np.minimum(blended, data + exact_limits.bound), blended)
        blended = np.where(f > -1, np.maximum(blended, data - exact_limits.bound), blended)
    return blended / unit
