"""Compare a result with the given surface: distances both ways, the places that were lost, and a verdict in words.

Distances from the result to the given surface show additions, those the other way losses. Both are exact, at points
spread evenly over the surfaces and at their vertices. Parts of the given surface hidden inside the solid do not count,
nor do parts that the caller excludes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.meshes.distance import TriangleTree, morton_order
from infill.meshes.measuring import face_areas, faces_for_kernels
from infill.plain_numbers import UNITS, choose_unit, plain_place, plain_share, plain_size
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.reports.smoothing import Distances, Place

Word = Literal["kept", "changed a little", "lost"]
Kinds = Callable[[Floats, NDArray[np.integer]], NDArray[np.integer]]

# Kinds of points: those that count, those where solid is too thin to last, on a sheet without solid, or inside solid.
COUNTS, THIN, SHEET, HIDDEN = 0, 1, 2, 3

KEPT = 1.25  # cells: a sharp corner recedes this far at most; a point further away has changed
LOST = 2.0  # cells: a point further away is lost
PATCH = 4.0  # cells², as large as a face of 2 x 2: if less than this is lost in one place, it is a change
LOST_SHARE = 0.05  # of the surface: if this much lies further away, in however many places, it is lost
LOST_AREA = 16.0  # cells², as large as a face of 4 x 4: if less than this lies further away in all, it is a change
PITCH = 0.7  # cells between points
MOST_SAMPLES = 80_000  # points on a surface, beside as many vertices
FINEST = 250  # boxes along a side, which group points into places
GOLDEN = (0.7548776662466927, 0.5698402909980532)  # 1 / p and 1 / p², p³ = p + 1: fills a square evenly


class Places(Protocol):
    """Places that alone may be far apart, such as `infill.inspection.uncertain_places.UncertainPlaces`."""

    def hold(self, points: Floats, *, threads: int | None = None) -> NDArray[np.bool_]:
        """Tell for points (N, 3), mm, whether they lie in such a place."""
        ...


@dataclass(frozen=True, kw_only=True)
class SurfaceGap:
    """Distances of one surface from another, mm.

    Parameters
    ----------
    mean, rms, p95, max : float
        Over the area; the maximum is over vertices too. Where near distances are not measured, all are the maximum.
    at : (x, y, z)
        Place of the maximum.
    """

    mean: float
    rms: float
    p95: float
    max: float
    at: tuple[float, float, float]

    def facts(self) -> Distances:
        """Return the numbers by name, for the report."""
        return {"mean": self.mean, "rms": self.rms, "p95": self.p95, "max": self.max, "at": list(self.at)}


@dataclass(frozen=True, kw_only=True)
class ChangedPatch:
    """A place where one surface lies far from the other.

    Parameters
    ----------
    at : (x, y, z), mm
        Its point that is furthest away.
    area : float, mm²
    distance : float, mm
        Distance of that point from the other surface.
    """

    at: tuple[float, float, float]
    area: float
    distance: float

    def facts(self) -> Place:
        """Return the numbers by name, for the report."""
        return {"at": list(self.at), "area": self.area, "distance": self.distance}


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """Distances both ways, and the places further apart than `LOST`.

    Parameters
    ----------
    there, back : SurfaceGap
        From the result to the given surface, and back.
    added, lost : tuple of ChangedPatch
        Places that the result added, and places that it lacks; the largest first.
    thin : tuple of ChangedPatch
        Places further away than `LOST` whose solid or void is too thin to count; the largest first.
    thin_distance : float, mm
        Largest distance of such places from the result; 0 without any.
    sheet, hidden : float
        Area of the given surface that is far from the result, but on a sheet without solid, or inside the solid, mm².
    given_area, result_area : float
        Area of both surfaces, without sheets and what is hidden, mm².
    cell : float, mm
    exact : bool
        Whether near distances are exact too, and not only known to be within `KEPT`.
    """

    there: SurfaceGap
    back: SurfaceGap
    added: tuple[ChangedPatch, ...]
    lost: tuple[ChangedPatch, ...]
    thin: tuple[ChangedPatch, ...]
    thin_distance: float
    sheet: float
    hidden: float
    given_area: float
    result_area: float
    cell: float
    exact: bool = True

    @property
    def word(self) -> Word:
        """`lost` if much is missing or new, in one place or in all; `kept` if nothing is over 1.25 cells away.

        Much is at least four cells² in one place, or a twentieth of the surface and 16 cells² in all places together.
        """
        if any(place.area >= PATCH * self.cell**2 for place in (*self.added, *self.lost)):
            return "lost"
        missing, new = total_area(self.lost), total_area(self.added)
        if self.is_large(missing, self.given_area) or self.is_large(new, self.result_area):
            return "lost"
        return "kept" if max(self.there.max, self.back.max) <= KEPT * self.cell else "changed a little"

    @property
    def thin_area(self) -> float:
        """Area of the given surface that lies further than `LOST` from the result and is too thin to count, mm²."""
        return total_area(self.thin)

    def is_large(self, area: float, whole: float) -> bool:
        """Tell whether an area, mm², is large by its size and by its share of a whole surface."""
        return area >= LOST_AREA * self.cell**2 and area >= LOST_SHARE * whole

    @property
    def phrases(self) -> tuple[str, ...]:
        """The changes, one phrase each."""
        moved = max((self.back, self.there), key=lambda gap: gap.max)
        phrases = []
        for patches, whole, owner, change in (
            (self.lost, self.given_area, "the input", "is missing"),
            (self.added, self.result_area, "the result", "was not in the input"),
        ):
            if not patches:
                continue
            worst = max(patches, key=lambda patch: patch.distance)
            area = total_area(patches)
            unit = _choose_unit_beside(worst.distance, worst.at)
            size = f"{plain_size(area, power=2, unit=unit)} of {owner} ({plain_share(area / whole)})"
            share = size if area else f"a tip of {owner}"
            number = f" in {len(patches)} places" if len(patches) > 1 else ""
            phrases.append(
                f"{share} {change}{number}, up to {plain_size(worst.distance, unit=unit)} away, "
                f"at {plain_place(worst.at)}"
            )
        if not phrases and moved.max > KEPT * self.cell:
            what = "the rest of the surface" if self.thin_area else "the surface"
            distance = plain_size(moved.max, unit=_choose_unit_beside(moved.max, moved.at))
            phrases.append(f"{what} moved by up to {distance}, at {plain_place(moved.at)}")
        return tuple(phrases)


def _choose_unit_beside(distance: float, place: Iterable[float]) -> str:
    """Choose the unit of a distance beside a place, which is in mm: at least mm, unless the part itself is tiny.

    >>> _choose_unit_beside(0.0009, (0.03, 0.15, 0.0)), _choose_unit_beside(0.0009, (0.0001, 0.0, 0.0))
    ('mm', 'µm')
    """
    unit = choose_unit(distance)
    return "mm" if UNITS[unit] < UNITS[choose_unit(*place)] and UNITS[unit] < 1 else unit


def total_area(patches: Iterable[ChangedPatch]) -> float:
    """Return the area of all patches together, mm².

    >>> total_area(ChangedPatch(at=(0, 0, 0), area=area, distance=1) for area in (1.5, 2))
    3.5
    """
    return float(sum(patch.area for patch in patches))


def all_points_count(points: Floats, faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG001 - a `Kinds`
    """Return the kind `COUNTS` for every point, (N,): the simplest of the `Kinds`."""
    return np.full(len(points), COUNTS)


def measure_deviation(
    given: Surface,
    result: Surface,
    *,
    cell: float,
    closed: Surface | None = None,
    kinds: Kinds = all_points_count,
    exact: bool = True,
    uncertain: Places | None = None,
    sampled: tuple[Surface, Surface] | None = None,
    trees: tuple[TriangleTree | None, TriangleTree | None] = (None, None),
    threads: int | None = None,
) -> Deviation:
    """Compare a result with the given surface.

    Parameters
    ----------
    given, result : Surface, mm
    cell : float
        Unit in which distances are judged, mm.
    closed : Surface, optional
        The given surface with its holes closed: the result adds nothing where the caps are.
    kinds : callable, optional
        Returns the kind of points (N, 3) on faces (N,) of the given surface: `COUNTS`, `THIN`, `SHEET` or `HIDDEN`.
        It is called only for points far away.
    exact : bool
        Whether to measure near distances: leaving them out is several times faster, and the word, the phrases and the
        places are the same.
    uncertain : Places, optional
        The places that alone may be further than `KEPT` from the other surface; all others count as near. Only if not
        `exact`, and without holes.
    sampled : (Surface, Surface), optional
        The parts of the given surface and of the result that are measured; by default, all of both.
    trees : (TriangleTree or None, TriangleTree or None)
        Of the given surface, with its holes closed if they are, and of the result, if there are any already.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    places = None if exact or closed is not None else uncertain
    enough = 0.0 if exact else KEPT * cell
    given_part, result_part = (given, result) if sampled is None else sampled
    points, _, area = sample_surface(result_part, PITCH * cell)
    distance = _distances(points, given if closed is None else closed, trees[0], enough, places, threads)
    there, added = _gap(points, distance, area, exact=exact), group_places(points, distance, area, cell)
    result_area = float(area.sum())
    points, faces, area = sample_surface(given_part, PITCH * cell)
    distance = _distances(points, result, trees[1], enough, places, threads)
    distant = np.flatnonzero(distance > KEPT * cell)
    kind = kinds(points[distant], faces[distant]) if len(distant) else np.empty(0, dtype=np.int64)
    thin_points = distant[kind == THIN]
    sheet, hidden = (float(area[distant[kind == code]].sum()) for code in (SHEET, HIDDEN))
    given_area = float(area.sum()) - sheet - hidden
    thin = group_places(points[thin_points], distance[thin_points], area[thin_points], cell)
    thin_distance = float(distance[thin_points].max(initial=0.0))
    counting = np.ones(len(points), dtype=bool)
    counting[distant[kind != COUNTS]] = False
    if not counting.any():
        counting[:] = True
    points, distance, area = points[counting], distance[counting], area[counting]
    return Deviation(
        there=there,
        back=_gap(points, distance, area, exact=exact),
        added=added,
        lost=group_places(points, distance, area, cell),
        thin=thin,
        thin_distance=thin_distance,
        sheet=sheet,
        hidden=hidden,
        given_area=given_area,
        result_area=result_area,
        cell=cell,
        exact=exact,
    )


