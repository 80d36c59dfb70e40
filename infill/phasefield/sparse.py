"""The compiled scheme on bricks around the surface only; no other cell can change.

Where phi = f = +-1 among equal neighbours, a cell is a fixed point to the last bit (see `infill.kernels.dense`). So
a brick in which that holds need not be kept, and a step touches a brick only once a neighbour's face has a different
value. The result equals that of the dense kernel to the last bit, and cost and memory grow with the surface.

The bricks lie on a lattice that begins one cell before the grid and ends at least one cell beyond it: this is where
the surface closes when the solid touches the edge of the grid. The extra cells repeat the value next to them, which
is the zero Neumann boundary condition.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.kernels import sparse as kernels
from infill.kernels import transfer as transfer_kernels
from infill.kernels.compiling import log_compilation
from infill.kernels.sparse import BRICK, CELLS, FACES, MASKS, MIXED, OUTER, OUTSIDE, SOLID_BRICK, VOID_BRICK
from infill.kernels.threads import in_threads, thread_count
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.dense import Data, StepCoefficients, on_three_axes, step_coefficients

# Room to reserve for bricks, relative to those there are: at first enough for one more layer on both sides of the
# surface, which 8 steps cannot cross; later half as much again, so that all copies together are at most three times
# the last one. It never exceeds the lattice: memory that was used before is not free of cost.
FIRST_GROWTH, LATER_GROWTH = 3.0, 1.5


@dataclass(frozen=True, kw_only=True)
class SparseField:
    """A phase field that keeps only the bricks around the surface.

    Parameters
    ----------
    shape : (n0, n1, n2)
        Cells of the grid.
    slots : (m0, m1, m2) int32
        The lattice of bricks: the number of a kept brick, else `VOID_BRICK`, `SOLID_BRICK` or `OUTSIDE`.
    where : (n, 3) int32
        Place on the lattice of each kept brick.
    values : (n, 8, 8, 16) float32
        The cells of the bricks; cell 0 of brick 0 lies one cell before the grid.
    data : (n, 8, 8, 16) int8 or float32
        The data before smoothing, in the same cells.
    """

    shape: tuple[int, int, int]
    slots: NDArray[np.int32]
    where: NDArray[np.int32]
    values: Field
    data: Data

    def gathered(self, whole: Field, *, threads: int | None = None) -> Field:
        """Gather the cells in bricks from a dense field (n0, n1, n2): (n, 8, 8, 16), like `values`."""
        cells = np.empty((len(self.where), CELLS), dtype=whole.dtype)
        count = thread_count(threads)
        in_threads(transfer_kernels.gather, _view_to_read(whole), self.where, cells, len(cells), None, threads=count)
        return cells.reshape(self.values.shape)

    def to_dense(self, *, threads: int | None = None) -> Field:
        """Return the whole field, (n0, n1, n2) float32."""
        count = thread_count(threads)
        dense = np.empty(self.shape, dtype=np.float32)
        in_threads(transfer_kernels.scatter, self.slots, self.values.reshape(-1, CELLS), dense, threads=count)
        return dense


def smooth_sparse(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> Field:
    """Smooth like `infill.phasefield.dense.smooth_dense`, identical to the last bit, on up to three axes.

    Grey data have surface everywhere: there it does the work of the dense kernel, with more overhead.
    """
    return smooth_bricks(f, smoothing, spacing=spacing, initial=initial, mask=mask).to_dense().reshape(f.shape)


@log_compilation("the smoother")
def smooth_bricks(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> SparseField:
    """Smooth a field in bricks, without ever allocating a dense one.

    Parameters
    ----------
    f : up to three axes
        bool, True solid; or numbers in [-1, 1]. Booleans, and int8 without zeros, are not copied.
    smoothing, spacing, initial, mask
        As in `infill.smooth`.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    progress : callable, optional
        Called before each step with the share of steps done.
    """
    threads = thread_count(threads)
    coefficients = step_coefficients(smoothing, spacing, f.ndim)
    data, state = brick_states(on_three_axes(f), threads)
    start = data
    if initial is not None:
        start = on_three_axes(initial).astype(np.float32)
        state = np.where(state == brick_states(start, threads)[1], state, MIXED)
    domain = None if mask is None else on_three_axes(mask)
    bricks = Bricks.around(state, data, threads)
    bricks.gather(start, data)
    for n in range(smoothing.steps):
        if progress is not None:
            progress(n / smoothing.steps)
        bricks.activate()
        bricks.step(coefficients, domain)
    shape = data.shape
    return SparseField(
        shape=(shape[0], shape[1], shape[2]),
        slots=bricks.slots,
        where=bricks.where[: bricks.count],
        values=bricks.phi[: bricks.count].reshape(-1, *BRICK),
        data=bricks.held[: bricks.count].reshape(-1, *BRICK),
    )


def _view_to_read(field: NDArray[Any]) -> NDArray[Any]:
    """Return a view that cannot be written to: kernels are compiled once, whether or not the array is writable."""
    view = field.view()
    view.flags.writeable = False
    return view


def brick_states(field: NDArray[np.generic], threads: int) -> tuple[Data, NDArray[np.int8]]:
    """Return the field in the type of the kernels, and the state of every brick: +1, -1, `MIXED` or `OUTER`."""
    if field.dtype == bool:
        data: Data = field.view(np.int8)
    elif np.issubdtype(field.dtype, np.integer):
        data = field.astype(np.int8, copy=False)
    else:
        data = field.astype(np.float32, copy=False)
    data = _view_to_read(data)
    lattice = tuple(math.ceil((count + 2) / size) for count, size in zip(data.shape, BRICK, strict=True))
    state = np.empty(lattice, dtype=np.int8)
    zeros = np.zeros(lattice[:2], dtype=bool)
    if data.dtype == np.int8:
        in_threads(transfer_kernels.fill_states, data, state, zeros, threads=threads)
        if zeros.any() and field.dtype != bool:  # integers between void and solid are grey
            return brick_states(data.astype(np.float32), threads)
    else:
        in_threads(transfer_kernels.fill_grey_states, data, state, threads=threads)
    return data, state


def kept_bricks(state: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Mark the bricks to keep before the first step: those that are mixed, or next to a brick of the other phase."""
    is_kept: NDArray[np.bool_] = state == MIXED
    for axis in range(3):
        low, high = (
            tuple(side if a == axis else slice(None) for a in range(3)) for side in (slice(None, -1), slice(1, None))
        )
        differs = state[low] * state[high] == -1
        is_kept[low] |= differs
        is_kept[high] |= differs
    return is_kept


