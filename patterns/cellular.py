"""The patterns in space, by name: periodic ones, and those that follow the skin of a part."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping

from patterns.cross import Cross3D
from patterns.errors import PatternError
from patterns.lightning import LIGHTNING, Lightning
from patterns.octree import OCTREES, Octree
from patterns.unit_cells import Cellular

Unlined = Cellular | Octree | Lightning  # no lines at any height describe them
InSpace = Unlined | Cross3D


class _Catalogue(Mapping[str, InSpace]):
    """Patterns in space by name."""

    def _all(self) -> dict[str, InSpace]:
        from patterns.hatch import CROSS_HATCH
        from patterns.honeycombs import HONEYCOMBS
        from patterns.planes import PLANES
        from patterns.struts import STRUTS
        from patterns.tpms import NETWORKS, TPMS

        wall_patterns = (CROSS_HATCH, Cross3D(), *PLANES, *OCTREES, LIGHTNING, *HONEYCOMBS)
        return {pattern.name: pattern for pattern in (*TPMS, *wall_patterns, *NETWORKS, *STRUTS)}

    def __getitem__(self, name: str) -> InSpace:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())


CELLULAR: Mapping[str, InSpace] = _Catalogue()


def unknown_pattern_error(name: str, names: Iterable[str]) -> PatternError:
    """Return the error for an unknown pattern, with the nearest known name."""
    names = list(names)
    matches = difflib.get_close_matches(name.lower(), names, n=1, cutoff=0.4)
    advice = f"did you mean {matches[0]!r}?" if matches else f"there are {', '.join(names)}"
    return PatternError(f"there is no pattern {name!r}; {advice}")
