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

import numpy as np

from infill.formats.label_tables import Colour
from infill.formats.mesh_files import PART_WRITERS, parts_writer, save
from infill.formats.parts import Part
from infill.formats.whole_files import whole_file
from infill.surface import Surface
from infill.surfaces.parting import joined

if TYPE_CHECKING:
    import trimesh

Progress = Callable[[str, float], None]
Stages = TypeVar("Stages", covariant=True)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Result(Generic[Stages]):
    """Surfaces, a report, and the stages they came from.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        The meshes as plain arrays, mm, the main one first. `make` names its surface "block", `smooth` "solid".
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    stages : frozen dataclass
        What the surfaces came from: `infill.making.stages.MakeStages`, `infill.smoothing.stages.SmoothStages`,
        `infill.smoothing.labels.LabelStages` or `infill.smoothing.by_component.ComponentStages`.
    colours : mapping of str to (red, green, blue)
        Of surfaces that have one, from 0 to 1, sRGB.
    joins : bool
        Whether several surfaces may go into a file that holds one mesh, one after the other: parts of one thing.
    """

    surfaces: Mapping[str, Surface]
    report: dict[str, Any]
    stages: Stages = field(repr=False)
    colours: Mapping[str, Colour] = field(default_factory=dict)
    joins: bool = False

    def __repr__(self) -> str:
        """Return the surfaces by name, with their triangles and sizes."""
        said = (
            f"{name}: {len(surface.faces):,} triangles, "
            f"{' x '.join(f'{side:.4g}' for side in np.ptp(surface.bounds, axis=0))} mm"
            for name, surface in self.surfaces.items()
        )
        return f"Result({'; '.join(said)})"

    @property
    def surface(self) -> Surface:
        """The only or main surface, mm."""
        return next(iter(self.surfaces.values()))

    @cached_property
    def whole(self) -> Surface:
        """All surfaces as one, one after the other, mm."""
        return joined(list(self.surfaces.values()))

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The only or main surface as a trimesh.Trimesh, mm."""
        return self.surface.to_trimesh()

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the surface, the format by suffix, and return the path.

        Several surfaces go into one .3mf or .glb, each by its name; the components of a mesh into any format.
        """
        target = Path(path)
        if len(self.surfaces) == 1 or (self.joins and target.suffix.lower() not in PART_WRITERS):
            return save(self.whole, target)
        write = parts_writer(target)
        with whole_file(target) as file:
            write(parts_of(self), file)
        return target


def parts_of(result: Result[object]) -> list[Part]:
    """Return the surfaces of a result with their names and colours, as files hold them."""
    return [
        Part(surface=surface, name=name, colour=result.colours.get(name)) for name, surface in result.surfaces.items()
    ]


def told_between(progress: Progress | None, begin: float, end: float) -> Progress | None:
    """Return a listener for a part of the work, which lies between two shares of the whole; None if nobody listens."""
    if progress is None:
        return None
    return lambda stage, share: progress(stage, begin + share * (end - begin))


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
