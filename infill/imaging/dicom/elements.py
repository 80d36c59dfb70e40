"""Values of single DICOM elements, checked."""

from __future__ import annotations

import math
import unicodedata
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydicom.dataset import Dataset

Mark = tuple[float | str, ...]


def read_whole_number(header: Dataset, name: str, otherwise: int) -> int:
    """Return a whole number, or `otherwise` if the element is missing or empty."""
    value = header.get(name)
    return otherwise if value is None or value == "" else to_integer(name, value)


def to_integer(name: str, value: Any) -> int:  # noqa: ANN401 - what pydicom makes of an element
    """Convert a value of pydicom to int, or raise ValueError."""
    try:
        return int(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {clean_text(value)!r}") from error


def read_numbers(header: Dataset | None, name: str, count: int | None = None) -> tuple[float, ...] | None:
    """Return the finite numbers of an element; None if it is missing or empty."""
    value = None if header is None else header.get(name)
    if value is None or value == "" or value == []:
        return None
    words = [value] if isinstance(value, str | int | float) else value
    try:
        numbers = tuple(float(word) for word in words)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {clean_text(value)!r}") from error
    if (count is not None and len(numbers) != count) or not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"{name} is {clean_text(value)!r}")
    return numbers


def read_number(header: Dataset | None, name: str) -> float | None:
    """Return the finite number of an element; None if it is missing or empty."""
    numbers = read_numbers(header, name, 1)
    return None if numbers is None else numbers[0]


def read_items(header: Dataset | None, name: str) -> list[Dataset]:
    """Return the items of a sequence; an empty list if it is missing."""
    from pydicom.sequence import Sequence

    value = None if header is None else header.get(name)
    if value is None:
        return []
    if not isinstance(value, Sequence):
        raise ValueError(f"{name} is not a sequence")  # noqa: TRY004 - of a file
    return list(value)


def read_first_item(header: Dataset | None, name: str) -> Dataset | None:
    """Return the first item of a sequence, or None."""
    items = read_items(header, name)
    return items[0] if items else None


def to_mark(value: Any) -> Mark:  # noqa: ANN401 - what pydicom makes of an element
    """Convert a value to a tuple that can be compared and sorted."""
    words = [value] if isinstance(value, str | int | float) or not hasattr(value, "__iter__") else list(value)
    return tuple(float(word) if isinstance(word, int | float) else clean_text(word) for word in words)


def clean_text(value: object) -> str:
    r"""Return a text on one line, without control characters, truncated if it is long.

    >>> clean_text("a\x1b[31m  b")
    'a[31m b'
    """
    words = " ".join(str(value).split())
    visible = "".join(character for character in words if not unicodedata.category(character).startswith("C"))
    return visible if len(visible) <= 64 else f"{visible[:64]}…"
