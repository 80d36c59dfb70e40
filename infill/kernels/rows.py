"""Rows copied number by number.

To assign a slice, numba compiles the words of an error too, which takes five seconds for every kind of array.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

from infill.kernels.compiling import njit


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def copy_row(target, source):
    """Copy a row of numbers to another of the same length."""
    for k in range(len(source)):
        target[k] = source[k]
