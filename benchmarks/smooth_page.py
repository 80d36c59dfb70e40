"""The page of the report on smoothing: tables between markers, in a page whose words are written by hand."""

from __future__ import annotations

from pathlib import Path


def marked(page: str, name: str, text: str) -> str:
    """Return the page with `text` between the markers of that name.

    >>> print(marked("a\\n<!-- t: begin -->\\nold\\n<!-- t: end -->\\nb", "t", "new\\n"))
    a
    <!-- t: begin -->
    <BLANKLINE>
    new
    <BLANKLINE>
    <!-- t: end -->
    b

    Raises
    ------
    ValueError
        If the page has not both markers, once each and in order.
    """
    begin, end = (f"<!-- {name}: {word} -->" for word in ("begin", "end"))
    if page.count(begin) != 1 or page.count(end) != 1 or page.index(begin) > page.index(end):
        raise ValueError(f"the page needs {begin} and {end}, once each and in this order")
    before, _, rest = page.partition(begin)
    return f"{before}{begin}\n\n{text.strip()}\n\n{end}{rest.partition(end)[2]}"


def put(path: Path, name: str, text: str) -> None:
    """Write a section of the page anew."""
    path.write_text(marked(path.read_text(encoding="utf-8"), name, text), encoding="utf-8", newline="\n")
