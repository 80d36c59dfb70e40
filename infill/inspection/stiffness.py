"""Stiffness of a pattern that repeats in space: homogenised by finite elements, one to a voxel.

The mean strain is given, the displacement that repeats from cell to cell is solved for, and its energy is that of the
equivalent uniform material. Elements are cubes with a node at each corner; void has none.

Source: Andreassen & Andreasen, "How to determine composite material properties using numerical homogenization",
Computational Materials Science 83 (2014) 488-495.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from infill.errors import ParameterError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_array

CORNERS = np.array(list(product((0, 1), repeat=3)))  # of an element, and its nodes in this order
SHEARS = ((1, 2), (0, 2), (0, 1))  # in Voigt's order after xx, yy and zz
ACCURACY = 1e-6  # of the solution, as a share of the load
STEPS = 600  # of conjugate gradients, of which stout cells take about a hundred
LARGEST = 60_000  # unknowns of a matrix that is factored
SHIFT = 1e-10  # of the diagonal: what makes the matrix regular
LEAST = 1e-9  # of the solid's modulus: loose pieces have at least this stiffness


@dataclass(frozen=True)
class Stiffness:
    """The elasticity (6, 6) of a cell, in Voigt's order with engineering shear, as shares of the solid's modulus."""

    matrix: NDArray[np.float64]

    def modulus(self, directions: ArrayLike) -> NDArray[np.float64]:
        """Return Young's modulus along directions (N, 3), as shares of the solid's: (N,)."""
        along = np.atleast_2d(np.asarray(directions, dtype=np.float64))
        along = along / np.linalg.norm(along, axis=1, keepdims=True)
        stress = np.hstack([along**2, *(along[:, [i]] * along[:, [j]] for i, j in SHEARS)])
        compliance = np.linalg.inv(self.matrix + LEAST * np.eye(6))
        moduli: NDArray[np.float64] = 1 / np.einsum("ni,ij,nj->n", stress, compliance, stress)
        return moduli

    def extremes(self, count: int = 2000) -> tuple[float, float]:
        """Return the lowest and the highest modulus over directions, evenly spread over half a sphere."""
        z = (np.arange(count) + 0.5) / count
        turn = np.arange(count) * np.pi * (3 - np.sqrt(5))
        flat = np.sqrt(1 - z**2)
        directions = np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=-1)
        moduli = self.modulus(np.concatenate([directions, np.eye(3)]))
        return float(moduli.min()), float(moduli.max())


def homogenise_stiffness(solid: ArrayLike, poisson: float = 0.3) -> Stiffness:
    """Compute the stiffness of a cell that repeats along x, y and z.

    Parameters
    ----------
    solid : (nx, ny, nz) bool
        Cubic voxels, some of them solid.
    poisson : float
        Poisson's ratio of the solid, from 0 to 0.49.

    Raises
    ------
    ParameterError
        If the array does not have three axes, nothing is solid, or Poisson's ratio is out of range.

    >>> import numpy as np
    >>> layers = np.zeros((4, 4, 4), dtype=bool)
    >>> layers[:, :, :2] = True
    >>> homogenise_stiffness(layers).modulus([(1, 0, 0)]).round(4).tolist()
    [0.5]
    """
    from scipy.sparse import coo_array

    voxels = np.asarray(solid, dtype=bool)
    if voxels.ndim != 3 or not voxels.any():
        raise ParameterError(f"solid has shape {voxels.shape}; give an array of three axes, of which some is solid")
    if not 0 <= poisson <= 0.49:
        raise ParameterError(f"poisson is {poisson}; it must be from 0 to 0.49")
    element, unit_displacements = _element_matrices(poisson)
    # Only nodes at the corners of solid voxels are free; nodes at opposite faces of the cell are the same.
    places = np.argwhere(voxels)[:, None] + CORNERS
    names = np.ravel_multi_index(tuple(np.moveaxis(places % voxels.shape, -1, 0)), voxels.shape)
    nodes, names = np.unique(names, return_inverse=True)
    free = (3 * names.reshape(-1, 8, 1) + np.arange(3)).reshape(-1, 24)
    size = 3 * len(nodes)
    rows, columns = np.repeat(free, 24, axis=1).ravel(), np.tile(free, (1, 24)).ravel()
    matrix = coo_array((np.tile(element.ravel(), len(free)), (rows, columns)), shape=(size, size)).tocsr()
    loads = np.stack(
        [
            np.bincount(free.ravel(), weights=np.tile(element @ strain, len(free)), minlength=size)
            for strain in unit_displacements.T
        ],
        axis=1,
        dtype=np.float64,
    )
    displacements = unit_displacements - _solve(matrix, loads)[free]
    return Stiffness(
        matrix=np.einsum("eai,ab,ebj->ij", displacements, element, displacements, optimize=True) / voxels.size
    )


def _solve(matrix: csr_array, loads: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solve the singular system for the loads (N, 6), which are in balance on every piece, though pieces may float.

    Conjugate gradients are fast in stout cells. In slender ones, whose bars bend, they take thousands of steps: there
    a factor of the matrix, shifted by a little, is small, and two corrections take the error of the shift out. Of
    a matrix that is too large for that, conjugate gradients go on for as long as it is worth.
    """
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import LinearOperator, cg, splu

    diagonal, size = matrix.diagonal(), matrix.shape[0]
    is_large = size > LARGEST
    steps = 20 * int(size ** (1 / 2)) + 1000 if is_large else STEPS
    scaled = LinearOperator(matrix.shape, matvec=lambda vector: vector / diagonal)
    solution = np.empty_like(loads)
    for case, load in enumerate(loads.T):
        solution[:, case], failed = cg(matrix, load, rtol=ACCURACY, maxiter=steps, M=scaled)
        if failed and not is_large:
            break
    else:
        return solution
    factor = splu(
        (matrix + diags_array(SHIFT * diagonal)).tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    solution = factor.solve(loads)
    for _ in range(2):
        solution += factor.solve(loads - matrix @ solution)
    return solution


def _element_matrices(poisson: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the stiffness (24, 24) of a unit cube of modulus 1, and the displacements (24, 6) of unit strains."""
    lame_lambda, shear_modulus = poisson / ((1 + poisson) * (1 - 2 * poisson)), 1 / (2 * (1 + poisson))
    law = np.zeros((6, 6))
    law[:3, :3] = lame_lambda
    law += shear_modulus * np.diag([2, 2, 2, 1, 1, 1])
    element = np.zeros((24, 24))
    signs = 2 * CORNERS - 1
    for point in product((-1, 1), repeat=3):
        gauss_point = np.array(point) / np.sqrt(3)
        terms = 1 + signs * gauss_point
        slopes = np.stack([signs[:, k] * np.delete(terms, k, axis=1).prod(axis=1) / 4 for k in range(3)])  # d/dx, N
        strains = np.zeros((6, 8, 3))
        for axis in range(3):
            strains[axis, :, axis] = slopes[axis]
        for row, (i, j) in enumerate(SHEARS, start=3):
            strains[row, :, i], strains[row, :, j] = slopes[j], slopes[i]
        flat = strains.reshape(6, 24)
        element += flat.T @ law @ flat / 8
    displacements = np.zeros((8, 3, 6))
    for axis in range(3):
        displacements[:, axis, axis] = CORNERS[:, axis]
    for case, (i, j) in enumerate(SHEARS, start=3):
        displacements[:, i, case], displacements[:, j, case] = CORNERS[:, j] / 2, CORNERS[:, i] / 2
    return element, displacements.reshape(24, 6)
