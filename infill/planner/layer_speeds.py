"""Fast and slow parts of a layer, or of a print: moves, cut into short pieces of known speed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import FormatError, MemoryLimitError, ParameterError
from infill.gcode.dialect import role_of
from infill.gcode.sliced_file import open_sliced
from infill.gcode.stream import LAYER_TAG, batches
from infill.planner.lookahead import MotionPlan
from infill.planner.open_timeline import collect_given, open_timeline
from infill.planner.struct_of_arrays import concatenate_rows, slice_rows
from infill.planner.timeline import Steps

PIECE_LENGTH: Final = 0.4  # mm, of a layer
COARSE_LENGTH: Final = 1.0  # mm, of a print
SPEED_STEP: Final = 4.0  # mm/s: neighbouring pieces of a print whose speeds differ by less may become one


@dataclass(frozen=True, kw_only=True)
class PlannedLayers:
    """The moves of all layers of a print, planned once.

    Parameters
    ----------
    steps : Steps
    plan : MotionPlan
    features : tuple of bytes
        Names of features; the first is that of none.
    """

    steps: Steps
    plan: MotionPlan
    features: tuple[bytes, ...]

    @property
    def count(self) -> int:
        """Number of layers."""
        return int(self.steps.layer[-1]) if len(self.steps) else 0

    def layer(self, number: int) -> LayerSpeeds:
        """Return the moves of one layer, in pieces; it is counted from 1.

        Raises
        ------
        ParameterError
            If there is no such layer.
        """
        begin, end = np.searchsorted(self.steps.layer, (number, number + 1))  # layers only ever rise
        if begin == end:
            raise ParameterError.about("layer", f"is {number}; the print has moves in layers 1 to {self.count}")
        rows = slice(int(begin), int(end))
        return _find_piece_speeds(slice_rows(self.steps, rows), slice_rows(self.plan, rows), list(self.features))

    def heights(self) -> Floats:
        """Return the z of each layer, (count,) mm: where most of its filament is laid; NaN without any."""
        draws = (self.steps.moves.delta[:, 3] > 0) & (self.steps.layer > 0)
        layer, z = self.steps.layer[draws], self.steps.start[draws, 2] + self.steps.moves.delta[draws, 2]
        heights = np.full(self.count + 1, np.nan)
        order = np.argsort(layer, kind="stable")
        bounds = np.searchsorted(layer[order], np.arange(self.count + 2))
        for number, (begin, end) in enumerate(zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True)):
            if end > begin:
                heights[number] = np.median(z[order[begin:end]])
        return heights[1:]


def plan_layers(path: str | os.PathLike[str], plate: int | None = None, *, most: int | None = None) -> PlannedLayers:
    """Plan a file as `motion` does; return the moves of all layers.

    Parameters
    ----------
    path : path
    plate : int, optional
        Plate of an archive; by default the first that has G-code.
    most : int, optional
        Moves that are kept, at most.

    Raises
    ------
    FormatError
        If the file is not G-code, or has no moves.
    MemoryLimitError
        If it has too many moves.
    """
    all_steps, all_plans, count = list[Steps](), list[MotionPlan](), 0
    with open_sliced(Path(path)) as file, open_timeline(file, file.part_of_plate(plate), collect_given()) as timeline:
        for steps, plan in timeline:
            count += len(steps)
            if most is not None and count > most:
                raise MemoryLimitError(f"{Path(path).name} has more than {most:,} moves; use the command line for it")
            all_steps.append(steps)
            all_plans.append(plan)
        features = tuple(timeline.features)
    if not count:
        raise FormatError(f"{Path(path).name} has no moves")
    return PlannedLayers(steps=concatenate_rows(all_steps), plan=concatenate_rows(all_plans), features=features)


@dataclass(frozen=True, kw_only=True)
class LayerSpeeds:
    """The moves of one layer, in pieces.

    Parameters
    ----------
    start, end : (N, 3) float64
        mm
    speed : (N,) float64
        mm/s, in the middle of the piece.
    draws : (N,) bool
        The piece lays filament.
    role : (N,) str
        Role of the feature in force.
    """

    start: Floats
    end: Floats
    speed: Floats
    draws: NDArray[np.bool_]
    role: NDArray[np.str_]


@dataclass(frozen=True, kw_only=True)
class DrawnSpeeds:
    """The lines of filament of a print, in pieces of nearly one speed.

    Parameters
    ----------
    start, end : (N, 3) float32
        mm
    speed : (N,) float32
        mm/s, the length of the piece over its time.
    layer : (N,) int32
        From 1, rising; 0 for lines before the first layer.
    section : float
        Mean cross-section of the lines, mm².
    """

    start: NDArray[np.float32]
    end: NDArray[np.float32]
    speed: NDArray[np.float32]
    layer: NDArray[np.int32]
    section: float


def layer_speeds(
    path: str | os.PathLike[str],
    layer: int,
    plate: int | None = None,
    **given: Any,  # noqa: ANN401
) -> LayerSpeeds:
    """Plan a file as `motion` does; return the moves of one layer.

    Parameters
    ----------
    path : path
    layer : int
        Counted from 1.
    plate : int, optional
        Plate of an archive; by default the first that has G-code.
    **given
        As for `motion`.

    Raises
    ------
    FormatError
        If the file is not G-code.
    ParameterError
        If the file does not have this layer or plate.
    """
    batches_of_pieces = []
    stated = collect_given(**given)
    with open_sliced(Path(path)) as file, open_timeline(file, file.part_of_plate(plate), stated) as timeline:
        for steps, plan in timeline:
            begin, end = np.searchsorted(steps.layer, (layer, layer + 1))  # layers only ever rise
            rows = slice(int(begin), int(end))
            batches_of_pieces.append(
                _find_piece_speeds(slice_rows(steps, rows), slice_rows(plan, rows), timeline.features)
            )
    pieces = concatenate_rows(batches_of_pieces)
    if not len(pieces.speed):
        raise ParameterError.about("layer", f"is {layer}; {Path(path).name} has moves in layers 1 to {timeline.layers}")
    return pieces


def drawn_speeds(
    path: str | os.PathLike[str],
    plate: int | None = None,
    **given: Any,  # noqa: ANN401
) -> DrawnSpeeds:
    """Plan a file as `motion` does; return all lines of filament.

    Parameters
    ----------
    path : path
    plate : int, optional
        Plate of an archive; by default the first that has G-code.
    **given
        As for `motion`.

    Raises
    ------
    FormatError
        If the file is not G-code, or lays no filament.
    """
    batches_of_pieces, volume, length = [], 0.0, 0.0
    stated = collect_given(**given)
    with open_sliced(Path(path)) as file, open_timeline(file, file.part_of_plate(plate), stated) as timeline:
        for steps, plan in timeline:
            distance = np.linalg.norm(steps.moves.delta[:, :3], axis=1)
            drawn = (steps.moves.delta[:, 3] > 0) & (distance > 0)
            volume += float((steps.moves.delta[:, 3] * steps.section)[drawn].sum())
            length += float(distance[drawn].sum())
            batches_of_pieces.append(_draw_pieces(steps, plan))
    pieces = [np.concatenate(column) for column in zip(*batches_of_pieces, strict=True)]
    if not len(pieces[2]):
        raise FormatError(f"{Path(path).name} lays no filament; give the G-code of a slicer")
    start, end, speed, layer = pieces
    return DrawnSpeeds(start=start, end=end, speed=speed, layer=layer, section=volume / length)


def _draw_pieces(
    steps: Steps, plan: MotionPlan
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32], NDArray[np.int32]]:
    """Cut moves that lay filament into pieces, and join those of a move whose speeds are alike.

    Return start, end, speed and layer of each.
    """
    move, begin, end, speed = _cut_moves(steps, plan, COARSE_LENGTH)
    lays = steps.moves.delta[move, 3] > 0
    move, begin, end, speed = move[lays], begin[lays], end[lays], speed[lays]
    level = np.floor(speed / SPEED_STEP)
    starts = np.flatnonzero((np.diff(move, prepend=-1) != 0) | (np.diff(level, prepend=-1) != 0))
    counts = np.diff(starts, append=len(move))
    final = starts + counts - 1
    mean = counts / np.add.reduceat(1 / speed, starts) if len(starts) else speed
    move, begin, end = move[starts], begin[starts], end[final]
    origin, delta = steps.start[move], steps.moves.delta[move, :3]
    return (
        (origin + begin[:, None] * delta).astype(np.float32),
        (origin + end[:, None] * delta).astype(np.float32),
        mean.astype(np.float32),
        steps.layer[move].astype(np.int32),
    )


def _cut_moves(steps: Steps, plan: MotionPlan, piece_length: float) -> tuple[NDArray[np.intp], Floats, Floats, Floats]:
    """Cut moves into pieces; return the move of each, the shares of it where it begins and ends, and its speed."""
    distance = np.linalg.norm(steps.moves.delta[:, :3], axis=1)
    ramps = plan.peak > np.minimum(plan.entry, plan.exit)
    count = np.where(ramps, np.ceil(distance / piece_length), 1).astype(np.intp)
    count[(distance == 0) | np.isnan(steps.start[:, :2]).any(axis=1)] = 0
    move = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(move)) - np.repeat(np.cumsum(count) - count, count)
    begin, end = number / count[move], (number + 1) / count[move]
    return move, begin, end, _speed_at(plan, distance, move, (begin + end) / 2)


def _find_piece_speeds(steps: Steps, plan: MotionPlan, features: list[bytes]) -> LayerSpeeds:
    """Cut moves into pieces of `PIECE_LENGTH`; return the ends, role and planned speed of each piece."""
    move, begin, end, speed = _cut_moves(steps, plan, PIECE_LENGTH)
    start, delta = steps.start[move], steps.moves.delta[move, :3]
    return LayerSpeeds(
        start=start + begin[:, None] * delta,
        end=start + end[:, None] * delta,
        speed=speed,
        draws=steps.moves.delta[move, 3] > 0,
        role=np.array([role_of(name) for name in features])[steps.feature[move]],
    )


def _speed_at(plan: MotionPlan, distance: Floats, move: NDArray[np.intp], share: Floats) -> Floats:
    """Return the speed at a share of the distance of a move.

    The times of a trapezoid, t = d / p + ((p - e)² + (p - x)²) / (2 a p) with entry e, peak p, exit x, give the
    acceleration a; and v² = min(p², e² + 2 a s, x² + 2 a (d - s)).
    """
    entry, peak, leaving = plan.entry[move], plan.peak[move], plan.exit[move]
    length, seconds = distance[move], plan.seconds[move]
    ramps = ((peak - entry) ** 2 + (peak - leaving) ** 2) / (2 * peak)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # a ramp without a length is infinite
        acceleration = np.nan_to_num(ramps / np.maximum(seconds - length / peak, 0), nan=np.inf)
        rising = entry**2 + 2 * acceleration * share * length
        falling = leaving**2 + 2 * acceleration * (1 - share) * length
    return np.asarray(np.sqrt(np.minimum(np.minimum(rising, falling), peak**2)))


def middle_layer(path: str | os.PathLike[str], plate: int | None = None) -> int:
    """Return the number of the middle layer of a print, counted from 1; for an archive, of one plate."""
    with open_sliced(Path(path)) as file, file.text(file.part_of_plate(plate)) as sliced_text:
        return max(1, sum(len(LAYER_TAG.findall(text)) for text in batches(sliced_text.text)) // 2)
