"""The errors of this package.

PatternError(ValueError)    a parameter, a region or a name from which no pattern can be made
└── PatternUsageError       a parameter that is not of its kind: a word for a number
"""


class PatternError(ValueError):
    """A pattern cannot be made from its parameters or region; the message says what to change."""


class PatternUsageError(PatternError):
    """A parameter is not of its kind: a word for a number, a number for a flag."""
