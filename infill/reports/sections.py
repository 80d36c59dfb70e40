"""A report with sections that are computed only when they are read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar, cast

Keys = TypeVar("Keys", bound=Mapping[str, Any])


def _after_all(name: str) -> Callable[..., Any]:
    """Return a method of dict that computes all values first."""
    method = getattr(dict, name)

    def call(self: Sections, *arguments: Any, **keywords: Any) -> Any:  # noqa: ANN401 - those of the method
        """Compute all late values, then call the method."""
        for sections in (self, *arguments):
            for key in list(sections.late) if isinstance(sections, Sections) else ():
                sections[key]
        return method(self, *arguments, **keywords)

    return call


class Sections(dict[str, Any]):
    """A dict with string keys that computes some of its values when they are first read.

    Reading, copying, merging, comparing, printing, pickling and writing JSON work as for any other dict. Copies are
    plain dicts, which hold no references to the inputs.

    Parameters
    ----------
    known : mapping
        The values, in order.
    late : mapping of str to callable
        Functions that compute values, by key. Such a key is in `known` as well, which defines its position.

    >>> report = Sections({"volume": 2.0, "distance": None}, {"distance": lambda: 0.5})
    >>> report.pending("distance"), report["distance"], report.pending("distance")
    (True, 0.5, False)
    """

    def __init__(self, known: Mapping[str, Any], late: Mapping[str, Callable[[], Any]]) -> None:
        super().__init__(known)
        self.late = dict(late)

    def pending(self, name: str) -> bool:
        """Tell whether a value is not computed yet."""
        return name in self.late

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401 - values of any type
        if name in self.late:
            self[name] = self.late[name]()
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

    def __reduce__(self) -> tuple[type[dict[str, Any]], tuple[dict[str, Any]]]:
        return dict, (self.copy(),)

    items, values, copy = map(_after_all, ("items", "values", "copy"))
    pop, popitem, setdefault, update = map(_after_all, ("pop", "popitem", "setdefault", "update"))
    __eq__, __ne__, __or__, __ior__, __repr__ = map(_after_all, ("__eq__", "__ne__", "__or__", "__ior__", "__repr__"))
    __hash__ = None


def add_late_section(report: Mapping[str, Any], name: str, compute: Callable[[], Any]) -> None:
    """Let another section of a report of `with_late_sections` be computed when it is first read."""
    cast("Sections", report).late[name] = compute


def with_late_sections(report: Keys, **late: Callable[[], Any]) -> Keys:
    """Return a report that computes some of its sections when they are first read."""
    return cast("Keys", Sections(report, late))
