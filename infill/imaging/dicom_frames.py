"""Which frames of DICOM files make a volume together, and where it lies: their places decide, not their order.

Frames make a volume if they lie behind each other in even steps, within UNEVEN of a step, along the normal of all of
them. Where several lie at one place, what else the files say of each, such as an echo time, tells volumes apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.imaging.dicom_files import OTHER_MARKS, TURN, VOLUME_MARKS, Frame, Image, Mark
from infill.volume import AXES

UNEVEN = 0.05  # of a step: how far frames may deviate from even steps
ALIKE = 1e-3  # of the size of a pixel: how far those of frames may differ
MOST_MARKS = 16  # of which pairs are tried
TOLD = 6  # names in a message
STORED_ORDER = "their order in the file alone"
FILES = "the files that they come from"


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Frames that lie behind each other in even steps.

    Parameters
    ----------
    frames : tuple of Frame
        In the order of their places, along the third column of `direction`.
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
    """Why frames make no volume.

    Parameters
    ----------
    off : float
        How far they lie from even steps, in steps.
    why : str
    doubled : bool
        Whether several lie at one place.
    """

    off: float
    why: str
    doubled: bool = False


@dataclass(frozen=True, kw_only=True)
class Stacks:
    """The volumes that frames make.

    Parameters
    ----------
    stacks : tuple of Stack
    apart : str
        What tells them apart; empty for one.
    """

    stacks: tuple[Stack, ...]
    apart: str = ""


@dataclass(frozen=True, kw_only=True)
class Plane:
    """What all frames of a stack have in common: directions, and size of a pixel."""

    direction: NDArray[np.float64]
    pixel: tuple[float, float]  # along a row, down a column


def placed_frames(image: Image, spacing: tuple[float, ...] | None) -> tuple[tuple[Frame, ...], tuple[str, ...]]:
    """Return the frames of a file, each with its place, and what had to be assumed for that.

    Parameters
    ----------
    image : Image
    spacing : (hx, hy, hz), optional
        Size of a cell, mm, where the file says none.

    Raises
    ------
    FormatError
        If nothing says where the frames lie.
    """
    path, frames = image.path, image.frames
    first = frames[0]
    if first.pixel is None and spacing is not None:
        frames = tuple(replace(each, pixel=each.pixel or (spacing[1], spacing[0])) for each in frames)
    if any(each.pixel is None for each in frames):
        raise FormatError(f"{path} does not say how large its pixels are; give the size of a cell: --spacing X,Y,Z")
    if not image.unplaced or len(frames) == 1:
        return frames, ()
    step = first.between or (None if spacing is None else spacing[2])
    if not image.stacked:
        raise FormatError(f"{path} {image.unplaced}; save the volume that it came from, as .nrrd or .nii.gz")
    if step is None:
        thick = "" if first.thickness is None else f", only how thick they are ({first.thickness:g} mm)"
        raise FormatError(
            f"{path} {image.unplaced} or how far apart{thick}; if they are the slices of a volume, in their order, "
            "give the size of a cell: --spacing X,Y,Z"
        )
    axes = first.axes or (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    known = image.start is not None and first.axes is not None
    start, normal = np.array(image.start or (0.0, 0.0, 0.0)), np.cross(axes[:AXES], axes[AXES:])
    found = tuple(
        replace(
            each,
            position=tuple((start + each.number * step * normal).tolist()),
            axes=axes,
            space="LPS" if known else "",
        )
        for each in frames
    )
    where = "" if known else ", so the part may be mirrored and lies at the origin"
    return found, (f"{path} {image.unplaced}: they are taken as slices {abs(step):g} mm apart in their order{where}",)


def stacks_of(path: Path, frames: Sequence[Frame]) -> Stacks:
    """Return the volumes that frames make, all of them in one or several.

    Raises
    ------
    FormatError
        If they make none, or some are left over.
    """
    groups = _of_one_plane(frames)
    if len(groups) > 1:
        found = [even_stack(each) for each in groups]
        stacks = tuple(each for each in found if isinstance(each, Stack))
        if len(stacks) < len(found):
            counts = ", ".join(str(len(each)) for each in groups[:TOLD]) + (", …" if len(groups) > TOLD else "")
            raise FormatError(
                f"{path} holds slices of {len(groups)} orientations, sizes or coordinate systems ({counts}), which "
                "make no volume; keep those of one volume"
            )
        return Stacks(stacks=stacks, apart="their orientation or size")
    alone = even_stack(frames)
    if isinstance(alone, Stack):
        return _split(frames, VOLUME_MARKS) or Stacks(stacks=(alone,))
    apart = _told_apart(frames) if alone.doubled else _split(frames, VOLUME_MARKS[:1])
    if apart is None:
        raise FormatError(
            f"{path} has slices up to {alone.off:.2g} of a slice away from even steps (missing, doubled, or a tilted "
            f"scanner): {alone.why}; resample the series to even slices first"
        )
    return apart


def _of_one_plane(frames: Sequence[Frame]) -> list[list[Frame]]:
    """Return frames in groups of one orientation, shape, size of pixels and coordinate system."""
    groups: list[list[Frame]] = []
    for frame in frames:
        for group in groups:
            if _is_alike(group[0], frame):
                group.append(frame)
                break
        else:
            groups.append([frame])
    return groups


def _is_alike(one: Frame, other: Frame) -> bool:
    if one.shape != other.shape or one.space != other.space:
        return False
    if one.axes is None or other.axes is None or one.pixel is None or other.pixel is None:
        return one.axes == other.axes and one.pixel == other.pixel
    turned = max(abs(a - b) for a, b in zip(one.axes, other.axes, strict=True))
    return turned <= TURN and all(abs(a - b) <= ALIKE * abs(a) for a, b in zip(one.pixel, other.pixel, strict=True))


def _split(frames: Sequence[Frame], names: Sequence[str]) -> Stacks | None:
    """Return the volumes that marks make though all frames may lie evenly: none of them of a single frame."""
    for name in names:
        found = _apart(frames, (name,))
        if found is not None:
            return found
    return None


def _told_apart(frames: Sequence[Frame]) -> Stacks | None:
    """Return the volumes of frames of which several lie at one place; None if nothing tells them apart."""
    marked = {name for frame in frames for name in frame.marks}
    known = [name for name in (*VOLUME_MARKS, *OTHER_MARKS) if name in marked]
    names = [*known, *sorted(marked - set(known))]
    varied = [name for name in names if len({frame.marks.get(name) for frame in frames}) > 1]
    tried = [*combinations(varied, 1), *combinations(varied[:MOST_MARKS], 2), tuple(varied)]
    for each in tried:
        found = _apart(frames, each) if each else None
        if found is not None:
            return found
    by_file: dict[Path, list[Frame]] = {}
    for frame in frames:
        by_file.setdefault(frame.path, []).append(frame)
    if len(by_file) > 1:
        return _even_groups([*by_file.values()], FILES)
    return _even_groups(_repeated(frames), STORED_ORDER)


def _apart(frames: Sequence[Frame], names: tuple[str, ...]) -> Stacks | None:
    """Return the volumes that frames with the same marks make; None if there is but one, or any group makes none."""
    groups: dict[tuple[Mark, ...], list[Frame]] = {}
    for frame in frames:
        groups.setdefault(tuple(frame.marks.get(name, ()) for name in names), []).append(frame)
    # Numbers before words, which do not compare.
    ordered = sorted(groups, key=lambda key: [[(isinstance(x, str), x) for x in mark] for mark in key])
    return _even_groups([groups[key] for key in ordered], " and ".join(names[:TOLD]))


def _even_groups(groups: Sequence[Sequence[Frame]], apart: str) -> Stacks | None:
    if len(groups) < 2:
        return None
    stacks = []
    for group in groups:
        stack = even_stack(group)
        if isinstance(stack, Uneven):
            return None
        stacks.append(stack)
    return Stacks(stacks=tuple(stacks), apart=apart)


def _repeated(frames: Sequence[Frame]) -> list[list[Frame]]:
    """Return the k-th frames of every place, for a file that goes through the places again and again in one order."""
    count = next((k for k in range(1, len(frames)) if _is_same_place(frames[0], frames[k])), len(frames))
    if len(frames) % count:
        return []
    if count == 1:  # all frames of a place stand together
        count = next((k for k in range(1, len(frames)) if not _is_same_place(frames[0], frames[k])), len(frames))
        groups = [list(frames[k::count]) for k in range(count)]
    else:
        groups = [list(frames[k : k + count]) for k in range(0, len(frames), count)]
    same = len(frames) % count == 0 and all(
        len(group) == len(groups[0]) and all(_is_same_place(a, b) for a, b in zip(groups[0], group, strict=True))
        for group in groups
    )
    return groups if same else []


def _is_same_place(one: Frame, other: Frame) -> bool:
    if one.position is None or other.position is None:
        return False
    return bool(np.linalg.norm(np.subtract(one.position, other.position)) <= UNEVEN * max(one.pixel or (1.0,)))


def even_stack(frames: Sequence[Frame]) -> Stack | Uneven:
    """Return frames of one plane in the order of their places, or why they make no volume.

    Notes
    -----
    First place and step are those of the least squares, so that a place that is rounded to few digits, even the first
    or last, changes neither much.
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
    off = float(np.linalg.norm(places[order] - even, axis=1).max() / step)
    if not off <= UNEVEN:
        return Uneven(off=off, why=_why(steps, along[order]), doubled=bool((steps < UNEVEN * steps.max()).any()))
    step = rounded(_stated(frames, step, off * step))
    centre = middle - (len(frames) - 1) / 2 * step * normal
    return Stack(
        frames=tuple(frames[k] for k in order),
        spacing=(*plane.pixel, step),
        centre=tuple(centre.tolist()),
        direction=plane.direction,
    )