def _distances(
    points: Floats,
    surface: Surface,
    tree: TriangleTree | None,
    enough: float,
    uncertain: Places | None,
    threads: int | None,
) -> Floats:
    """Return the distance of each point from a surface, (N,), mm; one below `enough` may be too great.

    Points that are certain to be near get 0.
    """
    distance = np.zeros(len(points))
    chosen = np.arange(len(points)) if uncertain is None else np.flatnonzero(uncertain.hold(points, threads=threads))
    if len(chosen):
        order = chosen[morton_order(points[chosen])]
        distance[order], _ = (tree or TriangleTree.of(surface)).nearest(points[order], enough=enough, threads=threads)
    return distance


def sample_surface(surface: Surface, pitch: float) -> tuple[Floats, NDArray[np.int64], Floats]:
    """Sample a surface at points spread evenly by area, and at its vertices, which stand for no area.

    Parameters
    ----------
    surface : Surface, mm
    pitch : float
        Distance between points, mm; more if they would be too many.

    Returns
    -------
    points : (N, 3) float64, mm
    faces : (N,) int64
        A face under each point.
    area : (N,) float64, mm²
        Area that each point stands for.
    """
    from infill.kernels.measures import find_first_corners, spread_points

    vertices, faces = np.ascontiguousarray(surface.vertices, dtype=np.float64), faces_for_kernels(surface)
    areas = face_areas(surface)
    total = float(areas.sum())
    count = int(min(MOST_SAMPLES, max(1.0, np.ceil(total / pitch**2)))) if total > 0 else 0
    step = total / max(count, 1)
    corner = np.full(len(vertices), -1, dtype=np.int64)
    used = find_first_corners(faces, corner)
    thinned = np.flatnonzero(corner >= 0)[:: max(1, -(-used // MOST_SAMPLES))]
    points, face = np.empty((count + len(thinned), 3)), np.empty(count + len(thinned), dtype=np.int64)
    spread_points(vertices, faces, areas, step, np.array(GOLDEN), points[:count], face[:count])
    points[count:], face[count:] = vertices[thinned], corner[thinned] // 3
    area = np.zeros(len(points))
    area[:count] = step
    return points, face, area


def _gap(points: Floats, distance: Floats, area: Floats, *, exact: bool) -> SurfaceGap:
    """Summarise the distances; of those that are bounds, all numbers are the maximum."""
    worst = int(distance.argmax())
    x, y, z = points[worst].tolist()
    furthest = float(distance[worst])
    if not exact:
        return SurfaceGap(mean=furthest, rms=furthest, p95=furthest, max=furthest, at=(x, y, z))
    weights = area if area.any() else np.ones_like(area)
    order = np.argsort(distance)
    cumulative = np.cumsum(weights[order])
    p95 = distance[order[np.searchsorted(cumulative, 0.95 * cumulative[-1]).clip(0, len(order) - 1)]]
    return SurfaceGap(
        mean=float(np.average(distance, weights=weights)),
        rms=float(np.sqrt(np.average(distance**2, weights=weights))),
        p95=float(p95),
        max=furthest,
        at=(x, y, z),
    )


def group_places(
    points: Floats, distance: Floats, area: Floats, cell: float, *, apart: float | None = None
) -> tuple[ChangedPatch, ...]:
    """Group the points that lie far away into places; return them, the largest first.

    Points up to `apart`, mm, from each other are one place; by default, twice their largest distance on the surface.
    """
    apart = 2 * float(area.max(initial=0.0)) ** 0.5 if apart is None else apart
    distant = np.flatnonzero(distance > LOST * cell)
    if len(distant) == 0:
        return ()
    from scipy.ndimage import label

    side = max(LOST * cell, apart, float(np.ptp(points[distant], axis=0).max()) / FINEST)
    place = ((points[distant] - points[distant].min(axis=0)) / side).astype(np.int64)
    occupied = np.zeros(place.max(axis=0) + 1, dtype=bool)
    occupied[tuple(place.T)] = True
    numbers, count = label(occupied, np.ones((3, 3, 3)))
    name = numbers[tuple(place.T)] - 1
    size = np.bincount(name, weights=area[distant], minlength=count)
    order = np.lexsort((-distance[distant], name))
    worst = distant[order[np.flatnonzero(np.diff(name[order], prepend=-1))]]  # in each place, the point furthest away
    patches = []
    for group in np.argsort(-size, kind="stable"):
        x, y, z = points[worst[group]].tolist()
        patches.append(ChangedPatch(at=(x, y, z), area=float(size[group]), distance=float(distance[worst[group]])))
    return tuple(patches)
