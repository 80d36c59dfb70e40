"""Texts and values of files as messages quote them: on one line, without control characters, and not for pages."""

from __future__ import annotations

from infill.errors import printable


def excerpt(text: str, most: int = 60) -> str:
    r"""Return a text on one line, with control characters as escapes, cut off after `most` characters.

    >>> excerpt("a\x1b[2J\nb\u202e")
    'a\\x1b[2J b\\u202e'
    """
    words = printable(" ".join(text[: most + 200].split()))
    return words if len(words) <= most else words[:most] + "…"


def quote_word(text: str | bytes) -> str:
    """Return a word of a file between quotation marks.

    >>> quote_word(b"1,5")
    "'1,5'"
    """
    return f"'{excerpt(text.decode('utf-8', errors='replace') if isinstance(text, bytes) else text)}'"


def quote_value(value: object) -> str:
    """Return a value of any type as Python writes it.

    >>> quote_value("a"), len(quote_value(10**4000))
    ("'a'", 61)
    """
    try:
        return excerpt(repr(value))
    except ValueError:  # a number of so many digits that Python writes it no more
        return "a number of thousands of digits"
