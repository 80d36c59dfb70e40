"""Tables of Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table.

    >>> print(table(("a", "b"), [("1", "2")]), end="")
    | a | b |
    |---|---|
    | 1 | 2 |
    """
    lines = [head, *rows]
    if any(len(line) != len(head) for line in lines):
        raise ValueError(f"a table of {len(head)} columns has rows of other lengths")
    told = ["| " + " | ".join(cell.replace("|", "/") for cell in line) + " |" for line in lines]
    return "\n".join([told[0], "|" + "---|" * len(head), *told[1:], ""])


def percent(value: float) -> str:
    """Return a change in percent, with its sign.

    >>> percent(-0.1234), percent(0.0), percent(0.00001)
    ('−12.3 %', '0 %', '0 %')
    """
    text = f"{100 * value:+.1f} %".replace("-", "−")
    return "0 %" if text in ("+0.0 %", "−0.0 %") else text


def shown(value: float, form: str) -> str:
    """Return a number in a form of `str.format`, with a space before the sign of per cent and no sign of nothing.

    >>> shown(0.126, "{:.1%}"), shown(-0.00001, "{:+.1%}"), shown(-0.02, "{:+.1%}"), shown(0.946, "{:.3f}")
    ('12.6 %', '0 %', '−2.0 %', '0.946')
    """
    text = form.format(value).replace("-", "−").replace("%", " %")
    return "0 %" if text in ("0.0 %", "+0.0 %", "−0.0 %") else text


def verdict(reached: bool) -> str:
    return "yes" if reached else "**NOT reached**"
