"""Where a solid is cut open for a picture: at a plane that shows most of what is inside, or where it was asked for."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError, UsageError
from infill.meshes.solids import FINE, solid_of, status_of
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

AXES = "xyz"
TYPED = r"\s*([xyz])\s*=\s*([+-]?(?:\d+\.?\d*(?:e[+-]?\d+)?|\.\d+|nan|inf))\s*(?:mm)?\s*"
MIDDLE, PLANES = (0.3, 0.7), 25  # of a side: between these, so many planes are tried
AS_GOOD = 0.95  # of the best: of such planes, one in the middle of those beside one another is taken
USUAL = 0.9  # of what a cut across x shows: one across y that shows this much is taken, as it is seen from the front
# The plane of a cut lies this far, of a side, from a round number, where faces of parts and walls often lie.
ASIDE = 1e-4


@dataclass(frozen=True, kw_only=True)
class Cut:
    """A plane across an axis.

    Parameters
    ----------
    axis : {0, 1, 2}
    at : float, mm
    """

    axis: int
    at: float

    def __str__(self) -> str:
        """Return it as it is typed.

        >>> str(Cut(axis=2, at=10.0))
        'z = 10 mm'
        """
        return f"{AXES[self.axis]} = {self.at:.4g} mm"


def parse_cut(text: str) -> Cut:
    """Return the cut in ``z=10``; raise UsageError, or ParameterError if it is nowhere.

    >>> parse_cut("z=10")
    Cut(axis=2, at=10.0)
    """
    found = re.fullmatch(TYPED, text.lower())
    if not found:
        raise UsageError(f"cut is {text!r}; give x, y or z and a place in mm, such as z=10")
    if not math.isfinite(float(found[2])):
        raise ParameterError(f"cut is {text!r}; give a place in mm, such as {found[1]}=10")
    return Cut(axis=AXES.index(found[1]), at=float(found[2]))


def check_cuts(cuts: Sequence[Cut], bounds: NDArray[np.floating]) -> None:
    """Raise ParameterError if a cut does not pass through a part with such bounds (2, 3), mm."""
    for cut in cuts:
        low, high = np.asarray(bounds, dtype=np.float64)[:, cut.axis].tolist()
        if not low < cut.at < high:
            axis = AXES[cut.axis]
            raise ParameterError(
                f"cut is {axis}={cut.at:g}, and the part goes from {axis} = {low:.4g} to {high:.4g} mm; give a place "
                f"between, such as {axis}={(low + high) / 2:.4g}"
            )


def choose_cuts(surface: Surface, part: Surface | None = None, given: Sequence[Cut] = ()) -> list[Cut]:
    """Choose an upright and a level cut that show the inside of a closed surface, unless one is given.

    Parameters
    ----------
    surface : Surface, mm
    part : Surface, optional
        The same without its voids; the hull of each section by default.
    given : sequence of Cut

    Notes
    -----
    A section shows the squared area of its voids, times the root of how much longer its outline is for them: nothing of
    a plane along a wall, little of one that grazes walls, and not the most of one between two walls that meets none.
    """
    solid = solid_of(surface)
    outer = None if part is None else solid_of(part)
    if status_of(solid) != FINE or (outer is not None and status_of(outer) != FINE):
        middle = surface.bounds.mean(axis=0).tolist()
        upright, level = Cut(axis=1, at=middle[1]), Cut(axis=2, at=middle[2])
        return [*_upright(given, [upright]), *_level(given, [level])]
    chosen = list(given)
    if not any(cut.axis < 2 for cut in given):
        across_y, shown = _best(surface, solid, outer, 1)
        across_x, more = _best(surface, solid, outer, 0)
        chosen.insert(0, across_y if shown >= USUAL * more else across_x)
    if not any(cut.axis == 2 for cut in given):
        chosen.append(_best(surface, solid, outer, 2)[0])
    return chosen


def _upright(given: Sequence[Cut], usual: list[Cut]) -> list[Cut]:
    return [cut for cut in given if cut.axis < 2] or usual


def _level(given: Sequence[Cut], usual: list[Cut]) -> list[Cut]:
    return [cut for cut in given if cut.axis == 2] or usual


def _best(
    surface: Surface, solid: manifold3d.Manifold, outer: manifold3d.Manifold | None, axis: int
) -> tuple[Cut, float]:
    """Return the cut across an axis that shows most, and how much that is."""
    low, high = (float(each) for each in surface.bounds[:, axis])
    shares = np.linspace(*MIDDLE, PLANES) + ASIDE
    places = low + shares * (high - low)
    turned = [_turned_up(each, axis) for each in (solid, outer) if each is not None]
    shown = np.array([_shown(turned, place) for place in places.tolist()])
    good = np.flatnonzero(shown >= AS_GOOD * shown.max())
    # Half way between two walls, as beside one there is a wall right behind the cut.
    runs = np.split(good, np.flatnonzero(np.diff(good) > 1) + 1)
    middles = [int(run[len(run) // 2]) for run in runs]
    nearest = min(middles, key=lambda each: abs(each - PLANES // 2))
    return Cut(axis=axis, at=float(places[nearest])), float(shown[nearest])


def _turned_up(solid: manifold3d.Manifold, axis: int) -> manifold3d.Manifold:
    """Return a solid turned so that an axis is z."""
    turned = np.zeros((3, 4))
    turned[[0, 1, 2], [(axis + 1) % 3, (axis + 2) % 3, axis]] = 1
    return solid.transform(turned)


def _shown(solids: list[manifold3d.Manifold], height: float) -> float:
    """Return how much of the inside of a solid is seen at a height; 0 if nothing is."""
    section = solids[0].slice(height)
    whole = solids[1].slice(height) if len(solids) > 1 else section.hull()
    longer = _outline(section) - _outline(whole)
    return float(max(0.0, whole.area() - section.area()) ** 2 * math.sqrt(max(0.0, longer)))


def _outline(section: manifold3d.CrossSection) -> float:
    """Return how long the outline of a section is, mm."""
    rings = section.to_polygons()
    return float(sum(np.linalg.norm(np.roll(ring, 1, axis=0) - ring, axis=1).sum() for ring in rings))