class Bricks:
    """The bricks in use: their cells, their data, and copies of their faces before and after a step."""

    def __init__(self, slots: NDArray[np.int32], where: NDArray[np.int32], data: Data, threads: int) -> None:
        self.slots, self.count, self.shape, self.threads = slots, len(where), data.shape, threads
        self.where = where
        self.phi = np.empty((0, CELLS), dtype=np.float32)
        self.held: Data = np.empty((0, CELLS), dtype=data.dtype)
        self.faces, self.next_faces = (np.empty((0, FACES), dtype=np.float32) for _ in range(2))
        self.flat, self.next_flat = (np.empty((0, 6), dtype=np.int8) for _ in range(2))
        self.rows, self.next_rows = (np.empty((0, MASKS), dtype=np.uint64) for _ in range(2))
        self.still = np.empty((0, 2), dtype=np.uint64)  # the rows of the data that are +1, and -1, throughout
        self.beside = np.empty((0, 6), dtype=np.int32)
        self._grow(FIRST_GROWTH)
        kernels.find_neighbours(self.slots, self.where, self.beside, 0, self.count)

    @classmethod
    def around(cls, state: NDArray[np.int8], data: Data, threads: int) -> Bricks:
        """Allocate the bricks that are mixed or next to a brick of the other phase."""
        is_kept = kept_bricks(state)
        slots = np.full(state.shape, VOID_BRICK, dtype=np.int32)
        slots[state == 1] = SOLID_BRICK
        slots[state == OUTER] = OUTSIDE
        where = np.argwhere(is_kept).astype(np.int32)
        slots[is_kept] = np.arange(len(where))
        return cls(slots, where, data, threads)

    def gather(self, start: Data, data: Data) -> None:
        """Copy the cells of start and data, which may be the same array."""
        self._gather_into(data, self.held)
        if start is not data:
            self._gather_into(start, self.phi)
        in_threads(
            kernels.update_all_faces,
            self.phi,
            self.held,
            start is data,
            self.faces,
            self.flat,
            self.rows,
            self.next_rows,
            self.still,
            self.count,
            threads=self.threads,
        )

    def _gather_into(self, source: Data, bricks: Data) -> None:
        """Copy the cells of an array into the bricks that cover them."""
        level = 0 if source.dtype == np.int8 else None
        in_threads(transfer_kernels.gather, source, self.where, bricks, self.count, level, threads=self.threads)

    def activate(self) -> None:
        """Add the bricks next to faces of a different value."""
        candidates = np.empty((6 * self.count, 3), dtype=np.int32)
        places = candidates[
            : kernels.find_missing_bricks(self.slots, self.where, self.beside, self.flat, self.count, candidates)
        ]
        if len(places) == 0:
            return
        old_count, self.count = self.count, self.count + len(places)
        if self.count > len(self.phi):
            self._grow(LATER_GROWTH)
        self.where[old_count : self.count] = places
        values = np.where(self.slots[tuple(places.T)] == SOLID_BRICK, 1, -1).astype(np.int8)
        self.slots[tuple(places.T)] = np.arange(old_count, self.count)
        kernels.find_neighbours(self.slots, self.where, self.beside, old_count, self.count)
        in_threads(
            kernels.fill_bricks,
            self.phi,
            self.held,
            self.flat,
            self.next_flat,
            self.rows,
            self.next_rows,
            self.still,
            values,
            old_count,
            self.count,
            threads=self.threads,
        )

    def step(self, numbers: StepCoefficients, domain: NDArray[np.bool_] | None) -> None:
        """Do one step, in place."""
        in_threads(
            kernels.step,
            self.phi,
            self.held,
            self.faces,
            self.next_faces,
            self.flat,
            self.next_flat,
            self.rows,
            self.next_rows,
            self.still,
            self.beside,
            self.where,
            domain,
            self.count,
            numbers,
            self.shape,
            threads=self.threads,
        )
        self.swap()

    def swap(self) -> None:
        """Make the copies after a step those before the next one."""
        self.faces, self.next_faces = self.next_faces, self.faces
        self.flat, self.next_flat = self.next_flat, self.flat
        self.rows, self.next_rows = self.next_rows, self.rows

    def capacity(self, times: float) -> int:
        """Return the number of bricks to allocate: the present number times a factor, limited by the lattice."""
        return max(16, min(int(times * self.count), self.slots.size))

    def _grow(self, times: float) -> None:
        """Enlarge the arrays to the present number of bricks times a factor."""
        room = self.capacity(times)
        faces = ("faces", "next_faces", "flat", "next_flat", "rows", "next_rows")
        for name in ("phi", "held", *faces, "still", "beside", "where"):
            current = getattr(self, name)
            larger = np.empty((room, *current.shape[1:]), dtype=current.dtype)
            larger[: min(len(current), self.count)] = current[: self.count]
            setattr(self, name, larger)
