"""Volumes of DICOM frames: stacks in even steps, found by the places of the frames and not by their order.

Frames make a volume if they lie behind each other in even steps, within UNEVEN of a step, along their common normal.
Where several lie at one place, other marks in the files, such as an echo time, distinguish the volumes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.imaging.dicom.elements import Mark
from infill.imaging.dicom.headers import Image
from infill.imaging.dicom.places import DIRECTION_TOLERANCE, OTHER_MARKS, VOLUME_MARKS, Frame
from infill.plain_numbers import list_some, plain_argument
from infill.volume import AXES

STEP_TOLERANCE = 0.05  # of a step: tolerance of frames against even steps
PIXEL_TOLERANCE = 1e-3  # of the size of a pixel: tolerance between frames
MOST_MARKS = 16  # marks that are tried in pairs
NAMES_SHOWN = 6  # names in a message
STORED_ORDER = "their order in the file alone"
SOURCE_FILES = "the files that they come from"


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Frames that lie behind each other in even steps.

    Parameters
    ----------
    frames : tuple of Frame
        Sorted by place, along the third column of `direction`.
    spacing : (hx, hy, hz)
        mm
    centre : (x, y, z)
        Centre of the first pixel of the first frame, mm.
    direction : (3, 3) float
        Along a row, down a column, and from frame to frame: right-handed.
    """

    frames: tuple[Frame, ...]
    spacing: tuple[float, ...]
    centre: tuple[float, ...]
    direction: NDArray[np.float64]

    @property
    def origin(self) -> tuple[float, ...]:
        """Lower corner of the first cell, mm."""
        corner: list[float] = (np.array(self.centre) - self.direction @ np.array(self.spacing) / 2).tolist()
        return tuple(corner)


@dataclass(frozen=True, kw_only=True)
class Uneven:
    """The reason why frames make no volume.

    Parameters
    ----------
    off : float
        Largest deviation from even steps, in steps.
    why : str
    doubled : bool
        Whether several lie at one place.
    """

    off: float
    why: str
    doubled: bool = False


@dataclass(frozen=True, kw_only=True)
class Stacks:
    """The volumes of a set of frames.

    Parameters
    ----------
    stacks : tuple of Stack
    apart : str
        Marks that distinguish them; empty for a single volume.
    """

    stacks: tuple[Stack, ...]
    apart: str = ""


@dataclass(frozen=True, kw_only=True)
class Plane:
    """Common plane of the frames of a stack: directions, and size of a pixel."""

    direction: NDArray[np.float64]
    pixel: tuple[float, float]  # along a row, down a column


