"""What holds the infill up, before and after, measured on layers here and there as they are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from infill.paths.contact import MOST_POINTS, STEP, Contact, Samples, contact, merged, sampled
from infill.paths.neighbours import Beads
from infill.ragged import picked

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

MEASURED = 16  # layers of a print, about; of small layers more, so that about as many points are looked at
MOST_MEASURED = 128
LARGE = MOST_POINTS * STEP  # mm of infill in a layer: of more, a sample is looked at


def stride_of(layers: float, length: float) -> int:
    """Return every how-many-th layer of a print is measured.

    Parameters
    ----------
    layers : float
        How many there are.
    length : float
        mm of infill in a layer, usually.

    >>> stride_of(320, 5000.0), stride_of(320, 500.0), stride_of(320, 0.0)
    (20, 5, 2)
    """
    number = min(MEASURED * max(1.0, LARGE / max(length, 1e-9)), MOST_MEASURED)
    return max(1, round(layers / number))


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Paths of some layers.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
    layer : (M,) int
    """

    points: Floats
    first: Places
    layer: Places

    def of(self, number: int) -> Samples:
        """Return samples of the paths of one layer."""
        places, first = picked(self.first, np.flatnonzero(self.layer == number))
        return sampled(self.points[places], first)


@dataclass(frozen=True, kw_only=True)
class Below:
    """A layer that was drawn: what the next one lies on.

    Parameters
    ----------
    number : int
    before, after : Samples
        Everything it prints, old and new.
    """

    number: int
    before: Samples
    after: Samples


def measured(
    old: Drawing, new: Drawing, others: Beads, layers: Places, *, line_width: float, stride: int, last: Below | None
) -> tuple[Contact, Contact, Below | None]:
    """Measure every `stride`-th layer of a batch, old and new.

    Parameters
    ----------
    old, new : Drawing
        The infill.
    others : Beads
        Everything else.
    layers : (L,) int, ascending
        Of the batch.
    line_width : float, mm
    stride : int
    last : Below, optional
        The last layer of the batch before, if it is needed.

    Returns
    -------
    before, after : Contact
    last : Below or None
        For the next batch.
    """
    before, after = Contact(), Contact()

    @lru_cache(maxsize=2)  # a layer is measured, and then the next one lies on it
    def drawn(number: int) -> tuple[Samples, Samples]:
        return old.of(number), new.of(number)

    def below(number: int) -> Below:
        walls = others.samples_of(number)
        then, now = drawn(number)
        return Below(number=number, before=merged(then, walls), after=merged(now, walls))

    there = set(layers.tolist())
    for number in np.unique(old.layer).tolist():
        if number % stride:
            continue
        if number - 1 in there:
            under = below(number - 1)
        elif last is not None and last.number == number - 1:
            under = last
        else:
            continue
        then, now = drawn(number)
        before += contact(then, under.before, line_width)
        after += contact(now, under.after, line_width)
    final = int(layers[-1]) if len(layers) else 0
    return before, after, below(final) if len(layers) and (final + 1) % stride == 0 else None
