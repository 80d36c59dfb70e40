"""How true a result is to what was given: distances both ways, the places that were lost, and a verdict in words.

Distances from the result to what was given tell what was added, those the other way what was lost. Both are exact, at
points spread evenly over the surfaces and at their vertices. What the given surface hides inside the solid does not
count, nor does what the caller takes out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from infill.meshes.distance import Tree, along_curve
from infill.meshes.measuring import face_areas
from infill.surface import Surface

Word = Literal["kept", "changed a little", "lost"]
Floats = NDArray[np.float64]
Kinds = Callable[[Floats, NDArray[np.integer]], NDArray[np.integer]]

# Kinds of points: they count, belong to what is too thin to last, lie on a sheet that bounds no solid, or inside it.
COUNTS, THIN, SHEET, HIDDEN = 0, 1, 2, 3

KEPT = 1.25  # cells: a sharp corner recedes this far at most; what lies further away has changed
LOST = 2.0  # cells: what lies further away is lost
PATCH = 4.0  # cells², as large as a face of 2 x 2: if less than this is lost in one place, it is a change
PITCH = 0.7  # cells between points
MOST = 80_000  # points on a surface, beside as many vertices
FINEST = 250  # boxes along a side, by which points are told to lie in one place
GOLDEN = (0.7548776662466927, 0.5698402909980532)  # 1 / p and 1 / p², p³ = p + 1: fills a square evenly


@dataclass(frozen=True, kw_only=True)
class Gap:
    """How far one surface lies from another, mm.

    Parameters
    ----------
    mean, rms, p95, max : float
        Over the area, but the maximum: over vertices too.
    at : (x, y, z)
        Where the maximum lies.
    """

    mean: float
    rms: float
    p95: float
    max: float
    at: tuple[float, float, float]

    def facts(self) -> dict[str, Any]:
        """Return the numbers by name, for the report."""
        return {"mean": self.mean, "rms": self.rms, "p95": self.p95, "max": self.max, "at": list(self.at)}


@dataclass(frozen=True, kw_only=True)
class Patch:
    """A place where one surface lies far from the other.

    Parameters
    ----------
    at : (x, y, z), mm
        Its point that is furthest away.
    area : float, mm²
    distance : float, mm
        How far that point is from the other surface.
    """

    at: tuple[float, float, float]
    area: float
    distance: float

    def facts(self) -> dict[str, Any]:
        """Return the numbers by name, for the report."""
        return {"at": list(self.at), "area": self.area, "distance": self.distance}


@dataclass(frozen=True, kw_only=True)
class Fidelity:
    """Distances both ways, and what lies further apart than `LOST`.

    Parameters
    ----------
    there, back : Gap
        From the result to what was given, and from what was given to the result.
    added, lost : tuple of Patch
        Where the result has what was not given, and where it lacks what was; the largest first.
    thin, sheet, hidden : float
        Area of what was given that is far from the result, but too thin to count, no face of a solid, or inside the
        solid, mm².
    cell : float, mm
    exact : bool
        Whether the distances of what is near are exact too, and not only known to be within `KEPT`.
    """

    there: Gap
    back: Gap
    added: tuple[Patch, ...]
    lost: tuple[Patch, ...]
    thin: float
    sheet: float
    hidden: float
    cell: float
    exact: bool = True

    @property
    def word(self) -> Word:
        """The verdict, by distances alone."""
        if any(patch.area >= PATCH * self.cell**2 for patch in (*self.added, *self.lost)):
            return "lost"
        return "kept" if max(self.there.max, self.back.max) <= KEPT * self.cell else "changed a little"

    @property
    def phrases(self) -> tuple[str, ...]:
        """What changed, one phrase each."""
        said = []
        for gap, patches, what in (
            (self.back, self.lost, "of the input is missing"),
            (self.there, self.added, "was not in the input"),
        ):
            if gap.max <= KEPT * self.cell:
                continue
            place = ", ".join(f"{x:.4g}" for x in gap.at)
            if patches:
                number = f"{len(patches)} places, " if len(patches) > 1 else ""
                area = sum(patch.area for patch in patches)
                said.append(f"{number}{area:.3g} mm² {what}, up to {gap.max:.3g} mm away, at ({place})")
            else:
                said.append(f"the surface moved by up to {gap.max:.3g} mm, at ({place})")
        return tuple(said)


def everything(points: Floats, faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG001 - a `Kinds`
    """Return that all points count."""
    return np.full(len(points), COUNTS)


def fidelity(
    given: Surface,
    result: Surface,
    *,
    cell: float,
    closed: Surface | None = None,
    kinds: Kinds = everything,
    exact: bool = True,
    threads: int | None = None,
) -> Fidelity:
    """Compare a result with what was given.

    Parameters
    ----------
    given, result : Surface, mm
    cell : float
        What distances are judged by, mm.
    closed : Surface, optional
        What was given with its holes closed: where the caps are, the result adds nothing.
    kinds : callable, optional
        Tells which of the points (N, 3) on faces (N,) of what was given count: `COUNTS`, `THIN`, `SHEET` or `HIDDEN`.
        Asked only about those far away.
    exact : bool
        Whether to measure what is near: the word, the phrases and the places do not depend on it, which is several
        times faster.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    enough = 0.0 if exact else KEPT * cell
    points, _, area = sampled(result, PITCH * cell)
    away = _away(points, given if closed is None else closed, enough, threads)
    there, added = _gap(points, away, area), _patches(points, away, area, cell)
    points, faces, area = sampled(given, PITCH * cell)
    away = _away(points, result, enough, threads)
    far = np.flatnonzero(away > KEPT * cell)
    kind = kinds(points[far], faces[far]) if len(far) else np.empty(0, dtype=np.int64)
    thin, sheet, hidden = (float(area[far[kind == each]].sum()) for each in (THIN, SHEET, HIDDEN))
    kept = np.ones(len(points), dtype=bool)
    kept[far[kind != COUNTS]] = False
    if not kept.any():
        kept[:] = True
    points, away, area = points[kept], away[kept], area[kept]
    return Fidelity(
        there=there,
        back=_gap(points, away, area),
        added=added,
        lost=_patches(points, away, area, cell),
        thin=thin,
        sheet=sheet,
        hidden=hidden,
        cell=cell,
        exact=exact,
    )


