"""A report of which some sections are found only when somebody asks for them."""

from __future__ import annotations

from collections.abc import Callable, ItemsView, Iterator, Mapping, ValuesView
from typing import Any


class Sections(dict[str, Any]):
    """A dict with string keys, some of whose values are computed when they are first asked for.

    Whoever reads, copies, merges, compares, prints, pickles or writes it as JSON sees a dict like any other.

    Parameters
    ----------
    known : mapping
        The values, in order.
    late : mapping of str to callable, optional
        What returns the value of a key, instead of a value; such a key is in `known` as well, to say where it stands.

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
        """Return whether a value is yet to be computed."""
        return name in self.late

    def replaced(self, **values: Any) -> Sections:  # noqa: ANN401 - values of any type
        """Return the same with other values; those that are yet to be computed stay so."""
        found = Sections(self)
        for name, value in values.items():
            found[name] = value
        return found

    def _computed(self) -> None:
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

    def __iter__(self) -> Iterator[str]:  # without this, dict(report) would not ask for values
        return super().__iter__()

    def get(self, name: str, default: Any = None) -> Any:  # noqa: ANN401 - values of any type
        """Return a value, or the default if there is no such key."""
        return self[name] if name in self else default  # noqa: SIM401 - that is what get is

    def items(self) -> ItemsView[str, Any]:  # type: ignore[override]
        """Return keys and values."""
        self._computed()
        return super().items()

    def values(self) -> ValuesView[Any]:  # type: ignore[override]
        """Return the values."""
        self._computed()
        return super().values()

    def pop(self, name: str, *default: Any) -> Any:  # noqa: ANN401 - values of any type
        """Return a value and take it out."""
        if name in self:
            self[name]
        return super().pop(name, *default)

    def popitem(self) -> tuple[str, Any]:
        """Return the last key and its value, and take them out."""
        self._computed()
        return super().popitem()

    def copy(self) -> dict[str, Any]:
        """Return a plain dict, all of it computed: nothing holds on any more to what that took."""
        return dict(self.items())

    def __reduce__(self) -> tuple[type[dict[str, Any]], tuple[dict[str, Any]]]:
        return dict, (self.copy(),)

    def __repr__(self) -> str:
        self._computed()
        return super().__repr__()

    def __eq__(self, other: object) -> bool:
        self._computed()
        if isinstance(other, Sections):
            other._computed()
        return super().__eq__(other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None

    def __or__(self, other: Mapping[str, Any]) -> dict[str, Any]:  # type: ignore[override]
        return self.copy() | dict(other.items())
