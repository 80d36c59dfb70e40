"""The one error of this package.

PatternError(ValueError)    a parameter, a region or a name from which no pattern can be made
"""


class PatternError(ValueError):
    """A pattern cannot be made from what was given; the message says what to change."""
