"""Cuts of a solid for a picture: at a plane that shows most of its inside, or as requested."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError, UsageError
from infill.meshes.solids import FINE, solid_status, to_manifold
from infill.plain_numbers import plain_argument
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

AXES = "xyz"
CUT_PATTERN = r"\s*([xyz])\s*=\s*([+-]?(?:\d+\.?\d*(?:e[+-]?\d+)?|\.\d+|nan|inf))\s*(?:mm)?\s*"
MIDDLE, PLANES = (0.3, 0.7), 25  # of a side: planes are tried in this range, and their number
NEAR_BEST = 0.95  # of the best: of such planes, one in the middle of a run is taken
FRONT_SHARE = 0.9  # of a cut across x: a cut across y that shows this much is taken, as it is seen from the front
# The plane of a cut lies this far, of a side, from a round number, where faces of parts and walls often lie.
PLANE_OFFSET = 1e-4


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
        """Return the cut in the notation of the command line.

        >>> str(Cut(axis=2, at=10.0))
        'z = 10 mm'
        """
        return f"{AXES[self.axis]} = {plain_argument(self.at, 4)} mm"


def parse_cut(text: str) -> Cut:
    """Parse the cut in ``z=10``; raise UsageError, or ParameterError if it is not finite.

    >>> parse_cut("z=10")
    Cut(axis=2, at=10.0)
    """
    match = re.fullmatch(CUT_PATTERN, text.lower())
    if not match:
        raise UsageError.about("cut", f"is {text!r}; give x, y or z and a place in mm, such as z=10")
    if not math.isfinite(float(match[2])):
        raise ParameterError.about("cut", f"is {text!r}; give a place in mm, such as {match[1]}=10")
    return Cut(axis=AXES.index(match[1]), at=float(match[2]))


def check_cuts(cuts: Sequence[Cut], bounds: NDArray[np.floating]) -> None:
    """Raise ParameterError if a cut misses a part with these bounds (2, 3), mm."""
    for cut in cuts:
        low, high = np.asarray(bounds, dtype=np.float64)[:, cut.axis].tolist()
        if not low < cut.at < high:
            axis = AXES[cut.axis]
            raise ParameterError.about(
                "cut",
                f"is {axis}={plain_argument(cut.at)}, and the part goes from {axis} = {plain_argument(low, 4)} to "
                f"{plain_argument(high, 4)} mm; give a place between, such as "
                f"{axis}={plain_argument((low + high) / 2, 4)}",
            )


def choose_cuts(surface: Surface, part: Surface | None = None, given: Sequence[Cut] = ()) -> list[Cut]:
    """Choose an upright and a level cut that show the inside of a closed surface, unless one is given.

    Parameters
    ----------
    surface : Surface, mm
    part : Surface, optional
        The same surface without its voids; the hull of each section by default.
    given : sequence of Cut

    Notes
    -----
    A section is rated by the squared area of its voids, times the root of their additional outline: a plane along a
    wall gets nothing, one that grazes walls little, and one between two walls that meets none not the most.
    """
    solid = to_manifold(surface)
    outer = None if part is None else to_manifold(part)
    if solid_status(solid) != FINE or (outer is not None and solid_status(outer) != FINE):
        middle = surface.bounds.mean(axis=0).tolist()
        upright, level = Cut(axis=1, at=middle[1]), Cut(axis=2, at=middle[2])
        return [*_upright_cuts(given, [upright]), *_level_cuts(given, [level])]
    chosen = list(given)
    if not any(cut.axis < 2 for cut in given):
        across_y, shown = _find_best_cut(surface, solid, outer, 1)
        across_x, more = _find_best_cut(surface, solid, outer, 0)
        chosen.insert(0, across_y if shown >= FRONT_SHARE * more else across_x)
    if not any(cut.axis == 2 for cut in given):
        chosen.append(_find_best_cut(surface, solid, outer, 2)[0])
    return chosen


def _upright_cuts(given: Sequence[Cut], usual: list[Cut]) -> list[Cut]:
    """Return the given cuts across x or y, or the usual ones if there are none."""
    return [cut for cut in given if cut.axis < 2] or usual


def _level_cuts(given: Sequence[Cut], usual: list[Cut]) -> list[Cut]:
    """Return the given cuts across z, or the usual ones if there are none."""
    return [cut for cut in given if cut.axis == 2] or usual


def _find_best_cut(
    surface: Surface, solid: manifold3d.Manifold, outer: manifold3d.Manifold | None, axis: int
) -> tuple[Cut, float]:
    """Return the cut across an axis with the best rating, and the rating."""
    low, high = (float(value) for value in surface.bounds[:, axis])
    shares = np.linspace(*MIDDLE, PLANES) + PLANE_OFFSET
    places = low + shares * (high - low)
    turned = [_turn_up(value, axis) for value in (solid, outer) if value is not None]
    shown = np.array([_rate_section(turned, place) for place in places.tolist()])
    good = np.flatnonzero(shown >= NEAR_BEST * shown.max())
    # Halfway between two walls: beside a wall, another one would be right behind the cut.
    runs = np.split(good, np.flatnonzero(np.diff(good) > 1) + 1)
    middles = [int(run[len(run) // 2]) for run in runs]
    nearest = min(middles, key=lambda value: abs(value - PLANES // 2))
    return Cut(axis=axis, at=float(places[nearest])), float(shown[nearest])


def _turn_up(solid: manifold3d.Manifold, axis: int) -> manifold3d.Manifold:
    """Turn a solid so that an axis becomes z."""
    turned = np.zeros((3, 4))
    turned[[0, 1, 2], [(axis + 1) % 3, (axis + 2) % 3, axis]] = 1
    return solid.transform(turned)


def _rate_section(solids: list[manifold3d.Manifold], height: float) -> float:
    """Rate the visible inside of a solid at a height; 0 if there is none."""
    section = solids[0].slice(height)
    outer_section = solids[1].slice(height) if len(solids) > 1 else section.hull()
    added_outline = _outline_length(section) - _outline_length(outer_section)
    return float(max(0.0, outer_section.area() - section.area()) ** 2 * math.sqrt(max(0.0, added_outline)))


def _outline_length(section: manifold3d.CrossSection) -> float:
    """Return the length of the outline of a section, mm."""
    rings = section.to_polygons()
    return float(sum(np.linalg.norm(np.roll(ring, 1, axis=0) - ring, axis=1).sum() for ring in rings))