def place_frames(image: Image, spacing: tuple[float, ...] | None) -> tuple[tuple[Frame, ...], tuple[str, ...]]:
    """Give every frame of a file a place; return the frames, and warnings about assumptions.

    Parameters
    ----------
    image : Image
    spacing : (hx, hy, hz), optional
        Cell size, mm, where the file states none.

    Raises
    ------
    FormatError
        If the place of the frames is unknown.
    """
    path, frames = image.path, image.frames
    template = frames[0]
    if template.pixel is None and spacing is not None:
        frames = tuple(replace(frame, pixel=frame.pixel or (spacing[1], spacing[0])) for frame in frames)
    if any(frame.pixel is None for frame in frames):
        raise FormatError(f"{path} does not say how large its pixels are; give the size of a cell: --spacing X,Y,Z")
    if not image.unplaced or len(frames) == 1:
        return frames, ()
    step = template.between or (None if spacing is None else spacing[2])
    if not image.stacked:
        raise FormatError(f"{path} {image.unplaced}; save the volume that it came from, as .nrrd or .nii.gz")
    if step is None:
        thick = (
            "" if template.thickness is None else f", only how thick they are ({plain_argument(template.thickness)} mm)"
        )
        raise FormatError(
            f"{path} {image.unplaced} or how far apart{thick}; if they are the slices of a volume, in their order, "
            "give the size of a cell: --spacing X,Y,Z"
        )
    axes = template.axes or (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    is_located = image.start is not None and template.axes is not None
    start, normal = np.array(image.start or (0.0, 0.0, 0.0)), np.cross(axes[:AXES], axes[AXES:])
    placed = tuple(
        replace(
            frame,
            position=tuple((start + frame.number * step * normal).tolist()),
            axes=axes,
            space="LPS" if is_located else "",
        )
        for frame in frames
    )
    caveat = "" if is_located else ", so the part may be mirrored and lies at the origin"
    return placed, (
        f"{path} {image.unplaced}: they are taken as slices {plain_argument(abs(step))} mm apart in their "
        f"order{caveat}",
    )


def split_into_stacks(path: Path, frames: Sequence[Frame]) -> Stacks:
    """Divide frames into volumes.

    Raises
    ------
    FormatError
        If they make no volume, or some frames remain.
    """
    groups = _group_by_plane(frames)
    if len(groups) > 1:
        candidates = [even_stack(group) for group in groups]
        stacks = tuple(stack for stack in candidates if isinstance(stack, Stack))
        if len(stacks) < len(candidates):
            counts = list_some([len(group) for group in groups], NAMES_SHOWN)
            raise FormatError(
                f"{path} holds slices of {len(groups)} orientations, sizes or coordinate systems ({counts}), which "
                "make no volume; keep those of one volume"
            )
        return Stacks(stacks=stacks, apart="their orientation or size")
    single = even_stack(frames)
    if isinstance(single, Stack):
        return _split_by_first_mark(frames, VOLUME_MARKS) or Stacks(stacks=(single,))
    volumes = _split_at_places(frames) if single.doubled else _split_by_first_mark(frames, VOLUME_MARKS[:1])
    if volumes is None:
        raise FormatError(
            f"{path} has slices up to {plain_argument(single.off, 2)} of a slice away from even steps (missing, "
            f"doubled, or a tilted scanner): {single.why}; resample the series to even slices first"
        )
    return volumes


def _group_by_plane(frames: Sequence[Frame]) -> list[list[Frame]]:
    """Group frames by orientation, shape, pixel size and coordinate system."""
    groups: list[list[Frame]] = []
    for frame in frames:
        for group in groups:
            if _is_alike(group[0], frame):
                group.append(frame)
                break
        else:
            groups.append([frame])
    return groups


def _is_alike(frame: Frame, reference: Frame) -> bool:
    """Tell whether two frames share orientation, shape, pixel size and coordinate system."""
    if frame.shape != reference.shape or frame.space != reference.space:
        return False
    if frame.axes is None or reference.axes is None or frame.pixel is None or reference.pixel is None:
        return frame.axes == reference.axes and frame.pixel == reference.pixel
    turned = max(abs(a - b) for a, b in zip(frame.axes, reference.axes, strict=True))
    return turned <= DIRECTION_TOLERANCE and all(
        abs(a - b) <= PIXEL_TOLERANCE * abs(a) for a, b in zip(frame.pixel, reference.pixel, strict=True)
    )


def _split_by_first_mark(frames: Sequence[Frame], names: Sequence[str]) -> Stacks | None:
    """Divide frames by the first mark that makes volumes of several frames each, even if all frames lie evenly."""
    for name in names:
        volumes = _split_by_marks(frames, (name,))
        if volumes is not None:
            return volumes
    return None


def _split_at_places(frames: Sequence[Frame]) -> Stacks | None:
    """Divide frames of which several lie at one place into volumes; return None if no mark does."""
    mark_names = {name for frame in frames for name in frame.marks}
    known_names = [name for name in (*VOLUME_MARKS, *OTHER_MARKS) if name in mark_names]
    names = [*known_names, *sorted(mark_names - set(known_names))]
    varying = [name for name in names if len({frame.marks.get(name) for frame in frames}) > 1]
    combinations_tried = [*combinations(varying, 1), *combinations(varying[:MOST_MARKS], 2), tuple(varying)]
    for marks_tried in combinations_tried:
        volumes = _split_by_marks(frames, marks_tried) if marks_tried else None
        if volumes is not None:
            return volumes
    by_file: dict[Path, list[Frame]] = {}
    for frame in frames:
        by_file.setdefault(frame.path, []).append(frame)
    if len(by_file) > 1:
        return _even_groups([*by_file.values()], SOURCE_FILES)
    return _even_groups(_group_repetitions(frames), STORED_ORDER)


def _split_by_marks(frames: Sequence[Frame], names: tuple[str, ...]) -> Stacks | None:
    """Divide frames by marks; return None if that gives a single group, or one whose frames make no even volume."""
    groups: dict[tuple[Mark, ...], list[Frame]] = {}
    for frame in frames:
        groups.setdefault(tuple(frame.marks.get(name, ()) for name in names), []).append(frame)
    # Numbers before words, which do not compare.
    ordered = sorted(groups, key=lambda key: [[(isinstance(x, str), x) for x in mark] for mark in key])
    return _even_groups([groups[key] for key in ordered], " and ".join(names[:NAMES_SHOWN]))


def _even_groups(groups: Sequence[Sequence[Frame]], apart: str) -> Stacks | None:
    """Stack every group, or return None if there is only one group or a group is uneven."""
    if len(groups) < 2:
        return None
    stacks = []
    for group in groups:
        stack = even_stack(group)
        if isinstance(stack, Uneven):
            return None
        stacks.append(stack)
    return Stacks(stacks=tuple(stacks), apart=apart)


def _group_repetitions(frames: Sequence[Frame]) -> list[list[Frame]]:
    """Group the k-th frames of every place, for a file that repeats the places in one order."""
    count = next((k for k in range(1, len(frames)) if _is_same_place(frames[0], frames[k])), len(frames))
    if len(frames) % count:
        return []
    if count == 1:  # all frames of a place stand together
        count = next((k for k in range(1, len(frames)) if not _is_same_place(frames[0], frames[k])), len(frames))
        groups = [list(frames[k::count]) for k in range(count)]
    else:
        groups = [list(frames[k : k + count]) for k in range(0, len(frames), count)]
    is_regular = len(frames) % count == 0 and all(
        len(group) == len(groups[0]) and all(_is_same_place(a, b) for a, b in zip(groups[0], group, strict=True))
        for group in groups
    )
    return groups if is_regular else []


def _is_same_place(frame: Frame, reference: Frame) -> bool:
    """Tell whether two frames lie at the same place."""
    if frame.position is None or reference.position is None:
        return False
    return bool(
        np.linalg.norm(np.subtract(frame.position, reference.position)) <= STEP_TOLERANCE * max(frame.pixel or (1.0,))
    )


def even_stack(frames: Sequence[Frame]) -> Stack | Uneven:
    """Sort frames of one plane by place and stack them; return the reason if they make no volume.

    Notes
    -----
    First place and step are a least-squares fit, so that rounding one place to few digits, even the first or last,
    changes neither much.
    """
    if len(frames) < 2:
        return Uneven(off=1.0, why="one frame alone")
    plane = plane_of(frames)
    if isinstance(plane, Uneven):
        return plane
    if any(frame.position is None for frame in frames):
        return Uneven(off=1.0, why="some frames have no place")
    places = np.array([frame.position for frame in frames], dtype=np.float64)
    normal = plane.direction[:, 2]
    along = places @ normal
    order = np.argsort(along, kind="stable")
    steps = np.diff(along[order])
    count = np.arange(len(frames)) - (len(frames) - 1) / 2
    step = float(count @ along[order] / (count @ count))
    if step <= 0:
        return Uneven(off=1.0, why="all lie at one place", doubled=True)
    middle = places.mean(axis=0)
    even = middle + np.outer(count * step, normal)
    deviation = float(np.linalg.norm(places[order] - even, axis=1).max() / step)
    if not deviation <= STEP_TOLERANCE:
        return Uneven(
            off=deviation,
            why=_describe_unevenness(steps, along[order]),
            doubled=bool((steps < STEP_TOLERANCE * steps.max()).any()),
        )
    step = round_length(_stated_step(frames, step, deviation * step))
    centre = middle - (len(frames) - 1) / 2 * step * normal
    return Stack(
        frames=tuple(frames[k] for k in order),
        spacing=(*plane.pixel, step),
        centre=tuple(centre.tolist()),
        direction=plane.direction,
    )


def round_length(length: float) -> float:
    """Round a length to 12 digits, which removes the errors of sums.

    >>> round_length(3.0000000000000004)
    3.0
    """
    return float(f"{length:.12g}")


def _stated_step(frames: Sequence[Frame], step: float, noise: float) -> float:
    """Return the step that all frames state if the places agree with it, else `step`; mm."""
    stated = {frame.between for frame in frames}
    between = abs(stated.pop() or 0.0) if len(stated) == 1 else 0.0
    return between if abs(between - step) * (len(frames) - 1) <= 2 * noise else step


def _describe_unevenness(steps: NDArray[np.float64], along: NDArray[np.float64]) -> str:
    """Describe the unevenness of frames in words."""
    smallest, largest = float(steps.min()), float(steps.max())
    places = 1 + int((steps >= STEP_TOLERANCE * largest).sum())
    if places <= len(steps):
        return f"{len(steps) + 1} of them lie at {places} places, and nothing tells them apart"
    if largest - smallest <= STEP_TOLERANCE * largest:
        return "each is shifted sideways against the one before"
    usual = float(np.median(steps))
    outlier = int(np.abs(steps - usual).argmax())
    return (
        f"the step is {plain_argument(usual, 4)} mm, and {plain_argument(steps[outlier], 4)} mm after the one at "
        f"{plain_argument(along[outlier], 4)} mm"
    )


def plane_of(frames: Sequence[Frame]) -> Plane | Uneven:
    """Return the common plane of frames, or the reason why they have none."""
    reference = frames[0]
    if reference.axes is None or reference.pixel is None:
        return Uneven(off=1.0, why="nothing says how they are turned, or how large pixels are")
    if not all(_is_alike(reference, frame) for frame in frames):
        return Uneven(off=1.0, why="their orientations or sizes differ")
    row, column = np.array([frame.axes for frame in frames]).mean(axis=0).reshape(2, AXES)
    lengths = np.linalg.norm(row), np.linalg.norm(column)
    if max(abs(lengths[0] - 1), abs(lengths[1] - 1), abs(row @ column)) > DIRECTION_TOLERANCE:
        return Uneven(off=1.0, why="their rows and columns are not at right angles, or no directions")
    row = row / lengths[0]
    column = column - (column @ row) * row
    column /= np.linalg.norm(column)
    down, across = (round_length(x) for x in np.mean([frame.pixel for frame in frames if frame.pixel], axis=0))
    if down <= 0 or across <= 0:
        return Uneven(off=1.0, why=f"pixels are {plain_argument(across)} x {plain_argument(down)} mm")
    return Plane(direction=np.column_stack([row, column, np.cross(row, column)]), pixel=(across, down))
