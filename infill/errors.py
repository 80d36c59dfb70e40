"""The errors of this package, one leaf per condition.

InfillError
├── ParameterError(ValueError)      a number out of range
│   └── UsageError                  a word for a number, none of the choices, or things that exclude each other
├── FormatError(ValueError)         a file suffix or file contents we cannot use
├── GeometryError(ValueError)       the mesh would come out wrong: open, broken, a feature lost
├── MemoryLimitError(ValueError)    a grid that exceeds the available memory
└── OutputError(OSError)            a file that exists, or cannot be written

A message is one line: what was given, what the limit is, what to do. One about an argument begins with its name, as
Python spells it: "line_width is -1 mm; ..."; the command line puts the option that was typed in its place. `patterns`
has its own errors, `patterns.PatternError`, since it may not import this package.
"""

import re

# What a terminal acts on, does not show or shows in another order, and what ends a line: files and their names may
# hold it.
UNPRINTABLE = re.compile(
    "[\x00-\x1f\x7f-\x9f\xad\u061c\u200b\u200e\u200f\u2028-\u202e\u2060-\u2069\ufeff\ud800-\udfff]"
)


def printable(text: str) -> str:
    r"""Return a text on one line, with control characters, and those that turn its direction, as escapes.

    >>> print(printable("a.nrrd holds \x1b[31m"))
    a.nrrd holds \x1b[31m
    """
    return UNPRINTABLE.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)


class InfillError(Exception):
    """Base class of every error this package raises on purpose; its text is one line, whatever it quotes."""

    def __str__(self) -> str:
        """Return the message with control characters as escapes."""
        return printable(super().__str__())


class ParameterError(InfillError, ValueError):
    """A parameter is out of range."""


class UsageError(ParameterError):
    """An argument is not of its kind or none of the choices, or two arguments exclude each other."""


class FormatError(InfillError, ValueError):
    """A file suffix is unknown, or a file holds something other than it should."""


class GeometryError(InfillError, ValueError):
    """The result would not be the part that was asked for."""


class MemoryLimitError(InfillError, ValueError):
    """The work needs more memory than is available."""


class OutputError(InfillError, OSError):
    """A file cannot be written, or may not be overwritten."""
