"""Uploaded scans: volumes with their histogram, slices and labels."""

from __future__ import annotations

import stat
import zipfile
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_whole_number
from infill.errors import FormatError, InfillError, UsageError
from infill.files.file_names import safe_names
from infill.imaging.hounsfield import name_thresholds
from infill.studio.numbers import Number
from infill.volume import Volume

if TYPE_CHECKING:
    from infill.imaging.label_tables import Segment

BINS = 256
SAMPLED = 4_000_000  # cells for the histogram
MOST_LABELS = 256
MOST_FILES = 20_000  # of an archive
AXES = "xyz"


def unpack_scan(name: str, limit: int) -> str:
    """Unpack an archive beside itself; return the folder, or the only file in it.

    Raises
    ------
    FormatError
        If it is not an archive, or unpacks to too much.
    """
    whole, folder = Path(f"{name}.unpacked"), Path(f"{name}.unpacking")
    if whole.exists():  # by an earlier process
        return _choose_source(whole)
    try:
        with zipfile.ZipFile(name) as archive:
            members = [member for member in archive.infolist() if not member.is_dir() and _is_plain(member)]
            if len(members) > MOST_FILES or sum(member.file_size for member in members) > limit:
                raise FormatError(f"{name} unpacks to more than the studio takes; use the command line for it")
            folder.mkdir(exist_ok=True)
            bases = [Path(member.filename).name for member in members]
            names = safe_names(bases, [f"slice_{number}" for number in range(len(bases))])
            room = limit
            for member, base in zip(members, names, strict=True):
                room -= _unpack(archive, member, folder / base, room)
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError, ValueError, EOFError) as error:
        if isinstance(error, InfillError):
            raise
        raise FormatError(f"cannot unpack {name} ({error}); pack it again") from error
    if not names:
        raise FormatError(f"{name} is an archive without files; pack the folder of the scan")
    folder.rename(whole)
    return _choose_source(whole)


def _choose_source(folder: Path) -> str:
    """Return the only file in a folder, or the folder."""
    files = list(folder.iterdir())
    return str(files[0] if len(files) == 1 else folder)


def _is_plain(member: zipfile.ZipInfo) -> bool:
    """Tell whether a member is a file of the scan, no link and no note of the system that packed it."""
    base, is_link = Path(member.filename).name, stat.S_ISLNK(member.external_attr >> 16)
    return not (is_link or base.startswith(".") or "__MACOSX" in member.filename)


def _unpack(archive: zipfile.ZipFile, member: zipfile.ZipInfo, target: Path, limit: int) -> int:
    """Unpack a file, up to a number of bytes, whatever the archive says of its size; return the number."""
    size = 0
    with archive.open(member) as packed, open(target, "xb") as file:
        while piece := packed.read(1 << 20):
            size += len(piece)
            if size > limit:
                raise FormatError(f"{archive.filename} unpacks to more than it says; pack it again")
            file.write(piece)
    return size


def read_scan(path: str) -> tuple[Volume, tuple[Segment, ...]]:
    """Read a volume, and the names and colours of its labels where it has them."""
    from infill.imaging.segmentations import read_segmentation
    from infill.smoothing.sources import read_source

    volume = read_source(path, kind="volume")
    assert isinstance(volume, Volume)
    segments: tuple[Segment, ...] = ()
    if volume.values.dtype.kind in "iub" and (path.lower().endswith((".nrrd", ".nhdr", ".dcm")) or Path(path).is_dir()):
        segments = read_segmentation(path).segments
    return volume, segments


def describe_scan(volume: Volume, segments: tuple[Segment, ...]) -> tuple[dict[str, Any], tuple[Number, ...]]:
    """Return the facts of a scan for the page, and numbers."""
    values, sample = volume.values, sample_values(volume.values)
    least, most = (float(end) for end in (values.min(), values.max()))
    finite = sample[np.isfinite(sample)] if sample.dtype.kind == "f" else sample
    if not np.isfinite([least, most]).all():
        least, most = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    counts, edges = np.histogram(finite, bins=BINS, range=(least, most if most > least else least + 1))
    otsu = _find_otsu(volume)
    shape, spacing = list(volume.values.shape), np.asarray(volume.cell_size, dtype=float).tolist()
    facts = {
        "scan": {
            "shape": shape,
            "spacing": spacing,
            "least": least,
            "most": most,
            "histogram": {"edges": edges.tolist(), "counts": counts.tolist()},
            "otsu": otsu,
            "thresholds": name_thresholds(least, most, otsu),
            "labels": list_labels(volume, segments),
            "space": volume.space,
        }
    }
    numbers = (
        *(Number(name=f"cells {axis}", value=count) for axis, count in zip(AXES, shape, strict=True)),
        *(Number(name=f"spacing {axis}", value=size, unit="mm") for axis, size in zip(AXES, spacing, strict=True)),
        Number(name="least value", value=least),
        Number(name="most value", value=most),
    )
    return facts, numbers


def sample_values(values: NDArray[Any]) -> NDArray[Any]:
    """Return all values of a volume, or of a large one those of layers at a stride."""
    stride = max(1, values.size // SAMPLED)
    layers = values.shape[2]
    return values[:, :, :: min(stride, layers)].ravel()


def _find_otsu(volume: Volume) -> float | None:
    """Return the threshold of Otsu's method; None where there is none."""
    from infill.voxels.segmentation import otsu_threshold

    try:
        return float(otsu_threshold(volume))
    except (InfillError, ValueError, TypeError):
        return None


def list_labels(volume: Volume, segments: tuple[Segment, ...]) -> list[dict[str, Any]] | None:
    """Return the labels of a volume with names and colours; None if its values are other numbers."""
    if segments:
        return [
            {"value": segment.value, "name": segment.name or f"label_{segment.value}", "colour": segment.colour}
            for segment in segments
        ]
    if volume.values.dtype.kind not in "iub":
        return None
    distinct = np.unique(volume.values)
    numbers = [int(value) for value in distinct if value]
    if len(distinct) > MOST_LABELS or not numbers or numbers[0] < 0:
        return None
    return [{"value": number, "name": f"label_{number}", "colour": None} for number in numbers]


def draw_slice(volume: Volume, axis: str, index: str, low: str | None, high: str | None) -> bytes:
    """Return a slice as a grey PNG: columns and rows are the axes left, in their order, the first row at 0.

    Raises
    ------
    UsageError, ParameterError
        If there is no such slice.
    """
    from PIL import Image

    if axis not in AXES:
        raise UsageError.about("axis", "is none of x, y and z")
    across = AXES.index(axis)
    try:
        number = check_whole_number("index", int(index), 0)
        ends = [None if end in (None, "") else float(str(end)) for end in (low, high)]
    except ValueError:
        raise UsageError.about("index", "must be a number; give the number of a slice") from None
    if number >= volume.values.shape[across]:
        raise UsageError.about("index", f"is {number}; there are slices 0 to {volume.values.shape[across] - 1}")
    cells = np.take(volume.values, number, axis=across).astype(np.float64)
    bottom = float(np.nanmin(volume.values)) if ends[0] is None else ends[0]
    top = float(np.nanmax(volume.values)) if ends[1] is None else ends[1]
    grey = np.nan_to_num((cells - bottom) / ((top - bottom) or 1.0)).clip(0, 1)
    picture = Image.fromarray(np.round(255 * grey.T).astype(np.uint8), mode="L")
    file = BytesIO()
    picture.save(file, format="PNG", compress_level=1)
    return file.getvalue()
