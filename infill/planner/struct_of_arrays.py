"""Dataclasses whose fields are arrays of equal length, or such dataclasses: slicing and concatenation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

Columns = TypeVar("Columns")


def slice_rows(columns: Columns, rows: slice) -> Columns:
    """Return a slice of the rows."""
    return type(columns)(**{name: _slice_value(value, rows) for name, value in _field_values(columns)})


def concatenate_rows(several: Sequence[Columns]) -> Columns:
    """Concatenate the rows of one or more dataclasses."""
    if len(several) == 1:
        return several[0]
    columns = {name: [getattr(item, name) for item in several] for name, _ in _field_values(several[0])}
    return type(several[0])(
        **{
            name: np.concatenate(values) if isinstance(values[0], np.ndarray) else concatenate_rows(values)
            for name, values in columns.items()
        }
    )


def _field_values(columns: Any) -> list[tuple[str, Any]]:  # noqa: ANN401 - whatever the dataclass holds
    """Return the fields of a dataclass with their values."""
    return [(item.name, getattr(columns, item.name)) for item in fields(columns)]


def _slice_value(value: Any, rows: slice) -> Any:  # noqa: ANN401
    """Return some rows of an array, or of a dataclass of arrays."""
    return value[rows] if isinstance(value, np.ndarray) else slice_rows(value, rows)
