"""Hand a result over: all its files, or none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import BinaryIO

from infill.output import told, whole_files


def deliver(parts: Mapping[Path, Callable[[BinaryIO], object]]) -> list[Path]:
    """Write the files of one run, each by its function, and return their paths.

    Raises
    ------
    OutputError
        If one of the files cannot be written; then none is.
    """
    paths = list(parts)
    if not paths:
        return paths
    with whole_files(paths) as files:
        for path, file in zip(paths, files, strict=True):
            with told(path):
                parts[path](file)
    return paths
