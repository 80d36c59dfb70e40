"""The result of every product: named surfaces, a report, and intermediate stages."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Generic, Protocol, TypeVar, cast, runtime_checkable

import numpy as np

from infill.errors import OutputError
from infill.files.whole_files import atomic_file
from infill.formats.mesh_files import PART_WRITERS, mesh_writer, parts_writer
from infill.formats.parts import LatePart, Part
from infill.imaging.label_tables import Colour
from infill.meshes.split_components import concatenate_surfaces
from infill.pictures.picturable import Picturable
from infill.pictures.picture_files import PAGES, is_page, is_picture
from infill.pictures.picture_files import SUFFIXES as PICTURES
from infill.plain_numbers import plain_size
from infill.reports.common import Declared, declare
from infill.surface import Surface
from infill.viewer.viewable import Viewable

if TYPE_CHECKING:
    import trimesh
    from PIL import Image

Progress = Callable[[str, float], None]
BEFORE = "before"  # the name on a page of the surface before smoothing
MOST_BEFORE = 300_000  # triangles of it that a page may have
UNNAMED = frozenset({"block", "solid"})  # of surfaces that no input has named


class Pictured(Protocol):
    """Stages that can be shown."""

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return the stages, and the surface that they led to, as one picture."""
        ...


@runtime_checkable
class Compared(Protocol):
    """Stages that know the surface before their work."""

    def before(self) -> Surface:
        """Return it, mm."""
        ...


