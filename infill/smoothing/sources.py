"""Read the input of `infill smooth` (a mesh, points or a volume, recognised by the file) and smooth it accordingly."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, GeometryError, LabelChoiceError, ParameterError, UsageError
from infill.files.broken import READER_ERRORS, missing_file
from infill.formats.mesh_files import READERS
from infill.formats.point_files import read_points_and_normals
from infill.formats.units import check_units, read_mesh_in_mm, unit_in_mm
from infill.grid import spacing_of
from infill.imaging.dicom.sampling import SampledStack, sample_folder
from infill.imaging.label_tables import Segment, segments_of_nrrd
from infill.imaging.segmentations import NRRD_SUFFIXES, Segmentation, read_segmentation
from infill.imaging.volume_files import VOLUME_SUFFIXES, holds_dicom, read_volume
from infill.lazy.names import is_lazy
from infill.lazy.opening import open_volume
from infill.lazy.volume import ADVICE, TOGETHER_ADVICE
from infill.smoothing.request import SmoothOptions
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.cropping import crop
from infill.voxels.from_mesh import voxel_size
from infill.voxels.labels import LABEL_ADVICE, describe_labels

if TYPE_CHECKING:
    from infill.lazy.volume import LazyVolume
    from infill.reports.smoothing import ComponentsReport, SmoothReport
    from infill.result import Result
    from infill.smoothing.by_component import ComponentStages
    from infill.smoothing.stages import SmoothStages

Kind = Literal["mesh", "points", "volume"]
Source = Surface | Volume | NDArray[np.float64]

LOG = logging.getLogger("infill")
POINT_SUFFIXES = (".xyz", ".txt", ".pts", ".csv")
OPTIONS_OF_KIND = {
    "volume": ("threshold", "between", "label", "otsu", "grey", "keep_components", "voxel"),
    "mesh": ("resolution", "voxel", "keep_components", "by_component"),
    "points": ("resolution", "voxel", "shell"),
}
CHOICES = (
    "resolution",
    "voxel",
    "shell",
    "threshold",
    "between",
    "label",
    "otsu",
    "grey",
    "keep_components",
    "by_component",
)
AXES = 3
KINDS = ("mesh", "points", "volume")


class SourceOptions(SmoothOptions, total=False):
    """The options of `smooth_source`: the choice of the solid and of the grid, and those of `SmoothOptions`.

    `between` is a range of values, for `threshold`; for the others see `infill.smooth_volume` and its siblings.
    """

    resolution: int | None
    voxel: float | None
    shell: float | None
    threshold: float | None
    between: tuple[float, ...] | None
    label: tuple[int, ...] | None
    otsu: bool
    grey: bool | None
    keep_components: str | tuple[int, ...] | None
    by_component: bool


def read_source(
    path: str | os.PathLike[str],
    *,
    kind: str | None = None,
    units: str | None = None,
    spacing: float | tuple[float, ...] | None = None,
    array: str | None = None,
    series: str | None = None,
    frame: int | None = None,
    roi: tuple[float, ...] | None = None,
) -> Source:
    """Return the contents of a file or folder, in mm: points as (N, 3), or as (N, 6) with their normals.

    Parameters
    ----------
    path : str or Path
    kind : {"mesh", "points", "volume"}, optional
        Kind to read it as; inferred from the file if left out.
    units : {"um", "mm", "cm", "m", "in"}, optional
        Unit of the coordinates of a mesh or of points, whatever the file says. If left out, the unit that a .3mf or
        .glb states, or else mm if the size is plausible.
    spacing : float or (hx, hy, hz), optional
        Cell size of a volume, mm; if left out, the one stated in the file.
    array, series : str, optional
    frame : int, optional
        See `infill.imaging.volume_files.read_volume`.
    roi : (x0, x1, y0, y1, z0, z1), optional
        The part of a volume to take, mm: see `infill.voxels.cropping.crop`.

    Raises
    ------
    FormatError
        For a file that cannot be read, or whose kind cannot be determined.
    ParameterError
        If a unit is given for a volume, or a spacing, frame or roi for anything else.

    Notes
    -----
    If no unit is given and the part would be smaller than 2 mm, as a part in metres would be, or larger than 2 m, a
    warning goes to the log "infill".
    """
    source = Path(path)
    if kind is not None and kind not in KINDS:
        raise UsageError.about("kind", f"is {kind!r}; choose from {', '.join(KINDS)}")
    units = check_units(units)
    source_kind = kind or _guess_kind(source)
    if source_kind == "volume":
        if units is not None:
            raise ParameterError.about("units", "is for meshes and points; give the spacing of a volume in mm")
        if is_lazy(path):
            return _load_lazy(path, array=array, series=series, frame=frame, spacing=spacing, roi=roi)
        return _resize_and_crop(
            read_volume(source, array=array, series=series, frame=frame, spacing=spacing), spacing, roi
        )
    volume_options = {"spacing": spacing, "array": array, "series": series, "frame": frame, "roi": roi}
    if any(value is not None for value in volume_options.values()):
        names = tuple(name for name, value in volume_options.items() if value is not None)
        raise ParameterError.about(names, f"is for volumes, and {source} is read as {source_kind}; leave it out")
    if source_kind == "points":
        points, normals = read_points_and_normals(source)
        points = points * unit_in_mm(source, points, units)
        return points if normals is None else np.concatenate([points, normals], axis=1)
    return read_mesh_in_mm(source, units)


def _load_lazy(
    path: str | os.PathLike[str],
    *,
    array: str | None,
    series: str | None,
    frame: int | None,
    spacing: float | tuple[float, ...] | None,
    roi: tuple[float, ...] | None,
    advice: str = ADVICE,
) -> Volume:
    """Read a volume of Zarr or HDF5 into memory, or the part of it in a box."""
    for name, value in (("series", series), ("frame", frame)):
        if value is not None:
            raise ParameterError.about(name, f"is {value!r}, and {path} has none; leave it out")
    volume = open_volume(path, array=array, spacing=spacing)
    return (volume if roi is None else volume.crop(roi)).load(advice=advice)


def sample_source(path: str | os.PathLike[str], **reading: Any) -> SampledStack | None:  # noqa: ANN401 - of `read_source`
    """Return a sample of a folder of DICOM slices; None where a plan needs all of the input.

    Parameters
    ----------
    path : str or Path
    **reading
        As for `read_source`; with any of them, all slices are read.
    """
    source = Path(path)
    chosen = any(value is not None for name, value in reading.items() if name != "kind" or value != "volume")
    return sample_folder(source) if not chosen and source.is_dir() and holds_dicom(source) else None


def read_label_source(
    path: str | os.PathLike[str],
    *,
    kind: str | None = None,
    spacing: float | tuple[float, ...] | None = None,
    array: str | None = None,
    series: str | None = None,
    frame: int | None = None,
    roi: tuple[float, ...] | None = None,
) -> Segmentation:
    """Return the labels of a file or folder, in mm, with their names and colours where the file has them.

    Parameters
    ----------
    path, kind, spacing, array, series, frame, roi
        See `read_source`.

    Raises
    ------
    ParameterError
        If the file is read as a mesh or as points, or the part holds no cell.
    FormatError
        As `read_source`.
    """
    source = Path(path)
    source_kind = kind or _guess_kind(source)
    if is_lazy(path):
        volume = _load_lazy(
            path, array=array, series=series, frame=frame, spacing=spacing, roi=roi, advice=TOGETHER_ADVICE
        )
        return Segmentation(layers=(volume,))
    if source_kind != "volume":
        raise ParameterError.about(
            "labels", f"are those of a volume, and {source} is read as {source_kind}; leave them out"
        )
    segmentation = read_segmentation(source, array=array, series=series, frame=frame, spacing=spacing)
    shares = segmentation.shares
    if shares is not None and roi is not None:
        volume = segmentation.layers[0]
        parts = [crop(replace(volume, values=share), roi, varied=False).values for share in shares]
        segmentation = replace(segmentation, shares=np.stack(parts))
    return replace(
        segmentation, layers=tuple(_resize_and_crop(layer, spacing, roi, varied=False) for layer in segmentation.layers)
    )


def open_label_source(
    path: str | os.PathLike[str],
    *,
    kind: str | None = None,
    spacing: float | tuple[float, ...] | None = None,
    array: str | None = None,
    series: str | None = None,
    frame: int | None = None,
    roi: tuple[float, ...] | None = None,
) -> tuple[LazyVolume, tuple[Segment, ...]]:
    """Open the labels of a file or folder without reading them; return their names and colours where it has them.

    Parameters
    ----------
    path, kind, spacing, array, series, frame, roi
        See `read_source`.

    Raises
    ------
    ParameterError
        For an option that does not apply.
    FormatError
        If it cannot be opened, or not in parts.
    """
    for name, value in (("kind", None if kind == "volume" else kind), ("series", series), ("frame", frame)):
        if value is not None:
            raise ParameterError.about(name, f"is {value!r}, and {path} is read in parts; leave it out")
    volume = open_volume(path, array=array, spacing=spacing)
    source = Path(path)
    is_nrrd = source.suffix.lower() in NRRD_SUFFIXES and not is_lazy(path)
    segments = segments_of_nrrd(source) if is_nrrd else ()
    return volume if roi is None else volume.crop(roi), segments


def _resize_and_crop(
    volume: Volume,
    spacing: float | tuple[float, ...] | None,
    roi: tuple[float, ...] | None,
    *,
    varied: bool = True,
) -> Volume:
    """Set the cell size of a volume, if one is given, and crop it to a box."""
    sized = volume if spacing is None else replace(volume, spacing=spacing_of(spacing, 3))
    return sized if roi is None else crop(sized, roi, varied=varied)


@contextlib.contextmanager
def name_labels(path: str | os.PathLike[str], **reading: Any) -> Iterator[None]:  # noqa: ANN401 - hands on
    """Name the labels of a file in the error that says that nothing chooses one of them.

    Parameters
    ----------
    path : str or Path
    **reading
        As for `read_source`.
    """
    try:
        yield
    except LabelChoiceError as error:
        segmentation = read_label_source(path, **{name: value for name, value in reading.items() if name != "units"})
        names = {(segment.layer, segment.value): segment.name for segment in segmentation.segments}
        raise LabelChoiceError(f"{path} holds {describe_labels(segmentation.layers, names)}; {LABEL_ADVICE}") from error


def smooth_source(
    source: Source, **options: Unpack[SourceOptions]
) -> Result[SmoothStages, SmoothReport] | Result[ComponentStages, ComponentsReport]:
    """Smooth the data of `read_source`; raise ParameterError for options that do not fit their kind."""
    from infill.smoothing.job import smooth_mesh, smooth_points, smooth_volume

    choice, smooth_options = split_options(source, options)
    if isinstance(source, Volume):
        return smooth_volume(source, **choice, **smooth_options)
    if isinstance(source, Surface):
        return smooth_mesh(source, **choice, **smooth_options)
    points, normals = source[:, :AXES], source[:, AXES:] if source.shape[1] > AXES and "shell" not in choice else None
    return smooth_points(points, normals=normals, **choice, **smooth_options)


def split_options(source: Source, options: SourceOptions) -> tuple[dict[str, Any], SmoothOptions]:
    """Check the options and split them: those that choose the solid and the grid, and those that all functions share.

    Parameters
    ----------
    source : Source
    options : SourceOptions

    Returns
    -------
    choice : dict
        Arguments of `infill.smooth_volume`, `infill.smooth_mesh` or `infill.smooth_points`, without those left out.
    shared : SmoothOptions

    Raises
    ------
    ParameterError
        If an option does not fit the kind of data, or excludes another.
    """
    given = {
        name: value for name, value in options.items() if value is not None and (value is not False or name == "grey")
    }
    choice: dict[str, Any] = {name: given[name] for name in CHOICES if name in given}
    shared = {name: value for name, value in options.items() if name not in CHOICES}
    kind = "volume" if isinstance(source, Volume) else "mesh" if isinstance(source, Surface) else "points"
    if kind != "volume" and choice.get("grey") is False:
        del choice["grey"]
    if unfit := [name for name in choice if name not in OPTIONS_OF_KIND[kind]]:
        kinds = [candidate for candidate in KINDS if unfit[0] in OPTIONS_OF_KIND[candidate]]
        raise ParameterError.about(
            unfit[0], f"is for {' and '.join(kinds)}, and the input is read as {kind}; leave it out"
        )
    thresholds = [name for name in ("threshold", "between", "otsu") if name in choice]
    if len(thresholds) > 1:
        raise UsageError.about(tuple(thresholds), "exclude each other; give one of them")
    if "between" in choice:
        choice["threshold"] = choice.pop("between")
    if choice.pop("otsu", False):
        choice["threshold"] = "otsu"
    if not isinstance(source, Volume | Surface):
        longest = float(np.ptp(source[:, :AXES], axis=0).max())
        if longest == 0 and "voxel" not in choice:
            raise GeometryError(f"all {len(source)} points are one point; give points all around the part")
        choice["voxel"] = voxel_size(longest, voxel=choice.get("voxel"), resolution=choice.pop("resolution", None))
    return choice, cast("SmoothOptions", shared)


def _guess_kind(path: Path) -> Kind:
    """Guess the kind of data in a file by its suffix or, where that is ambiguous, by its contents."""
    suffix = path.suffix.lower()
    if path.is_dir() or is_lazy(path):
        return "volume"
    if suffix in POINT_SUFFIXES:
        return "points"
    if suffix == ".npy":
        return "points" if _npy_axis_count(path) == 2 else "volume"
    if suffix == ".ply":
        return "mesh" if _ply_has_faces(path) else "points"
    if suffix in READERS:
        return "mesh"
    if path.is_file() and not path.name.lower().endswith(VOLUME_SUFFIXES):
        raise FormatError(
            f"cannot tell what {path.name!r} holds; export it as a mesh ({' '.join(READERS)}), a volume "
            f"({' '.join(VOLUME_SUFFIXES)} .zarr .h5) or points ({' '.join(POINT_SUFFIXES)})"
        )
    return "volume"


def _npy_axis_count(path: Path) -> int | None:
    """Return the number of axes of the array in a file, or None if it cannot be read."""
    try:
        return np.load(path, mmap_mode="r", allow_pickle=False).ndim  # type: ignore[no-any-return]
    except (OSError, *READER_ERRORS):
        return None  # the reader will report the error


def _ply_has_faces(path: Path) -> bool:
    """Tell by the header of a PLY file whether it holds faces."""
    if not path.is_file():
        raise FormatError(missing_file(path))
    try:
        with path.open("rb") as file:
            head = file.read(65536).split(b"end_header")[0]
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    lines = [line.split() for line in head.splitlines()]
    return any(words[:2] == [b"element", b"face"] and words[-1] != b"0" for words in lines)
