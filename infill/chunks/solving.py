"""The surface of a volume in chunks at the level of the right volume: the same numbers as those of the whole at once.

smooth            every chunk: its field, components, and volumes at the first level
join              components of the whole, and the volume of each
search levels     by `infill.isosurfaces.levels`, which asks for volumes at a level: one pass over the chunks
remove crumbs     by the volumes of shells and the components nearest to them
number vertices   how many vertices and triangles each chunk writes
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.chunks.encoding import digest_data
from infill.chunks.joining import ChunkComponents, JoinedComponents, join_components
from infill.chunks.layout import Chunk
from infill.chunks.level_parts import LevelParts, LevelTask, Lowering, try_level
from infill.chunks.running import Runner
from infill.chunks.shells import JoinedShells, find_names, join_shells
from infill.chunks.tasks import SmoothedChunk, look_up_components, rank_shared, smooth
from infill.chunks.work import Work
from infill.errors import GeometryError
from infill.isosurfaces.levels import (
    ComponentTrial,
    elect_components,
    search_common_level,
    search_component_levels,
)
from infill.isosurfaces.sparse_marching import LARGE, nothing_left
from infill.kernels.sparse import CELLS

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredSurface:
    """The whole surface at a level, in numbers.

    Parameters
    ----------
    level : float
    tasks : mapping of int to LevelTask
        How each chunk makes its piece.
    parts : mapping of int to LevelParts
    shells : JoinedShells
    levels : (b,) float64 or None
        Of components; None if they share one.
    """

    level: float
    tasks: Mapping[int, LevelTask]
    parts: Mapping[int, LevelParts]
    shells: JoinedShells
    levels: NDArray[np.float64] | None = None

    @property
    def volume(self) -> float:
        """Volume inside, mm³."""
        return self.shells.total[0]

    @property
    def slope(self) -> float:
        """Its change when the level rises by one."""
        return self.shells.total[1]


@dataclass(frozen=True, kw_only=True, eq=False)
class Numbering:
    """The vertices and triangles that each chunk writes.

    Parameters
    ----------
    chunks : tuple of Chunk
        Those with triangles, in order.
    first_vertices, first_faces : (n + 1,) int64
        Before each chunk, and in all.
    names, numbers : (S,) int64
        Shared vertices, by rising names, and their numbers in the file.
    removed : mapping of int to (s,) bool
        Parts of chunks that are crumbs.
    """

    chunks: tuple[Chunk, ...]
    first_vertices: Numbers
    first_faces: Numbers
    names: Numbers
    numbers: Numbers
    removed: Mapping[int, NDArray[np.bool_]]

    def find(self, foreign: Numbers) -> Numbers:
        """Return the numbers in the file of vertices by their names."""
        found: Numbers = self.numbers[find_names(self.names, foreign)]
        return found


@dataclass(kw_only=True, eq=False)
class Solver:
    """The passes over the chunks of one volume.

    Parameters
    ----------
    work : Work
    runner : Runner
    tell : callable
        Called with the stage and the share of its tasks that are done.
    """

    work: Work
    runner: Runner
    tell: Callable[[str, float], None]
    smoothed: dict[int, SmoothedChunk] = field(default_factory=dict)
    chunks: dict[int, Chunk] = field(default_factory=dict)
    joined: JoinedComponents | None = None
    targets: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    passes: int = 0
    recent: dict[str, LevelParts] = field(default_factory=dict)  # by digests of chunks and tasks

    @property
    def cell_volume(self) -> float:
        """Volume of a cell, mm³."""
        return float(np.prod(np.array(self.work.spacing)))

    @property
    def surfaced(self) -> dict[int, Chunk]:
        """The chunks that a surface may cross."""
        return {number: self.chunks[number] for number, outcome in self.smoothed.items() if outcome.start is not None}

    def smooth(self) -> None:
        """Smooth all chunks."""
        self.chunks = {chunk.number: chunk for chunk in self.work.layout}
        items = [(chunk,) for chunk in self.chunks.values()]
        results = self.runner.run(smooth, self.work, items, lambda share: self.tell("smooth", share))
        self.smoothed = dict(zip(self.chunks, results, strict=True))

    def join_components(self) -> JoinedComponents:
        """Join the components of the chunks."""
        surveys = {n: outcome.components for n, outcome in self.smoothed.items() if outcome.components is not None}
        queries: dict[int, list[tuple[int, Numbers, Numbers]]] = {}
        for number, survey in surveys.items():
            if len(survey.strange):
                owners = self._owners(survey.strange)
                for owner in np.unique(owners).tolist():
                    chosen = owners == owner
                    queries.setdefault(owner, []).append((number, survey.strange_by[chosen], survey.strange[chosen]))
        owners_list = [owner for owner in queries if self.smoothed[owner].start is not None]
        questions = [
            (self.chunks[owner], np.concatenate([names for _, _, names in queries[owner]])) for owner in owners_list
        ]
        answers = self.runner.run(look_up_components, self.work, questions, lambda share: self.tell("join", share))
        replies = dict(zip(owners_list, answers, strict=True))
        links = []
        for owner, query in queries.items():
            begin = 0
            for number, components, names in query:
                end = begin + len(names)
                # A chunk without a surface is solid throughout.
                others = (
                    replies[owner][begin:end].astype(np.int64) if owner in replies else np.zeros(len(names), np.int64)
                )
                links.append((number, components, owner, others))
                begin = end
        self.joined = join_components(_solid_only(surveys), links)
        return self.joined

    def _owners(self, names: Numbers) -> Numbers:
        """Return the chunks that own cells, by their names."""
        layout = self.work.layout
        number = names // CELLS
        _, second, third = layout.lattice
        place = np.stack([number // (second * third), number // third % second, number % third], axis=1)
        chunk = place // np.array(layout.size)
        _, counts_j, counts_k = layout.counts
        owners: Numbers = (chunk[:, 0] * counts_j + chunk[:, 1]) * counts_k + chunk[:, 2]
        return owners

    def measure(
        self,
        level: float,
        levels: NDArray[np.float64] | None = None,
        *,
        common: float = 0.0,
        votes: bool = False,
        stage: str = "surface",
    ) -> MeasuredSurface:
        """Measure the whole surface at a level, in one pass over the chunks, or two if cubes are undecided.

        Parameters
        ----------
        level : float
        levels : (b,) float64, optional
            The level of each component, which is subtracted from the field before.
        common : float
            The level of everything else, then.
        votes : bool
            Whether to count the components nearest to the vertices.
        stage : str
            Told to the listener.

        Raises
        ------
        GeometryError
            If nothing is above the level.
        """
        tasks = {}
        for number in self.surfaced:
            names = self.joined.names.get(number) if self.joined else None
            lowering = None if levels is None or names is None else Lowering(levels=levels[names], common=common)
            count = 1 if self.joined is None else len(self.joined.cells)
            tasks[number] = LevelTask(level=level, lowering=lowering, names=names, components=count, votes=votes)
        return self._measure(tasks, {}, level, stage)

    def measure_start(self) -> MeasuredSurface:
        """Return the whole surface at the first level, which was measured when the chunks were smoothed."""
        level = 0.0 if self.work.level is None else self.work.level
        parts = {number: self.smoothed[number].start for number in self.surfaced}
        measured = {number: part for number, part in parts.items() if part is not None}
        return self._measure({number: LevelTask(level=level) for number in measured}, measured, level, "surface")

    def _measure(
        self, tasks: Mapping[int, LevelTask], known: Mapping[int, LevelParts], level: float, stage: str
    ) -> MeasuredSurface:
        earlier, self.recent = self.recent, {}
        parts = dict(known) or self._run(tasks, stage, earlier)
        pending = [number for number, part in parts.items() if not part.complete]
        if any(len(part.cubes.bricks) for part in parts.values()):
            begins = number_cubes(parts)
            tasks = {number: replace(task, first_cubes=begins[number]) for number, task in tasks.items()}
            parts |= self._run({number: tasks[number] for number in pending}, stage, earlier)
        if not sum(part.own for part in parts.values()):
            raise nothing_left(level)
        return MeasuredSurface(level=level, tasks=tasks, parts=parts, shells=join_shells(parts, self.cell_volume))

    def _run(
        self, tasks: Mapping[int, LevelTask], stage: str, earlier: Mapping[str, LevelParts]
    ) -> dict[int, LevelParts]:
        """Measure chunks; a task that is the same as one of the earlier surface has the same result."""
        self.passes += 1
        digests = {number: digest_data(number, task) for number, task in tasks.items()}
        pending = [number for number, digest in digests.items() if digest not in earlier]
        items = [(self.chunks[number], tasks[number]) for number in pending]
        results = self.runner.run(try_level, self.work, items, lambda share: self.tell(stage, share))
        measured = dict(zip(pending, results, strict=True))
        parts = {number: measured.get(number) or earlier[digests[number]] for number in tasks}
        self.recent |= {digests[number]: part for number, part in parts.items()}
        return parts

    def find_surface(self) -> tuple[MeasuredSurface, float, NDArray[np.float64]]:
        """Find the surface; return it, the common level, and the level of each component.

        Raises
        ------
        GeometryError
            If nothing is left above any level.
        """
        joined = self.join_components()
        count = len(joined.cells)
        self.targets = targets = self.find_targets(joined)
        if self.work.level is not None:
            return self.measure_start(), self.work.level, np.full(count, self.work.level)
        total = float(targets.sum())
        start: MeasuredSurface | None = None
        try:
            start = self.measure_start()
        except GeometryError:
            start = None
        bricks = sum(outcome.bricks for outcome in self.smoothed.values())
        decided = start is not None and not any(len(part.cubes.bricks) for part in start.parts.values())
        at_zero = start.shells.total if start is not None and decided and bricks >= LARGE else None

        def try_at(level: float) -> MeasuredSurface:
            if level == 0.0 and start is not None:
                return start
            return self.measure(level)

        best = search_common_level(total, try_at, at_zero)
        common = best.level
        if count == 1:
            return best, common, np.array([common])

        def try_levels(levels: NDArray[np.float64]) -> ComponentTrial[MeasuredSurface]:
            surface = replace(self.measure(0.0, levels, common=common, votes=True), levels=levels)
            component, fused = elect(surface, joined.cells)
            return ComponentTrial(
                component=component,
                fused=fused,
                volume=surface.shells.volume,
                slope=surface.shells.slope,
                found=surface,
            )

        best = search_component_levels(joined.cells, targets, common, try_levels)
        assert best.levels is not None
        return best, common, best.levels

    def find_targets(self, joined: JoinedComponents) -> NDArray[np.float64]:
        """Return the volume of each component of the data (b,), mm³: of its cells, or inside the grey surface.

        Raises
        ------
        GeometryError
            If nothing of grey data is above 0.
        """
        cells, count = joined.volumes(self.cell_volume), len(joined.cells)
        if self.work.grey is None:
            return cells
        tasks = {
            number: LevelTask(level=0.0, names=joined.names.get(number), components=count, votes=True, unsmoothed=True)
            for number in self.surfaced
        }
        surface = self._measure(tasks, {}, 0.0, "join")
        component, _ = elect(surface, joined.cells)
        is_member = component >= 0
        volume = np.bincount(component[is_member], weights=surface.shells.volume[is_member], minlength=count)
        return np.where(volume > 0, volume, cells)

    def vote(self, surface: MeasuredSurface) -> tuple[Numbers, Numbers]:
        """Return the component of each shell, -1 for none, and pairs that share one: see `elect_components`."""
        assert self.joined is not None
        if not any(task.votes for task in surface.tasks.values()):
            assert surface.levels is None  # levels of components are found by votes
            surface = self.measure(surface.level, votes=True, stage="check")
        return elect(surface, self.joined.cells)

    def number_vertices(self, surface: MeasuredSurface, crumbs: NDArray[np.bool_]) -> Numbering:
        """Count the vertices and triangles of all chunks, without those of the shells that `crumbs` (n,) marks."""
        removed = {number: crumbs[names] for number, names in surface.shells.names.items()}
        chunks, counts, shared = [], [], []
        recounted_chunks = [number for number, marked in removed.items() if marked.any()]
        items = [(self.chunks[n], surface.tasks[n], removed[n]) for n in recounted_chunks]
        recounted = dict(
            zip(
                recounted_chunks,
                self.runner.run(rank_shared, self.work, items, lambda share: self.tell("check", share)),
                strict=True,
            )
        )
        for number, part in surface.parts.items():
            if number in recounted:
                vertices, faces, names, ranks = recounted[number]
            else:
                used = part.shared_in >= 0
                vertices, faces = part.own, int(part.shells.faces.sum())
                names, ranks = part.shared[used], part.shared_rank[used]
            if not faces:
                continue
            chunks.append(self.chunks[number])
            counts.append((vertices, faces))
            shared.append((names, ranks))
        begins = np.cumsum(np.array([(0, 0), *counts], dtype=np.int64), axis=0)
        nothing = np.empty(0, dtype=np.int64)
        names = np.concatenate([nothing, *(names for names, _ in shared)])
        numbers = np.concatenate([nothing, *(ranks + begins[n, 0] for n, (_, ranks) in enumerate(shared))])
        return Numbering(
            chunks=tuple(chunks),
            first_vertices=begins[:, 0],
            first_faces=begins[:, 1],
            names=names,
            numbers=numbers,
            removed=removed,
        )


def _solid_only(surveys: Mapping[int, ChunkComponents | None]) -> dict[int, ChunkComponents]:
    return {number: survey for number, survey in surveys.items() if survey is not None}


def elect(surface: MeasuredSurface, cells: Numbers) -> tuple[Numbers, Numbers]:
    """Add up the votes of all chunks, and elect the component of each shell."""
    count = len(cells)
    keys, votes = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    for number, part in surface.parts.items():
        shell, component = np.divmod(part.voters, max(count, 1))
        keys.append(surface.shells.names[number][shell].astype(np.int64) * count + component)
        votes.append(part.votes)
    key, where = np.unique(np.concatenate(keys), return_inverse=True)
    total = np.zeros(len(key), dtype=np.int64)
    np.add.at(total, where.reshape(-1), np.concatenate(votes))
    return elect_components(key, total, len(surface.shells.volume), cells)


def number_cubes(parts: Mapping[int, LevelParts]) -> dict[int, Numbers]:
    """Return the number of undecided cubes before each brick, in the order of the whole surface, by chunk."""
    bricks = np.concatenate([part.cubes.bricks for part in parts.values()])
    counts = np.concatenate([part.cubes.counts for part in parts.values()])
    order = np.argsort(bricks)
    begins = np.empty(len(bricks), dtype=np.int64)
    begins[order] = np.cumsum(counts[order]) - counts[order]
    ends = np.cumsum([len(part.cubes.bricks) for part in parts.values()])
    return dict(zip(parts, np.split(begins, ends[:-1]), strict=True))