Stages = TypeVar("Stages", bound=Pictured, covariant=True)
Told = TypeVar("Told", bound=Mapping[str, Any], covariant=True)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Result(Picturable, Viewable, Generic[Stages, Told]):
    """Surfaces, a report, and the intermediate stages.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        The meshes as plain arrays, mm, the main one first. `make` names its surface "block", `smooth` "solid".
    report : dict
        Plain numbers and strings, as ``--json`` prints them. docs/report.md lists every key, and type checkers find
        the keys in `infill.reports`.
    stages : frozen dataclass
        Intermediate stages: `infill.making.stages.MakeStages`, `infill.smoothing.stages.SmoothStages`,
        `infill.smoothing.labels.LabelStages` or `infill.smoothing.by_component.ComponentStages`.
    colours : mapping of str to (red, green, blue)
        Of surfaces that have one, from 0 to 1, sRGB.
    joins : bool
        Whether several surfaces may be concatenated into a file that holds a single mesh.
    writers : mapping of str to callable
        Functions that write what this result alone has, by the suffix of the file, such as walls that labels share.
    """

    surfaces: Mapping[str, Surface]
    report: Told
    stages: Stages = field(repr=False)
    colours: Mapping[str, Colour] = field(default_factory=dict)
    joins: bool = False
    writers: Mapping[str, Callable[[BinaryIO], None]] = field(default_factory=dict, repr=False)

    def __repr__(self) -> str:
        """Return the names of the surfaces, with their triangles and sizes."""
        summaries = (
            f"{name}: {len(surface.faces):,} triangles, {plain_size(*np.ptp(surface.bounds, axis=0), digits=4)}"
            for name, surface in self.surfaces.items()
        )
        return f"Result({'; '.join(summaries)})"

    @property
    def surface(self) -> Surface:
        """The only or main surface, mm."""
        return next(iter(self.surfaces.values()))

    @cached_property
    def whole(self) -> Surface:
        """All surfaces concatenated into one, mm."""
        return concatenate_surfaces(list(self.surfaces.values()))

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The only or main surface as a trimesh.Trimesh, mm."""
        return self.surface.to_trimesh()

    def picture(self) -> Image.Image:
        """Return the stages as one picture: points, stamp, field and mesh of a block; before and after of a solid."""
        return self.stages.picture(self.whole, self.report)

    def page(self, title: str | None = None) -> str:
        """Return an HTML page that shows the surfaces, can be turned and cut open, and needs no network.

        Parameters
        ----------
        title : str, optional
            By default, the pattern or the product.
        """
        from infill.viewer.page import surface_page

        request: Mapping[str, Any] = self.report.get("request") or {}
        named = title or request.get("pattern") or self.report.get("product") or "infill"
        before = self.stages.before() if isinstance(self.stages, Compared) else None
        hidden: dict[str, Surface] = {} if before is None or len(before.faces) > MOST_BEFORE else {BEFORE: before}
        return surface_page(
            {**self.surfaces, **hidden},
            title=str(named),
            report=self.report,
            colours=self.colours,
            cut="y" if self.report.get("product") == "fill" else None,
            hidden=tuple(hidden),
        )

    def preview_writer(self, path: str | os.PathLike[str], title: str | None = None) -> Callable[[BinaryIO], None]:
        """Return the function that writes a page for a .html, and a picture for other paths."""
        return partial(self.write_page, title=title) if is_page(path) else self.write_picture

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = True) -> Path:
        """Write the mesh, a picture of the stages, or a page, in the format of the suffix; return the path.

        Several surfaces go into one .3mf or .glb, each by its name; the components of a mesh into any format; labels
        that share their walls also into one .ply or .vtp, which holds every wall once, with the labels on both sides,
        and as tetrahedra into a .vtu.

        Parameters
        ----------
        path : str or Path
            .stl, .3mf, .obj, .ply or .glb for the mesh, in mm; .vtp or .vtu for labels that share their walls; .png
            for `picture`; .html for `page`, which shows the mesh in any browser.
        overwrite : bool
            Whether an existing file is replaced, once the new one is complete. By default it is, as by `numpy.save`,
            `Image.save` and `Trimesh.export`: a script or a notebook cell that is run again should not fail. The
            command keeps existing files unless it is asked to overwrite them: a file lost by a typing mistake is gone.

        Raises
        ------
        FormatError
            For an unknown suffix, or a format that cannot hold several surfaces.
        OutputError
            If the file cannot be written, or exists and may not be overwritten.
        """
        target = Path(path)
        write = self._writer(target)
        if not overwrite and os.path.lexists(target):
            raise OutputError(f"{target} exists; give another name, or leave out overwrite=False")
        with atomic_file(target) as file:
            write(file)
        return target

    def _writer(self, target: Path) -> Callable[[BinaryIO], None]:
        """Return the function that writes the format of a path."""
        if is_picture(target) or is_page(target):
            return self.preview_writer(target)
        if target.suffix.lower() in self.writers:
            return self.writers[target.suffix.lower()]
        write_one = mesh_writer(target, more=(*PICTURES, *PAGES))  # raises for an unknown suffix
        holds_names = target.suffix.lower() in PART_WRITERS
        named = not UNNAMED.issuperset(self.surfaces)
        if not (holds_names and named) and (len(self.surfaces) == 1 or self.joins):
            return lambda file: write_one(self.whole, file)
        write_several = parts_writer(target)
        return lambda file: write_several(parts_of(self), file)


def parts_of(result: Result[Any, Any]) -> list[Part]:
    """Return the surfaces of a result with their names and colours, as files hold them."""
    if not isinstance(result.surfaces, dict):  # each is made or read when it is asked for
        late = [
            LatePart(surfaces=result.surfaces, name=name, colour=result.colours.get(name)) for name in result.surfaces
        ]
        return cast("list[Part]", late)
    return [
        Part(surface=surface, name=name, colour=result.colours.get(name)) for name, surface in result.surfaces.items()
    ]


def share_progress(progress: Progress | None, sizes: Sequence[int]) -> list[Progress | None]:
    """Divide a listener into one for each part of a work, by the sizes of the parts; None without a listener."""
    return [
        progress and _progress_between(progress, (upto - size) / sum(sizes), upto / sum(sizes))
        for size, upto in zip(sizes, accumulate(sizes), strict=True)
    ]


def _progress_between(progress: Progress, begin: float, end: float) -> Progress:
    """Return a listener that maps progress from 0 to 1 onto a part of the whole."""
    return lambda stage, share: progress(stage, begin + share * (end - begin))


class Clock:
    """Seconds per stage; repeated stages add up."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress

    @contextlib.contextmanager
    def stage(self, name: str, share: float) -> Iterator[None]:
        """Time the enclosed code; `share` is the share of the work that is done when it begins."""
        self.tell(name, share)
        begin = time.perf_counter()
        yield
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - begin

    def timings(self, declaration: Callable[..., Declared], **unless_timed: float) -> Declared:
        """Return the seconds by stage, and their total, as a section of a report; stages may not have run."""
        return declare(declaration, {**unless_timed, **self.seconds, "total": sum(self.seconds.values())})

    def tell(self, name: str, share: float) -> None:
        """Report the finished share of the work to the listener, if any."""
        if self._progress is not None:
            self._progress(name, share)
