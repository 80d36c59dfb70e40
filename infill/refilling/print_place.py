"""The infill of a print as the place of a field: where it is, and how deep a point lies below walls, roofs and floors.

A first pass over the print finds the regions of its infill in some layers, evenly spaced. Wherever a layer has no
infill region, there is a wall, a roof or a floor.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import is_printing
from infill.paths.families.infill_space import InfillSpace
from infill.refilling.layers import read_layers
from infill.refilling.regions import FreeAreas

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

MOST_LAYERS = 96  # that are looked at, about
MOST_GAP = 1.0  # mm: infill that is left out of fewer layers is combined into every second or third one, or more
SIMPLER = 0.1  # mm: of outlines that are kept
MOST_NODES = 1_500_000  # of the grid in which depths are measured
LEAST_STEP, LEAST_RISE = 0.4, 0.05  # mm between them
ONLY_RISE = 0.2  # mm: height of the only layer of a print
LOWER = 0.01  # mm by which a layer lies below the one before it if another object begins
SAMPLES = 1500  # points in the region of a layer at which a field is looked at, about


@dataclass(frozen=True, kw_only=True, eq=False)
class InfillLayer:
    """The region of the infill of a layer: empty where it has none.

    Parameters
    ----------
    z : float, mm
    areas : tuple of Polygon
    number : int
        Of the layer.
    length : float, mm
        Of its infill.
    """

    z: float
    areas: tuple[Polygon, ...]
    number: int = 0
    length: float = 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class PrintPlace:
    """The infill of a print.

    Parameters
    ----------
    layers : tuple of InfillLayer
        Some layers from the first to the last, in order of height.
    heights : (L,) float64, mm
        Of all layers with infill, ascending.
    """

    layers: tuple[InfillLayer, ...]
    heights: Floats = field(default_factory=lambda: np.empty(0))

    @cached_property
    def filled(self) -> tuple[InfillLayer, ...]:
        """The layers with infill."""
        return tuple(layer for layer in self.layers if layer.areas)

    @cached_property
    def bounds(self) -> Floats:
        """The box around the infill, (2, 3), mm."""
        boxes = np.array([area.bounds for layer in self.filled for area in layer.areas])
        heights = [layer.z for layer in self.filled]
        return np.array([[*boxes[:, :2].min(axis=0), min(heights)], [*boxes[:, 2:].max(axis=0), max(heights)]])

    @cached_property
    def points(self) -> Floats:
        """Points in the infill, (N, 3), mm, with the corners of its regions."""
        rows, before, inside = [], (), np.empty((0, 2))
        for layer in self.filled:
            if layer.areas is not before:
                before, inside = layer.areas, _sample_areas(layer.areas)
            rows.append(np.column_stack([inside, np.full(len(inside), layer.z)]))
        return np.concatenate(rows)

    @cached_property
    def _heights(self) -> tuple[Floats, float]:
        """Heights of the grid, mm, from a step below the infill to a step above it; and that step."""
        (_, _, low), (_, _, high) = self.bounds
        rises = np.diff([layer.z for layer in self.layers])
        step = max((high - low) / MOST_LAYERS, 1e-3, float(np.median(rises)) if len(rises) else ONLY_RISE)
        count = math.ceil((high - low) / step) + 1
        return low + step * np.arange(-1, count + 1), step

    @cached_property
    def _grid(self) -> tuple[Floats, Floats, NDArray[np.bool_]]:
        """The first node and the steps of a grid, (3,) each, mm, and which of its nodes lie in the infill."""
        low, high = self.bounds
        heights, rise = self._heights
        step = max(LEAST_STEP, math.sqrt(float(np.prod(high[:2] - low[:2])) * len(heights) / MOST_NODES))
        x, y = (np.arange(low[axis] - step / 2, high[axis] + step, step) for axis in (0, 1))
        nodes = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
        inside = np.zeros((len(x), len(y), len(heights)), dtype=bool)
        before, held = None, inside[:, :, 0]
        places = np.array([layer.z for layer in self.layers])
        for number, height in enumerate(heights.tolist()):
            if not low[2] - rise / 2 <= height <= high[2] + rise / 2:
                continue
            layer = self.layers[int(np.argmin(np.abs(places - height)))]
            if layer.areas is not before:
                before, held = layer.areas, mark_inside(layer.areas, nodes).reshape(inside.shape[:2])
            inside[:, :, number] = held
        return np.array([x[0], y[0], heights[0]]), np.array([step, step, rise]), _close_gaps(inside, rise)

    def holds_infill(self, points: Floats) -> NDArray[np.bool_]:
        """Tell whether the nearest nodes of the grid to points (N, 3), mm, lie in the infill: (N,)."""
        corner, steps, inside = self._grid
        nodes = np.clip(np.rint((points - corner) / steps).astype(int), 0, np.array(inside.shape) - 1)
        held: NDArray[np.bool_] = inside[tuple(nodes.T)]
        return held

    @cached_property
    def _skin_depths(self) -> NDArray[np.float32]:
        """Distance of each node of the grid from the border of the infill, mm; 0 outside."""
        from scipy.ndimage import distance_transform_edt

        _, steps, inside = self._grid
        depths, nearest = distance_transform_edt(inside, sampling=steps, return_indices=True)
        # The border lies half a step before the nearest node outside, as seen along the way there.
        border = np.zeros(inside.shape, dtype=np.float32)
        for axis, step in enumerate(steps.tolist()):
            places = np.arange(inside.shape[axis]).reshape([-1 if along == axis else 1 for along in range(3)])
            border += (step * np.abs(nearest[axis] - places)).astype(np.float32) * np.float32(step / 2)
        inner: NDArray[np.float32] = np.maximum(depths - border / np.maximum(depths, steps.min()), 0.0).astype(
            np.float32
        )
        return inner

    @cached_property
    def space(self) -> InfillSpace:
        """The grid, for patterns that follow the infill of the entire print."""
        corner, steps, inside = self._grid
        return InfillSpace(corner=corner, steps=steps, inside=inside, depths=self._skin_depths, heights=self.heights)

    def skin_depth(self, points: Floats) -> Floats:
        """Return the distance of points (N, 3), mm, from walls, roofs and floors: (N,), mm."""
        from scipy.ndimage import map_coordinates

        corner, steps, _ = self._grid
        depths: Floats = map_coordinates(
            self._skin_depths, ((points - corner) / steps).T, output=np.float64, order=1, mode="nearest"
        )
        return depths

    @cached_property
    def _roof_depths(self) -> NDArray[np.float32]:
        """How far each node lies below the first one above it that is outside, less half a step; 0 outside."""
        _, (_, _, rise), inside = self._grid
        count = np.zeros(inside.shape, dtype=np.float32)
        for layer in range(inside.shape[2] - 2, -1, -1):
            count[:, :, layer] = np.where(inside[:, :, layer], count[:, :, layer + 1] + 1, 0)
        depths: NDArray[np.float32] = np.maximum(count - np.float32(0.5), 0) * np.float32(rise)
        return depths

    def roof_depth(self, points: Floats) -> Floats:
        """Return how far points (N, 3), mm, lie below the roof, or the wall, above them: (N,), mm."""
        from scipy.ndimage import distance_transform_edt, map_coordinates

        corner, steps, inside = self._grid
        empty = np.asarray(~inside.any(axis=2), dtype=np.bool_)
        _, nearest = distance_transform_edt(empty, return_indices=True)
        places = (points - corner) / steps  # of points at walls, the column of the nearest infill
        row, column = (np.clip(np.rint(places[:, axis]).astype(int), 0, inside.shape[axis] - 1) for axis in (0, 1))
        places[:, 0], places[:, 1] = nearest[0][row, column], nearest[1][row, column]
        depths: Floats = map_coordinates(self._roof_depths, places.T, output=np.float64, order=1, mode="nearest")
        return depths


def _close_gaps(inside: NDArray[np.bool_], rise: float) -> NDArray[np.bool_]:
    """Fill gaps of less than `MOST_GAP` in height: no roof and no floor is that thin."""
    from scipy.ndimage import binary_closing

    count = math.ceil(MOST_GAP / rise) - 1
    if count < 1:
        return inside
    padded = np.pad(inside, ((0, 0), (0, 0), (count, count)))
    closed = binary_closing(padded, structure=np.ones((1, 1, count + 1), dtype=bool))
    result: NDArray[np.bool_] = closed[:, :, count:-count]
    return result


def _sample_areas(areas: Sequence[Polygon]) -> Floats:
    """Return points in areas, and their corners, (N, 2), mm."""
    import shapely

    union = shapely.union_all(list(areas))
    x0, y0, x1, y1 = union.bounds
    step = math.sqrt(max(union.area, 1e-6) / SAMPLES)
    nodes = np.stack(np.meshgrid(np.arange(x0, x1, step), np.arange(y0, y1, step), indexing="ij"), axis=-1)
    nodes = nodes.reshape(-1, 2)
    return np.concatenate([nodes[mark_inside([union], nodes)], shapely.get_coordinates(union)])


def mark_inside(areas: Sequence[Polygon | MultiPolygon], points: Floats) -> NDArray[np.bool_]:
    """Mark the points (N, 2), mm, that lie in one of some areas: (N,)."""
    import shapely

    union = shapely.union_all(list(areas))
    shapely.prepare(union)
    inside: NDArray[np.bool_] = shapely.contains_xy(union, points[:, 0], points[:, 1])
    return inside


def look_at_infill(file: BinaryIO, begin: MachineState, layers: float) -> PrintPlace | None:
    """Read a print from its beginning, and find the regions of its infill in some layers; None without infill.

    Parameters
    ----------
    file : binary file
    begin : MachineState
    layers : float
        Approximate number of layers.
    """
    import shapely

    file.seek(0)
    stride = max(1, round(layers / MOST_LAYERS))
    kept: list[InfillLayer] = []
    region: FreeAreas | None = None
    areas: tuple[Polygon, ...] = ()
    heights: list[float] = []
    for batch in read_layers(file, begin):
        numbers, last = np.unique(batch.marks.layer, return_index=True)
        with_infill, prints = set(np.unique(batch.layer).tolist()), is_printing(batch.table)
        heights += [batch.of(number).z for number in sorted(with_infill)]
        for number, line in zip(numbers.tolist(), last.tolist(), strict=True):
            if number % stride:
                continue
            if number not in with_infill:
                lines = slice(line, int(np.searchsorted(batch.marks.layer, number, side="right")))
                beads = batch.table.z[lines][prints[lines]]
                if len(beads):
                    kept.append(InfillLayer(z=float(np.nan_to_num(beads.max())), areas=()))
                continue
            layer = batch.of(number)
            before, region = region, layer.find_region(region)
            if region is not before:
                areas = tuple(shapely.simplify(area, SIMPLER) for area in region.polygons)
            kept.append(InfillLayer(z=layer.z, areas=areas, number=number, length=layer.length))
            if len(kept) > 4 * MOST_LAYERS:
                kept, stride = kept[::2], 2 * stride
    place = PrintPlace(layers=tuple(join_passes(kept)), heights=np.unique(heights))
    return place if place.filled else None


def join_passes(layers: Sequence[InfillLayer]) -> list[InfillLayer]:
    """Join the layers of objects that are printed one after another; return layers of the entire plate by height.

    Parameters
    ----------
    layers : sequence of InfillLayer
        In the order in which they are printed. Where they go down, another object begins.

    >>> tower = [InfillLayer(z=z, areas=(), number=number, length=2.0) for number, z in enumerate([0.2, 0.4, 0.2])]
    >>> [(layer.z, layer.length) for layer in join_passes(tower)]
    [(0.2, 4.0), (0.4, 2.0)]
    """
    starts = [number for number in range(1, len(layers)) if layers[number].z < layers[number - 1].z - LOWER]
    if not starts:
        return list(layers)
    passes = [layers[start:end] for start, end in zip([0, *starts], [*starts, len(layers)], strict=True)]
    places = [np.array([layer.z for layer in layers_of]) for layers_of in passes]
    # Each object goes on by half of the distance of its layers above its last one.
    beyond = [float(np.median(np.diff(heights))) / 2 if len(heights) > 1 else LOWER for heights in places]
    joined: list[InfillLayer] = []
    areas: dict[tuple[int, ...], tuple[Polygon, ...]] = {}
    for z in sorted({layer.z for layer in layers}):
        nearest = [
            layers_of[int(np.argmin(np.abs(heights - z)))]
            for layers_of, heights, above in zip(passes, places, beyond, strict=True)
            if heights[0] - above <= z <= heights[-1] + above
        ]
        key = tuple(id(layer.areas) for layer in nearest)
        both = areas.setdefault(key, tuple(area for layer in nearest for area in layer.areas))
        joined.append(replace(nearest[0], z=z, areas=both, length=sum(layer.length for layer in nearest)))
    return joined
