"""What every product answers with: a mesh, the fields it came from, and a report."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.formats.mesh_files import save
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh

Progress = Callable[[str, float], None]


@dataclass(frozen=True, kw_only=True)
class Result:
    """A mesh, the fields it came from, and a report.

    Parameters
    ----------
    surface : Surface
        The mesh as plain arrays, mm.
    report : dict
        Plain numbers and strings: what ``--json`` prints.
    fields : dict
        By stage: "points" (N, 2) and "lines" in mm, "stamp" and "smoothed" (nx, ny), "grid".
    """

    surface: Surface
    report: dict[str, Any]
    fields: dict[str, Any] = field(default_factory=dict, repr=False)

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The mesh as a trimesh.Trimesh, mm."""
        return self.surface.to_trimesh()

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the mesh, the format by suffix, and return the path."""
        return save(self.surface, path)


class Clock:
    """Seconds per stage."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress

    @contextmanager
    def stage(self, name: str, share: float) -> Iterator[None]:
        """Time what is done inside; `share` is how much of the whole is done when it begins."""
        if self._progress is not None:
            self._progress(name, share)
        begin = time.perf_counter()
        yield
        self.seconds[name] = time.perf_counter() - begin
