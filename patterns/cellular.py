"""The patterns that repeat in space, by name."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping

from patterns.errors import PatternError
from patterns.unit_cells import Cellular


class _Catalogue(Mapping[str, Cellular]):
    """Patterns in space by name."""

    def _all(self) -> dict[str, Cellular]:
        from patterns.hatch import CROSS_HATCH
        from patterns.honeycombs import HONEYCOMBS
        from patterns.planes import PLANES
        from patterns.struts import STRUTS
        from patterns.tpms import NETWORKS, TPMS

        return {each.name: each for each in (*TPMS, CROSS_HATCH, *PLANES, *HONEYCOMBS, *NETWORKS, *STRUTS)}

    def __getitem__(self, name: str) -> Cellular:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())


CELLULAR: Mapping[str, Cellular] = _Catalogue()


def no_such(name: str, names: Iterable[str]) -> PatternError:
    """Return the error that no pattern has a name, with the nearest one that there is."""
    names = list(names)
    near = difflib.get_close_matches(name.lower(), names, n=1, cutoff=0.4)
    advice = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(names)}"
    return PatternError(f"there is no pattern {name!r}; {advice}")
