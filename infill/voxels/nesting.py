"""Find the components of a mesh that are inside out, by the components that lie around each."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.voxels.scanlines import RowCrossings

SAMPLES = 9  # crossings of a component that are examined to find the components around it

Floats = NDArray[np.float64]
Integers = NDArray[np.integer]


def is_inside_out(crossings: RowCrossings, component: Integers, volumes: Floats) -> NDArray[np.bool_]:
    """Mark the components to reverse: those that face inwards outside all others, and everything inside them.

    Parameters
    ----------
    crossings : RowCrossings
    component : (F,) int
        Component of every face.
    volumes : (B,) float64
        Signed volume of each component.

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
    owner = component[crossings.face]
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner, np.arange(len(volumes) + 1), sorter=order)
    for number in np.flatnonzero(volumes):
        own_crossings = order[bounds[number] : bounds[number + 1]]
        if len(own_crossings) == 0:
            continue
        holders: set[int] | None = None
        for i in own_crossings[np.linspace(0, len(own_crossings) - 1, SAMPLES).astype(np.int64)]:
            begin, end = np.searchsorted(crossings.row, [crossings.row[i], crossings.row[i] + 1])
            owners, signs, places = owner[begin:end], crossings.sign[begin:end], crossings.place[begin:end]
            enclosing: set[int] = set()
            for before in (places < crossings.place[i], places <= crossings.place[i]):
                winding = np.bincount(owners[before], weights=signs[before])
                enclosing.update(np.flatnonzero(winding).tolist())
            holders = enclosing if holders is None else holders & enclosing
        larger = [holder for holder in holders or () if abs(volumes[holder]) > abs(volumes[number])]
        outermost = max(larger, key=lambda index: abs(volumes[index]), default=number)
        turned[number] = volumes[outermost] < 0
    return turned
