"""The modified Allen-Cahn equation and its operator-splitting scheme: the specification.

    phi_t = -F'(phi) / eps^2 + Laplace(phi) + lam (f - phi),   F(phi) = (phi^2 - 1)^2 / 4      (3)

Source: Wang, Li, Choi, Lee, Kim, "Fast and accurate smoothing method using a modified Allen-Cahn
equation", Computer-Aided Design 120 (2020) 102804. Numbers in brackets are its equations.

This form is written for reading, in float64. Every faster kernel is tested against it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.checks import check_positive, check_range, check_whole_number
from infill.errors import ParameterError
from infill.grid import spacing_of
from infill.plain_numbers import plain_argument

# Within these ranges no kernel divides 0 by 0, not even in 32 bits.
PARAMETER_RANGES = {"fidelity": (0.0, 1e6), "interface": (0.25, 1e3), "alpha": (1e-4, 1.0)}
STEEPNESS = math.atanh(0.9)  # the interface is measured from the surface to phi = 0.9


@dataclass(frozen=True, kw_only=True)
class Smoothing:
    """How strongly to smooth, in units of cells, so that the unit of length does not matter.

    Parameters
    ----------
    steps : int
        Number of time steps. The paper takes 5 for 2D shapes, 10 for patterns, 20 for complex
        models, 30 for medical data. n steps blur about as far as a Gaussian of sqrt(2 n / 7)
        cells: a wall 3 cells thick keeps a width of 2.83 after 10 steps and is gone after 30;
        one of 5 cells keeps 4.95 after 30.
    fidelity : float
        lam h^2: how strongly the data hold the field. 0.01 (the paper's lam = 100 at h = 0.01) is weak;
        1 keeps a wall of 3 cells for ever, and the staircase with it.
    interface : float
        m: cells from the surface to phi = 0.9, eps = m h / (sqrt(2) artanh 0.9).
    alpha : float
        Time step over h^2. Explicit diffusion is stable up to 1/4 in 2D and 1/6 in 3D.

    Raises
    ------
    ParameterError
        If a number is out of range.

    >>> round(Smoothing.paper(lam=100, h=0.1).fidelity, 12)
    1.0
    """

    steps: int = 10
    fidelity: float = 0.01
    interface: float = 2.0
    alpha: float = 1 / 7

    def __post_init__(self) -> None:
        """Check the ranges that do not depend on the data, and convert to plain numbers."""
        object.__setattr__(self, "steps", check_whole_number("steps", self.steps, 0))
        for name, (low, high) in PARAMETER_RANGES.items():
            object.__setattr__(self, name, check_range(name, getattr(self, name), low, high))

    @classmethod
    def paper(cls, lam: float = 100, h: float = 0.01, m: float = 2, alpha: float = 1 / 7, steps: int = 10) -> Smoothing:
        """Return the same smoothing from the paper's lambda, cell size h and interface width m."""
        return cls(steps=steps, fidelity=lam * check_positive("h", h) ** 2, interface=m, alpha=alpha)

    @property
    def decay(self) -> float:
        """E = exp(-2 dt / eps^2) of the reaction step (8)."""
        return math.exp(-4 * self.alpha * (STEEPNESS / self.interface) ** 2)

    @property
    def pull(self) -> float:
        """Lam dt of the fidelity step (10)."""
        return self.alpha * self.fidelity

    @property
    def blur(self) -> float:
        """Standard deviation, in cells, of the Gaussian that equals the diffusion of all steps."""
        return math.sqrt(2 * self.alpha * self.steps)

    def weights(self, spacing: tuple[float, ...]) -> tuple[float, ...]:
        """Return dt / h_axis^2 for each axis, with dt = alpha h_min^2.

        Raises
        ------
        ParameterError
            Above the stability limit of the explicit step: 2 sum(weights) <= 1.
        """
        smallest = min(spacing)
        shares = [(smallest / cell_size) ** 2 for cell_size in spacing]
        limit = 1 / (2 * sum(shares))
        if self.alpha > limit * (1 + 1e-12):
            raise ParameterError.about(
                "alpha",
                f"is {plain_argument(self.alpha)}, the time step over h²; explicit diffusion is stable up to "
                f"{plain_argument(limit)} on this {len(spacing)}D grid; lower alpha",
            )
        return tuple(self.alpha * share for share in shares)


def as_phase_field(data: ArrayLike, name: str = "the data") -> NDArray[np.generic]:
    """Return `data` as an array of numbers in [-1, 1]; False and True become -1 and +1, 0 and 1 stay as they are.

    Raises
    ------
    ParameterError
        If the array is empty, or a value is not a number in [-1, 1].
    """
    field = np.asarray(data)
    if field.dtype == bool:
        field = np.where(field, np.int8(1), np.int8(-1))
    if field.size == 0 or field.ndim == 0:
        raise ParameterError.about(name, "has no cells; give an array with at least one cell on each of its axes")
    if not (np.issubdtype(field.dtype, np.integer) or np.issubdtype(field.dtype, np.floating)):
        raise ParameterError.about(name, f"is of type {field.dtype}; give real numbers or booleans")
    low, high = field.min(), field.max()
    if np.isnan(low):
        raise ParameterError.about(name, "holds NaN; fill or cut those cells first")
    if not (low >= -1 and high <= 1):
        raise ParameterError(
            f"{name} ranges from {plain_argument(low)} to {plain_argument(high)}; scale it to [-1, 1] first: "
            "rescale(data), Eq. (2)"
        )
    return field


def rescale(data: ArrayLike) -> NDArray[np.float64]:
    """Return f = (2 psi - max - min) / (max - min), in [-1, 1] (2).

    >>> rescale([0, 5, 10]).tolist()
    [-1.0, 0.0, 1.0]
    """
    psi = np.asarray(data, dtype=np.float64)
    low, high = (psi.min(), psi.max()) if psi.size else (math.nan, math.nan)
    if not high > low or not math.isfinite(high - low):
        raise ParameterError(
            f"the data range from {plain_argument(low)} to {plain_argument(high)}; there must be two different finite "
            "values"
        )
    return ((psi - low) - (high - psi)) / (high - low)  # no sum that could overflow


def laplacian(
    phi: NDArray[np.float64], weights: tuple[float, ...], mask: NDArray[np.bool_] | None = None
) -> NDArray[np.float64]:
    """Return the sum over axes of weight times second difference, zero Neumann at every edge (7, 11).

    Parameters
    ----------
    phi : (...) float64
    weights : one float per axis
        dt / h_axis^2.
    mask : (...) bool, optional
        The domain. No flux crosses its boundary, just as none crosses the edge of the grid.
    """
    change = np.zeros_like(phi)
    for axis, weight in enumerate(weights):
        low, high = (
            tuple(side if a == axis else slice(None) for a in range(phi.ndim))
            for side in (slice(None, -1), slice(1, None))
        )
        flux = weight * (phi[high] - phi[low])
        if mask is not None:
            flux = np.where(mask[high] & mask[low], flux, 0)
        change[low] += flux
        change[high] -= flux
    return change


def diffuse(
    phi: NDArray[np.float64], weights: tuple[float, ...], mask: NDArray[np.bool_] | None = None
) -> NDArray[np.float64]:
    """Return phi after phi_t = Laplace(phi) for one time step, explicitly (7, 11)."""
    return phi + laplacian(phi, weights, mask)


def react(phi: NDArray[np.float64], decay: float) -> NDArray[np.float64]:
    """Return phi after phi_t = -F'(phi) / eps^2 for one time step, exactly, with E = `decay` (8, 12).

    >>> react(np.array([-1.0, -0.5, 0, 0.5, 1]), decay=0.8).round(3).tolist()
    [-1.0, -0.542, 0.0, 0.542, 1.0]
    """
    return phi / np.sqrt(decay + phi**2 * (1 - decay))


def apply_fidelity(phi: NDArray[np.float64], f: NDArray[np.float64], pull: float) -> NDArray[np.float64]:
    """Return phi after phi_t = lam (f - phi) for one time step, implicitly, with lam dt = `pull` (10, 14).

    Alone, n such steps leave (1 + lam dt)^-n of the difference from the data.
    """
    return (phi + pull * f) / (1 + pull)


def step(
    phi: NDArray[np.float64],
    f: NDArray[np.float64],
    smoothing: Smoothing,
    weights: tuple[float, ...],
    mask: NDArray[np.bool_] | None = None,
) -> NDArray[np.float64]:
    """Return phi after one time step: diffusion in the mask (7, 11); everywhere reaction (8, 12), fidelity (10, 14)."""
    return apply_fidelity(react(diffuse(phi, weights, mask), smoothing.decay), f, smoothing.pull)


def smooth_reference(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> NDArray[np.float64]:
    """Return phi after all steps, in float64; cells outside the mask keep their initial values."""
    data = f.astype(np.float64)
    start = data if initial is None else initial.astype(np.float64)
    weights = smoothing.weights(spacing_of(spacing, data.ndim))
    phi = start
    for _ in range(smoothing.steps):
        phi = step(phi, data, smoothing, weights, mask)
    return phi.copy() if mask is None else np.where(mask, phi, start)
