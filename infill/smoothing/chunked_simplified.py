"""The surface of a volume in chunks with fewer triangles: its fragments in a folder, one file each.

    parts of chunks  ─▶  boxes around faces between them  ─▶  around edges  ─▶  around corners  ─▶  numbers of vertices

Only the fragments at work are in memory, and the numbers of vertices at their borders: see `infill.chunks.seams`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.encoding import digest_data, encode_data
from infill.chunks.keeping import NOT_KEPT, ResultFolder
from infill.chunks.seams import AROUND, FARTHEST, Box, SeamPlan
from infill.chunks.shells import find_names
from infill.chunks.simplifying import NUMBERS, PARTS, Fragment, near_box, simplify_box, simplify_chunk
from infill.chunks.solving import MeasuredSurface, Numbering, Solver
from infill.errors import OutputError, ParameterError
from infill.files.whole_files import wrap_os_errors
from infill.plain_numbers import plain_argument
from infill.volume import Volume

Numbers = NDArray[np.int64]
BATCH = 2  # tasks for each worker whose arguments are in memory at once


def check_tolerance(tolerance: float | None, spacing: Sequence[float]) -> None:
    """Raise ParameterError for a tolerance that reaches further than boxes around seams look."""
    limit = FARTHEST * min(spacing)
    if tolerance is not None and tolerance > limit:
        raise ParameterError.about(
            "tolerance",
            f"is {plain_argument(tolerance)} mm, and a volume in chunks is simplified by at most a voxel; give at most "
            f"{plain_argument(limit)}, and simplify the result further as a mesh",
        )


@dataclass(kw_only=True, eq=False)
class Stored:
    """A fragment in the folder.

    Parameters
    ----------
    name : str
    low, high : (3,) float64, cells
        Its extents.
    """

    name: str
    low: NDArray[np.float64]
    high: NDArray[np.float64]


@dataclass(kw_only=True, eq=False)
class SimplifiedSurface:
    """The simplified surface of a volume in chunks.

    Parameters
    ----------
    solver : Solver
    surface : MeasuredSurface
    numbering : Numbering
    tolerance : float, mm
    folder : ResultFolder
    place : Volume
        The place of the grid in space.
    tell : callable
        Called with the share that is done.
    """

    solver: Solver
    surface: MeasuredSurface
    numbering: Numbering
    tolerance: float
    folder: ResultFolder
    place: Volume
    tell: Callable[[float], None]
    fragments: list[Stored] = field(default_factory=list)
    originals: list[Stored] = field(default_factory=list)
    removed: dict[int, list[Numbers]] = field(default_factory=dict)
    sums: list[Numbers] = field(default_factory=list)
    vertices: int = 0
    triangles: int = 0
    _begins: list[int] = field(default_factory=list)
    _names: Numbers = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    _numbers: Numbers = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    _owned: list[Numbers] = field(default_factory=list)

    @property
    def plan(self) -> SeamPlan:
        """The boxes around seams."""
        return SeamPlan(layout=self.solver.work.layout)

    def simplify(self) -> None:
        """Simplify all parts, then the boxes between them."""
        self._simplify_chunks()
        rounds = list(self.plan.rounds())
        total, done = sum(map(len, rounds)), 0
        for boxes in rounds:
            self._simplify_boxes(boxes, done, total)
            done += len(boxes)
        self._count()

    def _simplify_chunks(self) -> None:
        """Simplify the parts of all chunks."""
        numbering, work = self.numbering, self.solver.work
        common = digest_data("chunk", work.layout, self.tolerance)
        batch, chunks = BATCH * self.solver.runner.workers, numbering.chunks
        for begin in range(0, len(chunks), batch):
            keys, items = [], []
            for number in range(begin, min(begin + batch, len(chunks))):
                chunk = chunks[number]
                task, removed = self.surface.tasks[chunk.number], numbering.removed[chunk.number]
                part = self.surface.parts[chunk.number]
                names = part.foreign[part.foreign_in >= 0]
                if len(removed):
                    names = part.foreign[(part.foreign_in >= 0) & ~removed[part.foreign_in]]
                first, foreign = int(numbering.first_vertices[number]), numbering.find(names)
                items.append((chunk, task, removed, first, self.tolerance, self.place, foreign))
                keys.append(digest_data(common, *items[-1][:4]))
            for _, record in zip(items, self._finish(keys, items, self._run_chunks), strict=True):
                self.sums.append(record["sums"])
                for fragment, original in zip(record["fragments"], record["originals"], strict=True):
                    self.fragments.append(fragment)
                    self.originals.append(original)
            self.tell(0.7 * min(1.0, (begin + batch) / len(chunks)))

    def _run_chunks(self, keys: list[str], items: list[Any]) -> None:
        """Simplify chunks, and write their fragments and a record of each."""
        results = self.solver.runner.run(simplify_chunk, self.solver.work, items, keep=False)
        for key, (parts, sums) in zip(keys, results, strict=True):
            fragments = [self._store(part.fragment, digest_data(key, "part", n)) for n, part in enumerate(parts)]
            originals = [self._store(part.original, digest_data(key, "original", n)) for n, part in enumerate(parts)]
            self._write(key, {"sums": sums, "fragments": fragments, "originals": originals})

    def _simplify_boxes(self, boxes: list[Box], before: int, total: int) -> None:
        """Simplify the surface in the boxes of one round; all see it as it was before the round."""
        common = digest_data("box", self.solver.work.layout, self.tolerance, [stored.name for stored in self.fragments])
        base = len(self.solver.work.layout) * PARTS + before
        batch = BATCH * self.solver.runner.workers
        added: list[Stored] = []
        removed: list[tuple[int, Numbers]] = []
        for begin in range(0, len(boxes), batch):
            chosen = boxes[begin : begin + batch]
            keys = [digest_data(common, box) for box in chosen]
            items = [(box, NUMBERS * (1 + base + begin + n)) for n, box in enumerate(chosen)]
            for record in self._finish(keys, items, self._run_boxes):
                if record["fragment"] is not None:
                    added.append(record["fragment"])
                    removed += zip(record["sources"], record["removed"], strict=True)
            self.tell(0.7 + 0.3 * (before + begin + len(chosen)) / total)
        for source, faces in removed:
            self.removed.setdefault(source, []).append(faces)
        self.fragments += added

    def _run_boxes(self, keys: list[str], items: list[Any]) -> None:
        """Simplify boxes, and write the fragments that change."""
        tasks, sources = [], []
        for box, base in items:
            fragments, indices = self._near(box, self.fragments, self.removed)
            originals, _ = self._near(box, self.originals, {})
            sources.append(indices)
            tasks.append((box, fragments, originals, self.tolerance, base))
        results = self.solver.runner.run(simplify_box, tuple(self.solver.work.spacing), tasks, keep=False)
        for key, result, indices in zip(keys, results, sources, strict=True):
            record: dict[str, Any] = {"fragment": None, "sources": [], "removed": []}
            if result.removed:
                record["fragment"] = self._store(result.fragment, digest_data(key, "fragment"))
                record["sources"] = [source for source, _ in indices]
                record["removed"] = [faces[gone] for (_, faces), gone in zip(indices, result.removed, strict=True)]
            self._write(key, record)

    def _near(
        self, box: Box, stored: Sequence[Stored], removed: dict[int, list[Numbers]]
    ) -> tuple[list[Fragment], list[tuple[int, Numbers]]]:
        """Return the part of each fragment near a box, and the numbers of fragments and their faces."""
        pieces, indices = [], []
        spacing = tuple(self.solver.work.spacing)
        for number, entry in enumerate(stored):
            if not box.meets(entry.low, entry.high, AROUND):
                continue
            fragment = self._load(entry)
            is_around = near_box(fragment, box, spacing)
            for faces in removed.get(number, ()):
                is_around[faces] = False
            if is_around.any():
                pieces.append(fragment.select(is_around))
                indices.append((number, np.flatnonzero(is_around)))
        return pieces, indices

    def _finish(self, keys: list[str], items: list[Any], run: Callable[[list[str], list[Any]], None]) -> list[Any]:
        """Return the records of tasks; those that are not in the folder, or whose files are not whole, are run."""
        missing = [n for n, key in enumerate(keys) if not self._is_whole(self.folder.find(key))]
        if missing:
            run([keys[n] for n in missing], [items[n] for n in missing])
        return [self.folder.find(key) for key in keys]

    def _is_whole(self, record: Any) -> bool:  # noqa: ANN401
        """Tell whether a record was found, with all its files."""
        if record is NOT_KEPT:
            return False
        names = [*record.get("fragments", ()), *record.get("originals", ()), record.get("fragment")]
        return all(self.folder.find(stored.name) is not NOT_KEPT for stored in names if stored is not None)

    def _store(self, fragment: Fragment, name: str) -> Stored:
        """Write a fragment; return where."""
        self._write(name, fragment)
        cells = fragment.points / np.array(self.solver.work.spacing)
        nothing = np.full(3, np.nan)
        low, high = (cells.min(axis=0), cells.max(axis=0)) if len(cells) else (nothing, nothing)
        return Stored(name=name, low=low, high=high)

    def _write(self, name: str, value: Any) -> None:  # noqa: ANN401
        with wrap_os_errors(Path(self.folder.folder)):
            self.folder.write(name, encode_data(value))

    def _load(self, stored: Stored) -> Fragment:
        """Read a fragment."""
        fragment = self.folder.find(stored.name)
        if fragment is NOT_KEPT:
            raise OutputError(f"a file in {self.folder.folder} was damaged while it was needed; run the command again")
        assert isinstance(fragment, Fragment)
        return fragment

    def _left(self, number: int) -> Fragment:
        """Return the rest of a fragment."""
        fragment = self._load(self.fragments[number])
        stays = np.ones(len(fragment.faces), dtype=bool)
        for faces in self.removed.get(number, ()):
            stays[faces] = False
        return fragment.select(stays)

    def _count(self) -> None:
        """Count vertices and triangles, and number the vertices at borders, each in the first fragment that has it."""
        borders, inner = [np.empty(0, dtype=np.int64)], []
        for number in range(len(self.fragments)):
            fragment = self._left(number)
            border = fragment.border
            borders.append(fragment.numbers[border])
            inner.append(len(border) - int(border.sum()))
            self.triangles += len(fragment.faces)
        names = np.concatenate(borders)
        self._names, first = np.unique(names, return_index=True)
        owned = np.zeros(len(names), dtype=bool)
        owned[first] = True
        ends = np.cumsum([len(border) for border in borders])
        own_border = [int(owned[a:b].sum()) for a, b in pairwise(ends)]
        counts = [a + b for a, b in zip(inner, own_border, strict=True)]
        self._begins = [0, *np.cumsum(counts).tolist()]
        self.vertices = self._begins[-1]
        # Own vertices come first in a piece: those inside, then those at its border.
        numbers = np.full(len(names), -1, dtype=np.int64)
        for number, (begin, end) in enumerate(pairwise(ends)):
            mine = np.flatnonzero(owned[begin:end])
            numbers[begin + mine] = self._begins[number] + inner[number] + np.arange(len(mine))
            self._owned.append(mine)
        self._numbers = numbers[first]

    def pieces(self) -> Iterator[tuple[NDArray[np.float64], NDArray[np.int64], int, Numbers]]:
        """Yield the points of each fragment, its faces, its own points, which come first, and the numbers of all."""
        for number in range(len(self.fragments)):
            fragment = self._left(number)
            if not len(fragment.faces):
                continue
            border = np.flatnonzero(fragment.border)
            is_inner = np.ones(len(fragment.points), dtype=bool)
            is_inner[border] = False
            is_owned = np.zeros(len(border), dtype=bool)
            is_owned[self._owned[number]] = True
            order = np.concatenate([np.flatnonzero(is_inner), border[is_owned], border[~is_owned]])
            own = int(is_inner.sum()) + int(is_owned.sum())
            rank = np.empty(len(order), dtype=np.int64)
            rank[order] = np.arange(len(order))
            others = self._numbers[find_names(self._names, fragment.numbers[border[~is_owned]])]
            numbers = np.concatenate([self._begins[number] + np.arange(own), others])
            yield fragment.points[order], rank[fragment.faces], own, numbers
