"""A sample of a DICOM folder: a few runs of neighbouring slices, from which the whole can be estimated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from infill.errors import FormatError
from infill.imaging.checked_volume import checked_volume
from infill.imaging.dicom.headers import Image, read_image, require_pydicom
from infill.imaging.dicom.pixels import frame_values, require_grey
from infill.imaging.dicom.stacks import STEP_TOLERANCE, Plane, Stack, place_frames, plane_of, round_length
from infill.imaging.slices import natural_key
from infill.volume import Volume

RUNS, RUN = 12, 3  # runs of slices, evenly spread, and slices in each
FEWEST = 2 * RUNS * RUN  # slices: fewer are read as fast as they are sampled


@dataclass(frozen=True, kw_only=True, eq=False)
class SampledStack:
    """Some slices of a stack.

    Parameters
    ----------
    volume : Volume
        The sampled slices, one run behind the other, along the last axis.
    runs : int
        Number of runs; all are as long.
    count : int
        Number of slices of the whole stack.
    """

    volume: Volume
    runs: int
    count: int

    @property
    def sampled(self) -> int:
        """Number of slices that were read."""
        return int(self.volume.values.shape[2])


def sample_folder(folder: Path) -> SampledStack | None:
    """Read a sample of the slices in a folder; return None unless it stands for all of them.

    It does if the files are many, one slice each, of one series, and lie in even steps in the order of their names.
    """
    require_pydicom("a DICOM folder")
    files = sorted((entry for entry in folder.iterdir() if entry.is_file() and entry.name[0] != "."), key=natural_key)
    if len(files) < FEWEST:
        return None
    starts = ((np.arange(RUNS) + 0.5) * len(files) / RUNS - RUN / 2).astype(int)  # in the middle of equal stretches
    numbers = (starts[:, None] + np.arange(RUN)).ravel()
    try:
        images = [read_image(files[number]) for number in numbers]
        slices = [image for image in images if image is not None and image.count == 1 and image.segments is None]
        if len(slices) < len(numbers) or len({image.series for image in slices}) > 1:
            return None
        return _stack_sample(folder, slices, numbers.tolist(), len(files))
    except FormatError:
        return None  # the reader of all slices says what is wrong


def _stack_sample(folder: Path, images: Sequence[Image], numbers: list[int], count: int) -> SampledStack | None:
    """Stack the slices with these numbers, of so many; return None if their places are not in even steps."""
    for image in images:
        require_grey(image)
    frames = [frame for image in images for frame in place_frames(image, None)[0]]
    plane = plane_of(frames)
    if not isinstance(plane, Plane) or any(frame.position is None for frame in frames):
        return None
    normal = plane.direction[:, 2]
    places = np.array([frame.position for frame in frames], dtype=np.float64)
    step, start = np.polyfit(numbers, places @ normal, 1)
    even = places[0] + np.outer(step * (np.array(numbers) - numbers[0]), normal)
    if not np.linalg.norm(places - even, axis=1).max() <= STEP_TOLERANCE * abs(step):
        return None
    ends = (float(start), float(start + step * (count - 1)))
    lowest = places[0] + (min(ends) - float(places[0] @ normal)) * normal
    stack = Stack(
        frames=tuple(frames if step > 0 else frames[::-1]),
        spacing=(*plane.pixel, round_length(abs(float(step)))),
        centre=tuple(np.round(lowest, 9).tolist()),
        direction=plane.direction,
    )
    values = frame_values(images, stack.frames).values
    volume = checked_volume(
        folder,
        values.T,
        spacing=stack.spacing,
        origin=stack.origin,
        direction=stack.direction,
        space=stack.frames[0].space,
    )
    return SampledStack(volume=volume, runs=RUNS, count=count)