def rounded(length: float) -> float:
    """Return a length without the last digits, which sums leave behind.

    >>> rounded(3.0000000000000004)
    3.0
    """
    return float(f"{length:.12g}")


def _stated(frames: Sequence[Frame], step: float, noise: float) -> float:
    """Return the step that all frames state, where the places agree with it as well as with each other; mm."""
    stated = {frame.between for frame in frames}
    between = abs(stated.pop() or 0.0) if len(stated) == 1 else 0.0
    return between if abs(between - step) * (len(frames) - 1) <= 2 * noise else step


def _why(steps: NDArray[np.float64], along: NDArray[np.float64]) -> str:
    """Return what is uneven about frames, in words."""
    least, most = float(steps.min()), float(steps.max())
    apart = 1 + int((steps >= UNEVEN * most).sum())
    if apart <= len(steps):
        return f"{len(steps) + 1} of them lie at {apart} places, and nothing tells them apart"
    if most - least <= UNEVEN * most:
        return "each is shifted sideways against the one before"
    usual = float(np.median(steps))
    at = int(np.abs(steps - usual).argmax())
    return f"the step is {usual:.4g} mm, and {steps[at]:.4g} mm after the one at {along[at]:.4g} mm"


def plane_of(frames: Sequence[Frame]) -> Plane | Uneven:
    """Return orientation and pixels of frames, or why they have none in common."""
    first = frames[0]
    if first.axes is None or first.pixel is None:
        return Uneven(off=1.0, why="nothing says how they are turned, or how large pixels are")
    if not all(_is_alike(first, each) for each in frames):
        return Uneven(off=1.0, why="their orientations or sizes differ")
    row, column = np.array([frame.axes for frame in frames]).mean(axis=0).reshape(2, AXES)
    lengths = np.linalg.norm(row), np.linalg.norm(column)
    if max(abs(lengths[0] - 1), abs(lengths[1] - 1), abs(row @ column)) > TURN:
        return Uneven(off=1.0, why="their rows and columns are not at right angles, or no directions")
    row = row / lengths[0]
    column = column - (column @ row) * row
    column /= np.linalg.norm(column)
    down, across = (rounded(x) for x in np.mean([frame.pixel for frame in frames if frame.pixel], axis=0))
    if down <= 0 or across <= 0:
        return Uneven(off=1.0, why=f"pixels are {across:g} x {down:g} mm")
    return Plane(direction=np.column_stack([row, column, np.cross(row, column)]), pixel=(across, down))
