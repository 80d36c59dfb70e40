"""The errors of this package.

PatternError(ValueError)    a parameter, a region or a name from which no pattern can be made
└── PatternUsageError       a parameter that is not of its kind: a word for a number
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Self


def join_names(names: tuple[str, ...]) -> str:
    """Join names as in a sentence.

    >>> join_names(("a",)), join_names(("a", "b", "c"))
    ('a', 'a, b and c')
    """
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


class PatternError(ValueError):
    """A pattern cannot be made from its parameters or region; the message says what to change.

    Attributes
    ----------
    parameters : tuple of str
        The parameters that the message begins with.
    """

    parameters: tuple[str, ...] = ()
    _problem = ""

    @classmethod
    def about(cls, parameters: str | tuple[str, ...], problem: str) -> Self:
        """Return an error about one or several parameters; the message is their names and the problem."""
        names = (parameters,) if isinstance(parameters, str) else parameters
        error = cls(f"{join_names(names)} {problem}")
        error.parameters, error._problem = names, problem
        return error

    @property
    def parameter(self) -> str | None:
        """The parameter that the message is about, or the first of several."""
        return self.parameters[0] if self.parameters else None

    def spell(self, name_of: Callable[[str], str]) -> str:
        """Return the message with other names for its parameters."""
        if not self.parameters:
            return str(self)
        return f"{join_names(tuple(map(name_of, self.parameters)))} {self._problem}"


class PatternUsageError(PatternError):
    """A parameter is not of its kind: a word for a number, a number for a flag."""