def _away(points: Floats, surface: Surface, enough: float, threads: int | None) -> Floats:
    """Return how far points lie from a surface, those first that are near the one before: see `Tree.nearest`."""
    order = along_curve(points)
    away = np.empty(len(points))
    away[order], _ = Tree.of(surface).nearest(points[order], enough=enough, threads=threads)
    return away


def sampled(surface: Surface, pitch: float) -> tuple[Floats, NDArray[np.int64], Floats]:
    """Return points all over a surface, spread evenly by area, and its vertices, which stand for no area.

    Parameters
    ----------
    surface : Surface, mm
    pitch : float
        Distance between points, mm; more if they would be too many.

    Returns
    -------
    points : (N, 3) float64, mm
    faces : (N,) int64
        A face that each lies on.
    area : (N,) float64, mm²
        What each stands for.
    """
    vertices = np.asarray(surface.vertices, dtype=np.float64)
    areas = face_areas(surface)
    total = float(areas.sum())
    count = int(min(MOST, max(1.0, np.ceil(total / pitch**2)))) if total > 0 else 0
    at = (np.arange(count) + 0.5) * (total / max(count, 1))
    face = np.searchsorted(np.cumsum(areas), at).clip(0, len(areas) - 1)
    u, v = ((np.arange(count) * share) % 1 for share in GOLDEN)
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    a, b, c = (vertices[surface.faces[face, i]] for i in range(3))
    points = a + u[:, None] * (b - a) + v[:, None] * (c - a)
    used, first = np.unique(surface.faces.ravel(), return_index=True)
    some = slice(None, None, max(1, -(-len(used) // MOST)))
    return (
        np.concatenate([points, vertices[used[some]]]),
        np.concatenate([face, first[some] // 3]).astype(np.int64),
        np.concatenate([np.full(count, total / max(count, 1)), np.zeros(len(used[some]))]),
    )


def _gap(points: Floats, away: Floats, area: Floats) -> Gap:
    """Return the distances in short."""
    whole = area if area.any() else np.ones_like(area)
    order = np.argsort(away)
    summed = np.cumsum(whole[order])
    p95 = away[order[np.searchsorted(summed, 0.95 * summed[-1]).clip(0, len(order) - 1)]]
    worst = int(away.argmax())
    x, y, z = points[worst].tolist()
    return Gap(
        mean=float(np.average(away, weights=whole)),
        rms=float(np.sqrt(np.average(away**2, weights=whole))),
        p95=float(p95),
        max=float(away[worst]),
        at=(x, y, z),
    )


def _patches(points: Floats, away: Floats, area: Floats, cell: float) -> tuple[Patch, ...]:
    """Return the places that lie far away, the largest first."""
    from scipy.ndimage import label

    far = np.flatnonzero(away > LOST * cell)
    if len(far) == 0:
        return ()
    side = max(LOST * cell, 2 * float(area.max(initial=0.0)) ** 0.5, float(np.ptp(points[far], axis=0).max()) / FINEST)
    place = ((points[far] - points[far].min(axis=0)) / side).astype(np.int64)
    there = np.zeros(place.max(axis=0) + 1, dtype=bool)
    there[tuple(place.T)] = True
    numbers, count = label(there, np.ones((3, 3, 3)))
    name = numbers[tuple(place.T)] - 1
    size = np.bincount(name, weights=area[far], minlength=count)
    order = np.lexsort((-away[far], name))
    worst = far[order[np.flatnonzero(np.diff(name[order], prepend=-1))]]  # of each place, the point furthest away
    found = []
    for each in np.argsort(-size, kind="stable"):
        x, y, z = points[worst[each]].tolist()
        found.append(Patch(at=(x, y, z), area=float(size[each]), distance=float(away[worst[each]])))
    return tuple(found)
