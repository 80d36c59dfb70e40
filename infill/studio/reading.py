"""Uploaded files: their kinds, and their content for products."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from infill.errors import FormatError
from infill.files.suffixes import MESHES, PRINTS
from infill.studio.frames import ANSWER, MESH, AnswerFrame
from infill.studio.numbers import Number
from infill.viewer.packing import pack_surfaces

if TYPE_CHECKING:
    from infill.result import Progress
    from infill.surface import Surface

Kind = Literal["part", "print", "scan", "tile", "field"]
TILES = (".svg", ".dxf", ".wkt", ".png", ".jpg", ".jpeg", ".bmp")
FIELDS = (".csv", ".vtu", ".frd")
ARRAYS = (".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".mgz", ".mgh", ".dcm", ".npy", ".npz", ".tif", ".tiff")
SCANS = (*ARRAYS, ".vti", ".vtk", ".zip")
TAKEN = (*MESHES, *PRINTS, ".gcode.3mf", *SCANS, *TILES, *FIELDS)
KINDS: tuple[Kind, ...] = ("part", "print", "scan", "tile", "field")


@dataclass(frozen=True, kw_only=True, eq=False)
class Content:
    """An uploaded file, read.

    Parameters
    ----------
    kind : str
    name : str
        In the folder of the page.
    path : str
        The file for the library, or the unpacked one.
    data : any
        A Surface, a Volume or a ReadPrint, by kind.
    facts : dict
        Facts for the page, beside kind and name.
    numbers : tuple of Number
    """

    kind: Kind
    name: str
    path: str
    data: Any = None
    facts: Mapping[str, Any] = field(default_factory=dict)
    numbers: tuple[Number, ...] = ()
    kept: dict[str, Any] = field(default_factory=dict)  # what quick looks use again

    def frames(self, file_id: str, warnings: list[str]) -> Iterator[AnswerFrame]:
        """Yield the answer to an upload."""
        answer = {
            "file": file_id,
            "kind": self.kind,
            "name": self.name,
            "numbers": [number.facts() for number in self.numbers],
            "warnings": list(warnings),
            **self.facts,
        }
        yield AnswerFrame.of_json(ANSWER, answer)
        if self.kind == "part":
            yield AnswerFrame(kind=MESH, payload=pack_surfaces({"part": self.data}))


def guess_kind(name: str, requested: str = "") -> Kind:
    """Return the kind of a file, by its name and content, or raise FormatError.

    >>> guess_kind("part.STL"), guess_kind("plate.gcode.3mf"), guess_kind("brain.nii.gz"), guess_kind("load.csv")
    ('part', 'print', 'scan', 'field')
    """
    lower = name.lower()
    kind = next((kind for kind in KINDS if kind == requested), None)
    if kind is not None:
        return kind
    if Path(name).is_dir():  # of DICOM or slices, named on the command line
        return "scan"
    if lower.endswith((".gcode.3mf", *PRINTS)) or (lower.endswith(".3mf") and _holds_gcode(name)):
        return "print"
    if lower.endswith(MESHES):
        return "part"
    if lower.endswith(SCANS):
        return "scan"
    if lower.endswith(TILES):
        return "tile"
    if lower.endswith(FIELDS):
        return "field"
    raise FormatError(
        f"{name} is not a file that the studio takes; it takes parts ({', '.join(MESHES)}), prints "
        f"({', '.join(PRINTS)}, .gcode.3mf), scans ({', '.join(SCANS)}), drawings and fields"
    )


def _holds_gcode(name: str) -> bool:
    """Tell whether a .3mf is a print."""
    try:
        with zipfile.ZipFile(name) as archive:
            return any(member.lower().endswith(".gcode") for member in archive.namelist())
    except (OSError, zipfile.BadZipFile, ValueError, NotImplementedError):
        return False


def read_content(name: str, requested: str, progress: Progress, memory: int) -> Content:
    """Read an uploaded file of the folder of the page.

    Raises
    ------
    InfillError
        If it cannot be read.
    """
    progress("read", 0.0)
    kind = guess_kind(name, requested)
    if kind == "part":
        return _read_part(name)
    if kind == "tile":
        return _read_tile(name)
    if kind == "field":
        return Content(kind="field", name=name, path=name)
    if kind == "print":
        from infill.studio.print_reading import read_print

        read = read_print(name)
        return Content(kind="print", name=name, path=name, data=read, facts=read.facts(), numbers=read.numbers)
    from infill.studio.scan_reading import describe_scan, read_scan, unpack_scan

    path = unpack_scan(name, memory) if name.lower().endswith(".zip") else name
    volume, segments = read_scan(path)
    facts, numbers = describe_scan(volume, segments)
    return Content(kind="scan", name=name, path=path, data=volume, facts=facts, numbers=numbers)


def _read_part(name: str) -> Content:
    """Read a mesh, and measure it."""
    from infill.isosurfaces.components import count_bodies
    from infill.meshes.measuring import measure_surface
    from infill.smoothing.sources import read_source

    surface: Surface = read_source(name, kind="mesh")  # type: ignore[assignment]
    if not len(surface.faces):
        raise FormatError(f"{name} holds no triangles; export it again")
    surface = measure_surface(surface)
    low, high = surface.bounds.tolist()
    bodies = count_bodies(surface)
    facts = {
        "part": {
            "bounds": [low, high],
            "volume": surface.volume,
            "triangles": len(surface.faces),
            "components": bodies,
            "closed": surface.closed,
        }
    }
    sizes = [top - bottom for bottom, top in zip(low, high, strict=True)]
    numbers = (
        *(Number(name=f"size {axis}", value=size, unit="mm") for axis, size in zip("xyz", sizes, strict=True)),
        Number(name="volume", value=surface.volume, unit="mm³"),
        Number(name="triangles", value=len(surface.faces)),
        Number(name="components", value=bodies),
        Number(name="closed", value=surface.closed, help="Whether the mesh encloses its inside without a gap"),
    )
    return Content(kind="part", name=name, path=name, data=surface, facts=facts, numbers=numbers)


def _read_tile(name: str) -> Content:
    """Check that a drawing can be repeated."""
    from infill.options.resolve_pattern import resolve_pattern

    resolve_pattern(Path(name), "fill")
    return Content(kind="tile", name=name, path=name)
