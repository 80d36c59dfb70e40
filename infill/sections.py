"""A report with sections that are computed only when they are read."""

from __future__ import annotations

from collections.abc import Callable, ItemsView, Iterator, Mapping, ValuesView
from typing import Any


class Sections(dict[str, Any]):
    """A dict with string keys that computes some of its values when they are first read.

    Reading, copying, merging, comparing, printing, pickling and writing JSON work as for any other dict.

    Parameters
    ----------
    known : mapping
        The values, in order.
    late : mapping of str to callable, optional
        Functions that compute values, by key. Such a key is in `known` as well, which defines its position.

    >>> report = Sections({"volume": 2.0, "distance": None}, {"distance": lambda: 0.5})
    >>> report.pending("distance"), report["distance"], report.pending("distance")
    (True, 0.5, False)
    """

    def __init__(self, known: Mapping[str, Any], late: Mapping[str, Callable[[], Any]] | None = None) -> None:
        self.late: dict[str, Callable[[], Any]] = dict(late or {})
        if isinstance(known, Sections):
            self.late = {**known.late, **self.late}
            known = {name: known.raw(name) for name in known}
        super().__init__(known)

    def raw(self, name: str) -> Any:  # noqa: ANN401 - values of any type
        """Return a value without computing it."""
        return super().__getitem__(name)

    def pending(self, name: str) -> bool:
        """Tell whether a value is not computed yet."""
        return name in self.late

    def replaced(self, **values: Any) -> Sections:  # noqa: ANN401 - values of any type
        """Return a copy with changed values; pending values stay pending."""
        updated = Sections(self)
        for name, value in values.items():
            updated[name] = value
        return updated

    def _compute_all(self) -> None:
        """Compute all pending values."""
        for name in list(self.late):
            self[name]

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401 - values of any type
        if name in self.late:
            super().__setitem__(name, self.late[name]())
            del self.late[name]
        return super().__getitem__(name)

    def __setitem__(self, name: str, value: Any) -> None:  # noqa: ANN401 - values of any type
        self.late.pop(name, None)
        super().__setitem__(name, value)

    def __delitem__(self, name: str) -> None:
        self.late.pop(name, None)
        super().__delitem__(name)

    def __iter__(self) -> Iterator[str]:  # without this, dict(report) would not compute values
        return super().__iter__()

    def get(self, name: str, default: Any = None) -> Any:  # noqa: ANN401 - values of any type
        """Return a value, or the default for a missing key."""
        return self[name] if name in self else default  # noqa: SIM401 - this is the implementation of get

    def items(self) -> ItemsView[str, Any]:  # type: ignore[override]
        """Return keys and values."""
        self._compute_all()
        return super().items()

    def values(self) -> ValuesView[Any]:  # type: ignore[override]
        """Return the values."""
        self._compute_all()
        return super().values()

    def pop(self, name: str, *default: Any) -> Any:  # noqa: ANN401 - values of any type
        """Remove a key and return its value, computed now if it is pending."""
        if name in self:
            self[name]
        return super().pop(name, *default)

    def popitem(self) -> tuple[str, Any]:
        """Remove the last key; return it and its value."""
        self._compute_all()
        return super().popitem()

    def copy(self) -> dict[str, Any]:
        """Compute all values and return them as a plain dict, which holds no references to the inputs."""
        return dict(self.items())

    def __reduce__(self) -> tuple[type[dict[str, Any]], tuple[dict[str, Any]]]:
        return dict, (self.copy(),)

    def __repr__(self) -> str:
        self._compute_all()
        return super().__repr__()

    def __eq__(self, other: object) -> bool:
        self._compute_all()
        if isinstance(other, Sections):
            other._compute_all()
        return super().__eq__(other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None

    def __or__(self, other: Mapping[str, Any]) -> dict[str, Any]:  # type: ignore[override]
        return self.copy() | dict(other.items())
