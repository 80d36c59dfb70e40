"""Dataclasses whose fields are arrays of the same length, or such dataclasses: cut, and put one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

Columns = TypeVar("Columns")


def part(columns: Columns, some: slice) -> Columns:
    """Return some of the rows."""
    return type(columns)(**{name: _part(value, some) for name, value in _items(columns)})


def chained(several: Sequence[Columns]) -> Columns:
    """Return the rows of several, one after the other; at least one is needed."""
    if len(several) == 1:
        return several[0]
    columns = {name: [getattr(each, name) for each in several] for name, _ in _items(several[0])}
    return type(several[0])(
        **{
            name: np.concatenate(values) if isinstance(values[0], np.ndarray) else chained(values)
            for name, values in columns.items()
        }
    )


def _items(columns: Any) -> list[tuple[str, Any]]:  # noqa: ANN401 - whatever the dataclass holds
    return [(each.name, getattr(columns, each.name)) for each in fields(columns)]


def _part(value: Any, some: slice) -> Any:  # noqa: ANN401
    return value[some] if isinstance(value, np.ndarray) else part(value, some)
