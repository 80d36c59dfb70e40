"""Short quotations of texts and values for messages: on one line, without control characters."""

from __future__ import annotations

from infill.errors import escape_unprintable


def excerpt(text: str, limit: int = 60) -> str:
    r"""Return a text on one line, with control characters escaped, cut off after `limit` characters.

    >>> excerpt("a\x1b[2J\nb\u202e")
    'a\\x1b[2J b\\u202e'
    """
    words = escape_unprintable(" ".join(text[: limit + 200].split()))
    return words if len(words) <= limit else words[:limit] + "…"


def quote_word(text: str | bytes) -> str:
    """Return a word of a file in quotation marks.

    >>> quote_word(b"1,5")
    "'1,5'"
    """
    return f"'{excerpt(text.decode('utf-8', errors='replace') if isinstance(text, bytes) else text)}'"


def quote_value(value: object) -> str:
    """Return the `repr` of a value, cut off.

    >>> quote_value("a"), len(quote_value(10**4000))
    ("'a'", 61)
    """
    try:
        return excerpt(repr(value))
    except ValueError:  # Python refuses to write a number with thousands of digits
        return "a number of thousands of digits"
