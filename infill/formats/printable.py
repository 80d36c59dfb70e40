"""Texts and values of files as messages show them: on one line, without control characters, and not for pages."""

from __future__ import annotations


def printable(text: str, most: int = 60) -> str:
    r"""Return a text on one line, without control characters, cut off after `most` signs.

    >>> printable("a\x1b[2J\nb\u202e")
    'a\\x1b[2J b\\u202e'
    """
    words = " ".join(text[: most + 200].split())
    shown_words = "".join(each if each.isprintable() else ascii(each)[1:-1] for each in words)
    return shown_words if len(shown_words) <= most else shown_words[:most] + "…"


def shown(value: object) -> str:
    """Return a value of any type likewise.

    >>> shown("a"), len(shown(10**4000))
    ("'a'", 61)
    """
    try:
        return printable(repr(value))
    except ValueError:  # a number of so many digits that Python writes it no more
        return "a number of thousands of digits"
