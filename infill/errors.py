"""The errors of this package, one leaf per condition.

InfillError
├── ParameterError(ValueError)      a number out of range
│   └── UsageError                  a word for a number, none of the choices, or things that exclude each other
├── FormatError(ValueError)         a file suffix or file contents we cannot use
├── GeometryError(ValueError)       the mesh would come out wrong: open, broken, a feature lost
├── MemoryLimitError(ValueError)    a grid that exceeds the available memory
└── OutputError(OSError)            a file that exists, or cannot be written

A message is one line: the given value, the limit, and the remedy. A message about an argument begins with its name in
Python: "line_width is -1 mm; ..."; the command line replaces the name by the option. `patterns`
has its own errors, `patterns.PatternError`, since it may not import this package.
"""


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
    """Base class of all errors that this package raises deliberately; the text is always a single line."""

    def __str__(self) -> str:
        """Return the message with control characters escaped."""
        return escape_unprintable(super().__str__())


class ParameterError(InfillError, ValueError):
    """A parameter is out of range."""


class UsageError(ParameterError):
    """An argument has the wrong type or is not one of the choices, or two arguments exclude each other."""


class FormatError(InfillError, ValueError):
    """A file suffix is unknown, or the content of a file is wrong."""


class GeometryError(InfillError, ValueError):
    """The result would not be the requested part."""


class MemoryLimitError(InfillError, ValueError):
    """The work needs more memory than is available."""


class OutputError(InfillError, OSError):
    """A file cannot be written, or may not be overwritten."""
