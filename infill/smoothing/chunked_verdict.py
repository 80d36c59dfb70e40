"""The verdict on a volume in chunks: the changes in its chunks, joined, and judged by the rules of a volume in memory.

Components of the solid are matched before and after, walls with their remains, and distances are measured both
ways wherever the surfaces may be more than a voxel apart. Voids are counted, not matched.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from infill.chunks.joining import JoinedComponents, join_components, survey_solid
from infill.chunks.layout import Chunk
from infill.chunks.placing import place_points
from infill.chunks.shells import JoinedShells, join_shells
from infill.chunks.solving import MeasuredSurface, Solver
from infill.inspection.bricks import (
    FAINT,
    LARGE,
    MOST_LOST_WALLS,
    ROUNDED,
    SMALLEST_PART,
    WALL,
    LostWallPiece,
    TopologyCheck,
)
from infill.inspection.changes import ConnectionCounts, TopologyChanges
from infill.inspection.component_matching import Overlaps, compare_components, sum_overlaps
from infill.inspection.deviation import PITCH, Deviation, SurfaceGap, Word, group_places, total_area
from infill.smoothing.chunk_changes import ComparedChunk, FarPoints, MatchedChunk, compare_chunk, match_chunk
from infill.smoothing.comparing import Differences, find_differences, thickness_that_counts
from infill.smoothing.request import SmoothInput

Numbers = NDArray[np.int64]

NAMES = ("after", "walls", "gone")


@dataclass(frozen=True, kw_only=True)
class ChunkedVerdict:
    """The verdict on a volume in chunks, and its reasons.

    Parameters
    ----------
    topology : TopologyCheck
        Changes of voids are not known: they are counted as none.
    deviation : Deviation
    differences : Differences
    volume_error : float
        Relative error of the volume, 0 if it is tolerable.
    """

    topology: TopologyCheck
    deviation: Deviation
    differences: Differences
    volume_error: float

    @property
    def word(self) -> Word:
        """`kept`, `changed a little` or `lost`."""
        return self.differences.word

    @property
    def is_sound(self) -> bool:
        """Whether another way could not improve: nothing is lost, broken or fused, and the volume is right."""
        changes = self.topology.changes
        return self.word != "lost" and not (changes.broken or changes.fused or changes.vanished or self.volume_error)

    @property
    def rank(self) -> tuple[bool, int, float]:
        """Sort key of ways: the lowest is the best."""
        area = total_area((*self.deviation.lost, *self.deviation.added))
        return self.word == "lost", len(self.differences.losses) + len(self.differences.problems), area


def judge_chunks(
    solver: Solver,
    surface: MeasuredSurface,
    crumbs: NDArray[np.bool_],
    *,
    smooth_input: SmoothInput,
    levels: NDArray[np.float64],
    volume_error: float,
) -> ChunkedVerdict:
    """Judge the final surface, in one pass over the chunks, or two if connections may have changed.

    Parameters
    ----------
    solver : Solver
    surface : MeasuredSurface
    crumbs : (s,) bool
        Shells that were taken out.
    smooth_input : SmoothInput
        Its volume holds the place of the cells in space, and no values.
    levels : (b,) float64
        Level of phi of each component.
    volume_error : float
        Relative error of the volume, 0 if it is tolerable.
    """
    counts = compare_counts(solver, surface.shells, crumbs)
    removed = {number: crumbs[names] for number, names in surface.shells.names.items()}
    cells = thickness_that_counts(smooth_input)
    items = [(chunk, surface.tasks[n], removed[n], cells) for n, chunk in solver.surfaced.items()]
    compared = dict(
        zip(
            solver.surfaced,
            solver.runner.run(compare_chunk, solver.work, items, lambda share: solver.tell("check", share)),
            strict=True,
        )
    )
    settled = _connections_are_kept(solver, compared) and not (levels < FAINT).any()
    if settled:
        new_holes = max(0, counts.result.tunnels - counts.data.tunnels)
        changes = TopologyChanges(vanished_thin=0, walls_lost=0, faint=0, walls_pierced=new_holes)
        topology = replace(counts, changes=changes)
    else:
        topology = _match_components(solver, surface, counts, levels)
    deviation = _join_distances(
        compared, smooth_input, partial(place_points, place=smooth_input.data), max(solver.work.spacing)
    )
    return ChunkedVerdict(
        topology=topology,
        deviation=deviation,
        differences=find_differences(topology, deviation, smooth_input, volume_error),
        volume_error=volume_error,
    )


def _connections_are_kept(solver: Solver, compared: Mapping[int, ComparedChunk]) -> bool:
    """Tell whether solid and void are certain to be connected as before."""
    if not all(part.same for part in compared.values()):
        return False
    assert solver.joined is not None
    unchanged = np.zeros(len(solver.joined.cells), dtype=bool)
    for number, names in solver.joined.names.items():
        unchanged[names[compared[number].unchanged] if number in compared else names] = True
    return bool(unchanged.all())


def _join_distances(
    compared: Mapping[int, ComparedChunk],
    smooth_input: SmoothInput,
    place: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    cell: float,
) -> Deviation:
    """Return the distances both ways of the whole volume."""
    added, lost, thin = (
        FarPoints.join([getattr(part, name) for part in compared.values()]) for name in ("added", "lost", "thin")
    )
    added, lost, thin = (replace(distant, points=place(distant.points)) for distant in (added, lost, thin))
    apart = 2 * PITCH * cell
    new, missing, faint = (
        group_places(distant.points, distant.distance, distant.area, cell, apart=apart)
        for distant in (added, lost, thin)
    )
    return Deviation(
        there=_furthest_gap(added),
        back=_furthest_gap(lost),
        added=new,
        lost=missing,
        thin=faint,
        thin_distance=float(thin.distance.max(initial=0.0)),
        sheet=0.0,
        hidden=0.0,
        given_area=sum(part.data_area for part in compared.values()),
        result_area=sum(part.result_area for part in compared.values()),
        cell=smooth_input.distance_unit,
        exact=False,
    )


def _furthest_gap(distant: FarPoints) -> SurfaceGap:
    """Return the furthest point as a gap."""
    if not len(distant.distance):
        return SurfaceGap(mean=0.0, rms=0.0, p95=0.0, max=0.0, at=(0.0, 0.0, 0.0))
    worst = int(distant.distance.argmax())
    x, y, z = distant.points[worst].tolist()
    furthest = float(distant.distance[worst])
    return SurfaceGap(mean=furthest, rms=furthest, p95=furthest, max=furthest, at=(x, y, z))


def _match_components(
    solver: Solver, surface: MeasuredSurface, counts: TopologyCheck, levels: NDArray[np.float64]
) -> TopologyCheck:
    """Compare components and walls before and after: see `infill.inspection.bricks.check_topology`."""
    reach = ROUNDED + int(np.ceil(solver.work.smoothing.blur))
    items = [(chunk, surface.tasks[number], reach) for number, chunk in solver.surfaced.items()]
    matched: dict[int, MatchedChunk] = dict(
        zip(
            solver.surfaced,
            solver.runner.run(match_chunk, solver.work, items, lambda share: solver.tell("check", share)),
            strict=True,
        )
    )
    before = solver.joined
    assert before is not None
    solid = {n: chunk for n, chunk in solver.chunks.items() if n in before.names and n not in matched}
    after, walls, gone = (_join_parts(matched, name, solid if name != "gone" else {}) for name in NAMES)
    thick = np.zeros(len(before.cells), dtype=bool)
    middle = np.zeros((len(gone.cells), 3))
    for number, part in matched.items():
        thick[before.names[number][part.thick]] = True
        is_real = gone.names[number] >= 0
        np.add.at(middle, gone.names[number][is_real], part.middle[is_real])
    for number in solid:
        thick[before.names[number]] = True
    of_solid = _sum_shared({n: part.of_solid for n, part in matched.items()}, before, after, solid)
    of_walls = _sum_shared({n: part.of_walls for n, part in matched.items()}, walls, after, solid)
    fate_of_solid = compare_components(of_solid, part=SMALLEST_PART, piece=LARGE, counted=thick)
    fate_of_walls = compare_components(of_walls, part=SMALLEST_PART, piece=LARGE)
    shells = join_shells({number: part.sturdy for number, part in matched.items()}, solver.cell_volume)
    sturdy = count_connections(shells, np.zeros(len(shells.volume), dtype=bool))
    changes = TopologyChanges(
        vanished=int(thick[fate_of_solid.vanished].sum()),
        vanished_thin=int((~thick[fate_of_solid.vanished]).sum()),
        broken=int((walls.cells[fate_of_walls.broken] >= WALL).sum()),
        fused=len(fate_of_solid.fused),
        appeared=len(fate_of_solid.appeared),
        walls_pierced=max(0, counts.result.tunnels - max(counts.data.tunnels, sturdy.tunnels)),
        walls_lost=int((gone.cells >= WALL).sum()),
        faint=int((thick & (before.cells >= WALL) & (levels < FAINT)).sum()),
    )
    largest = np.argsort(-gone.cells, kind="stable")[:MOST_LOST_WALLS]
    lost = tuple(
        LostWallPiece(
            voxels=int(gone.cells[number]), at=(middle[number] / gone.cells[number] + 0.5) * solver.work.spacing
        )
        for number in largest
        if gone.cells[number] >= WALL
    )
    return replace(counts, changes=changes, lost=lost)


def _join_parts(matched: Mapping[int, MatchedChunk], name: str, solid: Mapping[int, Chunk]) -> JoinedComponents:
    """Join the components of one kind; those without a cell of their own, seen by a neighbour alone, get -1."""
    surveys = {number: getattr(part, name) for number, part in matched.items()}
    surveys |= {number: survey_solid(chunk) for number, chunk in solid.items()}
    joined = join_components(surveys, [])
    is_real = joined.cells > 0
    number = np.where(is_real, np.cumsum(is_real) - 1, -1).astype(np.int32)
    return JoinedComponents(
        cells=joined.cells[is_real], names={key: number[names] for key, names in joined.names.items()}
    )


def _sum_shared(
    pairs: Mapping[int, Numbers], before: JoinedComponents, after: JoinedComponents, solid: Mapping[int, Chunk]
) -> Overlaps:
    """Sum the cells that components share in all chunks; chunks that are solid throughout have one of each."""
    rows = [np.empty((0, 3), dtype=np.int64)]
    for number, shared in pairs.items():
        rows.append(
            np.stack(
                [before.names[number][shared[:, 0]], after.names[number][shared[:, 1]], shared[:, 2]], axis=1
            ).astype(np.int64)
        )
    for number, chunk in solid.items():
        cells = int(np.prod([part.stop - part.start for part in chunk.own_cells]))
        rows.append(np.array([[before.names[number][0], after.names[number][0], cells]], dtype=np.int64))
    return sum_overlaps(np.concatenate(rows), before=len(before.cells), after=len(after.cells))


def compare_counts(solver: Solver, shells: JoinedShells, marked: NDArray[np.bool_]) -> TopologyCheck:
    """Compare the connections of the data with those of the surface, without its crumbs."""
    data = {n: outcome.data for n, outcome in solver.smoothed.items() if outcome.data is not None}
    before = join_shells(data, solver.cell_volume)
    return TopologyCheck(
        data=count_connections(before, np.zeros(len(before.volume), dtype=bool)),
        result=count_connections(shells, marked),
        changes=TopologyChanges(),
        lost=(),
    )


def count_connections(shells: JoinedShells, marked: NDArray[np.bool_]) -> ConnectionCounts:
    """Count the components, cavities and tunnels of a surface."""
    volume, euler = shells.volume[~marked], shells.euler[~marked]
    return ConnectionCounts(
        components=int((volume > 0).sum()),
        cavities=int((volume <= 0).sum()),
        tunnels=int((2 - euler).sum() // 2),
        euler_number=int(euler.sum()),
    )
