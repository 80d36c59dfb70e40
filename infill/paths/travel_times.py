"""How long a front takes from the outline of an area to the points inside, at a speed that changes from place to place.

The time t obeys the eikonal equation |∇t| = s, with the slowness s (1/speed) and t = 0 on the outline. Upwind
differences on a grid (Rouy and Tourin, doi:10.1137/0729053) are relaxed until nothing changes; near the
outline, times are exact for the slowness of each node.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

BAND = 4.0  # steps from the outline within which times are found without the grid
TOLERANCE = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class TravelTimes:
    """Travel times at the nodes of a grid; 0 outside of the area.

    Parameters
    ----------
    corner : (2,) float64, mm
        The first node.
    step : float, mm
    times : (N, M) float64
    """

    corner: Floats
    step: float
    times: Floats

    def area_beyond(self, time: float) -> MultiPolygon:
        """Return the area that the front reaches after a time above 0."""
        import shapely
        from skimage.measure import find_contours

        contours = find_contours(self.times, time)  # type: ignore[no-untyped-call]
        rings = [self.corner + self.step * contour for contour in contours if len(contour) > 3]
        area = shapely.build_area(shapely.MultiLineString(rings))
        return shapely.MultiPolygon([part for part in shapely.get_parts(area) if part.geom_type == "Polygon"])


def find_travel_times(area: Polygon | MultiPolygon, slowness: Callable[[Floats], Floats], step: float) -> TravelTimes:
    """Return the times in which a front from the outline reaches the points of an area.

    Parameters
    ----------
    area : Polygon or MultiPolygon, mm
    slowness : callable
        Time over distance, 1/mm, at points (N, 2), mm: (N,), above 0.
    step : float, mm
        Between the nodes of the grid. The times between two parts of an outline that are nearer than that are wrong.
    """
    import shapely
    from scipy.ndimage import distance_transform_edt

    from infill.kernels.eikonal import sweep_times

    x0, y0, x1, y1 = area.bounds
    corner = np.array([x0, y0]) - step
    axes = [np.arange(low, high + step, step) for low, high in zip(corner, (x1 + step, y1 + step), strict=True)]
    nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    shapely.prepare(area)
    inside: NDArray[np.bool_] = shapely.contains_xy(area, nodes[..., 0], nodes[..., 1])
    times = np.where(inside, np.inf, 0.0)
    delay = np.zeros(inside.shape)
    delay[inside] = step * slowness(nodes[inside])
    band = inside & (distance_transform_edt(inside) <= BAND)
    times[band] = _distances_to_outline(area, nodes[band]) / step * delay[band]
    sweep_times(times, band | ~inside, delay, TOLERANCE)
    return TravelTimes(corner=corner, step=step, times=times)


def relax_times(times: Floats, known: NDArray[np.bool_], delay: Floats) -> Floats:
    """Return the times after every node has looked at its four neighbours once: what the kernel repeats.

    Parameters
    ----------
    times, delay : (N, M) float64
        A time is infinite where nothing is known yet; the delay is that from a node to the next one.
    known : (N, M) bool
        Nodes whose times stay.
    """
    padded = np.pad(times, 1, constant_values=np.inf)
    a = np.minimum(padded[:-2, 1:-1], padded[2:, 1:-1])
    b = np.minimum(padded[1:-1, :-2], padded[1:-1, 2:])
    with np.errstate(invalid="ignore"):
        apart = np.abs(a - b)
        oblique = (a + b + np.sqrt(np.maximum(2 * delay**2 - apart**2, 0.0))) / 2
    arrivals = np.where(apart < delay, oblique, np.minimum(a, b) + delay)
    return np.where(known, times, np.minimum(times, arrivals))


def _distances_to_outline(area: Polygon | MultiPolygon, points: Floats) -> Floats:
    """Return the distances of points (N, 2) from the outline of an area, (N,), mm."""
    import shapely

    rings = [shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(area))]
    legs = shapely.linestrings(np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings]))
    places = shapely.points(points)
    _, nearest = shapely.STRtree(legs).query_nearest(places, all_matches=False)
    distances: Floats = shapely.distance(places, legs[nearest])
    return distances
