"""What every product returns: named surfaces, a report, and the stages they came from."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from infill.formats.label_tables import Colour
from infill.formats.mesh_files import parts_writer, save
from infill.formats.parts import Part
from infill.formats.whole_files import whole_file
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh

Progress = Callable[[str, float], None]
Stages = TypeVar("Stages", covariant=True)


@dataclass(frozen=True, kw_only=True)
class Result(Generic[Stages]):
    """Surfaces, a report, and the stages they came from.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        The meshes as plain arrays, mm, the main one first. `make` names its surface "block", `smooth` "solid".
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    stages : frozen dataclass
        What the surfaces came from: `infill.making.stages.MakeStages`, `infill.smoothing.stages.SmoothStages` or
        `infill.smoothing.labels.LabelStages`.
    colours : mapping of str to (red, green, blue)
        Of surfaces that have one, from 0 to 1, sRGB.
    """

    surfaces: Mapping[str, Surface]
    report: dict[str, Any]
    stages: Stages = field(repr=False)
    colours: Mapping[str, Colour] = field(default_factory=dict)

    @property
    def surface(self) -> Surface:
        """The only or main surface, mm."""
        return next(iter(self.surfaces.values()))

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The only or main surface as a trimesh.Trimesh, mm."""
        return self.surface.to_trimesh()

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the surface, the format by suffix, and return the path.

        Several surfaces go into one .3mf or .glb, each by its name.
        """
        if len(self.surfaces) == 1:
            return save(self.surface, path)
        target = Path(path)
        write = parts_writer(target)
        with whole_file(target) as file:
            write(self.parts, file)
        return target

    @property
    def parts(self) -> list[Part]:
        """The surfaces with their names and colours, as files hold them."""
        return [
            Part(surface=surface, name=name, colour=self.colours.get(name)) for name, surface in self.surfaces.items()
        ]


class Clock:
    """Seconds per stage."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress

    @contextmanager
    def stage(self, name: str, share: float) -> Iterator[None]:
        """Time the enclosed code; `share` is how much of the whole is done when it begins."""
        self.tell(name, share)
        begin = time.perf_counter()
        yield
        self.seconds[name] = time.perf_counter() - begin

    def tell(self, name: str, share: float) -> None:
        """Report to any listener how much of the whole is done."""
        if self._progress is not None:
            self._progress(name, share)
