"""The profile across a surface: phi is a tanh of the distance, so artanh phi is the distance itself.

Marching cubes interpolates linearly between cell centres. For a tanh that is wrong, for artanh phi it is
right, which halves the error of the normals. Far from the surface phi is +-1 and its artanh infinite, so it is
cut off at `steepest` and scaled to [-1, 1] there:

    d = artanh(phi) / artanh(steepest)
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.kernels.threads import in_threads, thread_count

CELLS_AT_ONCE = 1 << 15  # cells, which stay in the cache of a processor from one step to the next


@dataclass(frozen=True)
class Profile:
    """A scaled distance from the surface.

    Parameters
    ----------
    steepest : float
        The value of phi beyond which the distance is cut off.

    >>> round(PLAIN_PROFILE.phase_level(PLAIN_PROFILE.distance_level(0.5)), 12)
    0.5
    """

    steepest: float

    @cached_property
    def scale(self) -> float:
        """Return artanh of the steepest phi: the distance that 1 represents, in units of the tanh."""
        return math.atanh(self.steepest)

    def phase_level(self, level: float) -> float:
        """Return the level of phi that corresponds to a level of distance."""
        return math.tanh(level * self.scale)

    def distance_level(self, level: float) -> float:
        """Return the distance at a level of phi, over the cut-off distance; a level within `steepest`, unchecked."""
        return math.atanh(level) / self.scale

    def phase(
        self,
        distance: NDArray[np.floating],
        *,
        unit: float = 1.0,
        out: Field | None = None,
        threads: int | None = None,
    ) -> Field:
        """Return phi for distances in units of the cut-off distance, +-1 beyond it.

        Parameters
        ----------
        distance : (...) float
        unit : float
            Divisor of the distances.
        out : (...) float32, contiguous, optional
            Array that receives phi; it may be `distance`.
        threads : int, optional
            See `infill.kernels.threads.thread_count`.

        >>> REFINED_PROFILE.phase(np.array([-2, 0, 2]), unit=2).tolist()
        [-1.0, 0.0, 1.0]
        """
        flat_distance = np.asarray(distance).reshape(-1)
        flat_phase = np.empty(flat_distance.shape, dtype=np.float32) if out is None else out.reshape(-1)

        def fill(thread: int, threads: int) -> None:
            for begin in range(thread * CELLS_AT_ONCE, len(flat_distance), threads * CELLS_AT_ONCE):
                scaled, phi = (
                    (flat_distance[begin : begin + CELLS_AT_ONCE] / unit).astype(np.float32),
                    flat_phase[begin : begin + CELLS_AT_ONCE],
                )
                np.sign(scaled, out=phi)
                unsaturated = np.abs(scaled) < 1  # few cells of a grid
                if unsaturated.any():
                    phi[unsaturated] = np.tanh(scaled[unsaturated] * np.float32(self.scale))

        in_threads(fill, threads=thread_count(threads))
        return flat_phase.reshape(np.shape(distance))

    def distance(self, values: Field, *, out: Field | None = None, threads: int | None = None) -> Field:
        """Return distances for phi (...) float32, over the cut-off distance, in [-1, 1]; `out` may be `values`.

        The last three axes are bricks.
        """
        from infill.kernels import transfer
        from infill.kernels.sparse import CELLS

        out = np.empty_like(values) if out is None else out
        in_threads(
            transfer.artanh_of_values,
            values.reshape(-1, CELLS),
            np.float32(self.steepest),
            np.float32(self.scale),
            out.reshape(-1, CELLS),
            threads=thread_count(threads),
        )
        return out


PLAIN_PROFILE = Profile(0.9999)  # for plain smoothing: nearly all of the interface
REFINED_PROFILE = Profile(0.995)  # for refinement, whose gates compare distances: anything further away is simply +-1
