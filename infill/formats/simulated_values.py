"""Results of simulations: numbers at points, one for each, made of scalars, vectors or stresses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from infill.arrays import Floats
from infill.errors import FormatError, join_names
from infill.files.excerpts import excerpt

VECTOR, SYMMETRIC, TENSOR = 3, 6, 9  # components


@dataclass(frozen=True, kw_only=True, eq=False)
class SimulatedValues:
    """A number at each point of a simulated part.

    Parameters
    ----------
    points : (N, 3) float64
        In the unit of the file, which is mm for a part that is to be printed.
    values : (N,) float64
    """

    points: Floats
    values: Floats


def choose_array(path: Path, names: Sequence[str], requested: str | None) -> int:
    """Return the index of the named array, or of the only one.

    Raises
    ------
    FormatError
        If there is none, none of this name, or several and no name.
    """
    choices = ", ".join(repr(excerpt(name)) for name in dict.fromkeys(names))
    if requested is not None and requested in names:
        return len(names) - 1 - names[::-1].index(requested)  # the last step of several
    if not names:
        raise FormatError(f"{path} holds no array of numbers at its points or in its cells; save it with its results")
    if requested is not None:
        raise FormatError(f"{path} holds no array {excerpt(requested)!r}; choose from {choices}")
    if len(set(names)) > 1:
        raise FormatError(f"{path} holds several arrays: {choices}; choose one, such as {path}:{excerpt(names[0])}")
    return len(names) - 1


def reduce_components(path: Path, name: str, components: Floats) -> Floats:
    """Return one number for each row of components (N, C): (N,).

    A scalar is itself, a vector its length, and a tensor, such as a stress of xx, yy, zz, xy, yz, xz, the equivalent
    one of von Mises, sqrt(((sxx - syy)**2 + (syy - szz)**2 + (szz - sxx)**2) / 2 + 3 (sxy**2 + syz**2 + sxz**2)).
    """
    count = components.shape[1]
    if count == 1:
        return components[:, 0]
    if count == VECTOR:
        return np.asarray(np.sqrt((components**2).sum(axis=1)))
    if count in (SYMMETRIC, TENSOR):
        normal = components[:, [0, 4, 8]] if count == TENSOR else components[:, :3]
        # Of a whole tensor, the mean of the two components that are equal in a stress.
        shear = (components[:, [1, 5, 2]] + components[:, [3, 7, 6]]) / 2 if count == TENSOR else components[:, 3:]
        between = normal - np.roll(normal, -1, axis=1)
        return np.asarray(np.sqrt((between**2).sum(axis=1) / 2 + 3 * (shear**2).sum(axis=1)))
    sizes = join_names(("1", str(VECTOR), str(SYMMETRIC), str(TENSOR)))
    raise FormatError(f"{path} holds {count} numbers a point in {excerpt(name)!r}; choose an array of {sizes}")
