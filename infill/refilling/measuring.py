"""Measure the support and contact of the infill, before and after, on a sample of the layers as they are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from infill.paths.contact import MOST_POINTS, STEP, Contact, Samples, concatenate_samples, layer_contact, sample_paths
from infill.paths.neighbours import BeadMoves
from infill.ragged import select_rows

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

TARGET_LAYERS = 16  # layers of a print, about; more of small layers, so that the number of points is about the same
MOST_LAYERS = 128
LARGE = MOST_POINTS * STEP  # mm of infill in a layer: larger layers are sampled


def sampling_stride(layers: float, length: float) -> int:
    """Return the sampling stride, in layers, of a print.

    Parameters
    ----------
    layers : float
        Number of layers.
    length : float
        mm of infill in a typical layer.

    >>> sampling_stride(320, 5000.0), sampling_stride(320, 500.0), sampling_stride(320, 0.0)
    (20, 5, 2)
    """
    number = min(TARGET_LAYERS * max(1.0, LARGE / max(length, 1e-9)), MOST_LAYERS)
    return max(1, round(layers / number))


@dataclass(frozen=True, kw_only=True)
class LayerPaths:
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
        places, first = select_rows(self.first, np.flatnonzero(self.layer == number))
        return sample_paths(self.points[places], first)


@dataclass(frozen=True, kw_only=True)
class SampledLayer:
    """A drawn layer that supports the next one.

    Parameters
    ----------
    number : int
    before, after : Samples
        All its beads, old and new.
    """

    number: int
    before: Samples
    after: Samples


def measure_layers(
    old: LayerPaths,
    new: LayerPaths,
    others: BeadMoves,
    layers: Places,
    *,
    line_width: float,
    stride: int,
    last: SampledLayer | None,
) -> tuple[Contact, Contact, SampledLayer | None]:
    """Measure every `stride`-th layer of a batch, old and new.

    Parameters
    ----------
    old, new : LayerPaths
        The infill.
    others : BeadMoves
        All other beads.
    layers : (L,) int, ascending
        Of the batch.
    line_width : float, mm
    stride : int
    last : SampledLayer, optional
        The last layer of the previous batch, if needed.

    Returns
    -------
    before, after : Contact
    last : SampledLayer or None
        For the next batch.
    """
    before, after = Contact(), Contact()

    @lru_cache(maxsize=2)  # a layer is measured, and then the next one lies on it
    def layer_samples(number: int) -> tuple[Samples, Samples]:
        return old.of(number), new.of(number)

    def below(number: int) -> SampledLayer:
        walls = others.samples_of(number)
        old_samples, new_samples = layer_samples(number)
        return SampledLayer(
            number=number, before=concatenate_samples(old_samples, walls), after=concatenate_samples(new_samples, walls)
        )

    layer_set = set(layers.tolist())
    for number in np.unique(old.layer).tolist():
        if number % stride:
            continue
        if number - 1 in layer_set:
            lower = below(number - 1)
        elif last is not None and last.number == number - 1:
            lower = last
        else:
            continue
        old_samples, new_samples = layer_samples(number)
        before += layer_contact(old_samples, lower.before, line_width)
        after += layer_contact(new_samples, lower.after, line_width)
    final = int(layers[-1]) if len(layers) else 0
    return before, after, below(final) if len(layers) and (final + 1) % stride == 0 else None
