"""The errors of this package, one leaf per condition.

InfillError
├── ParameterError(ValueError)      a number out of range
│   ├── UsageError                  a word for a number, none of the choices, or things that exclude each other
│   └── LabelChoiceError            a volume of labels, and nothing says which are wanted
├── FormatError(ValueError)         a file suffix or file contents we cannot use
├── GeometryError(ValueError)       the mesh would come out wrong: open, broken, a feature lost
├── MemoryLimitError(ValueError)    a grid that exceeds the available memory
└── OutputError(OSError)            a file that exists, or cannot be written

A message is one line: the given value, the limit, and the remedy. A message about an argument begins with its name in
Python: "line_width is -1 mm; ...". `about` makes such an error, which carries the name as `parameter`; the command line
writes the option in its place. `patterns` has its own errors, `patterns.PatternError`, since it may not import this
package.
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


def escape_unprintable(text: str) -> str:
    r"""Return a text on one line, with control and invisible characters escaped.

    >>> print(escape_unprintable("a.nrrd holds \x1b[31m"))
    a.nrrd holds \x1b[31m
    """
    return (
        text
        if text.isprintable()
        else "".join(character if character.isprintable() else ascii(character)[1:-1] for character in text)
    )


class InfillError(Exception):
    """Base class of all errors that this package raises deliberately; the text is always a single line.

    Attributes
    ----------
    parameters : tuple of str
        The arguments that the message is about, as Python spells them; it begins with them.

    >>> error = ParameterError.about("voxel", "is -1 mm; give a number above 0")
    >>> error.parameter, str(error)
    ('voxel', 'voxel is -1 mm; give a number above 0')
    """

    parameters: tuple[str, ...] = ()
    _place = ""
    _problem = ""

    @classmethod
    def about(cls, parameters: str | tuple[str, ...], problem: str) -> Self:
        """Return an error about one or several arguments; the message is their names and the problem.

        >>> ParameterError.about("size x", "is -3 mm").parameter  # a part of an argument
        'size'
        """
        if isinstance(parameters, str):
            parameters, _, part = parameters.partition(" ")
            parameters, problem = (parameters,), f"{part} {problem}" if part else problem
        names = parameters
        error = cls(f"{join_names(names)} {problem}")
        error.parameters, error._problem = names, problem
        return error

    @classmethod
    def like(cls, error: Exception) -> Self:
        """Return an error of this class with the message and the parameters of another."""
        parameters = getattr(error, "parameters", ())
        return cls.about(parameters, error._problem) if parameters else cls(str(error))  # type: ignore[attr-defined]

    def within(self, place: str) -> Self:
        """Return the error with a place before its message, such as the name of a label."""
        error = type(self)(f"{place}: {self}")
        error.parameters, error._problem, error._place = self.parameters, self._problem, f"{place}: "
        return error

    @property
    def parameter(self) -> str | None:
        """The argument that the message is about, or the first of several."""
        return self.parameters[0] if self.parameters else None

    def spell(self, name_of: Callable[[str], str]) -> str:
        """Return the message with other names for its parameters.

        >>> ParameterError.about(("voxel", "resolution"), "are both given").spell(lambda name: f"--{name}")
        '--voxel and --resolution are both given'
        """
        if not self.parameters:
            return str(self)
        names = join_names(tuple(map(name_of, self.parameters)))
        return escape_unprintable(f"{self._place}{names} {self._problem}")

    def __str__(self) -> str:
        """Return the message with control characters escaped."""
        return escape_unprintable(super().__str__())


class ParameterError(InfillError, ValueError):
    """A parameter is out of range."""


class UsageError(ParameterError):
    """An argument has the wrong type or is not one of the choices, or two arguments exclude each other."""


class LabelChoiceError(ParameterError):
    """A volume holds labels, and nothing says which of them are wanted."""


class FormatError(InfillError, ValueError):
    """A file suffix is unknown, or the content of a file is wrong."""


class GeometryError(InfillError, ValueError):
    """The result would not be the requested part."""


class MemoryLimitError(InfillError, ValueError):
    """The work needs more memory than is available."""


class OutputError(InfillError, OSError):
    """A file cannot be written, or may not be overwritten."""
