"""Which components of a mesh lie inside which others, and which of them are inside out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.voxels.scanlines import Crossings

SAMPLES = 9  # crossings of a component that are examined to find out what it lies in

Floats = NDArray[np.float64]
Integers = NDArray[np.integer]


def inside_out(found: Crossings, component: Integers, volumes: Floats) -> NDArray[np.bool_]:
    """Return which components must be turned: those that face inwards and lie in no other, and everything inside them.

    Parameters
    ----------
    found : Crossings
    component : (F,) int
        Component of every face.
    volumes : (B,) float64
        Signed volume of each.

    Returns
    -------
    (B,) bool

    Notes
    -----
    A component lies in another if the rows wind around it at every one of the crossings examined. One that faces
    the opposite way from the component it lies in is a cavity of it, and turns with it.
    """
    turned = np.zeros(len(volumes), dtype=bool)
    if (volumes >= 0).all() or (volumes <= 0).all():
        return turned
    owner = component[found.face]
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner, np.arange(len(volumes) + 1), sorter=order)
    for number in np.flatnonzero(volumes):
        own = order[bounds[number] : bounds[number + 1]]
        if len(own) == 0:
            continue
        around: set[int] | None = None
        for i in own[np.linspace(0, len(own) - 1, SAMPLES).astype(np.int64)]:
            begin, end = np.searchsorted(found.row, [found.row[i], found.row[i] + 1])
            owners, signs, places = owner[begin:end], found.sign[begin:end], found.place[begin:end]
            holding: set[int] = set()
            for before in (places < found.place[i], places <= found.place[i]):
                winding = np.bincount(owners[before], weights=signs[before])
                holding.update(np.flatnonzero(winding).tolist())
            around = holding if around is None else around & holding
        larger = [each for each in around or () if abs(volumes[each]) > abs(volumes[number])]
        outermost = max(larger, key=lambda each: abs(volumes[each]), default=number)
        turned[number] = volumes[outermost] < 0
    return turned
